/** What the fixes of overdamped motion share: words, constants, translation. */
#ifndef HS_FIX_BROWNIAN_MOTION_H
#define HS_FIX_BROWNIAN_MOTION_H

#include <math.h>
#include <string.h>

#include "kernel/motion.h"
#include "kernel/noise_fill.h"
#include "style/fix.h"

typedef struct brownian_state {
    double temperature, gamma_t;
    double gamma_r; /**< 0: not given */
    bool has_noise; /**< rng none: none */
    hs_noise_kind kind;
    hs_noise noise;
    double drift; /**< velocity of a unit force: 1/gamma_t; velocity/force */
    double kick;  /**< standard deviation of the velocity's noise, sqrt(2 D_t / dt); velocity */
    double turn;  /**< standard deviation of the rotation in a step about one axis, sqrt(2 D_r dt); radians */
} brownian_state;

#define BROWNIAN_KEYWORDS                                                                                              \
    {"rng", 1, "uniform|gaussian|none", "distribution of the noise; default uniform"},                                 \
    {                                                                                                                  \
        "gamma_t", 1, "<friction>", "translational friction, mass/time"                                                \
    }

/** A word that must be greater than 0, named. */
static inline hs_status brownian_positive(const hs_args *args, int i, const char *what, double *value, hs_error *err)
{
    HS_TRY(hs_arg_double(args, i, value, err));
    if (*value > 0.0) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "%s: the %s '%s' must be greater than 0", args->command, what, args->word[i]);
}

static inline hs_status brownian_create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    static const char *const kinds[] = {"uniform", "gaussian", "none", NULL};
    brownian_state *state = fix->state;
    int64_t seed;
    int kind = 0;
    HS_TRY(hs_syntax_check(&fix->style->about.syntax, args, false, err));
    HS_TRY(brownian_positive(args, 0, "temperature", &state->temperature, err));
    HS_TRY(hs_arg_int(args, 1, 1, INT32_MAX, &seed, err));
    for (int i = 2; i < args->n; i += 2) {
        if (strcmp(args->word[i], "rng") == 0)
            HS_TRY(hs_arg_choice(args, i + 1, kinds, &kind, err));
        else if (strcmp(args->word[i], "gamma_t") == 0)
            HS_TRY(brownian_positive(args, i + 1, "friction gamma_t", &state->gamma_t, err));
        else
            HS_TRY(brownian_positive(args, i + 1, "friction gamma_r", &state->gamma_r, err));
    }
    if (state->gamma_t == 0.0)
        return hs_fail(err, HS_ERROR_INPUT, "%s: the friction is missing: 'gamma_t <friction>'", args->command);
    state->has_noise = kind != 2;
    state->kind = kind == 1 ? HS_NOISE_GAUSSIAN : HS_NOISE_UNIFORM;
    return hs_fix_noise(fix, seed, &state->noise, err);
}

static inline hs_status brownian_init(hs_fix *fix, hs_error *err)
{
    brownian_state *state = fix->state;
    const hs_env *env = fix->env;
    const double thermal = 2.0 * env->units->boltz * state->temperature / env->units->mvv2e;
    (void)err;
    state->drift = env->units->ftm2v / state->gamma_t;
    state->kick = sqrt(thermal / state->gamma_t / env->dt);
    state->turn = state->gamma_r > 0.0 ? sqrt(thermal / state->gamma_r * env->dt) : 0.0;
    return HS_OK;
}

/** Move the atoms [begin, begin + n) by the forces and the first numbers of the block; velocities become displacements
 *  per time. Atoms of other groups stay. */
static inline void brownian_translate(const hs_fix *fix, int begin, int n, const hs_noise_block *noise)
{
    const brownian_state *state = fix->state;
    const hs_env *env = fix->env;
    const hs_atoms *atoms = env->atoms;
    const hs_overdamped motion = {
        .drift = state->drift, .kick = state->kick, .dt = env->dt, .magic = env->position_magic};
    const uint32_t *group = fix->group == 0 ? NULL : atoms->mask + begin; /* group all: fewer instructions */
    for (int axis = 0; axis < env->box->dimension; ++axis)
        hs_isa_motion(env->isa)->translate(&motion, n, group, fix->mask, atoms->f[axis] + begin, noise->number[axis],
                                           atoms->x[axis] + begin, atoms->v[axis] + begin);
}

#define BROWNIAN_DETAILS                                                                                               \
    "`temp` is the temperature of the bath, `seed` a whole number from 1; the noise of an atom depends on the seed, "  \
    "the fix's ID, "                                                                                                   \
    "the step and the atom's ID alone. `rng uniform` (default) draws evenly spread numbers, which converge to the "    \
    "same "                                                                                                            \
    "motion and cost least; `gaussian` makes each step's displacement normal, so that free motion is exact for any "   \
    "timestep; `none` leaves the noise out.\n\n"                                                                       \
    "Velocities are set to displacement over timestep and mean nothing as kinetic energy. In two dimensions z stays."

#endif
