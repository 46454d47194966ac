/* Adds heat to a group of atoms, or takes it, at constant momentum: velocities relative to the center of mass are scaled so that the
 * kinetic energy grows by the heat.
 * Source: T. Ikeshoji, B. Hafskjold, Mol. Phys. 81, 251 (1994), doi:10.1080/00268979400100171. */
#include <string.h>

#include "base/memory.h"
#include "fix/thermal_motion.h"
#include "style/region.h"

typedef struct heat_state {
    int64_t every;
    double rate;             /**< energy/time */
    char *variable;          /**< owned; equal-style variable that gives the rate; NULL: a constant */
    char *region_id;         /**< owned; NULL: everywhere */
    const hs_region *region; /**< borrowed; found anew before each run */
    double scale;            /**< factor on the velocities, of the latest step it acted */
} heat_state;

static const hs_keyword keywords[] = {
    {"region", 1, "<region-ID>", "only atoms that are in this region at the step"},
    {NULL, 0, NULL, NULL},
};

static hs_status find_region(const hs_fix *fix, hs_error *err)
{
    heat_state *state = fix->state;
    if (state->region_id == NULL) return HS_OK;
    state->region = fix->env->find_region(fix->env, state->region_id);
    if (state->region != NULL) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "fix '%s' (heat): there is no region '%s'", fix->id, state->region_id);
}

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    heat_state *state = fix->state;
    state->scale = 1.0;
    HS_TRY(hs_syntax_check(&fix->style->about.syntax, args, false, err));
    HS_TRY(hs_arg_int(args, 0, 1, INT64_MAX, &state->every, err));
    if (strncmp(args->word[1], "v_", 2) == 0)
        HS_TRY(hs_memory_strdup(&state->variable, args->word[1] + 2, err));
    else
        HS_TRY(hs_arg_double(args, 1, &state->rate, err));
    for (int i = 2; i + 1 < args->n; i += 2) {
        HS_FREE(state->region_id);
        HS_TRY(hs_memory_strdup(&state->region_id, args->word[i + 1], err));
    }
    return find_region(fix, err);
}

static void destroy(hs_fix *fix)
{
    heat_state *state = fix->state;
    HS_FREE(state->variable);
    HS_FREE(state->region_id);
}

static hs_status init(hs_fix *fix, hs_error *err)
{
    const heat_state *state = fix->state;
    const hs_env *env = fix->env;
    const int kind =
        state->variable == NULL || env->variable_kind == NULL ? 0 : env->variable_kind(env->deck, state->variable);
    if (state->variable != NULL && kind != 1)
        return hs_fail(err, HS_ERROR_INPUT, "fix '%s' (heat): the rate needs an equal-style variable, and '%s' is %s",
                       fix->id, state->variable, kind == 0 ? "no variable that has a value" : "of another style");
    return find_region(fix, err);
}

static bool acts(const hs_fix *fix, int i)
{
    const heat_state *state = fix->state;
    const hs_atoms *atoms = fix->env->atoms;
    const double x[3] = {atoms->x[0][i], atoms->x[1][i], atoms->x[2][i]};
    return (atoms->mask[i] & fix->mask) != 0 && (state->region == NULL || hs_region_contains(state->region, x));
}

static hs_status end_of_step(hs_fix *fix, hs_error *err)
{
    heat_state *state = fix->state;
    hs_env *env = fix->env;
    const hs_atoms *atoms = env->atoms;
    thermal_motion motion;
    if (env->step % state->every != 0) return HS_OK;
    if (state->variable != NULL) HS_TRY(env->variable_value(env->deck, state->variable, &state->rate, err));
    const double heat = state->rate * (double)state->every * env->dt / env->units->mvv2e;
    HS_TRY(thermal_find(fix, acts, heat, &motion, err));
    if (!(motion.mass > 0.0)) return HS_OK;
    state->scale = motion.scale;
#pragma omp parallel for schedule(static)
    for (int i = 0; i < atoms->n_local; ++i) {
        if (!acts(fix, i)) continue;
        for (int axis = 0; axis < 3; ++axis)
            atoms->v[axis][i] = state->scale * atoms->v[axis][i] - (state->scale - 1.0) * motion.v[axis];
    }
    hs_env_changed(env);
    return HS_OK;
}

static hs_status scalar(hs_fix *fix, double *value, hs_error *err)
{
    (void)err;
    *value = ((heat_state *)fix->state)->scale;
    return HS_OK;
}

static hs_status keep_state(hs_fix *fix, hs_state *kept, hs_error *err)
{
    return hs_state_double(kept, "scale", &((heat_state *)fix->state)->scale, 1, err);
}

const hs_fix_style hs_fix_style_heat = {
    .about =
        {.name = "heat",
         .syntax = {.usage = "<N> <rate> [region <region-ID>]", .n_min = 2, .n_max = 2, .keywords = keywords},
         .summary = "add heat to atoms, or take it, at constant momentum",
         .details =
             "At multiples of N steps the velocities of the group's atoms (with `region`, of those that are in it at "
             "the step) relative to that of their center of mass are scaled so that their kinetic energy grows by "
             "rate times N timesteps. The rate (energy/time; negative to take heat) is a number or an equal-style "
             "variable `v_name`. Two such fixes, a source and a sink of one strength, make a stationary flow of heat, "
             "whose temperature gradient gives the thermal conductivity; use them with `fix nve`.\n\n"
             "The scalar `f_ID` is the factor on the velocities of the latest step. More heat than the atoms have "
             "cannot be taken: that stops the run.",
         .reference = "T. Ikeshoji, B. Hafskjold, Mol. Phys. 81, 251 (1994), doi:10.1080/00268979400100171",
         .example = "fix hot all heat 1 100.0 region hot\nfix cold all heat 1 -100.0 region cold"},
    .state_size = sizeof(heat_state),
    .create = create,
    .destroy = destroy,
    .init = init,
    .end_of_step = end_of_step,
    .keep_state = keep_state,
    .scalar = scalar,
};
