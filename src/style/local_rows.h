/** Local values: a table whose rows are not atoms but, say, pairs of atoms.
 *
 *  Rows belong to the compute that makes them, live for one revision (style/env.h), and are spread over the ranks. Those of rank 0,
 *  then those of rank 1, and so on, are all rows in the order that the compute states, which is the same for any number of
 *  ranks and threads and any neighbor method: only where ranks begin differs. */
#ifndef HS_STYLE_LOCAL_ROWS_H
#define HS_STYLE_LOCAL_ROWS_H

#include "parallel/parallel.h"

typedef struct hs_local_rows {
    int n;          /**< of this rank */
    int64_t first;  /**< number of its first row among all, from 0 */
    int64_t n_all;  /**< of all ranks */
    double *values; /**< owned: column k of row i is values[k * n + i] */
    size_t capacity;
} hs_local_rows;

void hs_local_rows_fini(hs_local_rows *rows);
/** Room for n rows of n_columns each; what was there is lost. An error beyond 2^31 rows of a rank. Not collective. */
HS_MUST_USE hs_status hs_local_rows_reserve(hs_local_rows *rows, int64_t n, int n_columns, hs_error *err);
/** Number the rows of all ranks (collective, errors agreed: one that a rank holds in @p err already stops all). */
HS_MUST_USE hs_status hs_local_rows_number(hs_local_rows *rows, const hs_parallel *parallel, hs_error *err);

#endif
