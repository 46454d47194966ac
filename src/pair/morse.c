/* Morse potential:  U(r) = D (e^2 - 2 e) - shift,  F(r)/r = 2 alpha D (e^2 - e) / r,  e = exp(-alpha (r - r_0))   for r
 * < r_c
 * Units: D energy, alpha 1/distance, r_0 distance.
 * Source: P. M. Morse, Phys. Rev. 34, 57 (1929), doi:10.1103/PhysRev.34.57. */
#include "kernel/evaluator.h"
#include "kernel/vector_math.h"

enum { D, MINUS_ALPHA, R0, FORCE, SHIFT, N_PARAMS };

HS_EVALUATE(const hs_vec *p, hs_vec r2, hs_vec *force_over_r, hs_vec *energy, bool with_energy)
{
    const hs_vec r = hs_sqrt(hs_max(r2, hs_set1(HS_TINY_R2))), e = hs_exp(p[MINUS_ALPHA] * (r - p[R0]));
    *force_over_r = p[FORCE] * hs_fma(e, e, hs_set1(0.0) - e) / r;
    if (with_energy) *energy = p[D] * hs_fma(e, e, hs_set1(-2.0) * e) - p[SHIFT];
}

#define HS_EVALUATOR morse
#include "kernel/instantiate.h"

#ifndef HS_KERNEL_ISA

#include <math.h>

#include "style/pair_coeffs.h"

static hs_status coeff(hs_pair *pair, int i, int j, const hs_args *args, hs_error *err)
{
    return hs_pair_coeffs_set(pair, i, j, "nnn", args, err);
}

static void params(const hs_pair *pair, int i, int j, double *cutoff, double *p)
{
    const hs_pair_coeff c = *hs_pair_coeffs_at(pair, i, j);
    const double depth = c.c[0], alpha = c.c[1], r0 = c.c[2], e = exp(-alpha * (c.cutoff - r0));
    *cutoff = c.cutoff;
    p[D] = depth;
    p[MINUS_ALPHA] = -alpha;
    p[R0] = r0;
    p[FORCE] = 2.0 * alpha * depth;
    p[SHIFT] = pair->shift ? depth * (e * e - 2.0 * e) : 0.0;
}

const hs_pair_style hs_pair_style_morse = {
    .about = {.name = "morse",
              .syntax = {.usage = "<cutoff>", .n_min = 1, .n_max = 1},
              .summary = "Morse potential",
              .details = "U(r) = D [exp(-2 alpha (r - r0)) - 2 exp(-alpha (r - r0))] for r < cutoff, 0 beyond.\n\n"
                         "`pair_coeff I J <D> <alpha> <r0> [<cutoff>]`: depth D (energy), inverse width alpha "
                         "(1/distance), place of the minimum r0 (distance). `pair_modify shift yes` makes the energy "
                         "zero at the cutoff. Unlike pairs are not mixed: every pair of types must be given.",
              .reference = "P. M. Morse, Phys. Rev. 34, 57 (1929), doi:10.1103/PhysRev.34.57",
              .example = "pair_style morse 2.5\npair_coeff * * 100.0 2.0 1.5"},
    .coeff_syntax = {.usage = "<D> <alpha> <r0> [<cutoff>]", .n_min = 3, .n_max = 4},
    .adaptable = (const hs_pair_adaptable[]){{"d0", 0}, {"alpha", 1}, {"r0", 2}, {NULL, 0}},
    HS_PAIR_COEFFS_HOOKS,
    .coeff = coeff,

    .params = params,
    .evaluator = &hs_evaluator_morse,
};

#endif
