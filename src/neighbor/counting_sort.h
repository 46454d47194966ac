/** The middle of a threaded counting sort: from how many atoms each thread has in each cell to where they go. */
#ifndef HS_NEIGHBOR_COUNTING_SORT_H
#define HS_NEIGHBOR_COUNTING_SORT_H

#include <stdint.h>

#include "parallel/parallel.h"

/** Exclusive prefix sums over (cell, thread) of histogram[thread][cell], in place, and start[n_cells + 1]: the first place of
 *  each cell. Called by all threads of a parallel region after a barrier; ends with one. share_sum is scratch [n_threads].
 *  The order within a cell is that of the threads, so the sort is stable when their atoms are contiguous ranges. */
static inline void hs_counting_sort_prefix(int32_t *histogram, int32_t *start, int64_t n_cells, int thread,
                                           int n_threads, int64_t *share_sum)
{
    int64_t begin, end;
    hs_thread_range(n_cells, 16, thread, n_threads, &begin, &end);
    int64_t sum = 0;
    for (int64_t c = begin; c < end; ++c)
        for (int t = 0; t < n_threads; ++t) sum += histogram[(int64_t)t * n_cells + c];
    share_sum[thread] = sum;
#pragma omp barrier
    int64_t at = 0;
    for (int t = 0; t < thread; ++t) at += share_sum[t];
    for (int64_t c = begin; c < end; ++c) {
        start[c] = (int32_t)at;
        for (int t = 0; t < n_threads; ++t) {
            int32_t *count = &histogram[(int64_t)t * n_cells + c];
            const int32_t n = *count;
            *count = (int32_t)at;
            at += n;
        }
    }
    if (thread == n_threads - 1) start[n_cells] = (int32_t)at;
#pragma omp barrier
}

#endif
