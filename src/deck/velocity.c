#include "deck/velocity.h"
#include "core/atom_style.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "core/exact_sum.h"
#include "core/rotation.h"
#include "deck/by_id.h"
#include "style/places.h"

hs_status hs_velocity_group_init(hs_velocity_group *group, hs_sim *sim, int bit, hs_error *err)
{
    const uint32_t mask = hs_group_mask(bit);
    *group = (hs_velocity_group){.sim = sim};
    HS_TRY(hs_by_id_order(&sim->atoms, &group->member, err));
    for (int k = 0; k < sim->atoms.n_local; ++k)
        if (sim->atoms.mask[group->member[k]] & mask) group->member[group->n++] = group->member[k];
    group->n_all = group->n;
    hs_parallel_sum_int64(&sim->parallel, &group->n_all, 1);
    return HS_OK;
}

void hs_velocity_group_fini(hs_velocity_group *group)
{
    HS_FREE(group->member);
    group->n = 0;
}

double hs_velocity_temperature(const hs_velocity_group *group)
{
    const hs_atoms *atoms = &group->sim->atoms;
    const hs_units *units = group->sim->env.units;
    const int dimension = group->sim->box.dimension;
    hs_exact_sum mv2 = {0};
    double sum;
    for (int k = 0; k < group->n; ++k) {
        const int i = group->member[k];
        const double vx = atoms->v[0][i], vy = atoms->v[1][i], vz = atoms->v[2][i];
        hs_exact_add(&mv2, (vx * vx + vy * vy + vz * vz) * hs_atom_mass(atoms, i));
    }
    hs_exact_total(&mv2, 1, &group->sim->parallel, &sum);
    const double n_dof = (double)dimension * (double)group->n_all - dimension;
    return n_dof > 0.0 ? sum * (units->mvv2e / (n_dof * units->boltz)) : 0.0;
}

hs_status hs_velocity_rescale(const hs_velocity_group *group, double present, double wanted, hs_error *err)
{
    if (!(present > 0.0))
        return hs_fail(err, HS_ERROR_INPUT,
                       "velocity: the temperature is 0 (atoms at rest, or only one), and cannot be scaled to %g",
                       wanted);
    const double factor = sqrt(wanted / present);
    hs_atoms *atoms = &group->sim->atoms;
    for (int k = 0; k < group->n; ++k)
        for (int axis = 0; axis < 3; ++axis) atoms->v[axis][group->member[k]] *= factor;
    return HS_OK;
}

static double total_mass(const hs_velocity_group *group)
{
    const hs_atoms *atoms = &group->sim->atoms;
    hs_exact_sum sum = {0};
    double mass;
    for (int k = 0; k < group->n; ++k) hs_exact_add(&sum, hs_atom_mass(atoms, group->member[k]));
    hs_exact_total(&sum, 1, &group->sim->parallel, &mass);
    return mass;
}

static hs_status need_members(const hs_velocity_group *group, const char *what, hs_error *err)
{
    if (group->n_all > 0) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "velocity: the group has no atoms whose %s could be made zero", what);
}

hs_status hs_velocity_zero_momentum(const hs_velocity_group *group, hs_error *err)
{
    hs_atoms *atoms = &group->sim->atoms;
    HS_TRY(need_members(group, "momentum", err));
    const double mass = total_mass(group);
    hs_exact_sum sum[3] = {{.n_added = 0}};
    double p[3];
    for (int k = 0; k < group->n; ++k) {
        const int i = group->member[k];
        for (int axis = 0; axis < 3; ++axis) hs_exact_add(&sum[axis], atoms->v[axis][i] * hs_atom_mass(atoms, i));
    }
    hs_exact_total(sum, 3, &group->sim->parallel, p);
    for (int axis = 0; axis < 3; ++axis) {
        const double mean = p[axis] / mass;
        for (int k = 0; k < group->n; ++k) atoms->v[axis][group->member[k]] -= mean;
    }
    return HS_OK;
}

static void center_of_mass(const hs_velocity_group *group, double center[3])
{
    const hs_atoms *atoms = &group->sim->atoms;
    const double mass = total_mass(group);
    hs_exact_sum sum[3] = {{.n_added = 0}};
    for (int k = 0; k < group->n; ++k) {
        const int i = group->member[k];
        double x[3];
        hs_unwrapped_place(&group->sim->env, i, x);
        for (int axis = 0; axis < 3; ++axis) hs_exact_add(&sum[axis], x[axis] * hs_atom_mass(atoms, i));
    }
    hs_exact_total(sum, 3, &group->sim->parallel, center);
    for (int axis = 0; axis < 3; ++axis) center[axis] /= mass;
}

/** Angular momentum and moments of inertia about a point. */
static void rotation_sums(const hs_velocity_group *group, const double center[3], double momentum[3],
                          double inertia[3][3])
{
    const hs_atoms *atoms = &group->sim->atoms;
    hs_exact_sum exact[9] = {{.n_added = 0}};
    double sum[9]; /* Lx Ly Lz, Ixx Iyy Izz Ixy Iyz Ixz */
    for (int k = 0; k < group->n; ++k) {
        const int i = group->member[k];
        const double mass = hs_atom_mass(atoms, i);
        double x[3];
        hs_unwrapped_place(&group->sim->env, i, x);
        const double dx = x[0] - center[0], dy = x[1] - center[1], dz = x[2] - center[2];
        const double term[9] = {mass * (dy * atoms->v[2][i] - dz * atoms->v[1][i]),
                                mass * (dz * atoms->v[0][i] - dx * atoms->v[2][i]),
                                mass * (dx * atoms->v[1][i] - dy * atoms->v[0][i]),
                                mass * (dy * dy + dz * dz),
                                mass * (dx * dx + dz * dz),
                                mass * (dx * dx + dy * dy),
                                -mass * dx * dy,
                                -mass * dy * dz,
                                -mass * dx * dz};
        for (int q = 0; q < 9; ++q) hs_exact_add(&exact[q], term[q]);
    }
    hs_exact_total(exact, 9, &group->sim->parallel, sum);
    memcpy(momentum, sum, 3 * sizeof *momentum);
    inertia[0][0] = sum[3];
    inertia[1][1] = sum[4];
    inertia[2][2] = sum[5];
    inertia[0][1] = inertia[1][0] = sum[6];
    inertia[1][2] = inertia[2][1] = sum[7];
    inertia[0][2] = inertia[2][0] = sum[8];
}

hs_status hs_velocity_zero_rotation(const hs_velocity_group *group, hs_error *err)
{
    HS_TRY(need_members(group, "rotation", err));
    hs_atoms *atoms = &group->sim->atoms;
    double center[3], momentum[3], m[3][3], omega[3];
    center_of_mass(group, center);
    rotation_sums(group, center, momentum, m);
    hs_rotation_velocity((const double(*)[3])m, momentum, omega);
    for (int k = 0; k < group->n; ++k) {
        const int i = group->member[k];
        double x[3];
        hs_unwrapped_place(&group->sim->env, i, x);
        const double dx = x[0] - center[0], dy = x[1] - center[1], dz = x[2] - center[2];
        atoms->v[0][i] -= omega[1] * dz - omega[2] * dy;
        atoms->v[1][i] -= omega[2] * dx - omega[0] * dz;
        atoms->v[2][i] -= omega[0] * dy - omega[1] * dx;
    }
    return HS_OK;
}
