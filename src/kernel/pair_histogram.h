/** Histogram of the distances of listed pairs: the fast way to a radial distribution function.
 *
 *  Bins are of equal width in r^2, namely (r_max / n_bins)^2, so that bin k of equal width in r holds exactly the fine bins
 *  k^2 to (k + 1)^2 - 1: no square root is needed. Cheapest is to count on the way, with the r^2 that the force kernels
 *  have at hand; a pass over the list for counting alone costs half a step. */
#ifndef HS_KERNEL_PAIR_HISTOGRAM_H
#define HS_KERNEL_PAIR_HISTOGRAM_H

#include <stdbool.h>
#include <stdint.h>

#include "base/error.h"
#include "kernel/kernel.h"

struct hs_cluster_list;
struct hs_list_chunk;

enum {
    HS_HISTOGRAM_BINS_MAX = 256, /**< beyond, the fine bins no longer fit caches */
    HS_QUEUE = 1024,             /**< bins that wait to be counted, before the queue is emptied */
    HS_QUEUE_ROOM = 64           /**< and room for the pairs of a group of entries */
};

/** Counters of one thread: n_fine bins of width 1 / scale in r^2. */
typedef struct hs_histogram {
    double scale;
    int n_fine;
    int n_queued;    /**< bins in the queue */
    int n_pending;   /**< pairs in `recent`, at most 65535 */
    uint32_t *queue; /**< owned [HS_QUEUE + HS_QUEUE_ROOM] */
    /** owned [n_fine + 1]: not yet in `total`; the last one of what rounding puts beyond the end. 16-bit counters stay in the
     *  first-level cache. */
    uint16_t *recent;
    uint32_t *total; /**< owned [n_fine] */
} hs_histogram;

/** Counts of pairs by distance, in n_bins (at most HS_HISTOGRAM_BINS_MAX) bins of equal width up to r_max. Zero it, then set these two;
 *  free with hs_pair_counter_fini. */
typedef struct hs_pair_counter {
    double r_max;
    int n_bins;
    hs_histogram *thread; /**< owned [n_threads] */
    int n_threads;
    bool is_filled; /**< it holds the pairs of the latest force evaluation */
    uint64_t held;  /**< env->revision for which it does; 0: none */
} hs_pair_counter;

/** Empty counters for the present number of threads. */
HS_MUST_USE hs_status hs_pair_counter_begin(hs_pair_counter *counter, hs_error *err);
/** Count the pairs of a list; @p x positions of local and halo atoms. Threaded; not collective. */
HS_MUST_USE hs_status hs_pair_counter_list(hs_pair_counter *counter, const struct hs_cluster_list *list,
                                           const hs_clusters *clusters, double *const x[3], hs_isa isa, hs_error *err);
/** counts[n_bins]: pairs of this rank, each once. */
void hs_pair_counter_get(hs_pair_counter *counter, int64_t *counts);
/** What was counted with the latest forces, if anything was, holds for that revision. */
void hs_pair_counter_hold(hs_pair_counter *counter, uint64_t revision);
void hs_pair_counter_fini(hs_pair_counter *counter);

/** Count the n bins in the queue. */
void hs_histogram_empty_queue(hs_histogram *histogram, int n);

/** The pass over a chunk of a list, compiled for every instruction set; whatever is farther than the last bin, or no pair,
 *  is left out. */
typedef void (*hs_histogram_kernel)(const double *const x[3], const hs_clusters *clusters,
                                    const struct hs_list_chunk *chunk, bool is_packed, hs_histogram *histogram);
hs_histogram_kernel hs_isa_histogram(hs_isa isa);
extern const hs_histogram_kernel hs_histogram_kernel_portable, hs_histogram_kernel_sse2, hs_histogram_kernel_avx2,
    hs_histogram_kernel_avx512;

#endif
