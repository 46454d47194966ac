/* Scales velocities so that a group has a temperature. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "style/compute.h"
#include "style/fix.h"

typedef struct rescale_state {
    int64_t every;
    double t_start, t_stop;
    char *t_variable; /**< owned; equal-style variable that gives the temperature; NULL: the ramp */
    double window, fraction;
    char *temperature_id; /**< owned; compute of fix_modify temp; NULL: the fix's own */
    double energy;        /**< taken from the atoms so far; energy */
} rescale_state;

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    rescale_state *state = fix->state;
    const hs_args none = {.command = args->command};
    HS_TRY(hs_syntax_check(&fix->style->about.syntax, args, false, err));
    HS_TRY(hs_arg_int(args, 0, 1, INT64_MAX, &state->every, err));
    if (strncmp(args->word[1], "v_", 2) == 0)
        HS_TRY(hs_memory_strdup(&state->t_variable, args->word[1] + 2, err));
    else
        HS_TRY(hs_arg_not_negative(args, 1, &state->t_start, err));
    HS_TRY(hs_arg_not_negative(args, 2, &state->t_stop, err));
    HS_TRY(hs_arg_not_negative(args, 3, &state->window, err));
    HS_TRY(hs_arg_not_negative(args, 4, &state->fraction, err));
    if (state->fraction > 1.0) return hs_arg_refuse(args, 4, "a fraction from 0 to 1", NULL, err);
    return hs_fix_own_compute(fix, 0, "temp", "temp", fix->group, &none, err);
}

static void destroy(hs_fix *fix)
{
    rescale_state *state = fix->state;
    HS_FREE(state->t_variable);
    HS_FREE(state->temperature_id);
}

static hs_status set_temperature(hs_fix *fix, const char *id, hs_error *err)
{
    rescale_state *state = fix->state;
    HS_FREE(state->temperature_id);
    return hs_memory_strdup(&state->temperature_id, id, err);
}

static hs_status find_temperature(const hs_fix *fix, hs_compute **temperature, hs_error *err)
{
    const rescale_state *state = fix->state;
    *temperature =
        state->temperature_id != NULL ? fix->env->find_compute(fix->env, state->temperature_id) : fix->own[0];
    if (*temperature != NULL) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "fix '%s' (temp/rescale): there is no compute '%s' any more", fix->id,
                   state->temperature_id);
}

static hs_status init(hs_fix *fix, hs_error *err)
{
    const rescale_state *state = fix->state;
    const hs_env *env = fix->env;
    hs_compute *temperature;
    if (state->t_variable != NULL &&
        (env->variable_kind == NULL || env->variable_kind(env->deck, state->t_variable) != 1))
        return hs_fail(err, HS_ERROR_INPUT, "fix '%s' (temp/rescale): there is no equal-style variable '%s'", fix->id,
                       state->t_variable);
    HS_TRY(find_temperature(fix, &temperature, err));
    return fix->own[0]->style->init(fix->own[0], err);
}

static hs_status target_of(const hs_fix *fix, double *t, hs_error *err)
{
    const rescale_state *state = fix->state;
    const hs_env *env = fix->env;
    *t = state->t_start + hs_env_ramp(env) * (state->t_stop - state->t_start);
    if (state->t_variable != NULL) HS_TRY(env->variable_value(env->deck, state->t_variable, t, err));
    if (*t >= 0.0) return HS_OK;
    return hs_fail(err, HS_ERROR_RUN, "fix '%s' (temp/rescale): the temperature %g is below 0", fix->id, *t);
}

/** The thermal part of each velocity times a factor. */
static void scale(const hs_fix *fix, const hs_compute *temperature, double factor)
{
    const hs_atoms *atoms = fix->env->atoms;
#pragma omp parallel for schedule(static)
    for (int i = 0; i < atoms->n_local; ++i) {
        double bias[3] = {0.0};
        if (!(atoms->mask[i] & fix->mask)) continue;
        if (temperature->style->bias != NULL) temperature->style->bias(temperature, i, bias);
        for (int axis = 0; axis < 3; ++axis) atoms->v[axis][i] = bias[axis] + factor * (atoms->v[axis][i] - bias[axis]);
    }
}

static hs_status end_of_step(hs_fix *fix, hs_error *err)
{
    rescale_state *state = fix->state;
    const hs_env *env = fix->env;
    hs_compute *temperature;
    double t, target;
    if (env->step % state->every != 0) return HS_OK;
    HS_TRY(find_temperature(fix, &temperature, err));
    HS_TRY(hs_compute_scalar(temperature, &t, err));
    HS_TRY(target_of(fix, &target, err));
    if (!(t > 0.0))
        return hs_fail(err, HS_ERROR_RUN, "fix '%s' (temp/rescale): the temperature is 0 and cannot be scaled to %g",
                       fix->id, target);
    if (fabs(t - target) <= state->window) return HS_OK;
    const double next = t - state->fraction * (t - target);
    state->energy += 0.5 * env->units->boltz * temperature->n_dof * (t - next);
    scale(fix, temperature, sqrt(next / t));
    hs_env_changed(fix->env);
    return HS_OK;
}

static hs_status scalar(hs_fix *fix, double *value, hs_error *err)
{
    (void)err;
    *value = ((rescale_state *)fix->state)->energy;
    return HS_OK;
}

static hs_status keep_state(hs_fix *fix, hs_state *kept, hs_error *err)
{
    return hs_state_double(kept, "energy", &((rescale_state *)fix->state)->energy, 1, err);
}

const hs_fix_style hs_fix_style_temp_rescale = {
    .about =
        {.name = "temp/rescale",
         .syntax = {.usage = "<N> <Tstart> <Tstop> <window> <fraction>", .n_min = 5, .n_max = 5},
         .summary = "scale velocities to a temperature",
         .details =
             "At steps that are multiples of N, when the temperature is farther than window from the wanted one, "
             "the velocities of the group are scaled so that the difference is smaller by the fraction (1: it "
             "vanishes). The wanted temperature goes from Tstart to Tstop over the run (or from `run start` to "
             "`run stop`); Tstart may be an equal-style variable `v_name`, which then is the temperature at every "
             "step. The fix moves nothing: use it with `fix nve` or another integrator. It does not give the "
             "canonical ensemble; it serves to bring a system to a temperature.\n\nThe temperature is that of the "
             "group, the compute `ID_temp` that the fix makes, or that of `fix_modify temp`; of a temperature that "
             "leaves out a part of the velocities only the thermal part is scaled. The scalar `f_ID` is the "
             "energy taken from the atoms so far; `fix_modify energy yes` adds it to the potential energy.",
         .example = "fix 1 all temp/rescale 100 1.0 1.1 0.02 0.5\n"
                    "compute t beads temp/partial 0 1 1\nfix 2 beads temp/rescale 1 2.0 2.0 0 1\nfix_modify 2 temp t"},
    .state_size = sizeof(rescale_state),
    .create = create,
    .destroy = destroy,
    .init = init,
    .end_of_step = end_of_step,
    .keep_state = keep_state,
    .set_temperature = set_temperature,
    .scalar = scalar,
    .is_extensive = true,
    .has_energy = true,
    .is_coupling = true,
};
