/* Atoms that go straight on at constant velocity: x += dt v, whatever the forces on them. */
#include "style/fix.h"

static void drift(const hs_fix *fix)
{
    const hs_env *env = fix->env;
    const hs_atoms *atoms = env->atoms;
#pragma omp for schedule(static) nowait
    for (int i = 0; i < atoms->n_local; ++i)
        for (int axis = 0; axis < 3 && atoms->mask[i] & fix->mask; ++axis)
            atoms->x[axis][i] = hs_moved(atoms->x[axis][i], env->dt * atoms->v[axis][i], env->position_magic);
}

static hs_status initial_integrate(hs_fix *fix, hs_error *err)
{
    (void)err;
    HS_ON_THREADS(drift(fix));
    return HS_OK;
}

const hs_fix_style hs_fix_style_nve_noforce = {
    .about = {.name = "nve/noforce",
              .syntax = {.usage = "", .n_min = 0, .n_max = 0},
              .summary = "move atoms at constant velocity",
              .details =
                  "The atoms of the group keep the velocities they have (`velocity set`, `velocity ramp`), and go "
                  "on by v dt in each step. Forces on them are computed as ever, and do nothing: for walls of "
                  "atoms. `fix move` has other paths.",
              .example = "velocity wall set 0.5 0 0\nfix 2 wall nve/noforce"},
    .initial_integrate = initial_integrate,
    .is_integrator = true,
    .allows_dynamic_group = true,
    .keeps_plane = true,
};
