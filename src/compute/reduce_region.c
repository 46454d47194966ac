/* One number from the values of the atoms of a group that are in a region. */
#include "style/reduction.h"

const hs_compute_style hs_compute_style_reduce_region = {
    .about = {.name = "reduce/region",
              .syntax = {.usage = "<region-ID> <sum | min | max | ave | sumsq | avesq> <input> ... [replace <i> <j>]",
                         .n_min = 3,
                         .n_max = -1,
                         .keywords = hs_reduction_keywords},
              .summary = "sum, mean or extreme of values over the atoms of a group in a region",
              .details = "As compute reduce, over those atoms of the group that are in the region at the step.",
              .example = "region slab block INF INF INF INF 4 5\ncompute f all reduce/region slab ave vx c_k"},
    .state_size = sizeof(hs_reduction),
    .create = hs_reduction_create,
    .destroy = hs_reduction_destroy,
    .init = hs_reduction_init,
    .scalar = hs_reduction_scalar,
    .vector = hs_reduction_vector,
};
