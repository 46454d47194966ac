#include "deck/by_id.h"

#include <stdlib.h>

#include "base/memory.h"

typedef struct entry {
    int64_t id;
    int32_t index;
} entry;

static int compare(const void *a, const void *b)
{
    const int64_t id_a = ((const entry *)a)->id, id_b = ((const entry *)b)->id;
    return (id_a > id_b) - (id_a < id_b);
}

static bool is_ascending(const hs_atoms *atoms)
{
    for (int i = 1; i < atoms->n_local; ++i)
        if (atoms->id[i] < atoms->id[i - 1]) return false;
    return true;
}

hs_status hs_by_id_order(const hs_atoms *atoms, int32_t **order, hs_error *err)
{
    const int n = atoms->n_local;
    *order = NULL;
    HS_TRY(HS_ALLOC(*order, (size_t)n, err));
    if (is_ascending(atoms)) {
        for (int i = 0; i < n; ++i) (*order)[i] = i;
        return HS_OK;
    }
    entry *entries = NULL;
    hs_status status = HS_ALLOC(entries, (size_t)n, err);
    if (status != HS_OK) {
        HS_FREE(*order);
        return status;
    }
    for (int i = 0; i < n; ++i) entries[i] = (entry){atoms->id[i], i};
    qsort(entries, (size_t)n, sizeof *entries, compare);
    for (int i = 0; i < n; ++i) (*order)[i] = entries[i].index;
    HS_FREE(entries);
    return HS_OK;
}

static hs_status members_here(const hs_atoms *atoms, const unsigned char *selected, int64_t **ids, int64_t *n,
                              hs_error *err)
{
    int32_t *order;
    HS_TRY(hs_by_id_order(atoms, &order, err));
    hs_status status = HS_ALLOC(*ids, (size_t)atoms->n_local, err);
    for (int k = 0; status == HS_OK && k < atoms->n_local; ++k)
        if (selected[order[k]]) (*ids)[(*n)++] = atoms->id[order[k]];
    HS_FREE(order);
    return status;
}

hs_status hs_by_id_members(const hs_sim *sim, const unsigned char *selected, int64_t **ids, int64_t *n, hs_error *err)
{
    const hs_atoms *atoms = &sim->atoms;
    *ids = NULL;
    *n = 0;
    if (sim->parallel.n_ranks <= 1) return members_here(atoms, selected, ids, n, err);

    /* the flag of ID k + 1 is flags[k]; every ID is on one rank, so that the sum holds the flags of all */
    enum { CHUNK = 1 << 20 };
    int64_t max_id = hs_atoms_max_id(atoms);
    hs_parallel_max_int64(&sim->parallel, &max_id, 1);
    HS_TRY(HS_ALLOC(*ids, (size_t)max_id, err));
    int64_t *flags = *ids;
    for (int i = 0; i < atoms->n_local; ++i) flags[atoms->id[i] - 1] = selected[i] != 0;
    for (int64_t k = 0; k < max_id; k += CHUNK)
        hs_parallel_sum_int64(&sim->parallel, flags + k, (int)(max_id - k < CHUNK ? max_id - k : CHUNK));
    for (int64_t k = 0; k < max_id; ++k)
        if (flags[k] != 0) flags[(*n)++] = k + 1;
    return HS_OK;
}
