/** One number from the values of all atoms: sum, mean, extreme. What compute reduce and compute reduce/region are. */
#ifndef HS_STYLE_REDUCTION_H
#define HS_STYLE_REDUCTION_H

#include "style/region.h"
#include "style/value.h"

/** What is reduced: an attribute of atoms, or a value per atom. */
typedef struct hs_reduction_input {
    int attribute; /**< -1: a reference */
    hs_value value;
    int replaced_by; /**< -1, or the input at whose extreme atom this one is taken */
} hs_reduction_input;

/** State of a compute that reduces. */
typedef struct hs_reduction {
    int mode;
    hs_reduction_input *inputs; /**< owned [n] */
    int n;
    hs_where where;
    double *values; /**< owned [n_local] scratch */
    int capacity;
} hs_reduction;

extern const hs_keyword hs_reduction_keywords[];

/* Hooks of the styles; that of the name reduce/region takes the ID of a region as its first word. */
HS_MUST_USE hs_status hs_reduction_create(hs_compute *compute, const hs_args *args, hs_error *err);
void hs_reduction_destroy(hs_compute *compute);
HS_MUST_USE hs_status hs_reduction_init(hs_compute *compute, hs_error *err);
HS_MUST_USE hs_status hs_reduction_scalar(hs_compute *compute, double *value, hs_error *err);
HS_MUST_USE hs_status hs_reduction_vector(hs_compute *compute, hs_error *err);

#endif
