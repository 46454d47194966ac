/** Numbers of the atoms that several styles want: arrays of hs_atoms that are there from the first who wants them to the last who
 *  gives them up. */
#ifndef HS_STYLE_SHARED_FIELDS_H
#define HS_STYLE_SHARED_FIELDS_H

#include "core/atoms.h"

/** Make of[n], [n_local] each and zero at first, fields of these names unless they are there, and count one user more. */
HS_MUST_USE hs_status hs_shared_fields_want(hs_atoms *atoms, double **of, const char *const *name, int n, int *n_users,
                                            hs_error *err);
/** One user less; after the last of[n] are NULL. */
void hs_shared_fields_release(hs_atoms *atoms, double **of, int n, int *n_users);
/** 0 for the local atoms, if the fields are there. */
void hs_shared_fields_clear(const hs_atoms *atoms, double *const *of, int n);

#endif
