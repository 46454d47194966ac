#include "style/spheres.h"

#include <math.h>
#include <string.h>

#include "style/shared_fields.h"

static const double disc_inertia = 0.5;

hs_status hs_torques_want(hs_env *env, hs_error *err)
{
    static const char *const name[3] = {"tqx", "tqy", "tqz"};
    return hs_shared_fields_want(env->atoms, env->torque, name, 3, &env->n_torque_users, err);
}

void hs_torques_release(hs_env *env) { hs_shared_fields_release(env->atoms, env->torque, 3, &env->n_torque_users); }

double hs_sphere_inertia(const hs_atoms *atoms, int i)
{
    return HS_SPHERE_INERTIA * atoms->rmass[i] * atoms->radius[i] * atoms->radius[i];
}

hs_status hs_spheres_read(hs_spheres *spheres, const hs_fix *fix, const hs_args *args, int i, int *n_used,
                          hs_error *err)
{
    static const char *const updates[] = {"dipole", "dipole/dlm", NULL};
    int which;
    *n_used = 1;
    if (strcmp(args->word[i], "disc") == 0) {
        spheres->is_disc = true;
        return fix->env->box->dimension == 2
                   ? HS_OK
                   : hs_fail(err, HS_ERROR_INPUT, "%s: disc is for two dimensions", args->command);
    }
    *n_used = 0;
    if (strcmp(args->word[i], "update") != 0) return HS_OK;
    HS_TRY(hs_arg_choice(args, i + 1, updates, &which, err));
    spheres->dipoles = which == 0 ? HS_DIPOLES_EULER : HS_DIPOLES_DLM;
    *n_used = 2;
    return HS_OK;
}

hs_status hs_spheres_check_style(const hs_spheres *spheres, const hs_fix *fix, const hs_args *args, hs_error *err)
{
    const hs_atoms *atoms = fix->env->atoms;
    if (atoms->omega[0] == NULL)
        return hs_fail(err, HS_ERROR_INPUT, "%s: the atoms are no spheres that could turn: use 'atom_style sphere'",
                       args->command);
    if (spheres->dipoles == HS_DIPOLES_STAY || atoms->mu[0] != NULL) return HS_OK;
    return hs_fail(
        err, HS_ERROR_INPUT,
        "%s: the atoms have no dipoles to turn: use 'atom_style hybrid dipole sphere', or leave 'update' out",
        args->command);
}

hs_status hs_spheres_check(const hs_fix *fix, hs_error *err)
{
    const hs_atoms *atoms = fix->env->atoms;
    int64_t point = INT64_MAX;
    for (int i = 0; i < atoms->n_local; ++i)
        if ((atoms->mask[i] & fix->mask) && !(atoms->radius[i] > 0.0) && atoms->id[i] < point) point = atoms->id[i];
    point = -point;
    hs_parallel_max_int64(fix->env->parallel, &point, 1);
    if (point == -INT64_MAX) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT,
                   "%s: atom %lld is a point (diameter 0), which cannot turn; 'set ... diameter' makes it a sphere, or "
                   "choose a group without it",
                   hs_fix_who(fix).text, (long long)-point);
}

/** dt/2 with the units' factor, over the moment of inertia. */
static void kick_share(const hs_spheres *spheres, const hs_fix *fix, double half_dt)
{
    const hs_atoms *atoms = fix->env->atoms;
    const double inertia = spheres->is_disc ? disc_inertia : HS_SPHERE_INERTIA;
#pragma omp for schedule(static) nowait
    for (int i = 0; i < atoms->n_local; ++i) {
        if (!(atoms->mask[i] & fix->mask)) continue;
        const double size = half_dt / (inertia * atoms->rmass[i] * atoms->radius[i] * atoms->radius[i]);
        for (int axis = 0; axis < 3; ++axis) atoms->omega[axis][i] += size * fix->env->torque[axis][i];
    }
}

void hs_spheres_kick(const hs_spheres *spheres, const hs_fix *fix, double dt)
{
    if (fix->env->torque[0] == NULL) return;
    HS_ON_THREADS(kick_share(spheres, fix, 0.5 * dt * fix->env->units->ftm2v));
}

