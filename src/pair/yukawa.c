/* Screened Coulomb (Yukawa) potential:  U(r) = A exp(-kappa r) / r - shift,  F(r)/r = A exp(-kappa r) (kappa r + 1) /
 * r^3   for r < r_c
 * Units: A energy x distance, kappa 1/distance.
 * Source: H. Yukawa, Proc. Phys.-Math. Soc. Japan 17, 48 (1935), doi:10.11429/ppmsj1919.17.0_48. */
#include "kernel/evaluator.h"
#include "kernel/vector_math.h"

enum { A, KAPPA, SHIFT, N_PARAMS };

HS_EVALUATE(const hs_vec *p, hs_vec r2, hs_vec *force_over_r, hs_vec *energy, bool with_energy)
{
    const hs_vec r = hs_sqrt(r2), u = p[A] * hs_exp(hs_set1(0.0) - p[KAPPA] * r) / r;
    *force_over_r = u * hs_fma(p[KAPPA], r, hs_set1(1.0)) / r2;
    if (with_energy) *energy = u - p[SHIFT];
}

#define HS_EVALUATOR yukawa
#include "kernel/instantiate.h"

#ifndef HS_KERNEL_ISA

#include <math.h>

#include "style/pair_coeffs.h"

typedef struct yukawa_state {
    hs_pair_coeffs coeffs;
    double kappa; /**< 1/distance */
} yukawa_state;

static hs_status settings(hs_pair *pair, const hs_args *args, hs_error *err)
{
    double cutoff;
    HS_TRY(hs_arg_not_negative(args, 0, &((yukawa_state *)pair->state)->kappa, err));
    HS_TRY(hs_arg_positive(args, 1, &cutoff, err));
    return hs_pair_coeffs_set_cutoff(pair, cutoff, err);
}

static void params(const hs_pair *pair, int i, int j, double *cutoff, double *p)
{
    const hs_pair_coeff c = *hs_pair_coeffs_at(pair, i, j);
    *cutoff = c.cutoff;
    p[A] = c.c[0];
    p[KAPPA] = ((yukawa_state *)pair->state)->kappa;
    p[SHIFT] = pair->shift && c.cutoff > 0.0 ? c.c[0] * exp(-p[KAPPA] * c.cutoff) / c.cutoff : 0.0;
}

const hs_pair_style hs_pair_style_yukawa = {
    .about =
        {.name = "yukawa",
         .syntax = {.usage = "<kappa> <cutoff>", .n_min = 2, .n_max = 2},
         .summary = "Yukawa potential: Coulomb repulsion screened by an electrolyte",
         .details =
             "U(r) = A exp(-kappa r)/r for r < cutoff, 0 beyond.\n\n"
             "`pair_style yukawa <kappa> <cutoff>`: kappa (1/distance) is the inverse screening length of all pairs, "
             "cutoff (distance) that of pairs that are given none of their own. `pair_coeff I J <A> [<cutoff>]`: A "
             "(energy x distance), of either sign. `pair_modify shift yes` makes the energy zero at the cutoff. Unlike "
             "pairs are mixed: A by the geometric mean, the cutoff as a distance (`pair_modify mix`).",
         .reference = "H. Yukawa, Proc. Phys.-Math. Soc. Japan 17, 48 (1935), doi:10.11429/ppmsj1919.17.0_48",
         .example = "pair_style yukawa 2.0 2.5\npair_coeff * * 100.0\npair_coeff 1 2 50.0 3.0"},
    .coeff_syntax = {.usage = "<A> [<cutoff>]", .n_min = 1, .n_max = 2},
    .adaptable = (const hs_pair_adaptable[]){{"a", 0}, {NULL, 0}},
    .state_size = sizeof(yukawa_state),
    .settings = settings,
    .destroy = hs_pair_coeffs_destroy,
    .coeff = hs_pair_coeffs_read_one,
    .mix = hs_pair_coeffs_mix_one,
    .params = params,

    .write_coeff = hs_pair_coeffs_write,
    .evaluator = &hs_evaluator_yukawa,
};

#endif
