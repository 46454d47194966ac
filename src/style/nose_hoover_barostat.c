/* The barostat of fix npt and nph: its targets, how it is moved, and how it moves velocities and the box. */
#include <math.h>
#include <string.h>

#include "style/box_change.h"
#include "style/box_shape.h"
#include "style/nose_hoover_internal.h"

void hs_nose_hoover_set_reference(hs_nose_hoover *nh, const hs_box *box)
{
    nh->reference = *box;
    nh->has_reference = true;
}

/** Of the present targets, relative to the reference box. */
static void set_strain_energy(hs_nose_hoover *nh)
{
    double unequal[HS_NH_COMPONENTS];
    for (int k = 0; k < HS_NH_COMPONENTS; ++k) unequal[k] = nh->p_target[k] - (k < HS_NH_XY ? nh->p_mean : 0.0);
    hs_strain_energy_set(&nh->strained, &nh->reference, unequal);
}

void hs_nose_hoover_find_targets(const hs_fix *fix)
{
    hs_nose_hoover *nh = fix->state;
    const double done = hs_env_ramp(fix->env);
    nh->p_mean = 0.0;
    /* where all targets are one, the reference is no more than a constant of the energy */
    if (nh->has_strain_energy && nh->reset_every > 0 && (fix->env->step - fix->env->ramp_start) % nh->reset_every == 0)
        hs_nose_hoover_set_reference(nh, fix->env->box);
    for (int k = 0; k < HS_NH_COMPONENTS; ++k) {
        if (!nh->moves[k]) continue;
        nh->p_target[k] = nh->p_start[k] + done * (nh->p_stop[k] - nh->p_start[k]);
        if (k < HS_NH_XY) nh->p_mean += nh->p_target[k] / nh->n_axes;
    }
    set_strain_energy(nh);
}

hs_status hs_nose_hoover_measure_pressure(const hs_fix *fix, hs_error *err)
{
    hs_nose_hoover *nh = fix->state;
    hs_env *env = fix->env;
    const int64_t energy_step = env->energy_step;
    hs_env_changed(env);
    env->energy_step = env->step;
    const hs_status status = hs_barometer_read(fix, &nh->barometer, nh->p_now, err);
    env->energy_step = energy_step;
    return status;
}

void hs_nose_hoover_set_barostat_masses(hs_nose_hoover *nh, const hs_env *env)
{
    const double kt = env->units->boltz * nh->t_target, nkt = ((double)env->atoms->n_all + 1.0) * kt;
    double p_rate = 0.0;
    for (int k = 0; k < HS_NH_COMPONENTS; ++k) {
        if (!nh->moves[k]) continue;
        nh->mass[k] = nkt / (nh->p_rate[k] * nh->p_rate[k]);
        p_rate = fmax(p_rate, nh->p_rate[k]);
    }
    for (int k = 0; k < nh->barostat_chain.n; ++k) nh->barostat_chain.mass[k] = kt / (p_rate * p_rate);
}

void hs_nose_hoover_advance_barostat_chain(const hs_fix *fix)
{
    hs_nose_hoover *nh = fix->state;
    const double kt = fix->env->units->boltz * nh->t_target;
    double kinetic = 0.0;
    if (nh->barostat_chain.n == 0) return;
    for (int k = 0; k < HS_NH_COMPONENTS; ++k)
        if (nh->moves[k]) kinetic += nh->mass[k] * nh->strain_rate[k] * nh->strain_rate[k];
    const double s =
        hs_nh_chain_advance(&nh->barostat_chain, kt, hs_nose_hoover_barostat_target(nh, kt), kinetic, nh->dt);
    for (int k = 0; k < HS_NH_COMPONENTS; ++k) nh->strain_rate[k] *= s;
}

/** Twice the kinetic energy along the axes that the barostat acts on. */
static hs_status measure_kinetic(const hs_fix *fix, double *kinetic, hs_error *err)
{
    const hs_nose_hoover *nh = fix->state;
    hs_compute *temperature;
    *kinetic = 0.0;
    if (nh->barometer.is_iso) {
        *kinetic = nh->n_dof * fix->env->units->boltz * nh->t_now;
        return HS_OK;
    }
    HS_TRY(hs_barometer_temperature(fix, &nh->barometer, &temperature, err));
    HS_TRY(hs_compute_eval_vector(temperature, err));
    for (int axis = 0; axis < 3; ++axis)
        if (nh->moves[axis]) *kinetic += temperature->vector[axis];
    return HS_OK;
}

hs_status hs_nose_hoover_kick_barostat(const hs_fix *fix, hs_error *err)
{
    hs_nose_hoover *nh = fix->state;
    const hs_env *env = fix->env;
    const double volume = hs_box_volume(env->box), nd = nh->n_axes * (double)env->atoms->n_all;
    double kinetic = 0.0, against[HS_NH_COMPONENTS] = {0.0};
    if (nh->is_mtk && nh->n_axes > 0) HS_TRY(measure_kinetic(fix, &kinetic, err));
    if (!nh->barometer.is_iso) hs_strain_energy_stress(&nh->strained, env->box, against);
    nh->kinetic_term = 0.0;
    for (int k = 0; k < HS_NH_COMPONENTS; ++k) {
        const bool is_axis = k < HS_NH_XY;
        if (!nh->moves[k]) continue;
        const double work = ((nh->p_now[k] - (is_axis ? nh->p_mean : 0.0)) * volume - against[k]) / env->units->nktv2p;
        nh->strain_rate[k] += (work + (is_axis ? kinetic / nd : 0.0)) / nh->mass[k] * 0.5 * nh->dt;
        nh->strain_rate[k] *= nh->barostat_chain.drag;
        if (is_axis && nh->is_mtk) nh->kinetic_term += nh->strain_rate[k] / nd;
    }
    return HS_OK;
}

