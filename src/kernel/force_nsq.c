/* Method nsq: the double loop, the oracle of the others. */
#include "kernel/force.h"

static double distance2(const double *const x[3], int i, int j, double d[3])
{
    for (int axis = 0; axis < 3; ++axis) d[axis] = x[axis][i] - x[axis][j];
    return d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
}

/** Whether the pair was within its listed distance, where that counts. */
static inline bool is_listed(const hs_kernel_input *in, const double *row, int i, int j)
{
    double d[3];
    if (!in->listed_only) return true;
    const double r2 = distance2(in->x_listed, i, j, d);
    return r2 < row[HS_TABLE_LISTED_R2] && (!in->listed_by_radius || r2 < hs_listed_by_radius_r2(in, i, j));
}

/** One pair of the double loop. */
static inline void nsq_pair(hs_force_buffer *buffer, const hs_force_job *job, int i, int j)
{
    const hs_kernel_input *in = &job->input;
    const hs_pair_table *table = in->table;
    const double *row = table->values + (size_t)(in->type[i] * table->n_types + in->type[j]) * (size_t)table->stride;
    double d[3];
    const double r2 = distance2(in->x, i, j, d);
    const double sum_of_radii = job->evaluator->has_radii ? in->radius[i] + in->radius[j] : 0.0;
    double force_over_r, energy, f[3];
    if (!hs_evaluator_pair(job->evaluator, table, in->type[i], in->type[j], sum_of_radii, r2, &force_over_r, &energy))
        return;
    if (!is_listed(in, row, i, j)) return;
    for (int axis = 0; axis < 3; ++axis) {
        f[axis] = force_over_r * d[axis];
        buffer->f[axis][i] += f[axis];
        buffer->f[axis][j] -= f[axis];
    }
    buffer->out.energy += energy;
    double *virial = buffer->out.virial;
    virial[0] += d[0] * f[0];
    virial[1] += d[1] * f[1];
    virial[2] += d[2] * f[2];
    virial[3] += d[0] * f[1];
    virial[4] += d[0] * f[2];
    virial[5] += d[1] * f[2];
}

/** The double loop with the kernel of method verlet for the pairs it finds: in fixed point all methods must round alike. */
static hs_status nsq_in_fixed_point(hs_force_space *space, const hs_force_job *job, int thread)
{
    hs_force_buffer *buffer = &space->buffer[thread];
    const hs_kernel_input *in = &job->input;
    const hs_pair_table *table = in->table;
    const int n_local = job->atoms->n_local, n_all = n_local + job->atoms->n_halo;
    const hs_verlet_kernel kernel =
        job->evaluator->set[job->isa][job->precision]->verlet[job->with_energy][!table->is_uniform];
    HS_TRY(hs_candidates_reserve(&buffer->candidates, n_all, &buffer->error));
    int32_t *const listed = buffer->candidates.near;
    for (int i = thread; i < n_local; i += space->n_threads) {
        const double *rows = table->values + (size_t)(in->type[i] * table->n_types) * (size_t)table->stride;
        int64_t range[2] = {0, 0};
        for (int j = i + 1; j < n_all; ++j)
            if (is_listed(in, rows + (size_t)in->type[j] * (size_t)table->stride, i, j)) listed[range[1]++] = j;
        for (int k = 0; k < HS_VERLET_PAD; ++k) listed[range[1] + k] = i;
        kernel(in, &buffer->out, i, i + 1, range, listed);
    }
    return HS_OK;
}

static hs_status work_nsq(hs_force_space *space, const hs_force_job *job, hs_force_stage stage, int thread)
{
    (void)stage;
    hs_force_buffer *buffer = &space->buffer[thread];
    const int n_local = job->atoms->n_local, n_all = n_local + job->atoms->n_halo;
    for (int64_t i = 0; i < n_all; i += HS_FORCE_BLOCK) hs_force_touch(buffer, i, n_all + HS_ATOMS_PAD);
    if (job->precision == HS_PRECISION_FIXED) return nsq_in_fixed_point(space, job, thread);
    for (int i = thread; i < n_local; i += space->n_threads)
        for (int j = i + 1; j < n_all; ++j) nsq_pair(buffer, job, i, j);
    return HS_OK;
}

hs_status hs_force_nsq(hs_force_space *space, const hs_force_job *job, hs_force_result *result, hs_error *err)
{
    return hs_force_run_threads(space, job, work_nsq, false, result, err);
}
