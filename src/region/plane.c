#include "style/region.h"
#include "style/unit_vector.h"

typedef struct plane {
    double point[3];  /**< distance */
    double normal[3]; /**< unit vector into the region */
} plane;

static hs_status create(hs_region *region, const hs_args *args, hs_error *err)
{
    plane *p = region->state;
    for (int axis = 0; axis < 3; ++axis) {
        HS_TRY(hs_region_length(region, args, axis, axis, &p->point[axis], err));
        /* the normal is scaled too, as in LAMMPS: with unequal spacings it is a direction in lattice units */
        HS_TRY(hs_region_length(region, args, 3 + axis, axis, &p->normal[axis], err));
    }
    if (hs_make_unit(p->normal)) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "%s: the normal %s %s %s has no direction", args->command, args->word[3],
                   args->word[4], args->word[5]);
}

static bool inside(const hs_region *region, const double x[3])
{
    const plane *p = region->state;
    const double height =
        (x[0] - p->point[0]) * p->normal[0] + (x[1] - p->point[1]) * p->normal[1] + (x[2] - p->point[2]) * p->normal[2];
    return height >= 0.0;
}

static int surfaces(const hs_region *region, const double x[3], double cutoff, hs_contact *contact)
{
    const plane *p = region->state;
    double height = 0.0, d[3];
    int n = 0;
    for (int axis = 0; axis < 3; ++axis) height += (x[axis] - p->point[axis]) * p->normal[axis];
    for (int axis = 0; axis < 3; ++axis) d[axis] = height * p->normal[axis];
    hs_region_touch(d, cutoff, contact, &n);
    return n;
}

const hs_region_style hs_region_style_plane = {
    .about =
        {
            .name = "plane",
            .syntax = {"<px> <py> <pz> <nx> <ny> <nz> [keyword value ...]", 6, 6, NULL},
            .summary = "Half space on one side of a plane",
            .details =
                "`px py pz` is a point of the plane and `nx ny nz` a normal, of any length but 0, that points into the "
                "region. Both are\n"
                "in lattice spacings, axis by axis, or in distance units after `units box`. The plane belongs to the "
                "region, which\n"
                "has no bounds: it cannot make a box.\n",
            .example = "region upper plane 0 0 5 0 0 1",
        },
    .state_size = sizeof(plane),
    .create = create,
    .inside = inside,
    .surfaces = surfaces,
};
