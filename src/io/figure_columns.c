/* Which columns of a table are drawn, and what they are drawn against. */
#include "io/figure_columns.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"

/** Columns that number or count the rows rather than measure anything: not drawn unless asked for. */
static const char *const bookkeeping[] = {
    "Step",    "TimeStep", "Time",  "Elapsed",   "Elaplong", "Dt",          "CPU",    "T/CPU", "S/CPU",
    "CPULeft", "Row",      "Chunk", "OrigID",    "Bin",      "Index",       "Ncount", "Atoms", "Coord1",
    "Coord2",  "Coord3",   "Coord", "TimeDelta", "Part",     "TimeoutLeft", NULL};

/** What a column's standard errors may be called. */
static const char *const error_patterns[] = {"%s_err",   "%s_error", "%s_se",     "%s_stderr", "err_%s",
                                             "error_%s", "se_%s",    "stderr_%s", NULL};

static bool is_listed(const char *const *list, const char *name)
{
    while (*list != NULL && strcmp(*list, name) != 0) ++list;
    return *list != NULL;
}

/** Column by name, else regardless of case, else by number from 1; -1 when there is none. */
static int find_column(const hs_table *table, const char *word)
{
    int64_t number;
    const int exact = hs_table_find(table, word);
    if (exact >= 0) return exact;
    for (int k = 0; k < table->n_columns; ++k)
        if (strcasecmp(table->column[k].name, word) == 0) return k;
    return hs_text_to_int64(word, &number) && number >= 1 && number <= table->n_columns ? (int)number - 1 : -1;
}

static hs_status refuse_column(const hs_table_file *file, const char *word, hs_error *err)
{
    hs_text names = {0};
    const hs_table *table = &file->table[0];
    const char **all;
    HS_TRY(HS_ALLOC(all, (size_t)table->n_columns, err));
    hs_status status = HS_OK;
    for (int k = 0; k < table->n_columns && status == HS_OK; ++k) {
        all[k] = table->column[k].name;
        status = hs_text_printf(&names, err, "%s%s", k > 0 ? " " : "", all[k]);
    }
    const char *nearest = hs_text_nearest(word, all, (size_t)table->n_columns);
    if (status == HS_OK && nearest != NULL)
        status = hs_fail(err, HS_ERROR_INPUT, "'%s' has no column '%s'; did you mean '%s'?", file->path, word, nearest);
    else if (status == HS_OK)
        status = hs_fail(err, HS_ERROR_INPUT, "'%s' has no column '%s'; its columns are: %s", file->path, word,
                         hs_text_get(&names));
    hs_text_fini(&names);
    HS_FREE(all);
    return status;
}

static bool is_increasing(const hs_table_column *column, int64_t n)
{
    if (column->word != NULL) return false;
    for (int64_t i = 1; i < n; ++i)
        if (!(column->value[i] > column->value[i - 1])) return false;
    return n > 1;
}

static int find_error_column(const hs_table *table, const char *y)
{
    for (const char *const *pattern = error_patterns; *pattern != NULL; ++pattern) {
        char name[256];
        const size_t slot = strcspn(*pattern, "%");
        snprintf(name, sizeof name, "%.*s%s%s", (int)slot, *pattern, y, *pattern + slot + 2);
        const int k = hs_table_find(table, name);
        if (k >= 0) return k;
    }
    return -1;
}

/** Whether this column holds the standard errors of another one. */
static bool is_error_column(const hs_table *table, int column)
{
    for (int k = 0; k < table->n_columns; ++k)
        if (k != column && find_error_column(table, table->column[k].name) == column) return true;
    return false;
}

/** Columns that nobody wants to see unless asked for. */
static bool is_aside(const hs_table *table, int column)
{
    static const char suffix[] = "_ineff"; /* statistical inefficiencies, beside errors */
    const char *name = table->column[column].name;
    const size_t n = strlen(name);
    return is_listed(bookkeeping, name) || is_error_column(table, column) ||
           (n >= sizeof suffix && strcmp(name + n - strlen(suffix), suffix) == 0);
}

/** The column that a file's rows go along when nobody says: known names; in an ave/time table a growing second column
 *  (the distance in a pair correlation); else the first column of numbers. */
static int default_x(const hs_table_file *file, const hs_table *table)
{
    static const char *const names[] = {"Time", "Step", "TimeStep", "TimeDelta", "Coord1", "Coord", "Frequency", NULL};
    for (const char *const *name = names; *name != NULL; ++name)
        if (hs_table_find(table, *name) >= 0) return hs_table_find(table, *name);
    if (file->kind == HS_TABLE_BLOCKS && table->n_columns > 2 && is_increasing(&table->column[1], table->n_rows))
        return 1;
    for (int k = 0; k < table->n_columns; ++k)
        if (table->column[k].word == NULL) return k;
    return 0;
}

