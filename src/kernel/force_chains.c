/* The loop over cells of methods `linked`, `incremental` and `hash`: each pair of atoms in the same cell or in cells that
 * the stencil joins is met once. */
#include <string.h>

#include "base/memory.h"
#include "kernel/force.h"

void hs_candidates_fini(hs_candidates *candidates)
{
    HS_FREE(candidates->index);
    for (int axis = 0; axis < 3; ++axis) HS_FREE(candidates->x[axis]);
    HS_FREE(candidates->r2);
    HS_FREE(candidates->near);
    memset(candidates, 0, sizeof *candidates);
}

hs_status hs_candidates_reserve(hs_candidates *candidates, int n_needed, hs_error *err)
{
    if (n_needed <= candidates->capacity) return HS_OK;
    const int n = candidates->n, capacity = n_needed + n_needed / 2 + 256;
    HS_TRY(HS_GROW(candidates->index, (size_t)n, (size_t)capacity, err));
    for (int axis = 0; axis < 3; ++axis) HS_TRY(HS_GROW(candidates->x[axis], (size_t)n, (size_t)capacity, err));
    HS_TRY(HS_GROW(candidates->r2, 0, (size_t)capacity, err));
    HS_TRY(HS_GROW(candidates->near, 0, (size_t)capacity + HS_VERLET_PAD, err));
    candidates->capacity = capacity;
    return HS_OK;
}

/** Append the atoms of a chain. */
static hs_status follow(hs_candidates *candidates, const hs_force_job *job, int32_t first, hs_error *err)
{
    for (int32_t i = first; i != HS_CHAIN_END; i = job->chains->next[i]) {
        HS_TRY(hs_candidates_reserve(candidates, candidates->n + 1, err));
        candidates->index[candidates->n] = i;
        for (int axis = 0; axis < 3; ++axis) candidates->x[axis][candidates->n] = job->input.x[axis][i];
        ++candidates->n;
    }
    return HS_OK;
}

/** The atoms of a cell, *n_own of them, and after these the ones of the cells of the stencil. */
static hs_status gather(hs_candidates *candidates, const hs_force_job *job, int64_t cell, int *n_own, hs_error *err)
{
    const hs_chains *chains = job->chains;
    const hs_grid *grid = &chains->grid;
    candidates->n = 0;
    HS_TRY(follow(candidates, job, chains->head[cell], err));
    *n_own = candidates->n;
    if (*n_own == 0) return HS_OK;
    int here[3];
    hs_chains_coordinates(chains, cell, here);
    for (int k = 0; k < grid->n_stencil; ++k) {
        const int *offset = grid->stencil[k],
                  there[3] = {here[0] + offset[0], here[1] + offset[1], here[2] + offset[2]};
        HS_TRY(follow(candidates, job, hs_chains_first(chains, there), err));
    }
    return HS_OK;
}

/** Candidates [begin, n) closer than the largest cutoff to candidate a, into near; a hair more, for the kernel, which looks again, may round
 *  otherwise. */
static int find_near(hs_candidates *candidates, int a, double cutoff)
{
    const double limit = cutoff * cutoff * (1.0 + 1e-12);
    const double x = candidates->x[0][a], y = candidates->x[1][a], z = candidates->x[2][a];
    const int n = candidates->n, begin = a + 1;
    for (int b = begin; b < n; ++b) {
        const double dx = candidates->x[0][b] - x, dy = candidates->x[1][b] - y, dz = candidates->x[2][b] - z;
        candidates->r2[b] = dx * dx + dy * dy + dz * dz;
    }
    int n_near = 0;
    for (int b = begin; b < n; ++b) {
        candidates->near[n_near] = candidates->index[b];
        n_near += candidates->r2[b] < limit;
    }
    return n_near;
}

/** Whether the pair counts: not when both are halo atoms, nor when LAMMPS's list would not hold it. */
static inline bool does_count(const hs_kernel_input *in, int n_local, int i, int j)
{
    if (i >= n_local && j >= n_local) return false;
    if (!in->listed_only) return true;
    double r2 = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        const double d = in->x_listed[axis][i] - in->x_listed[axis][j];
        r2 += d * d;
    }
    const size_t row = (size_t)(in->type[i] * in->table->n_types + in->type[j]);
    if (in->listed_by_radius && !(r2 < hs_listed_by_radius_r2(in, i, j))) return false;
    return r2 < in->table->values[row * (size_t)in->table->stride + HS_TABLE_LISTED_R2];
}

/** The neighbors of candidate a among the candidates after it; their number. */
static int find_neighbors(hs_candidates *candidates, const hs_force_job *job, int a)
{
    const int i = candidates->index[a], n_local = job->atoms->n_local;
    const int n_near = find_near(candidates, a, job->cutoff_max);
    if (i < n_local && !job->input.listed_only) return n_near;
    int n = 0;
    for (int k = 0; k < n_near; ++k) {
        const int32_t j = candidates->near[k];
        if (does_count(&job->input, n_local, i, j)) candidates->near[n++] = j;
    }
    return n;
}

static hs_status work_chains(hs_force_space *space, const hs_force_job *job, hs_force_stage stage, int thread)
{
    (void)stage;
    hs_force_buffer *buffer = &space->buffer[thread];
    hs_candidates *candidates = &buffer->candidates;
    const int64_t n_room = (int64_t)job->atoms->n_local + job->atoms->n_halo + HS_ATOMS_PAD;
    const hs_verlet_kernel kernel =
        job->evaluator->set[job->isa][job->precision]->verlet[job->with_energy][!job->input.table->is_uniform];
    int64_t begin, end;
    hs_force_share(space, job->chains->n_cells, thread, &begin, &end);
    for (int64_t cell = begin; cell < end; ++cell) {
        int n_own;
        HS_TRY(gather(candidates, job, cell, &n_own, &buffer->error));
        for (int a = 0; a < n_own; ++a) {
            const int i = candidates->index[a];
            const int64_t range[2] = {0, find_neighbors(candidates, job, a)};
            if (range[1] == 0) continue;
            hs_force_touch(buffer, i, n_room);
            for (int k = 0; k < range[1]; ++k) hs_force_touch(buffer, candidates->near[k], n_room);
            for (int k = 0; k < HS_VERLET_PAD; ++k) candidates->near[range[1] + k] = i;
            kernel(&job->input, &buffer->out, i, i + 1, range, candidates->near);
        }
        if (n_own > 0) hs_force_weigh(buffer, cell, job->chains->n_cells, (int64_t)n_own * candidates->n);
    }
    return HS_OK;
}

hs_status hs_force_chains(hs_force_space *space, const hs_force_job *job, hs_force_result *result, hs_error *err)
{
    const hs_status status = hs_force_run_threads(space, job, work_chains, false, result, err);
    hs_force_keep_weights(space);
    return status;
}
