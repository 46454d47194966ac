#include "style/nose_hoover.h"

#include <math.h>
#include <string.h>

#include "style/box_flow.h"
#include "style/box_shape.h"
#include "style/nose_hoover_internal.h"

/* Making it */

static hs_status create_computes(hs_fix *fix, hs_error *err)
{
    const hs_nose_hoover *nh = fix->state;
    const hs_args none = {.command = "fix"};
    const char *temperature = nh->is_sllod ? "temp/deform" : nh->spheres.has_rotation ? "temp/sphere" : "temp";
    if (nh->has_barostat) return hs_barometer_create(fix, temperature, false, err);
    return hs_fix_own_compute(fix, HS_OWN_TEMPERATURE, temperature, "temp", fix->group, &none, err);
}

hs_status hs_nose_hoover_create(hs_fix *fix, const hs_args *args, bool has_thermostat, bool has_barostat, hs_error *err)
{
    hs_nose_hoover *nh = fix->state;
    HS_TRY(hs_syntax_check(&fix->style->about.syntax, args, false, err));
    nh->has_thermostat = has_thermostat;
    nh->has_barostat = has_barostat;
    HS_TRY(hs_nose_hoover_read(fix, args, err));
    if (nh->spheres.has_rotation) HS_TRY(hs_spheres_check_style(&nh->spheres, fix, args, err));
    if (!has_thermostat) nh->chain.n = 0;
    if (!has_barostat) nh->barostat_chain.n = 0;
    HS_TRY(hs_nh_chain_create(&nh->chain, err));
    HS_TRY(hs_nh_chain_create(&nh->barostat_chain, err));
    fix->n_vector = hs_nose_hoover_n_vector(nh);
    return create_computes(fix, err);
}

void hs_nose_hoover_destroy(hs_fix *fix)
{
    hs_nose_hoover *nh = fix->state;
    hs_nh_chain_destroy(&nh->chain);
    hs_nh_chain_destroy(&nh->barostat_chain);
    hs_barometer_fini(&nh->barometer);
}

hs_status hs_nose_hoover_set_temperature(hs_fix *fix, const char *id, hs_error *err)
{
    return hs_barometer_set_temperature(fix, &((hs_nose_hoover *)fix->state)->barometer, id, err);
}

hs_status hs_nose_hoover_set_pressure(hs_fix *fix, const char *id, hs_error *err)
{
    return hs_barometer_set_pressure(&((hs_nose_hoover *)fix->state)->barometer, id, err);
}

hs_status hs_nose_hoover_take_dt(hs_fix *fix, hs_error *err)
{
    hs_nose_hoover *nh = fix->state;
    double p_rate = 0.0;
    (void)err;
    nh->dt = fix->env->dt;
    for (int k = 0; k < HS_NH_COMPONENTS; ++k) p_rate = fmax(p_rate, nh->p_rate[k]);
    nh->chain.drag = 1.0 - nh->dt * nh->t_rate * nh->drag / nh->chain.n_loops;
    nh->barostat_chain.drag = 1.0 - nh->dt * p_rate * nh->drag / nh->barostat_chain.n_loops;
    return HS_OK;
}

/** Fail where fix deform changes what the barostat does. */
static hs_status check_deform(const hs_fix *fix, hs_error *err)
{
    const hs_nose_hoover *nh = fix->state;
    const hs_box_flow *flow = fix->env->box_flow;
    for (int k = 0; k < 3 && flow != NULL; ++k) {
        if (nh->moves[k] && flow->sets_length[k])
            return hs_fail(err, HS_ERROR_INPUT,
                           "%s: the length in %c is what fix deform makes it, and cannot follow a pressure, too",
                           hs_fix_who(fix).text, "xyz"[k]);
        if (nh->moves[HS_NH_XY + k] && flow->sets_tilt[k])
            return hs_fail(err, HS_ERROR_INPUT,
                           "%s: the tilt %s is what fix deform makes it, and cannot follow a pressure, too",
                           hs_fix_who(fix).text, hs_tilt_names[k]);
    }
    return HS_OK;
}

hs_status hs_nose_hoover_init(hs_fix *fix, hs_error *err)
{
    hs_nose_hoover *nh = fix->state;
    hs_compute *temperature;
    HS_TRY(hs_barometer_temperature(fix, &nh->barometer, &temperature, err));
    if (nh->spheres.has_rotation) HS_TRY(hs_spheres_check(fix, err));
    if (nh->is_sllod && temperature->style->bias == NULL)
        return hs_fail(err, HS_ERROR_INPUT,
                       "%s: the temperature '%s' takes no flow off the velocities; compute temp/deform does",
                       hs_fix_who(fix).text, temperature->id);
    HS_TRY(check_deform(fix, err));
    HS_TRY(hs_barometer_init(fix, &nh->barometer, err));
    if (!nh->has_reference) hs_nose_hoover_set_reference(nh, fix->env->box);
    return hs_nose_hoover_take_dt(fix, err);
}

/* Targets and measurements */

static void find_target_temperature(const hs_fix *fix)
{
    hs_nose_hoover *nh = fix->state;
    nh->t_target = nh->t_start + hs_env_ramp(fix->env) * (nh->t_stop - nh->t_start);
    nh->kinetic_target = nh->n_dof * fix->env->units->boltz * nh->t_target;
}

