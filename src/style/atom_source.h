/** Numbers of each atom that a deck names: an attribute (x, vx ...), c_ID, c_ID[k], f_ID, f_ID[k], v_name; or, where that makes no
 *  difference to who reads them, of each row of local values. */
#ifndef HS_STYLE_ATOM_SOURCE_H
#define HS_STYLE_ATOM_SOURCE_H

#include "style/attribute.h"
#include "style/value.h"

/** One of them. */
typedef struct hs_atom_source {
    int attribute; /**< hs_attribute; -1: the value */
    hs_value value;
    hs_value_shape shape; /**< of the value: HS_VALUE_ATOMS, unless its reader says otherwise */
} hs_atom_source;

/** Attributes that move an atom: x y z vx vy vz fx fy fz, ended by NULL. */
extern const char *const hs_atom_source_motion[];

/** Read words; of those that are no references only the @p attributes (names, ended by NULL) are allowed, if the atoms
 *  have them, and ranges become several sources. (*sources)[*n] is the caller's: hs_atom_sources_destroy. Not
 *  collective. */
HS_MUST_USE hs_status hs_atom_sources_read(hs_atom_source **sources, int *n, hs_env *env, const hs_args *args,
                                           int first, int n_words, const char *const *attributes, hs_error *err);
/** The same, where a reference to local values becomes a source of the shape HS_VALUE_LOCAL. */
HS_MUST_USE hs_status hs_atom_sources_read_any(hs_atom_source **sources, int *n, hs_env *env, const hs_args *args,
                                               int first, int n_words, const char *const *attributes, hs_error *err);
/** Append an attribute, or (-1) the values[n_values] of that shape, which are taken over, also at an error. */
HS_MUST_USE hs_status hs_atom_sources_add(hs_atom_source **sources, int *n, int attribute, hs_value **values,
                                          int n_values, hs_value_shape shape, hs_error *err);
void hs_atom_sources_destroy(hs_atom_source **sources, int n);

/** Fail, naming @p command, unless the values are there still (hs_value_check). */
HS_MUST_USE hs_status hs_atom_sources_check(hs_env *env, const hs_atom_source *sources, int n, const char *command,
                                            hs_error *err);
/** Whether one of them may ask for the pair energy or virial. */
bool hs_atom_sources_need_energy(hs_env *env, const hs_atom_source *sources, int n);
/** Of sources that are of atoms: out[n_local], of the local atoms with (atoms->mask[i] & mask); 0 of others (collective). */
HS_MUST_USE hs_status hs_atom_source_values(hs_env *env, const hs_atom_source *source, uint32_t mask, double *out,
                                            hs_error *err);

#endif
