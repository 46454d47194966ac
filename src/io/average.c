#include "io/average.h"

#include <string.h>

#include "base/memory.h"
#include "io/user_format.h"

hs_status hs_schedule_init(hs_schedule *schedule, const hs_args *args, int first, hs_error *err)
{
    HS_TRY(hs_arg_int(args, first, 1, INT32_MAX, &schedule->every, err));
    HS_TRY(hs_arg_int(args, first + 1, 1, INT32_MAX, &schedule->repeat, err));
    HS_TRY(hs_arg_int(args, first + 2, 1, INT64_MAX / 4, &schedule->freq, err));
    if (schedule->freq % schedule->every != 0)
        return hs_fail(err, HS_ERROR_INPUT,
                       "%s: windows end every %lld steps (Nfreq), which must be a multiple of the %lld steps between "
                       "samples (Nevery)",
                       args->command, (long long)schedule->freq, (long long)schedule->every);
    if (schedule->repeat * schedule->every > schedule->freq)
        return hs_fail(
            err, HS_ERROR_INPUT,
            "%s: %lld samples (Nrepeat) every %lld steps (Nevery) do not fit into windows of %lld steps (Nfreq)",
            args->command, (long long)schedule->repeat, (long long)schedule->every, (long long)schedule->freq);
    return HS_OK;
}

void hs_schedule_begin(hs_schedule *schedule, int64_t step)
{
    const int64_t freq = schedule->freq, before = (schedule->repeat - 1) * schedule->every;
    int64_t end = step / freq * freq;
    if (end < step) end += freq;
    if (end < schedule->start) end += (schedule->start - end + freq - 1) / freq * freq;
    if (end - before < step) end += freq;
    schedule->next = end - before;
    schedule->n_taken = 0;
}

bool hs_schedule_advance(hs_schedule *schedule, int64_t step)
{
    if (++schedule->n_taken < schedule->repeat) {
        schedule->next = step + schedule->every;
        return false;
    }
    schedule->n_taken = 0;
    schedule->next = step + schedule->freq - (schedule->repeat - 1) * schedule->every;
    return true;
}

hs_status hs_schedule_keep(hs_schedule *schedule, hs_state *state, hs_error *err)
{
    HS_TRY(hs_state_int64(state, "next sample", &schedule->next, 1, err));
    return hs_state_int64(state, "samples of the window", &schedule->n_taken, 1, err);
}

hs_status hs_fold_reserve(hs_fold *fold, int n, hs_error *err)
{
    if (fold->sum != NULL && fold->n == n) return HS_OK;
    HS_TRY(HS_GROW(fold->sum, 0, (size_t)n, err));
    if (fold->mode == HS_FOLD_WINDOW) HS_TRY(HS_GROW(fold->ring, 0, (size_t)n * (size_t)fold->n_window, err));
    if (fold->has_errors) HS_TRY(hs_fold_reserve_errors(fold, n, err));
    fold->n = n;
    fold->n_added = 0;
    return HS_OK;
}

void hs_fold_add(hs_fold *fold, const double *values)
{
    const size_t n = (size_t)fold->n;
    ++fold->n_added;
    switch (fold->mode) {
    case HS_FOLD_ONE:
        memcpy(fold->sum, values, n * sizeof *values);
        break;
    case HS_FOLD_RUNNING:
        for (size_t k = 0; k < n; ++k) fold->sum[k] += values[k];
        break;
    case HS_FOLD_WINDOW:
        memcpy(fold->ring + (size_t)((fold->n_added - 1) % fold->n_window) * n, values, n * sizeof *values);
        /* summed anew: adding the new and subtracting the old one would let rounding errors grow */
        memset(fold->sum, 0, n * sizeof *fold->sum);
        for (int64_t w = 0; w < fold->n_window && w < fold->n_added; ++w)
            for (size_t k = 0; k < n; ++k) fold->sum[k] += fold->ring[(size_t)w * n + k];
        break;
    }
}

