/** A regular grid of cells over a region, and the stencil: the cells around a cell in which neighbors may be. Shared by the
 *  textbook methods (neighbor/chains.h) and the public cell lists (neighbor/cell_list.c). */
#ifndef HS_NEIGHBOR_GRID_H
#define HS_NEIGHBOR_GRID_H

#include <stdbool.h>
#include <stdint.h>

#include "base/error.h"

/** How cells are numbered, and atoms that are sorted by their cells. */
typedef enum {
    HS_CELL_ORDER_MORTON, /**< along the Morton curve, which keeps near cells near in memory */
    HS_CELL_ORDER_ROW,    /**< row by row, z fastest */
    HS_CELL_ORDER_NONE,   /**< cells row by row; atoms are not sorted */
    HS_N_CELL_ORDERS
} hs_cell_order;

extern const char *const hs_cell_order_names[]; /**< ended by NULL */

/** Cells of equal size that fill the region, n[a] of them along axis a (x, y, z). In 2D n[2] is 1 and z is of no account. */
typedef struct hs_grid {
    double lo[3]; /**< lower corner of the region */
    double pitch[3], inv_pitch[3];
    int n[3];
    int (
        *stencil)[3]; /**< owned [n_stencil]: offsets of the upper half: those whose first nonzero number is positive */
    int n_stencil, capacity_stencil;
} hs_grid;

/** What a grid is to be like. */
typedef struct hs_grid_plan {
    int dimension;
    double lo[3], hi[3]; /**< region; atoms beyond it count to the cells at its edge */
    bool wraps[3];       /**< periodic axis whose other side the stencil reaches; else it ends at the region's edge */
    double reach;        /**< pairs closer than this are to be found, > 0 */
    double edge;         /**< smallest length of a cell's edges, > 0 */
    bool is_cube; /**< the whole cube of cells within reach along each axis; else pruned to what a sphere reaches */
} hs_grid_plan;

/** Lay the grid and make its stencil. *has_changed (may be NULL) tells whether cells lie otherwise than before. */
HS_MUST_USE hs_status hs_grid_set(hs_grid *grid, const hs_grid_plan *plan, bool *has_changed, hs_error *err);
void hs_grid_fini(hs_grid *grid);
/** Cells of the grid. */
int64_t hs_grid_n_cells(const hs_grid *grid);
/** Key by which atoms are sorted in an order of cells. */
uint64_t hs_grid_key(const hs_grid *grid, hs_cell_order order, const int c[3]);

/** Coordinate of the cell at x along axis a. Clamped: an atom beyond the region counts to the cell at its edge, which
 *  brings no two atoms farther apart than they are. */
static inline int hs_grid_coordinate(const hs_grid *grid, int a, double x)
{
    const double c = (x - grid->lo[a]) * grid->inv_pitch[a];
    return c > 0.0 ? (c < grid->n[a] ? (int)c : grid->n[a] - 1) : 0;
}

/** Number of a cell, row by row. */
static inline int64_t hs_grid_place(const hs_grid *grid, const int c[3])
{
    return ((int64_t)c[0] * grid->n[1] + c[1]) * grid->n[2] + c[2];
}

/** The cell of that number. */
static inline void hs_grid_cell_at(const hs_grid *grid, int64_t place, int c[3])
{
    c[2] = (int)(place % grid->n[2]);
    c[1] = (int)(place / grid->n[2] % grid->n[1]);
    c[0] = (int)(place / grid->n[2] / grid->n[1]);
}

#endif
