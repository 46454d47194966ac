/* Born-Mayer-Huggins potential:
 *     U(r) = A exp((sigma - r)/rho) - C/r^6 + D/r^8 - shift,  F(r)/r = A/rho exp((sigma - r)/rho)/r - 6 C/r^8 + 8
 * D/r^10   for r < r_c
 * Units: A energy, rho and sigma distance, C energy x distance^6, D energy x distance^8.
 * Source: F. G. Fumi, M. P. Tosi, J. Phys. Chem. Solids 25, 31 (1964), doi:10.1016/0022-3697(64)90159-3. */
#include "kernel/evaluator.h"
#include "kernel/vector_math.h"

enum { A, MINUS_INV_RHO, SIGMA_OVER_RHO, FORCE, MINUS_C, D, MINUS_6C, D8, SHIFT, N_PARAMS };

HS_EVALUATE(const hs_vec *p, hs_vec r2, hs_vec *force_over_r, hs_vec *energy, bool with_energy)
{
    const hs_vec r = hs_sqrt(r2), inv_r2 = hs_set1(1.0) / r2, inv_r6 = inv_r2 * inv_r2 * inv_r2;
    const hs_vec e = hs_exp(hs_fma(p[MINUS_INV_RHO], r, p[SIGMA_OVER_RHO]));
    *force_over_r = hs_fma(p[FORCE] * e, r, inv_r6 * hs_fma(p[D8], inv_r2, p[MINUS_6C])) * inv_r2;
    if (with_energy) *energy = hs_fma(p[A], e, inv_r6 * hs_fma(p[D], inv_r2, p[MINUS_C])) - p[SHIFT];
}

#define HS_EVALUATOR born
#include "kernel/instantiate.h"

#ifndef HS_KERNEL_ISA

#include <math.h>

#include "style/pair_coeffs.h"

enum { STRENGTH, RHO, SIZE, DISPERSION, QUADRUPOLE };

static hs_status coeff(hs_pair *pair, int i, int j, const hs_args *args, hs_error *err)
{
    return hs_pair_coeffs_set(pair, i, j, "n+nnn", args, err);
}

static void params(const hs_pair *pair, int i, int j, double *cutoff, double *p)
{
    const hs_pair_coeff c = *hs_pair_coeffs_at(pair, i, j);
    *cutoff = c.cutoff;
    p[A] = c.c[STRENGTH];
    p[MINUS_INV_RHO] = -1.0 / c.c[RHO];
    p[SIGMA_OVER_RHO] = c.c[SIZE] / c.c[RHO];
    p[FORCE] = c.c[STRENGTH] / c.c[RHO];
    p[MINUS_C] = -c.c[DISPERSION];
    p[D] = c.c[QUADRUPOLE];
    p[MINUS_6C] = -6.0 * c.c[DISPERSION];
    p[D8] = 8.0 * c.c[QUADRUPOLE];
    p[SHIFT] = 0.0;
    if (pair->shift && c.cutoff > 0.0)
        p[SHIFT] = c.c[STRENGTH] * exp((c.c[SIZE] - c.cutoff) / c.c[RHO]) - c.c[DISPERSION] / pow(c.cutoff, 6.0) +
                   c.c[QUADRUPOLE] / pow(c.cutoff, 8.0);
}

/** Integrals from the cutoff of  2 pi r^2 U  and  -(2 pi / 3) r^3 dU/dr. */
static void tail(const hs_pair *pair, int i, int j, double *energy, double *virial)
{
    const hs_pair_coeff c = *hs_pair_coeffs_at(pair, i, j);
    const double rho = c.c[RHO], rc = c.cutoff, e = c.c[STRENGTH] * exp((c.c[SIZE] - rc) / rho);
    const double rc3 = rc * rc * rc, rc5 = rc3 * rc * rc;
    *energy = 2.0 * M_PI *
              (e * rho * (rc * rc + 2.0 * rho * rc + 2.0 * rho * rho) - c.c[DISPERSION] / (3.0 * rc3) +
               c.c[QUADRUPOLE] / (5.0 * rc5));
    *virial = 2.0 * M_PI / 3.0 *
              (e * (rc3 + 3.0 * rho * rc * rc + 6.0 * rho * rho * rc + 6.0 * rho * rho * rho) -
               2.0 * c.c[DISPERSION] / rc3 + 8.0 / 5.0 * c.c[QUADRUPOLE] / rc5);
}

const hs_pair_style hs_pair_style_born = {
    .about = {.name = "born",
              .syntax = {.usage = "<cutoff>", .n_min = 1, .n_max = 1},
              .summary = "Born-Mayer-Huggins potential of ionic crystals, without charges",
              .details = "U(r) = A exp((sigma - r)/rho) - C/r^6 + D/r^8 for r < cutoff, 0 beyond.\n\n"
                         "`pair_coeff I J <A> <rho> <sigma> <C> <D> [<cutoff>]`: A (energy), rho (distance, above "
                         "zero), sigma (distance), C (energy x distance^6), D (energy x distance^8). `pair_modify "
                         "shift yes` makes the energy zero at the cutoff; `tail yes` adds the long-range part. Unlike "
                         "pairs are not mixed: every pair of types must be given.",
              .reference =
                  "F. G. Fumi, M. P. Tosi, J. Phys. Chem. Solids 25, 31 (1964), doi:10.1016/0022-3697(64)90159-3",
              .example = "pair_style born 2.5\npair_coeff * * 2.0 0.3 1.0 1.0 0.5"},
    .coeff_syntax = {.usage = "<A> <rho> <sigma> <C> <D> [<cutoff>]", .n_min = 5, .n_max = 6},
    .adaptable = (const hs_pair_adaptable[]){{"a", STRENGTH}, {"c", DISPERSION}, {"d", QUADRUPOLE}, {NULL, 0}},
    HS_PAIR_COEFFS_HOOKS,
    .coeff = coeff,

    .params = params,
    .tail = tail,
    .evaluator = &hs_evaluator_born,
};

#endif
