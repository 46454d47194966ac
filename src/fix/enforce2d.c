/* Keeps a two-dimensional system flat: no velocities, forces or rotations out of the plane. */
#include "style/fix.h"

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    HS_TRY(hs_syntax_check(&fix->style->about.syntax, args, false, err));
    if (fix->env->box->dimension == 2) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "%s: the simulation has three dimensions; 'dimension 2' makes it flat",
                   args->command);
}

static void flatten(const hs_fix *fix)
{
    const hs_atoms *atoms = fix->env->atoms;
    const uint32_t mask = fix->mask, *restrict group = atoms->mask;
    double *restrict v = atoms->v[2], *restrict f = atoms->f[2];
    if (fix->group == 0) {
#pragma omp for simd schedule(static) nowait
        for (int i = 0; i < atoms->n_local; ++i) v[i] = f[i] = 0.0;
        return;
    }
#pragma omp for schedule(static) nowait
    for (int i = 0; i < atoms->n_local; ++i) {
        v[i] = group[i] & mask ? 0.0 : v[i];
        f[i] = group[i] & mask ? 0.0 : f[i];
    }
}

/** Spheres turn about z alone. */
static void flatten_rotation(const hs_fix *fix)
{
    const hs_atoms *atoms = fix->env->atoms;
#pragma omp for schedule(static) nowait
    for (int i = 0; i < atoms->n_local; ++i) {
        if (!(atoms->mask[i] & fix->mask)) continue;
        for (int axis = 0; axis < 2; ++axis) {
            atoms->omega[axis][i] = 0.0;
            if (fix->env->torque[axis] != NULL) fix->env->torque[axis][i] = 0.0;
        }
    }
}

static hs_status post_force(hs_fix *fix, hs_error *err)
{
    (void)err;
    HS_ON_THREADS(flatten(fix));
    if (fix->env->atoms->omega[0] != NULL) HS_ON_THREADS(flatten_rotation(fix));
    return HS_OK;
}

const hs_fix_style hs_fix_style_enforce2d = {
    .about = {.name = "enforce2d",
              .syntax = {.usage = "", .n_min = 0, .n_max = 0},
              .summary = "keep a two-dimensional system flat",
              .details =
                  "Sets the z velocity and the z force of the group's atoms to 0 at every step, after all forces, "
                  "and angular velocities of spheres about x and y. "
                  "Define it after fixes that may add forces along z. Halfshell's pair forces and noise have no z "
                  "part in two dimensions, so it is needed only where a deck itself gives atoms one.",
              .example = "fix flat all enforce2d"},
    .create = create,
    .post_force = post_force,
    .acts_in_minimize = true,
    .allows_dynamic_group = true,
};
