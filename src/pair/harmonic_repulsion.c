/* Harmonic repulsion of soft spheres, as the literature on jamming and granular matter writes it:
 *     U(r) = (k/2) (1 - r/r_0)^2,  F(r)/r = (k/r_0) (1 - r/r_0) / r   for r < r_0
 * It is the potential of harmonic/cut with the constant k / (2 r_0^2), and has no evaluator of its own.
 * Units: k energy, r_0 distance.
 * Source: C. S. O'Hern, L. E. Silbert, A. J. Liu, S. R. Nagel, Phys. Rev. E 68, 011306 (2003),
 * doi:10.1103/PhysRevE.68.011306, eq. (1) with alpha = 2. */
#include <math.h>

#include "style/pair_coeffs.h"

extern const hs_evaluator hs_evaluator_harmonic_cut;

static hs_status coeff(hs_pair *pair, int i, int j, const hs_args *args, hs_error *err)
{
    hs_pair_coeff c = {.cutoff = 0.0};
    HS_TRY(hs_arg_not_negative(args, 0, &c.c[0], err));
    HS_TRY(hs_arg_positive(args, 1, &c.cutoff, err));
    *hs_pair_coeffs_at(pair, i, j) = c;
    return HS_OK;
}

static hs_status mix(hs_pair *pair, int i, int j, hs_error *err)
{
    const hs_pair_coeff a = *hs_pair_coeffs_at(pair, i, i), b = *hs_pair_coeffs_at(pair, j, j);
    (void)err;
    *hs_pair_coeffs_at(pair, i, j) =
        (hs_pair_coeff){.c = {sqrt(a.c[0] * b.c[0])}, .cutoff = 0.5 * (a.cutoff + b.cutoff)};
    return HS_OK;
}

/** Parameters of the harmonic_cut evaluator, in its order. */
static void params(const hs_pair *pair, int i, int j, double *cutoff, double *p)
{
    const hs_pair_coeff c = *hs_pair_coeffs_at(pair, i, j);
    *cutoff = p[0] = c.cutoff;
    p[1] = c.c[0] / (c.cutoff * c.cutoff);
    p[2] = 0.5 * p[1];
}

const hs_pair_style hs_pair_style_harmonic_repulsion = {
    .about = {.name = "harmonic/repulsion",
              .syntax = {.usage = "", .n_min = 0, .n_max = 0},
              .summary = "harmonic repulsion (k/2) (1 - r/r0)^2 of soft spheres that touch at r0",
              .details = "U(r) = (k/2) (1 - r/r0)^2 for r < r0, 0 beyond: the soft spheres of work on jamming, foams "
                         "and grains without friction.\n\n"
                         "`pair_coeff I J <k> <r0>`: k (energy, above or at zero) and r0 (distance), the sum of the "
                         "two radii. Energy and force are zero at r0. Unlike pairs are mixed: k by the geometric mean, "
                         "r0 always by the arithmetic mean, as sums of radii are. (LAMMPS's `harmonic/cut` is the same "
                         "with k/(2 r0^2) for its constant.)",
              .reference = "C. S. O'Hern, L. E. Silbert, A. J. Liu, S. R. Nagel, Phys. Rev. E 68, 011306 (2003), "
                           "doi:10.1103/PhysRevE.68.011306",
              .example = "pair_style harmonic/repulsion\npair_coeff 1 1 100.0 1.0\npair_coeff 2 2 100.0 1.4"},
    .coeff_syntax = {.usage = "<k> <r0>", .n_min = 2, .n_max = 2},
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
