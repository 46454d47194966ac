/* Time correlations of numbers: C_ij(t) = <V_i(s) V_j(s + t)> over all s. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "io/correlation.h"

typedef struct correlate_state {
    hs_correlation table; /**< first, as io/correlation.h wants it */
    int n_lags;
    bool is_running;
    double *sample;         /**< owned [n_lags][n_values]: a ring of the last samples */
    int last;               /**< place of the latest in the ring */
    int n_samples;          /**< in the ring */
    double *sum;            /**< owned [n_lags][n_pairs]: since the last output, or the start */
    double *count;          /**< owned [n_lags] */
    hs_series_set products; /**< of [n_lags][n_pairs], with keyword error */
    double *product;        /**< owned [2][n_lags][n_pairs]: of the latest sample, and whether there was one */
} correlate_state;

static const hs_keyword keywords[] = {
    HS_CORRELATION_KEYWORDS,
    {"ave", 1, "one|running", "start anew after each output, or go on (default: one)"},
    {NULL, 0, NULL, NULL},
};

static hs_status read_keywords(hs_fix *fix, const hs_args *args, hs_error *err)
{
    static const char *const modes[] = {"one", "running", NULL};
    correlate_state *state = fix->state;
    int mode = 0;
    for (int i = hs_syntax_first_keyword(&fix->style->about.syntax, args), n_used; i < args->n; i += n_used) {
        HS_TRY(hs_correlation_keyword(fix, args, i, &n_used, err));
        if (n_used > 0) continue;
        n_used = 2;
        HS_TRY(hs_arg_choice(args, i + 1, modes, &mode, err));
    }
    state->is_running = mode == 1;
    if (!state->is_running && state->table.freq < (state->n_lags - 1) * state->table.every)
        return hs_fail(err, HS_ERROR_INPUT,
                       "%s: with ave one, %d lags of %lld steps do not fit into the %lld steps (Nfreq) between "
                       "outputs; 'ave running' goes on over them",
                       args->command, state->n_lags, (long long)state->table.every, (long long)state->table.freq);
    return HS_OK;
}

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    correlate_state *state = fix->state;
    hs_correlation *table = &state->table;
    int64_t n_lags;
    HS_TRY(hs_correlation_numbers(fix, args, 1, 100000000, &n_lags, err));
    HS_TRY(hs_correlation_values(fix, args, err));
    state->n_lags = (int)n_lags;
    HS_TRY(read_keywords(fix, args, err));
    HS_TRY(hs_correlation_pair(fix, args, err));
    HS_TRY(hs_correlation_table(fix, state->n_lags, "TimeDelta", hs_correlation_product, err));
    for (int lag = 0; lag < state->n_lags; ++lag) table->x[lag] = (double)(lag * table->every);
    const size_t n = (size_t)n_lags, n_sums = n * (size_t)table->n_pairs;
    HS_TRY(HS_ALLOC(state->sample, n * (size_t)table->n_values, err));
    HS_TRY(HS_ALLOC(state->sum, n_sums, err));
    HS_TRY(HS_ALLOC(state->count, n, err));
    if (table->has_errors) HS_TRY(HS_ALLOC(state->product, 2 * n_sums, err));
    state->products.n_series = table->has_errors ? (int)n_sums : 0;
    state->last = -1;
    return HS_OK;
}

static void destroy(hs_fix *fix)
{
    correlate_state *state = fix->state;
    HS_FREE(state->sample);
    HS_FREE(state->sum);
    HS_FREE(state->count);
    HS_FREE(state->product);
    hs_series_set_fini(&state->products);
    hs_correlation_fini(&state->table);
}

static hs_status init(hs_fix *fix, hs_error *err)
{
    return hs_correlation_init(fix, "Time-correlated data", "time-windows", err);
}

/** Products of the latest sample with each of the ring. */
static hs_status accumulate(correlate_state *state, hs_error *err)
{
    const hs_correlation *table = &state->table;
    const size_t n_values = (size_t)table->n_values, n_pairs = (size_t)table->n_pairs;
    const size_t n_sums = (size_t)state->n_lags * n_pairs;
    const double *new = state->sample + (size_t)state->last *n_values;
    int at = state->last;
    if (table->has_errors) memset(state->product, 0, 2 * n_sums * sizeof *state->product);
    for (int lag = 0; lag < state->n_samples; ++lag) {
        const double *old = state->sample + (size_t)at * n_values;
        for (size_t p = 0; p < n_pairs; ++p) {
            const size_t k = (size_t)lag * n_pairs + p;
            const double product = old[table->pair[p][0]] * new[table->pair[p][1]];
            state->sum[k] += product;
            if (!table->has_errors) continue;
            state->product[k] = product;
            state->product[n_sums + k] = 1.0;
        }
        state->count[lag] += 1.0;
        at = at > 0 ? at - 1 : state->n_lags - 1;
    }
    if (!table->has_errors) return HS_OK;
    return hs_series_set_add(&state->products, state->product, state->product + n_sums, err);
}

