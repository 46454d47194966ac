#include <math.h>

#include "style/region.h"

typedef struct sphere {
    double center[3], radius; /**< distance */
} sphere;

static bool fit(hs_region *region)
{
    sphere *s = region->state;
    s->radius = region->size[3].value;
    for (int axis = 0; axis < 3; ++axis) {
        s->center[axis] = region->size[axis].value;
        region->extent[axis][0] = s->center[axis] - s->radius;
        region->extent[axis][1] = s->center[axis] + s->radius;
    }
    return s->radius >= 0.0;
}

static hs_status create(hs_region *region, const hs_args *args, hs_error *err)
{
    for (int k = 0; k < 4; ++k) HS_TRY(hs_region_add_size(region, args, k, k % 3, err));
    region->has_extent = true;
    return hs_region_fit(region, args, 3, "a radius of 0 or more", err);
}

static bool inside(const hs_region *region, const double x[3])
{
    const sphere *s = region->state;
    const double dx = x[0] - s->center[0], dy = x[1] - s->center[1], dz = x[2] - s->center[2];
    return sqrt(dx * dx + dy * dy + dz * dz) <= s->radius;
}

static int surfaces(const hs_region *region, const double x[3], double cutoff, hs_contact *contact)
{
    const sphere *s = region->state;
    double d[3] = {x[0] - s->center[0], x[1] - s->center[1], x[2] - s->center[2]};
    const double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    int n = 0;
    if (!(length > 0.0)) return 0; /* at the center every direction is the same: no force */
    for (int axis = 0; axis < 3; ++axis) d[axis] *= (length - s->radius) / length;
    hs_region_touch(d, cutoff, contact, &n);
    return n;
}

const hs_region_style hs_region_style_sphere = {
    .about =
        {
            .name = "sphere",
            .syntax = {"<x> <y> <z> <radius> [keyword value ...]", 4, 4, NULL},
            .summary = "Ball",
            .details = "`x y z` is the center and `radius` the radius, 0 or more. Lengths are in lattice spacings (the "
                       "radius in that of\n"
                       "x), or in distance units after `units box`. The surface belongs to the ball. Each of the four "
                       "can be an equal-style\n"
                       "variable, `v_name`, which is evaluated whenever the region is used.\n",
            .example = "region drop sphere 10 10 10 4.5\nregion hole sphere 0 0 0 2 side out units box\n"
                       "variable r equal ramp(5,3)\nregion bag sphere 0 0 0 v_r units box",
        },
    .state_size = sizeof(sphere),
    .create = create,
    .fit = fit,
    .inside = inside,
    .surfaces = surfaces,
};
