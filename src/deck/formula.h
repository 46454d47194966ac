/** Formulas of equal-style, vector-style and atom-style variables and of $(...), with LAMMPS's grammar and
 *  precedence. */
#ifndef HS_DECK_FORMULA_H
#define HS_DECK_FORMULA_H

#include "deck/deck.h"
#include "style/value.h"

typedef struct hs_formula hs_formula;

/** Read a formula. Operators from weakest to strongest, all from left to right: || |^, &&, == !=, < <= > >=, + -,
 *  * / %, ^, and last the signs - and !, so that -2^2 is 4 as in LAMMPS. Names of functions, keywords and attributes
 *  are checked here; IDs of computes, fixes, groups, regions and variables when the formula is evaluated.
 *  The caller frees it with hs_formula_destroy. Not collective.
 *  @param shape  what it is to give: a number, a vector, or a number for each atom, which may be made of others that
 *                there are for each atom */
HS_MUST_USE hs_status hs_formula_parse(hs_formula **formula, const char *text, hs_value_shape shape, hs_error *err);
void hs_formula_destroy(hs_formula **formula);
/** The text it was made from; borrowed. */
const char *hs_formula_text(const hs_formula *formula);

/** Evaluate to one number (collective). Numbers that are not finite are errors. */
HS_MUST_USE hs_status hs_formula_value(const hs_formula *formula, hs_deck *deck, double *value, hs_error *err);
/** Evaluate for every local atom: values[n_local] (collective). */
HS_MUST_USE hs_status hs_formula_atoms(const hs_formula *formula, hs_deck *deck, double *values, hs_error *err);
/** Length of the vector that the vectors in the formula give, 0 when there is none in it, and whether it varies. With
 *  @p refresh those of varying length are brought up to date before (collective; else it cannot fail). */
HS_MUST_USE hs_status hs_formula_length(const hs_formula *formula, hs_deck *deck, bool refresh, int *length,
                                        bool *varies, hs_error *err);
/** Evaluate to a vector: values[length], the length being that of now. Vectors of other lengths in it are errors
 *  (collective). */
HS_MUST_USE hs_status hs_formula_vector(const hs_formula *formula, hs_deck *deck, int length, double *values,
                                        hs_error *err);
/** As hs_formula_atoms for a formula that is part of another one: its random numbers are drawn together with that one's. */
HS_MUST_USE hs_status hs_formula_atoms_within(const hs_formula *formula, hs_deck *deck, double *values, hs_error *err);

/** Evaluate a formula that is used once: $(...). Collective. */
HS_MUST_USE hs_status hs_formula_once(hs_deck *deck, const char *text, double *value, hs_error *err);

#endif
