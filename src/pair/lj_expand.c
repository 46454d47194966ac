/* Lennard-Jones 12-6 shifted along r by delta, for particles with hard cores of different size:
 *     U(r) = 4 eps ((sigma/s)^12 - (sigma/s)^6) - shift,  F(r)/r = 24 eps (2 (sigma/s)^12 - (sigma/s)^6) / (s r),  s =
 * r - delta, for s < r_c. Units: eps energy; sigma, delta and r_c distance. */
#include "kernel/evaluator.h"

enum { F12, MINUS_F6, U12, MINUS_U6, DELTA, SHIFT, N_PARAMS };

HS_EVALUATE(const hs_vec *p, hs_vec r2, hs_vec *force_over_r, hs_vec *energy, bool with_energy)
{
    const hs_vec r = hs_sqrt(r2), s = r - p[DELTA];
    const hs_vec inv_s2 = hs_set1(1.0) / (s * s);
    const hs_vec inv_s6 = inv_s2 * inv_s2 * inv_s2;
    *force_over_r = inv_s6 * hs_fma(p[F12], inv_s6, p[MINUS_F6]) / (s * r);
    if (with_energy) *energy = inv_s6 * hs_fma(p[U12], inv_s6, p[MINUS_U6]) - p[SHIFT];
}

#define HS_EVALUATOR lj_expand
#include "kernel/instantiate.h"

#ifndef HS_KERNEL_ISA

#include <math.h>

#include "style/pair_coeffs.h"

enum { EPSILON, SIGMA, LENGTH };

static hs_status coeff(hs_pair *pair, int i, int j, const hs_args *args, hs_error *err)
{
    hs_pair_coeff c = {.cutoff = 0.0};
    HS_TRY(hs_pair_coeffs_read(pair, "n0n", args, &c, err));
    if (c.cutoff + c.c[LENGTH] < 0.0) return hs_arg_refuse(args, 2, "a shift above minus the cutoff", NULL, err);
    *hs_pair_coeffs_at(pair, i, j) = c;
    return HS_OK;
}

static hs_status mix(hs_pair *pair, int i, int j, hs_error *err)
{
    const hs_pair_coeff a = *hs_pair_coeffs_at(pair, i, i), b = *hs_pair_coeffs_at(pair, j, j);
    (void)err;
    *hs_pair_coeffs_at(pair, i, j) = (hs_pair_coeff){
        .c = {hs_pair_mix_energy(pair->mix, a.c[EPSILON], b.c[EPSILON], a.c[SIGMA], b.c[SIGMA]),
              hs_pair_mix_distance(pair->mix, a.c[SIGMA], b.c[SIGMA]), 0.5 * (a.c[LENGTH] + b.c[LENGTH])},
        .cutoff = hs_pair_mix_distance(pair->mix, a.cutoff, b.cutoff)};
    return HS_OK;
}

static void params(const hs_pair *pair, int i, int j, double *cutoff, double *p)
{
    const hs_pair_coeff c = *hs_pair_coeffs_at(pair, i, j);
    const double epsilon = c.c[EPSILON], sigma6 = pow(c.c[SIGMA], 6.0);
    const double ratio6 = pair->shift && c.cutoff > 0.0 ? pow(c.c[SIGMA] / c.cutoff, 6.0) : 0.0;
    *cutoff = c.cutoff > 0.0 ? c.cutoff + c.c[LENGTH] : 0.0;
    p[F12] = 48.0 * epsilon * sigma6 * sigma6;
    p[MINUS_F6] = -24.0 * epsilon * sigma6;
    p[U12] = 4.0 * epsilon * sigma6 * sigma6;
    p[MINUS_U6] = -4.0 * epsilon * sigma6;
    p[DELTA] = c.c[LENGTH];
    p[SHIFT] = 4.0 * epsilon * ratio6 * (ratio6 - 1.0);
}

/** Integrals over s = r - delta from the cutoff of  2 pi r^2 U  and  -(2 pi / 3) r^3 dU/dr,  with r = s + delta. */
static void tail(const hs_pair *pair, int i, int j, double *energy, double *virial)
{
    const hs_pair_coeff c = *hs_pair_coeffs_at(pair, i, j);
    const double epsilon = c.c[EPSILON], sigma6 = pow(c.c[SIGMA], 6.0), d = c.c[LENGTH], rc = c.cutoff;
    *energy = *virial = 0.0;
    for (int n = 12; n >= 6; n -= 6) { /* terms of s^-n */
        const double u = n == 12 ? 4.0 * epsilon * sigma6 * sigma6 : -4.0 * epsilon * sigma6;
        *energy += 2.0 * M_PI * u *
                   (pow(rc, 3 - n) / (n - 3) + 2.0 * d * pow(rc, 2 - n) / (n - 2) + d * d * pow(rc, 1 - n) / (n - 1));
        *virial += 2.0 * M_PI / 3.0 * n * u *
                   (pow(rc, 3 - n) / (n - 3) + 3.0 * d * pow(rc, 2 - n) / (n - 2) +
                    3.0 * d * d * pow(rc, 1 - n) / (n - 1) + d * d * d * pow(rc, -n) / n);
    }
}

const hs_pair_style hs_pair_style_lj_expand = {
    .about =
        {.name = "lj/expand",
         .syntax = {.usage = "<cutoff>", .n_min = 1, .n_max = 1},
         .summary = "Lennard-Jones potential shifted along r, for large particles",
         .details =
             "U(r) = 4 epsilon [(sigma/(r - delta))^12 - (sigma/(r - delta))^6] for r < cutoff + delta, 0 beyond.\n\n"
             "`pair_coeff I J <epsilon> <sigma> <delta> [<cutoff>]`: energy, length, shift (distance, of either sign), "
             "and a cutoff for r - delta. `pair_modify shift yes` makes the energy zero at the cutoff; `tail yes` adds "
             "the long-range part. Unlike pairs are mixed: epsilon, sigma and cutoff as in lj/cut, delta by the "
             "arithmetic mean always.",
         .reference = NULL,
         .example = "pair_style lj/expand 2.5\npair_coeff * * 1.0 1.0 0.5\npair_coeff 1 2 1.0 1.0 -0.2 2.0"},
    .coeff_syntax = {.usage = "<epsilon> <sigma> <delta> [<cutoff>]", .n_min = 3, .n_max = 4},
    .adaptable = (const hs_pair_adaptable[]){{"epsilon", EPSILON}, {"sigma", SIGMA}, {"delta", LENGTH}, {NULL, 0}},
    HS_PAIR_COEFFS_HOOKS,
    .coeff = coeff,
    .mix = mix,
    .params = params,
    .tail = tail,
    .evaluator = &hs_evaluator_lj_expand,
};

#endif
