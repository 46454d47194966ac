#include "style/nose_hoover.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "style/box_change.h"
#include "style/box_flow.h"
#include "style/box_shape.h"

/* The computes that the fix owns: fix->own. */
enum { OWN_TEMPERATURE, OWN_PRESSURE };

/* Making it */

static hs_status create_computes(hs_fix *fix, hs_error *err)
{
    const hs_nose_hoover *nh = fix->state;
    const hs_args none = {.command = "fix"};
    static const char *const first[] = {"thermo_temp"};
    const hs_args with_temperature = {.command = "fix", .n = 1, .word = first};
    const int group = nh->has_barostat ? 0 : fix->group; /* the pressure is that of all atoms */
    const char *style = nh->is_sllod ? "temp/deform" : "temp";
    HS_TRY(hs_fix_own_compute(fix, OWN_TEMPERATURE, style, "temp", group, &none, err));
    if (!nh->has_barostat) return HS_OK;
    HS_TRY(hs_fix_own_compute(fix, OWN_PRESSURE, "pressure", "press", 0, &with_temperature, err));
    hs_compute *pressure = fix->own[OWN_PRESSURE];
    return pressure->style->set_temperature(pressure, fix->own[OWN_TEMPERATURE]->id, err);
}

hs_status hs_nose_hoover_create(hs_fix *fix, const hs_args *args, bool has_thermostat, bool has_barostat, hs_error *err)
{
    hs_nose_hoover *nh = fix->state;
    HS_TRY(hs_syntax_check(&fix->style->about.syntax, args, false, err));
    nh->has_thermostat = has_thermostat;
    nh->has_barostat = has_barostat;
    HS_TRY(hs_nose_hoover_read(fix, args, err));
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
    HS_FREE(nh->temperature_id);
    HS_FREE(nh->pressure_id);
}

static hs_status find_compute(const hs_fix *fix, int which, hs_compute **compute, hs_error *err)
{
    const hs_nose_hoover *nh = fix->state;
    const char *id = which == OWN_TEMPERATURE ? nh->temperature_id : nh->pressure_id;
    *compute = id != NULL ? fix->env->find_compute(fix->env, id) : fix->own[which];
    if (*compute != NULL) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "fix '%s' (%s): there is no compute '%s' any more", fix->id,
                   fix->style->about.name, id);
}

/** As in LAMMPS the pressure follows the temperature. */
hs_status hs_nose_hoover_set_temperature(hs_fix *fix, const char *id, hs_error *err)
{
    hs_nose_hoover *nh = fix->state;
    hs_compute *pressure;
    HS_TRY(hs_memory_replace(&nh->temperature_id, id, err));
    if (!nh->has_barostat) return HS_OK;
    HS_TRY(find_compute(fix, OWN_PRESSURE, &pressure, err));
    return pressure->style->set_temperature != NULL ? pressure->style->set_temperature(pressure, id, err) : HS_OK;
}

hs_status hs_nose_hoover_set_pressure(hs_fix *fix, const char *id, hs_error *err)
{
    hs_nose_hoover *nh = fix->state;
    hs_compute *pressure, *temperature;
    if (!nh->has_barostat)
        return hs_fail(err, HS_ERROR_INPUT, "fix_modify: fix '%s' (%s) uses no pressure", fix->id,
                       fix->style->about.name);
    HS_TRY(hs_memory_replace(&nh->pressure_id, id, err));
    HS_TRY(find_compute(fix, OWN_PRESSURE, &pressure, err));
    HS_TRY(find_compute(fix, OWN_TEMPERATURE, &temperature, err));
    return pressure->style->set_temperature != NULL ? pressure->style->set_temperature(pressure, temperature->id, err)
                                                    : HS_OK;
}

static void set_reference(hs_nose_hoover *nh, const hs_box *box)
{
    nh->v_reference = hs_box_volume(box);
    for (int axis = 0; axis < 3; ++axis) nh->inv_reference[axis] = 1.0 / hs_box_length(box, axis);
}

hs_status hs_nose_hoover_take_dt(hs_fix *fix, hs_error *err)
{
    hs_nose_hoover *nh = fix->state;
    double p_rate = 0.0;
    (void)err;
    nh->dt = fix->env->dt;
    for (int axis = 0; axis < 3; ++axis) p_rate = fmax(p_rate, nh->p_rate[axis]);
    nh->chain.drag = 1.0 - nh->dt * nh->t_rate * nh->drag / nh->chain.n_loops;
    nh->barostat_chain.drag = 1.0 - nh->dt * p_rate * nh->drag / nh->barostat_chain.n_loops;
    return HS_OK;
}

