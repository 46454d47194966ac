#include "deck/by_id.h"

#include <stdlib.h>
#include <string.h>

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

static hs_status visit_here(const hs_atoms *atoms, const unsigned char *selected, hs_by_id_visitor visit, void *context,
                            hs_error *err)
{
    int32_t *order;
    HS_TRY(hs_by_id_order(atoms, &order, err));
    hs_status status = HS_OK;
    for (int k = 0; status == HS_OK && k < atoms->n_local; ++k)
        if (selected[order[k]]) status = visit(context, atoms->id[order[k]], err);
    HS_FREE(order);
    return status;
}

/** Visit the IDs of a chunk: one bit each, bit 0 of the first word being ID first. */
static hs_status visit_bits(const int64_t *words, int n_words, int64_t first, hs_by_id_visitor visit, void *context,
                            hs_error *err)
{
    for (int w = 0; w < n_words; ++w)
        for (uint64_t bits = (uint64_t)words[w]; bits != 0; bits &= bits - 1)
            HS_TRY(visit(context, first + 64 * (int64_t)w + __builtin_ctzll(bits), err));
    return HS_OK;
}

hs_status hs_by_id_visit(const hs_sim *sim, const unsigned char *selected, hs_by_id_visitor visit, void *context,
                         hs_error *err)
{
    enum { WORDS = 1 << 14, CHUNK = 64 * WORDS };
    const hs_atoms *atoms = &sim->atoms;
    if (sim->parallel.n_ranks <= 1) return visit_here(atoms, selected, visit, context, err);
    int64_t *words = NULL;
    int32_t *order = NULL;
    HS_UNLESS_FAILED(err, hs_by_id_order(atoms, &order, err));
    HS_UNLESS_FAILED(err, HS_ALLOC(words, WORDS, err));
    hs_status status = hs_parallel_agree(&sim->parallel, err);
    int next = 0;
    while (status == HS_OK) {
        /* the lowest id that is left on any rank: ids may be few and far between */
        int64_t first = next < atoms->n_local ? -atoms->id[order[next]] : INT64_MIN;
        hs_parallel_max_int64(&sim->parallel, &first, 1);
        if (first == INT64_MIN) break;
        first = -first;
        /* every ID is on one rank, so that a sum of words has the bits of all */
        memset(words, 0, WORDS * sizeof *words);
        for (; next < atoms->n_local && atoms->id[order[next]] < first + CHUNK; ++next) {
            const int64_t place = atoms->id[order[next]] - first;
            if (selected[order[next]])
                words[place / 64] = (int64_t)((uint64_t)words[place / 64] | UINT64_C(1) << place % 64);
        }
        hs_parallel_sum_int64(&sim->parallel, words, WORDS);
        status = visit_bits(words, WORDS, first, visit, context, err);
    }
    HS_FREE(order);
    HS_FREE(words);
    return status;
}

/** IDs so far, for hs_by_id_members. */
typedef struct id_list {
    int64_t *ids, n;
    size_t capacity;
} id_list;

static hs_status append(void *context, int64_t id, hs_error *err)
{
    id_list *list = context;
    HS_TRY(HS_EXTEND(list->ids, list->n, list->capacity, err));
    list->ids[list->n++] = id;
    return HS_OK;
}

hs_status hs_by_id_members(const hs_sim *sim, const unsigned char *selected, int64_t **ids, int64_t *n, hs_error *err)
{
    id_list list = {0};
    const hs_status status = hs_by_id_visit(sim, selected, append, &list, err);
    *ids = list.ids;
    *n = list.n;
    return status;
}
