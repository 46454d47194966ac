#include <math.h>

#include "style/region.h"

typedef struct cylinder {
    int axis, across[2]; /**< along, and the two axes across in the order of their names */
    double center[2];    /**< distance, along across[] */
    double radius;       /**< distance */
    double lo, hi;       /**< distance, along the axis */
} cylinder;

static bool fit(hs_region *region)
{
    cylinder *c = region->state;
    c->radius = region->size[2].value;
    for (int k = 0; k < 2; ++k) {
        c->center[k] = region->size[k].value;
        region->extent[c->across[k]][0] = c->center[k] - c->radius;
        region->extent[c->across[k]][1] = c->center[k] + c->radius;
    }
    return c->radius > 0.0;
}

static hs_status create(hs_region *region, const hs_args *args, hs_error *err)
{
    static const char *const axes[] = {"x", "y", "z", NULL};
    static const int across[3][2] = {{1, 2}, {0, 2}, {0, 1}};
    cylinder *c = region->state;
    HS_TRY(hs_arg_choice(args, 0, axes, &c->axis, err));
    for (int k = 0; k < 2; ++k) c->across[k] = across[c->axis][k];
    for (int k = 0; k < 3; ++k) HS_TRY(hs_region_add_size(region, args, 1 + k, c->across[k % 2], err));
    HS_TRY(hs_region_fit(region, args, 3, "a radius greater than 0", err));
    HS_TRY(hs_region_bound(region, args, 4, c->axis, 0, &c->lo, err));
    HS_TRY(hs_region_bound(region, args, 5, c->axis, 1, &c->hi, err));
    if (c->lo > c->hi)
        return hs_fail(err, HS_ERROR_INPUT, "%s: the lower end %s is above the upper end %s", args->command,
                       args->word[4], args->word[5]);
    region->extent[c->axis][0] = c->lo;
    region->extent[c->axis][1] = c->hi;
    region->has_extent = true;
    return HS_OK;
}

static bool inside(const hs_region *region, const double x[3])
{
    const cylinder *c = region->state;
    const double d1 = x[c->across[0]] - c->center[0], d2 = x[c->across[1]] - c->center[1];
    return sqrt(d1 * d1 + d2 * d2) <= c->radius && x[c->axis] >= c->lo && x[c->axis] <= c->hi;
}

/** Inside the mantle and the ends within reach, outside the nearest point of the cylinder. */
static int surfaces(const hs_region *region, const double x[3], double cutoff, hs_contact *contact)
{
    const cylinder *c = region->state;
    const bool is_closed = region->env->box->dimension == 3 || c->axis != 2;
    const double d1 = x[c->across[0]] - c->center[0], d2 = x[c->across[1]] - c->center[1],
                 radius = sqrt(d1 * d1 + d2 * d2);
    const double below = x[c->axis] - c->lo, above = x[c->axis] - c->hi;
    double d[3] = {0.0};
    int n = 0;
    if (radius > 0.0 && (!region->is_outside || radius > c->radius)) {
        d[c->across[0]] = d1 * (radius - c->radius) / radius;
        d[c->across[1]] = d2 * (radius - c->radius) / radius;
    }
    if (region->is_outside) {
        if (is_closed) d[c->axis] = below < 0.0 ? below : above > 0.0 ? above : 0.0;
        hs_region_touch(d, cutoff, contact, &n);
        return n;
    }
    if (radius > 0.0) hs_region_touch(d, cutoff, contact, &n); /* on the axis the mantle pushes to no side */
    for (int end = 0; end < 2 && is_closed; ++end) {
        double along[3] = {0.0};
        along[c->axis] = end == 0 ? below : above;
        hs_region_touch(along, cutoff, contact, &n);
    }
    return n;
}

const hs_region_style hs_region_style_cylinder = {
    .about =
        {
            .name = "cylinder",
            .syntax = {"x|y|z <c1> <c2> <radius> <lo> <hi> [keyword value ...]", 6, 6, NULL},
            .summary = "Circular cylinder along x, y or z, with flat ends",
            .details = "`x|y|z` is the axis; `c1 c2` its place in the other two coordinates (y z, x z or x y); "
                       "`radius` is greater than 0;\n"
                       "`lo hi` are the ends: lengths, `INF` (1e20) or `EDGE` (the face of the simulation box at the "
                       "time of the command).\n"
                       "Lengths are in lattice spacings of their axis (the radius: of y for an axis along x, else of "
                       "x), or in distance\n"
                       "units after `units box`. The surface belongs to the cylinder. Center and radius can be "
                       "equal-style\n"
                       "variables, `v_name`, which are evaluated whenever the region is used.\n",
            .example = "region pore cylinder z 10 10 4 INF INF\nregion rod cylinder x 0 0 2.5 -5 5 units box",
        },
    .state_size = sizeof(cylinder),
    .create = create,
    .fit = fit,
    .inside = inside,
    .surfaces = surfaces,
};
