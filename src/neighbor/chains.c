/* What the three kinds of chains have in common. */
#include "neighbor/chains.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

hs_status hs_chains_set_grid(hs_chains *chains, const hs_grid_plan *plan, hs_cell_order order, hs_error *err)
{
    bool has_changed;
    HS_TRY(hs_grid_set(&chains->grid, plan, &has_changed, err));
    if (has_changed || order != chains->order) {
        chains->is_void = true;
        chains->n_cells = 0;
    }
    chains->order = order;
    return HS_OK;
}

void hs_chains_set_sizes(hs_chains *chains, double radius_lo, double radius_hi)
{
    if (!chains->is_sized || chains->radius_lo != radius_lo || chains->radius_hi != radius_hi) chains->is_void = true;
    chains->is_sized = true;
    chains->radius_lo = radius_lo;
    chains->radius_hi = radius_hi;
}

void hs_chains_set_all_sizes(hs_chains *chains)
{
    if (chains->is_sized) chains->is_void = true;
    chains->is_sized = false;
}

typedef struct keyed {
    uint64_t key;
    int64_t tie; /**< place or id: no two are equal */
    int32_t index;
} keyed;

static int compare_keys(const void *a, const void *b)
{
    const keyed *x = a, *y = b;
    if (x->key != y->key) return x->key < y->key ? -1 : 1;
    return (x->tie > y->tie) - (x->tie < y->tie);
}

/** Numbers along the Morton curve. */
static hs_status number_along_curve(hs_chains *chains, int64_t n_cells, hs_error *err)
{
    keyed *curve = NULL;
    HS_TRY(HS_GROW(chains->number, 0, (size_t)n_cells, err));
    HS_TRY(HS_GROW(chains->place, 0, (size_t)n_cells, err));
    HS_TRY(HS_ALLOC(curve, (size_t)n_cells, err));
    for (int64_t place = 0; place < n_cells; ++place) {
        int c[3];
        hs_grid_cell_at(&chains->grid, place, c);
        curve[place] = (keyed){hs_grid_key(&chains->grid, HS_CELL_ORDER_MORTON, c), place, (int32_t)place};
    }
    qsort(curve, (size_t)n_cells, sizeof *curve, compare_keys);
    for (int64_t k = 0; k < n_cells; ++k) {
        chains->place[k] = curve[k].index;
        chains->number[curve[k].index] = (int32_t)k;
    }
    HS_FREE(curve);
    return HS_OK;
}

hs_status hs_chains_number_cells(hs_chains *chains, hs_error *err)
{
    const int64_t n_cells = hs_grid_n_cells(&chains->grid);
    if (chains->n_cells == n_cells && !chains->is_hashed) return HS_OK;
    const double bytes = (double)n_cells * (chains->order == HS_CELL_ORDER_MORTON ? 36.0 : 4.0);
    if (n_cells > INT32_MAX || (hs_memory_physical() > 0 && bytes > 0.8 * (double)hs_memory_physical()))
        return hs_fail(err, HS_ERROR_RUN,
                       "the box has %lld cells, and an array of all of them does not fit into memory: use "
                       "'neighbor_method hash', which keeps the occupied ones only, or larger cells",
                       (long long)n_cells);
    if (n_cells > chains->capacity_cells) {
        HS_TRY(HS_GROW(chains->head, 0, (size_t)n_cells, err));
        chains->capacity_cells = n_cells;
    }
    if (chains->order == HS_CELL_ORDER_MORTON) {
        HS_TRY(number_along_curve(chains, n_cells, err));
    } else {
        HS_FREE(chains->number);
        HS_FREE(chains->place);
    }
    chains->n_cells = n_cells;
    chains->is_hashed = false;
    return HS_OK;
}

hs_status hs_chains_reserve(hs_chains *chains, int64_t n, hs_error *err)
{
    if (n <= chains->capacity_atoms) return HS_OK;
    const int64_t capacity = n + n / 8 + 64;
    HS_TRY(HS_GROW(chains->next, (size_t)chains->n_atoms, (size_t)capacity, err));
    if (chains->cell != NULL) HS_TRY(HS_GROW(chains->cell, (size_t)chains->n_atoms, (size_t)capacity, err));
    if (chains->previous != NULL) HS_TRY(HS_GROW(chains->previous, (size_t)chains->n_atoms, (size_t)capacity, err));
    chains->capacity_atoms = capacity;
    return HS_OK;
}

hs_status hs_chains_sort(const hs_chains *chains, const hs_atoms *atoms, int32_t *order, hs_error *err)
{
    keyed *sorted = NULL;
    HS_TRY(HS_ALLOC(sorted, (size_t)atoms->n_local, err));
#pragma omp parallel for schedule(static)
    for (int i = 0; i < atoms->n_local; ++i) {
        int c[3];
        hs_chains_locate(chains, atoms, i, c);
        sorted[i] = (keyed){hs_grid_key(&chains->grid, chains->order, c), atoms->id[i], i};
    }
    qsort(sorted, (size_t)atoms->n_local, sizeof *sorted, compare_keys);
    for (int k = 0; k < atoms->n_local; ++k) order[k] = sorted[k].index;
    HS_FREE(sorted);
    return HS_OK;
}

size_t hs_chains_memory(const hs_chains *chains)
{
    const size_t n_atoms = (size_t)chains->capacity_atoms, n_tables = chains->number != NULL ? 3 : 1;
    const size_t by_atom = sizeof *chains->next + (chains->cell != NULL ? 2 * sizeof *chains->cell : 0);
    return n_atoms * by_atom + (size_t)chains->capacity_cells * n_tables * sizeof *chains->head +
           (size_t)chains->table.capacity_slots * sizeof *chains->table.slot +
           (size_t)chains->table.capacity_cells * sizeof *chains->table.place_of +
           (size_t)chains->grid.capacity_stencil * sizeof *chains->grid.stencil;
}

void hs_chains_fini(hs_chains *chains)
{
    hs_grid_fini(&chains->grid);
    HS_FREE(chains->head);
    HS_FREE(chains->next);
    HS_FREE(chains->number);
    HS_FREE(chains->place);
    HS_FREE(chains->cell);
    HS_FREE(chains->previous);
    hs_hash_table_fini(&chains->table);
    memset(chains, 0, sizeof *chains);
}
