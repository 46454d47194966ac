/** Atoms of all ranks in the order of their ids, brought to rank 0 block by block: the one way in which data of atoms
 *  get from the ranks into files. No rank ever holds more than its own atoms and one block.
 *
 *      hs_rows rows = {0};
 *      status = hs_rows_begin(&rows, parallel, atoms, mask, err);
 *      while (status == HS_OK && hs_rows_next(&rows, &status, err)) {
 *          fill mine[k] for the atoms rows.mine[0 .. rows.n_mine);
 *          hs_rows_gather(&rows, mine, sizeof *mine, all);        all[rows.n_block] on rank 0: rows rows.first_row ...
 *      }
 *      hs_rows_end(&rows);
 */
#ifndef HS_IO_ROWS_H
#define HS_IO_ROWS_H

#include "core/atoms.h"
#include "parallel/parallel.h"

/** Rows of one block at most. */
enum { HS_ROWS_BLOCK = 1 << 18 };

typedef struct hs_rows {
    int64_t n_all; /**< rows on all ranks */

    /* The present block */
    int64_t first_row;   /**< number of its first row, from 0 */
    int n_block;         /**< its rows on all ranks */
    const int32_t *mine; /**< [n_mine] this rank's atoms in it (indices of local atoms), in the order of ids */
    int n_mine;

    /* private */
    const hs_parallel *parallel;
    const int64_t *id;  /**< borrowed from the atoms */
    int32_t *order;     /**< owned; this rank's atoms in the order of ids */
    int n_local;        /**< its length */
    int begin;          /**< of mine in order */
    int64_t id_end;     /**< ids from here on come later */
    int64_t *n_of_rank; /**< owned [n_ranks]; each rank's rows in the block */
    int32_t *place;     /**< owned [HS_ROWS_BLOCK] on rank 0 of several: row of each gathered one */
    char *buffer;       /**< owned; gathered rows before they are put in place */
    size_t buffer_size; /**< bytes */
} hs_rows;

/** Local atoms with a group bit of @p mask; at the start of the walk (collective). */
HS_MUST_USE hs_status hs_rows_begin(hs_rows *rows, const hs_parallel *parallel, const hs_atoms *atoms, uint32_t mask,
                                    hs_error *err);
/** The next block (collective); false at the end, and after an error, which is also put in *status. */
bool hs_rows_next(hs_rows *rows, hs_status *status, hs_error *err);
/** Bring mine[n_mine] of @p size bytes each to rank 0's all[n_block], in the order of ids (collective). */
HS_MUST_USE hs_status hs_rows_gather(hs_rows *rows, const void *mine, size_t size, void *all, hs_error *err);
/** The walk begins anew, with the same atoms (collective). */
void hs_rows_again(hs_rows *rows);
void hs_rows_end(hs_rows *rows);

#endif
