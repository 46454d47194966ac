/* Time correlations of numbers: C_ij(t) = <V_i(s) V_j(s + t)> over all s. */
#include <string.h>

#include "base/memory.h"
#include "io/average.h"
#include "style/value.h"

/** Which pairs of values are correlated. */
typedef enum { PAIRS_AUTO, PAIRS_UPPER, PAIRS_LOWER, PAIRS_AUTO_UPPER, PAIRS_AUTO_LOWER, PAIRS_FULL } pair_type;
static const char *const pair_types[] = {"auto", "upper", "lower", "auto/upper", "auto/lower", "full", NULL};

typedef struct correlate_state {
    int64_t every, freq, next; /**< next: step of the next sample */
    int n_lags;
    hs_schedule schedule; /**< keyword start only */
    hs_value *values;     /**< owned [n_values] */
    int n_values;
    int type;
    int (*pair)[2]; /**< owned [n_pairs] */
    int n_pairs;
    bool is_running;
    double prefactor;
    double *sample;       /**< owned [n_lags][n_values]: a ring of the last samples */
    int last;             /**< place of the latest in the ring */
    int n_samples;        /**< in the ring */
    double *sum;          /**< owned [n_lags][n_pairs]: since the last output, or the start */
    double *count;        /**< owned [n_lags] */
    double *result;       /**< owned [n_lags][n_pairs]: of the last output */
    double *result_count; /**< owned [n_lags] */
    hs_average_file file;
    char *head; /**< owned */
} correlate_state;

static const hs_keyword keywords[] = {
    {"type", 1, "auto|upper|lower|auto/upper|auto/lower|full",
     "each value with itself, pairs i < j, pairs i > j, both kinds, or all (default: auto)"},
    {"ave", 1, "one|running", "start anew after each output, or go on (default: one)"},
    {"start", 1, "<step>", "no sample before this step (default: 0)"},
    {"prefactor", 1, "<number>", "correlations are multiplied by it (default: 1)"},
    {"file", 1, "<name>", "write correlations to this file"},
    {"append", 1, "<name>", "the same, added to what is there"},
    {"overwrite", 0, "", "the file holds the last output only"},
    {"title1", 1, "<text>", "first line of the file"},
    {"title2", 1, "<text>", "second line"},
    {"title3", 1, "<text>", "third line"},
    {NULL, 0, NULL, NULL},
};

static bool is_wanted(int type, int i, int j)
{
    switch ((pair_type)type) {
    case PAIRS_AUTO:
        return i == j;
    case PAIRS_UPPER:
        return i < j;
    case PAIRS_LOWER:
        return i > j;
    case PAIRS_AUTO_UPPER:
        return i <= j;
    case PAIRS_AUTO_LOWER:
        return i >= j;
    default:
        return true;
    }
}

static hs_status read_keywords(correlate_state *state, const hs_args *args, int first, hs_error *err)
{
    static const char *const modes[] = {"one", "running", NULL};
    int mode = 0;
    state->prefactor = 1.0;
    for (int i = first, n_used; i < args->n; i += n_used) {
        HS_TRY(hs_average_keyword(&state->schedule, NULL, &state->file, args, i, &n_used, err));
        if (n_used > 0) continue;
        n_used = 2;
        if (strcmp(args->word[i], "type") == 0) HS_TRY(hs_arg_choice(args, i + 1, pair_types, &state->type, err));
        if (strcmp(args->word[i], "ave") == 0) HS_TRY(hs_arg_choice(args, i + 1, modes, &mode, err));
        if (strcmp(args->word[i], "prefactor") == 0) HS_TRY(hs_arg_double(args, i + 1, &state->prefactor, err));
    }
    state->is_running = mode == 1;
    return HS_OK;
}

static hs_status check_numbers(const correlate_state *state, const hs_args *args, hs_error *err)
{
    if (state->freq % state->every != 0)
        return hs_fail(
            err, HS_ERROR_INPUT,
            "%s: output comes every %lld steps (Nfreq), which must be a multiple of the %lld steps between samples "
            "(Nevery)",
            args->command, (long long)state->freq, (long long)state->every);
    if (!state->is_running && state->freq < (state->n_lags - 1) * state->every)
        return hs_fail(
            err, HS_ERROR_INPUT,
            "%s: with ave one, %d lags of %lld steps do not fit into the %lld steps (Nfreq) between outputs; 'ave "
            "running' goes on over them",
            args->command, state->n_lags, (long long)state->every, (long long)state->freq);
    return HS_OK;
}

