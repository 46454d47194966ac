/* Chooses the length of steps so that no atom moves farther than a distance in one of them.
 *
 * For each atom the time is the smaller of those in which its velocity alone, and its acceleration alone, would carry
 * it so far, x/v and sqrt(2 x/a); if both together carry it farther in that time, it is shortened by the ratio of the
 * distances. `emax` limits the work that the force does, |F| |v| dt, besides. */
#include <math.h>
#include <string.h>

#include "core/atom_style.h"
#include "core/lattice.h"
#include "style/fix.h"

typedef struct reset_state {
    int64_t every;
    double limit[2]; /**< least and largest timestep, time */
    double x_max;    /**< distance */
    double work_max; /**< energy; INFINITY: not limited */
    int64_t changed_at;
} reset_state;

static const hs_keyword keywords[] = {
    {"emax", 1, "<energy>", "largest work, |F| |v| dt, that may be done on an atom in a step (default: any)"},
    {"units", 1, "lattice|box", "the distance is in lattice spacings (default) or in distance units"},
    {NULL, 0, NULL, NULL},
};

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    reset_state *state = fix->state;
    HS_TRY(hs_syntax_check(&fix->style->about.syntax, args, false, err));
    HS_TRY(hs_arg_int(args, 0, 1, INT64_MAX, &state->every, err));
    state->limit[1] = INFINITY;
    for (int k = 0; k < 2; ++k)
        if (strcmp(args->word[1 + k], "NULL") != 0) HS_TRY(hs_arg_positive(args, 1 + k, &state->limit[k], err));
    if (state->limit[0] >= state->limit[1]) return hs_arg_refuse(args, 2, "greater than the least timestep", NULL, err);
    HS_TRY(hs_arg_positive(args, 3, &state->x_max, err));
    bool is_box = false;
    state->work_max = INFINITY;
    for (int i = 4; i < args->n; i += 2) {
        if (strcmp(args->word[i], "emax") == 0)
            HS_TRY(hs_arg_positive(args, i + 1, &state->work_max, err));
        else
            is_box = strcmp(args->word[i + 1], "box") == 0;
    }
    if (!is_box) state->x_max *= fix->env->lattice->spacing[0];
    state->changed_at = fix->env->step;
    return HS_OK;
}

/** Time in which local atom i moves as far as it may. */
static double time_of(const hs_fix *fix, int i)
{
    const reset_state *state = fix->state;
    const double x_max = state->x_max;
    const hs_atoms *atoms = fix->env->atoms;
    const double to_acceleration = fix->env->units->ftm2v / hs_atom_mass(atoms, i);
    double v2 = 0.0, f2 = 0.0, moved2 = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        v2 += atoms->v[axis][i] * atoms->v[axis][i];
        f2 += atoms->f[axis][i] * atoms->f[axis][i];
    }
    const double by_velocity = v2 > 0.0 ? x_max / sqrt(v2) : INFINITY;
    const double by_force = f2 > 0.0 ? sqrt(2.0 * x_max / (to_acceleration * sqrt(f2))) : INFINITY;
    const double by_work = v2 * f2 > 0.0 ? state->work_max / sqrt(v2 * f2) : INFINITY;
    const double time = fmin(fmin(by_velocity, by_force), by_work);
    if (isinf(time)) return time;
    for (int axis = 0; axis < 3; ++axis) {
        const double moved = time * atoms->v[axis][i] + 0.5 * time * time * to_acceleration * atoms->f[axis][i];
        moved2 += moved * moved;
    }
    return moved2 > x_max * x_max ? time * (x_max / sqrt(moved2)) : time;
}

static hs_status choose(hs_fix *fix, hs_error *err)
{
    reset_state *state = fix->state;
    hs_env *env = fix->env;
    const hs_atoms *atoms = env->atoms;
    double shortest = INFINITY;
#pragma omp parallel for schedule(static) reduction(min : shortest)
    for (int i = 0; i < atoms->n_local; ++i)
        if (atoms->mask[i] & fix->mask) shortest = fmin(shortest, time_of(fix, i));
    double most = -shortest;
    hs_parallel_max_double(env->parallel, &most, 1);
    const double dt = fmin(fmax(-most, state->limit[0]), state->limit[1]);
    if (isinf(dt))
        return hs_fail(err, HS_ERROR_RUN,
                       "%s: nothing moves and no force acts at step %lld, so any timestep would do; give the largest "
                       "one that is allowed",
                       hs_fix_who(fix).text, (long long)env->step);
    if (dt == env->dt) return HS_OK;
    state->changed_at = env->step;
    return env->set_timestep(env, dt, err);
}

static hs_status end_of_step(hs_fix *fix, hs_error *err)
{
    return fix->env->step % ((const reset_state *)fix->state)->every == 0 ? choose(fix, err) : HS_OK;
}

static hs_status scalar(hs_fix *fix, double *value, hs_error *err)
{
    (void)err;
    *value = (double)((const reset_state *)fix->state)->changed_at;
    return HS_OK;
}

static hs_status keep_state(hs_fix *fix, hs_state *kept, hs_error *err)
{
    return hs_state_int64(kept, "changed at", &((reset_state *)fix->state)->changed_at, 1, err);
}

const hs_fix_style hs_fix_style_dt_reset = {
    .about = {.name = "dt/reset",
              .syntax = {.usage = "<N> <Tmin>|NULL <Tmax>|NULL <Xmax> [emax <energy>] [units lattice|box]",
                         .n_min = 4,
                         .n_max = 4,
                         .keywords = keywords},
              .summary = "choose the timestep so that no atom moves too far in one",
              .details =
                  "Before a run and at steps that are multiples of N the timestep becomes the longest in which no atom "
                  "of the group would move farther than Xmax (in lattice spacings unless `units box` is said), judged "
                  "by its present velocity and force; not below Tmin and not above Tmax (NULL: no such limit). "
                  "`emax` also limits the work |F| |v| dt that a force can do on an atom in a step (energy). It "
                  "takes the place of `timestep`. For starts with overlapping atoms and for fast collisions.\n\n"
                  "`f_ID` is the step at which the timestep was last changed. The thermo keywords `dt` and `time` "
                  "follow; ramps go by steps, not by time.",
              .example = "fix 1 all nve\nfix 2 all dt/reset 10 1e-6 0.005 0.05 units box"},
    .state_size = sizeof(reset_state),
    .create = create,
    .measure_at_setup = choose,
    .end_of_step = end_of_step,
    .scalar = scalar,
    .keep_state = keep_state,
    .allows_dynamic_group = true,
    .keeps_plane = true,
};
