/* Means of thermo columns with their standard errors. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "cli/report.h"

enum { BLOCKS_MIN = 16 };

static double mean_of(const double *value, int64_t n)
{
    double sum = 0.0;
    for (int64_t i = 0; i < n; ++i) sum += value[i] - value[0]; /* small numbers lose no digits */
    return value[0] + sum / (double)n;
}

static double error_of(const double *value, int64_t n, double mean)
{
    double sum = 0.0;
    for (int64_t i = 0; i < n; ++i) sum += (value[i] - mean) * (value[i] - mean);
    return sqrt(sum / ((double)n * (double)(n - 1)));
}

/** Straight line through the values: its change from the first to the last. */
static double drift_of(const double *value, int64_t n, double mean)
{
    const double middle = 0.5 * (double)(n - 1);
    double up = 0.0, down = 0.0;
    for (int64_t i = 0; i < n; ++i) {
        up += ((double)i - middle) * (value[i] - mean);
        down += ((double)i - middle) * ((double)i - middle);
    }
    return down > 0.0 ? up / down * (double)(n - 1) : 0.0;
}

hs_status hs_mean_of(hs_mean *result, const double *value, int64_t n, hs_error *err)
{
    double *block;
    int64_t n_blocks = 0;
    *result = (hs_mean){.mean = NAN, .error = NAN, .minimum = NAN, .maximum = NAN, .inefficiency = NAN, .drift = NAN};
    HS_TRY(HS_ALLOC(block, (size_t)n + 1, err));
    for (int64_t i = 0; i < n; ++i)
        if (isfinite(value[i])) block[n_blocks++] = value[i];
    if (n_blocks > 0) {
        result->mean = mean_of(block, n_blocks);
        result->minimum = result->maximum = block[0];
        for (int64_t i = 0; i < n_blocks; ++i) {
            result->minimum = fmin(result->minimum, block[i]);
            result->maximum = fmax(result->maximum, block[i]);
        }
        result->drift = drift_of(block, n_blocks, result->mean);
    }
    const double plain = n_blocks >= BLOCKS_MIN ? error_of(block, n_blocks, result->mean) : NAN;
    for (; n_blocks >= BLOCKS_MIN; n_blocks /= 2) {
        const double error = error_of(block, n_blocks, mean_of(block, n_blocks));
        if (!(result->error >= error)) result->error = error;
        for (int64_t i = 0; i < n_blocks / 2; ++i) block[i] = 0.5 * (block[2 * i] + block[2 * i + 1]);
    }
    if (plain > 0.0) result->inefficiency = (result->error / plain) * (result->error / plain);
    HS_FREE(block);
    return HS_OK;
}

static hs_status put_cell(hs_text *page, double value, const char *fmt, hs_error *err)
{
    char text[64];
    snprintf(text, sizeof text, fmt, value);
    return hs_text_printf(page, err, "<td>%s</td>", isfinite(value) ? text : "–");
}

static hs_status put_row(hs_text *page, const hs_table *table, int k, const hs_deck_facts *facts, hs_error *err)
{
    hs_mean m;
    hs_text label = {0};
    HS_TRY(hs_mean_of(&m, table->column[k].value, table->n_rows, err));
    hs_status status = hs_quantity_label(&label, table->column[k].name, facts, err);
    if (status == HS_OK) status = hs_text_printf(page, err, "<tr><th scope=\"row\">");
    if (status == HS_OK) status = hs_html_text(page, table->column[k].name, err);
    if (status == HS_OK) status = hs_text_printf(page, err, "</th><td class=\"what\">");
    if (status == HS_OK) status = hs_html_text(page, hs_text_get(&label), err);
    hs_text_fini(&label);
    HS_TRY(status);
    HS_TRY(hs_text_printf(page, err, "</td>"));
    HS_TRY(put_cell(page, m.mean, "%.8g", err));
    HS_TRY(put_cell(page, m.error, "± %.2g", err));
    HS_TRY(put_cell(page, m.inefficiency, "%.1f", err));
    HS_TRY(put_cell(page, m.minimum, "%.8g", err));
    HS_TRY(put_cell(page, m.maximum, "%.8g", err));
    HS_TRY(put_cell(page, m.drift, "%.3g", err));
    return hs_text_printf(page, err, "</tr>\n");
}

static hs_status put_run(hs_text *page, const hs_table *table, const hs_deck_facts *facts, hs_error *err)
{
    const int step = hs_table_find(table, "Step");
    HS_TRY(hs_text_printf(page, err, "<h3>Run %lld", (long long)table->step));
    if (step >= 0 && table->n_rows > 0)
        HS_TRY(hs_text_printf(page, err, ": steps %.0f to %.0f", table->column[step].value[0],
                              table->column[step].value[table->n_rows - 1]));
    HS_TRY(
        hs_text_printf(page, err,
                       ", %lld rows</h3>\n<div class=\"wide\"><table>\n<thead><tr><th>column</th><th>quantity</th>"
                       "<th>mean</th><th>error</th><th>inefficiency</th><th>least</th><th>greatest</th><th>drift</th>"
                       "</tr></thead>\n<tbody>\n",
                       (long long)table->n_rows));
    for (int k = 0; k < table->n_columns; ++k)
        if (k != step && table->column[k].word == NULL) HS_TRY(put_row(page, table, k, facts, err));
    return hs_text_printf(page, err, "</tbody></table></div>\n");
}

hs_status hs_html_means(hs_text *page, const hs_table_file *log, const hs_deck_facts *facts, hs_error *err)
{
    for (int t = 0; t < log->n_tables; ++t)
        if (log->table[t].n_rows > 1) HS_TRY(put_run(page, &log->table[t], facts, err));
    return hs_text_printf(
        page, err,
        "<p class=\"note\">Means over all rows of a run, its beginning too. Errors are standard errors by "
        "blocking (Flyvbjerg and Petersen 1989); the inefficiency is the number of neighboring rows "
        "that count as one. Fewer than %d rows give no error. Drift: change from the first to the "
        "last row of a straight-line fit.</p>\n",
        BLOCKS_MIN);
}
