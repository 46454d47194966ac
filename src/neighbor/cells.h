/** Cells in Morton order and the counting sort of atoms into them.
 *
 *  The grid is made of columns: cells of one column stand one on the other along the run axis (z; y in 2D) and are
 *  consecutive in memory; columns follow one another along the Morton curve of their two (one in 2D) coordinates. A range
 *  of cells within one column is therefore one contiguous run of atoms, which is what the force loops want. */
#ifndef HS_NEIGHBOR_CELLS_H
#define HS_NEIGHBOR_CELLS_H

#include "core/atoms.h"
#include "core/box.h"
#include "neighbor/grid.h"

/** Grid over this rank's brick of the box and a margin of `reach` around it. Index 0, 1: column axes; 2: run axis (`axis` maps to x, y, z). */
typedef struct hs_cells {
    int axis[3];
    double lo[3]; /**< lower corner of cell 0 */
    double pitch[3], inv_pitch[3];
    int n[3];           /**< cells per axis */
    double brick_hi[3]; /**< upper faces of the brick, relative to lo: halo atoms lie beyond one of them at least */
    int n_columns;
    hs_cell_order curve;        /**< of the columns, set by the caller: along the Morton curve, or row by row */
    hs_cell_order ranked_curve; /**< the one that column_rank is for */
    int32_t *column_rank;       /**< owned [n[0] * n[1]]: place of column (c0, c1) in that order */
    int32_t *start_local;       /**< owned [n_columns * n[2] + 1]: first local atom of each cell */
    int32_t *start_halo;        /**< the same for halo atoms, counted from 0 at the first halo atom */
    int64_t capacity_cells, capacity_columns;
    hs_sort_scratch sort; /**< borrowed from the sorted atoms: their order, and the cell of each */
    int32_t *histogram;   /**< owned scratch [threads][cells] */
    int64_t capacity_histogram;
} hs_cells;

/** Lay a grid over this rank's brick of the box, from lo to hi, and its margin, with columns `width` wide and cells about a
 *  third of that high. Cells are made larger where there would be many more of them than atoms. cells->curve must be set. */
HS_MUST_USE hs_status hs_cells_set_grid(hs_cells *cells, const double brick_lo[3], const double brick_hi[3],
                                        int dimension, double reach, double width, int64_t n_atoms, hs_error *err);
/** Halo atoms do not keep beyond the upper faces of what the grid was laid over. */
void hs_cells_expect_halo_anywhere(hs_cells *cells);
/** Counting sort of the local atoms by cell; within a cell by place along the run axis, then by id. Computes
 *  cells->sort.order, in the atoms' own scratch (forces are lost), and start_local; the caller permutes the arrays. Threaded;
 *  independent of the number of threads. */
HS_MUST_USE hs_status hs_cells_sort_local(hs_cells *cells, const hs_atoms *atoms, hs_error *err);
/** The same for the halo atoms (order counted from the first halo atom). */
HS_MUST_USE hs_status hs_cells_sort_halo(hs_cells *cells, const hs_atoms *atoms, hs_error *err);
void hs_cells_fini(hs_cells *cells);

/** Cell coordinate of a place along grid axis a, clamped into the grid. */
static inline int hs_cells_coordinate(const hs_cells *cells, int a, double x)
{
    const double c = (x - cells->lo[a]) * cells->inv_pitch[a];
    return c <= 0.0 ? 0 : c >= cells->n[a] ? cells->n[a] - 1 : (int)c;
}

/** Interleave the lower 21 bits of three numbers, a highest. */
uint64_t hs_morton_encode_3d(uint32_t a, uint32_t b, uint32_t c);

#endif
