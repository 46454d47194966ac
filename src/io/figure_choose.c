/* Which tables and rows of a file become curves. */
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "io/figure_columns.h"

static hs_status set_x_label(hs_figure *figure, const hs_table *table, const hs_figure_axis *x,
                             const hs_deck_facts *facts, hs_error *err)
{
    hs_text label = {0};
    const char *name = table->column[x->column].name;
    if (figure->x_label != NULL) return HS_OK;
    const bool is_lag = strcmp(name, "TimeDelta") == 0 && x->factor != 1.0;
    hs_status status = hs_quantity_label(&label, x->factor != 1.0 ? "Time" : name, facts, err);
    hs_text full = {0};
    if (status == HS_OK) status = hs_text_printf(&full, err, "%s%s", is_lag ? "lag " : "", hs_text_get(&label));
    if (status == HS_OK) status = hs_memory_strdup(&figure->x_label, hs_text_get(&full), err);
    hs_text_fini(&full);
    hs_text_fini(&label);
    return status;
}

/** Points of one curve while they are gathered. */
typedef struct points {
    hs_curve curve;
    int64_t capacity;
} points;

static hs_status add_point(points *p, double x, double y, const double *error, hs_error *err)
{
    if (p->curve.n == p->capacity) {
        const int64_t more = p->capacity > 0 ? 2 * p->capacity : 64;
        HS_TRY(HS_GROW(p->curve.x, (size_t)p->curve.n, (size_t)more, err));
        HS_TRY(HS_GROW(p->curve.y, (size_t)p->curve.n, (size_t)more, err));
        HS_TRY(HS_GROW(p->curve.error, (size_t)p->curve.n, (size_t)more, err));
        p->capacity = more;
    }
    p->curve.x[p->curve.n] = x;
    p->curve.y[p->curve.n] = y;
    p->curve.error[p->curve.n++] = error != NULL ? *error : 0.0;
    return HS_OK;
}

static void clear_points(points *p)
{
    HS_FREE(p->curve.x);
    HS_FREE(p->curve.y);
    HS_FREE(p->curve.error);
    p->curve.n = p->capacity = 0;
}

/** The words of a row, between blanks: rows with the same words are one curve. */
static hs_status row_words(const hs_table *table, int64_t row, hs_text *words, hs_error *err)
{
    hs_text_clear(words);
    for (int k = 0; k < table->n_columns; ++k)
        if (table->column[k].word != NULL && table->column[k].word[row] != NULL)
            HS_TRY(hs_text_printf(words, err, "%s%s", words->length > 0 ? " " : "", table->column[k].word[row]));
    return HS_OK;
}

/** One column of one selection of tables on its way to the figure. */
typedef struct request {
    hs_figure *figure;
    const hs_table_file *file;
    const char *label; /**< of the file; NULL when it is the only one */
    const hs_plot_choice *choice;
    const hs_deck_facts *facts;
    int first, end;   /**< tables that make one curve */
    int n_columns;    /**< drawn columns: a single one needs no mention in the legend beside file or words */
    const char *part; /**< "step 100", "run 2" where several tables make curves of their own; "" */
} request;

static hs_status send(const request *r, points *p, const char *column, const char *words, bool has_errors,
                      hs_error *err)
{
    hs_text label = {0}, title = {0};
    hs_status status = hs_quantity_label(&label, column, r->facts, err);
    const bool is_named = r->label != NULL || words[0] != '\0', has_column = !is_named || r->n_columns > 1;
    if (status == HS_OK)
        status =
            hs_text_printf(&title, err, "%s%s%s%s%s%s%s", r->label != NULL ? r->label : "",
                           r->label != NULL && words[0] != '\0' ? ": " : "", words, is_named && has_column ? ": " : "",
                           has_column ? column : "", r->part[0] != '\0' ? ", " : "", r->part);
    hs_curve curve = p->curve;
    if (!has_errors) curve.error = NULL;
    if (status == HS_OK) status = hs_figure_add_curve(r->figure, hs_text_get(&label), hs_text_get(&title), &curve, err);
    hs_text_fini(&label);
    hs_text_fini(&title);
    return status;
}

/** All rows of a column over the request's tables; rows with different words are different curves. */
static hs_status add_column(const request *r, const char *name, int number, hs_error *err)
{
    const hs_table *head = &r->file->table[r->first];
    hs_text group = {0}, words = {0};
    points p = {0};
    hs_status status = HS_OK;
    unsigned char *done = NULL; /* rows of the first table that are in a curve already */
    bool has_words = false;
    for (int k = 0; k < head->n_columns; ++k) has_words |= head->column[k].word != NULL;
    status = HS_ALLOC(done, (size_t)head->n_rows + 1, err);
    for (int64_t start = 0; start < (has_words ? head->n_rows : 1) && status == HS_OK; ++start) {
        bool has_errors = false;
        if (done[start]) continue;
        p.curve.n = 0;
        if (has_words) status = row_words(head, start, &group, err);
        for (int t = r->first; t < r->end && status == HS_OK; ++t) {
            const hs_table *table = &r->file->table[t];
            const int y = hs_table_find(table, name);
            hs_figure_axis x;
            int error = -1;
            if (y < 0) continue;
            status = hs_figure_choose_x(r->file, table, r->choice, r->facts, &x, err);
            if (status == HS_OK) status = hs_figure_choose_errors(r->file, table, r->choice, y, number, &error, err);
            has_errors |= error >= 0;
            for (int64_t i = 0; i < table->n_rows && status == HS_OK; ++i) {
                if (has_words) status = row_words(table, i, &words, err);
                if (has_words && strcmp(hs_text_get(&words), hs_text_get(&group)) != 0) continue;
                if (has_words && t == r->first) done[i] = 1;
                if (status == HS_OK)
                    status = add_point(&p, table->column[x.column].value[i] * x.factor, table->column[y].value[i],
                                       error >= 0 ? &table->column[error].value[i] : NULL, err);
            }
        }
        if (status == HS_OK) status = send(r, &p, name, hs_text_get(&group), has_errors, err);
    }
    HS_FREE(done);
    hs_text_fini(&group);
    hs_text_fini(&words);
    clear_points(&p);
    return status;
}

