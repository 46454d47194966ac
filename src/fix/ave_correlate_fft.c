/* Time correlations over long windows, by fast Fourier transforms: as the direct sum, at a cost that hardly grows with the
 * number of lags. */
#include <string.h>

#include "base/memory.h"
#include "core/fourier.h"
#include "io/average.h"
#include "style/value.h"

typedef struct fft_state {
    int64_t every, freq, next; /**< next: step of the next sample */
    int n_lags;
    hs_schedule schedule; /**< keyword start only */
    hs_value *values;     /**< owned [n_values] */
    int n_values;
    bool is_cross; /**< all pairs, not each value with itself alone */
    int n_pairs;
    double *sample;  /**< owned [n_values][2 n_lags]: the block before, and the present one */
    int n_present;   /**< samples of the present block */
    int64_t n_total; /**< samples so far */
    double *sum;     /**< owned [n_pairs][n_lags]: of complete blocks */
    double *result;  /**< owned [n_pairs][n_lags]: of the last output */
    int64_t n_result;
    hs_correlator *correlator; /**< owned */
    hs_average_file file;
    char *head; /**< owned */
} fft_state;

static const hs_keyword keywords[] = {
    {"type", 1, "auto|full", "each value with itself, or all with all (default: auto)"},
    {"start", 1, "<step>", "no sample before this step (default: 0)"},
    {"file", 1, "<name>", "write correlations to this file, which holds the last output"},
    {"title1", 1, "<text>", "first line of the file"},
    {"title2", 1, "<text>", "second line"},
    {"title3", 1, "<text>", "third line"},
    {NULL, 0, NULL, NULL},
};

static void pair_of(const fft_state *state, int p, int *i, int *j)
{
    *i = state->is_cross ? p / state->n_values : p;
    *j = state->is_cross ? p % state->n_values : p;
}

static hs_status make_head(fft_state *state, hs_error *err)
{
    hs_text head = {0};
    hs_status status = hs_text_printf(&head, err, "# Index TimeDelta Ncount");
    for (int p = 0; p < state->n_pairs && status == HS_OK; ++p) {
        int i, j;
        pair_of(state, p, &i, &j);
        status = hs_text_printf(&head, err, " %s*%s", state->values[i].word, state->values[j].word);
    }
    if (status == HS_OK) status = hs_memory_strdup(&state->head, hs_text_get(&head), err);
    hs_text_fini(&head);
    return status;
}

static hs_status read_keywords(fft_state *state, const hs_args *args, int first, hs_error *err)
{
    static const char *const types[] = {"auto", "full", NULL};
    for (int i = first, n_used; i < args->n; i += n_used) {
        int type;
        HS_TRY(hs_average_keyword(&state->schedule, NULL, &state->file, args, i, &n_used, err));
        if (n_used > 0) continue;
        n_used = 2;
        HS_TRY(hs_arg_choice(args, i + 1, types, &type, err));
        state->is_cross = type == 1;
    }
    state->file.overwrite = true;
    return HS_OK;
}

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    fft_state *state = fix->state;
    int64_t n_lags;
    const int first = hs_syntax_first_keyword(&fix->style->about.syntax, args);
    HS_TRY(hs_arg_int(args, 0, 1, INT32_MAX, &state->every, err));
    HS_TRY(hs_arg_int(args, 1, 2, 1 << 28, &n_lags, err));
    HS_TRY(hs_arg_int(args, 2, 1, INT64_MAX / 4, &state->freq, err));
    if (state->freq % state->every != 0)
        return hs_fail(
            err, HS_ERROR_INPUT,
            "%s: output comes every %lld steps (Nfreq), which must be a multiple of the %lld steps between samples "
            "(Nevery)",
            args->command, (long long)state->freq, (long long)state->every);
    state->n_lags = (int)n_lags;
    HS_TRY(hs_values_create(&state->values, &state->n_values, fix->env, args, 3, first - 3, HS_VALUE_NUMBER, err));
    HS_TRY(read_keywords(state, args, first, err));
    state->n_pairs = state->is_cross ? state->n_values * state->n_values : state->n_values;
    HS_TRY(make_head(state, err));
    HS_TRY(HS_ALLOC(state->sample, 2 * (size_t)n_lags * (size_t)state->n_values, err));
    HS_TRY(HS_ALLOC(state->sum, (size_t)n_lags * (size_t)state->n_pairs, err));
    HS_TRY(HS_ALLOC(state->result, (size_t)n_lags * (size_t)state->n_pairs, err));
    HS_TRY(hs_correlator_create(&state->correlator, state->n_lags, err));
    const int64_t begin = state->schedule.start > fix->env->step ? state->schedule.start : fix->env->step;
    state->next = (begin + state->every - 1) / state->every * state->every;
    fix->n_rows = state->n_lags;
    fix->n_columns = state->n_pairs + 2;
    return HS_OK;
}

