/* Time correlations over very long times, with LAMMPS's words: fix ave/correlate/fft with levels. */
#include <string.h>

#include "base/memory.h"
#include "io/correlation.h"

enum { N_LEVELS = 20, N_LAGS = 16 };

typedef struct long_state {
    hs_correlation table; /**< first, as io/correlation.h wants it */
    hs_correlation_tau sums;
} long_state;

static const hs_keyword keywords[] = {
    HS_CORRELATION_KEYWORDS,
    {"nlen", 1, "<N>", "lags of each level, an even number (default: 16)"},
    {"ncorr", 1, "<L>", "levels (default: 20)"},
    {"ncount", 1, "2", "samples of a level that make one of the next"},
    {NULL, 0, NULL, NULL},
};

static hs_status read_keywords(hs_fix *fix, const hs_args *args, int64_t *n_lags, hs_error *err)
{
    long_state *state = fix->state;
    *n_lags = N_LAGS;
    state->sums.n_levels = N_LEVELS;
    for (int i = hs_syntax_first_keyword(&fix->style->about.syntax, args), n_used; i < args->n; i += n_used) {
        HS_TRY(hs_correlation_keyword(fix, args, i, &n_used, err));
        if (n_used > 0) continue;
        n_used = 2;
        if (strcmp(args->word[i], "nlen") == 0) {
            HS_TRY(hs_arg_int(args, i + 1, 2, 1 << 28, n_lags, err));
            if (*n_lags % 2 != 0) return hs_arg_refuse(args, i + 1, "an even number", NULL, err);
        } else if (strcmp(args->word[i], "ncorr") == 0) {
            HS_TRY(hs_arg_int(args, i + 1, 1, 40, &state->sums.n_levels, err));
        } /* else ncount: the syntax allows 2 only */
    }
    return HS_OK;
}

/** The file's second line. */
static hs_status make_head(const hs_fix *fix, hs_correlation *table, hs_error *err)
{
    hs_text head = {0};
    hs_status status = hs_text_printf(&head, err, "# Time");
    for (int k = 0; k < table->n_columns && status == HS_OK; ++k) {
        static const char *const suffixes[] = {"", "_err", "_ineff"};
        status = hs_text_printf(&head, err, " ");
        if (status == HS_OK) status = hs_correlation_product(&head, fix, k % table->n_pairs, err);
        if (status == HS_OK) status = hs_text_printf(&head, err, "%s", suffixes[k / table->n_pairs]);
    }
    if (status == HS_OK) status = hs_memory_replace(&table->head, hs_text_get(&head), err);
    hs_text_fini(&head);
    return status;
}

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    long_state *state = fix->state;
    hs_correlation *table = &state->table;
    const int n_words = hs_syntax_first_keyword(&fix->style->about.syntax, args) - 2;
    int64_t n_lags;
    table->prefactor = 1.0;
    HS_TRY(hs_arg_int(args, 0, 1, INT32_MAX, &table->every, err));
    HS_TRY(hs_arg_int(args, 1, 1, INT64_MAX / 4, &table->freq, err));
    if (table->freq % table->every != 0)
        return hs_arg_refuse(args, 1, "a multiple of the steps between samples (Nevery)", NULL, err);
    HS_TRY(hs_values_create(&table->values, &table->n_values, fix->env, args, 2, n_words, HS_VALUE_NUMBER, err));
    HS_TRY(read_keywords(fix, args, &n_lags, err));
    HS_TRY(hs_correlation_pair(fix, args, err));
    HS_TRY(hs_correlation_tau_of_pairs(fix, &state->sums, (int)n_lags, err));
    return make_head(fix, table, err);
}

static void destroy(hs_fix *fix)
{
    long_state *state = fix->state;
    hs_correlation_tau_fini(&state->sums);
    hs_correlation_fini(&state->table);
}

static hs_status init(hs_fix *fix, hs_error *err)
{
    return hs_correlation_init(fix, "Time-correlated data", NULL, err);
}

/** Rows of lags that have samples: the time, and a column for each pair. */
static hs_status write_rows(hs_fix *fix, hs_error *err)
{
    hs_correlation *table = fix->state;
    hs_average_file *file = &table->file;
    HS_TRY(hs_text_printf(&file->text, err, "# Timestep: %lld\n", (long long)fix->env->step));
    for (int row = 0; row < table->n_rows; ++row) {
        if (!(table->count[row] > 0.0)) continue;
        HS_TRY(hs_text_printf(&file->text, err, "%.10g", table->x[row] * fix->env->dt));
        for (int k = 0; k < table->n_columns; ++k)
            HS_TRY(
                hs_average_file_number(file, table->result[(size_t)row * (size_t)table->n_columns + (size_t)k], err));
        HS_TRY(hs_text_append(&file->text, "\n", 1, err));
    }
    return HS_OK;
}

static hs_status end_of_step(hs_fix *fix, hs_error *err)
{
    long_state *state = fix->state;
    bool is_due;
    HS_TRY(hs_correlation_tau_sample(fix, &state->sums, &is_due, err));
    if (!is_due) return HS_OK;
    hs_correlation_scale(&state->table);
    if (hs_average_file_is_open(&state->table.file)) HS_TRY(write_rows(fix, err));
    return hs_average_file_commit(&state->table.file, fix->env, err);
}

static hs_status keep_state(hs_fix *fix, hs_state *kept, hs_error *err)
{
    return hs_correlation_tau_keep(fix, &((long_state *)fix->state)->sums, kept, err);
}

const hs_fix_style hs_fix_style_ave_correlate_long = {
    .about = {.name = "ave/correlate/long",
              .syntax = {.usage = "<Nevery> <Nfreq> <value> ... [keyword value ...]",
                         .n_min = 3,
                         .n_max = -1,
                         .keywords = keywords},
              .summary = "time correlations of numbers over very long times, with LAMMPS's words",
              .details =
                  "As `fix ave/correlate/fft Nevery 16 Nfreq <value> ... levels 20`: sixteen lags on each of twenty "
                  "grids, each twice as coarse as the one before, whose samples are means of two. `nlen` and `ncorr` "
                  "change these numbers; the longest lag is (nlen - 1) 2^(ncorr - 1) samples.\n\n"
                  "Every Nfreq steps the file gets the step and a row for each lag that has samples: the lag as a "
                  "time, and one column for each pair of values (`type`); with `overwrite` it holds the last output "
                  "only. `error yes` adds standard errors and inefficiencies. The array `f_ID[i][j]` has the columns "
                  "lag in steps, number of samples, and those of the pairs. The group has no meaning.",
              .reference = "J. Ramirez et al., J. Chem. Phys. 133, 154103 (2010), doi:10.1063/1.3491098",
              .example =
                  "variable pxy equal pxy\nfix S all ave/correlate/long 5 100000 v_pxy file stress.corr overwrite"},
    .state_size = sizeof(long_state),
    HS_CORRELATION_HOOKS,
};
