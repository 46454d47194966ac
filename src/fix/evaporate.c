/* Removes atoms while a simulation runs: random ones of those in a region, such as the vapour over a film that dries. */
#include <stdlib.h>

#include "base/memory.h"
#include "style/fix.h"
#include "style/region.h"

typedef struct evaporate_state {
    int64_t every, n_at_once; /**< steps; atoms */
    hs_where where;
    hs_noise noise;
    int64_t n_removed, next; /**< atoms so far; step */
} evaporate_state;

/** An atom that may go; those with the smallest draws do. */
typedef struct candidate {
    uint64_t draw;
    int64_t id;
    int i; /**< local atom */
} candidate;

static const hs_keyword keywords[] = {
    {"molecule", 1, "no", "atoms go one by one: they belong to no molecules"},
    {NULL, 0, NULL, NULL},
};

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    evaporate_state *state = fix->state;
    int64_t seed;
    HS_TRY(hs_arg_int(args, 0, 1, INT64_MAX, &state->every, err));
    HS_TRY(hs_arg_int(args, 1, 1, INT64_MAX, &state->n_at_once, err));
    HS_TRY(hs_where_set(&state->where, args->word[2], err));
    HS_TRY(hs_arg_int(args, 3, 1, INT64_MAX, &seed, err));
    HS_TRY(hs_fix_noise(fix, seed, &state->noise, err));
    return hs_where_find(&state->where, fix->env, hs_fix_who(fix).text, err);
}

static void destroy(hs_fix *fix) { hs_where_fini(&((evaporate_state *)fix->state)->where); }

static hs_status init(hs_fix *fix, hs_error *err)
{
    evaporate_state *state = fix->state;
    state->next = (fix->env->step / state->every + 1) * state->every;
    return hs_where_find(&state->where, fix->env, hs_fix_who(fix).text, err);
}

static int64_t next_exchange(const hs_fix *fix) { return ((const evaporate_state *)fix->state)->next; }

static int by_draw(const void *a, const void *b)
{
    const candidate *p = a, *q = b;
    if (p->draw != q->draw) return p->draw < q->draw ? -1 : 1;
    return (p->id > q->id) - (p->id < q->id);
}

/** This rank's candidates, the first to go first. */
static hs_status find_candidates(const hs_fix *fix, candidate **found, int *n_found, hs_error *err)
{
    const evaporate_state *state = fix->state;
    const hs_atoms *atoms = fix->env->atoms;
    candidate *list;
    int n = 0;
    HS_TRY(hs_where_update(&state->where, err));
    HS_TRY(HS_ALLOC(list, (size_t)atoms->n_local + 1, err));
    for (int i = 0; i < atoms->n_local; ++i) {
        uint32_t word[HS_NOISE_NUMBERS];
        if (!(atoms->mask[i] & fix->mask) || !hs_where_has(&state->where, atoms, i)) continue;
        hs_noise_words(state->noise, hs_fix_clock(fix), 0, atoms->id[i], word);
        /* 62 bits, so that ranks can compare their negatives */
        list[n++] = (candidate){(uint64_t)(word[0] >> 1) << 31 | word[1] >> 1, atoms->id[i], i};
    }
    qsort(list, (size_t)n, sizeof *list, by_draw);
    *found = list;
    *n_found = n;
    return HS_OK;
}

/** Mark those that go, the same ones on any number of ranks; *n_gone counts those of all (collective). */
static void choose(const hs_fix *fix, const candidate *list, int n, unsigned char *drop, int64_t *n_gone)
{
    const evaporate_state *state = fix->state;
    const hs_parallel *parallel = fix->env->parallel;
    int next = 0;
    for (*n_gone = 0; *n_gone < state->n_at_once; ++*n_gone) {
        int64_t draw = next < n ? -(int64_t)list[next].draw : INT64_MIN;
        const int64_t mine = draw;
        hs_parallel_max_int64(parallel, &draw, 1);
        if (draw == INT64_MIN) return;
        int64_t id = mine == draw ? -list[next].id : INT64_MIN;
        hs_parallel_max_int64(parallel, &id, 1);
        if (mine == draw && list[next].id == -id) drop[list[next++].i] = 1;
    }
}

static hs_status pre_exchange(hs_fix *fix, hs_error *err)
{
    evaporate_state *state = fix->state;
    hs_atoms *atoms = fix->env->atoms;
    candidate *list = NULL;
    unsigned char *drop = NULL;
    int n = 0;
    int64_t n_gone = 0;
    if (fix->env->step != state->next) return HS_OK;
    state->next += state->every;
    HS_UNLESS_FAILED(err, HS_ALLOC(drop, (size_t)atoms->n_local + 1, err));
    HS_UNLESS_FAILED(err, find_candidates(fix, &list, &n, err));
    const hs_status status = hs_parallel_agree(fix->env->parallel, err);
    if (status == HS_OK) {
        choose(fix, list, n, drop, &n_gone);
        hs_atoms_remove(atoms, drop);
        atoms->n_all -= n_gone;
        state->n_removed += n_gone;
        hs_env_changed(fix->env);
    }
    HS_FREE(list);
    HS_FREE(drop);
    return status;
}

static hs_status scalar(hs_fix *fix, double *value, hs_error *err)
{
    (void)err;
    *value = (double)((const evaporate_state *)fix->state)->n_removed;
    return HS_OK;
}

static hs_status keep_state(hs_fix *fix, hs_state *kept, hs_error *err)
{
    evaporate_state *state = fix->state;
    HS_TRY(hs_state_int64(kept, "removed", &state->n_removed, 1, err));
    return hs_state_int64(kept, "next", &state->next, 1, err);
}

const hs_fix_style hs_fix_style_evaporate = {
    .about = {.name = "evaporate",
              .syntax = {.usage = "<N> <M> <region-ID> <seed> [keyword value ...]",
                         .n_min = 4,
                         .n_max = 4,
                         .keywords = keywords},
              .summary = "remove random atoms from a region",
              .details =
                  "At steps that are multiples of N, up to M atoms of the group that are in the region are removed, "
                  "chosen at random: the same ones on any number of ranks. LAMMPS with the same seed removes "
                  "others.\n\n"
                  "The scalar `f_ID` is the number of atoms removed. Temperatures of groups that shrink need "
                  "`compute_modify dynamic/dof yes`.",
              .example = "region vapour block INF INF INF INF 17 20\nfix dry all evaporate 100 5 vapour 38277\n"
                         "compute_modify thermo_temp dynamic/dof yes"},
    .state_size = sizeof(evaporate_state),
    .create = create,
    .destroy = destroy,
    .init = init,
    .next_exchange = next_exchange,
    .pre_exchange = pre_exchange,
    .keep_state = keep_state,
    .scalar = scalar,
    .is_time_dependent = true,
    .allows_dynamic_group = true,
    .keeps_plane = true,
};
