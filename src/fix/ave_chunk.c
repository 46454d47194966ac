/* Averages over the atoms of each chunk and over time. */
#include <string.h>

#include "base/memory.h"
#include "io/average.h"
#include "io/chunk_columns.h"
#include "style/chunks.h"

typedef struct ave_state {
    hs_schedule schedule;
    char *chunk_id; /**< owned */
    hs_chunk_columns columns;
    bool is_holding; /**< the chunks: a window has begun, or means are of several */
    int64_t n_chunks;
    double *sum;    /**< owned [n_chunks][1 + n]: counts and values of the present window */
    double *sample; /**< owned [1 + n][n_chunks] */
    double *each;   /**< owned [2][n_chunks][1 + n]: values of a sample and their weights, for errors */
    double *values; /**< owned [capacity]: of each local atom */
    size_t capacity;
    hs_fold fold;
    hs_average_file file;
} ave_state;

static const hs_keyword keywords[] = {
    HS_AVERAGE_KEYWORDS,
    {"norm", 1, "all|sample|none",
     "divide by the atoms of all samples, by those of each sample, or not (default: all)"},
    {"bias", 1, "<compute>", "take the bias of this temperature compute off the velocities for temp"},
    {"adof", 1, "<number>", "degrees of freedom of each atom (default: dimensions of the box)"},
    {"cdof", 1, "<number>", "degrees of freedom to be added for each chunk (default: 0)"},
    {NULL, 0, NULL, NULL},
};

static hs_status read_keywords(hs_fix *fix, const hs_args *args, int first, hs_error *err)
{
    ave_state *state = fix->state;
    for (int i = first, n_used; i < args->n; i += n_used) {
        HS_TRY(hs_average_keyword(&state->schedule, &state->fold, &state->file, args, i, &n_used, err));
        if (n_used > 0) continue;
        n_used = 2;
        HS_TRY(hs_chunk_columns_keyword(&state->columns, fix, args, i, err));
    }
    return HS_OK;
}

static int n_heads(const hs_chunks *chunks) { return chunks->n_axes + (chunks->is_compressed); }

/** Room for as many chunks as there are now. Means of several windows need the same chunks in each. */
static hs_status reserve(hs_fix *fix, const hs_compute *compute, hs_error *err)
{
    ave_state *state = fix->state;
    const hs_chunks *chunks = hs_chunks_of(compute);
    const size_t width = (size_t)state->columns.n + 1, n = (size_t)chunks->n;
    if (state->fold.mode != HS_FOLD_ONE && state->fold.n_added > 0 && chunks->n != state->n_chunks)
        return hs_fail(
            err, HS_ERROR_RUN,
            "%s: there were %lld chunks and are %lld now; 'ave one', or compute chunk/atom with 'nchunk once', goes on",
            hs_fix_who(fix).text, (long long)state->n_chunks, (long long)chunks->n);
    if (state->sum == NULL || chunks->n != state->n_chunks) {
        if (n * width > INT32_MAX)
            return hs_fail(err, HS_ERROR_INPUT, "%s: %lld chunks are too many", hs_fix_who(fix).text,
                           (long long)chunks->n);
        HS_TRY(HS_GROW(state->sum, 0, n * width + 1, err));
        HS_TRY(HS_GROW(state->sample, 0, n * width + 1, err));
        if (state->fold.has_errors) HS_TRY(HS_GROW(state->each, 0, 2 * n * width + 1, err));
        HS_TRY(hs_fold_reserve(&state->fold, (int)(n * width), err));
    }
    state->n_chunks = chunks->n;
    fix->has_variable_length = true;
    fix->n_rows = (int)chunks->n;
    fix->n_columns = n_heads(chunks) + 1 + state->columns.n * (state->fold.has_errors ? 3 : 1);
    return HS_OK;
}

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    ave_state *state = fix->state;
    const int first = hs_syntax_first_keyword(&fix->style->about.syntax, args);
    hs_compute *compute;
    state->columns.adof = fix->env->box->dimension;
    HS_TRY(hs_schedule_init(&state->schedule, args, 0, err));
    HS_TRY(hs_chunks_find(fix->env, args->word[3], args->command, &compute, err));
    HS_TRY(hs_memory_strdup(&state->chunk_id, args->word[3], err));
    for (int i = 4; i < first; ++i) HS_TRY(hs_chunk_columns_add(&state->columns, fix->env, args, i, err));
    HS_TRY(read_keywords(fix, args, first, err));
    HS_TRY(hs_fold_check_errors(&state->fold, &state->schedule, args->command, err));
    HS_TRY(reserve(fix, compute, err));
    hs_schedule_begin(&state->schedule, fix->env->step);
    return HS_OK;
}

