#include "style/atom_sum.h"

#include "base/memory.h"

enum { CHUNK = 1024 }; /* atoms that are summed one after the other: part of the definition of the result */

hs_status hs_atom_sum(const hs_atoms *atoms, const hs_parallel *parallel, hs_atom_terms terms, const void *context,
                      int n, double *sums, hs_error *err)
{
    const int n_chunks = (atoms->n_local + CHUNK - 1) / CHUNK;
    double(*partial)[HS_ATOM_SUM_MAX];
    HS_TRY(HS_ALLOC(partial, (size_t)n_chunks, err));
#pragma omp parallel for schedule(static)
    for (int c = 0; c < n_chunks; ++c) {
        const int end = c == n_chunks - 1 ? atoms->n_local : (c + 1) * CHUNK;
        terms(atoms, context, c * CHUNK, end, partial[c]);
    }
    for (int k = 0; k < n; ++k) {
        sums[k] = 0.0;
        for (int c = 0; c < n_chunks; ++c) sums[k] += partial[c][k];
    }
    HS_FREE(partial);
    hs_parallel_sum_double(parallel, sums, n);
    return HS_OK;
}

int64_t hs_atom_count(const hs_atoms *atoms, const hs_parallel *parallel, uint32_t mask)
{
    int64_t n = 0;
    for (int i = 0; i < atoms->n_local; ++i) n += (atoms->mask[i] & mask) != 0;
    hs_parallel_sum_int64(parallel, &n, 1);
    return n;
}
