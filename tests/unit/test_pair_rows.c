/* Local values of pairs against a double loop over all images, in boxes that are shorter than the cutoff: every pair once, the atom of
 * the lower id first, in the stated order. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "style/compute.h"
#include "support/harness.h"
#include "support/run_deck.h"

enum { N_IMAGES = 2, N_ROWS_MAX = 40000 };

/* A soft gas, some of whose ids are missing. */
static const char gas[] = "units lj\nlattice none 1.0\nregion b block 0 2.1 0 3 0 3.3\ncreate_box 2 b\n"
                          "create_atoms 1 random 40 4711 b\nmass * 1.0\nset type 1 type/fraction 2 0.5 77\n"
                          "group some id 1:60:3\npair_style soft 2.5\npair_coeff * * 2.0\npair_coeff 1 2 3.0 1.9\n"
                          "delete_atoms group some compress no\nfix 1 all nve\n";

/** A pair as it is to be told. */
typedef struct expected {
    double id[2], d[3], r, energy, force;
} expected;

static double cutoff_of(int type_i, int type_j) { return type_i == type_j ? 2.5 : 1.9; }

static int in_order(const void *a, const void *b)
{
    const expected *x = a, *y = b;
    for (int k = 0; k < 2; ++k)
        if (x->id[k] != y->id[k]) return x->id[k] < y->id[k] ? -1 : 1;
    for (int k = 0; k < 3; ++k)
        if (fabs(x->d[k] - y->d[k]) > 1e-9) return x->d[k] < y->d[k] ? -1 : 1;
    return 0;
}

/** The image of atom j that is `n` boxes away, as seen from atom i, if the two interact. */
static bool meet(const hs_sim *sim, int i, int j, const int n[3], expected *pair)
{
    const hs_atoms *atoms = &sim->atoms;
    const double cutoff = cutoff_of(atoms->type[i], atoms->type[j]), a = atoms->type[i] == atoms->type[j] ? 2.0 : 3.0;
    double r2 = 0.0;
    for (int k = 0; k < 3; ++k) {
        pair->d[k] = atoms->x[k][i] - atoms->x[k][j] - n[k] * hs_box_length(&sim->box, k);
        r2 += pair->d[k] * pair->d[k];
    }
    if (!(r2 < cutoff * cutoff)) return false;
    pair->id[0] = (double)atoms->id[i];
    pair->id[1] = (double)atoms->id[j];
    pair->r = sqrt(r2);
    pair->energy = a * (1.0 + cos(M_PI * pair->r / cutoff));
    pair->force = a * M_PI / cutoff * sin(M_PI * pair->r / cutoff);
    return true;
}

/** Whether of an atom and its image this one is told: the first component that is not 0 is positive. */
static bool is_forward(const expected *pair)
{
    int k = 0;
    while (k < 2 && pair->d[k] == 0.0) ++k;
    return pair->d[k] > 0.0;
}

static int list_expected(const hs_sim *sim, expected *pairs)
{
    const hs_atoms *atoms = &sim->atoms;
    int count = 0, n[3];
    for (int i = 0; i < atoms->n_local; ++i)
        for (int j = 0; j < atoms->n_local; ++j)
            for (n[0] = -N_IMAGES; n[0] <= N_IMAGES; ++n[0])
                for (n[1] = -N_IMAGES; n[1] <= N_IMAGES; ++n[1])
                    for (n[2] = -N_IMAGES; n[2] <= N_IMAGES; ++n[2]) {
                        const bool is_itself = i == j && n[0] == 0 && n[1] == 0 && n[2] == 0;
                        if (is_itself || atoms->id[i] > atoms->id[j]) continue;
                        ck_assert_int_lt(count, N_ROWS_MAX);
                        count += meet(sim, i, j, n, &pairs[count]) && (i != j || is_forward(&pairs[count]));
                    }
    qsort(pairs, (size_t)count, sizeof *pairs, in_order);
    return count;
}

static const hs_local_rows *rows_of(hs_deck *deck, const char *id)
{
    hs_error err = {0};
    hs_compute *compute = hs_sim_find_compute(deck->sim, id);
    ck_assert_ptr_nonnull(compute);
    ck_assert_hs_ok(hs_compute_eval_local(compute, &err), err);
    ck_assert_int_eq(compute->local.first, 0);
    ck_assert_int_eq(compute->local.n_all, compute->local.n);
    return &compute->local;
}

static void check_rows(hs_deck *deck, void *context)
{
    expected *pairs = calloc(N_ROWS_MAX, sizeof *pairs);
    const hs_sim *sim = deck->sim;
    const int n = list_expected(sim, pairs);
    const hs_local_rows *told = rows_of(deck, "p"), *atoms = rows_of(deck, "q");
    double energy = 0.0;
    int n_own = 0;
    (void)context;
    ck_assert_int_eq(told->n, n);
    ck_assert_int_eq(atoms->n, n);
    for (int k = 0; k < n; ++k) {
        const expected *e = &pairs[k];
        /* a handful of roundings of numbers below 10 */
        const double tolerance = 1e-13;
        for (int c = 0; c < 2; ++c) ck_assert_double_eq(atoms->values[c * n + k], e->id[c]);
        ck_assert_double_eq_tol(told->values[k], e->r, tolerance);
        for (int c = 0; c < 3; ++c) {
            ck_assert_double_eq_tol(told->values[(1 + c) * n + k], e->d[c], tolerance);
            ck_assert_double_eq_tol(told->values[(6 + c) * n + k], e->force * e->d[c] / e->r, 10 * tolerance);
        }
        ck_assert_double_eq_tol(told->values[4 * n + k], e->energy, 10 * tolerance);
        ck_assert_double_eq_tol(told->values[5 * n + k], e->force, 10 * tolerance);
        energy += told->values[4 * n + k];
        n_own += e->id[0] == e->id[1];
    }
    ck_assert_double_eq_tol(energy, sim->env.pair_energy, 1e-12 * fabs(energy));
    ck_assert_int_gt(n_own, 0);
    free(pairs);
}

START_TEST(rows_are_those_of_a_double_loop)
{
    for (int n_threads = 1; n_threads <= 3; ++n_threads) {
        hs_error err = {0};
        const hs_options options = {.n_threads = n_threads};
        char text[1024];
        snprintf(text, sizeof text,
                 "%scompute p all pair/local dist dx dy dz eng force fx fy fz\n"
                 "compute q all property/local patom1 patom2\nrun 3\n",
                 gas);
        free(hs_test_run_deck_with(text, &options, check_rows, NULL, &err));
        ck_assert_hs_ok(err.status, err);
    }
}
END_TEST

HS_TEST_MAIN("rows of pairs", rows_are_those_of_a_double_loop)