static void destroy(hs_fix *fix)
{
    fft_state *state = fix->state;
    hs_values_destroy(&state->values, state->n_values);
    hs_correlator_destroy(&state->correlator);
    HS_FREE(state->sample);
    HS_FREE(state->sum);
    HS_FREE(state->result);
    HS_FREE(state->head);
    hs_average_file_fini(&state->file);
}

static hs_status init(hs_fix *fix, hs_error *err)
{
    fft_state *state = fix->state;
    char command[128], title[160];
    snprintf(command, sizeof command, "fix '%.80s' (ave/correlate/fft)", fix->id);
    for (int k = 0; k < state->n_values; ++k)
        HS_TRY(hs_value_check(fix->env, &state->values[k], HS_VALUE_NUMBER, command, err));
    snprintf(title, sizeof title, "# Time-correlated data for fix %.100s", fix->id);
    const char *const head[3] = {title, "# Timestep Number-of-time-windows", state->head};
    return hs_average_file_open(&state->file, fix->env, head, err);
}

static bool needs_energy(const hs_fix *fix, int64_t step)
{
    const fft_state *state = fix->state;
    bool is_needed = false;
    if (step != state->next) return false;
    for (int k = 0; k < state->n_values; ++k) is_needed |= hs_value_needs_energy(fix->env, &state->values[k]);
    return is_needed;
}

/** Products of the present block (what is there of it) with itself and the block before. */
static void add_block(const fft_state *state, double *sums)
{
    const size_t n_lags = (size_t)state->n_lags;
    for (int p = 0; p < state->n_pairs; ++p) {
        int i, j;
        pair_of(state, p, &i, &j);
        hs_correlator_add(state->correlator, state->sample + 2 * n_lags * (size_t)i,
                          state->sample + 2 * n_lags * (size_t)j, sums + n_lags * (size_t)p);
    }
}

static double count_of(int64_t n_samples, int lag) { return n_samples > lag ? (double)(n_samples - lag) : 0.0; }

static hs_status write_output(hs_fix *fix, hs_error *err)
{
    fft_state *state = fix->state;
    hs_average_file *file = &state->file;
    if (hs_average_file_is_open(file)) {
        HS_TRY(hs_text_printf(&file->text, err, "%lld %d\n", (long long)fix->env->step, state->n_lags));
        for (int lag = 0; lag < state->n_lags; ++lag) {
            HS_TRY(hs_text_printf(&file->text, err, "%d %lld %.0f", lag + 1, (long long)(lag * state->every),
                                  count_of(state->n_result, lag)));
            for (int p = 0; p < state->n_pairs; ++p)
                HS_TRY(
                    hs_average_file_number(file, state->result[(size_t)p * (size_t)state->n_lags + (size_t)lag], err));
            HS_TRY(hs_text_append(&file->text, "\n", 1, err));
        }
    }
    return hs_average_file_commit(file, fix->env, err);
}

static hs_status finish(hs_fix *fix, hs_error *err)
{
    fft_state *state = fix->state;
    const size_t n = (size_t)state->n_lags * (size_t)state->n_pairs;
    memcpy(state->result, state->sum, n * sizeof *state->sum);
    if (state->n_present > 0) add_block(state, state->result);
    state->n_result = state->n_total;
    for (size_t k = 0; k < n; ++k) {
        const double count = count_of(state->n_total, (int)(k % (size_t)state->n_lags));
        state->result[k] = count > 0.0 ? state->result[k] / count : 0.0;
    }
    return write_output(fix, err);
}

