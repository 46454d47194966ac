/** What the fixes of overdamped motion share: words, constants, translation. */
#ifndef HS_FIX_BROWNIAN_MOTION_H
#define HS_FIX_BROWNIAN_MOTION_H

#include <math.h>
#include <string.h>

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

/** One axis of brownian_translate; without @p is_all, atoms of other groups stay. */
static inline void brownian_translate_axis(const brownian_state *state, double dt, double magic,
                                           const uint32_t *restrict group, uint32_t mask, int n,
                                           const double *restrict f, const double *restrict number, double *restrict x,
                                           double *restrict v, const bool is_all)
{
    const double drift = state->drift, kick = state->kick;
    for (int i = 0; i < n; ++i) {
        const bool is_moved = is_all || (group[i] & mask) != 0;
        const double v_new = drift * f[i] + kick * number[i];
        v[i] = is_moved ? v_new : v[i];
        x[i] = is_moved ? hs_moved(x[i], dt * v_new, magic) : x[i];
    }
}

/** Move the atoms [begin, begin + n) by the forces and the first numbers of the block; velocities become displacements
 *  per time. Atoms of other groups stay. */
static inline void brownian_translate(const hs_fix *fix, int begin, int n, const hs_noise_block *noise)
{
    const hs_atoms *atoms = fix->env->atoms;
    const double dt = fix->env->dt;
    const uint32_t *group = atoms->mask + begin;
    for (int axis = 0; axis < fix->env->box->dimension; ++axis) {
        double *x = atoms->x[axis] + begin, *v = atoms->v[axis] + begin;
        const double *f = atoms->f[axis] + begin, *number = noise->number[axis];
        if (fix->group == 0) /* group all: half as many instructions */
            brownian_translate_axis(fix->state, dt, fix->env->position_magic, group, fix->mask, n, f, number, x, v,
                                    true);
        else
            brownian_translate_axis(fix->state, dt, fix->env->position_magic, group, fix->mask, n, f, number, x, v,
                                    false);
    }
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