static hs_status make_pairs(correlate_state *state, hs_error *err)
{
    hs_text head = {0};
    HS_TRY(HS_ALLOC(state->pair, (size_t)state->n_values * (size_t)state->n_values, err));
    hs_status status = hs_text_printf(&head, err, "# Index TimeDelta Ncount");
    for (int i = 0; i < state->n_values; ++i)
        for (int j = 0; j < state->n_values && status == HS_OK; ++j) {
            if (!is_wanted(state->type, i, j)) continue;
            state->pair[state->n_pairs][0] = i;
            state->pair[state->n_pairs++][1] = j;
            status = hs_text_printf(&head, err, " %s*%s", state->values[i].word, state->values[j].word);
        }
    if (status == HS_OK) status = hs_memory_strdup(&state->head, hs_text_get(&head), err);
    hs_text_fini(&head);
    return status;
}

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    correlate_state *state = fix->state;
    int64_t n_lags;
    const int first = hs_syntax_first_keyword(&fix->style->about.syntax, args);
    HS_TRY(hs_arg_int(args, 0, 1, INT32_MAX, &state->every, err));
    HS_TRY(hs_arg_int(args, 1, 1, 100000000, &n_lags, err));
    HS_TRY(hs_arg_int(args, 2, 1, INT64_MAX / 4, &state->freq, err));
    state->n_lags = (int)n_lags;
    HS_TRY(hs_values_create(&state->values, &state->n_values, fix->env, args, 3, first - 3, HS_VALUE_NUMBER, err));
    HS_TRY(read_keywords(state, args, first, err));
    HS_TRY(check_numbers(state, args, err));
    HS_TRY(make_pairs(state, err));
    if (state->n_pairs == 0)
        return hs_fail(err, HS_ERROR_INPUT,
                       "%s: one value has no pairs of type %s; 'type auto' correlates it with itself", args->command,
                       pair_types[state->type]);
    const size_t n = (size_t)state->n_lags, n_pairs = (size_t)state->n_pairs;
    HS_TRY(HS_ALLOC(state->sample, n * (size_t)state->n_values, err));
    HS_TRY(HS_ALLOC(state->sum, n * n_pairs, err));
    HS_TRY(HS_ALLOC(state->result, n * n_pairs, err));
    HS_TRY(HS_ALLOC(state->count, n, err));
    HS_TRY(HS_ALLOC(state->result_count, n, err));
    state->last = -1;
    const int64_t begin = state->schedule.start > fix->env->step ? state->schedule.start : fix->env->step;
    state->next = (begin + state->every - 1) / state->every * state->every;
    fix->n_rows = state->n_lags;
    fix->n_columns = state->n_pairs + 2;
    return HS_OK;
}

static void destroy(hs_fix *fix)
{
    correlate_state *state = fix->state;
    hs_values_destroy(&state->values, state->n_values);
    HS_FREE(state->pair);
    HS_FREE(state->sample);
    HS_FREE(state->sum);
    HS_FREE(state->count);
    HS_FREE(state->result);
    HS_FREE(state->result_count);
    HS_FREE(state->head);
    hs_average_file_fini(&state->file);
}

static hs_status init(hs_fix *fix, hs_error *err)
{
    correlate_state *state = fix->state;
    char command[128], title[160];
    snprintf(command, sizeof command, "fix '%.80s' (ave/correlate)", fix->id);
    for (int k = 0; k < state->n_values; ++k)
        HS_TRY(hs_value_check(fix->env, &state->values[k], HS_VALUE_NUMBER, command, err));
    snprintf(title, sizeof title, "# Time-correlated data for fix %.100s", fix->id);
    const char *const head[3] = {title, "# Timestep Number-of-time-windows", state->head};
    return hs_average_file_open(&state->file, fix->env, head, err);
}

static bool needs_energy(const hs_fix *fix, int64_t step)
{
    const correlate_state *state = fix->state;
    bool is_needed = false;
    if (step != state->next) return false;
    for (int k = 0; k < state->n_values; ++k) is_needed |= hs_value_needs_energy(fix->env, &state->values[k]);
    return is_needed;
}

/** Products of the latest sample with each of the ring. */
static void accumulate(correlate_state *state)
{
    const double *new = state->sample + (size_t)state->last *(size_t)state->n_values;
    int at = state->last;
    for (int lag = 0; lag < state->n_samples; ++lag) {
        const double *old = state->sample + (size_t)at * (size_t)state->n_values;
        double *sum = state->sum + (size_t)lag * (size_t)state->n_pairs;
        for (int p = 0; p < state->n_pairs; ++p) sum[p] += old[state->pair[p][0]] * new[state->pair[p][1]];
        state->count[lag] += 1.0;
        at = at > 0 ? at - 1 : state->n_lags - 1;
    }
}

static hs_status write_output(hs_fix *fix, hs_error *err)
{
    correlate_state *state = fix->state;
    hs_average_file *file = &state->file;
    if (hs_average_file_is_open(file)) {
        HS_TRY(hs_text_printf(&file->text, err, "%lld %d\n", (long long)fix->env->step, state->n_lags));
        for (int lag = 0; lag < state->n_lags; ++lag) {
            HS_TRY(hs_text_printf(&file->text, err, "%d %lld %.0f", lag + 1, (long long)(lag * state->every),
                                  state->result_count[lag]));
            for (int p = 0; p < state->n_pairs; ++p) {
                /* as in LAMMPS, a lag without samples is 0.0 */
                if (state->result_count[lag] > 0.0)
                    HS_TRY(hs_average_file_number(file, state->result[(size_t)lag * (size_t)state->n_pairs + (size_t)p],
                                                  err));
                else
                    HS_TRY(hs_text_append(&file->text, " 0.0", 4, err));
            }
            HS_TRY(hs_text_append(&file->text, "\n", 1, err));
        }
    }
    return hs_average_file_commit(file, fix->env, err);
}

