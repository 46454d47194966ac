/* Averages over time of numbers or vectors. */
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "io/average.h"
#include "style/chunks.h"
#include "style/value.h"

typedef struct ave_state {
    hs_schedule schedule;
    hs_value *values; /**< owned [n_values] */
    int n_values;
    bool is_vector;     /**< mode vector: each value is a vector of n_rows elements */
    int n_rows;         /**< 1 in mode scalar */
    bool *is_holding;   /**< owned [n_values]: the chunks that the value is of */
    bool *is_off;       /**< owned [n_values]: keyword off: the last sample counts, not the mean */
    bool *is_extensive; /**< owned [3 n_values]: of means, errors, inefficiencies: grows with the number of atoms */
    double *sum;        /**< owned [n_rows][n_values]: of the present window */
    double *sample;     /**< owned [n_rows] */
    double *all;        /**< owned [n_rows][n_values]: the present sample, for errors */
    hs_series_set run;  /**< of the numbers of mode scalar with error yes: all samples since the fix began */
    hs_fold fold;
    hs_average_file file;
    char *head; /**< owned; the names of the columns */
} ave_state;

static const hs_keyword keywords[] = {
    HS_AVERAGE_KEYWORDS,
    {"mode", 1, "scalar|vector", "values are numbers, or vectors of equal length (default: scalar)"},
    {"off", 1, "<M>", "value M is not averaged: its last sample is taken"},
    {NULL, 0, NULL, NULL},
};

static hs_status read_mode(ave_state *state, const hs_args *args, int first, hs_error *err)
{
    static const char *const modes[] = {"scalar", "vector", NULL};
    for (int i = first; i + 1 < args->n; ++i) {
        int mode;
        if (strcmp(args->word[i], "mode") != 0) continue;
        HS_TRY(hs_arg_choice(args, i + 1, modes, &mode, err));
        state->is_vector = mode == 1;
    }
    return HS_OK;
}

static hs_status read_keywords(ave_state *state, const hs_args *args, int first, hs_error *err)
{
    for (int i = first, n_used; i < args->n; i += n_used) {
        HS_TRY(hs_average_keyword(&state->schedule, &state->fold, &state->file, args, i, &n_used, err));
        if (n_used > 0) continue;
        n_used = 2;
        if (strcmp(args->word[i], "mode") == 0) continue;
        if (strcmp(args->word[i], "off") != 0) return hs_arg_refuse(args, i, "a keyword here", NULL, err);
        int64_t m;
        HS_TRY(hs_arg_int(args, i + 1, 1, state->n_values, &m, err));
        state->is_off[m - 1] = true;
    }
    return HS_OK;
}

static hs_status set_length(hs_fix *fix, int n_rows, hs_error *err)
{
    ave_state *state = fix->state;
    state->n_rows = n_rows;
    const size_t n = (size_t)state->n_rows * (size_t)state->n_values;
    HS_TRY(HS_GROW(state->sum, 0, n, err));
    HS_TRY(HS_GROW(state->sample, 0, (size_t)state->n_rows, err));
    HS_TRY(HS_GROW(state->all, 0, n, err));
    HS_TRY(hs_fold_reserve(&state->fold, (int)n, err));
    const bool has_errors = state->fold.has_errors;
    const int n_columns = state->n_values * (has_errors ? 3 : 1); /* means, errors, inefficiencies */
    state->run.n_series = has_errors && !state->is_vector ? state->n_values : 0;
    fix->has_scalar = !state->is_vector && state->n_values == 1;
    fix->has_vector = state->is_vector ? state->n_values == 1 : n_columns > 1;
    fix->has_array = state->is_vector && n_columns > 1;
    fix->n_vector = state->is_vector ? state->n_rows : n_columns;
    fix->n_rows = state->n_rows;
    fix->n_columns = fix->has_array ? n_columns : 0;
    return HS_OK;
}

