/* Atoms in a region move one way only: velocities against it are turned round. */
#include "style/fix.h"
#include "style/region.h"

typedef struct oneway_state {
    int64_t every;
    hs_where where;
    int axis;
    double sign; /**< of the velocities that are left */
} oneway_state;

static hs_status find_region(hs_fix *fix, hs_error *err)
{
    oneway_state *state = fix->state;
    return hs_where_find(&state->where, fix->env, hs_fix_who(fix).text, err);
}

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    static const char *const directions[] = {"x", "y", "z", "-x", "-y", "-z", NULL};
    oneway_state *state = fix->state;
    int direction;
    HS_TRY(hs_syntax_check(&fix->style->about.syntax, args, false, err));
    HS_TRY(hs_arg_int(args, 0, 1, INT64_MAX, &state->every, err));
    HS_TRY(hs_where_set(&state->where, args->word[1], err));
    HS_TRY(find_region(fix, err));
    HS_TRY(hs_arg_choice(args, 2, directions, &direction, err));
    state->axis = direction % 3;
    state->sign = direction < 3 ? 1.0 : -1.0;
    return HS_OK;
}

static void destroy(hs_fix *fix) { hs_where_fini(&((oneway_state *)fix->state)->where); }

static void turn_round(const hs_fix *fix)
{
    const oneway_state *state = fix->state;
    const hs_atoms *atoms = fix->env->atoms;
    double *v = atoms->v[state->axis];
#pragma omp for schedule(static) nowait
    for (int i = 0; i < atoms->n_local; ++i)
        if (atoms->mask[i] & fix->mask && v[i] * state->sign < 0.0 && hs_where_has(&state->where, atoms, i))
            v[i] = -v[i];
}

static hs_status end_of_step(hs_fix *fix, hs_error *err)
{
    const oneway_state *state = fix->state;
    if (fix->env->step % state->every != 0) return HS_OK;
    HS_TRY(find_region(fix, err));
    HS_TRY(hs_where_update(&state->where, err));
    HS_ON_THREADS(turn_round(fix));
    hs_env_changed(fix->env);
    return HS_OK;
}

const hs_fix_style hs_fix_style_oneway = {
    .about = {.name = "oneway",
              .syntax = {.usage = "<N> <region-ID> x|y|z|-x|-y|-z", .n_min = 3, .n_max = 3},
              .summary = "atoms in a region move one way only",
              .details =
                  "At the end of every step that is a multiple of N, atoms of the group that are in the region and "
                  "move against the direction have that component of their velocity turned round, which keeps "
                  "their energy but not their momentum: a membrane that lets pass one way, or Maxwell's demon.",
              .example = "region gate block INF INF INF INF 9 11\nfix demon all oneway 10 gate -z"},
    .state_size = sizeof(oneway_state),
    .create = create,
    .destroy = destroy,
    .init = find_region,
    .end_of_step = end_of_step,
    .allows_dynamic_group = true,
    .keeps_plane = true,
};