hs_status hs_nose_hoover_init(hs_fix *fix, hs_error *err)
{
    hs_nose_hoover *nh = fix->state;
    const hs_env *env = fix->env;
    hs_compute *compute;
    HS_TRY(find_compute(fix, OWN_TEMPERATURE, &compute, err));
    if (nh->is_sllod && compute->style->bias == NULL)
        return hs_fail(
            err, HS_ERROR_INPUT,
            "fix '%s' (nvt/sllod): the temperature '%s' takes no flow off the velocities; compute temp/deform does",
            fix->id, compute->id);
    for (int axis = 0; axis < 3; ++axis)
        if (nh->axis[axis] && env->box_flow != NULL && env->box_flow->sets_length[axis])
            return hs_fail(
                err, HS_ERROR_INPUT,
                "fix '%s' (%s): the length in %c is what fix deform makes it, and cannot follow a pressure, too",
                fix->id, fix->style->about.name, "xyz"[axis]);
    if (nh->has_barostat) HS_TRY(find_compute(fix, OWN_PRESSURE, &compute, err));
    for (int k = 0; k < HS_FIX_OWN_MAX; ++k)
        if (fix->own[k] != NULL && fix->own[k]->style->init != NULL) HS_TRY(fix->own[k]->style->init(fix->own[k], err));
    if (nh->v_reference == 0.0) set_reference(nh, env->box);
    return hs_nose_hoover_take_dt(fix, err);
}

/* Targets and measurements */

static void find_targets(const hs_fix *fix)
{
    hs_nose_hoover *nh = fix->state;
    const double done = hs_env_ramp(fix->env);
    nh->p_mean = 0.0;
    if (nh->reset_every > 0 && (fix->env->step - fix->env->ramp_start) % nh->reset_every == 0)
        set_reference(nh, fix->env->box);
    for (int axis = 0; axis < 3; ++axis) {
        if (!nh->axis[axis]) continue;
        nh->p_target[axis] = nh->p_start[axis] + done * (nh->p_stop[axis] - nh->p_start[axis]);
        nh->p_mean += nh->p_target[axis] / nh->n_axes;
    }
}

static void find_target_temperature(const hs_fix *fix)
{
    hs_nose_hoover *nh = fix->state;
    nh->t_target = nh->t_start + hs_env_ramp(fix->env) * (nh->t_stop - nh->t_start);
}

static hs_status measure_temperature(const hs_fix *fix, hs_error *err)
{
    hs_nose_hoover *nh = fix->state;
    hs_compute *temperature;
    HS_TRY(find_compute(fix, OWN_TEMPERATURE, &temperature, err));
    HS_TRY(hs_compute_scalar(temperature, &nh->t_now, err));
    nh->n_dof = temperature->n_dof;
    return HS_OK;
}

/** Mean of the pressures of coupled axes. */
static void couple(hs_nose_hoover *nh, const double *p)
{
    static const int pairs[][2] = {[HS_NH_XY] = {0, 1}, [HS_NH_YZ] = {1, 2}, [HS_NH_XZ] = {0, 2}};
    for (int axis = 0; axis < 3; ++axis) nh->p_now[axis] = p[axis];
    if (nh->coupling == HS_NH_NONE) return;
    const int a = pairs[nh->coupling][0], b = pairs[nh->coupling][1];
    nh->p_now[a] = nh->p_now[b] = 0.5 * (p[a] + p[b]);
}

/** The present pressure. At the start of a step that is the virial of the step before with the present velocities. */
static hs_status measure_pressure(const hs_fix *fix, hs_error *err)
{
    hs_nose_hoover *nh = fix->state;
    hs_env *env = fix->env;
    hs_compute *pressure;
    double p = 0.0;
    const int64_t energy_step = env->energy_step;
    HS_TRY(find_compute(fix, OWN_PRESSURE, &pressure, err));
    hs_env_changed(env);
    env->energy_step = env->step;
    const hs_status status = nh->is_iso ? hs_compute_scalar(pressure, &p, err) : hs_compute_eval_vector(pressure, err);
    env->energy_step = energy_step;
    HS_TRY(status);
    if (nh->is_iso)
        nh->p_now[0] = nh->p_now[1] = nh->p_now[2] = p;
    else
        couple(nh, pressure->vector);
    return HS_OK;
}