hs_status hs_fold_keep(hs_fold *fold, hs_state *state, hs_error *err)
{
    HS_TRY(hs_state_int64(state, "windows", &fold->n_added, 1, err));
    HS_TRY(hs_state_double(state, "sum of windows", fold->sum, fold->n, err));
    if (fold->mode != HS_FOLD_WINDOW) return HS_OK;
    return hs_state_double(state, "last windows", fold->ring, fold->n * fold->n_window, err);
}

double hs_fold_count(const hs_fold *fold)
{
    if (fold->mode == HS_FOLD_ONE) return 1.0;
    if (fold->mode == HS_FOLD_WINDOW && fold->n_added > fold->n_window) return (double)fold->n_window;
    return (double)fold->n_added;
}

void hs_fold_fini(hs_fold *fold)
{
    HS_FREE(fold->sum);
    HS_FREE(fold->ring);
    HS_FREE(fold->error);
    HS_FREE(fold->inefficiency);
    hs_series_set_fini(&fold->samples);
}

static hs_status set_text(char **text, const hs_args *args, int i, hs_error *err)
{
    HS_FREE(*text);
    return hs_memory_strdup(text, args->word[i], err);
}

static hs_status keyword_ave(hs_fold *fold, const hs_args *args, int i, int *n_used, hs_error *err)
{
    static const char *const modes[] = {"one", "running", "window", NULL};
    int mode;
    HS_TRY(hs_arg_need(args, i + 1, "one, running or window <M>", err));
    HS_TRY(hs_arg_choice(args, i + 1, modes, &mode, err));
    fold->mode = (hs_fold_mode)mode;
    *n_used = 2;
    if (fold->mode != HS_FOLD_WINDOW) return HS_OK;
    *n_used = 3;
    HS_TRY(hs_arg_need(args, i + 2, "the number of windows to average", err));
    return hs_arg_int(args, i + 2, 1, INT32_MAX, &fold->n_window, err);
}

static hs_status keyword_format(hs_average_file *file, const hs_args *args, int i, hs_error *err)
{
    HS_FREE(file->format);
    return hs_format_normalize(&file->format, args->word[i], HS_FORMAT_FLOAT, args->command, err);
}

hs_status hs_average_keyword(hs_schedule *schedule, hs_fold *fold, hs_average_file *file, const hs_args *args, int i,
                             int *n_used, hs_error *err)
{
    const char *word = args->word[i];
    *n_used = 0;
    if (fold != NULL && strcmp(word, "ave") == 0) return keyword_ave(fold, args, i, n_used, err);
    if (fold != NULL && strcmp(word, "error") == 0) {
        *n_used = 2;
        return hs_arg_bool(args, i + 1, &fold->has_errors, err);
    }
    if (file != NULL && strcmp(word, "overwrite") == 0) {
        file->overwrite = true;
        *n_used = 1;
        return HS_OK;
    }
    static const char *const others[] = {"start", "file", "append", "format", "title1", "title2", "title3", NULL};
    int k = 0;
    while (others[k] != NULL && strcmp(word, others[k]) != 0) ++k;
    if (others[k] == NULL) return HS_OK;
    *n_used = 2;
    HS_TRY(hs_arg_need(args, i + 1, "a word after the keyword", err));
    if (k == 0) return hs_arg_int(args, i + 1, 0, INT64_MAX / 4, &schedule->start, err);
    if (k == 3) return keyword_format(file, args, i + 1, err);
    if (k > 3) return set_text(&file->title[k - 4], args, i + 1, err);
    file->mode = k == 1 ? HS_WRITE_REPLACE : HS_WRITE_APPEND;
    return set_text(&file->name, args, i + 1, err);
}

static hs_status put_heads(hs_average_file *file, const char *const head[3], hs_error *err)
{
    for (int k = 0; k < 3; ++k) {
        const char *line = file->title[k] != NULL ? file->title[k] : head[k];
        if (line != NULL && head[k] != NULL) HS_TRY(hs_text_printf(&file->text, err, "%s\n", line));
    }
    return HS_OK;
}

