/** What the stored lists of methods `cluster` and `verlet` share: clusters in chunks, chunks for threads, and the blocks of
 *  forces that a chunk adds to.
 *
 *  A chunk is a contiguous range of i-clusters with the lists of these. There are many more chunks than threads, so that handing out
 *  whole ones, in order, balances the threads by the length of their lists, and a thread that is done can take what another has not
 *  begun. The pairs listed do not depend on the number of threads. */
#ifndef HS_KERNEL_LIST_CHUNKS_H
#define HS_KERNEL_LIST_CHUNKS_H

#include "kernel/force.h"

/** Blocks of atoms (or of packed numbers) that forces act on, each once. Zero it before use; free block with HS_FREE. */
typedef struct hs_block_list {
    int32_t *block; /**< owned [n] */
    int64_t n, capacity;
} hs_block_list;

/** Chunks for that many clusters and the present number of threads, at most @p n_per_chunk_max clusters in each. */
int hs_list_chunks_for(int n_clusters, int n_per_chunk_max);
/** Clusters [*begin, *end) of a chunk. */
void hs_list_chunk_range(int n_clusters, int n_chunks, int chunk, int *begin, int *end);

/** Share the chunks among the threads, in order and with equal weight as far as whole chunks allow, for all stages of an evaluation;
 *  @p weight of(list, chunk) is its length. To be called before each evaluation, outside of parallel regions. */
void hs_list_share(hs_force_space *space, const void *list, int64_t (*weight)(const void *list, int chunk),
                   int n_chunks);
/** The next chunk for a thread in a stage, -1 when there is none. A thread whose share is done takes chunks of others, so the order of
 *  sums differs from run to run; fixed point does not feel it.
 *  @p is_cut: of this chunk stages BEFORE and AFTER do the inner clusters, MAIN the outer ones; else MAIN does it all. */
int hs_list_take(hs_force_space *space, hs_force_stage stage, int thread, bool *is_cut);

/** Copy the blocks that are marked in touched[n_blocks]. */
HS_MUST_USE hs_status hs_block_list_set(hs_block_list *list, const unsigned char *touched, int64_t n_blocks,
                                        hs_error *err);
/** Make the blocks ready to be added to. */
void hs_block_list_touch(const hs_block_list *list, hs_force_buffer *buffer, const hs_force_job *job);

#endif
