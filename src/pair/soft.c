/* Soft cosine repulsion:  U(r) = A (1 + cos(pi r / r_c))            for r < r_c
 *                         F(r)/r = A (pi / r_c) sin(pi r / r_c) / r
 * written with the half angle h = pi r / (2 r_c), 1 + cos = 2 cos^2 and sin = 2 sin cos, so that no digits are lost
 * near r_c.
 * Units: A energy, r_c distance. */
#include "kernel/evaluator.h"
#include "kernel/vector_math.h"

enum { HALF_OVER_RC, FORCE, ENERGY, N_PARAMS };

HS_EVALUATE(const hs_vec *p, hs_vec r2, hs_vec *force_over_r, hs_vec *energy, bool with_energy)
{
    const hs_vec r = hs_sqrt(hs_max(r2, hs_set1(HS_TINY_R2)));
    hs_vec sine, cosine;
    hs_sincospi(r * p[HALF_OVER_RC], &sine, &cosine);
    *force_over_r = p[FORCE] * sine * cosine / r;
    if (with_energy) *energy = p[ENERGY] * cosine * cosine;
}

#define HS_EVALUATOR soft
#include "kernel/instantiate.h"

#ifndef HS_KERNEL_ISA

#include <math.h>

#include "style/pair_coeffs.h"

static void params(const hs_pair *pair, int i, int j, double *cutoff, double *p)
{
    const hs_pair_coeff c = *hs_pair_coeffs_at(pair, i, j);
    *cutoff = c.cutoff;
    p[HALF_OVER_RC] = c.cutoff > 0.0 ? 0.5 / c.cutoff : 0.0;
    p[FORCE] = 4.0 * M_PI * c.c[0] * p[HALF_OVER_RC];
    p[ENERGY] = 2.0 * c.c[0];
}

const hs_pair_style hs_pair_style_soft = {
    .about = {.name = "soft",
              .syntax = {.usage = "<cutoff>", .n_min = 1, .n_max = 1},
              .summary = "soft cosine repulsion, which lets overlapping atoms be pushed apart",
              .details =
                  "U(r) = A [1 + cos(pi r/cutoff)] for r < cutoff, 0 beyond.\n\n"
                  "`pair_coeff I J <A> [<cutoff>]`: A (energy) is the half of the energy at r = 0. Energy and force "
                  "are finite at every distance and zero at the cutoff (there is nothing to shift). Unlike pairs are "
                  "mixed: A by the geometric mean, the cutoff as a distance (`pair_modify mix`).",
              .reference = NULL,
              .example = "pair_style soft 1.12\npair_coeff * * 10.0\npair_coeff 1 2 5.0 1.5"},
    .coeff_syntax = {.usage = "<A> [<cutoff>]", .n_min = 1, .n_max = 2},
    .adaptable = (const hs_pair_adaptable[]){{"a", 0}, {NULL, 0}},
    HS_PAIR_COEFFS_HOOKS,
    .coeff = hs_pair_coeffs_read_one,
    .mix = hs_pair_coeffs_mix_one,
    .params = params,
    .evaluator = &hs_evaluator_soft,
};

#endif