hs_status hs_nose_hoover_strain_velocities(const hs_fix *fix, hs_error *err)
{
    const hs_nose_hoover *nh = fix->state;
    const double *w = nh->strain_rate, half_dt = 0.5 * nh->dt;
    hs_compute *temperature;
    double factor[3];
    HS_TRY(hs_barometer_temperature(fix, &nh->barometer, &temperature, err));
    const double time = nh->has_tilts ? 0.5 * half_dt : half_dt;
    for (int axis = 0; axis < 3; ++axis) factor[axis] = exp(-time * (w[axis] + nh->kinetic_term));
    if (nh->has_tilts)
        hs_nose_hoover_shear(fix, temperature, factor,
                             (const double[3]){half_dt * w[3], half_dt * w[4], half_dt * w[5]});
    else
        hs_nose_hoover_scale(fix, temperature, factor);
    return HS_OK;
}

/** Tilts with a target follow the strain rates for some time: xz in halves, xy and yz between. */
static void strain_tilts(const hs_nose_hoover *nh, const hs_box *box, double time, double tilt[3])
{
    const double *w = nh->strain_rate, ly = hs_box_length(box, 1), lz = hs_box_length(box, 2);
    const double x_half = exp(0.25 * time * w[0]), x_whole = exp(0.5 * time * w[0]), y_whole = exp(0.5 * time * w[1]);
    for (int part = 0; part < 2; ++part) {
        if (nh->moves[HS_NH_XY + 1]) tilt[1] = (tilt[1] * x_half + 0.5 * time * (w[3] * tilt[2] + w[4] * lz)) * x_half;
        if (part == 1) break;
        if (nh->moves[HS_NH_XY + 2]) tilt[2] = (tilt[2] * y_whole + time * w[5] * lz) * y_whole;
        if (nh->moves[HS_NH_XY]) tilt[0] = (tilt[0] * x_whole + time * w[3] * ly) * x_whole;
    }
}

void hs_nose_hoover_strain_box(const hs_fix *fix)
{
    hs_nose_hoover *nh = fix->state;
    hs_env *env = fix->env;
    const double half_dt = 0.5 * nh->dt;
    hs_box to = *env->box;
    for (int k = 0; k < HS_NH_COMPONENTS; ++k) nh->strain[k] += half_dt * nh->strain_rate[k];
    if (nh->has_tilts) strain_tilts(nh, &to, 0.5 * half_dt, to.tilt);
    for (int axis = 0; axis < 3; ++axis) {
        if (!nh->moves[axis]) continue;
        const double point = nh->fixed_point[axis], growth = exp(half_dt * nh->strain_rate[axis]);
        to.lo[axis] = (to.lo[axis] - point) * growth + point;
        to.hi[axis] = (to.hi[axis] - point) * growth + point;
        /* tilts keep their ratio to the length that they tilt */
        for (int k = 0; k < 3; ++k)
            if (nh->scales_tilt[k] && hs_tilt_second(k) == axis) to.tilt[k] *= growth;
    }
    /* as in LAMMPS with the lengths of before, which makes a difference of the order of (w dt)^2 */
    if (nh->has_tilts) strain_tilts(nh, env->box, 0.5 * half_dt, to.tilt);
    hs_box_change(env, to.lo, to.hi, to.tilt, nh->dilate);
}

/** Edges by which a tilt must be changed to be at most half of the length along its first axis, where it is a good deal
 *  more. */
static int32_t excess(const hs_box *box, int tilt, double value)
{
    const double limit = 0.6; /* as in LAMMPS */
    const int axis = hs_tilt_first(tilt);
    const double edges = value / hs_box_length(box, axis);
    return box->periodic[axis] && fabs(edges) > limit ? -(int32_t)round(edges) : 0;
}

/** As in LAMMPS yz comes first, for it changes xz. The reference box goes on being the one it was. */
hs_status hs_nose_hoover_pre_exchange(hs_fix *fix, hs_error *err)
{
    hs_nose_hoover *nh = fix->state;
    hs_env *env = fix->env;
    const hs_box *box = env->box;
    const double no_flow[3][3] = {{0.0}};
    int32_t n[3];
    (void)err;
    if (!nh->has_tilts || !nh->has_flips) return HS_OK;
    n[2] = excess(box, 2, box->tilt[2]);
    n[1] = excess(box, 1, box->tilt[1] + n[2] * box->tilt[0]);
    n[0] = excess(box, 0, box->tilt[0]);
    if (n[0] == 0 && n[1] == 0 && n[2] == 0) return HS_OK;
    hs_box_flip(env, n);
    nh->reference.tilt[1] += n[1] * hs_box_length(&nh->reference, 0) + n[2] * nh->reference.tilt[0];
    nh->reference.tilt[0] += n[0] * hs_box_length(&nh->reference, 0);
    nh->reference.tilt[2] += n[2] * hs_box_length(&nh->reference, 1);
    set_strain_energy(nh);
    hs_box_wrap_flowing(env, no_flow, 0);
    return HS_OK;
}
