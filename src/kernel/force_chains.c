/* The loop over cells of methods `linked`, `incremental` and `hash`: each pair of atoms in the same cell or in cells that
 * the stencil joins is met once. */
#include <math.h>
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

/** Append the atoms of a chain; its first atom is `first`. */
static hs_status follow(hs_candidates *candidates, const hs_force_job *job, const hs_chains *chains, int32_t first,
                        hs_error *err)
{
    for (int32_t i = first; i != HS_CHAIN_END; i = chains->next[i]) {
        HS_TRY(hs_candidates_reserve(candidates, candidates->n + 1, err));
        candidates->index[candidates->n] = i;
        for (int axis = 0; axis < 3; ++axis) candidates->x[axis][candidates->n] = job->input.x[axis][i];
        ++candidates->n;
    }
    return HS_OK;
}

/** The atoms of a cell, *n_own of them, and after these the ones of the cells of the stencil. */
static hs_status gather(hs_candidates *candidates, const hs_force_job *job, const hs_chains *chains, int64_t cell,
                        int *n_own, hs_error *err)
{
    const hs_grid *grid = &chains->grid;
    candidates->n = 0;
    HS_TRY(follow(candidates, job, chains, chains->head[cell], err));
    *n_own = candidates->n;
    if (*n_own == 0) return HS_OK;
    int here[3];
    hs_chains_coordinates(chains, cell, here);
    for (int k = 0; k < grid->n_stencil; ++k) {
        const int *offset = grid->stencil[k],
                  there[3] = {here[0] + offset[0], here[1] + offset[1], here[2] + offset[2]};
        HS_TRY(follow(candidates, job, chains, hs_chains_first(chains, there), err));
    }
    return HS_OK;
}

/** Append the large atoms of all coarse cells that come within reach of the cell's own atoms, which are the first n_own. */
static hs_status gather_large(hs_candidates *candidates, const hs_force_job *job, int n_own, double reach,
                              hs_error *err)
{
    const hs_grid *grid = &job->coarse->grid;
    int lo[3], hi[3], c[3];
    for (int axis = 0; axis < 3; ++axis) {
        double least = candidates->x[axis][0], most = least;
        for (int a = 1; a < n_own; ++a) {
            least = fmin(least, candidates->x[axis][a]);
            most = fmax(most, candidates->x[axis][a]);
        }
        lo[axis] = hs_grid_coordinate(grid, axis, least - reach);
        hi[axis] = hs_grid_coordinate(grid, axis, most + reach);
    }
    for (c[0] = lo[0]; c[0] <= hi[0]; ++c[0])
        for (c[1] = lo[1]; c[1] <= hi[1]; ++c[1])
            for (c[2] = lo[2]; c[2] <= hi[2]; ++c[2])
                HS_TRY(follow(candidates, job, job->coarse, hs_chains_first(job->coarse, c), err));
    return HS_OK;
}

/** Candidates [begin, end) closer than `cutoff` to candidate a, appended to the n_near ones there are; their new number. Some a hair
 *  beyond it come along, for the kernel, which looks again, may round otherwise. */
static int find_near(hs_candidates *candidates, int a, int begin, int end, double cutoff, int n_near)
{
    const double limit = cutoff * cutoff * (1.0 + 1e-12);
    const double x = candidates->x[0][a], y = candidates->x[1][a], z = candidates->x[2][a];
    for (int b = begin; b < end; ++b) {
        const double dx = candidates->x[0][b] - x, dy = candidates->x[1][b] - y, dz = candidates->x[2][b] - z;
        candidates->r2[b] = dx * dx + dy * dy + dz * dz;
    }
    for (int b = begin; b < end; ++b) {
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

/** What is searched around the atoms of a cell. */
typedef struct surroundings {
    int n_own;           /**< the first candidates are the cell's own atoms */
    int n_alike;         /**< candidates from the same chains, the own ones too; large atoms come behind them */
    double reach, cross; /**< largest cutoffs of pairs of the same chains, and with large atoms; distance */
} surroundings;

/** The neighbors of candidate a among the candidates after it; their number. */
static int find_neighbors(hs_candidates *candidates, const hs_force_job *job, const surroundings *around, int a)
{
    const int i = candidates->index[a], n_local = job->atoms->n_local;
    int n_near = find_near(candidates, a, a + 1, around->n_alike, around->reach, 0);
    if (around->n_alike < candidates->n)
        n_near = find_near(candidates, a, around->n_alike, candidates->n, around->cross, n_near);
    if (i < n_local && !job->input.listed_only) return n_near;
    int n = 0;
    for (int k = 0; k < n_near; ++k) {
        const int32_t j = candidates->near[k];
        if (does_count(&job->input, n_local, i, j)) candidates->near[n++] = j;
    }
    return n;
}

/** Gather what is around a cell: of the chains, or from n_fine on of the coarse ones. */
static hs_status look_around(hs_candidates *candidates, const hs_force_job *job, int64_t cell, surroundings *around,
                             hs_error *err)
{
    const int64_t n_fine = job->chains->n_cells;
    const bool is_coarse = cell >= n_fine, is_fine = job->coarse != NULL && !is_coarse;
    const double small = is_fine ? job->chains->radius_hi : 0.0, large = is_fine ? job->coarse->radius_hi : 0.0;
    around->reach = is_fine ? 2.0 * small : job->cutoff_max;
    around->cross = small + large;
    HS_TRY(gather(candidates, job, is_coarse ? job->coarse : job->chains, is_coarse ? cell - n_fine : cell,
                  &around->n_own, err));
    around->n_alike = candidates->n;
    return is_fine && around->n_own > 0 ? gather_large(candidates, job, around->n_own, around->cross, err) : HS_OK;
}

static hs_status work_chains(hs_force_space *space, const hs_force_job *job, hs_force_stage stage, int thread)
{
    (void)stage;
    hs_force_buffer *buffer = &space->buffer[thread];
    hs_candidates *candidates = &buffer->candidates;
    const int64_t n_room = (int64_t)job->atoms->n_local + job->atoms->n_halo + HS_ATOMS_PAD;
    const hs_verlet_kernel kernel =
        job->evaluator->set[job->isa][job->precision]->verlet[job->with_energy][!job->input.table->is_uniform];
    const int64_t n_cells = job->chains->n_cells + (job->coarse != NULL ? job->coarse->n_cells : 0);
    int64_t begin, end;
    hs_force_share(space, n_cells, thread, &begin, &end);
    for (int64_t cell = begin; cell < end; ++cell) {
        surroundings around;
        HS_TRY(look_around(candidates, job, cell, &around, &buffer->error));
        for (int a = 0; a < around.n_own; ++a) {
            const int i = candidates->index[a];
            const int64_t range[2] = {0, find_neighbors(candidates, job, &around, a)};
            if (range[1] == 0) continue;
            hs_force_touch(buffer, i, n_room);
            for (int k = 0; k < range[1]; ++k) hs_force_touch(buffer, candidates->near[k], n_room);
            for (int k = 0; k < HS_VERLET_PAD; ++k) candidates->near[range[1] + k] = i;
            kernel(&job->input, &buffer->out, i, i + 1, range, candidates->near);
        }
        if (around.n_own > 0) hs_force_weigh(buffer, cell, n_cells, (int64_t)around.n_own * candidates->n);
    }
    return HS_OK;
}

hs_status hs_force_chains(hs_force_space *space, const hs_force_job *job, hs_force_result *result, hs_error *err)
{
    const hs_status status = hs_force_run_threads(space, job, work_chains, false, result, err);
    hs_force_keep_weights(space);
    return status;
}
