/** Values of atoms that the deck has added with fix property/atom: i_NAME, whole numbers, and d_NAME, real ones. They
 *  are fields of the atoms (hs_atoms_add_field), "fix i_NAME" of int32_t and "fix d_NAME" of double. */
#ifndef HS_STYLE_CUSTOM_ATOM_H
#define HS_STYLE_CUSTOM_ATOM_H

#include "core/atoms.h"

/** Whether a word has the form of such a name: i_ or d_, then letters, digits and underscores. */
bool hs_custom_atom_is_name(const char *word);
/** The field of kind 'i' or 'd' and that name (without the prefix); NULL: there is none. Valid until fields are added
 *  or removed. */
const hs_atom_field *hs_custom_atom_find(const hs_atoms *atoms, char kind, const char *name);
/** The field of that name, such as d_NAME; an error that names @p command when there is none. */
HS_MUST_USE hs_status hs_custom_atom_get(const hs_atoms *atoms, const char *name, const char *command,
                                         const hs_atom_field **field, hs_error *err);
/** out[n_local]. Not collective. */
void hs_custom_atom_read(const hs_atoms *atoms, const hs_atom_field *field, double *out);
/** Give flagged local atoms (all when @p flag is NULL) their values[n_local]; whole numbers are cut off towards 0. An
 *  error, which names @p command, when one is too large for that. Not collective. */
HS_MUST_USE hs_status hs_custom_atom_write(const hs_atoms *atoms, const hs_atom_field *field, const unsigned char *flag,
                                           const double *values, const char *command, hs_error *err);

#endif
