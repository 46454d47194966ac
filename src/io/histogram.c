#include "io/histogram.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "core/exact_sum.h"

const double hs_histogram_nothing[2] = {1e20, -1e20};

void hs_histogram_destroy(hs_fix *fix)
{
    hs_histogram *histogram = fix->state;
    hs_atom_sources_destroy(&histogram->inputs, histogram->n_inputs);
    HS_FREE(histogram->count);
    HS_FREE(histogram->extremes);
    HS_FREE(histogram->value);
    HS_FREE(histogram->weight);
    hs_fold_fini(&histogram->fold);
    hs_average_file_fini(&histogram->file);
}

hs_status hs_histogram_init(hs_fix *fix, hs_error *err)
{
    hs_histogram *histogram = fix->state;
    char title[160];
    HS_TRY(hs_histogram_check(fix, hs_fix_who(fix).text, err));
    snprintf(title, sizeof title, "# Histogrammed data for fix %.100s", fix->id);
    const char *const head[3] = {title, "# TimeStep Number-of-bins Total-counts Missing-counts Min-value Max-value",
                                 histogram->fold.has_errors
                                     ? "# Bin Coord Count Count/Total Count/Total_err Count/Total_ineff"
                                     : "# Bin Coord Count Count/Total"};
    return hs_average_file_open(&histogram->file, fix->env, head, err);
}

bool hs_histogram_needs_energy(const hs_fix *fix, int64_t step)
{
    const hs_histogram *histogram = fix->state;
    return hs_schedule_is_due(&histogram->schedule, step) &&
           hs_atom_sources_need_energy(fix->env, histogram->inputs, histogram->n_inputs);
}

/* Counting */

/** Bin of a value; -1: none. */
static int bin_of(const hs_histogram *histogram, double value)
{
    const int last = histogram->n_bins - 1;
    if (value < histogram->lo) return histogram->beyond == HS_BEYOND_IGNORE ? -1 : 0;
    if (value > histogram->hi) return histogram->beyond == HS_BEYOND_IGNORE ? -1 : last;
    const int bin = (int)((value - histogram->lo) * (1.0 / histogram->width));
    if (histogram->beyond != HS_BEYOND_EXTRA) return bin < last ? bin : last;
    return (bin < last - 2 ? bin : last - 2) + 1;
}

/** Add values (with weights) to counts. Only atoms of the group count, when there is a mask. */
static void count_plain(const hs_histogram *histogram, const hs_fix *fix, int64_t n, double *count)
{
    const uint32_t *mask = histogram->shape == HS_VALUE_ATOMS ? fix->env->atoms->mask : NULL;
    for (int64_t i = 0; i < n; ++i) {
        if (mask != NULL && !(mask[i] & fix->mask)) continue;
        const int bin = bin_of(histogram, histogram->value[i]);
        ++count[bin < 0 ? HS_HISTO_MISSING : HS_HISTO_TOTAL];
        if (bin >= 0) ++count[HS_HISTO_BINS + bin];
    }
}

/** The same with weights, whose sums are exact, so that the order of the atoms does not matter. */
static void count_weights(const hs_histogram *histogram, const hs_fix *fix, int64_t n, hs_exact_sum *count)
{
    const uint32_t *mask = histogram->shape == HS_VALUE_ATOMS ? fix->env->atoms->mask : NULL;
    for (int64_t i = 0; i < n; ++i) {
        if (mask != NULL && !(mask[i] & fix->mask)) continue;
        const int bin = bin_of(histogram, histogram->value[i]);
        hs_exact_add(&count[bin < 0 ? HS_HISTO_MISSING : HS_HISTO_TOTAL], histogram->weight[i]);
        if (bin >= 0) hs_exact_add(&count[HS_HISTO_BINS + bin], histogram->weight[i]);
    }
}

/** Whether each rank has values of its own: all others are the same on all ranks. */
static bool is_spread(const hs_histogram *histogram)
{
    return histogram->shape == HS_VALUE_ATOMS || histogram->shape == HS_VALUE_LOCAL;
}

