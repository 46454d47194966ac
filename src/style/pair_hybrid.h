/** What the hybrid pair styles share: several styles at once, whose forces are added. They are the parts of the pair
 *  (hs_pair.part), made by ->settings; every part has its own coefficients, cutoffs and pair_modify settings. */
#ifndef HS_STYLE_PAIR_HYBRID_H
#define HS_STYLE_PAIR_HYBRID_H

#include "style/pair.h"

/** Words of pair_style: sub-styles, each followed by its own words. Parts that are there already keep their coefficients
 *  when the sub-styles are the same as before. */
HS_MUST_USE hs_status hs_pair_hybrid_settings(hs_pair *pair, const hs_args *args, hs_error *err);
/** The part that words from @p first on name: a sub-style and, when it occurs more than once, its number. *n_words of them
 *  are used. */
HS_MUST_USE hs_status hs_pair_hybrid_find(const hs_pair *pair, const hs_args *args, int first, hs_pair **part,
                                          int *n_words, hs_error *err);
/** Words of pair_coeff after the types: a part and its coefficients, or `none`. @p is_added: beside, not instead of, the
 *  parts the pair of types has. */
HS_MUST_USE hs_status hs_pair_hybrid_coeff(hs_pair *pair, int i, int j, const hs_args *args, bool is_added,
                                           hs_error *err);

#endif
