/* Power spectra of numbers: averaged periodograms of half-overlapping segments.
 * Source: P. D. Welch, IEEE Trans. Audio Electroacoust. 15, 70 (1967), doi:10.1109/TAU.1967.1161901. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "core/fourier.h"
#include "io/correlation.h"

typedef struct spectrum_state {
    hs_correlation table; /**< first, as io/correlation.h wants it */
    int n;                /**< samples of a segment */
    bool has_window, keeps_mean;
    hs_periodogram *periodogram; /**< owned */
    double *sample;              /**< owned [n_values]: the latest */
    double *segment;             /**< owned [n_values][n] */
    int n_present;               /**< samples of the segment that are there */
    int64_t n_segments;
    double *sum;          /**< owned [n_rows][n_values]: of periodograms */
    double *power;        /**< owned [n_rows][n_values]: of the latest segment */
    hs_series_set powers; /**< of [n_rows][n_values], with keyword error */
} spectrum_state;

static const hs_keyword keywords[] = {
    {"window", 1, "hann|none", "weights of the samples of a segment (default: hann)"},
    {"mean", 1, "subtract|keep", "take the mean of each segment off first, or not (default: subtract)"},
    {"error", 1, "yes|no", "standard errors and inefficiencies, too (default: no)"},
    {"start", 1, "<step>", "no sample before this step (default: 0)"},
    {"file", 1, "<output-file>", "write spectra to this file, which holds the last output"},
    {"title1", 1, "<text>", "first line of the file"},
    {"title2", 1, "<text>", "second line"},
    {"title3", 1, "<text>", "third line"},
    {NULL, 0, NULL, NULL},
};

static hs_status read_keywords(hs_fix *fix, const hs_args *args, hs_error *err)
{
    static const char *const windows[] = {"hann", "none", NULL}, *const means[] = {"subtract", "keep", NULL};
    spectrum_state *state = fix->state;
    int window = 0, mean = 0;
    state->table.file.overwrite = true;
    for (int i = hs_syntax_first_keyword(&fix->style->about.syntax, args), n_used; i < args->n; i += n_used) {
        HS_TRY(hs_correlation_keyword(fix, args, i, &n_used, err));
        if (n_used > 0) continue;
        n_used = 2;
        if (strcmp(args->word[i], "window") == 0)
            HS_TRY(hs_arg_choice(args, i + 1, windows, &window, err));
        else
            HS_TRY(hs_arg_choice(args, i + 1, means, &mean, err));
    }
    state->has_window = window == 0;
    state->keeps_mean = mean == 1;
    return HS_OK;
}

/** power(v_x) */
static hs_status put_name(hs_text *head, const hs_fix *fix, int k, hs_error *err)
{
    return hs_text_printf(head, err, "power(%s)", ((const hs_correlation *)fix->state)->values[k].word);
}

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    spectrum_state *state = fix->state;
    hs_correlation *table = &state->table;
    int64_t n;
    HS_TRY(hs_correlation_numbers(fix, args, 4, 1 << 28, &n, err));
    HS_TRY(hs_correlation_values(fix, args, err));
    HS_TRY(read_keywords(fix, args, err));
    if (n % 2 != 0)
        return hs_fail(err, HS_ERROR_INPUT,
                       "%s: a segment must have an even number of samples (Nsegment): %lld has no middle where the "
                       "next could begin",
                       args->command, (long long)n);
    state->n = (int)n;
    HS_TRY(hs_correlation_pair(fix, args, err));
    HS_TRY(hs_correlation_table(fix, state->n / 2 + 1, "Frequency", put_name, err));
    const size_t n_values = (size_t)table->n_values, n_all = (size_t)table->n_rows * n_values;
    HS_TRY(hs_periodogram_create(&state->periodogram, state->n, state->has_window, !state->keeps_mean, err));
    HS_TRY(HS_ALLOC(state->sample, n_values, err));
    HS_TRY(HS_ALLOC(state->segment, (size_t)n * n_values, err));
    HS_TRY(HS_ALLOC(state->sum, n_all, err));
    state->powers.n_series = table->has_errors ? (int)n_all : 0;
    return HS_ALLOC(state->power, n_all, err);
}

static void destroy(hs_fix *fix)
{
    spectrum_state *state = fix->state;
    hs_periodogram_destroy(&state->periodogram);
    HS_FREE(state->sample);
    HS_FREE(state->segment);
    HS_FREE(state->sum);
    HS_FREE(state->power);
    hs_series_set_fini(&state->powers);
    hs_correlation_fini(&state->table);
}

static hs_status init(hs_fix *fix, hs_error *err)
{
    return hs_correlation_init(fix, "Power spectra", "frequencies", err);
}

