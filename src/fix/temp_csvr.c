/* Canonical sampling by rescaling: the velocities of a group are scaled so that its kinetic energy makes a random
 * walk whose distribution is the canonical one, and which forgets where it was in the damping time. With c =
 * exp(-dt/Tdamp), n degrees of freedom, and the wanted over the present temperature in q = T_wanted/(n T),
 *     T'/T = c + (1 - c) q (R_1^2 + ... + R_n^2) + 2 R_1 sqrt(c (1 - c) q),      R_i normal.
 * Source: G. Bussi, D. Donadio, M. Parrinello, J. Chem. Phys. 126, 014101 (2007), doi:10.1063/1.2408420, eq. (A7). */
#include "core/noise.h"
#include "fix/velocity_scaling.h"

typedef struct csvr_state {
    velocity_scaling scaling; /* first: velocity_scaling.h takes the state as one */
    double damping;           /**< time */
    hs_noise noise;
} csvr_state;

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    csvr_state *state = fix->state;
    int64_t seed;
    HS_TRY(hs_syntax_check(&fix->style->about.syntax, args, false, err));
    HS_TRY(hs_arg_positive(args, 2, &state->damping, err));
    HS_TRY(hs_arg_int(args, 3, 1, INT64_MAX, &seed, err));
    HS_TRY(hs_fix_noise(fix, seed, &state->noise, err));
    return scaling_create(fix, args, 0, err);
}

/** Sum of the squares of n normal numbers, n > 1: twice a gamma variate of shape n/2.
 *  Source: G. Marsaglia, W. W. Tsang, ACM Trans. Math. Softw. 26, 363 (2000), doi:10.1145/358407.358414. */
static double sum_of_squares(hs_noise noise, int64_t step, double n)
{
    const double d = 0.5 * n - 1.0 / 3.0, c = 1.0 / sqrt(9.0 * d);
    for (int64_t attempt = 1;; ++attempt) {
        double normal[HS_NOISE_NUMBERS];
        uint32_t word[HS_NOISE_NUMBERS];
        hs_noise_numbers(noise, HS_NOISE_GAUSSIAN, step, 1, attempt, normal);
        hs_noise_words(noise, step, 2, attempt, word);
        const double x = normal[0], root = 1.0 + c * x, v = root * root * root, u = ldexp(word[0] + 0.5, -32);
        if (v > 0.0 && log(u) < 0.5 * x * x + d - d * v + d * log(v)) return 2.0 * d * v;
    }
}

static hs_status end_of_step(hs_fix *fix, hs_error *err)
{
    const csvr_state *state = fix->state;
    const int64_t step = hs_fix_clock(fix);
    hs_compute *temperature;
    double wanted, measured, normal[HS_NOISE_NUMBERS];
    HS_TRY(scaling_measure(fix, &temperature, &wanted, &measured, err));
    if (measured == 0.0) return HS_OK;
    hs_noise_numbers(state->noise, HS_NOISE_GAUSSIAN, step, 0, 1, normal);
    const double c = exp(-fix->env->dt / state->damping), n = temperature->n_dof, q = wanted / (n * measured),
                 r = normal[0],
                 others = n > 2.0   ? sum_of_squares(state->noise, step, n - 1.0)
                          : n > 1.0 ? normal[1] * normal[1]
                                    : 0.0;
    const double growth = c + (1.0 - c) * q * (r * r + others) + 2.0 * r * sqrt(c * (1.0 - c) * q);
    scaling_apply(fix, temperature, measured, measured * growth);
    return HS_OK;
}

const hs_fix_style hs_fix_style_temp_csvr = {
    .about =
        {.name = "temp/csvr",
         .syntax = {.usage = "<Tstart> <Tstop> <Tdamp> <seed>", .n_min = 4, .n_max = 4},
         .summary = "canonical thermostat that scales velocities (Bussi)",
         .details =
             "At every step the velocities of the group are scaled by a factor with a random part, so that the kinetic "
             "energy has the canonical distribution of the wanted temperature and forgets its past in Tdamp, a time. "
             "Unlike temp/berendsen it gives the canonical ensemble; and as one factor scales all velocities, it "
             "disturbs the dynamics of single atoms little.\n\nThe wanted temperature goes from Tstart to Tstop over "
             "the run (or from `run start` to `run stop`); Tstart may be an equal-style variable `v_name`, which then "
             "is the temperature at every step. The fix moves nothing: use it with `fix nve`. The temperature is that "
             "of the group, the compute `ID_temp` that the fix makes, or that of `fix_modify temp`; of a temperature "
             "that leaves out a part of the velocities only the thermal part is scaled. The random numbers are "
             "functions of seed, ID and step: any threads, ranks and restarts give the same. The scalar `f_ID` is the "
             "energy taken from the atoms so far: with theirs it is constant but for the integrator's error.",
         .reference = "G. Bussi, D. Donadio, M. Parrinello, J. Chem. Phys. 126, 014101 (2007), doi:10.1063/1.2408420",
         .example = "fix 1 all nve\nfix 2 all temp/csvr 1.0 1.0 0.1 4711"},
    .state_size = sizeof(csvr_state),
    .create = create,
    .end_of_step = end_of_step,
    SCALING_HOOKS,
    .allows_dynamic_group = true,
    .keeps_plane = true,
};
