/** What fixes heat and ehex share: how much heat, how often and where; the motion of their atoms relative to the center
 *  of mass, and the factor by which it must be scaled to take up an amount of heat. */
#ifndef HS_FIX_THERMAL_MOTION_H
#define HS_FIX_THERMAL_MOTION_H

#include <math.h>

#include "core/atom_style.h"
#include "style/atom_sum.h"
#include "style/region.h"
#include "style/varying.h"

/** State of such a fix, or its first member. */
typedef struct thermal_state {
    int64_t every;
    hs_varying rate; /**< energy/time */
    hs_where where;
    double scale; /**< factor on the velocities, of the latest step it acted */
} thermal_state;

static inline void thermal_destroy(hs_fix *fix)
{
    thermal_state *state = fix->state;
    hs_varying_fini(&state->rate);
    hs_where_fini(&state->where);
}

static inline hs_status thermal_find_region(hs_fix *fix, hs_error *err)
{
    return hs_where_find(&((thermal_state *)fix->state)->where, fix->env, hs_fix_who(fix).text, err);
}

static inline hs_status thermal_init(hs_fix *fix, hs_error *err)
{
    HS_TRY(hs_varying_check(&((thermal_state *)fix->state)->rate, fix, err));
    return thermal_find_region(fix, err);
}

static inline hs_status thermal_scalar(hs_fix *fix, double *value, hs_error *err)
{
    (void)err;
    *value = ((thermal_state *)fix->state)->scale;
    return HS_OK;
}

static inline hs_status thermal_keep_state(hs_fix *fix, hs_state *kept, hs_error *err)
{
    return hs_state_double(kept, "scale", &((thermal_state *)fix->state)->scale, 1, err);
}

/** Hooks that are the same in both. */
#define THERMAL_HOOKS                                                                                                  \
    .destroy = thermal_destroy, .init = thermal_init, .keep_state = thermal_keep_state, .scalar = thermal_scalar

/** Whether local atom i takes part. */
typedef bool (*thermal_acts)(const hs_fix *fix, int i);

typedef struct thermal_motion {
    double mass;  /**< of all that take part; 0: there are none, and nothing else is set */
    double v[3];  /**< of their center of mass, distance/time */
    double ke;    /**< relative to it, mass velocity^2 */
    double scale; /**< of the relative velocities, after the heat */
} thermal_motion;

enum { THERMAL_MASS, THERMAL_MOMENTUM, THERMAL_MV2 = THERMAL_MOMENTUM + 3, THERMAL_N_SUMS };

typedef struct thermal_context {
    const hs_fix *fix;
    thermal_acts acts;
} thermal_context;

static inline void thermal_add_terms(const hs_atoms *atoms, const void *context, int begin, int end, hs_exact_sum *sums)
{
    const thermal_context *c = context;
    for (int i = begin; i < end; ++i) {
        if (!c->acts(c->fix, i)) continue;
        const double m = hs_atom_mass(atoms, i), v[3] = {atoms->v[0][i], atoms->v[1][i], atoms->v[2][i]};
        hs_exact_add(&sums[THERMAL_MASS], m);
        for (int axis = 0; axis < 3; ++axis) hs_exact_add(&sums[THERMAL_MOMENTUM + axis], m * v[axis]);
        hs_exact_add(&sums[THERMAL_MV2], m * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]));
    }
}

/** Find the motion, and what becomes of it with @p heat (mass velocity^2); an error when it has not so much to give
 *  (collective). */
static inline hs_status thermal_find(hs_fix *fix, thermal_acts acts, double heat, thermal_motion *motion, hs_error *err)
{
    const hs_env *env = fix->env;
    const thermal_context context = {.fix = fix, .acts = acts};
    double sums[THERMAL_N_SUMS], drift = 0.0;
    HS_TRY(hs_where_update(&((const thermal_state *)fix->state)->where, err));
    hs_atom_sum(env->atoms, env->parallel, thermal_add_terms, &context, THERMAL_N_SUMS, sums);
    motion->mass = sums[THERMAL_MASS];
    if (!(motion->mass > 0.0)) return HS_OK;
    for (int axis = 0; axis < 3; ++axis) {
        motion->v[axis] = sums[THERMAL_MOMENTUM + axis] / motion->mass;
        drift += 0.5 * motion->mass * motion->v[axis] * motion->v[axis];
    }
    motion->ke = 0.5 * sums[THERMAL_MV2] - drift;
    if (!(motion->ke + heat >= 0.0) || !(motion->ke > 0.0))
        return hs_fail(err, HS_ERROR_RUN,
                       "%s: at step %lld the atoms have the energy %g in their thermal motion, which is not enough to "
                       "take %g from it",
                       hs_fix_who(fix).text, (long long)env->step, motion->ke * env->units->mvv2e,
                       -heat * env->units->mvv2e);
    motion->scale = sqrt((motion->ke + heat) / motion->ke);
    return HS_OK;
}

#endif
