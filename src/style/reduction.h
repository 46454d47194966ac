/** One number from the values of all atoms, or from all local values: sum, mean, extreme. What compute reduce and compute reduce/region
 *  are. */
#ifndef HS_STYLE_REDUCTION_H
#define HS_STYLE_REDUCTION_H

#include "style/atom_source.h"
#include "style/region.h"

/** What is reduced: the values of one input on this rank. */
typedef struct hs_reduced {
    const double *value;       /**< borrowed */
    const hs_local_rows *rows; /**< borrowed; NULL: the values are of the local atoms */
} hs_reduced;

/** State of a compute that reduces. */
typedef struct hs_reduction {
    int mode;
    hs_atom_source *inputs; /**< owned [n] */
    int *replaced_by;       /**< owned [n]: -1, or the input at whose extreme atom this one is taken */
    int n;
    hs_where where;
    double *values; /**< owned [capacity] scratch: of each local atom */
    size_t capacity;
    hs_reduced present; /**< input that is being reduced */
} hs_reduction;

extern const hs_keyword hs_reduction_keywords[];

/* Hooks of the styles; that of the name reduce/region takes the ID of a region as its first word. */
HS_MUST_USE hs_status hs_reduction_create(hs_compute *compute, const hs_args *args, hs_error *err);
void hs_reduction_destroy(hs_compute *compute);
HS_MUST_USE hs_status hs_reduction_init(hs_compute *compute, hs_error *err);
HS_MUST_USE hs_status hs_reduction_scalar(hs_compute *compute, double *value, hs_error *err);
HS_MUST_USE hs_status hs_reduction_vector(hs_compute *compute, hs_error *err);

#endif
