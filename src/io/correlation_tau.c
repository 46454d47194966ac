/* Correlations by core/multi_tau.h: what its fixes share. */
#include <stdio.h>

#include "base/memory.h"
#include "io/correlation.h"

hs_status hs_correlation_tau_keywords(hs_fix *fix, hs_correlation_tau *t, const hs_args *args, int64_t n_lags,
                                      hs_error *err)
{
    t->n_levels = 1;
    ((hs_correlation *)fix->state)->file.overwrite = true;
    for (int i = hs_syntax_first_keyword(&fix->style->about.syntax, args), n_used; i < args->n; i += n_used) {
        HS_TRY(hs_correlation_keyword(fix, args, i, &n_used, err));
        if (n_used > 0) continue;
        n_used = 2;
        HS_TRY(hs_arg_int(args, i + 1, 1, 40, &t->n_levels, err));
    }
    if (t->n_levels == 1 || n_lags % 2 == 0) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT,
                   "%s: the number of lags (Nlags) must be even for 'levels %lld': each level goes on from the middle "
                   "of its own; %lld is not",
                   args->command, (long long)t->n_levels, (long long)n_lags);
}

hs_status hs_correlation_tau_create(hs_fix *fix, hs_correlation_tau *t, hs_correlation_name name, hs_error *err)
{
    hs_correlation *table = fix->state;
    const int n_rows = hs_multi_tau_rows(&t->tau);
    HS_TRY(hs_correlation_table(fix, n_rows, "TimeDelta", name, err));
    for (int row = 0; row < n_rows; ++row) table->x[row] = (double)(hs_multi_tau_lag(&t->tau, row) * table->every);
    HS_TRY(HS_ALLOC(t->means, 3 * (size_t)n_rows * (size_t)table->n_pairs, err));
    return HS_ALLOC(t->sample, (size_t)t->tau.n_values, err);
}

hs_status hs_correlation_tau_of_pairs(hs_fix *fix, hs_correlation_tau *t, int n_lags, hs_error *err)
{
    const hs_correlation *c = fix->state;
    const hs_multi_tau_plan plan = {.n_values = c->n_values,
                                    .n_pairs = c->n_pairs,
                                    .pair = c->pair,
                                    .n_lags = n_lags,
                                    .n_levels = (int)t->n_levels,
                                    .has_errors = c->has_errors};
    HS_TRY(hs_multi_tau_init(&t->tau, &plan, err));
    return hs_correlation_tau_create(fix, t, hs_correlation_product, err);
}

void hs_correlation_tau_fini(hs_correlation_tau *t)
{
    hs_multi_tau_fini(&t->tau);
    HS_FREE(t->means);
    HS_FREE(t->sample);
}

void hs_correlation_tau_take(hs_fix *fix, hs_correlation_tau *t)
{
    hs_correlation *table = fix->state;
    const size_t n_pairs = (size_t)table->n_pairs, n = (size_t)table->n_rows * n_pairs;
    hs_multi_tau_result(&t->tau, table->count, t->means, t->means + n, t->means + 2 * n);
    for (size_t row = 0; row < (size_t)table->n_rows; ++row)
        for (size_t k = 0; k < (size_t)table->n_columns; ++k)
            table->result[row * (size_t)table->n_columns + k] = t->means[k / n_pairs * n + row * n_pairs + k % n_pairs];
}

hs_status hs_correlation_tau_sample(hs_fix *fix, hs_correlation_tau *t, bool *is_due, hs_error *err)
{
    HS_TRY(hs_correlation_sample(fix, t->sample, is_due, err));
    if (!*is_due) return HS_OK;
    HS_TRY(hs_multi_tau_add(&t->tau, t->sample, err));
    *is_due = hs_correlation_is_output_due(fix);
    if (*is_due) hs_correlation_tau_take(fix, t);
    return HS_OK;
}

/** The name in a checkpoint of what a level has. */
static const char *name_of(char name[64], int level, const char *what)
{
    snprintf(name, 64, "level %d: %s", level, what);
    return name;
}

hs_status hs_correlation_tau_keep(hs_fix *fix, hs_correlation_tau *t, hs_state *kept, hs_error *err)
{
    hs_multi_tau *tau = &t->tau;
    const int64_t n_lags = tau->n_lags, n_values = tau->n_values, n_columns = tau->n_columns;
    char name[64];
    for (int l = 0; l < tau->n_levels; ++l) {
        hs_multi_tau_level *level = &tau->level[l];
        HS_TRY(hs_state_int(kept, name_of(name, l, "samples of the block"), &level->n_present, err));
        HS_TRY(hs_state_int64(kept, name_of(name, l, "samples"), &level->n_total, 1, err));
        HS_TRY(hs_state_double(kept, name_of(name, l, "blocks"), level->sample, 2 * n_lags * n_values, err));
        HS_TRY(hs_state_double(kept, name_of(name, l, "half"), level->half, n_values, err));
        HS_TRY(hs_state_double(kept, name_of(name, l, "sums"), level->sum, n_lags * n_columns, err));
        HS_TRY(hs_series_set_keep(&level->blocks, kept, name_of(name, l, "errors"), err));
    }
    return hs_correlation_keep(fix, kept, err);
}