hs_status hs_average_file_open(hs_average_file *file, const hs_env *env, const char *const head[3], hs_error *err)
{
    if (file->name == NULL || file->is_begun || env->dry_run) return HS_OK;
    const hs_write_mode fresh = file->overwrite ? HS_WRITE_REPLACE : file->mode;
    const hs_write_mode mode = env->is_resuming ? HS_WRITE_APPEND : fresh;
    file->is_begun = true;
    hs_status status = HS_OK;
    if (env->parallel->rank == 0) {
        status = hs_writer_open(&file->writer, file->name, mode, err);
        if (status == HS_OK) status = put_heads(file, head, err);
        if (status == HS_OK && !env->is_resuming)
            status = hs_writer_bytes(file->writer, hs_text_get(&file->text), file->text.length, err);
        if (status == HS_OK) status = hs_writer_commit(file->writer, err);
        /* with overwrite the heads come before each window */
        file->head_length = file->overwrite ? file->text.length : 0;
        if (!file->overwrite) hs_text_clear(&file->text);
    }
    if (hs_parallel_agree(env->parallel, err) != HS_OK) return status != HS_OK ? status : err->status;
    return HS_OK;
}

hs_status hs_average_file_number(hs_average_file *file, double value, hs_error *err)
{
    const char *format = file->format != NULL ? file->format : "%g";
    if (format[0] != ' ') HS_TRY(hs_text_append(&file->text, " ", 1, err));
    return hs_text_printf(&file->text, err, format, value);
}

/** The window alone: a new file that takes the place of the old one whole. */
static hs_status replace(hs_average_file *file, hs_error *err)
{
    hs_writer *writer;
    HS_TRY(hs_writer_open(&writer, file->name, HS_WRITE_WHOLE, err));
    hs_status status = hs_writer_bytes(writer, hs_text_get(&file->text), file->text.length, err);
    if (status == HS_OK) return hs_writer_close(&writer, err);
    hs_writer_abandon(&writer);
    return status;
}

hs_status hs_average_file_commit(hs_average_file *file, const hs_env *env, hs_error *err)
{
    if (file->name == NULL || env->dry_run) return HS_OK;
    hs_status status = HS_OK;
    if (file->writer != NULL) {
        if (file->overwrite) {
            status = replace(file, err);
            file->text.length = file->head_length;
            if (file->text.data != NULL) file->text.data[file->head_length] = '\0';
        } else {
            status = hs_writer_bytes(file->writer, hs_text_get(&file->text), file->text.length, err);
            if (status == HS_OK) status = hs_writer_commit(file->writer, err);
            hs_text_clear(&file->text);
        }
    }
    if (hs_parallel_agree(env->parallel, err) != HS_OK) return status != HS_OK ? status : err->status;
    return HS_OK;
}

hs_status hs_average_file_keep(hs_average_file *file, const hs_env *env, hs_state *state, hs_error *err)
{
    int64_t size = file->writer != NULL && !file->overwrite ? hs_writer_committed(file->writer) : -1;
    if (file->name == NULL) return HS_OK;
    hs_parallel_broadcast(env->parallel, 0, &size, sizeof size);
    HS_TRY(hs_state_bool(state, "file is begun", &file->is_begun, err));
    HS_TRY(hs_state_int64(state, "file size", &size, 1, err));
    if (!state->is_reading || file->writer == NULL) return HS_OK;
    if (!file->is_begun) {
        hs_writer_abandon(&file->writer); /* the run that was interrupted had not come to it */
        hs_text_clear(&file->text);
    } else if (!file->overwrite) {
        return hs_writer_cut(file->writer, size, err);
    }
    return HS_OK;
}

void hs_average_file_fini(hs_average_file *file)
{
    hs_writer_abandon(&file->writer); /* every piece was committed when it was written */
    for (int k = 0; k < 3; ++k) HS_FREE(file->title[k]);
    HS_FREE(file->name);
    HS_FREE(file->format);
    hs_text_fini(&file->text);
}
