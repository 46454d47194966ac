/* Velocity of the center of mass of each chunk. */

#include "style/per_chunk.h"

static double velocity(const hs_compute *compute, int i, int64_t c, const void *axis)
{
    (void)c;
    return compute->env->atoms->v[*(const int *)axis][i];
}

static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    return hs_per_chunk_create(compute, args, 3, true, err);
}

static hs_status array(hs_compute *compute, hs_error *err)
{
    HS_TRY(hs_per_chunk_begin(compute, err));
    return hs_per_chunk_mean(compute, velocity, err);
}

const hs_compute_style hs_compute_style_vcm_chunk = {
    .about = {.name = "vcm/chunk",
              .syntax = {.usage = "<chunk-ID>", .n_min = 1, .n_max = 1},
              .summary = "velocity of the center of mass of each chunk",
              .details = "The array `c_ID` has a row for each chunk of the compute chunk/atom: the velocity of the "
                         "center of mass of those of its atoms that are in the group (distance/time); 0 without any.",
              .example = "compute layers all chunk/atom bin/1d z lower 0.5\ncompute flow all vcm/chunk layers\nfix 1 "
                         "all ave/time 100 1 100 c_flow[*] mode vector file flow.txt"},
    .state_size = sizeof(hs_per_chunk),
    .create = create,
    .destroy = hs_per_chunk_destroy,
    .init = hs_per_chunk_init,
    .array = array,
};
