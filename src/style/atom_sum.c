#include "style/atom_sum.h"

#include <assert.h>

#include "core/group.h"

enum { CHUNK = HS_EXACT_ARRAY_MAX }; /* atoms that a thread takes at a time */

static void add_chunk(const hs_atoms *atoms, hs_atom_terms terms, const void *context, int chunk, hs_exact_sum *sums)
{
    const int begin = chunk * CHUNK, end = atoms->n_local - begin < CHUNK ? atoms->n_local : begin + CHUNK;
    terms(atoms, context, begin, end, sums);
}

/** Add this rank's atoms to sums[n]. */
static void add_atoms(const hs_atoms *atoms, hs_atom_terms terms, const void *context, int n, hs_exact_sum *sums)
{
    const int n_chunks = (atoms->n_local + CHUNK - 1) / CHUNK, n_threads = hs_threads_get();
    assert(n <= HS_ATOM_SUM_MAX);
    for (int k = 0; k < n; ++k) hs_exact_clear(&sums[k]);
    if (n_threads == 1 || n_chunks == 1) { /* a parallel region takes longer than some hundred atoms */
        for (int c = 0; c < n_chunks; ++c) add_chunk(atoms, terms, context, c, sums);
        return;
    }
#pragma omp parallel
    {
        hs_exact_sum part[HS_ATOM_SUM_MAX];
        for (int k = 0; k < n; ++k) hs_exact_clear(&part[k]);
#pragma omp for schedule(static) nowait
        for (int c = 0; c < n_chunks; ++c) add_chunk(atoms, terms, context, c, part);
#pragma omp critical(hs_atom_sum)
        for (int k = 0; k < n; ++k) hs_exact_merge(&sums[k], &part[k]);
    }
}

void hs_atom_sum(const hs_atoms *atoms, const hs_parallel *parallel, hs_atom_terms terms, const void *context, int n,
                 double *sums)
{
    hs_exact_sum all[HS_ATOM_SUM_MAX];
    add_atoms(atoms, terms, context, n, all);
    hs_exact_total(all, n, parallel, sums);
}

void hs_late_sums_make(hs_late_sums *sums, const hs_atoms *atoms, hs_atom_terms terms, const void *context, int n)
{
    add_atoms(atoms, terms, context, n, sums->part);
    sums->n = n;
}

const double *hs_late_sums_read(hs_late_sums *sums, const hs_parallel *parallel)
{
    hs_exact_total(sums->part, sums->n, parallel, sums->value);
    sums->n = 0;
    return sums->value;
}

int64_t hs_atom_count(const hs_atoms *atoms, const hs_parallel *parallel, uint32_t mask)
{
    int64_t n = 0;
    if (mask & hs_group_mask(0)) /* all */
        n = atoms->n_local;
    else
        for (int i = 0; i < atoms->n_local; ++i) n += (atoms->mask[i] & mask) != 0;
    hs_parallel_sum_int64(parallel, &n, 1);
    return n;
}