/** Length of the vectors, which must agree. */
static hs_status find_length(hs_fix *fix, const char *command, hs_error *err)
{
    const ave_state *state = fix->state;
    const int n_rows = state->is_vector ? hs_value_length(fix->env, &state->values[0]) : 1;
    for (int k = 1; k < state->n_values && state->is_vector; ++k) {
        const int n = hs_value_length(fix->env, &state->values[k]);
        if (n != n_rows)
            return hs_fail(err, HS_ERROR_INPUT, "%s: the vectors must be equally long, and %s has %d elements, %s %d",
                           command, state->values[0].word, n_rows, state->values[k].word, n);
    }
    return set_length(fix, n_rows, err);
}

static const char *name_of(const void *context, int k) { return ((const ave_state *)context)->values[k].word; }

static hs_status make_head(ave_state *state, hs_error *err)
{
    hs_text head = {0};
    hs_status status = hs_text_printf(&head, err, state->is_vector ? "# Row" : "# TimeStep");
    for (int k = 0; k < state->n_values && status == HS_OK; ++k)
        status = hs_text_printf(&head, err, " %s", state->values[k].word);
    if (status == HS_OK && state->fold.has_errors)
        status = hs_average_error_head(&head, state->n_values, name_of, state, err);
    if (status == HS_OK) status = hs_memory_strdup(&state->head, hs_text_get(&head), err);
    hs_text_fini(&head);
    return status;
}

/** Which means and errors grow with the number of atoms (inefficiencies do not); of an array all do if the first value does. */
static hs_status find_extensive(hs_fix *fix, hs_error *err)
{
    ave_state *state = fix->state;
    HS_TRY(HS_ALLOC(state->is_extensive, 3 * (size_t)state->n_values, err));
    for (int k = 0; k < state->n_values; ++k) {
        hs_value element = state->values[k];
        if (state->is_vector) element.index[element.n_indices++] = 1; /* any element of the vector */
        state->is_extensive[k] = state->is_extensive[state->n_values + k] = hs_value_is_extensive(fix->env, &element);
    }
    fix->is_extensive = fix->is_vector_extensive = fix->is_array_extensive = state->is_extensive[0];
    if (!state->is_vector) fix->is_element_extensive = state->is_extensive;
    return HS_OK;
}

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    ave_state *state = fix->state;
    const int first = hs_syntax_first_keyword(&fix->style->about.syntax, args);
    HS_TRY(hs_schedule_init(&state->schedule, args, 0, err));
    HS_TRY(read_mode(state, args, first, err));
    HS_TRY(hs_values_create(&state->values, &state->n_values, fix->env, args, 3, first - 3,
                            state->is_vector ? HS_VALUE_VECTOR : HS_VALUE_NUMBER, err));
    fix->has_variable_length = state->is_vector && hs_value_is_variable(fix->env, &state->values[0]);
    HS_TRY(HS_ALLOC(state->is_off, (size_t)state->n_values, err));
    HS_TRY(HS_ALLOC(state->is_holding, (size_t)state->n_values, err));
    HS_TRY(read_keywords(state, args, first, err));
    HS_TRY(hs_fold_check_errors(&state->fold, &state->schedule, args->command, err));
    HS_TRY(find_length(fix, args->command, err));
    HS_TRY(find_extensive(fix, err));
    hs_schedule_begin(&state->schedule, fix->env->step);
    return make_head(state, err);
}

/** Rows of chunks stay those of the same chunks while a window is averaged; means of several windows hold them for good. */
static void hold_chunks(hs_fix *fix, bool hold)
{
    ave_state *state = fix->state;
    for (int k = 0; k < state->n_values && state->is_vector; ++k) {
        const hs_value *value = &state->values[k];
        const hs_compute *compute = value->kind == 'c' ? fix->env->find_compute(fix->env, value->id) : NULL;
        if (compute != NULL) hs_chunks_hold(fix->env, compute->chunk_id, hold, &state->is_holding[k]);
    }
}

