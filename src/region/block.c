#include "style/region.h"

/** Bounds are the region's extent: nothing else to keep. */
static hs_status create(hs_region *region, const hs_args *args, hs_error *err)
{
    for (int axis = 0; axis < 3; ++axis) {
        for (int end = 0; end < 2; ++end)
            HS_TRY(hs_region_bound(region, args, 2 * axis + end, axis, end, &region->extent[axis][end], err));
        if (region->extent[axis][0] > region->extent[axis][1])
            return hs_fail(err, HS_ERROR_INPUT, "%s: the lower bound of %c, %s, is above the upper one, %s",
                           args->command, "xyz"[axis], args -> word[2 * axis], args -> word[2 * axis + 1]);
    }
    region->has_extent = true;
    return HS_OK;
}

static bool inside(const hs_region *region, const double x[3])
{
    for (int axis = 0; axis < 3; ++axis)
        if (!(x[axis] >= region->extent[axis][0] && x[axis] <= region->extent[axis][1])) return false;
    return true;
}

/** Inside every face within reach, outside the nearest point of the block. */
static int surfaces(const hs_region *region, const double x[3], double cutoff, hs_contact *contact)
{
    const int dimension = region->env->box->dimension;
    double outside[3] = {0.0};
    int n = 0;
    for (int axis = 0; axis < dimension; ++axis) {
        for (int end = 0; end < 2; ++end) {
            double d[3] = {0.0};
            d[axis] = x[axis] - region->extent[axis][end];
            if (region->is_outside && (end == 0 ? d[axis] < 0.0 : d[axis] > 0.0)) outside[axis] = d[axis];
            if (!region->is_outside) hs_region_touch(d, cutoff, contact, &n);
        }
    }
    if (region->is_outside) hs_region_touch(outside, cutoff, contact, &n);
    return n;
}

const hs_region_style hs_region_style_block = {
    .about =
        {
            .name = "block",
            .syntax = {"<xlo> <xhi> <ylo> <yhi> <zlo> <zhi> [keyword value ...]", 6, 6, NULL},
            .summary = "Box with faces across x, y and z",
            .details = "`xlo xhi ylo yhi zlo zhi` are the bounds, each a length, `INF` (1e20, beyond any atom) or "
                       "`EDGE` (the face of the\n"
                       "simulation box at the time of the command). `INF` and `EDGE` need a box. Lengths are in "
                       "lattice spacings of their\n"
                       "axis, or in distance units after `units box`. The faces belong to the block.\n",
            .example = "region box block 0 20 0 20 0 20\nregion left block INF 5.0 INF INF INF INF units box",
        },
    .create = create,
    .inside = inside,
    .surfaces = surfaces,
};
