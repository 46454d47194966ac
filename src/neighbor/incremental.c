/* Method `incremental`: doubly linked chains, in which only atoms that have changed cell are moved. */
#include "base/memory.h"
#include "neighbor/chains.h"

static void insert(hs_chains *chains, int32_t i, int32_t cell)
{
    const int32_t first = chains->head[cell];
    chains->cell[i] = cell;
    chains->previous[i] = HS_CHAIN_END;
    chains->next[i] = first;
    if (first != HS_CHAIN_END) chains->previous[first] = i;
    chains->head[cell] = i;
}

static void remove_atom(hs_chains *chains, int32_t i)
{
    const int32_t before = chains->previous[i], after = chains->next[i];
    if (before != HS_CHAIN_END)
        chains->next[before] = after;
    else
        chains->head[chains->cell[i]] = after;
    if (after != HS_CHAIN_END) chains->previous[after] = before;
}

/** Insert the atoms [begin, end), which are in no chain. */
static void insert_all(hs_chains *chains, const hs_atoms *atoms, int begin, int end)
{
    for (int i = end - 1; i >= begin; --i) {
        int c[3];
        if (!hs_chains_takes(chains, atoms, i)) {
            chains->cell[i] = HS_CHAIN_END; /* in none */
            continue;
        }
        hs_chains_locate(chains, atoms, i, c);
        insert(chains, i, hs_chains_number(chains, c));
    }
}

/** Move those of the atoms [0, end) that are in another cell than before. */
static void move_changed(hs_chains *chains, const hs_atoms *atoms, int end)
{
    for (int i = 0; i < end; ++i) {
        int c[3];
        if (!hs_chains_takes(chains, atoms, i)) continue;
        hs_chains_locate(chains, atoms, i, c);
        const int32_t cell = hs_chains_number(chains, c);
        if (cell == chains->cell[i]) continue;
        remove_atom(chains, i);
        insert(chains, i, cell);
        ++chains->n_changed;
    }
    chains->n_checked += end;
}

static hs_status reserve(hs_chains *chains, int n, hs_error *err)
{
    HS_TRY(hs_chains_reserve(chains, n, err));
    if (chains->cell == NULL) HS_TRY(HS_ALLOC(chains->cell, (size_t)chains->capacity_atoms, err));
    if (chains->previous == NULL) HS_TRY(HS_ALLOC(chains->previous, (size_t)chains->capacity_atoms, err));
    return HS_OK;
}

hs_status hs_incremental_update(hs_chains *chains, const hs_atoms *atoms, bool has_new_halo, hs_error *err)
{
    const int n = atoms->n_local + atoms->n_halo;
    const bool is_new = chains->is_void || chains->cell == NULL || chains->generation != atoms->generation ||
                        chains->n_local != atoms->n_local;
    HS_TRY(hs_chains_number_cells(chains, err));
    if (!is_new && has_new_halo)
        for (int i = atoms->n_local; i < chains->n_atoms; ++i)
            if (chains->cell[i] != HS_CHAIN_END) remove_atom(chains, i);
    HS_TRY(reserve(chains, n, err));
    if (is_new) {
        for (int64_t cell = 0; cell < chains->n_cells; ++cell) chains->head[cell] = HS_CHAIN_END;
        insert_all(chains, atoms, 0, n);
    } else if (has_new_halo) {
        move_changed(chains, atoms, atoms->n_local);
        insert_all(chains, atoms, atoms->n_local, n);
    } else {
        move_changed(chains, atoms, n);
    }
    chains->n_atoms = n;
    chains->n_local = atoms->n_local;
    chains->generation = atoms->generation;
    chains->is_void = false;
    return HS_OK;
}