static void destroy(hs_fix *fix)
{
    ave_state *state = fix->state;
    if (state->is_holding != NULL) hold_chunks(fix, false);
    HS_FREE(state->is_holding);
    hs_values_destroy(&state->values, state->n_values);
    HS_FREE(state->is_off);
    HS_FREE(state->is_extensive);
    HS_FREE(state->sum);
    HS_FREE(state->sample);
    HS_FREE(state->all);
    HS_FREE(state->head);
    hs_series_set_fini(&state->run);
    hs_fold_fini(&state->fold);
    hs_average_file_fini(&state->file);
}

static hs_status init(hs_fix *fix, hs_error *err)
{
    ave_state *state = fix->state;
    hs_schedule_renew(&state->schedule, fix->env->step);
    char title[160];
    HS_TRY(hs_values_check(fix->env, state->values, state->n_values,
                           state->is_vector ? HS_VALUE_VECTOR : HS_VALUE_NUMBER, hs_fix_who(fix).text, err));
    snprintf(title, sizeof title, "# Time-averaged data for fix %.100s", fix->id);
    const char *const head[3] = {title, state->is_vector ? "# TimeStep Number-of-rows" : state->head,
                                 state->is_vector ? state->head : NULL};
    return hs_average_file_open(&state->file, fix->env, head, err);
}

static bool needs_energy(const hs_fix *fix, int64_t step)
{
    const ave_state *state = fix->state;
    return hs_schedule_is_due(&state->schedule, step) &&
           hs_values_need_energy(fix->env, state->values, state->n_values);
}

/** Vectors whose length varies, as the number of chunks does: each window may have its own, means of several that of the first. */
static hs_status fit_length(hs_fix *fix, hs_error *err)
{
    ave_state *state = fix->state;
    if (!state->is_vector || (state->fold.mode != HS_FOLD_ONE && state->fold.n_added > 0)) return HS_OK;
    for (int k = 0; k < state->n_values; ++k) HS_TRY(hs_value_refresh(fix->env, &state->values[k], err));
    if (hs_value_length(fix->env, &state->values[0]) == state->n_rows) return HS_OK;
    return find_length(fix, hs_fix_who(fix).text, err);
}

static void announce(const hs_fix *fix, int64_t step)
{
    const ave_state *state = fix->state;
    if (!hs_schedule_is_due(&state->schedule, step)) return;
    for (int k = 0; k < state->n_values; ++k) hs_value_announce(fix->env, &state->values[k]);
}

static hs_status take_sample(hs_fix *fix, hs_error *err)
{
    ave_state *state = fix->state;
    const int n = state->n_values;
    for (int k = 0; k < n; ++k) {
        const hs_value *value = &state->values[k];
        if (state->is_vector) HS_TRY(hs_value_refresh(fix->env, value, err));
        if (state->is_vector && hs_value_length(fix->env, value) != state->n_rows)
            return hs_fail(err, HS_ERROR_RUN, "%s: the vector %s had %d elements and has %d now", hs_fix_who(fix).text,
                           value->word, state->n_rows, hs_value_length(fix->env, value));
        HS_TRY(state->is_vector ? hs_value_vector(fix->env, value, state->sample, err)
                                : hs_value_number(fix->env, value, state->sample, err));
        for (int i = 0; i < state->n_rows; ++i) {
            double *sum = &state->sum[i * n + k];
            *sum = state->is_off[k] ? state->sample[i] : *sum + state->sample[i];
            state->all[i * n + k] = state->sample[i];
        }
    }
    HS_TRY(hs_series_set_add(&state->run, state->all, NULL, err));
    return hs_fold_add_sample(&state->fold, state->all, NULL, err);
}

/** Column k: the means, then their errors, then their inefficiencies. */
static double result(const ave_state *state, int i, int k)
{
    const hs_fold *fold = &state->fold;
    const double count = hs_fold_count(fold);
    const int n = state->n_values, at = i * n + k % n;
    if (count == 0.0 || i >= state->n_rows) return 0.0;
    return k < n ? fold->sum[at] / count : k < 2 * n ? fold->error[at] : fold->inefficiency[at];
}

