/* several pair styles, one for each pair of types: see style/pair_hybrid.h. */
#include "style/pair_hybrid.h"

static hs_status coeff(hs_pair *pair, int i, int j, const hs_args *args, hs_error *err)
{
    return hs_pair_hybrid_coeff(pair, i, j, args, false, err);
}

const hs_pair_style hs_pair_style_hybrid = {
    .about = {.name = "hybrid",
              .syntax = {.usage = "<sub-style> [words of the sub-style] ...", .n_min = 1, .n_max = -1},
              .summary = "several pair styles, one for each pair of types",
              .details =
                  "Each pair of types has the potential of one sub-style: the last that a pair_coeff gave it.\n\n"
                  "`pair_style hybrid" HS_PAIR_HYBRID_DETAILS,
              .example = "pair_style hybrid lj/cut 2.5 soft 1.2\npair_coeff 1 1 lj/cut 1.0 1.0\npair_coeff 2 2 soft "
                         "20.0\npair_coeff 1 2 none"},
    .coeff_syntax = HS_PAIR_HYBRID_COEFF_SYNTAX,
    .settings = hs_pair_hybrid_settings,
    .coeff = coeff,
    .is_hybrid = true,
};
