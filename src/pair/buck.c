/* Buckingham potential:  U(r) = A exp(-r/rho) - C/r^6 - shift,  F(r)/r = A/rho exp(-r/rho)/r - 6 C/r^8   for r < r_c
 * Units: A energy, rho distance, C energy x distance^6.
 * Source: R. A. Buckingham, Proc. R. Soc. Lond. A 168, 264 (1938), doi:10.1098/rspa.1938.0173. */
#include "kernel/evaluator.h"
#include "kernel/vector_math.h"

enum { A, MINUS_INV_RHO, FORCE, MINUS_C, MINUS_6C, SHIFT, N_PARAMS };

HS_EVALUATE(const hs_vec *p, hs_vec r2, hs_vec *force_over_r, hs_vec *energy, bool with_energy)
{
    const hs_vec r = hs_sqrt(r2), inv_r2 = hs_set1(1.0) / r2, inv_r6 = inv_r2 * inv_r2 * inv_r2;
    const hs_vec e = hs_exp(p[MINUS_INV_RHO] * r);
    *force_over_r = hs_fma(p[FORCE] * e, r, p[MINUS_6C] * inv_r6) * inv_r2;
    if (with_energy) *energy = hs_fma(p[A], e, p[MINUS_C] * inv_r6) - p[SHIFT];
}

#define HS_EVALUATOR buck
#include "kernel/instantiate.h"

#ifndef HS_KERNEL_ISA

#include <math.h>

#include "style/pair_coeffs.h"

enum { STRENGTH, RHO, DISPERSION };

static hs_status coeff(hs_pair *pair, int i, int j, const hs_args *args, hs_error *err)
{
    return hs_pair_coeffs_set(pair, i, j, "n+n", args, err);
}

static void params(const hs_pair *pair, int i, int j, double *cutoff, double *p)
{
    const hs_pair_coeff c = *hs_pair_coeffs_at(pair, i, j);
    *cutoff = c.cutoff;
    p[A] = c.c[STRENGTH];
    p[MINUS_INV_RHO] = -1.0 / c.c[RHO];
    p[FORCE] = c.c[STRENGTH] / c.c[RHO];
    p[MINUS_C] = -c.c[DISPERSION];
    p[MINUS_6C] = -6.0 * c.c[DISPERSION];
    p[SHIFT] = 0.0;
    if (pair->shift && c.cutoff > 0.0)
        p[SHIFT] = c.c[STRENGTH] * exp(-c.cutoff / c.c[RHO]) - c.c[DISPERSION] / pow(c.cutoff, 6.0);
}

/** Integrals from the cutoff of  2 pi r^2 U  and  -(2 pi / 3) r^3 dU/dr. */
static void tail(const hs_pair *pair, int i, int j, double *energy, double *virial)
{
    const hs_pair_coeff c = *hs_pair_coeffs_at(pair, i, j);
    const double rho = c.c[RHO], rc = c.cutoff, e = c.c[STRENGTH] * exp(-rc / rho), rc3 = rc * rc * rc;
    *energy = 2.0 * M_PI * (e * rho * (rc * rc + 2.0 * rho * rc + 2.0 * rho * rho) - c.c[DISPERSION] / (3.0 * rc3));
    *virial =
        2.0 * M_PI / 3.0 *
        (e * (rc3 + 3.0 * rho * rc * rc + 6.0 * rho * rho * rc + 6.0 * rho * rho * rho) - 2.0 * c.c[DISPERSION] / rc3);
}

const hs_pair_style hs_pair_style_buck = {
    .about = {.name = "buck",
              .syntax = {.usage = "<cutoff>", .n_min = 1, .n_max = 1},
              .summary = "Buckingham potential: exponential repulsion and dispersion",
              .details = "U(r) = A exp(-r/rho) - C/r^6 for r < cutoff, 0 beyond.\n\n"
                         "`pair_coeff I J <A> <rho> <C> [<cutoff>]`: A (energy), rho (distance, above zero), C (energy "
                         "x distance^6). At small r the potential falls without bound: atoms that come there fuse. "
                         "`pair_modify shift yes` makes the energy zero at the cutoff; `tail yes` adds the long-range "
                         "part. Unlike pairs are not mixed: every pair of types must be given.",
              .reference = "R. A. Buckingham, Proc. R. Soc. Lond. A 168, 264 (1938), doi:10.1098/rspa.1938.0173",
              .example = "pair_style buck 2.5\npair_coeff * * 100.0 0.35 1.0"},
    .coeff_syntax = {.usage = "<A> <rho> <C> [<cutoff>]", .n_min = 3, .n_max = 4},
    .adaptable = (const hs_pair_adaptable[]){{"a", STRENGTH}, {"c", DISPERSION}, {NULL, 0}},
    HS_PAIR_COEFFS_HOOKS,
    .coeff = coeff,

    .params = params,
    .tail = tail,
    .evaluator = &hs_evaluator_buck,
};

#endif
