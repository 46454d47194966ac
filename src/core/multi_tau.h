/** Time correlations of series of any length in bounded memory: up to a window at every lag, beyond it on ever coarser
 *  grids.
 *
 *  Level 0 has the samples themselves; a sample of level l + 1 is the mean of two of level l. Each level correlates its
 *  samples at the lags below the window through fast Fourier transforms (core/fourier.h), and from level 1 on the upper
 *  half of its lags counts, which the level below does not reach. This is the multiple-tau scheme of J. Ramirez, S. K.
 *  Sukumaran, B. Vorselaars, A. E. Likhtman, J. Chem. Phys. 133, 154103 (2010), doi:10.1063/1.3491098, with m = 2;
 *  averaging over 2^l samples changes a correlation at lag t by about C''(t) (2^l)^2 / 12, which is small where C
 *  varies over many samples. */
#ifndef HS_CORE_MULTI_TAU_H
#define HS_CORE_MULTI_TAU_H

#include "core/fourier.h"
#include "core/statistics.h"

typedef struct hs_multi_tau_level {
    double *sample;       /**< owned [n_values][2 n_lags]: the block before, and the present one */
    double *sum;          /**< owned [n_columns][n_lags]: products in complete blocks */
    double *half;         /**< owned [n_values]: the first of two samples of the next level */
    int n_present;        /**< samples of the present block */
    int64_t n_total;      /**< samples so far */
    hs_series_set blocks; /**< of [n_columns][n_lags], a value a block; empty without errors */
} hs_multi_tau_level;

typedef struct hs_multi_tau {
    int n_values, n_pairs, n_columns, n_lags, n_levels;
    int (*pair)[2];            /**< owned [n_pairs]: C_ij(t) = <V_i(s) V_j(s + t)> */
    int *column;               /**< owned [n_pairs]: sum that the products of the pair are added to */
    hs_multi_tau_level *level; /**< owned [n_levels] */
    hs_correlator *correlator; /**< owned */
    double *block;             /**< owned [2][n_columns][n_lags]: sums of one block, and their counts */
    bool has_errors;
} hs_multi_tau;

/** What is to be correlated: lags 0 .. n_lags - 1 and, with more levels than one, n_lags up to (n_lags - 1) 2^(n_levels - 1);
 *  n_lags is even then. */
typedef struct hs_multi_tau_plan {
    int n_values, n_pairs;
    int (*pair)[2];    /**< borrowed [n_pairs]: C_ij(t) = <V_i(s) V_j(s + t)> */
    const int *column; /**< borrowed [n_pairs]: pairs of one column are added up; NULL: each has its own */
    int n_lags, n_levels;
    bool has_errors;
} hs_multi_tau_plan;

/** Zero the object before; hs_multi_tau_fini frees it, also after an error. Not collective. */
HS_MUST_USE hs_status hs_multi_tau_init(hs_multi_tau *tau, const hs_multi_tau_plan *plan, hs_error *err);
void hs_multi_tau_fini(hs_multi_tau *tau);
/** The next sample: values[n_values]. */
HS_MUST_USE hs_status hs_multi_tau_add(hs_multi_tau *tau, const double *values, hs_error *err);

/** Lags in all: rows of the result. */
static inline int hs_multi_tau_rows(const hs_multi_tau *tau)
{
    return tau->n_lags + (tau->n_levels - 1) * (tau->n_lags / 2);
}
/** The lag of a row, in samples of level 0. */
int64_t hs_multi_tau_lag(const hs_multi_tau *tau, int row);
/** Means at all rows: how many products they are made of, count[n_rows], and value[n_rows][n_columns]; 0 without
 *  products. With errors also their standard errors and inefficiencies (blocks that count as one) in the same shape;
 *  NaN where fewer than two blocks are complete. Both may be NULL. */
void hs_multi_tau_result(hs_multi_tau *tau, double *count, double *value, double *error, double *inefficiency);

#endif
