#include "deck/set_types.h"

#include <string.h>

#include "base/memory.h"
#include "core/random.h"
#include "deck/by_id.h"
#include "deck/marsaglia.h"
#include "deck/subset.h"

/** Atoms that `set` was said for. */
typedef struct chosen {
    hs_sim *sim;
    const unsigned char *flag; /**< [n_local] */
    int64_t n_all;             /**< on all ranks */
} chosen;

/** type/fraction: each atom draws for itself, from its place. *n is the number changed here. */
static hs_status set_fraction(const chosen *s, const hs_args *args, int i, int type, int64_t *n, hs_error *err)
{
    hs_atoms *atoms = &s->sim->atoms;
    double fraction;
    int64_t seed;
    HS_TRY(hs_arg_double(args, i + 2, &fraction, err));
    if (!(fraction >= 0.0 && fraction <= 1.0)) return hs_arg_refuse(args, i + 2, "a fraction from 0 to 1", NULL, err);
    HS_TRY(hs_arg_int(args, i + 3, 1, INT32_MAX - 1, &seed, err));
    for (int k = 0; k < atoms->n_local; ++k) {
        if (!s->flag[k]) continue;
        const double x[3] = {atoms->x[0][k], atoms->x[1][k], atoms->x[2][k]};
        hs_park park;
        hs_park_reset_at(&park, (int)seed, x);
        if (hs_park_uniform(&park) > fraction) continue;
        atoms->type[k] = type;
        ++*n;
    }
    return HS_OK;
}

/** Give the type to the local atoms among ids[n] that are marked. Both are in the order of IDs. */
static hs_status set_marked(const chosen *s, const int64_t *ids, const unsigned char *mark, int64_t n_ids, int type,
                            int64_t *n, hs_error *err)
{
    hs_atoms *atoms = &s->sim->atoms;
    int32_t *order;
    HS_TRY(hs_by_id_order(atoms, &order, err));
    int64_t m = 0;
    for (int k = 0; k < atoms->n_local; ++k) {
        while (m < n_ids && ids[m] < atoms->id[order[k]]) ++m;
        if (m == n_ids) break;
        if (ids[m] != atoms->id[order[k]] || !mark[m]) continue;
        atoms->type[order[k]] = type;
        ++*n;
    }
    HS_FREE(order);
    return HS_OK;
}

/** type/ratio and type/subset: an exact number of atoms. */
static hs_status set_exact(const chosen *s, const hs_args *args, int i, int type, int64_t *n, hs_error *err)
{
    int64_t n_wanted, seed, n_ids, *ids = NULL;
    double fraction;
    unsigned char *mark = NULL;
    if (strcmp(args->word[i], "type/ratio") == 0) {
        HS_TRY(hs_arg_double(args, i + 2, &fraction, err));
        if (!(fraction >= 0.0 && fraction <= 1.0))
            return hs_arg_refuse(args, i + 2, "a fraction from 0 to 1", NULL, err);
        n_wanted = (int64_t)(fraction * (double)s->n_all);
    } else {
        HS_TRY(hs_arg_int(args, i + 2, 0, INT64_MAX, &n_wanted, err));
        if (n_wanted > s->n_all)
            return hs_fail(err, HS_ERROR_INPUT, "set: a subset of %lld atoms is wanted, but only %lld are selected",
                           (long long)n_wanted, (long long)s->n_all);
    }
    HS_TRY(hs_arg_int(args, i + 3, 1, HS_MARSAGLIA_SEED_MAX, &seed, err));
    hs_status status = hs_by_id_members(s->sim, s->flag, &ids, &n_ids, err);
    if (status == HS_OK) status = HS_ALLOC(mark, (size_t)n_ids, err);
    if (status == HS_OK) status = hs_subset_select(mark, n_ids, n_wanted, (int)seed, err);
    if (status == HS_OK) status = set_marked(s, ids, mark, n_ids, type, n, err);
    HS_FREE(mark);
    HS_FREE(ids);
    return status;
}

hs_status hs_set_random_types(hs_sim *sim, const unsigned char *flag, int64_t n_all, const hs_args *args, int i,
                              int type, int64_t *n, hs_error *err)
{
    const chosen s = {.sim = sim, .flag = flag, .n_all = n_all};
    *n = 0;
    return (strcmp(args->word[i], "type/fraction") == 0 ? set_fraction : set_exact)(&s, args, i, type, n, err);
}