/** The present block is full: it becomes the one before. */
static void end_block(fft_state *state)
{
    const size_t n_lags = (size_t)state->n_lags;
    add_block(state, state->sum);
    for (int k = 0; k < state->n_values; ++k) {
        double *sample = state->sample + 2 * n_lags * (size_t)k;
        memcpy(sample, sample + n_lags, n_lags * sizeof *sample);
        memset(sample + n_lags, 0, n_lags * sizeof *sample);
    }
    state->n_present = 0;
}

static hs_status end_of_step(hs_fix *fix, hs_error *err)
{
    fft_state *state = fix->state;
    if (fix->env->step != state->next) return HS_OK;
    for (int k = 0; k < state->n_values; ++k)
        HS_TRY(hs_value_number(
            fix->env, &state->values[k],
            &state->sample[2 * (size_t)state->n_lags * (size_t)k + (size_t)(state->n_lags + state->n_present)], err));
    ++state->n_present;
    ++state->n_total;
    state->next += state->every;
    if (state->n_present == state->n_lags) end_block(state);
    return fix->env->step % state->freq == 0 ? finish(fix, err) : HS_OK;
}

static hs_status array(hs_fix *fix, int i, int j, double *value, hs_error *err)
{
    const fft_state *state = fix->state;
    (void)err;
    *value = j == 0   ? (double)(i * state->every)
             : j == 1 ? count_of(state->n_result, i)
                      : state->result[(size_t)(j - 2) * (size_t)state->n_lags + (size_t)i];
    return HS_OK;
}

static hs_status keep_state(hs_fix *fix, hs_state *kept, hs_error *err)
{
    fft_state *state = fix->state;
    const int64_t n_lags = state->n_lags;
    HS_TRY(hs_state_int64(kept, "next", &state->next, 1, err));
    HS_TRY(hs_state_int(kept, "n_present", &state->n_present, err));
    HS_TRY(hs_state_int64(kept, "n_total", &state->n_total, 1, err));
    HS_TRY(hs_state_int64(kept, "n_result", &state->n_result, 1, err));
    HS_TRY(hs_state_double(kept, "sample", state->sample, 2 * n_lags * state->n_values, err));
    HS_TRY(hs_state_double(kept, "sum", state->sum, n_lags * state->n_pairs, err));
    HS_TRY(hs_state_double(kept, "result", state->result, n_lags * state->n_pairs, err));
    return hs_average_file_keep(&state->file, fix->env, kept, err);
}

const hs_fix_style hs_fix_style_ave_correlate_fft = {
    .about =
        {.name = "ave/correlate/fft",
         .syntax = {.usage = "<Nevery> <Nlags> <Nfreq> <value> ... [keyword value ...]",
                    .n_min = 4,
                    .n_max = -1,
                    .keywords = keywords},
         .summary = "time correlations of numbers over long times",
         .details =
             "As `fix ave/correlate ... ave running`, with the same numbers to rounding: values are sampled every "
             "Nevery "
             "steps, and products V_i(s) V_j(s + t) up to Nlags - 1 samples apart are averaged over the whole series. "
             "They "
             "are made by zero-padded fast Fourier transforms of blocks of Nlags samples, so that a sample costs about "
             "log(Nlags) instead of Nlags products, and tens of thousands of lags are cheap; memory is that of two "
             "blocks. "
             "Results come every Nfreq steps; the file holds the last ones. The array `f_ID[i][j]` has the columns "
             "time in "
             "steps, number of samples, and one for each value (`type auto`) or pair of values (`type full`: 1*1, 1*2, "
             "...). "
             "The group has no meaning.",
         .reference = "W. H. Press et al., Numerical Recipes, 3rd ed. (2007), section 13.2",
         .example =
             "variable pxy equal pxy\nfix SS all ave/correlate/fft 1 20000 100000 v_pxy file stress.corr\nvariable eta "
             "equal vol/temp*dt*trap(f_SS[3])"},
    .state_size = sizeof(fft_state),
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
