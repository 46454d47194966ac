/* Standard errors of averages: keyword error of the averaging fixes. */
#include <math.h>

#include "base/memory.h"
#include "io/average.h"

hs_status hs_fold_check_errors(const hs_fold *fold, const hs_schedule *schedule, const char *command, hs_error *err)
{
    if (!fold->has_errors) return HS_OK;
    if (fold->mode == HS_FOLD_ONE && schedule->repeat < 2)
        return hs_fail(err, HS_ERROR_INPUT,
                       "%s: with 'ave one' a mean of one sample (Nrepeat) shows no error; 'error yes' goes with 'ave "
                       "running', or with more samples",
                       command);
    if (fold->mode == HS_FOLD_WINDOW && fold->n_window < 2)
        return hs_fail(err, HS_ERROR_INPUT,
                       "%s: with 'ave window 1' the errors that 'error yes' asks for would be those of one value; two "
                       "windows or more show one",
                       command);
    return HS_OK;
}

hs_status hs_fold_reserve_errors(hs_fold *fold, int n, hs_error *err)
{
    hs_series_set_fini(&fold->samples);
    fold->samples.n_series = n;
    HS_TRY(HS_GROW(fold->error, 0, (size_t)n, err));
    return HS_GROW(fold->inefficiency, 0, (size_t)n, err);
}

hs_status hs_fold_add_sample(hs_fold *fold, const double *values, const double *weights, hs_error *err)
{
    if (!fold->has_errors || fold->mode == HS_FOLD_WINDOW) return HS_OK;
    return hs_series_set_add(&fold->samples, values, weights, err);
}

/** Estimate from the windows of the ring. */
static hs_estimate estimate_of_windows(const hs_fold *fold, int k)
{
    hs_series series = {0};
    const int64_t n = fold->n_added < fold->n_window ? fold->n_added : fold->n_window;
    for (int64_t w = fold->n_added - n; w < fold->n_added; ++w) {
        const double *window = fold->ring + (size_t)(w % fold->n_window) * (size_t)fold->n;
        hs_series_add(&series, window[k], fold->is_share ? window[0] : 1.0);
    }
    return hs_series_estimate(&series);
}

void hs_fold_find_errors(hs_fold *fold)
{
    for (int k = 0; k < fold->n && fold->has_errors; ++k) {
        const hs_estimate e =
            fold->mode == HS_FOLD_WINDOW ? estimate_of_windows(fold, k) : hs_series_set_estimate(&fold->samples, k);
        fold->error[k] = e.n < 2 ? NAN : e.error;
        fold->inefficiency[k] = e.n < 2 ? NAN : e.inefficiency;
    }
    if (fold->mode == HS_FOLD_ONE) hs_series_set_clear(&fold->samples);
}

enum { LEVEL_NUMBERS = 11 }; /* of an hs_block_level */

static void pack_level(const hs_block_level *level, double *out)
{
    const double values[LEVEL_NUMBERS] = {(double)level->n, level->mean,         level->m2,        level->weight,
                                          level->weight2,   level->cross,        level->last,      level->last_weight,
                                          level->step2,     level->step_weight2, level->step_cross};
    for (int k = 0; k < LEVEL_NUMBERS; ++k) out[k] = values[k];
}

static hs_block_level unpack_level(const double *in)
{
    return (hs_block_level){.n = (int64_t)in[0],
                            .mean = in[1],
                            .m2 = in[2],
                            .weight = in[3],
                            .weight2 = in[4],
                            .cross = in[5],
                            .last = in[6],
                            .last_weight = in[7],
                            .step2 = in[8],
                            .step_weight2 = in[9],
                            .step_cross = in[10]};
}

hs_status hs_series_set_keep(hs_series_set *set, hs_state *state, const char *name, hs_error *err)
{
    double *packed = NULL;
    const int64_t n_level = (int64_t)set->n_series * LEVEL_NUMBERS;
    int64_t n = set->n_levels * n_level;
    if (n_level == 0) return HS_OK;
    HS_TRY(HS_ALLOC(packed, (size_t)n + 1, err));
    for (int64_t i = 0; i < n / LEVEL_NUMBERS && !state->is_reading; ++i)
        pack_level(&set->level[i], packed + i * LEVEL_NUMBERS);
    hs_status status = hs_state_doubles(state, name, &packed, &n, err);
    if (status == HS_OK && state->is_reading && n % n_level != 0)
        status = hs_fail(err, HS_ERROR_INPUT, "the value '%s' has %lld elements, which make no whole blocks", name,
                         (long long)n);
    if (status == HS_OK && state->is_reading) {
        hs_series_set_clear(set);
        status = hs_series_set_reserve(set, (int)(n / n_level), err);
        for (int64_t i = 0; i < n / LEVEL_NUMBERS && status == HS_OK; ++i)
            set->level[i] = unpack_level(packed + i * LEVEL_NUMBERS);
        if (status == HS_OK) set->n_levels = (int)(n / n_level);
    }
    HS_FREE(packed);
    return status;
}

hs_status hs_fold_keep_errors(hs_fold *fold, hs_state *state, hs_error *err)
{
    if (!fold->has_errors) return HS_OK;
    HS_TRY(hs_state_double(state, "errors", fold->error, fold->n, err));
    HS_TRY(hs_state_double(state, "inefficiencies", fold->inefficiency, fold->n, err));
    return hs_series_set_keep(&fold->samples, state, "samples", err);
}

hs_status hs_average_error_head(hs_text *head, int n, hs_name_of name, const void *context, hs_error *err)
{
    static const char *const suffixes[] = {"_err", "_ineff"};
    for (int s = 0; s < 2; ++s)
        for (int k = 0; k < n; ++k) HS_TRY(hs_text_printf(head, err, " %s%s", name(context, k), suffixes[s]));
    return HS_OK;
}

void hs_average_say_head(hs_sink *out, const char *title)
{
    hs_say(out, "\n%s\n%-16s %15s %12s %14s\n", title, "Column", "Mean", "Error", "Inefficiency");
}

void hs_average_say_row(hs_sink *out, const char *name, const hs_estimate *estimate)
{
    hs_say(out, "%-16s %15.8g %12.3g %14.3g%s\n", name, estimate->mean, estimate->error, estimate->inefficiency,
           estimate->is_converged ? "" : " *");
}

void hs_average_say_foot(hs_sink *out, bool is_uncertain)
{
    if (is_uncertain) hs_say(out, "* fewer than 20 independent values: the error may be too small\n");
}
