/* Adds heat to a group of atoms, or takes it, at constant momentum: velocities relative to the center of mass are
 * scaled so that the kinetic energy grows by the heat.
 * Source: T. Ikeshoji, B. Hafskjold, Mol. Phys. 81, 251 (1994), doi:10.1080/00268979400100171. */
#include "fix/thermal_motion.h"

static const hs_keyword keywords[] = {
    {"region", 1, "<region-ID>", "only atoms that are in this region at the step"},
    {NULL, 0, NULL, NULL},
};

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    thermal_state *state = fix->state;
    state->scale = 1.0;
    HS_TRY(hs_syntax_check(&fix->style->about.syntax, args, false, err));
    HS_TRY(hs_arg_int(args, 0, 1, INT64_MAX, &state->every, err));
    HS_TRY(hs_varying_read(&state->rate, args, 1, err));
    for (int i = 2; i + 1 < args->n; i += 2) HS_TRY(hs_where_set(&state->where, args->word[i + 1], err));
    return thermal_find_region(fix, err);
}

static bool acts(const hs_fix *fix, int i)
{
    const hs_atoms *atoms = fix->env->atoms;
    return (atoms->mask[i] & fix->mask) != 0 && hs_where_has(&((const thermal_state *)fix->state)->where, atoms, i);
}

static hs_status end_of_step(hs_fix *fix, hs_error *err)
{
    thermal_state *state = fix->state;
    hs_env *env = fix->env;
    const hs_atoms *atoms = env->atoms;
    thermal_motion motion;
    if (env->step % state->every != 0) return HS_OK;
    HS_TRY(hs_varying_update(&state->rate, env, err));
    const double heat = state->rate.value * (double)state->every * env->dt / env->units->mvv2e;
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

const hs_fix_style hs_fix_style_heat = {
    .about =
        {.name = "heat",
         .syntax = {.usage = "<N> <rate> [region <region-ID>]", .n_min = 2, .n_max = 2, .keywords = keywords},
         .summary = "add heat to atoms, or take it, at constant momentum",
         .details =
             "At multiples of N steps the velocities of the group's atoms (with `region`, of those that are in it at "
             "the step) relative to that of their center of mass are scaled so that their kinetic energy grows by rate "
             "times N timesteps. The rate (energy/time; negative to take heat) is a number or an equal-style variable "
             "`v_name`. Two such fixes, a source and a sink of one strength, make a stationary flow of heat, whose "
             "temperature gradient gives the thermal conductivity; use them with `fix nve`.\n\n"
             "The scalar `f_ID` is the factor on the velocities of the latest step. More heat than the atoms have "
             "cannot be taken: that stops the run.",
         .reference = "T. Ikeshoji, B. Hafskjold, Mol. Phys. 81, 251 (1994), doi:10.1080/00268979400100171",
         .example = "fix hot all heat 1 100.0 region hot\nfix cold all heat 1 -100.0 region cold"},
    .state_size = sizeof(thermal_state),
    .create = create,
    .end_of_step = end_of_step,
    THERMAL_HOOKS,
    .allows_dynamic_group = true,
};
