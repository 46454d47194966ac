#include "style/atom_sum.h"

#include <assert.h>

enum { CHUNK = HS_EXACT_ARRAY_MAX }; /* atoms that a thread takes at a time */

void hs_atom_sum(const hs_atoms *atoms, const hs_parallel *parallel, hs_atom_terms terms, const void *context, int n,
                 double *sums)
{
    hs_exact_sum all[HS_ATOM_SUM_MAX] = {{{0}, 0, 0.0}};
    const int n_chunks = (atoms->n_local + CHUNK - 1) / CHUNK;
    assert(n <= HS_ATOM_SUM_MAX);
#pragma omp parallel
    {
        hs_exact_sum part[HS_ATOM_SUM_MAX] = {{{0}, 0, 0.0}};
#pragma omp for schedule(static)
        for (int c = 0; c < n_chunks; ++c) {
            const int end = c == n_chunks - 1 ? atoms->n_local : (c + 1) * CHUNK;
            terms(atoms, context, c * CHUNK, end, part);
        }
#pragma omp critical(hs_atom_sum)
        for (int k = 0; k < n; ++k) hs_exact_merge(&all[k], &part[k]);
    }
    hs_exact_total(all, n, parallel, sums);
}

int64_t hs_atom_count(const hs_atoms *atoms, const hs_parallel *parallel, uint32_t mask)
{
    int64_t n = 0;
    for (int i = 0; i < atoms->n_local; ++i) n += (atoms->mask[i] & mask) != 0;
    hs_parallel_sum_int64(parallel, &n, 1);
    return n;
}
