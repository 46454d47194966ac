/* Walls, gravity, springs and the like against the numbers that LAMMPS prints (tests/golden/fixes.txt). */
#include "support/run_deck.h"

#include "physics/physics.h" /* after the others: its type `table` would be shadowed in their headers */

enum { N_COLUMNS_MAX = 16 };

/** The case's lines up to "++", which begin the next line; both are ended by a zero. */
static char *cut_columns(char *text)
{
    char *mark = strstr(text, "\n++ ");
    ck_assert_ptr_nonnull(mark);
    *mark = '\0';
    return mark + 4;
}

/** One row of LAMMPS's against the row of the same step. */
static void check_row(const char *name, const table *t, const char *line)
{
    double expected[N_COLUMNS_MAX];
    const int n = read_row(line, line + strcspn(line, "\n"), expected, N_COLUMNS_MAX);
    int row = 0;
    ck_assert_int_eq(n, t->n_columns);
    while (row < t->n_rows && cell(t, row, 0) != expected[0]) ++row;
    ck_assert_int_lt(row, t->n_rows);
    for (int k = 1; k < n; ++k) {
        /* eight digits are printed: half a unit of the last one, and as much for what 100 steps add to rounding */
        const double tolerance = 1e-7 * fabs(expected[k]) + 1e-9;
        ck_assert_msg(fabs(cell(t, row, k) - expected[k]) <= tolerance, "%s, step %g, column %d: %.10g, LAMMPS %.10g",
                      name, expected[0], k, cell(t, row, k), expected[k]);
    }
}

static void run_case(const char *start, const char *name, char *text)
{
    char *columns = cut_columns(text), *rows = strchr(columns, '\n');
    experiment e;
    ck_assert_ptr_nonnull(rows);
    *rows++ = '\0';
    open_experiment(&e, 1);
    deck(&e, "%s\n%s\n", start, text);
    deck(&e, "thermo_style custom step %s\nthermo_modify norm no format float %%.17g\nrun 100\n", columns);
    table t = last_table(&e);
    int n_rows = 0;
    for (const char *line = rows; line[0] != '\0' && line[0] != '\n'; line = strchr(line, '\n') + 1, ++n_rows)
        check_row(name, &t, line);
    ck_assert_int_eq(n_rows, 3);
    free(t.value);
    close_experiment(&e);
}

START_TEST(test_against_lammps)
{
    ck_assert_int_eq(hs_test_each_case(TEST_SOURCE_DIR "/golden/fixes.txt", run_case), 20);
}
END_TEST

HS_TEST_MAIN("fixes", test_against_lammps)
