#include "neighbor/hash_table.h"

#include <string.h>

#include "base/memory.h"

hs_status hs_hash_table_clear(hs_hash_table *table, int64_t n_cells_max, hs_error *err)
{
    int64_t n_slots = 16;
    while (n_slots < 2 * n_cells_max) n_slots *= 2;
    if (n_slots > table->capacity_slots) {
        HS_TRY(HS_GROW(table->slot, 0, (size_t)n_slots, err));
        table->capacity_slots = n_slots;
    }
    if (n_cells_max > table->capacity_cells) {
        HS_TRY(HS_GROW(table->place_of, 0, (size_t)n_cells_max, err));
        table->capacity_cells = n_cells_max;
    }
    memset(table->slot, 0xff, (size_t)n_slots * sizeof *table->slot); /* -1 */
    table->n_slots = n_slots;
    table->n_cells = 0;
    return HS_OK;
}

void hs_hash_table_fini(hs_hash_table *table)
{
    HS_FREE(table->slot);
    HS_FREE(table->place_of);
    memset(table, 0, sizeof *table);
}