/** Twice the kinetic energy along the axes that the barostat acts on. */
static hs_status measure_kinetic(const hs_fix *fix, double *kinetic, hs_error *err)
{
    const hs_nose_hoover *nh = fix->state;
    hs_compute *temperature;
    *kinetic = 0.0;
    if (nh->is_iso) {
        *kinetic = nh->n_dof * fix->env->units->boltz * nh->t_now;
        return HS_OK;
    }
    HS_TRY(find_compute(fix, OWN_TEMPERATURE, &temperature, err));
    HS_TRY(hs_compute_eval_vector(temperature, err));
    for (int axis = 0; axis < 3; ++axis)
        if (nh->axis[axis]) *kinetic += temperature->vector[axis];
    return HS_OK;
}

/** Masses that give the chain its frequency at the present target. */
static void set_chain_masses(hs_nose_hoover *nh, const hs_env *env)
{
    const double kt = env->units->boltz * nh->t_target;
    for (int k = 0; k < nh->chain.n; ++k)
        nh->chain.mass[k] = (k == 0 ? nh->n_dof : 1.0) * kt / (nh->t_rate * nh->t_rate);
}

/** Masses of the barostat and its chain. As in LAMMPS they stay through a run, even when its temperature changes. */
static void set_barostat_masses(hs_nose_hoover *nh, const hs_env *env)
{
    const double kt = env->units->boltz * nh->t_target, nkt = ((double)env->atoms->n_all + 1.0) * kt;
    double p_rate = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        if (!nh->axis[axis]) continue;
        nh->mass[axis] = nkt / (nh->p_rate[axis] * nh->p_rate[axis]);
        p_rate = fmax(p_rate, nh->p_rate[axis]);
    }
    for (int k = 0; k < nh->barostat_chain.n; ++k) nh->barostat_chain.mass[k] = kt / (p_rate * p_rate);
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
        find_targets(fix);
        HS_TRY(measure_pressure(fix, err));
    }
    set_chain_masses(nh, env);
    set_barostat_masses(nh, env);
    hs_nh_chain_force(&nh->chain, env->units->boltz * nh->t_target);
    hs_nh_chain_force(&nh->barostat_chain, env->units->boltz * nh->t_target);
    return HS_OK;
}

/* Parts of a step */

/** Scale the thermal velocities of the group, all axes alike where they flow. */
static hs_status scale_velocities(const hs_fix *fix, const double factor[3], bool is_flowing, hs_error *err)
{
    hs_compute *temperature;
    HS_TRY(find_compute(fix, OWN_TEMPERATURE, &temperature, err));
    if (is_flowing)
        hs_nose_hoover_flow(fix, temperature != fix->own[OWN_TEMPERATURE] ? temperature : NULL, factor[0]);
    else
        hs_nose_hoover_scale(fix, temperature, factor);
    hs_env_changed(fix->env);
    return HS_OK;
}

/** The chain acts on the atoms. */
static hs_status advance_thermostat(const hs_fix *fix, hs_error *err)
{
    hs_nose_hoover *nh = fix->state;
    const double k = fix->env->units->boltz;
    nh->chain.mass[0] = nh->n_dof * k * nh->t_target / (nh->t_rate * nh->t_rate);
    for (int link = 1; link < nh->chain.n; ++link) nh->chain.mass[link] = k * nh->t_target / (nh->t_rate * nh->t_rate);
    const double s = hs_nh_chain_advance(&nh->chain, k * nh->t_target, nh->n_dof * k * nh->t_target,
                                         nh->n_dof * k * nh->t_now, nh->dt);
    nh->t_now *= s * s;
    return scale_velocities(fix, (const double[3]){s, s, s}, nh->is_sllod, err);
}

/** The barostat's chain acts on the strain rates. */
static void advance_barostat_chain(const hs_fix *fix)
{
    hs_nose_hoover *nh = fix->state;
    const double kt = fix->env->units->boltz * nh->t_target;
    double kinetic = 0.0;
    if (nh->barostat_chain.n == 0) return;
    for (int axis = 0; axis < 3; ++axis)
        if (nh->axis[axis]) kinetic += nh->mass[axis] * nh->strain_rate[axis] * nh->strain_rate[axis];
    const double s =
        hs_nh_chain_advance(&nh->barostat_chain, kt, hs_nose_hoover_barostat_target(nh, kt), kinetic, nh->dt);
    for (int axis = 0; axis < 3; ++axis) nh->strain_rate[axis] *= s;
}

