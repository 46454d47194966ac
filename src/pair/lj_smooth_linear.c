/* Lennard-Jones 12-6 with a linear term that makes energy and force zero at the cutoff:
 *     U(r) = U_LJ(r) - U_LJ(r_c) - (r - r_c) U_LJ'(r_c),  F(r) = F_LJ(r) - F_LJ(r_c)   for r < r_c
 * Source: S. Toxvaerd, J. C. Dyre, J. Chem. Phys. 134, 081102 (2011), doi:10.1063/1.3558787. */
#include "kernel/evaluator.h"

enum { F12, MINUS_F6, U12, MINUS_U6, SLOPE, SHIFT, N_PARAMS };

HS_EVALUATE(const hs_vec *p, hs_vec r2, hs_vec *force_over_r, hs_vec *energy, bool with_energy)
{
    const hs_vec inv_r2 = hs_set1(1.0) / r2, r = hs_sqrt(r2);
    const hs_vec inv_r6 = inv_r2 * inv_r2 * inv_r2;
    *force_over_r = hs_fma(inv_r6, hs_fma(p[F12], inv_r6, p[MINUS_F6]), p[SLOPE] * r) * inv_r2;
    if (with_energy)
        *energy = hs_fma(inv_r6, hs_fma(p[U12], inv_r6, p[MINUS_U6]), hs_set1(0.0) - hs_fma(p[SLOPE], r, p[SHIFT]));
}

#define HS_EVALUATOR lj_smooth_linear
#include "kernel/instantiate.h"

#ifndef HS_KERNEL_ISA

#include <math.h>

#include "style/pair_coeffs.h"

enum { EPSILON, SIGMA, N_COEFFS };

static hs_status coeff(hs_pair *pair, int i, int j, const hs_args *args, hs_error *err)
{
    hs_pair_coeff c = {.cutoff = 0.0};
    HS_TRY(hs_arg_double(args, 0, &c.c[EPSILON], err));
    HS_TRY(hs_arg_not_negative(args, 1, &c.c[SIGMA], err));
    HS_TRY(hs_pair_coeffs_read_cutoff(pair, args, 2, &c.cutoff, err));
    *hs_pair_coeffs_at(pair, i, j) = c;
    return HS_OK;
}

static hs_status mix(hs_pair *pair, int i, int j, hs_error *err)
{
    const hs_pair_coeff a = *hs_pair_coeffs_at(pair, i, i), b = *hs_pair_coeffs_at(pair, j, j);
    (void)err;
    *hs_pair_coeffs_at(pair, i, j) =
        (hs_pair_coeff){.c = {hs_pair_mix_energy(pair->mix, a.c[EPSILON], b.c[EPSILON], a.c[SIGMA], b.c[SIGMA]),
                              hs_pair_mix_distance(pair->mix, a.c[SIGMA], b.c[SIGMA])},
                        .cutoff = hs_pair_mix_distance(pair->mix, a.cutoff, b.cutoff)};
    return HS_OK;
}

static void params(const hs_pair *pair, int i, int j, double *cutoff, double *p)
{
    const hs_pair_coeff c = *hs_pair_coeffs_at(pair, i, j);
    const double epsilon = c.c[EPSILON], sigma6 = pow(c.c[SIGMA], 6.0);
    const double ratio6 = c.cutoff > 0.0 ? pow(c.c[SIGMA] / c.cutoff, 6.0) : 0.0;
    *cutoff = c.cutoff;
    p[F12] = 48.0 * epsilon * sigma6 * sigma6;
    p[MINUS_F6] = -24.0 * epsilon * sigma6;
    p[U12] = 4.0 * epsilon * sigma6 * sigma6;
    p[MINUS_U6] = -4.0 * epsilon * sigma6;
    /* dU/dr at the cutoff; and what remains of the energy at r = 0 of the line through the cutoff */
    p[SLOPE] = c.cutoff > 0.0 ? -24.0 * epsilon * ratio6 * (2.0 * ratio6 - 1.0) / c.cutoff : 0.0;
    p[SHIFT] = 4.0 * epsilon * ratio6 * (ratio6 - 1.0) - p[SLOPE] * c.cutoff;
}

static hs_status write_coeff(const hs_pair *pair, int i, int j, hs_text *words, hs_error *err)
{
    return hs_pair_coeffs_write(pair, i, j, N_COEFFS, words, err);
}

const hs_pair_style hs_pair_style_lj_smooth_linear = {
    .about = {.name = "lj/smooth/linear",
              .syntax = {.usage = "<cutoff>", .n_min = 1, .n_max = 1},
              .summary = "Lennard-Jones potential whose energy and force end smoothly at the cutoff",
              .details = "U(r) = phi(r) - phi(cutoff) - (r - cutoff) phi'(cutoff) for r < cutoff, 0 beyond, where phi "
                         "is the Lennard-Jones potential "
                         "4 epsilon [(sigma/r)^12 - (sigma/r)^6].\n\n"
                         "`pair_coeff I J <epsilon> <sigma> [<cutoff>]` as in lj/cut. There is nothing to shift, and "
                         "no long-range part. Unlike "
                         "pairs are mixed as in lj/cut.",
              .reference = "S. Toxvaerd, J. C. Dyre, J. Chem. Phys. 134, 081102 (2011), doi:10.1063/1.3558787",
              .example = "pair_style lj/smooth/linear 2.5\npair_coeff * * 1.0 1.0"},
    .coeff_syntax = {.usage = "<epsilon> <sigma> [<cutoff>]", .n_min = 2, .n_max = 3},
    .state_size = sizeof(hs_pair_coeffs),
    .settings = hs_pair_coeffs_settings,
    .destroy = hs_pair_coeffs_destroy,
    .coeff = coeff,
    .mix = mix,
    .params = params,

    .write_coeff = write_coeff,
    .evaluator = &hs_evaluator_lj_smooth_linear,
};

#endif
