/** Rows of text that the atoms of all ranks write into one file, in one order over all ranks.
 *
 *  Every rank brings its rows into order and makes their text; the first rank merges the ranks' rows and writes them.
 *  No rank ever holds more than its own rows and some pieces of the others', whatever the number of atoms. */
#ifndef HS_IO_ROW_STREAM_H
#define HS_IO_ROW_STREAM_H

#include "base/text.h"
#include "io/writer.h"
#include "parallel/parallel.h"

/** What rows are ordered by: value, then id. */
typedef struct hs_row_key {
    double value;
    int64_t id;
} hs_row_key;

/** The rows of this rank. */
typedef struct hs_text_rows {
    int64_t n;
    bool is_descending; /**< by value; ids always ascend. The same on all ranks */
    bool by_rank;       /**< all rows of a rank before those of the next; keys are not asked for */
    /** Key of row k; rows must ascend by it (or descend). */
    hs_row_key (*key)(const void *context, int64_t k);
    /** Append row k and its newline to text. */
    HS_MUST_USE hs_status (*format)(const void *context, int64_t k, hs_text *text, hs_error *err);
    const void *context;
} hs_text_rows;

/** Which of two keys comes first: < 0, 0, > 0. */
int hs_row_compare(const hs_row_key *a, const hs_row_key *b, bool is_descending);

/** Write the rows of all ranks. @p writer is the first rank's; NULL on the others. Collective, errors agreed: one that
 *  a rank holds in @p err already stops all before anything is written. */
HS_MUST_USE hs_status hs_text_rows_write(const hs_text_rows *rows, hs_writer *writer, const hs_parallel *parallel,
                                         hs_error *err);

#endif
