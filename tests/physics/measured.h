/** What the tests of measures share: a deck run to its end with a look at the values that its computes and fixes then
 *  show. */
#ifndef HS_TESTS_MEASURED_H
#define HS_TESTS_MEASURED_H

#include <math.h>
#include <stdio.h>

#include "style/value.h"
#include "support/harness.h"
#include "support/run_deck.h"

/** 500 atoms of a Lennard-Jones liquid in a region five lattice constants wide, 100 steps after the crystal. */
#define LIQUID_OF_500(region)                                                                                          \
    "units lj\nlattice fcc 0.8442\nregion b " region "\ncreate_box 1 b\ncreate_atoms 1 box\nmass 1 1.0\n"              \
    "velocity all create 1.44 87287 loop geom\npair_style lj/cut 2.5\npair_coeff 1 1 1 1\n"                            \
    "neigh_modify every 1 delay 0 check yes\nfix 1 all nve\nrun 100\nreset_timestep 0\n"

/** Run the system and then more lines, with the check at the end. */
static inline void run_after(const char *system, const char *lines, void (*check)(hs_deck *deck, void *context))
{
    hs_error err = {0};
    char deck[8192];
    const hs_options options = {.n_threads = 2};
    snprintf(deck, sizeof deck, "%s%s", system, lines);
    free(hs_test_run_deck_with(deck, &options, check, NULL, &err));
    ck_assert_hs_ok(err.status, err);
}

/** A number, as thermo_style custom would print it: c_ID, f_ID[2], v_name, ... */
static inline double number(hs_deck *deck, const char *word)
{
    hs_error err = {0};
    hs_value value = {0};
    double out;
    hs_env *env = &deck->sim->env;
    const hs_args args = {.command = "test", .n = 1, .word = &word};
    ck_assert_hs_ok(hs_value_init(&value, env, &args, 0, HS_VALUE_NUMBER, &err), err);
    ck_assert_hs_ok(hs_value_number(env, &value, &out, &err), err);
    hs_value_fini(&value);
    return out;
}

static inline void check_number(hs_deck *deck, const char *word, double expected, double tolerance)
{
    const double is = number(deck, word);
    ck_assert_msg(fabs(is - expected) <= tolerance, "%s is %.15g, expected %.15g", word, is, expected);
}

/** A vector or column of an array, which the caller frees with free. */
static inline double *fetch(hs_deck *deck, const char *word, int *n)
{
    hs_error err = {0};
    hs_value value = {0};
    hs_env *env = &deck->sim->env;
    const hs_args args = {.command = "test", .n = 1, .word = &word};
    ck_assert_hs_ok(hs_value_init(&value, env, &args, 0, HS_VALUE_VECTOR, &err), err);
    *n = hs_value_length(env, &value);
    double *out = malloc((size_t)*n * sizeof *out);
    ck_assert_hs_ok(hs_value_vector(env, &value, out, &err), err);
    hs_value_fini(&value);
    return out;
}

static inline void check_equal(hs_deck *deck, const char *a, const char *b, double tolerance)
{
    int n_a, n_b;
    double *x = fetch(deck, a, &n_a), *y = fetch(deck, b, &n_b);
    ck_assert_int_eq(n_a, n_b);
    for (int i = 0; i < n_a; ++i)
        ck_assert_msg(fabs(x[i] - y[i]) <= tolerance, "%s[%d] = %.15g, %s[%d] = %.15g", a, i + 1, x[i], b, i + 1, y[i]);
    free(x);
    free(y);
}

#endif
