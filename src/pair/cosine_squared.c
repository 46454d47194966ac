/* Attraction of a squared cosine, with or without a repulsive core:
 *     sigma <= r < r_c:  U(r) = -eps cos^2(pi (r - sigma)/(2 (r_c - sigma)))
 *     r < sigma:         U(r) = -eps;  with `wca`:  U(r) = eps ((sigma/r)^12 - 2 (sigma/r)^6)
 * and with `wca` and r_c = sigma the core alone, raised by eps.
 * Source: I. R. Cooke, K. Kremer, M. Deserno, Phys. Rev. E 72, 011506 (2005), doi:10.1103/PhysRevE.72.011506.
 * Units: eps energy, sigma and r_c distance. */
#include "kernel/evaluator.h"
#include "kernel/vector_math.h"

enum { HALF_DEPTH, SLOPE, SIGMA, PER_WIDTH, SIGMA2, CORE, N_PARAMS };

/* cos^2 is half of 1 + cos of twice the angle; inside of sigma the angle stays 0 */
HS_EVALUATE(const hs_vec *p, hs_vec r2, hs_vec *force_over_r, hs_vec *energy, bool with_energy)
{
    const hs_vec square = hs_max(r2, hs_set1(HS_TINY_R2)), r = hs_sqrt(square);
    const hs_vec turn = hs_max(r - p[SIGMA], hs_set1(0.0)) * p[PER_WIDTH];
    hs_vec sine, cosine;
    hs_sincospi(hs_min(turn, hs_set1(1.0)), &sine, &cosine);
    const hs_vec s2 = p[SIGMA2] / square, s6 = s2 * s2 * s2;
    const hs_vec core = hs_select(hs_less(square, p[SIGMA2]), p[CORE], hs_set1(0.0));
    *force_over_r = core * (hs_set1(12.0) * s6 * (s6 - hs_set1(1.0))) / square - p[SLOPE] * sine / r;
    if (with_energy)
        *energy = core * hs_fma(s6, s6 - hs_set1(2.0), hs_set1(1.0)) - p[HALF_DEPTH] * (hs_set1(1.0) + cosine);
}

#define HS_EVALUATOR cosine_squared
#include "kernel/instantiate.h"

#ifndef HS_KERNEL_ISA

#include <string.h>

#include "pair/lj_coeffs.h"

/** Coefficient behind epsilon and sigma: 1 with a core. */
enum { HAS_CORE = HS_LJ_N_COEFFS };

static hs_status coeff(hs_pair *pair, int i, int j, const hs_args *args, hs_error *err)
{
    static const char *const wca[] = {"wca", NULL};
    hs_pair_coeff c = {.cutoff = 0.0};
    int n = args->n, unused;
    if (n > 2 && strcmp(args->word[n - 1], "wca") == 0) {
        c.c[HAS_CORE] = 1.0;
        --n;
    } else if (n == 4) {
        HS_TRY(hs_arg_choice(args, 3, wca, &unused, err));
    }
    HS_TRY(hs_arg_double(args, 0, &c.c[HS_LJ_EPSILON], err));
    HS_TRY(hs_arg_positive(args, 1, &c.c[HS_LJ_SIGMA], err));
    c.cutoff = ((hs_pair_coeffs *)pair->state)->cutoff;
    if (n > 2) HS_TRY(hs_arg_positive(args, 2, &c.cutoff, err));
    if (c.cutoff < c.c[HS_LJ_SIGMA] || (c.cutoff == c.c[HS_LJ_SIGMA] && c.c[HAS_CORE] == 0.0))
        return hs_fail(err, HS_ERROR_INPUT, "%s: the cutoff %g must be larger than sigma, %g (or equal, with wca)",
                       args->command, c.cutoff, c.c[HS_LJ_SIGMA]);
    *hs_pair_coeffs_at(pair, i, j) = c;
    return HS_OK;
}

static void params(const hs_pair *pair, int i, int j, double *cutoff, double *p)
{
    const hs_pair_coeff *c = hs_pair_coeffs_at(pair, i, j);
    const double epsilon = c->c[HS_LJ_EPSILON], sigma = c->c[HS_LJ_SIGMA], width = c->cutoff - sigma;
    const double depth = width > 0.0 ? epsilon : 0.0;
    *cutoff = c->cutoff;
    p[HALF_DEPTH] = 0.5 * depth;
    p[PER_WIDTH] = width > 0.0 ? 1.0 / width : 0.0;
    p[SLOPE] = 0.5 * depth * M_PI * p[PER_WIDTH];
    p[SIGMA] = sigma;
    p[SIGMA2] = sigma * sigma;
    p[CORE] = c->c[HAS_CORE] * epsilon;
}

static hs_status write_coeff(const hs_pair *pair, int i, int j, hs_text *words, hs_error *err)
{
    const hs_pair_coeff *c = hs_pair_coeffs_at(pair, i, j);
    return hs_text_printf(words, err, "%.17g %.17g %.17g%s", c->c[HS_LJ_EPSILON], c->c[HS_LJ_SIGMA], c->cutoff,
                          c->c[HAS_CORE] != 0.0 ? " wca" : "");
}

const hs_pair_style hs_pair_style_cosine_squared = {
    .about =
        {.name = "cosine/squared",
         .syntax = {.usage = "<cutoff>", .n_min = 1, .n_max = 1},
         .summary = "broad attraction of a squared cosine, for lipids without solvent",
         .details =
             "U(r) = -epsilon cos^2[pi (r - sigma)/(2 (cutoff - sigma))] for sigma <= r < cutoff, 0 beyond, and "
             "-epsilon within sigma; with `wca` there is a repulsive core instead, U(r) = epsilon [(sigma/r)^12 - 2 "
             "(sigma/r)^6] for r < sigma. A cutoff of sigma and `wca` leave the core alone, raised by epsilon.\n\n"
             "`pair_coeff I J <epsilon> <sigma> [<cutoff>] [wca]`: energy and distance; the minimum is at sigma. "
             "Energy and force end smoothly, so there is nothing to shift. Unlike pairs are not mixed: every pair of "
             "types must be given.",
         .reference =
             "I. R. Cooke, K. Kremer, M. Deserno, Phys. Rev. E 72, 011506 (2005), doi:10.1103/PhysRevE.72.011506",
         .example = "pair_style cosine/squared 2.7\npair_coeff * * 1.0 1.122462 wca\npair_coeff 1 2 1.0 1.06 1.06 wca"},
    .coeff_syntax = {.usage = "<epsilon> <sigma> [<cutoff>] [wca]", .n_min = 2, .n_max = 4},
    .adaptable = HS_LJ_ADAPTABLE,
    .state_size = sizeof(hs_pair_coeffs),
    .settings = hs_pair_coeffs_settings,
    .destroy = hs_pair_coeffs_destroy,
    .coeff = coeff,
    .params = params,
    .write_coeff = write_coeff,
    .evaluator = &hs_evaluator_cosine_squared,
};

#endif
