#include <math.h>

#include "style/region.h"

typedef struct cone {
    int axis, across[2];      /**< along, and the two axes across in the order of their names */
    double center[2];         /**< distance, along across[] */
    double radius_lo, radius; /**< distance, at the two ends */
    double lo, hi;            /**< distance, along the axis */
} cone;

static hs_status read_radius(const hs_region *region, const hs_args *args, int i, double *radius, hs_error *err)
{
    const cone *c = region->state;
    HS_TRY(hs_region_length(region, args, i, c->across[0], radius, err));
    return *radius >= 0.0 ? HS_OK : hs_arg_refuse(args, i, "a radius of 0 or more", NULL, err);
}

static hs_status create(hs_region *region, const hs_args *args, hs_error *err)
{
    static const char *const axes[] = {"x", "y", "z", NULL};
    static const int across[3][2] = {{1, 2}, {0, 2}, {0, 1}};
    cone *c = region->state;
    HS_TRY(hs_arg_choice(args, 0, axes, &c->axis, err));
    for (int k = 0; k < 2; ++k) {
        c->across[k] = across[c->axis][k];
        HS_TRY(hs_region_length(region, args, 1 + k, c->across[k], &c->center[k], err));
    }
    HS_TRY(read_radius(region, args, 3, &c->radius_lo, err));
    HS_TRY(read_radius(region, args, 4, &c->radius, err));
    if (c->radius_lo == 0.0 && c->radius == 0.0)
        return hs_arg_refuse(args, 4, "greater than 0, as one of both radii must be", NULL, err);
    HS_TRY(hs_region_bound(region, args, 5, c->axis, 0, &c->lo, err));
    HS_TRY(hs_region_bound(region, args, 6, c->axis, 1, &c->hi, err));
    if (c->lo >= c->hi)
        return hs_fail(err, HS_ERROR_INPUT, "%s: the lower end %s is not below the upper end %s", args->command,
                       args->word[5], args->word[6]);
    const double widest = fmax(c->radius_lo, c->radius);
    region->extent[c->axis][0] = c->lo;
    region->extent[c->axis][1] = c->hi;
    for (int k = 0; k < 2; ++k) {
        region->extent[c->across[k]][0] = c->center[k] - widest;
        region->extent[c->across[k]][1] = c->center[k] + widest;
    }
    region->has_extent = true;
    return HS_OK;
}

static bool inside(const hs_region *region, const double x[3])
{
    const cone *c = region->state;
    const double d1 = x[c->across[0]] - c->center[0], d2 = x[c->across[1]] - c->center[1], along = x[c->axis];
    const double radius = c->radius_lo + (along - c->lo) * (c->radius - c->radius_lo) / (c->hi - c->lo);
    return sqrt(d1 * d1 + d2 * d2) <= radius && along >= c->lo && along <= c->hi;
}

const hs_region_style hs_region_style_cone = {
    .about =
        {
            .name = "cone",
            .syntax = {"x|y|z <c1> <c2> <radius-lo> <radius-hi> <lo> <hi> [keyword value ...]", 7, 7, NULL},
            .summary = "Circular cone or frustum along x, y or z, with flat ends",
            .details =
                "`x|y|z` is the axis; `c1 c2` its place in the other two coordinates (y z, x z or x y); the radius "
                "grows evenly from\n"
                "`radius-lo` at the end `lo` to `radius-hi` at the end `hi`; one of both may be 0, a tip. The ends "
                "are lengths, `INF` (1e20) or\n"
                "`EDGE` (the face of the simulation box at the time of the command). Lengths are in lattice spacings "
                "of their axis (the radii: of y\n"
                "for an axis along x, else of x), or in distance units after `units box`. The surface belongs to "
                "the cone, which cannot be a\n"
                "wall (`fix wall/region`).\n",
            .example = "region funnel cone z 10 10 1 6 0 12\nregion tip cone x 0 0 2.5 0 -5 5 units box",
        },
    .state_size = sizeof(cone),
    .create = create,
    .inside = inside,
};
