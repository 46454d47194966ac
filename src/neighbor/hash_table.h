/** Hash table of the occupied cells of a grid: numbers them 0, 1, ... in the order in which they are met. Open addressing with
 *  linear probing, at most half full. */
#ifndef HS_NEIGHBOR_HASH_TABLE_H
#define HS_NEIGHBOR_HASH_TABLE_H

#include <stdint.h>

#include "base/error.h"

/** Zero it before use. */
typedef struct hs_hash_table {
    int32_t *slot;     /**< owned [n_slots]: number of an occupied cell, or -1 */
    int64_t *place_of; /**< owned [n_cells]: place in the grid of each occupied cell */
    int64_t n_cells;   /**< occupied cells */
    int64_t n_slots;   /**< a power of two; 0 before the first clear */
    int64_t capacity_slots, capacity_cells;
} hs_hash_table;

/** Empty the table, with room for as many cells as there may be. */
HS_MUST_USE hs_status hs_hash_table_clear(hs_hash_table *table, int64_t n_cells_max, hs_error *err);
void hs_hash_table_fini(hs_hash_table *table);

/** Slot that holds the cell at a place, or the empty one where it belongs. The search begins where the upper bits of a
 *  product point, which spread neighboring places over the table (Fibonacci hashing: D. E. Knuth, The Art of Computer
 *  Programming, vol. 3, section 6.4). */
static inline uint64_t hs_hash_table_slot(const hs_hash_table *table, int64_t place)
{
    const int bits = __builtin_ctzll((uint64_t)table->n_slots);
    uint64_t slot = (uint64_t)place * UINT64_C(0x9E3779B97F4A7C15) >> (64 - bits);
    while (table->slot[slot] >= 0 && table->place_of[table->slot[slot]] != place)
        slot = (slot + 1) & (uint64_t)(table->n_slots - 1);
    return slot;
}

/** Number of the occupied cell at a place, or -1. */
static inline int32_t hs_hash_table_find(const hs_hash_table *table, int64_t place)
{
    return table->slot[hs_hash_table_slot(table, place)];
}

/** Number of the cell at a place, which is occupied from now on; *is_new tells whether it was not before. */
static inline int32_t hs_hash_table_insert(hs_hash_table *table, int64_t place, bool *is_new)
{
    int32_t *cell = &table->slot[hs_hash_table_slot(table, place)];
    *is_new = *cell < 0;
    if (*is_new) {
        *cell = (int32_t)table->n_cells++;
        table->place_of[*cell] = place;
    }
    return *cell;
}

#endif
