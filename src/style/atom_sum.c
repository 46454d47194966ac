#include "style/atom_sum.h"

#include <assert.h>

#include "core/group.h"

enum { CHUNK = HS_EXACT_ARRAY_MAX }; /* items that a thread takes at a time */

/** What is to be added up: atoms, or items that are none. */
typedef struct addends {
    const hs_atoms *atoms; /**< NULL: none */
    int n;
    hs_atom_terms terms;
    const void *context;
} addends;

static void add_chunk(const addends *all, int chunk, hs_exact_sum *sums)
{
    const int begin = chunk * CHUNK, end = all->n - begin < CHUNK ? all->n : begin + CHUNK;
    all->terms(all->atoms, all->context, begin, end, sums);
}

/** Add this rank's addends to sums[n]. */
static void add(const addends *all, int n, hs_exact_sum *sums)
{
    const int n_chunks = all->n / CHUNK + (all->n % CHUNK != 0), n_threads = hs_threads_get();
    assert(n <= HS_ATOM_SUM_MAX);
    for (int k = 0; k < n; ++k) hs_exact_clear(&sums[k]);
    if (n_threads == 1 || n_chunks == 1) { /* a parallel region takes longer than some hundred atoms */
        for (int c = 0; c < n_chunks; ++c) add_chunk(all, c, sums);
        return;
    }
#pragma omp parallel
    {
        hs_exact_sum part[HS_ATOM_SUM_MAX];
        for (int k = 0; k < n; ++k) hs_exact_clear(&part[k]);
#pragma omp for schedule(static) nowait
        for (int c = 0; c < n_chunks; ++c) add_chunk(all, c, part);
#pragma omp critical(hs_atom_sum)
        for (int k = 0; k < n; ++k) hs_exact_merge(&sums[k], &part[k]);
    }
}

static void sum_over_ranks(const addends *all, const hs_parallel *parallel, int n, double *sums)
{
    hs_exact_sum exact[HS_ATOM_SUM_MAX];
    add(all, n, exact);
    hs_exact_total(exact, n, parallel, sums);
}

void hs_atom_sum(const hs_atoms *atoms, const hs_parallel *parallel, hs_atom_terms terms, const void *context, int n,
                 double *sums)
{
    const addends all = {.atoms = atoms, .n = atoms->n_local, .terms = terms, .context = context};
    sum_over_ranks(&all, parallel, n, sums);
}

void hs_item_sum(int n_items, const hs_parallel *parallel, hs_atom_terms terms, const void *context, int n,
                 double *sums)
{
    const addends all = {.n = n_items, .terms = terms, .context = context};
    sum_over_ranks(&all, parallel, n, sums);
}

void hs_late_sums_make(hs_late_sums *sums, const hs_atoms *atoms, hs_atom_terms terms, const void *context, int n)
{
    const addends all = {.atoms = atoms, .n = atoms->n_local, .terms = terms, .context = context};
    add(&all, n, sums->part);
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
