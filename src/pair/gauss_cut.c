/* Gaussian barrier or well around a distance:  U(r) = H/(w sqrt(2 pi)) exp(-(r - r0)^2/(2 w^2)) - shift   for r < r_c
 *                                              F(r)/r = (r - r0)/(w^2 r) U
 * Units: H energy distance, r0, w and r_c distance.
 * Source: S. Lenart, A. Jusufi, A. Z. Panagiotopoulos, J. Chem. Phys. 126, 044509 (2007), doi:10.1063/1.2431169. */
#include "kernel/evaluator.h"
#include "kernel/vector_math.h"

enum { HEIGHT, PLACE, MINUS_RATE, TWO_RATES, SHIFT, N_PARAMS };

HS_EVALUATE(const hs_vec *p, hs_vec r2, hs_vec *force_over_r, hs_vec *energy, bool with_energy)
{
    const hs_vec r = hs_sqrt(hs_max(r2, hs_set1(HS_TINY_R2))), d = r - p[PLACE];
    const hs_vec u = p[HEIGHT] * hs_exp(p[MINUS_RATE] * d * d);
    *force_over_r = p[TWO_RATES] * d * u / r;
    if (with_energy) *energy = u - p[SHIFT];
}

#define HS_EVALUATOR gauss_cut
#include "kernel/instantiate.h"

#ifndef HS_KERNEL_ISA

#include <math.h>

#include "style/pair_coeffs.h"

/** Coefficients. */
enum { H, R0, WIDTH };

static hs_status coeff(hs_pair *pair, int i, int j, const hs_args *args, hs_error *err)
{
    return hs_pair_coeffs_set(pair, i, j, "nn+", args, err);
}

static void params(const hs_pair *pair, int i, int j, double *cutoff, double *p)
{
    const hs_pair_coeff *c = hs_pair_coeffs_at(pair, i, j);
    const double width = c->c[WIDTH], rate = width > 0.0 ? 0.5 / (width * width) : 0.0, end = c->cutoff - c->c[R0];
    *cutoff = c->cutoff;
    p[HEIGHT] = width > 0.0 ? c->c[H] / (width * sqrt(2.0 * M_PI)) : 0.0;
    p[PLACE] = c->c[R0];
    p[MINUS_RATE] = -rate;
    p[TWO_RATES] = 2.0 * rate;
    p[SHIFT] = pair->shift ? p[HEIGHT] * exp(-rate * end * end) : 0.0;
}

const hs_pair_style hs_pair_style_gauss_cut = {
    .about =
        {.name = "gauss/cut",
         .syntax = {.usage = "<cutoff>", .n_min = 1, .n_max = 1},
         .summary = "Gaussian barrier or well around a distance",
         .details = "U(r) = H/(w sqrt(2 pi)) exp[-(r - r0)^2/(2 w^2)] for r < cutoff, 0 beyond: a barrier (H > 0) or a "
                    "well (H < 0) around the distance r0, often added to another potential by `hybrid/overlay`. H is "
                    "its integral over r.\n\n"
                    "`pair_coeff I J <H> <r0> <w> [<cutoff>]`: energy times distance, distance, distance. "
                    "`pair_modify shift yes` makes the energy zero at the cutoff. Unlike pairs are not mixed: every "
                    "pair of types must be given. `gauss` is a Gaussian around 0.",
         .reference =
             "S. Lenart, A. Jusufi, A. Z. Panagiotopoulos, J. Chem. Phys. 126, 044509 (2007), doi:10.1063/1.2431169",
         .example = "pair_style hybrid/overlay lj/cut 2.5 gauss/cut 2.5\npair_coeff * * lj/cut 1.0 1.0\n"
                    "pair_coeff * * gauss/cut 0.5 1.5 0.15"},
    .coeff_syntax = {.usage = "<H> <r0> <w> [<cutoff>]", .n_min = 3, .n_max = 4},
    .adaptable = (const hs_pair_adaptable[]){{"hgauss", H}, {"rmh", R0}, {"sigmah", WIDTH}, {NULL, 0}},
    HS_PAIR_COEFFS_HOOKS,
    .coeff = coeff,
    .params = params,
    .evaluator = &hs_evaluator_gauss_cut,
};

#endif
