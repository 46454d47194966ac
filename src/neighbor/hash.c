/* Method `hash`: head and next for the occupied cells only, which a hash table finds. */
#include "base/memory.h"
#include "neighbor/chains.h"

/** Room for n atoms, each in a cell of its own. */
static hs_status reserve(hs_chains *chains, int n, hs_error *err)
{
    HS_TRY(hs_chains_reserve(chains, n, err));
    HS_TRY(hs_hash_table_clear(&chains->table, chains->capacity_atoms, err));
    if (chains->capacity_atoms > chains->capacity_cells) {
        HS_TRY(HS_GROW(chains->head, 0, (size_t)chains->capacity_atoms, err));
        chains->capacity_cells = chains->capacity_atoms;
    }
    return HS_OK;
}

hs_status hs_hash_build(hs_chains *chains, const hs_atoms *atoms, hs_error *err)
{
    const int n = atoms->n_local + atoms->n_halo;
    HS_TRY(reserve(chains, n, err));
    for (int i = 0; i < n; ++i) {
        int c[3];
        bool is_new;
        if (!hs_chains_takes(chains, atoms, i)) continue;
        hs_chains_locate(chains, atoms, i, c);
        const int32_t cell = hs_hash_table_insert(&chains->table, hs_grid_place(&chains->grid, c), &is_new);
        chains->next[i] = is_new ? HS_CHAIN_END : chains->head[cell];
        chains->head[cell] = i;
    }
    chains->n_atoms = n;
    chains->n_cells = chains->table.n_cells;
    chains->is_hashed = true;
    chains->is_void = true; /* for `incremental`, which could not tell whose chains these are */
    return HS_OK;
}
