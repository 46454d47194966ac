#include "kernel/pair_histogram.h"

#include <string.h>

#include "base/memory.h"
#include "parallel/parallel.h"

void hs_histogram_settle(hs_histogram *histogram)
{
    for (int k = 0; k < histogram->n_fine; ++k) histogram->total[k] += histogram->recent[k];
    memset(histogram->recent, 0, (size_t)histogram->n_fine * sizeof *histogram->recent);
    histogram->n_pending = 0;
}

hs_status hs_pair_histogram(const hs_cluster_list *list, const hs_clusters *clusters, double *const x[3], hs_isa isa,
                            double r_max, int n_bins, int64_t *counts, hs_error *err)
{
    const int n_fine = n_bins * n_bins, n_threads = hs_threads_get();
    const double inv_width = n_bins / r_max;
    const double *const positions[3] = {x[0], x[1], x[2]};
    const size_t stride = (size_t)n_fine + 64; /* threads' counters on cache lines of their own */
    uint32_t *fine = NULL;
    uint16_t *recent = NULL;
    hs_status status = HS_ALLOC(fine, (size_t)n_threads * stride, err);
    if (status == HS_OK) status = HS_ALLOC(recent, (size_t)n_threads * stride, err);
    if (status != HS_OK) {
        HS_FREE(fine);
        return status;
    }
#pragma omp parallel num_threads(n_threads)
    {
        const size_t own = (size_t)hs_thread_number() * stride;
        hs_histogram histogram = {
            .scale = inv_width * inv_width, .n_fine = n_fine, .recent = recent + own, .total = fine + own};
#pragma omp for schedule(dynamic, 1)
        for (int k = 0; k < list->n_chunks; ++k)
            hs_isa_histogram(isa)(positions, clusters, &list->chunk[k], list->is_packed, &histogram);
        hs_histogram_settle(&histogram);
    }
    for (int bin = 0; bin < n_bins; ++bin) {
        counts[bin] = 0;
        for (int t = 0; t < n_threads; ++t)
            for (int k = bin * bin; k < (bin + 1) * (bin + 1); ++k) counts[bin] += fine[(size_t)t * stride + (size_t)k];
    }
    HS_FREE(recent);
    HS_FREE(fine);
    return HS_OK;
}
