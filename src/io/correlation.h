/** What fixes share that turn series of numbers into functions: of the time lag (correlations) or of the frequency
 *  (spectra). Which values, sampled when; the table of the function at the last output, and its file. */
#ifndef HS_IO_CORRELATION_H
#define HS_IO_CORRELATION_H

#include "core/multi_tau.h"
#include "io/average.h"
#include "style/value.h"

/** The state of such a fix begins with this. */
typedef struct hs_correlation {
    int64_t every, freq, next; /**< steps between samples and between outputs; step of the next sample */
    hs_schedule schedule;      /**< keyword start only */
    hs_value *values;          /**< owned [n_values] */
    int n_values;
    int type;       /**< which pairs; keyword type */
    int (*pair)[2]; /**< owned [n_pairs] */
    int n_pairs;
    double prefactor;
    bool has_errors; /**< keyword error: for each pair a value, then for each an error, then for each an inefficiency */
    int n_rows, n_columns;
    double *x;      /**< owned [n_rows]: lag in steps, or frequency */
    double *count;  /**< owned [n_rows]: samples, as of the last output */
    double *result; /**< owned [n_rows][n_columns], the same */
    hs_average_file file;
    char *head; /**< owned; names of columns */
} hs_correlation;

/** Read <Nevery> <N> <Nfreq>; *n within n_min and n_max. */
HS_MUST_USE hs_status hs_correlation_numbers(hs_fix *fix, const hs_args *args, int64_t n_min, int64_t n_max, int64_t *n,
                                             hs_error *err);
/** Read the values, from word 3 up to the first keyword. */
HS_MUST_USE hs_status hs_correlation_values(hs_fix *fix, const hs_args *args, hs_error *err);
/** Keywords of all: type, prefactor, error, and those of files. *n_used = words taken, 0 when the keyword is
 *  another. */
HS_MUST_USE hs_status hs_correlation_keyword(hs_fix *fix, const hs_args *args, int i, int *n_used, hs_error *err);
#define HS_CORRELATION_KEYWORDS                                                                                        \
    {"type", 1, "auto|upper|lower|auto/upper|auto/lower|full",                                                         \
     "each value with itself, pairs i < j, pairs i > j, both kinds, or all (default: auto)"},                          \
        {"prefactor", 1, "<number>", "correlations are multiplied by it (default: 1)"},                                \
        {"error", 1, "yes|no", "standard errors and inefficiencies, too (default: no)"},                               \
        {"start", 1, "<step>", "no sample before this step (default: 0)"},                                             \
        {"file", 1, "<output-file>", "write correlations to this file"},                                               \
        {"append", 1, "<output-file>", "the same, added to what is there"},                                            \
        {"overwrite", 0, "", "the file holds the last output only"},                                                   \
        {"title1", 1, "<text>", "first line of the file"}, {"title2", 1, "<text>", "second line"},                     \
    {                                                                                                                  \
        "title3", 1, "<text>", "third line"                                                                            \
    }
/** After the keywords: the pairs. */
HS_MUST_USE hs_status hs_correlation_pair(hs_fix *fix, const hs_args *args, hs_error *err);
/** Append the name of column k (of a pair, without errors) to the head. */
typedef hs_status (*hs_correlation_name)(hs_text *head, const hs_fix *fix, int k, hs_error *err);
/** "V_i*V_j" of pair k. */
HS_MUST_USE hs_status hs_correlation_product(hs_text *head, const hs_fix *fix, int k, hs_error *err);
/** Room for n_rows rows of n_pairs columns (thrice as many with errors), the array f_ID[i][j] (x, count, columns), and
 *  the head: @p x_name for the first column, @p name for the others. */
HS_MUST_USE hs_status hs_correlation_table(hs_fix *fix, int n_rows, const char *x_name, hs_correlation_name name,
                                           hs_error *err);
void hs_correlation_fini(hs_correlation *c);

