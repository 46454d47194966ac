#include "core/multi_tau.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"

static hs_status allocate(hs_multi_tau *tau, const hs_multi_tau_plan *plan, hs_error *err)
{
    const size_t n_values = (size_t)tau->n_values, n_lags = (size_t)tau->n_lags;
    HS_TRY(HS_ALLOC(tau->pair, (size_t)tau->n_pairs, err));
    HS_TRY(HS_ALLOC(tau->column, (size_t)tau->n_pairs, err));
    for (int p = 0; p < tau->n_pairs; ++p) {
        memcpy(tau->pair[p], plan->pair[p], sizeof *plan->pair);
        tau->column[p] = plan->column != NULL ? plan->column[p] : p;
        if (tau->column[p] >= tau->n_columns) tau->n_columns = tau->column[p] + 1;
    }
    const size_t n_sums = n_lags * (size_t)tau->n_columns;
    HS_TRY(HS_ALLOC(tau->level, (size_t)tau->n_levels, err));
    HS_TRY(HS_ALLOC(tau->block, 2 * n_sums, err));
    for (int l = 0; l < tau->n_levels; ++l) {
        hs_multi_tau_level *level = &tau->level[l];
        HS_TRY(HS_ALLOC(level->sample, 2 * n_lags * n_values, err));
        HS_TRY(HS_ALLOC(level->sum, n_sums, err));
        HS_TRY(HS_ALLOC(level->half, n_values, err));
        level->blocks.n_series = tau->has_errors ? (int)n_sums : 0;
    }
    return hs_correlator_create(&tau->correlator, tau->n_lags, err);
}

hs_status hs_multi_tau_init(hs_multi_tau *tau, const hs_multi_tau_plan *plan, hs_error *err)
{
    *tau = (hs_multi_tau){.n_values = plan->n_values,
                          .n_pairs = plan->n_pairs,
                          .n_lags = plan->n_lags,
                          .n_levels = plan->n_levels,
                          .has_errors = plan->has_errors};
    if ((int64_t)plan->n_lags * plan->n_pairs > INT32_MAX / 2 ||
        (int64_t)plan->n_lags + (plan->n_levels - 1) * ((int64_t)plan->n_lags / 2) > INT32_MAX)
        return hs_fail(err, HS_ERROR_INPUT, "%d lags of %d correlations on %d levels are too many", plan->n_lags,
                       plan->n_pairs, plan->n_levels);
    return allocate(tau, plan, err);
}

void hs_multi_tau_fini(hs_multi_tau *tau)
{
    for (int l = 0; l < tau->n_levels && tau->level != NULL; ++l) {
        HS_FREE(tau->level[l].sample);
        HS_FREE(tau->level[l].sum);
        HS_FREE(tau->level[l].half);
        hs_series_set_fini(&tau->level[l].blocks);
    }
    HS_FREE(tau->level);
    HS_FREE(tau->pair);
    HS_FREE(tau->column);
    HS_FREE(tau->block);
    hs_correlator_destroy(&tau->correlator);
}

/** sums[n_columns][n_lags] += products of the present block (what is there of it) with itself and the block before. */
static void add_products(const hs_multi_tau *tau, const hs_multi_tau_level *level, double *sums)
{
    const size_t n_lags = (size_t)tau->n_lags;
    for (int p = 0; p < tau->n_pairs; ++p)
        hs_correlator_add(tau->correlator, level->sample + 2 * n_lags * (size_t)tau->pair[p][0],
                          level->sample + 2 * n_lags * (size_t)tau->pair[p][1], sums + n_lags * (size_t)tau->column[p]);
}

