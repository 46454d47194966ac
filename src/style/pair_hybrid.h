/** What the hybrid pair styles share: several styles at once, whose forces are added. They are the parts of the pair
 *  (hs_pair.part), made by ->settings; every part has its own coefficients, cutoffs and pair_modify settings. */
#ifndef HS_STYLE_PAIR_HYBRID_H
#define HS_STYLE_PAIR_HYBRID_H

#include "style/pair.h"

/** Words of pair_style: sub-styles, each followed by its own words. Parts that are there already keep their
 *  coefficients when the sub-styles are the same as before. */
HS_MUST_USE hs_status hs_pair_hybrid_settings(hs_pair *pair, const hs_args *args, hs_error *err);
/** The part that words from @p first on name: a sub-style and, when it occurs more than once, its number. *n_words of
 *  them are used. */
HS_MUST_USE hs_status hs_pair_hybrid_find(const hs_pair *pair, const hs_args *args, int first, hs_pair **part,
                                          int *n_words, hs_error *err);
/** Words of pair_coeff after the types: a part and its coefficients, or `none`. @p is_added: beside, not instead of,
 *  the parts the pair of types has. */
HS_MUST_USE hs_status hs_pair_hybrid_coeff(hs_pair *pair, int i, int j, const hs_args *args, bool is_added,
                                           hs_error *err);

/** What the descriptors share: after "`pair_style <style>" the same words of the manual; the syntax of pair_coeff. */
#define HS_PAIR_HYBRID_DETAILS                                                                                         \
    " <sub-style> <words> <sub-style> <words> ...` names pair styles, each followed by its own words. "                \
    "`pair_coeff I J <sub-style> <coefficients>` gives a pair of types the coefficients of one of them; "              \
    "when a sub-style occurs more than once, its number comes after its name (`pair_coeff 1 1 lj/cut 2 "               \
    "1.0 1.0`). `pair_coeff I J none` takes all sub-styles from a pair of types. Pairs of different "                  \
    "types that are not given are mixed when both types have the same sub-styles, and these can be "                   \
    "mixed.\n\n`pair_modify pair <sub-style> [<number>] <keyword> <value> ...` changes one sub-style, "                \
    "pair_modify without it all. The neighbor list is that of the largest cutoff of each pair of types. "              \
    "Data files hold no coefficients of hybrid styles: give them in the deck."
#define HS_PAIR_HYBRID_COEFF_SYNTAX                                                                                    \
    {                                                                                                                  \
        .usage = "<sub-style> [<number>] [coefficients of the sub-style] | none", .n_min = 1, .n_max = -1              \
    }

#endif