static void destroy(hs_fix *fix)
{
    ave_state *state = fix->state;
    hs_chunks_hold(fix->env, state->chunk_id, false, &state->is_holding);
    hs_chunk_columns_fini(&state->columns);
    HS_FREE(state->chunk_id);
    HS_FREE(state->sum);
    HS_FREE(state->sample);
    HS_FREE(state->each);
    HS_FREE(state->values);
    hs_fold_fini(&state->fold);
    hs_average_file_fini(&state->file);
}

static const char *name_of(const void *context, int k) { return ((const ave_state *)context)->columns.column[k].name; }

static hs_status make_head(hs_text *head, const hs_fix *fix, const hs_chunks *chunks, hs_error *err)
{
    const ave_state *state = fix->state;
    HS_TRY(hs_text_printf(head, err, "# Chunk"));
    if (chunks->is_compressed) HS_TRY(hs_text_printf(head, err, " OrigID"));
    for (int k = 0; k < chunks->n_axes; ++k) HS_TRY(hs_text_printf(head, err, " Coord%d", k + 1));
    HS_TRY(hs_text_printf(head, err, " Ncount"));
    for (int k = 0; k < state->columns.n; ++k) HS_TRY(hs_text_printf(head, err, " %s", state->columns.column[k].name));
    return state->fold.has_errors ? hs_average_error_head(head, state->columns.n, name_of, state, err) : HS_OK;
}

static hs_status init(hs_fix *fix, hs_error *err)
{
    ave_state *state = fix->state;
    hs_schedule_renew(&state->schedule, fix->env->step);
    char title[256];
    hs_compute *compute;
    hs_text head = {0};
    HS_TRY(hs_chunks_find(fix->env, state->chunk_id, hs_fix_who(fix).text, &compute, err));
    HS_TRY(hs_chunk_columns_check(&state->columns, fix, hs_fix_who(fix).text, err));
    snprintf(title, sizeof title, "# Chunk-averaged data for fix %.80s and group %.80s", fix->id,
             fix->env->groups->name[fix->group]);
    hs_status status = make_head(&head, fix, hs_chunks_of(compute), err);
    const char *const heads[3] = {title, "# Timestep Number-of-chunks Total-count", hs_text_get(&head)};
    if (status == HS_OK) status = hs_average_file_open(&state->file, fix->env, heads, err);
    hs_text_fini(&head);
    return status;
}

static bool needs_energy(const hs_fix *fix, int64_t step)
{
    const ave_state *state = fix->state;
    return hs_schedule_is_due(&state->schedule, step) && hs_chunk_columns_need_energy(&state->columns, fix->env);
}

/** The sample just taken, for the errors of the means. */
static hs_status add_to_errors(hs_fix *fix, const hs_chunks *chunks, hs_error *err)
{
    ave_state *state = fix->state;
    const size_t width = (size_t)state->columns.n + 1, n = (size_t)chunks->n * width;
    if (!state->fold.has_errors) return HS_OK;
    for (int64_t c = 0; c < chunks->n; ++c)
        for (int k = -1; k < state->columns.n; ++k) {
            const size_t at = (size_t)c * width + (size_t)(k + 1);
            hs_chunk_columns_weigh(&state->columns, fix->env, hs_chunks_volume(chunks, c), k,
                                   state->sample[(k + 1) * chunks->n + c], state->sample[c], &state->each[at],
                                   &state->each[n + at]);
        }
    return hs_fold_add_sample(&state->fold, state->each, state->each + n, err);
}

static hs_status take_sample(hs_fix *fix, hs_compute *compute, hs_error *err)
{
    ave_state *state = fix->state;
    const hs_chunks *chunks = hs_chunks_of(compute);
    const size_t n_local = (size_t)fix->env->atoms->n_local, width = (size_t)state->columns.n + 1;
    hs_compute *bias;
    double ignored;
    HS_TRY(hs_chunk_columns_bias(&state->columns, fix, &bias, err));
    if (bias != NULL) HS_TRY(hs_compute_scalar(bias, &ignored, err));
    HS_TRY(HS_RESERVE(state->values, state->capacity, n_local, err));
    for (int k = -1; k < state->columns.n; ++k) {
        HS_TRY(hs_chunk_columns_fill(&state->columns, fix->env, k, bias, state->values, err));
        HS_TRY(
            hs_chunks_sum(compute, fix->mask, state->values, state->sample + (size_t)(k + 1) * (size_t)chunks->n, err));
    }
    for (int64_t c = 0; c < chunks->n; ++c)
        for (int k = -1; k < state->columns.n; ++k) {
            double value = state->sample[(k + 1) * chunks->n + c];
            if (k >= 0 && state->columns.norm != HS_NORM_ALL)
                value = hs_chunk_columns_mean(&state->columns, fix->env, hs_chunks_volume(chunks, c), k, value,
                                              state->sample[c], 1.0);
            state->sum[(size_t)c * width + (size_t)(k + 1)] += value;
        }
    return add_to_errors(fix, chunks, err);
}

