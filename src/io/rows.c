#include "io/rows.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

typedef struct keyed {
    int64_t id;
    int32_t index;
} keyed;

static int compare_ids(const void *a, const void *b)
{
    const keyed *first = a, *second = b;
    return first->id < second->id ? -1 : first->id > second->id;
}

/** Order by a table with a place for each id between the least and the greatest. */
static hs_status order_by_table(int32_t *order, const hs_atoms *atoms, uint32_t mask, int64_t least, int64_t greatest,
                                hs_error *err)
{
    const size_t n_places = (size_t)(greatest - least) + 1;
    int32_t *table, n_ordered = 0;
    HS_TRY(HS_ALLOC(table, n_places, err));
#pragma omp parallel for schedule(static)
    for (int i = 0; i < atoms->n_local; ++i)
        if (atoms->mask[i] & mask) table[atoms->id[i] - least] = i + 1;
    for (size_t place = 0; place < n_places; ++place)
        if (table[place] != 0) order[n_ordered++] = table[place] - 1;
    HS_FREE(table);
    return HS_OK;
}

static hs_status order_by_sorting(int32_t *order, const hs_atoms *atoms, uint32_t mask, int n, hs_error *err)
{
    keyed *atom;
    int n_found = 0;
    HS_TRY(HS_ALLOC(atom, (size_t)n, err));
    for (int i = 0; i < atoms->n_local; ++i)
        if (atoms->mask[i] & mask) atom[n_found++] = (keyed){.id = atoms->id[i], .index = i};
    if (n > 0) qsort(atom, (size_t)n, sizeof *atom, compare_ids);
    for (int k = 0; k < n; ++k) order[k] = atom[k].index;
    HS_FREE(atom);
    return HS_OK;
}

/** Fill rows->order with this rank's atoms. */
static hs_status order_mine(hs_rows *rows, const hs_atoms *atoms, uint32_t mask, hs_error *err)
{
    int n = 0;
    int64_t least = INT64_MAX, greatest = 0;
#pragma omp parallel for schedule(static) reduction(+ : n) reduction(min : least) reduction(max : greatest)
    for (int i = 0; i < atoms->n_local; ++i) {
        if ((atoms->mask[i] & mask) == 0) continue;
        ++n;
        if (atoms->id[i] < least) least = atoms->id[i];
        if (atoms->id[i] > greatest) greatest = atoms->id[i];
    }
    HS_TRY(HS_ALLOC(rows->order, (size_t)n, err));
    rows->n_local = n;
    if (n > 0 && (greatest - least) / 8 < n) return order_by_table(rows->order, atoms, mask, least, greatest, err);
    return order_by_sorting(rows->order, atoms, mask, n, err);
}

hs_status hs_rows_begin(hs_rows *rows, const hs_parallel *parallel, const hs_atoms *atoms, uint32_t mask, hs_error *err)
{
    *rows = (hs_rows){.parallel = parallel, .id = atoms->id};
    hs_status status = order_mine(rows, atoms, mask, err);
    if (status == HS_OK && parallel->n_ranks > 1 && parallel->rank == 0)
        status = HS_ALLOC(rows->place, HS_ROWS_BLOCK, err);
    if (status == HS_OK) status = HS_ALLOC(rows->n_of_rank, (size_t)parallel->n_ranks, err);
    status = hs_parallel_agree(parallel, err);
    rows->n_all = rows->n_local;
    hs_parallel_sum_int64(parallel, &rows->n_all, 1);
    return status;
}

/** This rank's atoms of the present block and later whose id is less than @p id. */
static int count_below(const hs_rows *rows, int64_t id)
{
    int lo = rows->begin, hi = rows->n_local;
    while (lo < hi) {
        const int middle = lo + (hi - lo) / 2;
        if (rows->id[rows->order[middle]] < id)
            lo = middle + 1;
        else
            hi = middle;
    }
    return lo - rows->begin;
}

/** Ids of the block end where at most HS_ROWS_BLOCK rows are below (collective). */
static int64_t find_id_end(const hs_rows *rows)
{
    int64_t greatest = rows->n_local > 0 ? rows->id[rows->order[rows->n_local - 1]] : 0;
    hs_parallel_max_int64(rows->parallel, &greatest, 1);
    int64_t lo = rows->id_end, hi = greatest + 1;
    if (rows->n_all - rows->first_row <= HS_ROWS_BLOCK) return hi;
    while (lo < hi) { /* the last id end that is not too far; ids are unique, so it is above the first */
        const int64_t middle = lo + (hi - lo + 1) / 2;
        int64_t n = count_below(rows, middle);
        hs_parallel_sum_int64(rows->parallel, &n, 1);
        if (n <= HS_ROWS_BLOCK)
            lo = middle;
        else
            hi = middle - 1;
    }
    return lo;
}