/** Keep the present correlations as the result and, with ave one, start anew with the latest sample. */
static hs_status finish(hs_fix *fix, hs_error *err)
{
    correlate_state *state = fix->state;
    const size_t n = (size_t)state->n_lags, n_pairs = (size_t)state->n_pairs;
    for (size_t lag = 0; lag < n; ++lag) {
        state->result_count[lag] = state->count[lag];
        for (size_t p = 0; p < n_pairs; ++p)
            state->result[lag * n_pairs + p] =
                state->count[lag] > 0.0 ? state->prefactor * state->sum[lag * n_pairs + p] / state->count[lag] : 0.0;
    }
    HS_TRY(write_output(fix, err));
    if (state->is_running) return HS_OK;
    memset(state->sum, 0, n * n_pairs * sizeof *state->sum);
    memset(state->count, 0, n * sizeof *state->count);
    state->n_samples = 1;
    accumulate(state);
    return HS_OK;
}

static hs_status end_of_step(hs_fix *fix, hs_error *err)
{
    correlate_state *state = fix->state;
    if (fix->env->step != state->next) return HS_OK;
    state->last = (state->last + 1) % state->n_lags;
    if (state->n_samples < state->n_lags) ++state->n_samples;
    for (int k = 0; k < state->n_values; ++k)
        HS_TRY(hs_value_number(fix->env, &state->values[k],
                               &state->sample[(size_t)state->last * (size_t)state->n_values + (size_t)k], err));
    accumulate(state);
    state->next += state->every;
    return fix->env->step % state->freq == 0 ? finish(fix, err) : HS_OK;
}

static hs_status array(hs_fix *fix, int i, int j, double *value, hs_error *err)
{
    const correlate_state *state = fix->state;
    (void)err;
    *value = j == 0   ? (double)(i * state->every)
             : j == 1 ? state->result_count[i]
                      : state->result[(size_t)i * (size_t)state->n_pairs + (size_t)(j - 2)];
    return HS_OK;
}

static hs_status keep_state(hs_fix *fix, hs_state *kept, hs_error *err)
{
    correlate_state *state = fix->state;
    const int64_t n = state->n_lags, n_pairs = state->n_pairs;
    HS_TRY(hs_state_int64(kept, "next", &state->next, 1, err));
    HS_TRY(hs_state_int(kept, "last", &state->last, err));
    HS_TRY(hs_state_int(kept, "n_samples", &state->n_samples, err));
    HS_TRY(hs_state_double(kept, "sample", state->sample, n * state->n_values, err));
    HS_TRY(hs_state_double(kept, "sum", state->sum, n * n_pairs, err));
    HS_TRY(hs_state_double(kept, "count", state->count, n, err));
    HS_TRY(hs_state_double(kept, "result", state->result, n * n_pairs, err));
    HS_TRY(hs_state_double(kept, "result_count", state->result_count, n, err));
    return hs_average_file_keep(&state->file, fix->env, kept, err);
}

const hs_fix_style hs_fix_style_ave_correlate = {
    .about =
        {.name = "ave/correlate",
         .syntax = {.usage = "<Nevery> <Nrepeat> <Nfreq> <value> ... [keyword value ...]",
                    .n_min = 4,
                    .n_max = -1,
                    .keywords = keywords},
         .summary = "time correlations of numbers",
         .details =
             "Values are numbers: `c_ID`, `c_ID[i]`, `f_ID`, `f_ID[i]`, `v_name`, ranges as in `c_ID[*]`. They are "
             "sampled every Nevery steps, and products V_i(s) V_j(s + t) of samples up to Nrepeat - 1 samples apart "
             "are "
             "averaged over all s. Results come every Nfreq steps. With `ave one` averages start anew then; with `ave "
             "running` they go on.\n\n"
             "`f_ID[i][j]` is an array of Nrepeat rows: the time t in steps, the number of samples, and one column for "
             "each pair of values: each value with itself (`type auto`), those with i < j (`upper`), i > j (`lower`), "
             "both kinds, or all (`full`). `trap(f_ID[3])` in a formula integrates the first of them. A sample costs "
             "Nrepeat products for each pair. The group has no meaning.",
         .reference = "R. Kubo, J. Phys. Soc. Jpn. 12, 570 (1957), doi:10.1143/JPSJ.12.570",
         .example = "variable pxy equal pxy\nfix SS all ave/correlate 5 400 2000 v_pxy type auto file profile.gk ave "
                    "running"},
    .state_size = sizeof(correlate_state),
    .create = create,
    .destroy = destroy,
    .init = init,
    .setup = end_of_step,
    .end_of_step = end_of_step,
    .keep_state = keep_state,
    .array = array,
    .needs_energy = needs_energy,
    .is_time_dependent = true,
};
