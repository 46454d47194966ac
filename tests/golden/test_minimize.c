/* Minimisations against what LAMMPS prints (tests/golden/minimize.txt): energies on the way, and why and when they
 * end. */
#include "support/run_deck.h"

#include "physics/physics.h" /* after the others: its type `table` would be shadowed in their headers */

/** One row of LAMMPS's against the row of the same step, if the table has it. */
static void check_row(const char *name, const table *t, const char *line)
{
    double expected[3];
    int row = 0;
    ck_assert_int_eq(read_row(line, line + strcspn(line, "\n"), expected, 3), 3);
    while (row < t->n_rows && cell(t, row, 0) != expected[0]) ++row;
    ck_assert_msg(row < t->n_rows, "%s: no row of step %g", name, expected[0]);
    /* Eight digits are printed. Rounding grows with the iterations, by a factor of some hundred until the end; at a
     * minimum energies feel it in the second order only, pressures in the first. Overlaps that have all but vanished have
     * energies of the square of what rounding leaves of them. */
    const double tolerance[2] = {1e-7 * fabs(expected[1]) + 1e-13, 1e-6 * fabs(expected[2]) + 2e-8};
    for (int k = 0; k < 2; ++k)
        ck_assert_msg(fabs(cell(t, row, k + 1) - expected[k + 1]) <= tolerance[k],
                      "%s, step %g, column %d: %.10g, LAMMPS %.10g", name, expected[0], k + 1, cell(t, row, k + 1),
                      expected[k + 1]);
}

/** The log's last criterion and number of iterations. */
static void check_end(const char *name, experiment *e, const char *line)
{
    char criterion[64], expected[64];
    int n = -1, n_expected;
    ck_assert_int_eq(sscanf(line, "-> %63[^,], %d", expected, &n_expected), 2);
    const char *said = strstr(e->text, "Stopping criterion = ");
    ck_assert_ptr_nonnull(said);
    ck_assert_int_eq(sscanf(said, "Stopping criterion = %63[^\n]", criterion), 1);
    ck_assert_msg(strcmp(criterion, expected) == 0, "%s: %s, LAMMPS: %s", name, criterion, expected);
    said = strstr(said, "Iterations, force evaluations = ");
    ck_assert_ptr_nonnull(said);
    ck_assert_int_eq(sscanf(said, "Iterations, force evaluations = %d", &n), 1);
    ck_assert_msg(n == n_expected, "%s: %d iterations, LAMMPS: %d", name, n, n_expected);
}

static void run_case(const char *start, const char *name, char *text)
{
    char *mark = strstr(text, "\n++ "), *rows;
    experiment e;
    ck_assert_ptr_nonnull(mark);
    *mark = '\0';
    rows = strchr(mark + 4, '\n') + 1;
    open_experiment(&e, 2);
    deck(&e, "%s\nthermo 10\nthermo_style custom step pe press\nthermo_modify norm no format float %%.17g\n%s\n", start,
         text);
    table t = last_table(&e);
    while (rows[0] != '-' || rows[1] != '>') {
        check_row(name, &t, rows);
        rows = strchr(rows, '\n') + 1;
    }
    check_end(name, &e, rows);
    free(t.value);
    close_experiment(&e);
}

START_TEST(test_against_lammps)
{
    ck_assert_int_eq(hs_test_each_case(TEST_SOURCE_DIR "/golden/minimize.txt", run_case), 25);
}
END_TEST

/** The end of one minimisation: energy and forces, then what a run makes of it. */
static void finish(int n_threads, const char *method, double end[3])
{
    experiment e;
    open_experiment(&e, n_threads);
    deck(&e,
         "neighbor_method %s\ndimension 2\nlattice sq2 0.9\nregion box block 0 9 0 8 -0.5 0.5\ncreate_box 2 box\n"
         "create_atoms 1 box\nset type 1 type/fraction 2 0.4 17\nmass * 1.0\npair_style lj/cut 2.0\n"
         "pair_coeff * * 1.0 1.0\npair_coeff 2 2 1.0 0.8\npair_modify shift yes\nfix 1 all nve\n"
         "thermo_modify norm no\nminimize 0 0 70 1000\n",
         method);
    end[0] = thermo(&e, "pe");
    end[1] = thermo(&e, "press");
    deck(&e, "run 100\n");
    end[2] = thermo(&e, "etotal");
    close_experiment(&e);
}

/* Sums over atoms are exact, moves are rounded to the grid of positions: any threads and any method reach the same
 * bits. */
START_TEST(test_same_bits)
{
    double first[3], other[3];
    finish(1, "cluster", first);
    const struct {
        int n_threads;
        const char *method;
    } ways[] = {{2, "cluster"}, {3, "verlet"}, {1, "nsq"}, {2, "cell"}, {2, "linked"}};
    for (size_t k = 0; k < sizeof ways / sizeof ways[0]; ++k) {
        finish(ways[k].n_threads, ways[k].method, other);
        ck_assert_msg(memcmp(first, other, sizeof first) == 0,
                      "%s on %d threads: %.17g %.17g %.17g, not %.17g %.17g %.17g", ways[k].method, ways[k].n_threads,
                      other[0], other[1], other[2], first[0], first[1], first[2]);
    }
    /* from rest, a run in the harmonic bottom of the minimum keeps its energy */
    ck_assert_double_eq_tol(first[2], first[0], 1e-6 * fabs(first[0]));
}
END_TEST

HS_TEST_MAIN("minimize", test_against_lammps, test_same_bits)
