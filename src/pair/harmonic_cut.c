/* Harmonic repulsion:  U(r) = k (r_c - r)^2,  F(r)/r = 2 k (r_c - r) / r   for r < r_c
 * Units: k energy/distance^2, r_c distance. */
#include "kernel/evaluator.h"

enum { RC, TWO_K, K, N_PARAMS };

HS_EVALUATE(const hs_vec *p, hs_vec r2, hs_vec *force_over_r, hs_vec *energy, bool with_energy)
{
    const hs_vec r = hs_sqrt(hs_max(r2, hs_set1(HS_TINY_R2))), overlap = p[RC] - r;
    *force_over_r = p[TWO_K] * overlap / r;
    if (with_energy) *energy = p[K] * overlap * overlap;
}

#define HS_EVALUATOR harmonic_cut
#include "kernel/instantiate.h"

#ifndef HS_KERNEL_ISA

#include "style/pair_coeffs.h"

static hs_status coeff(hs_pair *pair, int i, int j, const hs_args *args, hs_error *err)
{
    hs_pair_coeff c = {.cutoff = 0.0};
    HS_TRY(hs_arg_double(args, 0, &c.c[0], err));
    HS_TRY(hs_arg_not_negative(args, 1, &c.cutoff, err));
    *hs_pair_coeffs_at(pair, i, j) = c;
    return HS_OK;
}

static hs_status mix(hs_pair *pair, int i, int j, hs_error *err)
{
    const hs_pair_coeff a = *hs_pair_coeffs_at(pair, i, i), b = *hs_pair_coeffs_at(pair, j, j);
    (void)err;
    *hs_pair_coeffs_at(pair, i, j) =
        (hs_pair_coeff){.c = {hs_pair_mix_energy(pair->mix, a.c[0], b.c[0], a.cutoff, b.cutoff)},
                        .cutoff = hs_pair_mix_distance(pair->mix, a.cutoff, b.cutoff)};
    return HS_OK;
}

static void params(const hs_pair *pair, int i, int j, double *cutoff, double *p)
{
    const hs_pair_coeff c = *hs_pair_coeffs_at(pair, i, j);
    *cutoff = p[RC] = c.cutoff;
    p[K] = c.c[0];
    p[TWO_K] = 2.0 * c.c[0];
}

const hs_pair_style hs_pair_style_harmonic_cut = {
    .about = {.name = "harmonic/cut",
              .syntax = {.usage = "", .n_min = 0, .n_max = 0},
              .summary = "harmonic repulsion k (r_c - r)^2 below a cutoff",
              .details = "U(r) = k (cutoff - r)^2 for r < cutoff, 0 beyond.\n\n"
                         "`pair_coeff I J <k> <cutoff>`: k (energy/distance^2; there is no factor 1/2 in front) and "
                         "cutoff (distance). Energy and force are zero at the cutoff. Unlike pairs are mixed: k by the "
                         "geometric mean, the cutoff as a distance (`pair_modify mix`). The same potential with the "
                         "factors usual in work on jamming is `harmonic/repulsion`.",
              .reference = NULL,
              .example = "pair_style harmonic/cut\npair_coeff * * 50.0 1.0"},
    .coeff_syntax = {.usage = "<k> <cutoff>", .n_min = 2, .n_max = 2},
    .adaptable = (const hs_pair_adaptable[]){{"k", 0}, {NULL, 0}},
    .state_size = sizeof(hs_pair_coeffs),
    .settings = hs_pair_coeffs_no_settings,
    .destroy = hs_pair_coeffs_destroy,
    .coeff = coeff,
    .mix = mix,
    .params = params,

    .write_coeff = hs_pair_coeffs_write,
    .evaluator = &hs_evaluator_harmonic_cut,
};

#endif
