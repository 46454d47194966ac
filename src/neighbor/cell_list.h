/** What the files of the public cell lists (include/halfshell/cells.h) share. */
#ifndef HS_NEIGHBOR_CELL_LIST_H
#define HS_NEIGHBOR_CELL_LIST_H

#include <halfshell/cells.h>

#include "neighbor/grid.h"
#include "neighbor/hash_table.h"

struct hs_cell_list {
    hs_cell_list_box box;
    double reach, cell;
    int n_threads;
    hs_grid grid;
    bool is_hashed;      /**< cells are the occupied ones, found in `table`; else all of the grid */
    hs_hash_table table; /**< owned */
    int64_t n, n_cells;
    double *x[3];     /**< owned [n]: positions in the box, cell by cell */
    int32_t *index;   /**< owned [n]: the caller's number of each */
    int32_t *start;   /**< owned [n_cells + 1]: first particle of each cell */
    int32_t *key;     /**< owned scratch [n]: cell of each particle, in the caller's order */
    int64_t *place;   /**< owned scratch [n], when hashed: its place in the grid */
    double *given[3]; /**< owned scratch [n]: positions in the box, in the caller's order */
    int64_t capacity, capacity_cells;
    hs_error error; /**< of the last call */
};

/** Number of the cell at c, which is inside of the grid; -1 for an empty one that has none. */
static inline int64_t hs_cell_list_number(const hs_cell_list *list, const int c[3])
{
    const int64_t place = hs_grid_place(&list->grid, c);
    return list->is_hashed ? hs_hash_table_find(&list->table, place) : place;
}

#endif
