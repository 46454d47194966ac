/* Lennard-Jones 12-6 with a linear term that makes energy and force zero at the cutoff:
 *     U(r) = U_LJ(r) - U_LJ(r_c) - (r - r_c) U_LJ'(r_c),  F(r) = F_LJ(r) - F_LJ(r_c)   for r < r_c
 * Source: S. Toxvaerd, J. C. Dyre, J. Chem. Phys. 134, 081102 (2011), doi:10.1063/1.3558787. */
#include "kernel/evaluator.h"
#include "pair/force_shifted.h"

HS_EVALUATE(const hs_vec *p, hs_vec r2, hs_vec *force_over_r, hs_vec *energy, bool with_energy)
{
    const hs_vec inv_r2 = hs_set1(1.0) / r2, r = hs_sqrt(r2);
    const hs_vec inv_r6 = inv_r2 * inv_r2 * inv_r2;
    *force_over_r = hs_fma(inv_r6, hs_fma(p[HS_SF_F12], inv_r6, p[HS_SF_MINUS_F6]), p[HS_SF_SLOPE] * r) * inv_r2;
    if (with_energy)
        *energy = hs_fma(inv_r6, hs_fma(p[HS_SF_U12], inv_r6, p[HS_SF_MINUS_U6]),
                         hs_set1(0.0) - hs_fma(p[HS_SF_SLOPE], r, p[HS_SF_SHIFT]));
}

enum { N_PARAMS = HS_SF_N_PARAMS };
#define HS_EVALUATOR lj_smooth_linear
#include "kernel/instantiate.h"

#ifndef HS_KERNEL_ISA

const hs_pair_style hs_pair_style_lj_smooth_linear = HS_FORCE_SHIFTED_STYLE(
    "lj/smooth/linear", "Lennard-Jones potential whose energy and force end smoothly at the cutoff");

#endif
