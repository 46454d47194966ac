/** Sums over atoms whose bits depend neither on threads nor on ranks nor on the order of the atoms. */
#ifndef HS_STYLE_ATOM_SUM_H
#define HS_STYLE_ATOM_SUM_H

#include "core/atoms.h"
#include "core/exact_sum.h"

enum { HS_ATOM_SUM_MAX = 8 }; /**< sums that one call can make */

/** Add the terms of local atoms [begin, end), at most HS_EXACT_ARRAY_MAX, to sums[] with hs_exact_add or
 *  hs_exact_add_array; called for ranges of atoms by several threads at once. A term is whatever can be computed from
 *  one atom alone; what belongs to that atom may be changed on the way, for each is met once. */
typedef void (*hs_atom_terms)(const hs_atoms *atoms, const void *context, int begin, int end, hs_exact_sum *sums);

/** Bring an array that will be read next nearer: sums that read many arrays but compute little wait for memory else,
 *  for the processor's own guesses end with every page and every change of arrays. */
#define HS_FETCH(array, n)                                                                                             \
    do {                                                                                                               \
        for (size_t k_ = 0; k_ < (size_t)(n) * sizeof *(array); k_ += 64)                                              \
            __builtin_prefetch((const char *)(array) + k_, 0, 2);                                                      \
    } while (0)

/** sums[n], n <= HS_ATOM_SUM_MAX, over all atoms of all ranks, each exact and rounded once (collective). */
void hs_atom_sum(const hs_atoms *atoms, const hs_parallel *parallel, hs_atom_terms terms, const void *context, int n,
                 double *sums);

/** The same over the items 0 ... n_items - 1 of each rank that are no atoms: terms gets none (collective). */
void hs_item_sum(int n_items, const hs_parallel *parallel, hs_atom_terms terms, const void *context, int n,
                 double *sums);

/** Sums that are made at every step and seldom read. What depends on the step is done at it, by each rank for itself;
 *  ranks put their parts together, and sums are rounded, when one is read. Zero-initialised all are 0. */
typedef struct hs_late_sums {
    hs_exact_sum part[HS_ATOM_SUM_MAX]; /**< this rank's; used up by reading */
    double value[HS_ATOM_SUM_MAX];
    int n; /**< that are made, and not read yet: 0 when values[] hold */
} hs_late_sums;

/** Make the sums anew from this rank's atoms. Not collective. */
void hs_late_sums_make(hs_late_sums *sums, const hs_atoms *atoms, hs_atom_terms terms, const void *context, int n);
/** The values, valid until sums are made again (collective). */
const double *hs_late_sums_read(hs_late_sums *sums, const hs_parallel *parallel);

/** Atoms with a group bit of @p mask on all ranks (collective). */
int64_t hs_atom_count(const hs_atoms *atoms, const hs_parallel *parallel, uint32_t mask);

#endif
