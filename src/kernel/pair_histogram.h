/** Histogram of the distances of listed pairs: the fast way to a radial distribution function.
 *
 *  Bins are of equal width in r^2, namely (r_max / n_bins)^2, so that bin k of equal width in r holds exactly the fine bins
 *  k^2 to (k + 1)^2 - 1: no square root is needed, and the inner loop is a subtraction, a product and an increment. */
#ifndef HS_KERNEL_PAIR_HISTOGRAM_H
#define HS_KERNEL_PAIR_HISTOGRAM_H

#include "kernel/cluster_list.h"

enum { HS_HISTOGRAM_BINS_MAX = 256 }; /**< beyond, the fine bins no longer fit caches */

/** counts[n_bins]: pairs of the list by distance, n_bins (at most HS_HISTOGRAM_BINS_MAX) bins of equal width up to r_max.
 *  @p x positions of local and halo atoms. Threaded, exact; not collective. */
HS_MUST_USE hs_status hs_pair_histogram(const hs_cluster_list *list, const hs_clusters *clusters, double *const x[3],
                                        hs_isa isa, double r_max, int n_bins, int64_t *counts, hs_error *err);

/** Counters of one thread: n_fine bins of width 1 / scale in r^2. */
typedef struct hs_histogram {
    double scale;
    int n_fine;
    int n_pending;    /**< pairs in `recent`, at most 65535 */
    uint16_t *recent; /**< borrowed [n_fine]: not yet in `total` */
    uint32_t *total;  /**< borrowed [n_fine] */
} hs_histogram;

/** Add the recent counts to the totals. */
void hs_histogram_settle(hs_histogram *histogram);

/** The inner part, compiled for every instruction set: counts the pairs of a chunk of the list; whatever is farther than the last
 *  bin, or no pair, is left out. */
typedef void (*hs_histogram_kernel)(const double *const x[3], const hs_clusters *clusters, const hs_list_chunk *chunk,
                                    bool is_packed, hs_histogram *histogram);
hs_histogram_kernel hs_isa_histogram(hs_isa isa);
extern const hs_histogram_kernel hs_histogram_kernel_portable, hs_histogram_kernel_sse2, hs_histogram_kernel_avx2,
    hs_histogram_kernel_avx512;

#endif
