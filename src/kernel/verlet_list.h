/** Stored lists of neighbors of each atom (method `verlet`). */
#ifndef HS_KERNEL_VERLET_LIST_H
#define HS_KERNEL_VERLET_LIST_H

#include "kernel/list_chunks.h"

/** Pairs (i[k], j[k]). */
typedef struct hs_pair_list {
    int32_t *i, *j; /**< owned [n + HS_VERLET_PAD] each */
    int64_t n, capacity;
} hs_pair_list;

/** Lists of the atoms of one chunk. */
typedef struct hs_verlet_chunk {
    int begin, end;     /**< local clusters */
    int first, n_atoms; /**< their atoms, which follow one another */
    int64_t *start;     /**< owned [n_atoms + 1]: first neighbor of each atom */
    int64_t capacity_start;
    /** owned [n + HS_VERLET_PAD]: j-atoms, local and halo; of each i-atom as many as fill vectors */
    int32_t *neighbor;
    int64_t n, capacity;
    hs_pair_list rest;    /**< the other pairs */
    hs_block_list blocks; /**< of atoms that the chunk's forces act on */
    hs_error error;
} hs_verlet_chunk;

/** Half lists: each pair of atoms is in the list of one of the two. */
typedef struct hs_verlet_list {
    hs_verlet_chunk *chunk; /**< owned [n_chunks] */
    int n_chunks;
    uint64_t generation; /**< of the atoms the list was made for */
} hs_verlet_list;

/** List the pairs of atoms within their listed distance at the present positions. job->cutoff_max is the largest listed
 *  distance. Threaded; the same pairs for any number of threads. */
HS_MUST_USE hs_status hs_verlet_list_build(hs_verlet_list *list, hs_force_space *space, const hs_force_job *job,
                                           hs_error *err);
/** Pairs of atoms in the list. */
int64_t hs_verlet_list_n_pairs(const hs_verlet_list *list);
void hs_verlet_list_fini(hs_verlet_list *list);

/** Method `verlet`: forces of the listed pairs. Overwrites forces of local and halo atoms; needs hs_halo_reverse after.
 *  The list must be of the atoms' present generation. */
HS_MUST_USE hs_status hs_force_verlet(hs_force_space *space, const hs_verlet_list *list, const hs_force_job *job,
                                      hs_force_result *result, hs_error *err);

#endif
