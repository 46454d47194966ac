/* Friction against a resting medium:  F = -gamma v. */

#include "base/memory.h"
#include "style/fix.h"

typedef struct viscous_state {
    double *gamma; /**< owned [n_types + 1]: force/velocity, by type */
} viscous_state;

static const hs_keyword keywords[] = {
    {"scale", 2, "<type> <ratio>", "multiply gamma of atoms of this type; may be repeated"},
    {NULL, 0, NULL, NULL},
};

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    viscous_state *state = fix->state;
    const int n_types = fix->env->atoms->n_types;
    double gamma;
    HS_TRY(hs_syntax_check(&fix->style->about.syntax, args, false, err));
    HS_TRY(hs_arg_double(args, 0, &gamma, err));
    HS_TRY(HS_ALLOC(state->gamma, (size_t)n_types + 1, err));
    for (int type = 1; type <= n_types; ++type) state->gamma[type] = gamma;
    for (int i = 1; i + 2 < args->n; i += 3) {
        int64_t type;
        double ratio;
        HS_TRY(hs_arg_type(args, i + 1, n_types, &type, err));
        HS_TRY(hs_arg_double(args, i + 2, &ratio, err));
        state->gamma[type] = gamma * ratio;
    }
    return HS_OK;
}

static void destroy(hs_fix *fix) { HS_FREE(((viscous_state *)fix->state)->gamma); }

static void drag(const hs_fix *fix)
{
    const double *gamma = ((const viscous_state *)fix->state)->gamma;
    const hs_atoms *atoms = fix->env->atoms;
#pragma omp for schedule(static) nowait
    for (int i = 0; i < atoms->n_local; ++i) {
        if (!(atoms->mask[i] & fix->mask)) continue;
        for (int axis = 0; axis < 3; ++axis) atoms->f[axis][i] -= gamma[atoms->type[i]] * atoms->v[axis][i];
    }
}

static hs_status post_force(hs_fix *fix, hs_error *err)
{
    (void)err;
    HS_ON_THREADS(drag(fix));
    return HS_OK;
}

const hs_fix_style hs_fix_style_viscous = {
    .about =
        {.name = "viscous",
         .syntax = {.usage = "<gamma> [scale <type> <ratio>] ...", .n_min = 1, .n_max = 1, .keywords = keywords},
         .summary = "friction against a resting medium",
         .details =
             "Adds -gamma v to the force on each atom of the group; gamma is a force over a velocity (in lj units "
             "1/time times mass), and a negative one drives atoms. It takes energy out of collisions and lets systems "
             "come to rest; `fix langevin` adds the noise of a bath to it. `scale` sets gamma of one type to that many "
             "times the first number. Force over velocity is meant: gamma v must be small against what moves the "
             "atoms, and gamma dt/m against 1. It acts in minimisations that have velocities (`min_style fire`), too.",
         .example = "fix 1 all nve\nfix 2 all viscous 0.5\nfix 3 big viscous 1.0 scale 2 2.5"},
    .state_size = sizeof(viscous_state),
    .create = create,
    .destroy = destroy,
    .post_force = post_force,
    .acts_in_minimize = true,
    .allows_dynamic_group = true,
    .keeps_plane = true,
};
