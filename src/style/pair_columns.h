/** Computes whose local values are of pairs: what compute pair/local and compute property/local share. */
#ifndef HS_STYLE_PAIR_COLUMNS_H
#define HS_STYLE_PAIR_COLUMNS_H

#include "style/pair_rows.h"

/** What is told of a pair. */
typedef enum {
    HS_PAIR_DIST,
    HS_PAIR_DX,
    HS_PAIR_DY,
    HS_PAIR_DZ,
    HS_PAIR_ENG,
    HS_PAIR_FORCE,
    HS_PAIR_FX,
    HS_PAIR_FY,
    HS_PAIR_FZ,
    HS_PAIR_ATOM1,
    HS_PAIR_ATOM2,
    HS_PAIR_TYPE1,
    HS_PAIR_TYPE2
} hs_pair_quantity;

/** State of such a compute. */
typedef struct hs_pair_columns {
    hs_pair_quantity *column; /**< owned [n] */
    int n;
    hs_pair_choice choice;
    int64_t n_rows; /**< of the evaluation before: as many are expected */
} hs_pair_columns;

/** The keyword `cutoff`. */
extern const hs_keyword hs_pair_columns_keywords[];

/** A column more, and the number of the compute's columns with it. */
HS_MUST_USE hs_status hs_pair_columns_add(hs_compute *compute, hs_pair_quantity quantity, hs_error *err);
/** Read `cutoff type|radius` at word i, args->n for none. */
HS_MUST_USE hs_status hs_pair_columns_read_cutoff(hs_compute *compute, const hs_args *args, int i, hs_error *err);

/* Hooks of the styles. */
void hs_pair_columns_destroy(hs_compute *compute);
HS_MUST_USE hs_status hs_pair_columns_local(hs_compute *compute, hs_error *err);

#endif
