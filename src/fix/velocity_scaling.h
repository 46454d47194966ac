/** What fixes share that scale a group's velocities towards a temperature: which one is wanted, which compute measures it, and the
 *  energy that the scaling has taken. */
#ifndef HS_FIX_VELOCITY_SCALING_H
#define HS_FIX_VELOCITY_SCALING_H

#include <math.h>

#include "base/memory.h"
#include "fix/bath.h"
#include "style/compute.h"

/** State of such a fix, or its first member. */
typedef struct velocity_scaling {
    bath_ramp bath;
    char *temperature_id; /**< owned; compute of fix_modify temp; NULL: the fix's own */
    double energy;        /**< taken from the atoms so far; energy */
} velocity_scaling;

/** Words i (Tstart or v_name) and i + 1 (Tstop); the compute ID_temp. */
static inline hs_status scaling_create(hs_fix *fix, const hs_args *args, int i, hs_error *err)
{
    velocity_scaling *state = fix->state;
    const hs_args none = {.command = args->command};
    HS_TRY(bath_read(&state->bath, args, i, err));
    return hs_fix_own_compute(fix, 0, "temp", "temp", fix->group, &none, err);
}

static inline void scaling_destroy(hs_fix *fix)
{
    velocity_scaling *state = fix->state;
    hs_varying_fini(&state->bath.start);
    HS_FREE(state->temperature_id);
}

static inline hs_status scaling_set_temperature(hs_fix *fix, const char *id, hs_error *err)
{
    velocity_scaling *state = fix->state;
    return hs_memory_replace(&state->temperature_id, id, err);
}

static inline hs_status scaling_find_temperature(const hs_fix *fix, hs_compute **temperature, hs_error *err)
{
    const velocity_scaling *state = fix->state;
    *temperature = fix->own[0];
    if (state->temperature_id == NULL) return HS_OK;
    return hs_compute_get(fix->env, state->temperature_id, HS_TEMPERATURE, hs_fix_who(fix).text, temperature, err);
}

static inline hs_status scaling_init(hs_fix *fix, hs_error *err)
{
    const velocity_scaling *state = fix->state;
    hs_compute *temperature;
    HS_TRY(hs_varying_check(&state->bath.start, fix, err));
    HS_TRY(scaling_find_temperature(fix, &temperature, err));
    return fix->own[0]->style->init(fix->own[0], err);
}

/** The wanted temperature of this step, and the measured one (collective): above zero, or zero where there is nothing to scale, because
 *  the group has no atoms, or one. */
static inline hs_status scaling_measure(const hs_fix *fix, hs_compute **temperature, double *wanted, double *measured,
                                        hs_error *err)
{
    HS_TRY(scaling_find_temperature(fix, temperature, err));
    HS_TRY(hs_compute_scalar(*temperature, measured, err));
    HS_TRY(bath_now(fix, &((velocity_scaling *)fix->state)->bath, wanted, err));
    if ((*temperature)->n_dof < 1.0) *measured = 0.0;
    if (*measured > 0.0 || (*temperature)->n_dof < 1.0) return HS_OK;
    return hs_fail(err, HS_ERROR_RUN, "%s: the temperature is 0 and cannot be scaled to %g", hs_fix_who(fix).text,
                   *wanted);
}

/** The thermal part of each velocity times a factor, which takes the temperature from one value to another. */
static inline void scaling_apply(hs_fix *fix, const hs_compute *temperature, double from, double to)
{
    velocity_scaling *state = fix->state;
    const hs_atoms *atoms = fix->env->atoms;
    const double factor = sqrt(to / from);
    state->energy += 0.5 * fix->env->units->boltz * temperature->n_dof * (from - to);
#pragma omp parallel for schedule(static)
    for (int i = 0; i < atoms->n_local; ++i) {
        double bias[3] = {0.0};
        if (!(atoms->mask[i] & fix->mask)) continue;
        if (temperature->style->bias != NULL) temperature->style->bias(temperature, i, bias);
        for (int axis = 0; axis < 3; ++axis) atoms->v[axis][i] = bias[axis] + factor * (atoms->v[axis][i] - bias[axis]);
    }
    hs_env_changed(fix->env);
}

static inline hs_status scaling_scalar(hs_fix *fix, double *value, hs_error *err)
{
    (void)err;
    *value = ((velocity_scaling *)fix->state)->energy;
    return HS_OK;
}

static inline hs_status scaling_keep_state(hs_fix *fix, hs_state *kept, hs_error *err)
{
    return hs_state_double(kept, "energy", &((velocity_scaling *)fix->state)->energy, 1, err);
}

/** Hooks that are the same in all. */
#define SCALING_HOOKS                                                                                                  \
    .destroy = scaling_destroy, .init = scaling_init, .keep_state = scaling_keep_state,                                \
    .set_temperature = scaling_set_temperature, .scalar = scaling_scalar, .is_extensive = true, .has_energy = true,    \
    .is_coupling = true

#define SCALING_DETAILS                                                                                                \
    "The wanted temperature goes from Tstart to Tstop over the run (or from `run start` to "                           \
    "`run stop`); Tstart may be an equal-style variable `v_name`, which then is the temperature at every "             \
    "step. The fix moves nothing: use it with `fix nve` or another integrator. It does not give the "                  \
    "canonical ensemble; it serves to bring a system to a temperature.\n\nThe temperature is that of the "             \
    "group, the compute `ID_temp` that the fix makes, or that of `fix_modify temp`; of a temperature that "            \
    "leaves out a part of the velocities only the thermal part is scaled. The scalar `f_ID` is the "                   \
    "energy taken from the atoms so far; `fix_modify energy yes` adds it to the potential energy."

#endif
