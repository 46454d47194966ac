#include "core/statistics.h"

#include <math.h>

static void add_to_level(hs_block_level *level, double value)
{
    const double before = value - level->mean;
    ++level->n;
    level->mean += before / (double)level->n;
    level->m2 += before * (value - level->mean);
}

void hs_series_add(hs_series *series, double value)
{
    ++series->n;
    for (int k = 0; k < HS_BLOCK_LEVELS; ++k) {
        hs_block_level *level = &series->level[k];
        add_to_level(level, value);
        level->has_half = !level->has_half;
        if (level->has_half) {
            level->half = value;
            return;
        }
        value = 0.5 * (level->half + value);
    }
}

/** Square of the standard error that the blocks of a level show. */
static double error2_of(const hs_block_level *level) { return level->m2 / ((double)level->n * (double)(level->n - 1)); }

hs_estimate hs_series_estimate(const hs_series *series)
{
    hs_estimate estimate = {.n = series->n, .mean = series->level[0].mean, .inefficiency = 1.0, .block = 1};
    if (series->n < 2) return estimate;
    const double single2 = error2_of(&series->level[0]), n = (double)series->n;
    estimate.variance = series->level[0].m2 / (n - 1.0);
    estimate.error = sqrt(single2);
    if (!(single2 > 0.0)) {
        estimate.is_converged = true;
        return estimate;
    }
    for (int k = 0; k < HS_BLOCK_LEVELS && series->level[k].n >= 2; ++k) {
        const double length = ldexp(1.0, k), inefficiency = error2_of(&series->level[k]) / single2;
        estimate.error = sqrt(error2_of(&series->level[k]));
        estimate.inefficiency = inefficiency;
        estimate.block = (int64_t)length;
        estimate.is_converged = length * length * length > 2.0 * n * inefficiency * inefficiency;
        if (estimate.is_converged) break;
    }
    return estimate;
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
