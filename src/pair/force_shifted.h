/** Lennard-Jones with a linear term that ends energy and force at the cutoff: what the styles lj/smooth/linear and lj/sf, two
 *  names of one potential, share. */
#ifndef HS_PAIR_FORCE_SHIFTED_H
#define HS_PAIR_FORCE_SHIFTED_H

/** Parameters of the evaluator. */
enum { HS_SF_F12, HS_SF_MINUS_F6, HS_SF_U12, HS_SF_MINUS_U6, HS_SF_SLOPE, HS_SF_SHIFT, HS_SF_N_PARAMS };

#ifndef HS_KERNEL_ISA

#include <math.h>

#include "style/pair_coeffs.h"

enum { HS_SF_EPSILON, HS_SF_SIGMA, HS_SF_N_COEFFS };

static inline HS_MUST_USE hs_status hs_force_shifted_coeff(hs_pair *pair, int i, int j, const hs_args *args,
                                                           hs_error *err)
{
    hs_pair_coeff c = {.cutoff = 0.0};
    HS_TRY(hs_arg_double(args, 0, &c.c[HS_SF_EPSILON], err));
    HS_TRY(hs_arg_not_negative(args, 1, &c.c[HS_SF_SIGMA], err));
    HS_TRY(hs_pair_coeffs_read_cutoff(pair, args, 2, &c.cutoff, err));
    *hs_pair_coeffs_at(pair, i, j) = c;
    return HS_OK;
}

static inline HS_MUST_USE hs_status hs_force_shifted_mix(hs_pair *pair, int i, int j, hs_error *err)
{
    const hs_pair_coeff a = *hs_pair_coeffs_at(pair, i, i), b = *hs_pair_coeffs_at(pair, j, j);
    (void)err;
    *hs_pair_coeffs_at(pair, i, j) = (hs_pair_coeff){
        .c = {hs_pair_mix_energy(pair->mix, a.c[HS_SF_EPSILON], b.c[HS_SF_EPSILON], a.c[HS_SF_SIGMA], b.c[HS_SF_SIGMA]),
              hs_pair_mix_distance(pair->mix, a.c[HS_SF_SIGMA], b.c[HS_SF_SIGMA])},
        .cutoff = hs_pair_mix_distance(pair->mix, a.cutoff, b.cutoff)};
    return HS_OK;
}

static inline void hs_force_shifted_params(const hs_pair *pair, int i, int j, double *cutoff, double *p)
{
    const hs_pair_coeff c = *hs_pair_coeffs_at(pair, i, j);
    const double epsilon = c.c[HS_SF_EPSILON], sigma6 = pow(c.c[HS_SF_SIGMA], 6.0);
    const double ratio6 = c.cutoff > 0.0 ? pow(c.c[HS_SF_SIGMA] / c.cutoff, 6.0) : 0.0;
    *cutoff = c.cutoff;
    p[HS_SF_F12] = 48.0 * epsilon * sigma6 * sigma6;
    p[HS_SF_MINUS_F6] = -24.0 * epsilon * sigma6;
    p[HS_SF_U12] = 4.0 * epsilon * sigma6 * sigma6;
    p[HS_SF_MINUS_U6] = -4.0 * epsilon * sigma6;
    /* dU/dr at the cutoff; and what remains of the energy at r = 0 of the line through the cutoff */
    p[HS_SF_SLOPE] = c.cutoff > 0.0 ? -24.0 * epsilon * ratio6 * (2.0 * ratio6 - 1.0) / c.cutoff : 0.0;
    p[HS_SF_SHIFT] = 4.0 * epsilon * ratio6 * (ratio6 - 1.0) - p[HS_SF_SLOPE] * c.cutoff;
}

static inline HS_MUST_USE hs_status hs_force_shifted_write_coeff(const hs_pair *pair, int i, int j, hs_text *words,
                                                                 hs_error *err)
{
    return hs_pair_coeffs_write(pair, i, j, HS_SF_N_COEFFS, words, err);
}

#endif
#endif
