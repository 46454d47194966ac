/** Formulas of equal-style and atom-style variables and of $(...), with LAMMPS's grammar and precedence. */
#ifndef HS_DECK_FORMULA_H
#define HS_DECK_FORMULA_H

#include "deck/deck.h"

typedef struct hs_formula hs_formula;

/** Read a formula. Operators from weakest to strongest, all from left to right: || |^, &&, == !=, < <= > >=, + -,
 *  * / %, ^, and last the signs - and !, so that -2^2 is 4 as in LAMMPS. Names of functions, keywords and attributes
 *  are checked here; IDs of computes, fixes, groups, regions and variables when the formula is evaluated.
 *  The caller frees it with hs_formula_destroy. Not collective.
 *  @param per_atom  per-atom quantities are allowed (atom-style variables) */
HS_MUST_USE hs_status hs_formula_parse(hs_formula **formula, const char *text, bool per_atom, hs_error *err);
void hs_formula_destroy(hs_formula **formula);
/** The text it was made from; borrowed. */
const char *hs_formula_text(const hs_formula *formula);

/** Evaluate to one number (collective). Numbers that are not finite are errors. */
HS_MUST_USE hs_status hs_formula_value(const hs_formula *formula, hs_deck *deck, double *value, hs_error *err);
/** Evaluate for every local atom: values[n_local] (collective). */
HS_MUST_USE hs_status hs_formula_atoms(const hs_formula *formula, hs_deck *deck, double *values, hs_error *err);
/** The same for a formula that is part of another one: its random numbers are drawn together with that one's. */
HS_MUST_USE hs_status hs_formula_atoms_within(const hs_formula *formula, hs_deck *deck, double *values, hs_error *err);

/** Evaluate a formula that is used once: $(...). Collective. */
HS_MUST_USE hs_status hs_formula_once(hs_deck *deck, const char *text, double *value, hs_error *err);

#endif
