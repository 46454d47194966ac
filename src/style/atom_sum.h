/** Sums over atoms whose digits do not depend on the number of threads. */
#ifndef HS_STYLE_ATOM_SUM_H
#define HS_STYLE_ATOM_SUM_H

#include "core/atoms.h"
#include "parallel/parallel.h"

enum { HS_ATOM_SUM_MAX = 8 }; /**< sums that one call can make */

/** Add the terms of local atoms [begin, end) to sums[]; called for ranges of atoms by several threads at once. */
typedef void (*hs_atom_terms)(const hs_atoms *atoms, const void *context, int begin, int end, double *sums);

/** sums[n] over all atoms of all ranks (collective). Atoms are summed in fixed chunks and the chunks in order, so the
 *  result is the same for any number of threads. */
HS_MUST_USE hs_status hs_atom_sum(const hs_atoms *atoms, const hs_parallel *parallel, hs_atom_terms terms,
                                  const void *context, int n, double *sums, hs_error *err);

/** Atoms with a group bit of @p mask on all ranks (collective). */
int64_t hs_atom_count(const hs_atoms *atoms, const hs_parallel *parallel, uint32_t mask);

#endif
