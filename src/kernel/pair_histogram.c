#include "kernel/pair_histogram.h"

#include "base/memory.h"
#include "parallel/parallel.h"

hs_status hs_pair_histogram(const hs_cluster_list *list, const hs_clusters *clusters, double *const x[3], hs_isa isa,
                            double r_max, int n_bins, int64_t *counts, hs_error *err)
{
    const int n_fine = n_bins * n_bins, n_threads = hs_threads_get();
    const double inv_width = n_bins / r_max;
    const double *const positions[3] = {x[0], x[1], x[2]};
    uint32_t *fine;
    HS_TRY(HS_ALLOC(fine, (size_t)n_threads * (size_t)(n_fine + 1), err));
#pragma omp parallel num_threads(n_threads)
    {
        uint32_t *own = fine + (size_t)hs_thread_number() * (size_t)(n_fine + 1);
#pragma omp for schedule(dynamic, 1)
        for (int k = 0; k < list->n_chunks; ++k)
            hs_isa_histogram(isa)(positions, clusters, &list->chunk[k], list->is_packed, inv_width * inv_width, n_fine,
                                  own);
    }
    for (int bin = 0; bin < n_bins; ++bin) {
        counts[bin] = 0;
        for (int t = 0; t < n_threads; ++t)
            for (int k = bin * bin; k < (bin + 1) * (bin + 1); ++k)
                counts[bin] += fine[(size_t)t * (size_t)(n_fine + 1) + (size_t)k];
    }
    HS_FREE(fine);
    return HS_OK;
}