hs_status hs_figure_choose_x(const hs_table_file *file, const hs_table *table, const hs_plot_choice *choice,
                             const hs_deck_facts *facts, hs_figure_axis *x, hs_error *err)
{
    static const char *const steps[] = {"Step", "TimeStep", "TimeDelta", NULL};
    *x = (hs_figure_axis){.factor = 1.0};
    if (choice->x == NULL) {
        x->column = default_x(file, table);
        return HS_OK;
    }
    x->column = find_column(table, choice->x);
    if (x->column >= 0) return HS_OK;
    if (strcmp(choice->x, "time") != 0) return refuse_column(file, choice->x, err);
    for (const char *const *name = steps; *name != NULL && x->column < 0; ++name)
        x->column = hs_table_find(table, *name);
    if (x->column < 0) return refuse_column(file, choice->x, err);
    if (facts->dt <= 0.0)
        return hs_fail(err, HS_ERROR_INPUT,
                       "'%s': steps cannot become times, because the timestep is not known; name the deck or log that "
                       "says it with -deck",
                       file->path);
    x->factor = facts->dt;
    return HS_OK;
}

static bool is_constant(const hs_table_file *file, const char *name)
{
    double first = NAN;
    for (int t = 0; t < file->n_tables; ++t) {
        const int k = hs_table_find(&file->table[t], name);
        for (int64_t i = 0; k >= 0 && i < file->table[t].n_rows; ++i) {
            const double value = file->table[t].column[k].value[i];
            if (isnan(first)) first = value;
            if (value != first) return false;
        }
    }
    return true;
}

static void add_once(hs_figure_columns *list, int column)
{
    for (int k = 0; k < list->n; ++k)
        if (list->column[k] == column) return;
    list->column[list->n++] = column;
}

/** What is drawn when nobody says: all columns that measure something, and in a log change. */
static void choose_default_y(const hs_table_file *file, const hs_table *table, int x, hs_figure_columns *list)
{
    for (int k = 0; k < table->n_columns; ++k) {
        const char *name = table->column[k].name;
        if (k != x && table->column[k].word == NULL && !is_aside(table, k) &&
            !(strcmp(name, "Count") == 0 && hs_table_find(table, "Count/Total") >= 0) &&
            !(file->kind == HS_TABLE_LOG && is_constant(file, name)))
            add_once(list, k);
    }
    /* nothing moves: then show what there is */
    const bool is_empty = list->n == 0;
    for (int k = 0; k < table->n_columns && is_empty; ++k)
        if (k != x && table->column[k].word == NULL && !is_error_column(table, k)) add_once(list, k);
}

hs_status hs_figure_choose_y(const hs_table_file *file, const hs_table *table, const hs_plot_choice *choice, int x,
                             hs_figure_columns *list, hs_error *err)
{
    if (choice->y == NULL) {
        choose_default_y(file, table, x, list);
        return HS_OK;
    }
    char *words, *rest;
    HS_TRY(hs_memory_strdup(&words, choice->y, err));
    hs_status status = HS_OK;
    rest = words;
    for (char *word = strsep(&rest, ","); word != NULL && status == HS_OK; word = strsep(&rest, ",")) {
        const int column = find_column(table, word), n_before = list->n;
        if (column >= 0) add_once(list, column);
        bool is_found = column >= 0;
        for (int k = 0; k < table->n_columns && column < 0 && strpbrk(word, "*?") != NULL; ++k)
            if (hs_text_glob(word, table->column[k].name)) {
                add_once(list, k);
                is_found = true;
            }
        if (!is_found && list->n == n_before) status = refuse_column(file, word, err);
    }
    HS_FREE(words);
    return status;
}

hs_status hs_figure_choose_errors(const hs_table_file *file, const hs_table *table, const hs_plot_choice *choice, int y,
                                  int number, int *column, hs_error *err)
{
    *column = -1;
    if (choice->errors == NULL) {
        *column = find_error_column(table, table->column[y].name);
        return HS_OK;
    }
    if (strcmp(choice->errors, "none") == 0) return HS_OK;
    char *list, *rest;
    HS_TRY(hs_memory_strdup(&list, choice->errors, err));
    rest = list;
    char *word = strsep(&rest, ",");
    for (int k = 0; k < number && word != NULL; ++k) word = strsep(&rest, ",");
    hs_status status = HS_OK;
    if (word == NULL)
        status = hs_fail(err, HS_ERROR_INPUT, "-errors names fewer columns than are drawn: none for '%s'",
                         table->column[y].name);
    else if ((*column = find_column(table, word)) < 0)
        status = refuse_column(file, word, err);
    HS_FREE(list);
    return status;
}