/** This rank's n_bytes to rank 0's @p all, in the order of ranks. */
static void collect(const hs_rows *rows, const void *mine, size_t size, char *all)
{
    const hs_parallel *parallel = rows->parallel;
    if (parallel->rank != 0) {
        if (rows->n_mine > 0) hs_parallel_send(parallel, 0, mine, size * (size_t)rows->n_mine);
        return;
    }
    size_t at = size * (size_t)rows->n_mine;
    if (at > 0) memcpy(all, mine, at);
    for (int rank = 1; rank < parallel->n_ranks; ++rank) {
        const size_t n = size * (size_t)rows->n_of_rank[rank];
        if (n > 0) hs_parallel_receive(parallel, rank, all + at, n);
        at += n;
    }
}

/** On rank 0: where each gathered row belongs. */
static hs_status find_places(hs_rows *rows, hs_error *err)
{
    const bool is_root = rows->parallel->rank == 0;
    int64_t *mine = NULL, *all = NULL;
    keyed *row = NULL;
    hs_status status = HS_ALLOC(mine, (size_t)rows->n_mine, err);
    if (status == HS_OK && is_root) status = HS_ALLOC(all, (size_t)rows->n_block, err);
    if (status == HS_OK && is_root) status = HS_ALLOC(row, (size_t)rows->n_block, err);
    for (int k = 0; k < rows->n_mine && status == HS_OK; ++k) mine[k] = rows->id[rows->mine[k]];
    status = hs_parallel_agree(rows->parallel, err);
    if (status == HS_OK) {
        collect(rows, mine, sizeof *mine, (char *)all);
        for (int k = 0; k < rows->n_block && is_root; ++k) row[k] = (keyed){.id = all[k], .index = k};
        if (is_root) qsort(row, (size_t)rows->n_block, sizeof *row, compare_ids);
        for (int k = 0; k < rows->n_block && is_root; ++k) rows->place[row[k].index] = k;
    }
    HS_FREE(mine);
    HS_FREE(all);
    HS_FREE(row);
    return status;
}

bool hs_rows_next(hs_rows *rows, hs_status *status, hs_error *err)
{
    rows->first_row += rows->n_block;
    rows->begin += rows->n_mine;
    rows->n_block = rows->n_mine = 0;
    if (rows->first_row >= rows->n_all) return false;
    rows->mine = rows->order + rows->begin;
    if (rows->parallel->n_ranks == 1) {
        const int64_t left = rows->n_all - rows->first_row;
        rows->n_block = rows->n_mine = left < HS_ROWS_BLOCK ? (int)left : HS_ROWS_BLOCK;
        return true;
    }
    const int64_t id_end = find_id_end(rows);
    rows->n_mine = count_below(rows, id_end);
    rows->id_end = id_end;
    hs_parallel_gather_int64(rows->parallel, rows->n_mine, rows->n_of_rank);
    for (int rank = 0; rank < rows->parallel->n_ranks; ++rank) rows->n_block += (int)rows->n_of_rank[rank];
    *status = find_places(rows, err);
    return *status == HS_OK;
}

hs_status hs_rows_gather(hs_rows *rows, const void *mine, size_t size, void *all, hs_error *err)
{
    const size_t n_bytes = (size_t)rows->n_block * size;
    if (rows->parallel->n_ranks == 1) {
        if (n_bytes > 0 && all != mine) memcpy(all, mine, n_bytes);
        return HS_OK;
    }
    if (rows->parallel->rank == 0 && rows->buffer_size < n_bytes) {
        HS_FREE(rows->buffer);
        rows->buffer_size = 0;
        if (HS_ALLOC(rows->buffer, n_bytes, err) == HS_OK) rows->buffer_size = n_bytes;
    }
    HS_TRY(hs_parallel_agree(rows->parallel, err));
    collect(rows, mine, size, rows->buffer);
    for (int k = 0; k < rows->n_block && rows->parallel->rank == 0; ++k)
        memcpy((char *)all + (size_t)rows->place[k] * size, rows->buffer + (size_t)k * size, size);
    return HS_OK;
}

void hs_rows_again(hs_rows *rows)
{
    rows->first_row = rows->id_end = 0;
    rows->begin = rows->n_block = rows->n_mine = 0;
}

void hs_rows_end(hs_rows *rows)
{
    HS_FREE(rows->order);
    HS_FREE(rows->place);
    HS_FREE(rows->n_of_rank);
    HS_FREE(rows->buffer);
}