/** Keep the present correlations as the result and, with ave one, start anew with the latest sample. */
static hs_status finish(hs_fix *fix, hs_error *err)
{
    correlate_state *state = fix->state;
    hs_correlation *table = &state->table;
    const int n_pairs = table->n_pairs;
    for (int lag = 0; lag < state->n_lags; ++lag) {
        double *row = table->result + (size_t)lag * (size_t)table->n_columns;
        const double count = table->count[lag] = state->count[lag];
        for (int p = 0; p < n_pairs; ++p) {
            const size_t k = (size_t)lag * (size_t)n_pairs + (size_t)p;
            row[p] = count > 0.0 ? state->sum[k] / count : 0.0;
            if (!table->has_errors) continue;
            const hs_estimate e = hs_series_set_estimate(&state->products, (int)k);
            row[n_pairs + p] = count > 1.0 ? e.error : NAN;
            row[2 * n_pairs + p] = count > 1.0 ? e.inefficiency : NAN;
        }
    }
    HS_TRY(hs_correlation_finish(fix, err));
    if (state->is_running) return HS_OK;
    memset(state->sum, 0, (size_t)state->n_lags * (size_t)n_pairs * sizeof *state->sum);
    memset(state->count, 0, (size_t)state->n_lags * sizeof *state->count);
    hs_series_set_clear(&state->products);
    state->n_samples = 1;
    return accumulate(state, err);
}

static hs_status end_of_step(hs_fix *fix, hs_error *err)
{
    correlate_state *state = fix->state;
    const int next = (state->last + 1) % state->n_lags;
    bool is_due;
    HS_TRY(hs_correlation_sample(fix, state->sample + (size_t)next * (size_t)state->table.n_values, &is_due, err));
    if (!is_due) return HS_OK;
    state->last = next;
    if (state->n_samples < state->n_lags) ++state->n_samples;
    HS_TRY(accumulate(state, err));
    return hs_correlation_is_output_due(fix) ? finish(fix, err) : HS_OK;
}

static hs_status keep_state(hs_fix *fix, hs_state *kept, hs_error *err)
{
    correlate_state *state = fix->state;
    const int64_t n = state->n_lags;
    HS_TRY(hs_state_int(kept, "last", &state->last, err));
    HS_TRY(hs_state_int(kept, "n_samples", &state->n_samples, err));
    HS_TRY(hs_state_double(kept, "sample", state->sample, n * state->table.n_values, err));
    HS_TRY(hs_state_double(kept, "sum", state->sum, n * state->table.n_pairs, err));
    HS_TRY(hs_state_double(kept, "count", state->count, n, err));
    HS_TRY(hs_series_set_keep(&state->products, kept, "products", err));
    return hs_correlation_keep(fix, kept, err);
}

const hs_fix_style hs_fix_style_ave_correlate = {
    .about =
        {.name = "ave/correlate",
         .syntax = {.usage = "<Nevery> <Nrepeat> <Nfreq> <value> ... [keyword value ...]",
                    .n_min = 4,
                    .n_max = -1,
                    .keywords = keywords},
         .summary = "time correlations of numbers",
         .details = "Values are numbers: `c_ID`, `c_ID[i]`, `f_ID`, `f_ID[i]`, `v_name`, ranges as in `c_ID[*]`. They "
                    "are sampled every Nevery steps, and products V_i(s) V_j(s + t) of samples up to Nrepeat - 1 "
                    "samples apart are averaged over all s. Results come every Nfreq steps. With `ave one` averages "
                    "start anew then; with `ave running` they go on.\n\n"
                    "`f_ID[i][j]` is an array of Nrepeat rows: the time t in steps, the number of samples, and one "
                    "column for each pair of values: each value with itself (`type auto`), those with i < j (`upper`), "
                    "i > j (`lower`), both kinds, or all (`full`). `trap(f_ID[3])` in a formula integrates the first "
                    "of them. A sample costs Nrepeat products for each pair. The group has no meaning.\n\n"
                    "With `error yes` a column for each pair follows with the standard error of its mean product, by "
                    "blocking, and then one with the statistical inefficiency, the number of products that count as "
                    "one; `nan` where there is but one product. Errors of neighboring lags are not independent: for "
                    "the error of an integral, integrate each of several outputs (`ave one`) and average the integrals "
                    "with `fix ave/time ... error yes`.",
         .reference = "R. Kubo, J. Phys. Soc. Jpn. 12, 570 (1957), doi:10.1143/JPSJ.12.570",
         .example =
             "variable pxy equal pxy\nfix SS all ave/correlate 5 400 2000 v_pxy type auto file profile.gk ave running"},
    .state_size = sizeof(correlate_state),
    HS_CORRELATION_HOOKS,
};
