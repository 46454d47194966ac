/** What the averaging fixes share: when samples are taken, how windows follow one another, and the text files. */
#ifndef HS_IO_AVERAGE_H
#define HS_IO_AVERAGE_H

#include "base/text.h"
#include "core/statistics.h"
#include "io/writer.h"
#include "style/args.h"
#include "style/env.h"
#include "style/state.h"

/** Samples every `every` steps; `repeat` of them make a window that ends at each multiple of `freq`. */
typedef struct hs_schedule {
    int64_t every, repeat, freq;
    int64_t start;   /**< no window ends before this step */
    int64_t next;    /**< step of the next sample */
    int64_t n_taken; /**< samples of the present window */
} hs_schedule;

/** Read Nevery Nrepeat Nfreq from words first, first + 1, first + 2; windows that do not fit are refused. */
HS_MUST_USE hs_status hs_schedule_init(hs_schedule *schedule, const hs_args *args, int first, hs_error *err);
/** Set the first sample at or after a step. */
void hs_schedule_begin(hs_schedule *schedule, int64_t step);
/** The same when samples would be due before @p step: steps may have passed since the fix was made. */
static inline void hs_schedule_renew(hs_schedule *schedule, int64_t step)
{
    if (schedule->next < step) hs_schedule_begin(schedule, step);
}
/** For keep_state of a fix. */
HS_MUST_USE hs_status hs_schedule_keep(hs_schedule *schedule, hs_state *state, hs_error *err);
/** Whether a sample is due on that step. */
static inline bool hs_schedule_is_due(const hs_schedule *schedule, int64_t step) { return step == schedule->next; }
/** A sample was taken now: sets the next; true when the window is complete. */
bool hs_schedule_advance(hs_schedule *schedule, int64_t step);

typedef enum { HS_FOLD_ONE, HS_FOLD_RUNNING, HS_FOLD_WINDOW } hs_fold_mode;

/** Sums of windows that follow one another: of the last, of all, or of the last few. */
typedef struct hs_fold {
    hs_fold_mode mode;
    int64_t n_window; /**< windows kept in mode HS_FOLD_WINDOW */
    int64_t n_added;  /**< windows so far */
    int n;            /**< values of a window */
    double *sum;      /**< owned [n] */
    double *ring;     /**< owned [n_window][n] */

    bool has_errors;       /**< keyword error: what follows is in use */
    bool is_share;         /**< errors are those of the values as parts of value 0, the total */
    hs_series_set samples; /**< of the present window, or of all (ave running) */
    double *error; /**< owned [n]: standard errors of the means after the last window; NaN: one sample shows none */
    double *inefficiency; /**< owned [n]: samples (ave window: windows) that count as one */
} hs_fold;

/** Make room for windows of n values; forgets what was there when n changes. */
HS_MUST_USE hs_status hs_fold_reserve(hs_fold *fold, int n, hs_error *err);
/** Add a window; sum[] then holds the sums over the windows that count, hs_fold_count how many these are. */
void hs_fold_add(hs_fold *fold, const double *values);
double hs_fold_count(const hs_fold *fold);
/** Refuse `error yes` where a mean is made of one sample. */
HS_MUST_USE hs_status hs_fold_check_errors(const hs_fold *fold, const hs_schedule *schedule, const char *command,
                                           hs_error *err);
/** Room for the errors of n values; forgets what was there. hs_fold_reserve does it. */
HS_MUST_USE hs_status hs_fold_reserve_errors(hs_fold *fold, int n, hs_error *err);
/** One sample of all n values, as hs_series_set_add takes it; nothing without `error yes`. Before hs_fold_add. */
HS_MUST_USE hs_status hs_fold_add_sample(hs_fold *fold, const double *values, const double *weights, hs_error *err);
/** The errors of what hs_fold_add has made; ave one: the next window begins. */
void hs_fold_find_errors(hs_fold *fold);
/** For keep_state of a fix, beside hs_fold_keep. */
HS_MUST_USE hs_status hs_fold_keep_errors(hs_fold *fold, hs_state *state, hs_error *err);
/** A set of series in a checkpoint, as the value of that name. */
HS_MUST_USE hs_status hs_series_set_keep(hs_series_set *set, hs_state *state, const char *name, hs_error *err);
/** For keep_state of a fix; room must have been made. */
HS_MUST_USE hs_status hs_fold_keep(hs_fold *fold, hs_state *state, hs_error *err);
void hs_fold_fini(hs_fold *fold);

