/** Stored lists of cluster pairs (method `cluster`). */
#ifndef HS_KERNEL_CLUSTER_LIST_H
#define HS_KERNEL_CLUSTER_LIST_H

#include "kernel/list_chunks.h"

/** Pairs of the i-clusters of one chunk. */
typedef struct hs_list_chunk {
    int begin, end; /**< local clusters */
    int32_t *start; /**< owned [end - begin + 1]: first entry of each cluster, from begin on */
    int64_t capacity_start;
    hs_entry_list entries;
    int32_t *outer; /**< owned [n_outer]: clusters with other ranks' atoms in their lists, ascending */
    int n_outer;
    int64_t capacity_outer;
    hs_block_list blocks; /**< of atoms that the chunk's forces act on */
    int64_t n_pairs;      /**< pairs of atoms in the list */
    hs_error error;
} hs_list_chunk;

typedef struct hs_cluster_list {
    hs_list_chunk *chunk; /**< owned [n_chunks] */
    int n_chunks;
    uint64_t generation; /**< of the atoms the list was made for */
    bool is_packed;      /**< entries name packed clusters (kernel/packed.h), not atoms */
} hs_cluster_list;

/** List the pairs of atoms within their listed distance at the present positions. job->cutoff_max is the largest listed
 *  distance. Threaded; the same pairs for any number of threads. */
HS_MUST_USE hs_status hs_cluster_list_build(hs_cluster_list *list, hs_force_space *space, const hs_force_job *job,
                                            hs_error *err);
/** Pairs of atoms in the list. */
int64_t hs_cluster_list_n_pairs(const hs_cluster_list *list);
void hs_cluster_list_fini(hs_cluster_list *list);

/** Whether hs_force_cluster can count the distances of the job's pairs on the way: in double, without energies, where all pairs
 *  have forces up to r_max and none farther. */
bool hs_force_can_count(const hs_force_job *job, double r_max);
/** Method `cluster`: forces of the listed pairs. Overwrites forces of local and halo atoms; needs hs_halo_reverse after. */
HS_MUST_USE hs_status hs_force_cluster(hs_force_space *space, const hs_cluster_list *list, const hs_force_job *job,
                                       hs_force_result *result, hs_error *err);

#endif
