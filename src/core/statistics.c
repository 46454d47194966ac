#include "core/statistics.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"

enum {
    BLOCKS_MIN = 8,       /**< fewer show an error that is itself hardly known */
    INDEPENDENT_MIN = 20, /**< independent values: fewer may hide correlations as long as the series */
};

static void add_to_level(hs_block_level *level, double value, double weight)
{
    const double before = value - level->mean, weight_before = weight - level->weight;
    const double step = value - level->last, weight_step = weight - level->last_weight;
    if (level->n > 0) {
        level->step2 += step * step;
        level->step_weight2 += weight_step * weight_step;
        level->step_cross += step * weight_step;
    }
    level->last = value;
    level->last_weight = weight;
    ++level->n;
    level->mean += before / (double)level->n;
    level->m2 += before * (value - level->mean);
    level->weight += weight_before / (double)level->n;
    level->weight2 += weight_before * (weight - level->weight);
    level->cross += before * (weight - level->weight);
}

/** Add a value to the level of single values and, where that completes blocks, to those above; level k is at level[k *
 *  stride]. Returns how many levels were reached. */
static int add_value(hs_block_level *level, size_t stride, int n_levels, double value, double weight)
{
    for (int k = 0; k < n_levels; ++k, level += stride) {
        const double before = level->last, weight_before = level->last_weight;
        add_to_level(level, value, weight);
        if (level->n % 2 != 0) return k + 1;
        value = 0.5 * (before + value);
        weight = 0.5 * (weight_before + weight);
    }
    return n_levels;
}

/** Square of the error of a ratio (all weights 1: of the mean), and on how many independent numbers it rests. */
typedef struct level_error {
    double squared, freedom;
} level_error;

static level_error error_of(const hs_block_level *level, double ratio)
{
    const double n = (double)level->n, w2 = level->weight * level->weight;
    const double m2 = level->m2 - 2.0 * ratio * level->cross + ratio * ratio * level->weight2;
    const double step2 = level->step2 - 2.0 * ratio * level->step_cross + ratio * ratio * level->step_weight2;
    const double independent = fmax(m2, 0.0) / (n * (n - 1.0) * w2); /* as if blocks were */
    if (level->n < BLOCKS_MIN) return (level_error){.squared = independent, .freedom = n - 1.0};
    const double squared = (3.0 * m2 / n - step2 / (n - 1.0)) / ((n - 3.0) * w2);
    /* that blocks detest each other is mostly chance when they are few: no less than half */
    return (level_error){.squared = fmax(squared, 0.5 * independent), .freedom = n / 2.5};
}

/** Factor that makes an interval of one standard error hold 68.3 %: expansion of Student's t for large nu, M.
 *  Abramowitz, I. A. Stegun, Handbook of Mathematical Functions (1964), 26.7.5 at x = 1; within 2 % for nu = 1, 0.1 %
 *  from 2 on. */
static double student(double nu) { return 1.0 + (0.5 + (0.25 + 0.0625 / nu) / nu) / nu; }

static hs_estimate estimate_of(const hs_block_level *level, size_t stride, int n_levels)
{
    hs_estimate estimate = {.inefficiency = 1.0, .block = 1};
    if (n_levels == 0 || level->n == 0) return estimate;
    estimate.n = level->n;
    const double ratio = level->weight != 0.0 ? level->mean / level->weight : 0.0, n = (double)estimate.n;
    const double m2 = level->m2 - 2.0 * ratio * level->cross + ratio * ratio * level->weight2;
    estimate.mean = ratio;
    if (estimate.n < 2) return estimate;
    estimate.variance = fmax(m2, 0.0) / ((n - 1.0) * level->weight * level->weight);
    if (!(estimate.variance > 0.0)) {
        estimate.is_converged = true;
        return estimate;
    }
    for (int k = 0; k < n_levels && (k == 0 || level->n >= BLOCKS_MIN); ++k, level += stride) {
        const double length = ldexp(1.0, k),
                     covered = length * (double)level->n / n; /* but for an incomplete last block */
        const level_error found = error_of(level, ratio);
        estimate.error = sqrt(found.squared * covered) * student(found.freedom);
        estimate.inefficiency = found.squared * covered * n / estimate.variance;
        estimate.block = (int64_t)length;
        if (length * length * length > 2.0 * n * estimate.inefficiency * estimate.inefficiency) break;
    }
    estimate.is_converged = n >= INDEPENDENT_MIN * estimate.inefficiency;
    return estimate;
}

void hs_series_add(hs_series *series, double value, double weight)
{
    ++series->n;
    add_value(series->level, 1, HS_BLOCK_LEVELS, value, weight);
}

hs_estimate hs_series_estimate(const hs_series *series) { return estimate_of(series->level, 1, HS_BLOCK_LEVELS); }

hs_status hs_series_set_reserve(hs_series_set *set, int n_levels, hs_error *err)
{
    const size_t n = (size_t)set->n_series;
    if (n_levels <= set->capacity) return HS_OK;
    HS_TRY(HS_GROW(set->level, n * (size_t)set->capacity, n * (size_t)n_levels, err));
    set->capacity = n_levels;
    return HS_OK;
}

hs_status hs_series_set_add(hs_series_set *set, const double *values, const double *weights, hs_error *err)
{
    const size_t n = (size_t)set->n_series;
    int n_reached = 0;
    if (n == 0) return HS_OK;
    /* a value can complete blocks of one level more than there were */
    HS_TRY(hs_series_set_reserve(set, set->n_levels + 1, err));
    for (size_t i = 0; i < n; ++i)
        n_reached = add_value(set->level + i, n, set->capacity, values[i], weights != NULL ? weights[i] : 1.0);
    if (n_reached > set->n_levels) set->n_levels = n_reached;
    return HS_OK;
}

hs_estimate hs_series_set_estimate(const hs_series_set *set, int k)
{
    return estimate_of(set->level + k, (size_t)set->n_series, set->n_levels);
}

void hs_series_set_clear(hs_series_set *set)
{
    set->n_levels = 0;
    if (set->level != NULL) memset(set->level, 0, (size_t)set->n_series * (size_t)set->capacity * sizeof *set->level);
}

void hs_series_set_fini(hs_series_set *set)
{
    HS_FREE(set->level);
    set->n_levels = set->capacity = 0;
}

void hs_line_add(hs_line *line, double x, double y)
{
    ++line->n;
    const double n = (double)line->n, dx = x - line->mean_x, dy = y - line->mean_y;
    line->mean_x += dx / n;
    line->mean_y += dy / n;
    line->sxx += dx * (x - line->mean_x);
    line->sxy += dx * (y - line->mean_y);
    line->syy += dy * (y - line->mean_y);
}

void hs_line_slope(const hs_line *line, double *slope, double *error)
{
    *slope = *error = 0.0;
    if (line->n < 3 || !(line->sxx > 0.0)) return;
    *slope = line->sxy / line->sxx;
    const double rest = line->syy - *slope * line->sxy;
    *error = rest > 0.0 ? sqrt(rest / ((double)(line->n - 2) * line->sxx)) : 0.0;
}
