/** Halo atoms: copies of other ranks' atoms and of periodic images within reach of this rank's brick.
 *
 *  Only bricks and images in the "upper half" of directions are copied: offsets (a, b, c) from this brick whose first nonzero
 *  number is positive. A pair across a boundary is then met exactly once, by the lower of its two atoms, and half the halo
 *  is enough (half-shell method: D. E. Shaw, J. Comput. Chem. 26, 1318 (2005), doi:10.1002/jcc.20267). The force on a halo
 *  atom goes back to its owner with hs_halo_reverse. Bricks thinner than the reach get several layers. Offsets that lead
 *  around the box to this rank itself are copied without messages; all others that lead to one rank share one message. */
#ifndef HS_COMM_HALO_H
#define HS_COMM_HALO_H

#include "comm/domain.h"
#include "core/atoms.h"
#include "parallel/messages.h"

/** Atoms that go one way, or come from one way. */
typedef struct hs_halo_block {
    int offset[3];   /**< of the brick they come from, seen from the brick they go to */
    int rank;        /**< partner */
    int begin, end;  /**< blocks to send: range of source[]; blocks received: range of slot[] */
    int image[3];    /**< blocks to send: edges of the box to add to positions, */
    double shift[3]; /**< and what these are, distance */
} hs_halo_block;

/** All blocks sent, or all received: first those of this rank itself, then rank by rank, each in lexicographic order of
 *  offsets, which is the same on both sides. */
typedef struct hs_halo_side {
    hs_halo_block *block; /**< owned [n_blocks] */
    int n_blocks, n_self; /**< blocks [0, n_self) stay on this rank: the same on both sides */
    int n, n_self_atoms;  /**< atoms of all blocks, and of the first n_self */
    double *buffer;       /**< owned: HS_HALO_WORDS words for each atom of another rank's blocks */
    size_t capacity_blocks;
    int capacity_buffer;
} hs_halo_side;

enum { HS_HALO_WORDS = 3 }; /**< words of 8 bytes that a message carries for each atom */

typedef struct hs_halo {
    int n; /**< halo atoms */
    hs_halo_side out, in;
    int32_t *source;          /**< owned [out.n]: local index of the atom copied */
    int32_t *slot;            /**< owned [n]: halo atom k stands at index n_local + slot[k] */
    unsigned char *is_remote; /**< owned [n]: the one at index n_local + q comes from another rank */
    hs_messages forward, reverse;
    int capacity, capacity_source;
    uint64_t generation; /**< of the atoms this halo belongs to */
    uint64_t version;    /**< another one whenever other atoms are copied, or stand elsewhere */
    bool is_ascending;   /**< sources ascend in each block: not after hs_halo_follow */
    bool is_awaited;     /**< messages with positions are under way: between hs_halo_forward_send and _wait */
} hs_halo;

/** Choose the halo of the local atoms (which must lie in this rank's brick), sized to reach, and fill positions, in order
 *  of blocks (slot[k] = k). Threaded; the result does not depend on the number of threads. Collective; an error that one
 *  rank holds in @p err already, or meets here, stops all. */
HS_MUST_USE hs_status hs_halo_build(hs_halo *halo, const hs_domain *domain, const hs_parallel *parallel,
                                    const hs_box *box, hs_atoms *atoms, double reach, hs_error *err);
/** Put halo atom order[q] at place q (a permutation of [0, n)); positions are filled anew. Directly after a build or
 *  hs_halo_follow; not collective. */
void hs_halo_reorder(hs_halo *halo, hs_atoms *atoms, const int32_t *order);
/** The local atoms have been sorted: what stood at i stands at place[i]. The halo keeps its atoms; positions are filled anew, in
 *  order of blocks. Collective. */
void hs_halo_follow(hs_halo *halo, hs_atoms *atoms, const int32_t *place);
/** The box has other lengths or tilts than when the halo was built: shifts follow it. Not collective. */
void hs_halo_fit_box(hs_halo *halo, const hs_box *box);
/** Fill the halo part of all fields that go to the halo when it is made (hs_atom_field.goes_to_halo). Collective. */
void hs_halo_forward_fields(const hs_halo *halo, hs_atoms *atoms);
/** Positions of halo atoms from those of their sources. Collective. */
void hs_halo_forward(const hs_halo *halo, hs_atoms *atoms);
/* The same in parts, between which there may be work that needs no other rank's atoms: messages are sent, and own images made;
   messages have come; positions are taken from them. Collective. */
void hs_halo_forward_send(hs_halo *halo, hs_atoms *atoms);
void hs_halo_forward_wait(hs_halo *halo);
void hs_halo_forward_receive(const hs_halo *halo, hs_atoms *atoms);
/** The same for any per-atom array of positions [3] with room for the halo (reference positions of lists). Collective. */
void hs_halo_forward_positions(const hs_halo *halo, const hs_atoms *atoms, double *const position[3]);
/** Copy any per-atom array of @p size bytes an atom, with room for the halo, to the halo. Collective. */
void hs_halo_forward_array(const hs_halo *halo, const hs_atoms *atoms, void *values, size_t size);
/** Add forces of halo atoms to their sources. The order of additions does not depend on the number of threads. Collective.
 *  @p is_fixed: the forces are 64-bit integers in the place of doubles (fixed point). */
void hs_halo_reverse(const hs_halo *halo, hs_atoms *atoms, bool is_fixed);
/* The same in parts: forces on halo atoms are sent, which must be complete; those of own images are added, so all forces must be
   complete; messages have come; their forces are added. Collective. */
void hs_halo_reverse_send(const hs_halo *halo, const hs_atoms *atoms);
void hs_halo_reverse_own(const hs_halo *halo, hs_atoms *atoms, bool is_fixed);
void hs_halo_reverse_wait(const hs_halo *halo);
void hs_halo_reverse_receive(const hs_halo *halo, hs_atoms *atoms, bool is_fixed);
/** The other way, without adding: collected[k] of @p size bytes, k < out.n, is the value of the copy of local atom source[k]
 *  that block b with begin <= k < end has sent. Collective. */
void hs_halo_collect(const hs_halo *halo, const hs_atoms *atoms, const void *values, size_t size, void *collected);
void hs_halo_fini(hs_halo *halo);

#endif
