/* Every neighbor method with its options x 2D and 3D x periodic and closed boxes x equal and unequal particles x
 * densities from 0.001 to 1.2, against the double loop: forces, energy and virial at the start and after some steps. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "support/harness.h"
#include "support/run_deck.h"

enum { N_ATOMS = 125, TEXT_SIZE = 65536 };

static const char *const methods[] = {
    "linked",
    "linked cell 0.5",
    "linked cell 0.34 order row stencil cube",
    "linked cell 1.7 order none",
    "incremental",
    "incremental cell 0.5 order row",
    "incremental cell 0.9 order none stencil cube",
    "hash",
    "hash cell 0.4 order none",
    "hash cell 3 order row stencil cube",
    "cell",
    "cell cell 0.5 order row",
    "verlet",
    "verlet cell 0.8 order row",
    "cluster",
    "cluster cell 0.4 order row",
};
enum { N_METHODS_HERE = sizeof methods / sizeof methods[0] };

static const double densities[] = {0.001, 0.03, 0.3, 0.7, 1.2};
enum { N_DENSITIES = sizeof densities / sizeof densities[0] };

/** Deterministic numbers in [0, 1): a 64-bit LCG (Knuth's MMIX constants). */
static double next_uniform(uint64_t *state)
{
    *state = *state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (double)(*state >> 11) * 0x1p-53;
}

/** Half the places on a jittered lattice that fills the box, the rest beside others, so that a thin gas has pairs
 *  too. */
static void place(int dimension, double length, bool is_dense, double x[N_ATOMS][3])
{
    const int side = dimension == 3 ? 5 : 12; /* 125 or 144 sites */
    const double spacing = length / side;
    uint64_t state = 2024;
    for (int k = 0; k < N_ATOMS; ++k) {
        const int site[3] = {k % side, k / side % side, k / side / side};
        for (int axis = 0; axis < 3; ++axis)
            x[k][axis] = axis < dimension ? (site[axis] + 0.5 + 0.12 * (next_uniform(&state) - 0.5)) * spacing : 0.0;
        if (is_dense || k % 2 == 0) continue;
        /* a near neighbor of the atom before, in any direction */
        const double r = 1.0 + 0.35 * next_uniform(&state), angle = 6.283185307 * next_uniform(&state);
        const double rise = dimension == 3 ? 2.0 * next_uniform(&state) - 1.0 : 0.0, flat = sqrt(1.0 - rise * rise);
        x[k][0] = x[k - 1][0] + r * flat * cos(angle);
        x[k][1] = x[k - 1][1] + r * flat * sin(angle);
        x[k][2] = x[k - 1][2] + r * rise;
    }
}

static void write_deck(char *text, int dimension, bool is_periodic, bool is_mixed, double density, const char *method)
{
    static double x[N_ATOMS][3];
    const double length = pow(N_ATOMS / density, 1.0 / dimension);
    place(dimension, length, density > 0.1, x);
    const double margin = is_periodic ? 0.0 : 3.0; /* so that no atom leaves a closed box */
    char *to = text;
    to += sprintf(to, "dimension %d\nboundary %s\n", dimension,
                  is_periodic      ? "p p p"
                  : dimension == 3 ? "f f f"
                                   : "f f p");
    to += sprintf(to, "region box block %.17g %.17g %.17g %.17g %.17g %.17g units box\ncreate_box 2 box\n", -margin,
                  length + margin, -margin, length + margin, dimension == 3 ? -margin : -0.5,
                  dimension == 3 ? length + margin : 0.5);
    for (int k = 0; k < N_ATOMS; ++k)
        to += sprintf(to, "create_atoms %d single %.17g %.17g %.17g units box\n", is_mixed && k % 3 == 0 ? 2 : 1,
                      x[k][0], x[k][1], x[k][2]);
    /* the smaller species is half as large, with cutoffs to match */
    to += sprintf(to, "mass * 1.0\nvelocity all create 2.0 4711\npair_style lj/cut 2.5\npair_coeff 1 1 1.0 1.0 2.5\n"
                      "pair_coeff 2 2 1.0 0.5 1.25\npair_coeff 1 2 1.0 0.75 1.875\n");
    to += sprintf(to, "neighbor 0.1 bin\nneigh_modify every 4 delay 0 check no\nneighbor_method %s\n", method);
    to += sprintf(to, "fix 1 all nve\ntimestep 0.002\nrun 10\n");
    ck_assert_int_lt((int)(to - text), TEXT_SIZE);
}