/** Column k: 0 the count, then the means of the n values, their errors, their inefficiencies. */
static double result(const ave_state *state, int64_t c, int k)
{
    const hs_fold *fold = &state->fold;
    const int64_t row = c * (state->columns.n + 1);
    const double count = hs_fold_count(fold);
    if (k > 2 * state->columns.n) return fold->inefficiency[row + k - 2 * state->columns.n];
    if (k > state->columns.n) return fold->error[row + k - state->columns.n];
    return count == 0.0 ? 0.0 : fold->sum[row + k] / count;
}

static hs_status write_window(hs_fix *fix, const hs_chunks *chunks, hs_error *err)
{
    ave_state *state = fix->state;
    hs_average_file *file = &state->file;
    double total = 0.0; /* over all windows that count, as LAMMPS prints it */
    for (int64_t c = 0; c < chunks->n; ++c) total += result(state, c, 0) * hs_fold_count(&state->fold);
    if (hs_average_file_is_open(file)) {
        HS_TRY(
            hs_text_printf(&file->text, err, "%lld %lld %g\n", (long long)fix->env->step, (long long)chunks->n, total));
        for (int64_t c = 0; c < chunks->n; ++c) {
            HS_TRY(hs_text_printf(&file->text, err, "  %lld", (long long)c + 1));
            if (chunks->is_compressed)
                HS_TRY(hs_text_printf(&file->text, err, " %lld", (long long)chunks->original[c]));
            for (int k = 0; k < chunks->n_axes; ++k)
                HS_TRY(hs_text_printf(&file->text, err, " %g", chunks->place[c * chunks->n_axes + k]));
            HS_TRY(hs_text_printf(&file->text, err, " %g", result(state, c, 0)));
            for (int k = 1; k <= state->columns.n * (state->fold.has_errors ? 3 : 1); ++k)
                HS_TRY(hs_average_file_number(file, result(state, c, k), err));
            HS_TRY(hs_text_append(&file->text, "\n", 1, err));
        }
    }
    return hs_average_file_commit(file, fix->env, err);
}

static hs_status end_of_step(hs_fix *fix, hs_error *err)
{
    ave_state *state = fix->state;
    hs_compute *compute;
    HS_TRY(hs_fix_need_sample(fix, state->schedule.next, err));
    if (!hs_schedule_is_due(&state->schedule, fix->env->step)) return HS_OK;
    HS_TRY(hs_chunks_find(fix->env, state->chunk_id, "fix ave/chunk", &compute, err));
    hs_chunks *chunks = hs_chunks_of(compute);
    const int width = state->columns.n + 1;
    const double repeat = (double)state->schedule.repeat;
    const bool is_first = state->schedule.n_taken == 0;
    HS_TRY(hs_compute_eval_atoms(compute, err));
    if (is_first) {
        HS_TRY(reserve(fix, compute, err));
        memset(state->sum, 0, (size_t)chunks->n * (size_t)width * sizeof *state->sum);
        hs_chunks_hold(fix->env, state->chunk_id, true, &state->is_holding);
    }
    HS_TRY(take_sample(fix, compute, err));
    if (!hs_schedule_advance(&state->schedule, fix->env->step)) return HS_OK;
    for (int64_t c = 0; c < chunks->n; ++c) {
        double *row = state->sum + c * width;
        for (int k = 0; k < state->columns.n; ++k)
            row[k + 1] = state->columns.norm == HS_NORM_ALL
                             ? hs_chunk_columns_mean(&state->columns, fix->env, hs_chunks_volume(chunks, c), k,
                                                     row[k + 1], row[0], repeat)
                             : row[k + 1] / repeat;
        row[0] /= repeat;
    }
    hs_fold_add(&state->fold, state->sum);
    hs_fold_find_errors(&state->fold);
    if (state->fold.mode == HS_FOLD_ONE) hs_chunks_hold(fix->env, state->chunk_id, false, &state->is_holding);
    return write_window(fix, chunks, err);
}

