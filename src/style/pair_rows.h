/** Pairs of atoms as rows in one order: for what is told of every single pair.
 *
 *  The order is that of the ids of the two atoms, the lower one first; of several images of one pair (in boxes that are shorter than
 *  twice the cutoff) that of the components of their distance. Every rank has the rows whose lower ids are in its part of all
 *  ids, so that the rows of rank 0, then 1, and so on, are in that order. */
#ifndef HS_STYLE_PAIR_ROWS_H
#define HS_STYLE_PAIR_ROWS_H

#include "style/compute.h"

/** Which pairs. */
typedef enum {
    HS_PAIRS_IN_CUTOFF,  /**< nearer than the cutoff of their types, at the places of the latest forces */
    HS_PAIRS_IN_CONTACT, /**< of those in the lists the ones nearer than the sum of their radii, at the same places */
    HS_PAIRS_IN_LISTS    /**< within cutoff and skin when the lists were made, at the places of that moment */
} hs_pair_choice;

typedef struct hs_pair_row {
    int64_t id[2]; /**< id[0] <= id[1]; equal: an atom and an image of itself */
    int32_t type[2];
    /** Distance r_0 - r_1; of an atom and its image the one whose first component that is not 0 is positive. */
    double d[3];
    /** Of the force on atom 0, which is force_over_r d: energy/distance^2; positive: the atoms repel each other. */
    double force_over_r;
    double energy;
} hs_pair_row;

/** A row's place in the order: its ids once more, so that sorting leaves the rows alone. */
typedef struct hs_pair_place {
    int64_t id[2];
    const hs_pair_row *row;
} hs_pair_place;

/** Rows in the order in which they were found. */
typedef struct hs_pair_piece {
    hs_pair_row *row; /**< owned [capacity] */
    size_t n, capacity;
    hs_error err; /**< of its making */
} hs_pair_piece;

typedef struct hs_pair_rows {
    hs_pair_place *order; /**< owned [n]: the rows in their order */
    int64_t n;            /**< of this rank */
    hs_pair_piece *piece; /**< owned [n_pieces]: the rows */
    int n_pieces;
} hs_pair_rows;

/** Find the pairs both of whose atoms are in the compute's group (collective, errors agreed). @p with_forces: forces and energies
 *  are wanted, which of pairs in lists are 0. @p n_expected: for how many there is room from the start. *rows is the caller's: hs_pair_rows_fini, also after an error. An error before the first
 *  run, and without a pair style that has cutoffs. */
HS_MUST_USE hs_status hs_pair_rows_find(hs_pair_rows *rows, const hs_compute *compute, hs_pair_choice choice,
                                        bool with_forces, int64_t n_expected, hs_error *err);
void hs_pair_rows_fini(hs_pair_rows *rows);

#endif
