/** Halo atoms: copies of periodic images (and of other ranks' atoms) within reach of this rank's brick.
 *
 *  Only the images in the "upper half" of directions are made: shifts (a, b, c) whose first nonzero number is positive.
 *  A pair across a boundary is then met exactly once, by the lower of its two atoms, and half the halo is enough
 *  (half-shell method: D. E. Shaw, J. Comput. Chem. 26, 1318 (2005), doi:10.1002/jcc.20267). The force on a halo atom
 *  goes back to its owner with hs_halo_reverse. Boxes smaller than the reach get several layers of images. */
#ifndef HS_COMM_HALO_H
#define HS_COMM_HALO_H

#include "core/atoms.h"
#include "core/box.h"

/** One direction: where its atoms stand in the lists, and the shift to add to their positions. */
typedef struct hs_halo_direction {
    int begin, end;  /**< range of source[] and slot[] */
    double shift[3]; /**< distance */
} hs_halo_direction;

typedef struct hs_halo {
    int n; /**< halo atoms */
    int n_directions;
    hs_halo_direction *direction; /**< owned [n_directions], in lexicographic order of shifts */
    int32_t *source;              /**< owned [n]: local index of the atom copied */
    int32_t *slot;                /**< owned [n]: halo atom k stands at index n_local + slot[k] */
    int capacity, capacity_directions;
    uint64_t generation; /**< of the atoms this halo belongs to */
} hs_halo;

/** Choose the halo of the local atoms (which must lie in the box along periodic axes), sized to reach, and fill positions
 *  and types, in order of direction (slot[k] = k). Threaded; the result does not depend on the number of threads. */
HS_MUST_USE hs_status hs_halo_build(hs_halo *halo, const hs_box *box, hs_atoms *atoms, double reach, hs_error *err);
/** Put halo atom order[q] at place q (a permutation of [0, n)); positions and types are filled anew. */
void hs_halo_reorder(hs_halo *halo, hs_atoms *atoms, const int32_t *order);
/** Positions of halo atoms from those of their sources. */
void hs_halo_forward(const hs_halo *halo, hs_atoms *atoms);
/** The same for any per-atom array of positions [3] with room for the halo (reference positions of lists). */
void hs_halo_forward_positions(const hs_halo *halo, const hs_atoms *atoms, double *const position[3]);
/** Copy an integer per-atom array to the halo. */
void hs_halo_forward_int(const hs_halo *halo, const hs_atoms *atoms, int32_t *values);
/** Add forces of halo atoms to their sources. The order of additions does not depend on the number of threads. */
void hs_halo_reverse(const hs_halo *halo, hs_atoms *atoms);
void hs_halo_fini(hs_halo *halo);

#endif