/** Half a step of the strain rates. */
static hs_status kick_barostat(const hs_fix *fix, hs_error *err)
{
    hs_nose_hoover *nh = fix->state;
    const hs_env *env = fix->env;
    const double volume = hs_box_volume(env->box), nd = nh->n_axes * (double)env->atoms->n_all;
    double kinetic = 0.0;
    if (nh->is_mtk) HS_TRY(measure_kinetic(fix, &kinetic, err));
    for (int axis = 0; axis < 3; ++axis) {
        if (!nh->axis[axis]) continue;
        const double work = ((nh->p_now[axis] - nh->p_mean) * volume -
                             (nh->is_iso ? 0.0 : hs_nose_hoover_deviatoric(nh, env->box, axis))) /
                            env->units->nktv2p;
        nh->strain_rate[axis] += (work + kinetic / nd) / nh->mass[axis] * 0.5 * nh->dt;
        nh->strain_rate[axis] *= nh->barostat_chain.drag;
    }
    nh->kinetic_term = 0.0;
    for (int axis = 0; axis < 3 && nh->is_mtk; ++axis)
        if (nh->axis[axis]) nh->kinetic_term += nh->strain_rate[axis] / nd;
    return HS_OK;
}

/** The strain rates act on the velocities for half a step. */
static hs_status strain_velocities(const hs_fix *fix, hs_error *err)
{
    const hs_nose_hoover *nh = fix->state;
    double factor[3];
    for (int axis = 0; axis < 3; ++axis) factor[axis] = exp(-0.5 * nh->dt * (nh->strain_rate[axis] + nh->kinetic_term));
    return scale_velocities(fix, factor, false, err);
}

/** The strain rates act on box and positions for half a step. */
static void strain_box(const hs_fix *fix)
{
    hs_nose_hoover *nh = fix->state;
    hs_env *env = fix->env;
    double lo[3], hi[3], tilt[3];
    memcpy(tilt, env->box->tilt, sizeof tilt);
    for (int axis = 0; axis < 3; ++axis) {
        lo[axis] = env->box->lo[axis];
        hi[axis] = env->box->hi[axis];
        nh->strain[axis] += 0.5 * nh->dt * nh->strain_rate[axis];
        if (!nh->axis[axis]) continue;
        const double point = nh->fixed_point[axis], growth = exp(0.5 * nh->dt * nh->strain_rate[axis]);
        lo[axis] = (lo[axis] - point) * growth + point;
        hi[axis] = (hi[axis] - point) * growth + point;
        /* tilts keep their ratio to the length that they tilt */
        for (int k = 0; k < 3; ++k)
            if (nh->scales_tilt[k] && hs_tilt_second(k) == axis) tilt[k] *= growth;
    }
    hs_box_change(env, lo, hi, tilt, nh->dilate);
}

hs_status hs_nose_hoover_initial_integrate(hs_fix *fix, hs_error *err)
{
    hs_nose_hoover *nh = fix->state;
    if (nh->has_barostat) advance_barostat_chain(fix);
    if (nh->has_thermostat) {
        find_target_temperature(fix);
        HS_TRY(advance_thermostat(fix, err));
    }
    if (nh->has_barostat) {
        HS_TRY(measure_pressure(fix, err));
        find_targets(fix);
        HS_TRY(kick_barostat(fix, err));
        HS_TRY(strain_velocities(fix, err));
    }
    hs_nose_hoover_kick(fix);
    if (nh->has_barostat) strain_box(fix);
    hs_nose_hoover_drift(fix);
    if (nh->has_barostat) strain_box(fix);
    return HS_OK;
}

hs_status hs_nose_hoover_final_integrate(hs_fix *fix, hs_error *err)
{
    hs_nose_hoover *nh = fix->state;
    hs_nose_hoover_kick(fix);
    if (nh->has_barostat) HS_TRY(strain_velocities(fix, err));
    HS_TRY(measure_temperature(fix, err));
    if (nh->has_barostat) {
        HS_TRY(measure_pressure(fix, err));
        HS_TRY(kick_barostat(fix, err));
    }
    if (nh->has_thermostat) HS_TRY(advance_thermostat(fix, err));
    if (nh->has_barostat) advance_barostat_chain(fix);
    return HS_OK;
}

bool hs_nose_hoover_needs_energy(const hs_fix *fix, int64_t step)
{
    (void)step;
    return ((const hs_nose_hoover *)fix->state)->has_barostat;
}
