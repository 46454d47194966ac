/** Means of correlated series and how far they can be trusted.
 *
 *  Blocks of 2, 4, 8, ... neighbors are averaged as values come in, in memory that grows with the logarithm of their
 *  number: H. Flyvbjerg, H. G. Petersen, J. Chem. Phys. 91, 461 (1989), doi:10.1063/1.457480. Scatter of blocks alone
 *  shows too small an error, because neighboring blocks are correlated still, the more so where a slow mode hides below
 *  a fast one. So the correlation c of neighboring blocks is counted too: with the variance s2 of n blocks the square
 *  of the error is
 *      (s2 + 2 c) / n = (3 S - q) / (n - 3),
 *  S the mean squared deviation from the mean of the series (which is too small by that square itself), q = 2 (s2 - c)
 *  the mean squared difference of neighbors. That is the sum of the autocorrelation through a window that is flat up to
 *  one block and falls to 0 at two: D. N. Politis, J. P. Romano, J. Time Series Anal. 16, 67 (1995),
 *  doi:10.1111/j.1467-9892.1995.tb00223.x. The length is the shortest B with B^3 > 2 n g^2, where g is the inefficiency
 *  that blocks of B show: R. M. Lee et al., Phys. Rev. E 83, 066706 (2011), doi:10.1103/PhysRevE.83.066706; there are
 *  at least 8 blocks. The error is the half width of the interval that holds the true mean with the probability
 *  erf(1/sqrt(2)) = 68.3 %, of Student's t, for it rests on few blocks. */
#ifndef HS_CORE_STATISTICS_H
#define HS_CORE_STATISTICS_H

#include <stdbool.h>
#include <stdint.h>

#include "base/error.h"

enum { HS_BLOCK_LEVELS = 48 }; /**< 2^48 values are more than a run can give */

/** Blocks of one length: Welford's sums of their means. */
typedef struct hs_block_level {
    int64_t n;
    double mean, m2;               /**< mean of the blocks, and sum of their squared deviations from it */
    double weight, weight2, cross; /**< the same of their weights, and sum of the products of both deviations */
    double last, last_weight;      /**< the latest block */
    double step2, step_weight2, step_cross; /**< sums of squares and products of differences of neighboring blocks */
} hs_block_level;

/** A series. Zero-initialised it is empty. */
typedef struct hs_series {
    int64_t n;
    hs_block_level level[HS_BLOCK_LEVELS];
} hs_series;

/** What is known of the mean: of the sum of all values over the sum of all weights. */
typedef struct hs_estimate {
    int64_t n;
    double mean;
    double variance; /**< of single values */
    double error; /**< the true mean is that near in 68 % of all series; 0 for fewer than two values, which show none */
    double inefficiency; /**< values per independent one */
    int64_t block;       /**< length of the blocks that the error is taken from */
    bool is_converged;   /**< at least 20 independent values; with fewer the error may be too small */
} hs_estimate;

/** Add a value. Its weight is 1, or as in hs_series_set_add. */
void hs_series_add(hs_series *series, double value, double weight);
hs_estimate hs_series_estimate(const hs_series *series);

/** Many series that grow together. Zero-initialised but for n_series it is empty. */
typedef struct hs_series_set {
    int n_series;
    int n_levels, capacity; /**< levels in use, and those there is room for */
    hs_block_level *level;  /**< owned [capacity][n_series] */
} hs_series_set;

/** Add one value to each series. With weights (NULL: all are 1) values are sums over something that varies in number,
 *  the weight: the mean is the ratio of both sums, and its error that of the ratio, to first order: W. G. Cochran,
 *  Sampling Techniques, 3rd ed. (1977), section 6.3. */
HS_MUST_USE hs_status hs_series_set_add(hs_series_set *set, const double *values, const double *weights, hs_error *err);
hs_estimate hs_series_set_estimate(const hs_series_set *set, int k);
/** Forget all values. */
void hs_series_set_clear(hs_series_set *set);
/** Room for at least that many levels; new ones are empty. */
HS_MUST_USE hs_status hs_series_set_reserve(hs_series_set *set, int n_levels, hs_error *err);
void hs_series_set_fini(hs_series_set *set);

/** Slope of a straight line fitted to points (x, y), and its sums. Zero-initialised it is empty. */
typedef struct hs_line {
    int64_t n;
    double mean_x, mean_y, sxx, sxy, syy;
} hs_line;

void hs_line_add(hs_line *line, double x, double y);
/** Slope and its standard error, as if the deviations were independent; 0 for fewer than three points. */
void hs_line_slope(const hs_line *line, double *slope, double *error);

#endif