static hs_status array(hs_fix *fix, int i, int j, double *value, hs_error *err)
{
    ave_state *state = fix->state;
    hs_compute *compute;
    HS_TRY(hs_chunks_find(fix->env, state->chunk_id, "fix ave/chunk", &compute, err));
    const hs_chunks *chunks = hs_chunks_of(compute);
    const int n_before = n_heads(chunks);
    *value = 0.0;
    if (i >= state->n_chunks || hs_fold_count(&state->fold) == 0.0) return HS_OK;
    if (j >= n_before)
        *value = result(state, i, j - n_before);
    else if (chunks->is_compressed && j == 0)
        *value = (double)chunks->original[i];
    else if (chunks->place != NULL)
        *value = chunks->place[i * chunks->n_axes + j - (chunks->is_compressed)];
    return HS_OK;
}

static hs_status keep_state(hs_fix *fix, hs_state *kept, hs_error *err)
{
    ave_state *state = fix->state;
    hs_fold *fold = &state->fold;
    int64_t n_sum = state->n_chunks * (state->columns.n + 1), n_fold = n_sum, n_ring = n_sum * fold->n_window;
    HS_TRY(hs_state_int64(kept, "next", &state->schedule.next, 1, err));
    HS_TRY(hs_state_int64(kept, "n_taken", &state->schedule.n_taken, 1, err));
    HS_TRY(hs_state_int64(kept, "n_chunks", &state->n_chunks, 1, err));
    HS_TRY(hs_state_int64(kept, "n_folded", &fold->n_added, 1, err));
    HS_TRY(hs_state_bool(kept, "is_holding", &state->is_holding, err));
    HS_TRY(hs_state_doubles(kept, "sum", &state->sum, &n_sum, err));
    HS_TRY(hs_state_doubles(kept, "folded", &fold->sum, &n_fold, err));
    if (fold->mode == HS_FOLD_WINDOW) HS_TRY(hs_state_doubles(kept, "ring", &fold->ring, &n_ring, err));
    if (kept->is_reading) {
        fix->n_rows = (int)state->n_chunks;
        HS_TRY(HS_GROW(state->sample, 0, (size_t)n_sum + 1, err));
        if (fold->has_errors) {
            HS_TRY(HS_GROW(state->each, 0, 2 * (size_t)n_sum + 1, err));
            HS_TRY(hs_fold_reserve_errors(fold, (int)n_sum, err));
        }
        fold->n = (int)n_sum;
    }
    HS_TRY(hs_fold_keep_errors(fold, kept, err));
    return hs_average_file_keep(&state->file, fix->env, kept, err);
}

const hs_fix_style hs_fix_style_ave_chunk = {
    .about =
        {.name = "ave/chunk",
         .syntax = {.usage = "<Nevery> <Nrepeat> <Nfreq> <chunk-ID> <value> ... [keyword value ...]",
                    .n_min = 5,
                    .n_max = -1,
                    .keywords = keywords},
         .summary = "average over the atoms of each chunk and over time",
         .details =
             "Samples are taken and make windows as in fix ave/time. Of each chunk of compute chunk/atom (its atoms "
             "that are in the fix's group) the mean is given of: velocities `vx vy vz`, forces `fx fy fz`, `mass`, "
             "values per atom (`c_ID`, `c_ID[i]`, `f_ID`, `f_ID[i]`, `v_name`); and the number or mass of atoms per "
             "volume, `density/number` and `density/mass`, and the temperature, `temp`, from all of the velocity with "
             "adof degrees of freedom of each atom and cdof of each chunk (profiles of a flow: take off its velocity "
             "with `bias`). The volume is that of the bin or shell, or of the box for other chunks.\n\n"
             "`norm all` divides the sum over all atoms of all samples by their number; `sample` takes the mean of "
             "each sample, and of these the mean; `none` gives sums over atoms, not means. Chunks without atoms have "
             "0.\n\n"
             "`f_ID[i][j]` is an array with a row for each chunk: coordinates of its center (bins), the number of "
             "atoms in the mean sample, then the values; with `compress yes` its original number comes first. The file "
             "holds the same.\n\n"
             "With `error yes` columns of standard errors (`X_err`) and statistical inefficiencies (`X_ineff`, samples "
             "that count as one) of all values follow, as in fix ave/time. Under `norm all` a mean is a ratio, of sums "
             "over atoms to numbers of atoms; its error is that of the ratio.",
         .reference = "W. G. Cochran, Sampling Techniques, 3rd ed. (1977), section 6.3 (errors of ratios)",
         .example = "compute layers all chunk/atom bin/1d z lower 0.1 units reduced\n"
                    "fix 1 all ave/chunk 10 100 1000 layers density/number vx temp file profile.txt"},
    .state_size = sizeof(ave_state),
    .create = create,
    .destroy = destroy,
    .init = init,
    .measure_at_setup = end_of_step,
    .end_of_step = end_of_step,
    .array = array,
    .keep_state = keep_state,
    .needs_energy = needs_energy,
    .is_time_dependent = true,
    .keeps_plane = true,
};