static hs_status add_tables(request *r, hs_error *err)
{
    const hs_table *head = &r->file->table[r->first];
    hs_figure_axis x;
    hs_figure_columns list = {0};
    HS_TRY(hs_figure_choose_x(r->file, head, r->choice, r->facts, &x, err));
    HS_TRY(set_x_label(r->figure, head, &x, r->facts, err));
    HS_TRY(HS_ALLOC(list.column, (size_t)head->n_columns, err));
    hs_status status = hs_figure_choose_y(r->file, head, r->choice, x.column, &list, err);
    r->n_columns = list.n;
    for (int k = 0; k < list.n && status == HS_OK; ++k) {
        const hs_table_column *column = &head->column[list.column[k]];
        if (column->word != NULL && r->choice->y != NULL)
            status =
                hs_fail(err, HS_ERROR_INPUT, "'%s': column '%s' holds words, not numbers", r->file->path, column->name);
        if (status == HS_OK) status = add_column(r, column->name, k, err);
    }
    if (status == HS_OK && list.n == 0)
        status = hs_fail(err, HS_ERROR_INPUT, "'%s' has no column of numbers to plot against '%s'", r->file->path,
                         head->column[x.column].name);
    HS_FREE(list.column);
    return status;
}

/** Tables that the word of -block asks for: [*first, *end). */
static hs_status choose_tables(const hs_table_file *file, const char *block, int *first, int *end, hs_error *err)
{
    int64_t step;
    *first = 0;
    *end = file->n_tables;
    while (*end > 1 && file->table[*end - 1].n_rows == 0) --*end; /* a run that was stopped at once */
    if (block == NULL) block = file->kind == HS_TABLE_BLOCKS ? "last" : "all";
    if (strcmp(block, "all") == 0) return HS_OK;
    if (strcmp(block, "first") == 0) return *end = 1, HS_OK;
    if (strcmp(block, "last") == 0) return *first = *end - 1, HS_OK;
    for (int t = 0; hs_text_to_int64(block, &step) && t < file->n_tables; ++t)
        if (file->table[t].step == step) {
            *first = t;
            *end = t + 1;
            return HS_OK;
        }
    return hs_fail(err, HS_ERROR_INPUT, "'%s' has no %s '%s'; it has %lld to %lld, and the words all, first, last",
                   file->path, file->kind == HS_TABLE_BLOCKS ? "step" : "run", block, (long long)file->table[0].step,
                   (long long)file->table[file->n_tables - 1].step);
}

/** First value of the horizontal axis's column after table t - 1 lies before its last one: steps were set back. */
static bool begins_anew(const hs_table_file *file, int t)
{
    static const char *const names[] = {"Step", "Time", NULL};
    for (const char *const *name = names; *name != NULL; ++name) {
        const hs_table *before = &file->table[t - 1], *after = &file->table[t];
        const int a = hs_table_find(before, *name), b = hs_table_find(after, *name);
        if (a >= 0 && b >= 0 && before->n_rows > 0 && after->n_rows > 0)
            return after->column[b].value[0] < before->column[a].value[before->n_rows - 1];
    }
    return false;
}

/** Tables [r->first, r->end) of a log: runs follow one another as one curve, as long as steps grow. */
static hs_status add_runs(request *r, int first, int end, hs_error *err)
{
    bool has_parts = false;
    for (int t = first + 1; t < end; ++t) has_parts |= begins_anew(r->file, t);
    for (int t = first; t < end; t = r->end) {
        char part[48] = "";
        r->first = t;
        r->end = t + 1;
        while (r->end < end && !begins_anew(r->file, r->end)) ++r->end;
        if (has_parts && r->end == t + 1) snprintf(part, sizeof part, "run %d", t + 1);
        if (has_parts && r->end > t + 1) snprintf(part, sizeof part, "runs %d to %d", t + 1, r->end);
        r->part = part;
        HS_TRY(add_tables(r, err));
    }
    return HS_OK;
}

hs_status hs_figure_add_file(hs_figure *figure, const hs_table_file *file, const char *label,
                             const hs_plot_choice *choice, const hs_deck_facts *facts, hs_error *err)
{
    request r = {.figure = figure, .file = file, .label = label, .choice = choice, .facts = facts, .part = ""};
    int first, end;
    HS_TRY(choose_tables(file, choice->block, &first, &end, err));
    /* the runs of a log follow one another; the blocks of other files lie above each other */
    if (file->kind != HS_TABLE_BLOCKS) return add_runs(&r, first, end, err);
    if (end - first == 1) {
        r.first = first;
        r.end = end;
        return add_tables(&r, err);
    }
    for (int t = first; t < end; ++t) {
        char part[48];
        snprintf(part, sizeof part, "step %lld", (long long)file->table[t].step);
        r.first = t;
        r.end = t + 1;
        r.part = part;
        HS_TRY(add_tables(&r, err));
    }
    return HS_OK;
}