/** The present block is full: it becomes the one before. */
static hs_status end_block(hs_multi_tau *tau, hs_multi_tau_level *level, hs_error *err)
{
    const size_t n_lags = (size_t)tau->n_lags, n_sums = n_lags * (size_t)tau->n_columns;
    const bool is_first = level->n_total == tau->n_lags; /* nothing was there before it */
    memset(tau->block, 0, n_sums * sizeof *tau->block);
    add_products(tau, level, tau->block);
    for (size_t k = 0; k < n_sums; ++k) {
        level->sum[k] += tau->block[k];
        tau->block[n_sums + k] = is_first ? (double)(n_lags - k % n_lags) : (double)n_lags;
    }
    HS_TRY(hs_series_set_add(&level->blocks, tau->block, tau->block + n_sums, err));
    for (int v = 0; v < tau->n_values; ++v) {
        double *sample = level->sample + 2 * n_lags * (size_t)v;
        memcpy(sample, sample + n_lags, n_lags * sizeof *sample);
        memset(sample + n_lags, 0, n_lags * sizeof *sample);
    }
    level->n_present = 0;
    return HS_OK;
}

static hs_status add_to_level(hs_multi_tau *tau, int l, const double *values, hs_error *err)
{
    hs_multi_tau_level *level = &tau->level[l];
    const size_t n_lags = (size_t)tau->n_lags;
    for (int v = 0; v < tau->n_values; ++v)
        level->sample[2 * n_lags * (size_t)v + n_lags + (size_t)level->n_present] = values[v];
    ++level->n_present;
    ++level->n_total;
    return level->n_present == tau->n_lags ? end_block(tau, level, err) : HS_OK;
}

hs_status hs_multi_tau_add(hs_multi_tau *tau, const double *values, hs_error *err)
{
    for (int l = 0;; ++l) {
        hs_multi_tau_level *level = &tau->level[l];
        HS_TRY(add_to_level(tau, l, values, err));
        if (l + 1 == tau->n_levels) return HS_OK;
        if (level->n_total % 2 == 1) {
            memcpy(level->half, values, (size_t)tau->n_values * sizeof *values);
            return HS_OK;
        }
        for (int v = 0; v < tau->n_values; ++v) level->half[v] = 0.5 * (level->half[v] + values[v]);
        values = level->half;
    }
}

/** Level and lag within the level of a row. */
static void place_of(const hs_multi_tau *tau, int row, int *level, int *lag)
{
    const int half = tau->n_lags / 2;
    *level = row < tau->n_lags ? 0 : 1 + (row - tau->n_lags) / half;
    *lag = *level == 0 ? row : half + (row - tau->n_lags) % half;
}

int64_t hs_multi_tau_lag(const hs_multi_tau *tau, int row)
{
    int level, lag;
    place_of(tau, row, &level, &lag);
    return (int64_t)lag << level;
}

/** Means, and errors from the blocks, of the rows of one level; sums are all its products so far. */
static void fill_level(const hs_multi_tau *tau, int l, const double *sums, double *count, double *value, double *error,
                       double *inefficiency)
{
    const hs_multi_tau_level *level = &tau->level[l];
    const int n_rows = hs_multi_tau_rows(tau);
    for (int row = 0; row < n_rows; ++row) {
        int of_row, lag;
        place_of(tau, row, &of_row, &lag);
        if (of_row != l) continue;
        count[row] = level->n_total > lag ? (double)(level->n_total - lag) : 0.0;
        for (int c = 0; c < tau->n_columns; ++c) {
            const int at = row * tau->n_columns + c, series = c * tau->n_lags + lag;
            value[at] = count[row] > 0.0 ? sums[series] / count[row] : 0.0;
            if (error == NULL) continue;
            const hs_estimate e = hs_series_set_estimate(&level->blocks, series);
            error[at] = e.n > 1 ? e.error : NAN;
            inefficiency[at] = e.n > 1 ? e.inefficiency : NAN;
        }
    }
}

void hs_multi_tau_result(hs_multi_tau *tau, double *count, double *value, double *error, double *inefficiency)
{
    const size_t n_sums = (size_t)tau->n_lags * (size_t)tau->n_columns;
    for (int l = 0; l < tau->n_levels; ++l) {
        const hs_multi_tau_level *level = &tau->level[l];
        memcpy(tau->block, level->sum, n_sums * sizeof *level->sum);
        if (level->n_present > 0) add_products(tau, level, tau->block);
        fill_level(tau, l, tau->block, count, value, tau->has_errors ? error : NULL, inefficiency);
    }
}
