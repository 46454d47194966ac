/* Gaussian well (or, with negative A, the Gaussian core of polymer coils):
 *     U(r) = -A exp(-B r^2) - shift,  F(r)/r = -2 A B exp(-B r^2)   for r < r_c
 * Units: A energy, B 1/distance^2.
 * Source: F. H. Stillinger, J. Chem. Phys. 65, 3968 (1976), doi:10.1063/1.432891. */
#include "kernel/evaluator.h"
#include "kernel/vector_math.h"

enum { MINUS_A, MINUS_B, FORCE, SHIFT, N_PARAMS };

HS_EVALUATE(const hs_vec *p, hs_vec r2, hs_vec *force_over_r, hs_vec *energy, bool with_energy)
{
    const hs_vec e = hs_exp(p[MINUS_B] * r2);
    *force_over_r = p[FORCE] * e;
    if (with_energy) *energy = hs_fma(p[MINUS_A], e, hs_set1(0.0) - p[SHIFT]);
}

#define HS_EVALUATOR gauss
#include "kernel/instantiate.h"

#ifndef HS_KERNEL_ISA

#include <math.h>

#include "style/pair_coeffs.h"

static hs_status coeff(hs_pair *pair, int i, int j, const hs_args *args, hs_error *err)
{
    return hs_pair_coeffs_set(pair, i, j, "nn", args, err);
}

/** Width sigma of exp(-r^2/(2 sigma^2)) is what mixes as a distance. */
static hs_status mix(hs_pair *pair, int i, int j, hs_error *err)
{
    const hs_pair_coeff a = *hs_pair_coeffs_at(pair, i, i), b = *hs_pair_coeffs_at(pair, j, j);
    const double width_a = sqrt(0.5 / fabs(a.c[1])), width_b = sqrt(0.5 / fabs(b.c[1]));
    const double width = hs_pair_mix_distance(pair->mix, width_a, width_b);
    const double sign = (a.c[0] < 0.0 ? -1.0 : 1.0);
    (void)err;
    *hs_pair_coeffs_at(pair, i, j) =
        (hs_pair_coeff){.c = {sign * hs_pair_mix_energy(pair->mix, fabs(a.c[0]), fabs(b.c[0]), width_a, width_b),
                              0.5 / (width * width)},
                        .cutoff = hs_pair_mix_distance(pair->mix, a.cutoff, b.cutoff)};
    return HS_OK;
}

static void params(const hs_pair *pair, int i, int j, double *cutoff, double *p)
{
    const hs_pair_coeff c = *hs_pair_coeffs_at(pair, i, j);
    *cutoff = c.cutoff;
    p[MINUS_A] = -c.c[0];
    p[MINUS_B] = -c.c[1];
    p[FORCE] = -2.0 * c.c[0] * c.c[1];
    p[SHIFT] = pair->shift ? -c.c[0] * exp(-c.c[1] * c.cutoff * c.cutoff) : 0.0;
}

const hs_pair_style hs_pair_style_gauss = {
    .about = {.name = "gauss",
              .syntax = {.usage = "<cutoff>", .n_min = 1, .n_max = 1},
              .summary = "Gaussian well or repulsive Gaussian core",
              .details = "U(r) = -A exp(-B r^2) for r < cutoff, 0 beyond.\n\n"
                         "`pair_coeff I J <A> <B> [<cutoff>]`: A (energy) is the depth of the well; negative, it is "
                         "the height of a repulsive core. B (1/distance^2). `pair_modify shift yes` makes the energy "
                         "zero at the cutoff. Unlike pairs are mixed: A by the geometric mean of the sizes, the width "
                         "1/sqrt(2 B) and the cutoff as distances (`pair_modify mix`).",
              .reference = "F. H. Stillinger, J. Chem. Phys. 65, 3968 (1976), doi:10.1063/1.432891",
              .example = "pair_style gauss 3.0\npair_coeff * * -10.0 1.0"},
    .coeff_syntax = {.usage = "<A> <B> [<cutoff>]", .n_min = 2, .n_max = 3},
    .adaptable = (const hs_pair_adaptable[]){{"a", 0}, {NULL, 0}},
    HS_PAIR_COEFFS_HOOKS,
    .coeff = coeff,
    .mix = mix,
    .params = params,
    .evaluator = &hs_evaluator_gauss,
};

#endif