/** Check the values and open the file; for hs_fix_style.init. Its second line tells of the outputs' first lines, "Number-of-" and
 *  @p rows, and the third is the head; with rows NULL the head is the second line. */
HS_MUST_USE hs_status hs_correlation_init(hs_fix *fix, const char *title, const char *rows, hs_error *err);
/** Whether a sample is due now; if so it is taken: sample[n_values] (collective). */
HS_MUST_USE hs_status hs_correlation_sample(hs_fix *fix, double *sample, bool *is_due, hs_error *err);
/** Whether an output is due at this step, after the sample. */
static inline bool hs_correlation_is_output_due(const hs_fix *fix)
{
    return fix->env->step % ((const hs_correlation *)fix->state)->freq == 0;
}
/** Multiply the result by the prefactor. */
void hs_correlation_scale(hs_correlation *c);
/** x, count and result were brought up to date: multiply by the prefactor and write (collective). */
HS_MUST_USE hs_status hs_correlation_finish(hs_fix *fix, hs_error *err);
HS_MUST_USE hs_status hs_correlation_keep(hs_fix *fix, hs_state *kept, hs_error *err);

/** What those need that use core/multi_tau.h, one column for each pair. Zero-initialised; fini frees it. */
typedef struct hs_correlation_tau {
    hs_multi_tau tau; /**< made by the fix, between levels and create */
    int64_t n_levels;
    double *sample; /**< owned [tau.n_values]: to be filled with the present sample */
    double *means;  /**< owned [3][n_rows][n_pairs]: values, errors, inefficiencies */
} hs_correlation_tau;
#define HS_CORRELATION_LEVELS                                                                                          \
    {                                                                                                                  \
        "levels", 1, "<number>", "go on beyond the window on so many grids in all, each twice as coarse (default: 1)"  \
    }
/** Read all keywords: `levels` and those of all. The file holds the last output. */
HS_MUST_USE hs_status hs_correlation_tau_keywords(hs_fix *fix, hs_correlation_tau *t, const hs_args *args,
                                                  int64_t n_lags, hs_error *err);
/** The table, a row for each lag, and room for sample and means. */
HS_MUST_USE hs_status hs_correlation_tau_create(hs_fix *fix, hs_correlation_tau *t, hs_correlation_name name,
                                                hs_error *err);
/** The correlator of all pairs of the deck's values (after hs_correlation_pair), and these. */
HS_MUST_USE hs_status hs_correlation_tau_of_pairs(hs_fix *fix, hs_correlation_tau *t, int n_lags, hs_error *err);
void hs_correlation_tau_fini(hs_correlation_tau *t);
/** At the end of a step, for fixes whose sample are the values of the deck: take it in, and where output is due (*is_due) bring count
 *  and result up to date (collective). */
HS_MUST_USE hs_status hs_correlation_tau_sample(hs_fix *fix, hs_correlation_tau *t, bool *is_due, hs_error *err);
/** Bring count and result up to date. */
void hs_correlation_tau_take(hs_fix *fix, hs_correlation_tau *t);
/** Table and sums (hook keep_state). */
HS_MUST_USE hs_status hs_correlation_tau_keep(hs_fix *fix, hs_correlation_tau *t, hs_state *kept, hs_error *err);

/* Hooks as they stand in hs_fix_style, and the rest of the descriptor. */
bool hs_correlation_needs_energy(const hs_fix *fix, int64_t step);
HS_MUST_USE hs_status hs_correlation_array(hs_fix *fix, int i, int j, double *value, hs_error *err);
#define HS_CORRELATION_HOOKS                                                                                           \
    .create = create, .destroy = destroy, .init = init, .measure_at_setup = end_of_step, .end_of_step = end_of_step,   \
    .keep_state = keep_state, .array = hs_correlation_array, .needs_energy = hs_correlation_needs_energy,              \
    .is_time_dependent = true, .keeps_plane = true

#endif
