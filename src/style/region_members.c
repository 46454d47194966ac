#include "style/region_members.h"

#include "base/memory.h"

hs_status hs_region_members_read(hs_region *region, const hs_args *args, hs_error *err)
{
    hs_region_members *m = region->state;
    int64_t n;
    HS_TRY(hs_arg_int(args, 0, 2, 1000000, &n, err));
    if (args->n != n + 1)
        return hs_fail(err, HS_ERROR_INPUT, "%s: %lld region IDs must follow the number %s, there are %d",
                       args->command, (long long)n, args->word[0], args->n - 1);
    HS_TRY(HS_ALLOC(m->region, (size_t)n, err));
    m->n = (int)n;
    for (int k = 0; k < m->n; ++k) {
        m->region[k] = region->env->find_region(region->env, args->word[k + 1]);
        if (m->region[k] != NULL) region->is_varying = region->is_varying || m->region[k]->is_varying;
        if (m->region[k] == NULL)
            return hs_fail(err, HS_ERROR_INPUT, "%s: there is no region '%s'; define it before this line",
                           args->command, args->word[k + 1]);
    }
    return HS_OK;
}

void hs_region_members_destroy(hs_region *region)
{
    hs_region_members *m = region->state;
    HS_FREE(m->region);
}

bool hs_region_members_use(const hs_region *region, const hs_region *other)
{
    const hs_region_members *m = region->state;
    for (int k = 0; k < m->n; ++k)
        if (m->region[k] == other) return true;
    return false;
}

hs_status hs_region_members_update(hs_region *region, hs_error *err)
{
    const hs_region_members *m = region->state;
    for (int k = 0; k < m->n; ++k) HS_TRY(hs_region_update(m->region[k], err));
    return HS_OK;
}
