/** Lennard-Jones with a linear term that ends energy and force at the cutoff: what the styles lj/smooth/linear and
 *  lj/sf, two names of one potential, share. */
#ifndef HS_PAIR_FORCE_SHIFTED_H
#define HS_PAIR_FORCE_SHIFTED_H

/** Parameters of the evaluator. */
enum { HS_SF_F12, HS_SF_MINUS_F6, HS_SF_U12, HS_SF_MINUS_U6, HS_SF_SLOPE, HS_SF_SHIFT, HS_SF_N_PARAMS };

#ifndef HS_KERNEL_ISA

#include "pair/lj_coeffs.h"

static inline void hs_force_shifted_params(const hs_pair *pair, int i, int j, double *cutoff, double *p)
{
    const hs_pair_coeff c = *hs_pair_coeffs_at(pair, i, j);
    const double epsilon = c.c[HS_LJ_EPSILON], sigma6 = pow(c.c[HS_LJ_SIGMA], 6.0);
    const double ratio6 = c.cutoff > 0.0 ? pow(c.c[HS_LJ_SIGMA] / c.cutoff, 6.0) : 0.0;
    *cutoff = c.cutoff;
    p[HS_SF_F12] = 48.0 * epsilon * sigma6 * sigma6;
    p[HS_SF_MINUS_F6] = -24.0 * epsilon * sigma6;
    p[HS_SF_U12] = 4.0 * epsilon * sigma6 * sigma6;
    p[HS_SF_MINUS_U6] = -4.0 * epsilon * sigma6;
    /* dU/dr at the cutoff; and what remains of the energy at r = 0 of the line through the cutoff */
    p[HS_SF_SLOPE] = c.cutoff > 0.0 ? -24.0 * epsilon * ratio6 * (2.0 * ratio6 - 1.0) / c.cutoff : 0.0;
    p[HS_SF_SHIFT] = 4.0 * epsilon * ratio6 * (ratio6 - 1.0) - p[HS_SF_SLOPE] * c.cutoff;
}

extern const hs_evaluator hs_evaluator_lj_smooth_linear;

/** The descriptor of the style under one of its names. */
#define HS_FORCE_SHIFTED_STYLE(its_name, its_summary)                                                                  \
    {                                                                                                                  \
        .about = {.name = its_name,                                                                                    \
                  .syntax = {.usage = "<cutoff>", .n_min = 1, .n_max = 1},                                             \
                  .summary = its_summary,                                                                              \
                  .details =                                                                                           \
                      "U(r) = phi(r) - phi(cutoff) - (r - cutoff) phi'(cutoff) for r < cutoff, 0 beyond, where phi "   \
                      "is the Lennard-Jones potential 4 epsilon [(sigma/r)^12 - (sigma/r)^6].\n\n"                     \
                      "`pair_coeff I J <epsilon> <sigma> [<cutoff>]` as in lj/cut. There is nothing to shift, and "    \
                      "no long-range part. Unlike pairs are mixed as in lj/cut.",                                      \
                  .reference = "S. Toxvaerd, J. C. Dyre, J. Chem. Phys. 134, 081102 (2011), doi:10.1063/1.3558787",    \
                  .example = "pair_style " its_name " 2.5\npair_coeff * * 1.0 1.0"},                                   \
        .coeff_syntax = {.usage = "<epsilon> <sigma> [<cutoff>]", .n_min = 2, .n_max = 3}, HS_PAIR_COEFFS_HOOKS,       \
        .adaptable = HS_LJ_ADAPTABLE, .coeff = hs_lj_coeff, .mix = hs_lj_mix, .params = hs_force_shifted_params,       \
        .evaluator = &hs_evaluator_lj_smooth_linear,                                                                   \
    }

#endif
#endif
