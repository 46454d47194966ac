/* Lennard-Jones 9-6, truncated:  U(r) = 4 eps ((sigma/r)^9 - (sigma/r)^6) - shift   for r < r_c. It has no
 * evaluator of its own: see mie_cut.c.
 * Units: eps energy, sigma and r_c distance. */
#include "pair/powers.h"

extern const hs_evaluator hs_evaluator_mie_cut;

static hs_powers powers_of(const hs_pair_coeff *c)
{
    const double epsilon = c->c[HS_LJ_EPSILON], sigma = c->c[HS_LJ_SIGMA];
    return (hs_powers){.a = 4.0 * epsilon * pow(sigma, 9.0), .n = 9.0, .b = 4.0 * epsilon * pow(sigma, 6.0), .m = 6.0};
}

const hs_pair_style hs_pair_style_lj96_cut = {
    .about = {.name = "lj96/cut",
              .syntax = {.usage = "<cutoff>", .n_min = 1, .n_max = 1},
              .summary = "Lennard-Jones 9-6 potential, softer than 12-6",
              .details = "U(r) = 4 epsilon [(sigma/r)^9 - (sigma/r)^6] for r < cutoff, 0 beyond. The depth of the "
                         "minimum is 16/27 epsilon.\n\n`pair_coeff I J <epsilon> <sigma> [<cutoff>]`: energy, and the "
                         "distance where the energy is zero. Pairs of different types that are not given are mixed "
                         "from their like pairs (`pair_modify mix`). `pair_modify shift yes` makes the energy zero at "
                         "the cutoff; `pair_modify tail yes` adds the long-range part to energy and pressure.",
              .reference = "M. Waldman, A. T. Hagler, J. Comput. Chem. 14, 1077 (1993), doi:10.1002/jcc.540140909",
              .example = "pair_style lj96/cut 2.5\npair_coeff * * 1.0 1.0\npair_modify mix sixthpower"},
    .coeff_syntax = {.usage = "<epsilon> <sigma> [<cutoff>]", .n_min = 2, .n_max = 3},
    .adaptable = HS_LJ_ADAPTABLE,
    HS_PAIR_COEFFS_HOOKS,
    .coeff = hs_lj_coeff,
    .mix = hs_lj_mix,
    .params = hs_powers_params,
    .tail = hs_powers_tail,
    .evaluator = &hs_evaluator_mie_cut,
};
