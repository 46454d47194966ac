/* Velocity Verlet in which no atom moves farther than a limit in one step: for starts from overlapping atoms. */
#include <math.h>

#include "core/atom_style.h"
#include "style/fix.h"

typedef struct limit_state {
    double x_max;      /**< distance */
    int64_t n_limited; /**< times that a velocity was cut, on this rank */
} limit_state;

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    HS_TRY(hs_syntax_check(&fix->style->about.syntax, args, false, err));
    return hs_arg_positive(args, 0, &((limit_state *)fix->state)->x_max, err);
}

static void move_share(hs_fix *fix, bool drift)
{
    limit_state *state = fix->state;
    const hs_atoms *atoms = fix->env->atoms;
    const double dt = fix->env->dt, half_dt = 0.5 * dt * fix->env->units->ftm2v, v_max = state->x_max / dt;
    int64_t n_limited = 0;
#pragma omp for schedule(static) nowait
    for (int i = 0; i < atoms->n_local; ++i) {
        if (!(atoms->mask[i] & fix->mask)) continue;
        const double kick = half_dt / hs_atom_mass(atoms, i);
        double v[3], v2 = 0.0;
        for (int axis = 0; axis < 3; ++axis) {
            v[axis] = atoms->v[axis][i] + kick * atoms->f[axis][i];
            v2 += v[axis] * v[axis];
        }
        const bool is_limited = v2 > v_max * v_max;
        const double scale = is_limited ? v_max / sqrt(v2) : 1.0;
        n_limited += is_limited;
        for (int axis = 0; axis < 3; ++axis) {
            atoms->v[axis][i] = scale * v[axis];
            if (drift)
                atoms->x[axis][i] = hs_moved(atoms->x[axis][i], dt * atoms->v[axis][i], fix->env->position_magic);
        }
    }
#pragma omp atomic
    state->n_limited += n_limited;
}

/** v += (dt/2) f/m, cut to x_max/dt, and with @p drift x += dt v. */
static void move(hs_fix *fix, bool drift) { HS_ON_THREADS(move_share(fix, drift)); }

static hs_status initial_integrate(hs_fix *fix, hs_error *err)
{
    (void)err;
    move(fix, true);
    return HS_OK;
}

static hs_status final_integrate(hs_fix *fix, hs_error *err)
{
    (void)err;
    move(fix, false);
    return HS_OK;
}

static hs_status scalar(hs_fix *fix, double *value, hs_error *err)
{
    int64_t n = ((limit_state *)fix->state)->n_limited;
    (void)err;
    hs_parallel_sum_int64(fix->env->parallel, &n, 1);
    *value = (double)n;
    return HS_OK;
}

const hs_fix_style hs_fix_style_nve_limit = {
    .about =
        {.name = "nve/limit",
         .syntax = {.usage = "<distance>", .n_min = 1, .n_max = 1},
         .summary = "integrate with a limit to how far an atom moves in a step",
         .details =
             "Velocity Verlet as in `fix nve`, but a velocity that would move an atom farther than the distance in "
             "a timestep is cut to that size. Energy is not conserved where that happens: it is meant for the "
             "first steps from a start in which atoms overlap. The scalar `f_ID` counts the cuts.",
         .example = "fix 1 all nve/limit 0.05"},
    .state_size = sizeof(limit_state),
    .create = create,
    .initial_integrate = initial_integrate,
    .final_integrate = final_integrate,
    .scalar = scalar,
    .is_extensive = true,
    .is_integrator = true,
    .allows_dynamic_group = true,
    .keeps_plane = true,
};
