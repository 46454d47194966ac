/* Measures of the neighbors of each atom against double loops over all pairs: compute hexorder/atom. (LAMMPS's package
 * with it is often not built in.) */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "style/value.h"
#include "support/harness.h"
#include "support/run_deck.h"

/* A dilute gas in a box of a few cutoffs, in which images matter. */
static const char gas[] = "units lj\ndimension 2\nlattice sq 0.5\nregion b block 0 6 0 5 -0.5 0.5\ncreate_box 1 b\n"
                          "create_atoms 1 random 60 4711 b\nmass 1 1.0\npair_style zero 2.5\npair_coeff * *\n"
                          "group some id 1:60:2\nfix 1 all nve\n";

typedef struct bond {
    double r2, dx, dy;
} bond;

static int by_distance(const void *a, const void *b)
{
    const double x = ((const bond *)a)->r2, y = ((const bond *)b)->r2;
    return (x > y) - (x < y);
}

/** Bonds of atom i to all images of all atoms within the cutoff, nearest first. */
static int list_bonds(const hs_sim *sim, int i, double cutoff, bond *bonds)
{
    const hs_atoms *atoms = &sim->atoms;
    const double lx = hs_box_length(&sim->box, 0), ly = hs_box_length(&sim->box, 1);
    int n = 0;
    for (int j = 0; j < atoms->n_local; ++j)
        for (int a = -1; a <= 1; ++a)
            for (int b = -1; b <= 1; ++b) {
                const double dx = atoms->x[0][i] - atoms->x[0][j] + a * lx,
                             dy = atoms->x[1][i] - atoms->x[1][j] + b * ly, r2 = dx * dx + dy * dy;
                if (r2 > 0.0 && r2 < cutoff * cutoff) bonds[n++] = (bond){r2, dx, dy};
            }
    qsort(bonds, (size_t)n, sizeof *bonds, by_distance);
    return n;
}

/** What is to be found, as the words of the compute say. */
typedef struct order {
    const char *words;
    int degree, n_nearest;
    double cutoff;
    unsigned group;
} order;

static void check_order(hs_deck *deck, void *context)
{
    const order *o = context;
    hs_error err = {0};
    const hs_atoms *atoms = &deck->sim->atoms;
    hs_compute *compute = hs_sim_find_compute(deck->sim, "q");
    int n_ordered = 0;
    ck_assert_ptr_nonnull(compute);
    ck_assert_hs_ok(hs_compute_eval_atoms(compute, &err), err);
    for (int i = 0; i < atoms->n_local; ++i) {
        bond bonds[60 * 9];
        double q[2] = {0.0, 0.0};
        int n = list_bonds(deck->sim, i, o->cutoff, bonds);
        if (n < o->n_nearest || !(atoms->mask[i] & o->group)) n = 0;
        if (o->n_nearest > 0 && n > o->n_nearest) n = o->n_nearest;
        n_ordered += n > 0;
        for (int k = 0; k < n; ++k) {
            q[0] += cos(o->degree * atan2(bonds[k].dy, bonds[k].dx)) / n;
            q[1] += sin(o->degree * atan2(bonds[k].dy, bonds[k].dx)) / n;
        }
        /* a handful of terms below 1: rounding of the angle times the degree */
        ck_assert_double_eq_tol(compute->atoms[i], q[0], 1e-13);
        ck_assert_double_eq_tol(compute->atoms[atoms->n_local + i], q[1], 1e-13);
    }
    ck_assert_int_gt(n_ordered, 10);
}

START_TEST(hexorder_is_that_of_a_double_loop)
{
    static const order orders[] = {{"", 6, 6, 2.5, 1},
                                   {"nnn 4 degree 4 cutoff 2.1", 4, 4, 2.1, 1},
                                   {"degree 5 nnn NULL cutoff 3.0", 5, 0, 3.0, 1},
                                   {"degree 3 nnn 3 cutoff 1.5", 3, 3, 1.5, 2}};
    for (size_t k = 0; k < sizeof orders / sizeof orders[0]; ++k) {
        hs_error err = {0};
        char text[1024];
        const hs_options options = {.n_threads = 2};
        order o = orders[k];
        snprintf(text, sizeof text, "%scompute q %s hexorder/atom %s\nrun 0\n", gas, o.group == 1 ? "all" : "some",
                 o.words);
        free(hs_test_run_deck_with(text, &options, check_order, &o, &err));
        ck_assert_hs_ok(err.status, err);
    }
}
END_TEST

static void check_crystal(hs_deck *deck, void *context)
{
    hs_error err = {0};
    hs_compute *compute = hs_sim_find_compute(deck->sim, "q");
    (void)context;
    ck_assert_hs_ok(hs_compute_eval_atoms(compute, &err), err);
    const int n = deck->sim->atoms.n_local;
    for (int i = 0; i < n; ++i) ck_assert_double_eq_tol(hypot(compute->atoms[i], compute->atoms[n + i]), 1.0, 1e-12);
}

START_TEST(a_hexagonal_crystal_has_order_one)
{
    hs_error err = {0};
    const hs_options options = {.n_threads = 1};
    free(hs_test_run_deck_with(
        "units lj\ndimension 2\nlattice hex 0.9\nregion b block 0 6 0 4 -0.5 0.5\ncreate_box 1 b\n"
        "create_atoms 1 box\nmass 1 1.0\npair_style none\ncompute q all hexorder/atom cutoff 1.5\n"
        "run 0\n",
        &options, check_crystal, NULL, &err));
    ck_assert_hs_ok(err.status, err);
}
END_TEST

HS_TEST_MAIN("measures of neighbors", hexorder_is_that_of_a_double_loop, a_hexagonal_crystal_has_order_one)