/** Room for n values of an input, or for their weights. */
static hs_status make_room(hs_histogram *histogram, bool is_weight, int64_t n, double **out, hs_error *err)
{
    HS_TRY(is_weight ? HS_RESERVE(histogram->weight, histogram->capacity_weight, (size_t)n, err)
                     : HS_RESERVE(histogram->value, histogram->capacity_value, (size_t)n, err));
    *out = is_weight ? histogram->weight : histogram->value;
    return HS_OK;
}

static hs_status read_local(hs_fix *fix, const hs_atom_source *input, bool is_weight, int64_t *n, hs_error *err)
{
    hs_histogram *histogram = fix->state;
    const hs_local_rows *rows;
    const double *column;
    double *out;
    HS_TRY(hs_value_local(fix->env, &input->value, &rows, &column, err));
    *n = rows->n;
    HS_TRY(make_room(histogram, is_weight, *n, &out, err));
    if (*n > 0) memcpy(out, column, (size_t)*n * sizeof *out);
    return HS_OK;
}

/** Fail unless values and weights are of the same rows. */
static hs_status check_weights(hs_fix *fix, hs_error *err)
{
    const hs_histogram *histogram = fix->state;
    const hs_value *value = &histogram->inputs[0].value, *weight = &histogram->inputs[1].value;
    return histogram->shape == HS_VALUE_LOCAL ? hs_values_check_rows(fix->env, value, weight, hs_fix_who(fix).text, err)
                                              : HS_OK;
}

/** values[0 .. *n) of one input on this rank. */
static hs_status read_input(hs_fix *fix, const hs_atom_source *input, bool is_weight, int64_t *n, hs_error *err)
{
    hs_histogram *histogram = fix->state;
    hs_env *env = fix->env;
    double *out;
    if (histogram->shape == HS_VALUE_LOCAL) return read_local(fix, input, is_weight, n, err);
    if (histogram->shape == HS_VALUE_VECTOR) HS_TRY(hs_value_refresh(env, &input->value, err));
    *n = histogram->shape == HS_VALUE_NUMBER   ? 1
         : histogram->shape == HS_VALUE_VECTOR ? hs_value_length(env, &input->value)
                                               : env->atoms->n_local;
    HS_TRY(make_room(histogram, is_weight, *n, &out, err));
    switch (histogram->shape) {
    case HS_VALUE_NUMBER:
        return hs_value_number(env, &input->value, out, err);
    case HS_VALUE_VECTOR:
        return hs_value_vector(env, &input->value, out, err);
    default:
        return hs_atom_source_values(env, input, fix->mask, out, err);
    }
}

static void find_extremes(const hs_histogram *histogram, const hs_fix *fix, int64_t n, double extreme[2])
{
    const uint32_t *mask = histogram->shape == HS_VALUE_ATOMS ? fix->env->atoms->mask : NULL;
    for (int64_t i = 0; i < n; ++i) {
        if (mask != NULL && !(mask[i] & fix->mask)) continue;
        extreme[0] = fmin(extreme[0], histogram->value[i]);
        extreme[1] = fmax(extreme[1], histogram->value[i]);
    }
}

/** The sample's counts for the errors of the shares. */
static hs_status add_to_errors(hs_histogram *histogram, const double *count, hs_error *err)
{
    const int n = HS_HISTO_BINS + histogram->n_bins;
    double *total;
    if (!histogram->fold.has_errors) return HS_OK;
    HS_TRY(HS_ALLOC(total, (size_t)n, err));
    for (int k = 0; k < n; ++k) total[k] = count[HS_HISTO_TOTAL];
    const hs_status status = hs_fold_add_sample(&histogram->fold, count, total, err);
    HS_FREE(total);
    return status;
}

/** Sums over ranks of what is spread over them. */
static hs_status add_up(const hs_fix *fix, double *count, double extreme[2], hs_error *err)
{
    hs_histogram *histogram = fix->state;
    const int n = HS_HISTO_BINS + histogram->n_bins;
    if (is_spread(histogram)) {
        hs_parallel_min_double(fix->env->parallel, &extreme[0], 1);
        hs_parallel_max_double(fix->env->parallel, &extreme[1], 1);
    }
    for (int k = 0; k < n; ++k) histogram->count[k] += count[k];
    histogram->extreme[0] = fmin(histogram->extreme[0], hs_plain_zero(extreme[0]));
    histogram->extreme[1] = fmax(histogram->extreme[1], hs_plain_zero(extreme[1]));
    return add_to_errors(histogram, count, err);
}

