#include <math.h>

#include "base/memory.h"
#include "style/region.h"

/** The members, borrowed: hs_sim keeps a region for as long as another one refers to it. */
typedef struct members {
    hs_region **region; /**< owned array [n] */
    int n;
} members;

static void destroy(hs_region *region)
{
    members *m = region->state;
    HS_FREE(m->region);
}

/** Bounded when all members are. */
static void set_extent(hs_region *region, const members *m)
{
    region->has_extent = true;
    for (int axis = 0; axis < 3; ++axis) {
        region->extent[axis][0] = HS_REGION_FAR;
        region->extent[axis][1] = -HS_REGION_FAR;
    }
    for (int k = 0; k < m->n; ++k) {
        region->has_extent = region->has_extent && m->region[k]->has_extent;
        for (int axis = 0; axis < 3; ++axis) {
            region->extent[axis][0] = fmin(region->extent[axis][0], m->region[k]->extent[axis][0]);
            region->extent[axis][1] = fmax(region->extent[axis][1], m->region[k]->extent[axis][1]);
        }
    }
}

static hs_status create(hs_region *region, const hs_args *args, hs_error *err)
{
    members *m = region->state;
    int64_t n;
    HS_TRY(hs_arg_int(args, 0, 2, 1000000, &n, err));
    if (args->n != n + 1)
        return hs_fail(err, HS_ERROR_INPUT, "%s: %lld region IDs must follow the number %s, there are %d",
                       args->command, (long long)n, args->word[0], args->n - 1);
    HS_TRY(HS_ALLOC(m->region, (size_t)n, err));
    m->n = (int)n;
    for (int k = 0; k < m->n; ++k) {
        m->region[k] = region->env->find_region(region->env, args->word[k + 1]);
        if (m->region[k] == NULL)
            return hs_fail(err, HS_ERROR_INPUT, "%s: there is no region '%s'; define it before this line",
                           args->command, args->word[k + 1]);
    }
    set_extent(region, m);
    return HS_OK;
}

static bool inside(const hs_region *region, const double x[3])
{
    const members *m = region->state;
    for (int k = 0; k < m->n; ++k)
        if (hs_region_contains(m->region[k], x)) return true;
    return false;
}

static bool uses(const hs_region *region, const hs_region *other)
{
    const members *m = region->state;
    for (int k = 0; k < m->n; ++k)
        if (m->region[k] == other) return true;
    return false;
}

const hs_region_style hs_region_style_union = {
    .about =
        {
            .name = "union",
            .syntax = {"<N> <region-ID> <region-ID> ... [side in|out] [units lattice|box]", 3, -1, NULL},
            .summary = "What lies in at least one of several regions",
            .details =
                "`N` is the number of regions, 2 or more, and is followed by their IDs. Their own `side` counts: a "
                "member "
                "with `side out`\n"
                "adds what lies outside of its shape. A region that is part of a union cannot be deleted before the "
                "union. `units`\n"
                "changes nothing, since a union has no lengths of its own.\n",
            .example = "region both union 2 left right",
        },
    .state_size = sizeof(members),
    .create = create,
    .destroy = destroy,
    .inside = inside,
    .uses = uses,
};
