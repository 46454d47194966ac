/* What fix nvt, npt, nph and nvt/sllod do to the atoms. */
#include "core/atom_style.h"
#include "style/box_flow.h"
#include "style/nose_hoover_internal.h"

static void scale_share(const hs_fix *fix, const hs_compute *temperature, const double factor[3])
{
    const hs_atoms *atoms = fix->env->atoms;
    void (*const bias_of)(const hs_compute *, int, double *) = temperature->style->bias;
#pragma omp for schedule(static) nowait
    for (int i = 0; i < atoms->n_local; ++i) {
        double bias[3] = {0.0};
        if (!(atoms->mask[i] & fix->mask)) continue;
        if (bias_of != NULL) bias_of(temperature, i, bias);
        for (int axis = 0; axis < 3; ++axis)
            atoms->v[axis][i] = bias_of != NULL ? bias[axis] + factor[axis] * (atoms->v[axis][i] - bias[axis])
                                                : factor[axis] * atoms->v[axis][i];
    }
}

void hs_nose_hoover_scale(const hs_fix *fix, const hs_compute *temperature, const double factor[3])
{
    HS_ON_THREADS(scale_share(fix, temperature, factor));
    hs_env_changed(fix->env);
}

static void shear_share(const hs_fix *fix, const hs_compute *temperature, const double factor[3], const double shear[3])
{
    const hs_atoms *atoms = fix->env->atoms;
    void (*const bias_of)(const hs_compute *, int, double *) = temperature->style->bias;
#pragma omp for schedule(static) nowait
    for (int i = 0; i < atoms->n_local; ++i) {
        double bias[3] = {0.0}, v[3];
        if (!(atoms->mask[i] & fix->mask)) continue;
        if (bias_of != NULL) bias_of(temperature, i, bias);
        for (int axis = 0; axis < 3; ++axis) v[axis] = factor[axis] * (atoms->v[axis][i] - bias[axis]);
        v[0] -= shear[0] * v[1] + shear[1] * v[2];
        v[1] -= shear[2] * v[2];
        for (int axis = 0; axis < 3; ++axis) atoms->v[axis][i] = bias[axis] + factor[axis] * v[axis];
    }
}

void hs_nose_hoover_shear(const hs_fix *fix, const hs_compute *temperature, const double factor[3],
                          const double shear[3])
{
    HS_ON_THREADS(shear_share(fix, temperature, factor, shear));
    hs_env_changed(fix->env);
}

static void flow_share(const hs_fix *fix, const hs_compute *temperature, double factor, const hs_box_flow_map *flow)
{
    const hs_nose_hoover *nh = fix->state;
    const hs_atoms *atoms = fix->env->atoms;
    const double(*gradient)[3] = flow->gradient, half_dt = 0.5 * nh->dt;
#pragma omp for schedule(static) nowait
    for (int i = 0; i < atoms->n_local; ++i) {
        double u[3], c[3];
        if (!(atoms->mask[i] & fix->mask)) continue;
        if (temperature == NULL)
            hs_box_flow_at(flow, atoms->x[0][i], atoms->x[1][i], atoms->x[2][i], u);
        else
            temperature->style->bias(temperature, i, u);
        for (int axis = 0; axis < 3; ++axis) c[axis] = atoms->v[axis][i] - u[axis];
        double pulled[3] = {c[0], c[1], c[2]};
        for (int axis = 0; axis < 3 && nh->is_p_sllod; ++axis) pulled[axis] = atoms->v[axis][i];
        const double pull[3] = {gradient[0][0] * pulled[0] + gradient[0][1] * pulled[1] + gradient[0][2] * pulled[2],
                                gradient[1][1] * pulled[1] + gradient[1][2] * pulled[2], gradient[2][2] * pulled[2]};
        for (int axis = 0; axis < 3; ++axis) atoms->v[axis][i] = u[axis] + (factor * c[axis] - half_dt * pull[axis]);
    }
}

void hs_nose_hoover_flow(const hs_fix *fix, const hs_compute *temperature, double factor)
{
    const hs_box_flow_map flow = hs_box_flow_now(fix->env);
    HS_ON_THREADS(flow_share(fix, temperature, factor, &flow));
    hs_env_changed(fix->env);
}

static void kick_share(const hs_fix *fix)
{
    const hs_nose_hoover *nh = fix->state;
    const hs_atoms *atoms = fix->env->atoms;
    const double half_dt = 0.5 * nh->dt * fix->env->units->ftm2v;
#pragma omp for schedule(static) nowait
    for (int i = 0; i < atoms->n_local; ++i) {
        if (!(atoms->mask[i] & fix->mask)) continue;
        const double size = half_dt / hs_atom_mass(atoms, i);
        for (int axis = 0; axis < 3; ++axis) atoms->v[axis][i] += size * atoms->f[axis][i];
    }
}

void hs_nose_hoover_kick(const hs_fix *fix)
{
    const hs_nose_hoover *nh = fix->state;
    HS_ON_THREADS(kick_share(fix));
    if (nh->spheres.has_rotation) hs_spheres_kick(&nh->spheres, fix, nh->dt);
    hs_env_changed(fix->env);
}

static void drift_share(const hs_fix *fix)
{
    const hs_nose_hoover *nh = fix->state;
    const hs_atoms *atoms = fix->env->atoms;
    const double magic = fix->env->position_magic;
#pragma omp for schedule(static) nowait
    for (int i = 0; i < atoms->n_local; ++i) {
        if (!(atoms->mask[i] & fix->mask)) continue;
        for (int axis = 0; axis < 3; ++axis)
            atoms->x[axis][i] = hs_moved(atoms->x[axis][i], nh->dt * atoms->v[axis][i], magic);
    }
}

void hs_nose_hoover_drift(const hs_fix *fix)
{
    const hs_nose_hoover *nh = fix->state;
    HS_ON_THREADS(drift_share(fix));
    if (nh->spheres.has_rotation) hs_spheres_turn(&nh->spheres, fix, nh->dt);
    hs_env_changed(fix->env);
}