static hs_status sample_weighted(hs_fix *fix, hs_error *err)
{
    hs_histogram *histogram = fix->state;
    const int n_counts = HS_HISTO_BINS + histogram->n_bins;
    double extreme[2] = {hs_histogram_nothing[0], hs_histogram_nothing[1]}, *count = NULL;
    int64_t n = 0;
    hs_exact_sum *sums = NULL;
    HS_TRY(check_weights(fix, err));
    HS_TRY(read_input(fix, &histogram->inputs[0], false, &n, err));
    HS_TRY(read_input(fix, &histogram->inputs[1], true, &n, err));
    hs_status status = HS_ALLOC(sums, (size_t)n_counts, err);
    if (status == HS_OK) status = HS_ALLOC(count, (size_t)n_counts, err);
    if (hs_parallel_agree(fix->env->parallel, err) == HS_OK) {
        count_weights(histogram, fix, n, sums);
        find_extremes(histogram, fix, n, extreme);
        if (is_spread(histogram))
            hs_exact_total(sums, n_counts, fix->env->parallel, count);
        else
            for (int k = 0; k < n_counts; ++k) count[k] = hs_exact_value(&sums[k]);
        status = add_up(fix, count, extreme, err);
    }
    HS_FREE(sums);
    HS_FREE(count);
    return status != HS_OK ? status : err->status;
}

static hs_status sample_plain(hs_fix *fix, hs_error *err)
{
    hs_histogram *histogram = fix->state;
    const int n_counts = HS_HISTO_BINS + histogram->n_bins;
    double extreme[2] = {hs_histogram_nothing[0], hs_histogram_nothing[1]}, *count;
    HS_TRY(HS_ALLOC(count, (size_t)n_counts, err));
    hs_status status = HS_OK;
    for (int k = 0; k < histogram->n_inputs && status == HS_OK; ++k) {
        int64_t n = 0;
        status = read_input(fix, &histogram->inputs[k], false, &n, err);
        if (status != HS_OK) break;
        count_plain(histogram, fix, n, count);
        find_extremes(histogram, fix, n, extreme);
    }
    if (status == HS_OK) {
        if (is_spread(histogram)) hs_parallel_sum_double(fix->env->parallel, count, n_counts);
        status = add_up(fix, count, extreme, err);
    }
    HS_FREE(count);
    return status;
}

/* Windows */

/** Keep the extremes of the window that ends, and find those of the windows that count. */
static void fold_extremes(const hs_histogram *histogram, double extreme[2])
{
    const hs_fold *fold = &histogram->fold;
    const int64_t n_window = fold->mode == HS_FOLD_WINDOW ? fold->n_window : 1;
    const int64_t n = fold->n_added < n_window ? fold->n_added : n_window;
    memcpy(extreme, hs_histogram_nothing, sizeof hs_histogram_nothing);
    for (int64_t w = 0; w < n; ++w) {
        extreme[0] = fmin(extreme[0], histogram->extremes[w][0]);
        extreme[1] = fmax(extreme[1], histogram->extremes[w][1]);
    }
}

static void end_window(hs_histogram *histogram)
{
    hs_fold *fold = &histogram->fold;
    const int64_t place = fold->mode == HS_FOLD_WINDOW ? fold->n_added % fold->n_window : 0;
    double *kept = histogram->extremes[place];
    const bool is_added = fold->mode == HS_FOLD_RUNNING && fold->n_added > 0;
    kept[0] = is_added ? fmin(kept[0], histogram->extreme[0]) : histogram->extreme[0];
    kept[1] = is_added ? fmax(kept[1], histogram->extreme[1]) : histogram->extreme[1];
    hs_fold_add(fold, histogram->count);
    hs_fold_find_errors(fold);
}

/** Middle of a bin; what is beyond is shown at lo and hi. */
static double coordinate(const hs_histogram *histogram, int bin)
{
    if (histogram->beyond != HS_BEYOND_EXTRA) return histogram->lo + (bin + 0.5) * histogram->width;
    if (bin == 0) return histogram->lo;
    if (bin == histogram->n_bins - 1) return histogram->hi;
    return histogram->lo + (bin - 1 + 0.5) * histogram->width;
}

