#include "kernel/pair_histogram.h"

#include <string.h>

#include "base/memory.h"
#include "kernel/cluster_list.h"
#include "parallel/parallel.h"

/** Add the recent counts to the totals. */
static void settle(hs_histogram *histogram)
{
    for (int k = 0; k < histogram->n_fine; ++k) histogram->total[k] += histogram->recent[k];
    memset(histogram->recent, 0, (size_t)histogram->n_fine * sizeof *histogram->recent);
    histogram->n_pending = 0;
}

void hs_histogram_empty_queue(hs_histogram *histogram, int n)
{
    if (histogram->n_pending + n > UINT16_MAX) settle(histogram);
    histogram->n_pending += n;
    histogram->n_queued = 0;
    const uint32_t *restrict queue = histogram->queue;
    uint16_t *restrict counts = histogram->recent;
    int k = 0;
    for (; k + 4 <= n; k += 4) {
        ++counts[queue[k]];
        ++counts[queue[k + 1]];
        ++counts[queue[k + 2]];
        ++counts[queue[k + 3]];
    }
    for (; k < n; ++k) ++counts[queue[k]];
}

static void fini_threads(hs_pair_counter *counter)
{
    for (int t = 0; t < counter->n_threads && counter->thread != NULL; ++t) {
        HS_FREE(counter->thread[t].queue);
        HS_FREE(counter->thread[t].recent);
        HS_FREE(counter->thread[t].total);
    }
    HS_FREE(counter->thread);
    counter->n_threads = 0;
}

void hs_pair_counter_fini(hs_pair_counter *counter)
{
    fini_threads(counter);
    memset(counter, 0, sizeof *counter);
}

hs_status hs_pair_counter_begin(hs_pair_counter *counter, hs_error *err)
{
    const int n_threads = hs_threads_get(), n_fine = counter->n_bins * counter->n_bins;
    const double inv_width = counter->n_bins / counter->r_max;
    counter->is_filled = false;
    counter->held = 0;
    if (n_threads != counter->n_threads) {
        fini_threads(counter);
        HS_TRY(HS_ALLOC(counter->thread, (size_t)n_threads, err));
        counter->n_threads = n_threads;
    }
    for (int t = 0; t < n_threads; ++t) {
        hs_histogram *histogram = &counter->thread[t];
        if (histogram->queue == NULL) HS_TRY(HS_ALLOC(histogram->queue, HS_QUEUE + HS_QUEUE_ROOM, err));
        if (histogram->recent == NULL) HS_TRY(HS_ALLOC(histogram->recent, (size_t)n_fine + 1, err));
        if (histogram->total == NULL) HS_TRY(HS_ALLOC(histogram->total, (size_t)n_fine, err));
        histogram->scale = inv_width * inv_width;
        histogram->n_fine = n_fine;
        histogram->n_queued = histogram->n_pending = 0;
        memset(histogram->recent, 0, (size_t)n_fine * sizeof *histogram->recent);
        memset(histogram->total, 0, (size_t)n_fine * sizeof *histogram->total);
    }
    return HS_OK;
}

hs_status hs_pair_counter_list(hs_pair_counter *counter, const hs_cluster_list *list, const hs_clusters *clusters,
                               double *const x[3], hs_isa isa, hs_error *err)
{
    const double *const positions[3] = {x[0], x[1], x[2]};
    HS_TRY(hs_pair_counter_begin(counter, err));
#pragma omp parallel for schedule(dynamic, 1) num_threads(counter->n_threads)
    for (int k = 0; k < list->n_chunks; ++k)
        hs_isa_histogram(isa)(positions, clusters, &list->chunk[k], list->is_packed,
                              &counter->thread[hs_thread_number()]);
    return HS_OK;
}

void hs_pair_counter_get(hs_pair_counter *counter, int64_t *counts)
{
    memset(counts, 0, (size_t)counter->n_bins * sizeof *counts);
    for (int t = 0; t < counter->n_threads; ++t) {
        hs_histogram *histogram = &counter->thread[t];
        hs_histogram_empty_queue(histogram, histogram->n_queued);
        settle(histogram);
        for (int bin = 0; bin < counter->n_bins; ++bin)
            for (int k = bin * bin; k < (bin + 1) * (bin + 1); ++k) counts[bin] += histogram->total[k];
    }
}

void hs_pair_counter_hold(hs_pair_counter *counter, uint64_t revision)
{
    counter->held = counter->is_filled ? revision : 0;
    counter->is_filled = false;
}