static hs_status write_window(hs_fix *fix, hs_error *err)
{
    ave_state *state = fix->state;
    hs_average_file *file = &state->file;
    const int n_columns = state->n_values * (state->fold.has_errors ? 3 : 1);
    if (hs_average_file_is_open(file)) {
        HS_TRY(hs_text_printf(&file->text, err, "%lld", (long long)fix->env->step));
        if (state->is_vector) HS_TRY(hs_text_printf(&file->text, err, " %d\n", state->n_rows));
        for (int i = 0; i < state->n_rows; ++i) {
            if (state->is_vector) HS_TRY(hs_text_printf(&file->text, err, "%d", i + 1));
            for (int k = 0; k < n_columns; ++k) HS_TRY(hs_average_file_number(file, result(state, i, k), err));
            HS_TRY(hs_text_append(&file->text, "\n", 1, err));
        }
    }
    return hs_average_file_commit(file, fix->env, err);
}

static hs_status end_of_step(hs_fix *fix, hs_error *err)
{
    ave_state *state = fix->state;
    HS_TRY(hs_fix_need_sample(fix, state->schedule.next, err));
    if (!hs_schedule_is_due(&state->schedule, fix->env->step)) return HS_OK;
    if (state->schedule.n_taken == 0) {
        HS_TRY(fit_length(fix, err));
        hold_chunks(fix, true);
    }
    const int n = state->n_rows * state->n_values;
    if (state->schedule.n_taken == 0) memset(state->sum, 0, (size_t)n * sizeof *state->sum);
    HS_TRY(take_sample(fix, err));
    if (!hs_schedule_advance(&state->schedule, fix->env->step)) return HS_OK;
    for (int i = 0; i < n; ++i)
        if (!state->is_off[i % state->n_values]) state->sum[i] /= (double)state->schedule.repeat;
    hs_fold_add(&state->fold, state->sum);
    /* what is not averaged over samples is not averaged over windows either */
    for (int i = 0; i < n; ++i)
        if (state->is_off[i % state->n_values]) state->fold.sum[i] = state->sum[i] * hs_fold_count(&state->fold);
    hs_fold_find_errors(&state->fold);
    if (state->fold.mode == HS_FOLD_ONE) hold_chunks(fix, false);
    return write_window(fix, err);
}

/** The means over all samples, whatever the windows. */
static void say_results(const hs_fix *fix)
{
    const ave_state *state = fix->state;
    char title[160];
    bool is_uncertain = false;
    if (state->run.n_series == 0 || state->run.n_levels == 0) return;
    hs_estimate e = hs_series_set_estimate(&state->run, 0);
    if (e.n < 2) return;
    snprintf(title, sizeof title, "Means of %lld samples of fix %.100s", (long long)e.n, fix->id);
    hs_average_say_head(fix->env->out, title);
    for (int k = 0; k < state->n_values; ++k) {
        e = hs_series_set_estimate(&state->run, k);
        hs_average_say_row(fix->env->out, state->values[k].word, &e);
        is_uncertain |= !e.is_converged;
    }
    hs_average_say_foot(fix->env->out, is_uncertain);
}

static hs_status scalar(hs_fix *fix, double *value, hs_error *err)
{
    (void)err;
    *value = result(fix->state, 0, 0);
    return HS_OK;
}

static hs_status vector(hs_fix *fix, int i, double *value, hs_error *err)
{
    const ave_state *state = fix->state;
    (void)err;
    *value = state->is_vector ? result(state, i, 0) : result(state, 0, i);
    return HS_OK;
}

static hs_status array(hs_fix *fix, int i, int j, double *value, hs_error *err)
{
    (void)err;
    *value = result(fix->state, i, j);
    return HS_OK;
}