/** The output file of an averaging fix and its settings. */
typedef struct hs_average_file {
    char *name; /**< owned; NULL: none */
    hs_write_mode mode;
    bool overwrite;     /**< the file holds the last window only */
    char *title[3];     /**< owned; NULL: the fix's own */
    char *format;       /**< owned; of one number, with a blank before it */
    bool is_begun;      /**< hs_average_file_open was done, on all ranks */
    hs_writer *writer;  /**< owned; NULL on other ranks than the first */
    hs_text text;       /**< lines of the present piece */
    size_t head_length; /**< with overwrite: of the heads, which every piece begins with */
} hs_average_file;

/** Common keywords: ave, error, start, file, append, overwrite, format, title1, title2, title3. *n_used = words taken,
 *  0 when the keyword is another. Pieces may be NULL when the fix has none. */
HS_MUST_USE hs_status hs_average_keyword(hs_schedule *schedule, hs_fold *fold, hs_average_file *file,
                                         const hs_args *args, int i, int *n_used, hs_error *err);
/** These keywords, and after them the style's own, for its syntax. */
#define HS_AVERAGE_KEYWORDS                                                                                            \
    {"ave", -1, "one|running|window <M>", "average each window alone, all so far, or the last M (default: one)"},      \
        {"error", 1, "yes|no", "standard errors and inefficiencies of the means, too (default: no)"},                  \
        {"start", 1, "<step>", "no window ends before this step (default: 0)"},                                        \
        {"file", 1, "<output-file>", "write windows to this file"},                                                    \
        {"append", 1, "<output-file>", "the same, added to what is there"},                                            \
        {"overwrite", 0, "", "the file holds the last window only"},                                                   \
        {"format", 1, "<format>", "of a number, as for printf (default: %g)"},                                         \
        {"title1", 1, "<text>", "first line of the file"}, {"title2", 1, "<text>", "second line"},                     \
    {                                                                                                                  \
        "title3", 1, "<text>", "third line"                                                                            \
    }

/** Open the file and write its heads (title or, when none was given, head; NULL: no such line). Once; nothing in a dry
 *  run or on other ranks than the first. A resumed run finds the file with its heads and adds to it. */
HS_MUST_USE hs_status hs_average_file_open(hs_average_file *file, const hs_env *env, const char *const head[3],
                                           hs_error *err);
/** Whether this rank writes. */
static inline bool hs_average_file_is_open(const hs_average_file *file) { return file->writer != NULL; }
/** Names of columns for the errors and inefficiencies of n means: `NAME_err`..., then `NAME_ineff`.... */
typedef const char *(*hs_name_of)(const void *context, int k);
HS_MUST_USE hs_status hs_average_error_head(hs_text *head, int n, hs_name_of name, const void *context, hs_error *err);
/** A table of means for people: its head, a row for each, its foot. */
void hs_average_say_head(hs_sink *out, const char *title);
void hs_average_say_row(hs_sink *out, const char *name, const hs_estimate *estimate);
/** What the star at some rows means; nothing unless a row had one. */
void hs_average_say_foot(hs_sink *out, bool is_uncertain);
/** Append to the present piece. */
HS_MUST_USE hs_status hs_average_file_number(hs_average_file *file, double value, hs_error *err);
/** The piece is complete: write it. Collective: a failure stops all ranks. */
HS_MUST_USE hs_status hs_average_file_commit(hs_average_file *file, const hs_env *env, hs_error *err);
/** For keep_state of a fix: a resumed run cuts off what was written after the checkpoint. Collective. */
HS_MUST_USE hs_status hs_average_file_keep(hs_average_file *file, const hs_env *env, hs_state *state, hs_error *err);
void hs_average_file_fini(hs_average_file *file);

#endif