static double fraction(const hs_histogram *histogram, int bin)
{
    const double total = histogram->fold.sum[HS_HISTO_TOTAL];
    return total != 0.0 ? histogram->fold.sum[HS_HISTO_BINS + bin] / total : 0.0;
}

/** Column of the array: middle, count, share, error and inefficiency of the share. */
static double column(const hs_histogram *histogram, int bin, int k)
{
    const hs_fold *fold = &histogram->fold;
    switch (k) {
    case 0:
        return coordinate(histogram, bin);
    case 1:
        return fold->sum[HS_HISTO_BINS + bin];
    case 2:
        return fraction(histogram, bin);
    default:
        return (k == 3 ? fold->error : fold->inefficiency)[HS_HISTO_BINS + bin];
    }
}

static hs_status write_window(hs_fix *fix, hs_error *err)
{
    hs_histogram *histogram = fix->state;
    hs_average_file *file = &histogram->file;
    const double *sum = histogram->fold.sum;
    double extreme[2];
    fold_extremes(histogram, extreme);
    if (hs_average_file_is_open(file)) {
        HS_TRY(hs_text_printf(&file->text, err, "%lld %d %g %g %g %g\n", (long long)fix->env->step, histogram->n_bins,
                              sum[HS_HISTO_TOTAL], sum[HS_HISTO_MISSING], extreme[0], extreme[1]));
        for (int k = 0; k < histogram->n_bins; ++k) {
            HS_TRY(hs_text_printf(&file->text, err, "%d", k + 1));
            for (int c = 0; c < fix->n_columns; ++c) HS_TRY(hs_average_file_number(file, column(histogram, k, c), err));
            HS_TRY(hs_text_append(&file->text, "\n", 1, err));
        }
    }
    return hs_average_file_commit(file, fix->env, err);
}

hs_status hs_histogram_end_of_step(hs_fix *fix, hs_error *err)
{
    hs_histogram *histogram = fix->state;
    HS_TRY(hs_fix_need_sample(fix, histogram->schedule.next, err));
    if (!hs_schedule_is_due(&histogram->schedule, fix->env->step)) return HS_OK;
    if (histogram->schedule.n_taken == 0) {
        memset(histogram->count, 0, (HS_HISTO_BINS + (size_t)histogram->n_bins) * sizeof *histogram->count);
        memcpy(histogram->extreme, hs_histogram_nothing, sizeof hs_histogram_nothing);
    }
    HS_TRY(histogram->is_weighted ? sample_weighted(fix, err) : sample_plain(fix, err));
    if (!hs_schedule_advance(&histogram->schedule, fix->env->step)) return HS_OK;
    end_window(histogram);
    return write_window(fix, err);
}

hs_status hs_histogram_vector(hs_fix *fix, int i, double *value, hs_error *err)
{
    const hs_histogram *histogram = fix->state;
    double extreme[2] = {0.0, 0.0};
    (void)err;
    if (histogram->fold.n_added > 0) fold_extremes(histogram, extreme);
    *value = i < HS_HISTO_BINS ? histogram->fold.sum[i] : extreme[i - HS_HISTO_BINS];
    return HS_OK;
}

hs_status hs_histogram_array(hs_fix *fix, int i, int j, double *value, hs_error *err)
{
    const hs_histogram *histogram = fix->state;
    (void)err;
    *value = column(histogram, i, j);
    return HS_OK;
}

hs_status hs_histogram_keep_state(hs_fix *fix, hs_state *kept, hs_error *err)
{
    hs_histogram *histogram = fix->state;
    const int64_t n_extremes = histogram->fold.mode == HS_FOLD_WINDOW ? histogram->fold.n_window : 1;
    HS_TRY(hs_schedule_keep(&histogram->schedule, kept, err));
    HS_TRY(hs_state_double(kept, "counts", histogram->count, HS_HISTO_BINS + histogram->n_bins, err));
    HS_TRY(hs_state_double(kept, "extremes", histogram->extreme, 2, err));
    HS_TRY(hs_state_double(kept, "extremes of windows", histogram->extremes[0], 2 * n_extremes, err));
    HS_TRY(hs_fold_keep(&histogram->fold, kept, err));
    HS_TRY(hs_fold_keep_errors(&histogram->fold, kept, err));
    return hs_average_file_keep(&histogram->file, fix->env, kept, err);
}