static hs_status keep_state(hs_fix *fix, hs_state *kept, hs_error *err)
{
    ave_state *state = fix->state;
    int64_t n_rows = state->n_rows;
    HS_TRY(hs_schedule_keep(&state->schedule, kept, err));
    for (int k = 0; k < state->n_values && state->is_vector; ++k) {
        char name[32];
        snprintf(name, sizeof name, "is_holding %d", k);
        HS_TRY(hs_state_bool(kept, name, &state->is_holding[k], err));
    }
    HS_TRY(hs_state_int64(kept, "rows", &n_rows, 1, err));
    if (n_rows != state->n_rows) HS_TRY(set_length(fix, (int)n_rows, err));
    HS_TRY(hs_state_double(kept, "sum", state->sum, (int64_t)state->n_rows * state->n_values, err));
    HS_TRY(hs_fold_keep(&state->fold, kept, err));
    HS_TRY(hs_fold_keep_errors(&state->fold, kept, err));
    HS_TRY(hs_series_set_keep(&state->run, kept, "samples of the run", err));
    return hs_average_file_keep(&state->file, fix->env, kept, err);
}

const hs_fix_style hs_fix_style_ave_time = {
    .about = {.name = "ave/time",
              .syntax = {.usage = "<Nevery> <Nrepeat> <Nfreq> <value> ... [keyword value ...]",
                         .n_min = 4,
                         .n_max = -1,
                         .keywords = keywords},
              .summary = "average numbers or vectors over time",
              .details =
                  "Samples are taken every Nevery steps; Nrepeat of them make a window, whose mean is there at each "
                  "multiple of Nfreq steps: `10 5 100` averages the steps 60, 70, 80, 90, 100; then 160 and so on. "
                  "Nfreq must be a multiple of Nevery, and Nrepeat samples must fit into it.\n\n"
                  "In `mode scalar` a value is a number, `c_ID`, `c_ID[i]`, `f_ID`, `f_ID[i]` or `v_name`; in `mode "
                  "vector` a vector, `c_ID` or `f_ID`, or a column of an array, `c_ID[j]` or `f_ID[j]`, all equally "
                  "long. `c_ID[*]` stands for all elements or columns.\n\n"
                  "`f_ID` is the mean in mode scalar with one value, with several `f_ID[i]`; in mode vector `f_ID` is "
                  "the mean vector, with several values `f_ID[i][j]` an array whose columns they are. Before the first "
                  "window is complete they are 0. The group has no meaning.\n\n"
                  "With `error yes` columns `X_err` and `X_ineff` follow: the standard error of the mean by blocking "
                  "(the true mean is that near in 68 % of all runs; where blocks are few, it is widened by Student's "
                  "t), and the statistical inefficiency, the number of samples that count as one. They belong to the "
                  "mean beside them: of the samples of the window (`ave one`), of all samples (`running`), of the last "
                  "M windows (`window M`); `nan` where there is one alone. `f_ID` has them too: n means, then n "
                  "errors, then n inefficiencies, as elements of the vector in mode scalar and as columns of the array "
                  "in mode vector. In mode scalar a table of the means over all samples is printed after each run; a "
                  "star marks an error that rests on fewer than 20 independent values and may be too small.",
              .reference = "H. Flyvbjerg, H. G. Petersen, J. Chem. Phys. 91, 461 (1989), doi:10.1063/1.457480; R. M. "
                           "Lee et al., Phys. Rev. E 83, 066706 (2011), doi:10.1103/PhysRevE.83.066706; D. N. Politis, "
                           "J. P. Romano, J. Time Series Anal. 16, 67 (1995), doi:10.1111/j.1467-9892.1995.tb00223.x",
              .example = "fix 1 all ave/time 100 5 1000 c_myTemp c_thermo_temp file temp.profile\n"
                         "fix 2 all ave/time 100 10 1000 c_myRDF[*] file tmp.rdf mode vector\n"
                         "fix 3 all ave/time 10 1 10 c_thermo_press ave running error yes"},
    .state_size = sizeof(ave_state),
    .create = create,
    .destroy = destroy,
    .init = init,
    .measure_at_setup = end_of_step,
    .end_of_step = end_of_step,
    .say_results = say_results,
    .scalar = scalar,
    .vector = vector,
    .array = array,
    .needs_energy = needs_energy,
    .announce = announce,
    .keep_state = keep_state,
    .is_time_dependent = true,
    .allows_dynamic_group = true,
    .keeps_plane = true,
};
