/* several pair styles, one for each pair of types: see style/pair_hybrid.h. */
#include "style/pair_hybrid.h"

static hs_status coeff(hs_pair *pair, int i, int j, const hs_args *args, hs_error *err)
{
    return hs_pair_hybrid_coeff(pair, i, j, args, false, err);
}

const hs_pair_style hs_pair_style_hybrid = {
    .about =
        {.name = "hybrid",
         .syntax = {.usage = "<sub-style> [words of the sub-style] ...", .n_min = 1, .n_max = -1},
         .summary = "several pair styles, one for each pair of types",
         .details =
             "Each pair of types has the potential of one sub-style: the last that a pair_coeff gave it.\n\n"
             "`pair_style hybrid <sub-style> <words> <sub-style> <words> ...` names pair styles, each followed by its "
             "own "
             "words. `pair_coeff I J <sub-style> <coefficients>` gives a pair of types the coefficients of one of "
             "them; when a "
             "sub-style occurs more than once, its number comes after its name (`pair_coeff 1 1 lj/cut 2 1.0 1.0`). "
             "`pair_coeff I J none` takes all sub-styles from a pair of types. Pairs of different types that are not "
             "given "
             "are mixed when both types have the same sub-styles, and these can be mixed.\n\n"
             "`pair_modify pair <sub-style> [<number>] <keyword> <value> ...` changes one sub-style, pair_modify "
             "without it "
             "all. The neighbor list is that of the largest cutoff of each pair of types. Data files hold no "
             "coefficients of hybrid styles: give them in the deck.",
         .example = "pair_style hybrid lj/cut 2.5 soft 1.2\npair_coeff 1 1 lj/cut 1.0 1.0\npair_coeff 2 2 soft "
                    "20.0\npair_coeff 1 2 none"},
    .coeff_syntax = {.usage = "<sub-style> [<number>] [coefficients of the sub-style] | none", .n_min = 1, .n_max = -1},
    .settings = hs_pair_hybrid_settings,
    .coeff = coeff,
    .is_hybrid = true,
};