/** The segment is full: its periodograms are added, and its second half becomes the first of the next. */
static hs_status end_segment(spectrum_state *state, hs_error *err)
{
    const size_t n = (size_t)state->n, n_values = (size_t)state->table.n_values, n_rows = (size_t)state->table.n_rows;
    for (size_t v = 0; v < n_values; ++v) {
        double *segment = state->segment + v * n;
        hs_periodogram_eval(state->periodogram, segment, state->power + v, (int)n_values);
        memmove(segment, segment + n / 2, n / 2 * sizeof *segment);
    }
    for (size_t k = 0; k < n_rows * n_values; ++k) state->sum[k] += state->power[k];
    state->n_present = state->n / 2;
    ++state->n_segments;
    return hs_series_set_add(&state->powers, state->power, NULL, err);
}

/** Periodograms are per sample; as densities they are per unit of frequency, 1/(time between samples). */
static hs_status finish(hs_fix *fix, hs_error *err)
{
    spectrum_state *state = fix->state;
    hs_correlation *table = &state->table;
    const double dt = (double)table->every * fix->env->dt, n_segments = (double)state->n_segments;
    const int n_values = table->n_values;
    for (int row = 0; row < table->n_rows; ++row) {
        double *result = table->result + (size_t)row * (size_t)table->n_columns;
        table->x[row] = row / (state->n * dt);
        table->count[row] = n_segments;
        for (int v = 0; v < n_values && n_segments > 0.0; ++v) {
            const int k = row * n_values + v;
            result[v] = dt * state->sum[k] / n_segments;
            if (!table->has_errors) continue;
            const hs_estimate e = hs_series_set_estimate(&state->powers, k);
            result[n_values + v] = e.n > 1 ? dt * e.error : NAN;
            result[2 * n_values + v] = e.n > 1 ? e.inefficiency : NAN;
        }
    }
    return hs_correlation_finish(fix, err);
}

static hs_status end_of_step(hs_fix *fix, hs_error *err)
{
    spectrum_state *state = fix->state;
    bool is_due;
    HS_TRY(hs_correlation_sample(fix, state->sample, &is_due, err));
    if (!is_due) return HS_OK;
    for (int v = 0; v < state->table.n_values; ++v)
        state->segment[(size_t)v * (size_t)state->n + (size_t)state->n_present] = state->sample[v];
    if (++state->n_present == state->n) HS_TRY(end_segment(state, err));
    return hs_correlation_is_output_due(fix) ? finish(fix, err) : HS_OK;
}

static hs_status keep_state(hs_fix *fix, hs_state *kept, hs_error *err)
{
    spectrum_state *state = fix->state;
    const int64_t n_values = state->table.n_values;
    HS_TRY(hs_state_int(kept, "samples of the segment", &state->n_present, err));
    HS_TRY(hs_state_int64(kept, "segments", &state->n_segments, 1, err));
    HS_TRY(hs_state_double(kept, "segment", state->segment, state->n * n_values, err));
    HS_TRY(hs_state_double(kept, "sums", state->sum, state->table.n_rows * n_values, err));
    HS_TRY(hs_series_set_keep(&state->powers, kept, "errors", err));
    return hs_correlation_keep(fix, kept, err);
}

const hs_fix_style hs_fix_style_ave_spectrum = {
    .about = {.name = "ave/spectrum",
              .syntax = {.usage = "<Nevery> <Nsegment> <Nfreq> <value> ... [keyword value ...]",
                         .n_min = 4,
                         .n_max = -1,
                         .keywords = keywords},
              .summary = "power spectra of numbers",
              .details = "Values are numbers: `c_ID`, `c_ID[i]`, `f_ID`, `f_ID[i]`, `v_name`, ranges as in `c_ID[*]`, "
                         "sampled every Nevery steps. Segments of Nsegment samples (an even number; one of small prime "
                         "factors is fastest), each beginning in the middle of the one before, are Fourier "
                         "transformed, and the squares averaged over all segments: Welch's method. Memory is that of "
                         "one segment. Results come every Nfreq steps; the file holds the last ones.\n\n"
                         "The array `f_ID[i][j]` has Nsegment/2 + 1 rows: the frequency k/(Nsegment Nevery dt) "
                         "(1/time; not the angular one), the number of segments, and for each value the power spectral "
                         "density P (value^2 time), one-sided: the integral of P over all frequencies is the variance. "
                         "With `mean keep` it is the mean square, and P at frequency 0 holds the mean. A sharp line is "
                         "as wide as a few rows: more samples a segment resolve more, more segments scatter less.\n\n"
                         "`window hann` weights samples by sin^2, which keeps strong lines from spilling over the "
                         "whole spectrum; `none` takes segments as they are. With `error yes` a column of standard "
                         "errors for each value follows, by blocking over the segments, and then one of inefficiencies "
                         "(segments that count as one). The group has no meaning. The timestep must stay the same.",
              .reference = "P. D. Welch, IEEE Trans. Audio Electroacoust. 15, 70 (1967), doi:10.1109/TAU.1967.1161901",
              .example = "compute v all vacf\nvariable pxy equal pxy\nfix S all ave/spectrum 2 1000 100000 v_pxy "
                         "c_thermo_temp error yes file spectrum.dat"},
    .state_size = sizeof(spectrum_state),
    HS_CORRELATION_HOOKS,
};
