/** Coefficients of pair styles whose pair_coeff line is some numbers and perhaps a cutoff: most of them. */
#ifndef HS_STYLE_PAIR_COEFFS_H
#define HS_STYLE_PAIR_COEFFS_H

#include "style/pair.h"
#include "style/state.h"

enum { HS_COEFFS_MAX = 8 };

/** Of one pair of types. */
typedef struct hs_pair_coeff {
    double c[HS_COEFFS_MAX]; /**< in the order of the words; what they mean is the style's */
    double cutoff;           /**< distance; 0: no interaction */
} hs_pair_coeff;

/** State of such a style (or its first member). */
typedef struct hs_pair_coeffs {
    double cutoff;     /**< of pairs that are given none of their own, distance */
    hs_pair_coeff *at; /**< owned, by hs_pair_index */
} hs_pair_coeffs;

static inline hs_pair_coeff *hs_pair_coeffs_at(const hs_pair *pair, int i, int j)
{
    return &((hs_pair_coeffs *)pair->state)->at[hs_pair_index(pair, i, j)];
}

/** Set the cutoff of all pairs that are given none of their own. When pair_style is given again, also the cutoffs that
 *  earlier pair_coeffs set become this one. */
HS_MUST_USE hs_status hs_pair_coeffs_set_cutoff(hs_pair *pair, double cutoff, hs_error *err);
/** A pair_style whose only word is that cutoff: ->settings of most styles. */
HS_MUST_USE hs_status hs_pair_coeffs_settings(hs_pair *pair, const hs_args *args, hs_error *err);
/** A pair_style without words, whose cutoffs follow from the coefficients. */
HS_MUST_USE hs_status hs_pair_coeffs_no_settings(hs_pair *pair, const hs_args *args, hs_error *err);
/** Cutoff of a pair from word @p i, or the one of all pairs when there is no such word. */
HS_MUST_USE hs_status hs_pair_coeffs_read_cutoff(const hs_pair *pair, const hs_args *args, int i, double *cutoff,
                                                 hs_error *err);
/** One pair_coeff: words 0, 1 ... are coefficients, of the kinds that the letters tell ('n' any number, '0' one that is not
 *  negative, '+' a positive one), and the word behind them, where there is one, is the cutoff. */
HS_MUST_USE hs_status hs_pair_coeffs_read(const hs_pair *pair, const char *kinds, const hs_args *args,
                                          hs_pair_coeff *coeff, hs_error *err);
/** The same into the pair of types i, j, which keeps what it has when a word is refused. */
HS_MUST_USE hs_status hs_pair_coeffs_set(const hs_pair *pair, int i, int j, const char *kinds, const hs_args *args,
                                         hs_error *err);
/** The coefficients that fix adapt may change, of all pairs of types: moved into a checkpoint or back; their names
 *  there begin with @p name. */
HS_MUST_USE hs_status hs_pair_coeffs_keep(hs_pair *pair, const char *name, hs_state *state, hs_error *err);
/** ->write_coeff of styles whose last word of pair_coeff (coeff_syntax.n_max) is the cutoff, and the others the
 *  coefficients in their order. Numbers have the digits that bring them back. */
HS_MUST_USE hs_status hs_pair_coeffs_write(const hs_pair *pair, int i, int j, hs_text *words, hs_error *err);
/** The same of styles whose words are all coefficients: their cutoffs follow from these. */
HS_MUST_USE hs_status hs_pair_coeffs_write_bare(const hs_pair *pair, int i, int j, hs_text *words, hs_error *err);
/* Hooks of styles with one coefficient, mixed by the geometric mean, and a cutoff, mixed as a distance. */
HS_MUST_USE hs_status hs_pair_coeffs_read_one(hs_pair *pair, int i, int j, const hs_args *args, hs_error *err);
HS_MUST_USE hs_status hs_pair_coeffs_mix_one(hs_pair *pair, int i, int j, hs_error *err);
/** ->destroy of all these styles. */
void hs_pair_coeffs_destroy(hs_pair *pair);

/** State and hooks of styles whose pair_style is a cutoff, and whose pair_coeff are coefficients and perhaps another. */
#define HS_PAIR_COEFFS_HOOKS                                                                                           \
    .state_size = sizeof(hs_pair_coeffs), .settings = hs_pair_coeffs_settings, .destroy = hs_pair_coeffs_destroy,      \
    .write_coeff = hs_pair_coeffs_write

#endif
