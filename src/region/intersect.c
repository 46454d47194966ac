#include <math.h>

#include "style/region_members.h"

/** Bounded when at least one member is. */
static void set_extent(hs_region *region, const hs_region_members *m)
{
    region->has_extent = false;
    for (int axis = 0; axis < 3; ++axis) {
        region->extent[axis][0] = -HS_REGION_FAR;
        region->extent[axis][1] = HS_REGION_FAR;
    }
    for (int k = 0; k < m->n; ++k) {
        if (!m->region[k]->has_extent) continue;
        region->has_extent = true;
        for (int axis = 0; axis < 3; ++axis) {
            region->extent[axis][0] = fmax(region->extent[axis][0], m->region[k]->extent[axis][0]);
            region->extent[axis][1] = fmin(region->extent[axis][1], m->region[k]->extent[axis][1]);
        }
    }
}

static hs_status create(hs_region *region, const hs_args *args, hs_error *err)
{
    HS_TRY(hs_region_members_read(region, args, err));
    set_extent(region, region->state);
    return HS_OK;
}

static bool inside(const hs_region *region, const double x[3])
{
    const hs_region_members *m = region->state;
    for (int k = 0; k < m->n; ++k)
        if (!hs_region_contains(m->region[k], x)) return false;
    return true;
}

const hs_region_style hs_region_style_intersect = {
    .about =
        {
            .name = "intersect",
            .syntax = {"<N> <region-ID> <region-ID> ... [keyword value ...]", 3, -1, NULL},
            .summary = "What lies in all of several regions",
            .details = "`N` is the number of regions, 2 or more, and is followed by their IDs. Their own `side` "
                       "counts: a member with `side out`\n"
                       "cuts its shape away. A region that is part of an intersection cannot be deleted before the "
                       "intersection. `units`\n"
                       "changes nothing, since an intersection has no lengths of its own.\n",
            .example = "region shell intersect 2 outer_ball not_inner_ball",
        },
    .state_size = sizeof(hs_region_members),
    .create = create,
    .destroy = hs_region_members_destroy,
    .update = hs_region_members_update,
    .inside = inside,
    .uses = hs_region_members_use,
};
