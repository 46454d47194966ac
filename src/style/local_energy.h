/** The energy of an atom at a place, with all other atoms: what Monte Carlo moves and test particles ask for.
 *
 *  Every rank sums over its own atoms near any periodic image of the place, and the parts are put together exactly, so the bits depend
 *  on no order. No list, halo or neighbor method is used: atoms may be anywhere, before they are wrapped and sent to other ranks, too;
 *  only the types may change meanwhile. Pairs within their cutoff count at their present distance, whatever the lists say. */
#ifndef HS_STYLE_LOCAL_ENERGY_H
#define HS_STYLE_LOCAL_ENERGY_H

#include "core/exact_sum.h"
#include "neighbor/cell_list.h"
#include "style/fix.h"
#include "style/pair_scan.h"

enum { HS_LOCAL_TYPES = 2 };

typedef struct hs_local_energy {
    const hs_env *env;
    hs_pair_view view;
    double too_high;     /**< a pair of more energy is an overlap */
    double lo[3], hi[3]; /**< of this rank's atoms, distance */
    hs_cell_list *cells; /**< owned: these atoms, without images; NULL: none, or nothing interacts */
    int64_t *n_of_type;  /**< owned [n_types + 1] atoms of all ranks; whoever changes types keeps it up to date */
    bool has_tail;       /**< pair_modify tail: long-range corrections */
} hs_local_energy;

/** Get ready, with the atoms where they are now (collective). @p who names the fix in messages; pairs of more energy than
 *  @p too_high are overlaps. Zero it before; always followed by hs_local_energy_end, also after an error. */
HS_MUST_USE hs_status hs_local_energy_begin(hs_local_energy *local, const hs_fix *fix, double too_high, hs_error *err);
void hs_local_energy_end(hs_local_energy *local);
/** Exclusion class of local atom i, and 0 for a test particle. */
int hs_local_energy_class(const hs_local_energy *local, int i);
/** Add this rank's part of the energy of an atom of the class at @p x, with each of n types (at most HS_LOCAL_TYPES), to
 *  sums[n], and of overlaps to n_overlaps[n]. The atoms with the ids left_out[2] (0: none) do not count. Not collective;
 *  threads may add to different sums. */
void hs_local_energy_add(const hs_local_energy *local, const double x[3], int class, const int *type, int n,
                         const int64_t left_out[2], hs_exact_sum *sums, int64_t *n_overlaps);
/** Energies and overlaps over all ranks; the sums are used up (collective). */
void hs_local_energy_total(const hs_local_energy *local, hs_exact_sum *sums, int n, double *energy,
                           int64_t *n_overlaps);
/** Long-range corrections that the present atoms and one more of a type bring, less those without it; energy. */
double hs_local_energy_tail(const hs_local_energy *local, int type);

#endif
