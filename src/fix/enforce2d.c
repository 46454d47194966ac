/* Keeps a two-dimensional system flat: no velocities, forces or rotations out of the plane. */
#include "style/fix.h"

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    HS_TRY(hs_syntax_check(&fix->style->about.syntax, args, false, err));
    if (fix->env->box->dimension == 2) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "%s: the simulation has three dimensions; 'dimension 2' makes it flat",
                   args->command);
}

/** 0 for the atoms of the group, shared by the threads; a[n_local] may be NULL. */
static void flatten(const hs_fix *fix, double *restrict a)
{
    const hs_atoms *atoms = fix->env->atoms;
    const uint32_t mask = fix->mask, *restrict group = atoms->mask;
    if (a == NULL) return;
    if (fix->group == 0) {
#pragma omp for simd schedule(static) nowait
        for (int i = 0; i < atoms->n_local; ++i) a[i] = 0.0;
        return;
    }
#pragma omp for schedule(static) nowait
    for (int i = 0; i < atoms->n_local; ++i) a[i] = group[i] & mask ? 0.0 : a[i];
}

/** Spheres turn about z alone. */
static void flatten_rotation(const hs_fix *fix)
{
    const hs_env *env = fix->env;
    for (int axis = 0; axis < 2; ++axis) {
        flatten(fix, env->atoms->omega[axis]);
        flatten(fix, env->torque[axis]);
    }
}

static void flatten_motion(const hs_fix *fix)
{
    flatten(fix, fix->env->atoms->v[2]);
    flatten(fix, fix->env->atoms->f[2]);
}

static hs_status setup(hs_fix *fix, hs_error *err)
{
    (void)err;
    HS_ON_THREADS(flatten_rotation(fix));
    return HS_OK;
}

static hs_status post_force(hs_fix *fix, hs_error *err)
{
    (void)err;
    if (!fix->env->is_planar) HS_ON_THREADS(flatten_motion(fix));
    /* without torques angular velocities stay as they were at set-up */
    if (fix->env->torque[0] != NULL) HS_ON_THREADS(flatten_rotation(fix));
    return HS_OK;
}

const hs_fix_style hs_fix_style_enforce2d = {
    .about = {.name = "enforce2d",
              .syntax = {.usage = "", .n_min = 0, .n_max = 0},
              .summary = "keep a two-dimensional system flat",
              .details = "Sets the z velocity and the z force of the group's atoms to 0 at every step, after all "
                         "forces, and angular velocities of spheres about x and y. Define it after fixes that may add "
                         "forces along z. Halfshell's pair forces and noise have no z part in two dimensions, so it is "
                         "needed only where a deck itself gives atoms one.",
              .example = "fix flat all enforce2d"},
    .create = create,
    .setup = setup,
    .post_force = post_force,
    .acts_in_minimize = true,
    .allows_dynamic_group = true,
    .keeps_plane = true,
};
