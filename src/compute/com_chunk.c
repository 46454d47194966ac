/* Center of mass of each chunk. */
#include "style/per_chunk.h"
#include "style/places.h"

static double place(const hs_compute *compute, int i, int64_t c, const void *axis)
{
    (void)c;
    return hs_unwrapped(compute->env, *(const int *)axis, i);
}

static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    return hs_per_chunk_create(compute, args, 3, true, err);
}

static hs_status array(hs_compute *compute, hs_error *err)
{
    HS_TRY(hs_per_chunk_begin(compute, err));
    return hs_per_chunk_mean(compute, place, err);
}

const hs_compute_style hs_compute_style_com_chunk = {
    .about = {.name = "com/chunk",
              .syntax = {.usage = "<chunk-ID>", .n_min = 1, .n_max = 1},
              .summary = "center of mass of each chunk",
              .details =
                  "The array `c_ID` has a row for each chunk of the compute chunk/atom: the center of mass of those of "
                  "its atoms that are in the group, from their unwrapped places (distance); 0 without any.",
              .example = "compute c all cluster/atom 1.5\ncompute drops all chunk/atom c_c compress yes\ncompute "
                         "middle all com/chunk drops"},
    .state_size = sizeof(hs_per_chunk),
    .create = create,
    .destroy = hs_per_chunk_destroy,
    .init = hs_per_chunk_init,
    .array = array,
};
