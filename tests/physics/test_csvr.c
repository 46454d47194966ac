/* Canonical sampling by rescaling (fix temp/csvr): the distribution of the kinetic energy, how it forgets, what is
 * conserved. */
#include "physics/physics.h"

/** Free particles: nothing but the thermostat changes their kinetic energy. */
static void open_gas(experiment *e, int n_side, double t, double damping)
{
    open_experiment(e, 1);
    deck(e,
         "region b block 0 %d 0 %d 0 %d\ncreate_box 1 b\nlattice sc 1.0\ncreate_atoms 1 box\nmass 1 1.0\n"
         "pair_style zero 1.0\npair_coeff * *\nvelocity all create %g 4711\ntimestep 0.01\nfix 1 all nve\n"
         "fix 2 all temp/csvr 1.0 1.0 %g 4711\n",
         n_side, n_side, n_side, t, damping);
}

/* n T/T_wanted has the chi-square distribution of n degrees of freedom: mean n, variance 2n, third central moment 8n.
 * With c = exp(-1/2) between samples of a first-order process the means of m samples have (1 + c)/(1 - c) = 4.08
 * times the variance of independent ones; squares forget twice as fast (factor 2.16), cubes three times. Limits are
 * 4.5 standard errors (one in 150,000). */
START_TEST(distribution)
{
    experiment e;
    const int m = 40000;
    const double n = 21.0; /* 8 atoms, 24 - 3 */
    double mean = 0.0, second = 0.0, third = 0.0;
    open_gas(&e, 2, 1.0, 0.02);
    table t = run_table(&e, m, 1, "temp");
    for (int k = 1; k <= m; ++k) mean += n * cell(&t, k, 1) / m;
    for (int k = 1; k <= m; ++k) {
        const double d = n * cell(&t, k, 1) - mean;
        second += d * d / m;
        third += d * d * d / m;
    }
    ck_assert_double_eq_tol(mean, n, 4.5 * sqrt(2.0 * n * 4.08 / m));
    /* fourth central moment 12 n (n + 4) */
    ck_assert_double_eq_tol(second, 2.0 * n, 4.5 * sqrt((12.0 * n * (n + 4.0) - 4.0 * n * n) * 2.16 / m));
    /* sixth: 40 n (3 n^2 + 52 n + 96); the variance of (d^3) with what the mean's own error takes away is below its
     * raw value */
    ck_assert_double_eq_tol(third, 8.0 * n, 4.5 * sqrt(40.0 * n * (3.0 * n * n + 52.0 * n + 96.0) * 4.08 / m));
    free(t.value);
    close_experiment(&e);
}
END_TEST

/* From a temperature far off, the mean decays as exp(-t/Tdamp). Of 1,000 atoms T has a relative spread of some 3 % at
 * most; limits are 5 of those. And what the thermostat has taken is what the atoms have lost. */
START_TEST(decay)
{
    experiment e;
    open_gas(&e, 10, 4.0, 0.5);
    deck(&e, "thermo_modify norm no\n");
    table t = run_table(&e, 200, 10, "temp ke f_2");
    for (int k = 0; k < t.n_rows; ++k) {
        const double expected = 1.0 + 3.0 * exp(-cell(&t, k, 0) * 0.01 / 0.5);
        ck_assert_double_eq_tol(cell(&t, k, 1), expected, 0.15 * expected);
        ck_assert_double_eq_tol(cell(&t, k, 2) + cell(&t, k, 3), cell(&t, 0, 2), 1e-9 * cell(&t, 0, 2));
    }
    free(t.value);
    close_experiment(&e);
}
END_TEST

/* The noise is a function of the step: a run in two parts, on other threads, is the same. */
START_TEST(same_bits)
{
    experiment e;
    double end[2];
    for (int k = 0; k < 2; ++k) {
        open_gas(&e, 3, 1.0, 0.1);
        deck(&e, k == 0 ? "run 20\n" : "run 7\nrun 13\n");
        end[k] = thermo(&e, "ke");
        close_experiment(&e);
    }
    ck_assert(end[0] == end[1]);
}
END_TEST

/* A group of one atom has no temperature (three degrees of freedom go to the center of mass): its velocity stays what it was, and so does
 * that of a group without atoms. */
START_TEST(nothing_to_scale)
{
    static const char *const groups[] = {"id 1", "id 100000"};
    for (int k = 0; k < 2; ++k) {
        experiment e;
        open_gas(&e, 3, 1.0, 0.1);
        deck(&e, "group g %s\nfix 3 g temp/csvr 1.0 1.0 0.1 99\nfix 4 g temp/rescale 1 1.0 1.0 0.0 1.0\n", groups[k]);
        deck(&e, "fix 5 g temp/berendsen 1.0 1.0 0.1\n");
        table t = run_table(&e, 20, 20, "ke f_3 f_4 f_5");
        ck_assert(isfinite(cell(&t, 1, 1)));
        for (int column = 2; column <= 4; ++column) ck_assert_double_eq(cell(&t, 1, column), 0.0);
        free(t.value);
        close_experiment(&e);
    }
}
END_TEST

HS_TEST_MAIN("canonical sampling by rescaling", distribution, decay, same_bits, nothing_to_scale)
