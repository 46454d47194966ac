/* Method `hash`: head and next for the occupied cells only, which a hash table finds. */
#include "base/memory.h"
#include "neighbor/chains.h"

/** Slot where the search for a cell begins: the upper bits of a product spread neighboring places over the table
 *  (Fibonacci hashing: D. E. Knuth, The Art of Computer Programming, vol. 3, section 6.4). */
static inline uint64_t first_slot(const hs_chains *chains, int64_t place)
{
    const int bits = __builtin_ctzll((uint64_t)chains->n_slots);
    return (uint64_t)place * UINT64_C(0x9E3779B97F4A7C15) >> (64 - bits);
}

/** Slot that holds the cell at a place, or the empty one where it belongs. */
static inline uint64_t find_slot(const hs_chains *chains, int64_t place)
{
    uint64_t slot = first_slot(chains, place);
    while (chains->slot[slot] != HS_CHAIN_END && chains->place_of[chains->slot[slot]] != place)
        slot = (slot + 1) & (uint64_t)(chains->n_slots - 1);
    return slot;
}

int32_t hs_hash_find(const hs_chains *chains, int64_t place) { return chains->slot[find_slot(chains, place)]; }

/** Room for n atoms, each in a cell of its own, and at least twice as many slots. */
static hs_status reserve(hs_chains *chains, int n, hs_error *err)
{
    HS_TRY(hs_chains_reserve(chains, n, err));
    if (chains->capacity_atoms > chains->capacity_cells || chains->place_of == NULL) {
        HS_TRY(HS_GROW(chains->head, 0, (size_t)chains->capacity_atoms, err));
        HS_TRY(HS_GROW(chains->place_of, 0, (size_t)chains->capacity_atoms, err));
        chains->capacity_cells = chains->capacity_atoms;
    }
    chains->n_slots = 16;
    while (chains->n_slots < 2 * (int64_t)n) chains->n_slots *= 2;
    if (chains->n_slots > chains->capacity_slots) {
        HS_TRY(HS_GROW(chains->slot, 0, (size_t)chains->n_slots, err));
        chains->capacity_slots = chains->n_slots;
    }
    return HS_OK;
}

hs_status hs_hash_build(hs_chains *chains, const hs_atoms *atoms, hs_error *err)
{
    const int n = atoms->n_local + atoms->n_halo;
    HS_TRY(reserve(chains, n, err));
    chains->n_atoms = n;
    chains->n_cells = 0;
    chains->is_void = true;
    for (int64_t slot = 0; slot < chains->n_slots; ++slot) chains->slot[slot] = HS_CHAIN_END;
    for (int i = 0; i < n; ++i) {
        int c[3];
        hs_chains_locate(chains, atoms, i, c);
        const int64_t place = hs_grid_place(&chains->grid, c);
        int32_t *cell = &chains->slot[find_slot(chains, place)];
        if (*cell == HS_CHAIN_END) { /* the first atom of a cell */
            *cell = (int32_t)chains->n_cells++;
            chains->place_of[*cell] = place;
            chains->head[*cell] = HS_CHAIN_END;
        }
        chains->next[i] = chains->head[*cell];
        chains->head[*cell] = i;
    }
    return HS_OK;
}