/** mu' = omega x mu by one step, which makes mu longer. */
static void turn_simply(const hs_atoms *atoms, int i, double dt)
{
    const double w[3] = {atoms->omega[0][i], atoms->omega[1][i], atoms->omega[2][i]};
    const double mu[3] = {atoms->mu[0][i], atoms->mu[1][i], atoms->mu[2][i]};
    const double to[3] = {mu[0] + dt * (w[1] * mu[2] - w[2] * mu[1]), mu[1] + dt * (w[2] * mu[0] - w[0] * mu[2]),
                          mu[2] + dt * (w[0] * mu[1] - w[1] * mu[0])};
    const double scale = atoms->mu_length[i] / sqrt(to[0] * to[0] + to[1] * to[1] + to[2] * to[2]);
    for (int axis = 0; axis < 3; ++axis) atoms->mu[axis][i] = scale * to[axis];
}

/** A frame of the sphere's own, whose third row is the direction of its dipole: the least rotation that brings that to z. */
static void make_frame(const double e[3], double q[3][3])
{
    const double aside2 = e[0] * e[0] + e[1] * e[1];
    const double shrink = aside2 != 0.0 ? (1.0 - e[2]) / aside2 : 0.0;
    const double rows[3][3] = {{1.0 - shrink * e[0] * e[0], -shrink * e[0] * e[1], -e[0]},
                               {-shrink * e[0] * e[1], 1.0 - shrink * e[1] * e[1], -e[1]},
                               {e[0], e[1], 1.0 - shrink * aside2}};
    memcpy(q, rows, sizeof rows);
    if (aside2 == 0.0) q[0][0] = q[2][2] = 1.0 / e[2]; /* along z, up or down */
}

/** The sphere turns about an axis of its frame by the angle t w[axis]: a true rotation whose angle is right to second order. */
static void turn_about(int axis, double t, double q[3][3], double w[3])
{
    const int b = (axis + 1) % 3, c = (axis + 2) % 3;
    const double angle = t * w[axis], quarter = 0.25 * angle * angle;
    const double cosine = (1.0 - quarter) / (1.0 + quarter), sine = angle / (1.0 + quarter);
    const double w_b = w[b], w_c = w[c];
    w[b] = cosine * w_b + sine * w_c;
    w[c] = cosine * w_c - sine * w_b;
    for (int k = 0; k < 3; ++k) {
        const double q_b = q[b][k], q_c = q[c][k];
        q[b][k] = cosine * q_b + sine * q_c;
        q[c][k] = cosine * q_c - sine * q_b;
    }
}

static void turn_well(const hs_atoms *atoms, int i, double dt)
{
    double q[3][3], w[3], e[3];
    for (int axis = 0; axis < 3; ++axis) e[axis] = atoms->mu[axis][i] / atoms->mu_length[i];
    make_frame(e, q);
    for (int k = 0; k < 3; ++k)
        w[k] = q[k][0] * atoms->omega[0][i] + q[k][1] * atoms->omega[1][i] + q[k][2] * atoms->omega[2][i];
    turn_about(0, 0.5 * dt, q, w);
    turn_about(1, 0.5 * dt, q, w);
    turn_about(2, dt, q, w);
    turn_about(1, 0.5 * dt, q, w);
    turn_about(0, 0.5 * dt, q, w);
    for (int axis = 0; axis < 3; ++axis) {
        atoms->omega[axis][i] = q[0][axis] * w[0] + q[1][axis] * w[1] + q[2][axis] * w[2];
        atoms->mu[axis][i] = q[2][axis] * atoms->mu_length[i];
    }
}

static void turn_share(const hs_spheres *spheres, const hs_fix *fix, double dt)
{
    const hs_atoms *atoms = fix->env->atoms;
#pragma omp for schedule(static) nowait
    for (int i = 0; i < atoms->n_local; ++i) {
        if (!(atoms->mask[i] & fix->mask) || !(atoms->mu_length[i] > 0.0)) continue;
        if (spheres->dipoles == HS_DIPOLES_DLM)
            turn_well(atoms, i, dt);
        else
            turn_simply(atoms, i, dt);
    }
}

void hs_spheres_turn(const hs_spheres *spheres, const hs_fix *fix, double dt)
{
    if (spheres->dipoles != HS_DIPOLES_STAY) HS_ON_THREADS(turn_share(spheres, fix, dt));
}

static void scale_share(const hs_fix *fix, double factor)
{
    const hs_atoms *atoms = fix->env->atoms;
#pragma omp for schedule(static) nowait
    for (int i = 0; i < atoms->n_local; ++i)
        for (int axis = 0; axis < 3 && atoms->mask[i] & fix->mask; ++axis) atoms->omega[axis][i] *= factor;
}

void hs_spheres_scale(const hs_fix *fix, double factor) { HS_ON_THREADS(scale_share(fix, factor)); }
