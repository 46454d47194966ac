/* Constant-energy integration of spheres that turn: velocity Verlet for places and for angles. */
#include "style/spheres.h"

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    hs_spheres *spheres = fix->state;
    HS_TRY(hs_syntax_check(&fix->style->about.syntax, args, false, err));
    for (int i = 0, n_used; i < args->n; i += n_used) HS_TRY(hs_spheres_read(spheres, fix, args, i, &n_used, err));
    return hs_spheres_check_style(spheres, fix, args, err);
}

static hs_status init(hs_fix *fix, hs_error *err) { return hs_spheres_check(fix, err); }

static void kick(const hs_fix *fix)
{
    const hs_atoms *atoms = fix->env->atoms;
    const double half_dt = 0.5 * fix->env->dt * fix->env->units->ftm2v;
#pragma omp for schedule(static) nowait
    for (int i = 0; i < atoms->n_local; ++i) {
        if (!(atoms->mask[i] & fix->mask)) continue;
        const double size = half_dt / atoms->rmass[i];
        for (int axis = 0; axis < 3; ++axis) atoms->v[axis][i] += size * atoms->f[axis][i];
    }
}

static void drift(const hs_fix *fix)
{
    const hs_atoms *atoms = fix->env->atoms;
    const double dt = fix->env->dt, magic = fix->env->position_magic;
#pragma omp for schedule(static) nowait
    for (int i = 0; i < atoms->n_local; ++i)
        for (int axis = 0; axis < 3 && atoms->mask[i] & fix->mask; ++axis)
            atoms->x[axis][i] = hs_moved(atoms->x[axis][i], dt * atoms->v[axis][i], magic);
}

static hs_status initial_integrate(hs_fix *fix, hs_error *err)
{
    (void)err;
    HS_ON_THREADS(kick(fix));
    HS_ON_THREADS(drift(fix));
    hs_spheres_kick(fix->state, fix, fix->env->dt);
    hs_spheres_turn(fix->state, fix, fix->env->dt);
    return HS_OK;
}

static hs_status final_integrate(hs_fix *fix, hs_error *err)
{
    (void)err;
    HS_ON_THREADS(kick(fix));
    hs_spheres_kick(fix->state, fix, fix->env->dt);
    return HS_OK;
}

static const hs_keyword keywords[] = {HS_SPHERES_KEYWORDS, {NULL, 0, NULL, NULL}};

const hs_fix_style hs_fix_style_nve_sphere = {
    .about =
        {.name = "nve/sphere",
         .syntax = {.usage = "[keyword value ...]", .n_min = 0, .n_max = 0, .keywords = keywords},
         .summary = "integrate at constant energy, with the rotation of spheres",
         .details =
             "Moves the atoms as `fix nve` does, and their angular velocities by the torques on them, with the "
             "moment of inertia (2/5) m R^2 of a sphere (`disc`: (1/2) m R^2). Torques come from `fix langevin` "
             "with `omega yes`; without any, spheres turn freely. `update dipole` lets dipoles turn with their atoms, "
             "by mu + dt (omega x mu) brought back to its length, which turns by atan(omega dt); `update dipole/dlm` "
             "by five rotations about the axes, good to second order. All atoms of the group need a diameter greater "
             "than 0.",
         .reference = "A. Dullweber, B. Leimkuhler, R. McLachlan, J. Chem. Phys. 107, 5840 (1997), "
                      "doi:10.1063/1.474310",
         .example = "fix 1 all nve/sphere\nfix 2 all nve/sphere update dipole/dlm"},
    .state_size = sizeof(hs_spheres),
    .create = create,
    .init = init,
    .initial_integrate = initial_integrate,
    .final_integrate = final_integrate,
    .is_integrator = true,
    .allows_dynamic_group = true,
};
