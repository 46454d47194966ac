/* several pair styles at once, whose forces are added: see style/pair_hybrid.h. */
#include "style/pair_hybrid.h"

static hs_status coeff(hs_pair *pair, int i, int j, const hs_args *args, hs_error *err)
{
    return hs_pair_hybrid_coeff(pair, i, j, args, true, err);
}

const hs_pair_style hs_pair_style_hybrid_overlay = {
    .about =
        {.name = "hybrid/overlay",
         .syntax = {.usage = "<sub-style> [words of the sub-style] ...", .n_min = 1, .n_max = -1},
         .summary = "several pair styles at once, whose forces are added",
         .details =
             "Each pair of types has the potentials of all sub-styles that its pair_coeffs gave it; their forces and "
             "energies are added.\n\n"
             "`pair_style hybrid/overlay" HS_PAIR_HYBRID_DETAILS,
         .example = "pair_style hybrid/overlay lj/cut 2.5 yukawa 2.0 3.0\npair_coeff * * lj/cut 1.0 1.0\npair_coeff 1 "
                    "1 yukawa 5.0\npair_modify pair lj/cut shift yes"},
    .coeff_syntax = HS_PAIR_HYBRID_COEFF_SYNTAX,
    .settings = hs_pair_hybrid_settings,
    .coeff = coeff,
    .is_hybrid = true,
};
