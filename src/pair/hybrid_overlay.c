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
             "`pair_style hybrid/overlay <sub-style> <words> <sub-style> <words> ...` names pair styles, each followed "
             "by its own "
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
         .example = "pair_style hybrid/overlay lj/cut 2.5 yukawa 2.0 3.0\npair_coeff * * lj/cut 1.0 1.0\npair_coeff 1 "
                    "1 yukawa 5.0\npair_modify pair lj/cut shift yes"},
    .coeff_syntax = {.usage = "<sub-style> [<number>] [coefficients of the sub-style] | none", .n_min = 1, .n_max = -1},
    .settings = hs_pair_hybrid_settings,
    .coeff = coeff,
    .is_hybrid = true,
};
