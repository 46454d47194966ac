/** A vector of each atom that belongs to a fix or a compute and travels with the atoms. */
#ifndef HS_STYLE_ATOM_VECTOR_H
#define HS_STYLE_ATOM_VECTOR_H

#include "style/env.h"

/** Zero it before first use. */
typedef struct hs_atom_vector {
    double *of[3]; /**< [n_local]; memory of hs_atoms */
    char *name[3]; /**< owned: "<kind> <ID> <what> x", ...; by these names restarts find them */
} hs_atom_vector;

/** Register it, zero at first; @p kind is "fix" or "compute". */
HS_MUST_USE hs_status hs_atom_vector_add(hs_atoms *atoms, hs_atom_vector *vector, const char *kind, const char *id,
                                         const char *what, hs_error *err);
/** Set it to the unwrapped places of the local atoms, distance, less @p origin. That of an atom that is made later is
 *  where it is made. */
void hs_atom_vector_set_places(hs_atom_vector *vector, const hs_env *env, const double origin[3]);
/** Also for one that was never, or not wholly, added. */
void hs_atom_vector_remove(hs_atoms *atoms, hs_atom_vector *vector);

#endif
