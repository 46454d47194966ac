/* Means of thermo columns with their standard errors. */
#include <math.h>
#include <stdio.h>

#include "cli/report.h"
#include "core/statistics.h"

/** What a table says of a column. */
typedef struct column_facts {
    hs_series series;
    hs_line line; /**< of the values against their number: the drift */
    double minimum, maximum;
} column_facts;

static column_facts facts_of(const double *value, int64_t n)
{
    column_facts facts = {.minimum = INFINITY, .maximum = -INFINITY};
    for (int64_t i = 0; i < n; ++i) {
        if (!isfinite(value[i])) continue;
        hs_series_add(&facts.series, value[i], 1.0);
        hs_line_add(&facts.line, (double)i, value[i]);
        facts.minimum = fmin(facts.minimum, value[i]);
        facts.maximum = fmax(facts.maximum, value[i]);
    }
    return facts;
}

static hs_status put_cell(hs_text *page, double value, const char *fmt, hs_error *err)
{
    char text[64];
    snprintf(text, sizeof text, fmt, value);
    return hs_text_printf(page, err, "<td>%s</td>", isfinite(value) ? text : "–");
}

static hs_status put_row(hs_text *page, const hs_table *table, int k, const hs_deck_facts *facts, bool *is_uncertain,
                         hs_error *err)
{
    const column_facts found = facts_of(table->column[k].value, table->n_rows);
    const hs_estimate e = hs_series_estimate(&found.series);
    double slope, ignored;
    hs_text label = {0};
    hs_line_slope(&found.line, &slope, &ignored);
    *is_uncertain |= e.n > 1 && !e.is_converged;
    hs_status status = hs_quantity_label(&label, table->column[k].name, facts, err);
    if (status == HS_OK) status = hs_text_printf(page, err, "<tr><th scope=\"row\">");
    if (status == HS_OK) status = hs_html_text(page, table->column[k].name, err);
    if (status == HS_OK) status = hs_text_printf(page, err, "</th><td class=\"what\">");
    if (status == HS_OK) status = hs_html_text(page, hs_text_get(&label), err);
    hs_text_fini(&label);
    HS_TRY(status);
    HS_TRY(hs_text_printf(page, err, "</td>"));
    HS_TRY(put_cell(page, e.n > 0 ? e.mean : NAN, "%.8g", err));
    HS_TRY(put_cell(page, e.n > 1 ? e.error : NAN, e.is_converged ? "± %.2g" : "± %.2g *", err));
    HS_TRY(put_cell(page, e.n > 1 ? e.inefficiency : NAN, "%.1f", err));
    HS_TRY(put_cell(page, found.minimum, "%.8g", err));
    HS_TRY(put_cell(page, found.maximum, "%.8g", err));
    HS_TRY(put_cell(page, e.n > 2 ? slope * (double)(e.n - 1) : NAN, "%.3g", err));
    return hs_text_printf(page, err, "</tr>\n");
}

static hs_status put_run(hs_text *page, const hs_table *table, const hs_deck_facts *facts, bool *is_uncertain,
                         hs_error *err)
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
        if (k != step && table->column[k].word == NULL) HS_TRY(put_row(page, table, k, facts, is_uncertain, err));
    return hs_text_printf(page, err, "</tbody></table></div>\n");
}

hs_status hs_html_means(hs_text *page, const hs_table_file *log, const hs_deck_facts *facts, hs_error *err)
{
    bool is_uncertain = false;
    for (int t = 0; t < log->n_tables; ++t)
        if (log->table[t].n_rows > 1) HS_TRY(put_run(page, &log->table[t], facts, &is_uncertain, err));
    return hs_text_printf(
        page, err,
        "<p class=\"note\">Means over all rows of a run, its beginning too. Errors are standard errors by "
        "blocking (Flyvbjerg and Petersen 1989, Lee and others 2011); the inefficiency is the number of neighboring "
        "rows that count as one. %sDrift: change from the first to the last row of a straight-line fit.</p>\n",
        is_uncertain ? "* Fewer than 20 independent rows: the error may be too small. " : "");
}
