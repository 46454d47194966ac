/* Torque on each chunk about its center of mass. */
#include "style/per_chunk.h"

/** (r - r_cm) x f along an axis. */
static double component(const hs_compute *compute, int i, int64_t c, const void *axis)
{
    const hs_atoms *atoms = compute->env->atoms;
    const int x = (*(const int *)axis + 1) % 3, y = (*(const int *)axis + 2) % 3;
    double d[3];
    hs_per_chunk_arm(compute, i, c, d);
    return d[x] * atoms->f[y][i] - d[y] * atoms->f[x][i];
}

static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    return hs_per_chunk_create(compute, args, 3, true, err);
}

static hs_status array(hs_compute *compute, hs_error *err) { return hs_per_chunk_sum_moments(compute, component, err); }

const hs_compute_style hs_compute_style_torque_chunk = {
    .about = {.name = "torque/chunk",
              .syntax = {.usage = "<chunk-ID>", .n_min = 1, .n_max = 1},
              .summary = "torque on each chunk",
              .details = "The array `c_ID` has a row for each chunk of the compute chunk/atom: the sum of (r - r_cm) x "
                         "f over those of its atoms that are in the group, along x, y and z (energy), with unwrapped "
                         "places and the chunk's center of mass; 0 without any.",
              .example = "compute c all cluster/atom 1.5\ncompute drops all chunk/atom c_c compress yes\n"
                         "compute turn all torque/chunk drops"},
    .state_size = sizeof(hs_per_chunk),
    .create = create,
    .destroy = hs_per_chunk_destroy,
    .init = hs_per_chunk_init,
    .array = array,
};
