#include "parallel/parallel.h"

#include <omp.h>
#include <stdlib.h>

void hs_threads_set(int n_threads)
{
    if (n_threads <= 0) n_threads = getenv("OMP_NUM_THREADS") != NULL ? omp_get_max_threads() : 1;
    omp_set_num_threads(n_threads);
}

int hs_threads_get(void) { return omp_get_max_threads(); }

int hs_threads_available(void) { return omp_get_num_procs(); }

int hs_thread_number(void) { return omp_get_thread_num(); }

int hs_thread_count(void) { return omp_get_num_threads(); }

void hs_thread_range(int64_t n, int chunk, int thread, int n_threads, int64_t *begin, int64_t *end)
{
    const int64_t n_chunks = (n + chunk - 1) / chunk;
    *begin = n_chunks * thread / n_threads * chunk;
    *end = n_chunks * (thread + 1) / n_threads * chunk;
    if (*begin > n) *begin = n;
    if (*end > n) *end = n;
}