/** Forces by id, energy and virial of the last step. */
typedef struct result {
    double f[N_ATOMS][3], energy, virial[6];
    int n_forced; /**< atoms with a force */
} result;

static void keep_result(hs_deck *deck, void *context)
{
    result *kept = context;
    const hs_atoms *atoms = &deck->sim->atoms;
    ck_assert_int_eq(atoms->n_local, N_ATOMS);
    for (int i = 0; i < atoms->n_local; ++i) {
        for (int axis = 0; axis < 3; ++axis) kept->f[atoms->id[i] - 1][axis] = atoms->f[axis][i];
        kept->n_forced += atoms->f[0][i] != 0.0;
    }
    kept->energy = deck->sim->env.pair_energy;
    memcpy(kept->virial, deck->sim->env.pair_virial, sizeof kept->virial);
}

static void run(const char *text, int n_threads, result *kept)
{
    hs_error err = {0};
    const hs_options options = {.n_threads = n_threads};
    *kept = (result){.n_forced = 0};
    free(hs_test_run_deck_with(text, &options, keep_result, kept, &err));
    ck_assert_msg(err.status == HS_OK, "%s", err.text);
}

/** Sums in another order: 1e-15 of the terms, of which the largest are some hundred; 10 steps of motion make at most
 *  1e3 of it. */
static void compare(const result *right, const result *other, const char *what)
{
    const double tolerance = 1e-9;
    for (int i = 0; i < N_ATOMS; ++i)
        for (int axis = 0; axis < 3; ++axis)
            ck_assert_msg(fabs(right->f[i][axis] - other->f[i][axis]) < tolerance,
                          "%s: force %c of atom %d: %.15g, not %.15g", what, "xyz"[axis], i + 1, other->f[i][axis],
                          right->f[i][axis]);
    ck_assert_msg(fabs(right->energy - other->energy) < tolerance * N_ATOMS, "%s: energy %.15g, not %.15g", what,
                  other->energy, right->energy);
    for (int k = 0; k < 6; ++k)
        ck_assert_msg(fabs(right->virial[k] - other->virial[k]) < tolerance * N_ATOMS,
                      "%s: virial %d: %.15g, not %.15g", what, k, other->virial[k], right->virial[k]);
}

static void check(int dimension, bool is_periodic, bool is_mixed, double density)
{
    static char text[TEXT_SIZE];
    static result right, other;
    char what[160];
    write_deck(text, dimension, is_periodic, is_mixed, density, "nsq");
    run(text, 1, &right);
    ck_assert_int_gt(right.n_forced, N_ATOMS / 2); /* the comparison is of something */
    for (int k = 0; k < N_METHODS_HERE; ++k) {
        write_deck(text, dimension, is_periodic, is_mixed, density, methods[k]);
        run(text, 1 + k % 3, &other);
        snprintf(what, sizeof what, "%dD, %s, %s, density %g, %s", dimension, is_periodic ? "periodic" : "closed",
                 is_mixed ? "two sizes" : "one size", density, methods[k]);
        compare(&right, &other, what);
    }
}

START_TEST(all_methods) { check(2 + _i % 2, _i / 2 % 2, _i / 4 % 2, densities[_i / 8]); }
END_TEST

HS_LOOP_TEST_MAIN("textbook methods", {all_methods, 8 * N_DENSITIES})
