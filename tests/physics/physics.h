/** What the physics tests share: simulations through the public API, their thermo tables as numbers, simple
 *  statistics. */
#ifndef HS_TESTS_PHYSICS_H
#define HS_TESTS_PHYSICS_H

#include <halfshell/halfshell.h>
#include <math.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "support/harness.h"

/** A simulation whose log is kept in memory. Stays where it was opened: the log's stream knows its address. */
typedef struct experiment {
    hs_simulation *simulation;
    FILE *log;
    char *text; /**< the log so far */
    size_t text_size;
} experiment;

/** Thermo table of the last run: n_rows x n_columns, row by row. */
typedef struct table {
    double *value;
    int n_rows, n_columns;
} table;

static inline void need(experiment *e, hs_code code)
{
    ck_assert_msg(code == HS_CODE_OK, "code %d: %s", (int)code, hs_simulation_error(e->simulation));
}

static inline void open_experiment(experiment *e, int n_threads)
{
    memset(e, 0, sizeof *e);
    e->log = open_memstream(&e->text, &e->text_size);
    ck_assert_ptr_nonnull(e->log);
    hs_simulation_options options = HS_SIMULATION_OPTIONS_INIT;
    options.n_threads = n_threads;
    options.log = e->log;
    need(e, hs_simulation_create(&e->simulation, &options));
}

static inline void close_experiment(experiment *e)
{
    hs_simulation_destroy(&e->simulation);
    fclose(e->log);
    free(e->text);
}

/** Carry out deck lines made by a format. */
__attribute__((format(printf, 2, 3))) static inline void deck(experiment *e, const char *format, ...)
{
    char text[4096];
    va_list arguments;
    va_start(arguments, format);
    const int length = vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    ck_assert(length >= 0 && (size_t)length < sizeof text);
    need(e, hs_simulation_deck_text(e->simulation, text));
}

static inline double thermo(experiment *e, const char *keyword)
{
    double value;
    need(e, hs_simulation_thermo(e->simulation, keyword, &value));
    return value;
}

/** Numbers of one line into row[]; -1 when the line holds anything else. */
static inline int read_row(const char *line, const char *end, double *row, int n_max)
{
    int n = 0;
    while (line < end && n < n_max) {
        char *after;
        row[n] = strtod(line, &after);
        if (after == line || after > end) break;
        line = after, ++n;
    }
    while (line < end && *line == ' ') ++line;
    return line == end && n > 0 ? n : -1;
}

/** The rows of the last table in the log. The caller frees value. */
static inline table last_table(experiment *e)
{
    enum { N_MAX = 16 };
    fflush(e->log);
    const char *line = NULL;
    for (const char *found = strstr(e->text, "\nStep "); found != NULL; found = strstr(found + 1, "\nStep "))
        line = found + 1;
    ck_assert_msg(line != NULL, "no table in the log");
    table t = {0};
    while ((line = strchr(line, '\n')) != NULL) {
        const char *end = strchr(++line, '\n');
        double row[N_MAX];
        const int n = end != NULL ? read_row(line, end, row, N_MAX) : -1;
        if (n < 0) break;
        ck_assert(t.n_rows == 0 || n == t.n_columns);
        t.n_columns = n;
        t.value = realloc(t.value, sizeof(double) * (size_t)(t.n_rows + 1) * (size_t)n);
        ck_assert_ptr_nonnull(t.value);
        memcpy(t.value + (size_t)t.n_rows++ * (size_t)n, row, sizeof(double) * (size_t)n);
    }
    ck_assert_int_gt(t.n_rows, 0);
    return t;
}

static inline double cell(const table *t, int row, int column) { return t->value[row * t->n_columns + column]; }

/** A table to full precision with a row every so many steps. */
static inline table run_table(experiment *e, int n_steps, int every, const char *columns)
{
    deck(e, "thermo_style custom step %s\nthermo_modify format float %%.17g\nthermo %d\nrun %d\n", columns, every,
         n_steps);
    return last_table(e);
}

static inline double *new_vector(int64_t n)
{
    double *vector = calloc((size_t)n + 1, sizeof *vector);
    ck_assert_ptr_nonnull(vector);
    return vector;
}

/** Positions (unwrapped) and velocities by id, 3 numbers an atom. The caller frees them. */
static inline void get_state(experiment *e, double **x, double **v)
{
    const int64_t n = hs_simulation_n_atoms(e->simulation);
    *x = new_vector(3 * n), *v = new_vector(3 * n);
    need(e, hs_simulation_get_unwrapped(e->simulation, HS_ORDER_ID, n, *x));
    need(e, hs_simulation_get_velocities(e->simulation, HS_ORDER_ID, n, *v));
}

static inline void set_state(experiment *e, const double *x, const double *v)
{
    const int64_t n = hs_simulation_n_atoms(e->simulation);
    need(e, hs_simulation_set_positions(e->simulation, HS_ORDER_ID, n, x));
    need(e, hs_simulation_set_velocities(e->simulation, HS_ORDER_ID, n, v));
}

static inline double distance_of(const double *a, const double *b, int64_t n)
{
    double sum = 0.0;
    for (int64_t i = 0; i < n; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return sqrt(sum);
}

/** Least-squares line y = a + b x; returns b. */
static inline double slope_of(const double *x, const double *y, int n)
{
    double mean_x = 0.0, mean_y = 0.0, xx = 0.0, xy = 0.0;
    for (int i = 0; i < n; ++i) mean_x += x[i] / n, mean_y += y[i] / n;
    for (int i = 0; i < n; ++i) {
        xx += (x[i] - mean_x) * (x[i] - mean_x);
        xy += (x[i] - mean_x) * (y[i] - mean_y);
    }
    return xy / xx;
}

#endif