static hs_status measure_temperature(const hs_fix *fix, hs_error *err)
{
    hs_nose_hoover *nh = fix->state;
    hs_compute *temperature;
    HS_TRY(hs_barometer_temperature(fix, &nh->barometer, &temperature, err));
    HS_TRY(hs_compute_scalar(temperature, &nh->t_now, err));
    nh->n_dof = temperature->n_dof;
    return HS_OK;
}

/** Masses that give the chain its frequency at the present target. */
static void set_chain_masses(hs_nose_hoover *nh, const hs_env *env)
{
    const double kt = env->units->boltz * nh->t_target;
    for (int k = 0; k < nh->chain.n; ++k)
        nh->chain.mass[k] = (k == 0 ? nh->n_dof : 1.0) * kt / (nh->t_rate * nh->t_rate);
}

hs_status hs_nose_hoover_setup(hs_fix *fix, hs_error *err)
{
    hs_nose_hoover *nh = fix->state;
    const hs_env *env = fix->env;
    HS_TRY(measure_temperature(fix, err));
    if (nh->has_thermostat) {
        find_target_temperature(fix);
    } else {
        if (nh->t_fixed == 0.0)
            nh->t_fixed = nh->t_now > 1e-6 ? nh->t_now : strcmp(env->units->name, "lj") == 0 ? 1.0 : 300.0;
        nh->t_target = nh->t_fixed;
    }
    if (nh->has_barostat) {
        hs_nose_hoover_find_targets(fix);
        HS_TRY(hs_nose_hoover_measure_pressure(fix, err));
    }
    set_chain_masses(nh, env);
    hs_nose_hoover_set_barostat_masses(nh, env);
    hs_nh_chain_force(&nh->chain, env->units->boltz * nh->t_target);
    hs_nh_chain_force(&nh->barostat_chain, env->units->boltz * nh->t_target);
    return HS_OK;
}

/* Parts of a step */

/** The chain acts on the atoms. */
static hs_status advance_thermostat(const hs_fix *fix, hs_error *err)
{
    hs_nose_hoover *nh = fix->state;
    const double k = fix->env->units->boltz;
    nh->chain.mass[0] = nh->n_dof * k * nh->t_target / (nh->t_rate * nh->t_rate);
    for (int link = 1; link < nh->chain.n; ++link) nh->chain.mass[link] = k * nh->t_target / (nh->t_rate * nh->t_rate);
    const double s =
        hs_nh_chain_advance(&nh->chain, k * nh->t_target, nh->kinetic_target, nh->n_dof * k * nh->t_now, nh->dt);
    nh->t_now *= s * s;
    hs_compute *temperature;
    HS_TRY(hs_barometer_temperature(fix, &nh->barometer, &temperature, err));
    if (nh->is_sllod)
        hs_nose_hoover_flow(fix, temperature != fix->own[HS_OWN_TEMPERATURE] ? temperature : NULL, s);
    else
        hs_nose_hoover_scale(fix, temperature, (const double[3]){s, s, s});
    if (nh->spheres.has_rotation) hs_spheres_scale(fix, s);
    return HS_OK;
}

hs_status hs_nose_hoover_initial_integrate(hs_fix *fix, hs_error *err)
{
    hs_nose_hoover *nh = fix->state;
    if (nh->has_barostat) hs_nose_hoover_advance_barostat_chain(fix);
    if (nh->has_thermostat) {
        find_target_temperature(fix);
        HS_TRY(advance_thermostat(fix, err));
    }
    if (nh->has_barostat) {
        HS_TRY(hs_nose_hoover_measure_pressure(fix, err));
        hs_nose_hoover_find_targets(fix);
        HS_TRY(hs_nose_hoover_kick_barostat(fix, err));
        HS_TRY(hs_nose_hoover_strain_velocities(fix, err));
    }
    hs_nose_hoover_kick(fix);
    if (nh->has_barostat) hs_nose_hoover_strain_box(fix);
    hs_nose_hoover_drift(fix);
    if (nh->has_barostat) hs_nose_hoover_strain_box(fix);
    return HS_OK;
}

hs_status hs_nose_hoover_final_integrate(hs_fix *fix, hs_error *err)
{
    hs_nose_hoover *nh = fix->state;
    hs_nose_hoover_kick(fix);
    if (nh->has_barostat) {
        /* LAMMPS's order: the bias is that of the step's first half, but for steps with new lists */
        if (fix->env->has_new_lists) HS_TRY(measure_temperature(fix, err));
        HS_TRY(hs_nose_hoover_strain_velocities(fix, err));
    }
    HS_TRY(measure_temperature(fix, err));
    if (nh->has_barostat) {
        HS_TRY(hs_nose_hoover_measure_pressure(fix, err));
        HS_TRY(hs_nose_hoover_kick_barostat(fix, err));
    }
    if (nh->has_thermostat) HS_TRY(advance_thermostat(fix, err));
    if (nh->has_barostat) hs_nose_hoover_advance_barostat_chain(fix);
    return HS_OK;
}

bool hs_nose_hoover_needs_energy(const hs_fix *fix, int64_t step)
{
    (void)step;
    return ((const hs_nose_hoover *)fix->state)->has_barostat;
}
