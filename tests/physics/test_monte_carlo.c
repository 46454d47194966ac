/* Monte Carlo moves and test particles against what is known exactly: all states of a few fixed atoms, compositions of ideal
 * mixtures, the chemical potential in an ideal gas of independent atoms, and in a dilute one by the second virial coefficient. */
#include <math.h>

#include "physics/physics.h"

enum { N_FIXED = 5, N_STATES = 1 << N_FIXED };

static const double box = 5.2, cutoff = 2.5, temperature = 1.5, mu_2 = 0.4;
static const double place[N_FIXED][3] = {
    {0.3, 0.4, 0.2}, {1.4, 0.5, 5.0}, {0.5, 1.5, 0.3}, {5.0, 0.6, 1.2}, {1.2, 1.4, 1.1}};
/* of types 1 1, 1 2, 2 2 */
static const double epsilon[3] = {1.0, 0.7, 1.0}, sigma[3] = {1.0, 0.95, 0.9};

/** Energy of the fixed atoms, bit k of the state is set where atom k is of type 2; *n2 counts these. */
static double energy_of(int state, int *n2)
{
    double sum = 0.0;
    *n2 = 0;
    for (int i = 0; i < N_FIXED; ++i) {
        *n2 += state >> i & 1;
        for (int j = 0; j < i; ++j) {
            const int pair = (state >> i & 1) + (state >> j & 1);
            double r2 = 0.0;
            for (int axis = 0; axis < 3; ++axis) r2 += pow(remainder(place[i][axis] - place[j][axis], box), 2);
            const double s6 = pow(sigma[pair] * sigma[pair] / r2, 3);
            if (r2 < cutoff * cutoff) sum += 4.0 * epsilon[pair] * s6 * (s6 - 1.0);
        }
    }
    return sum;
}

/** How often each state occurs: chi squared below the value that 0.1 % of right programs exceed. Fifty moves of five atoms lie
 *  between samples, which are as good as independent; 53, for after as many as there are atoms most of them, each moved once,
 *  would have the other type. */
static void check_states(bool is_semi_grand)
{
    enum { N_STEPS = 6000, N_MOVES = 53 };
    experiment e;
    open_experiment(&e, 1);
    deck(&e, "units lj\nregion b block 0 %g 0 %g 0 %g\ncreate_box 2 b\n", box, box, box);
    for (int k = 0; k < N_FIXED; ++k)
        deck(&e, "create_atoms %d single %g %g %g\n", 1 + k % 2, place[k][0], place[k][1], place[k][2]);
    deck(&e, "mass * 1.0\npair_style lj/cut %g\n", cutoff);
    for (int k = 0; k < 3; ++k)
        deck(&e, "pair_coeff %d %d %g %g\n", k < 2 ? 1 : 2, k > 0 ? 2 : 1, epsilon[k], sigma[k]);
    deck(&e,
         "fix w all atom/swap 1 %d 4711 %g %s types 1 2 %s\nvariable s atom (type-1)*0.5*2.0^id\n"
         "compute s all reduce sum v_s\nthermo_style custom step c_s pe f_w[1] f_w[2]\n"
         "thermo_modify norm no format float %%.12g\nthermo 1\nrun %d\n",
         N_MOVES, temperature, is_semi_grand ? "semi-grand yes" : "", is_semi_grand ? "mu 0.0 0.4" : "", N_STEPS);
    table t = last_table(&e);
    double weight[N_STATES], total = 0.0, chi2 = 0.0;
    int count[N_STATES] = {0}, n_states = 0;
    for (int row = 1; row < t.n_rows; ++row) {
        int n2;
        const int state = (int)cell(&t, row, 1);
        ck_assert_double_eq_tol(cell(&t, row, 2), energy_of(state, &n2), 1e-9);
        ++count[state];
    }
    for (int s = 0; s < N_STATES; ++s) {
        int n2;
        const double u = energy_of(s, &n2);
        weight[s] = is_semi_grand ? exp((mu_2 * n2 - u) / temperature) : n2 == 2 ? exp(-u / temperature) : 0.0;
        n_states += weight[s] > 0.0;
        total += weight[s];
    }
    for (int s = 0; s < N_STATES; ++s) {
        const double expected = N_STEPS * weight[s] / total;
        if (weight[s] > 0.0)
            chi2 += pow(count[s] - expected, 2) / expected;
        else
            ck_assert_int_eq(count[s], 0);
    }
    printf("%s: chi squared %.1f of %d states\n", is_semi_grand ? "semi-grand" : "swaps", chi2, n_states);
    ck_assert_int_eq(n_states, is_semi_grand ? 32 : 10);
    ck_assert_double_lt(chi2, is_semi_grand ? 61.1 : 27.9); /* 31 and 9 degrees of freedom */
    ck_assert_double_eq(cell(&t, t.n_rows - 1, 3), (double)N_MOVES * N_STEPS);
    ck_assert_double_lt(cell(&t, t.n_rows - 1, 4), (double)N_MOVES * N_STEPS);
    free(t.value);
    close_experiment(&e);
}

START_TEST(test_all_states) { check_states(_i == 1); }
END_TEST

/** Three types that do not interact: each atom's type has the probability exp(mu / kT) / sum. Kinetic energies stay. */
START_TEST(test_ideal_mixture)
{
    const double mu[3] = {0.0, 0.7, -0.4};
    double total = 0.0;
    experiment e;
    open_experiment(&e, 2);
    deck(&e, "units lj\nregion b block 0 20 0 20 0 20\ncreate_box 4 b\ncreate_atoms 1 random 3000 77 NULL\n"
             "create_atoms 4 random 500 78 NULL\nmass 1 1.0\nmass 2 4.0\nmass 3 0.5\nmass 4 1\n"
             "pair_style zero 1.0\npair_coeff * *\nvelocity all create 1.5 9 loop geom\nfix 1 all nve\n");
    deck(&e,
         "fix w all atom/swap 2 9000 12 %g types 1 2 3 semi-grand yes mu %g %g %g\nvariable a atom type==1\n"
         "variable b atom type==2\nvariable c atom type==3\ncompute n all reduce sum v_a v_b v_c\n"
         "thermo_style custom step c_n[1] c_n[2] c_n[3] ke\nthermo_modify norm no format float %%.15g\nrun 5\n",
         temperature, mu[0], mu[1], mu[2]);
    table t = last_table(&e);
    for (int k = 0; k < 3; ++k) total += exp(mu[k] / temperature);
    for (int k = 0; k < 3; ++k) { /* binomial; four standard deviations */
        const double p = exp(mu[k] / temperature) / total;
        ck_assert_double_eq_tol(cell(&t, t.n_rows - 1, 1 + k), 3000 * p, 4.0 * sqrt(3000 * p * (1.0 - p)));
    }
    ck_assert_double_eq_tol(cell(&t, t.n_rows - 1, 4), cell(&t, 0, 4), 1e-9 * cell(&t, 0, 4));
    free(t.value);
    close_experiment(&e);
}
END_TEST

/** -2 B2 of Lennard-Jones, cut at 2.5: the integral of exp(-u/kT) - 1 over space, by Simpson's rule. */
static double mayer_integral(double t)
{
    enum { N = 20000 };
    const double h = cutoff / N;
    double sum = 0.0;
    for (int k = 0; k <= N; ++k) {
        const double r = k * h, s6 = k > 0 ? pow(r, -6) : 0.0;
        const double f = (k > 0 ? exp(-4.0 * s6 * (s6 - 1.0) / t) : 0.0) - 1.0;
        sum += (k == 0 || k == N ? 1.0 : k % 2 == 1 ? 4.0 : 2.0) * 4.0 * M_PI * r * r * f;
    }
    return sum * h / 3.0;
}

/** Test particles that see N atoms which do not see each other: <exp(-u/kT)> = (1 - 2 B2 / V)^N, in a tilted box too. */
START_TEST(test_independent_atoms)
{
    const double t = 1.5, volume = 12.0 * 11.0 * 10.0;
    enum { N = 260 };
    experiment e;
    open_experiment(&e, 2);
    deck(&e,
         "units lj\nregion b %s\ncreate_box 2 b\ncreate_atoms 1 random %d 77 NULL\nmass * 1.0\n"
         "pair_style lj/cut %g\npair_coeff * * 1.0 1.0\npair_coeff 1 1 0.0 1.0\nvelocity all create 2.0 9 loop geom\n"
         "fix 1 all nve\ntimestep 0.05\nfix w all widom 10 2000 2 4711 %g\nthermo_style custom step f_w[*]\n"
         "thermo_modify norm no format float %%.12g\nrun 1000\n",
         _i == 0 ? "block 0 12 0 11 0 10" : "prism 0 12 0 11 0 10 4 -5 3", N, cutoff, t);
    table rows = last_table(&e);
    const int last = rows.n_rows - 1;
    const double expected = -t * N * log(1.0 + mayer_integral(t) / volume);
    const double mu = cell(&rows, last, 4), error = cell(&rows, last, 5);
    printf("independent atoms: mu_ex %.5f, error %.5f, exact %.5f\n", mu, error, expected);
    ck_assert_double_lt(error, 0.02);
    ck_assert_double_eq_tol(mu, expected, 4.0 * error);
    ck_assert_double_eq_tol(cell(&rows, last, 3), volume, 1e-9);
    ck_assert_double_eq_tol(cell(&rows, last, 1), -t * log(cell(&rows, last, 2)), 1e-9);
    free(rows.value);
    close_experiment(&e);
}
END_TEST

/** A dilute gas: mu_ex = 2 kT B2 n to first order; the next, (3/2) kT C n^2 with the third coefficient C < 4, is below
 *  1e-3. With pair_modify tail the same test particles give (2 N + 1) times the correction of one pair more. */
START_TEST(test_dilute_gas)
{
    const double t = 2.0;
    enum { N = 500 };
    const double length = 37.0, density = N / (length * length * length);
    double mu[2], error = 0.0;
    for (int k = 0; k < 2; ++k) {
        experiment e;
        open_experiment(&e, 2);
        deck(&e,
             "units lj\nregion b block 0 %g 0 %g 0 %g\ncreate_box 1 b\nlattice sc %.17g\ncreate_atoms 1 random %d 77 "
             "NULL\n"
             "mass 1 1.0\npair_style lj/cut %g\npair_coeff 1 1 1.0 1.0\npair_modify tail %s\nneigh_modify one 4000\n",
             length, length, length, density, N, cutoff, k == 1 ? "yes" : "no");
        deck(&e,
             "minimize 0 1e-3 1000 1000\nvelocity all create %g 9 loop geom\nfix 1 all nvt temp %g %g 1.0\n"
             "timestep 0.005\nrun 1000\nfix w all widom 50 3000 1 4711 %g\nthermo_style custom step f_w[*]\n"
             "thermo_modify norm no format float %%.12g\nrun 3000\n",
             t, t, t, t);
        table rows = last_table(&e);
        mu[k] = cell(&rows, rows.n_rows - 1, 4);
        error = cell(&rows, rows.n_rows - 1, 5);
        free(rows.value);
        close_experiment(&e);
    }
    const double expected = -t * mayer_integral(t) * density, s3 = pow(cutoff, -3);
    const double tail = 8.0 / 3.0 * M_PI * (pow(s3, 3) / 3.0 - s3) * (2 * N + 1) / (length * length * length);
    printf("dilute gas: mu_ex %.5f, error %.5f, second virial coefficient %.5f; tail %.6f, exact %.6f\n", mu[0], error,
           expected, mu[1] - mu[0], tail);
    ck_assert_double_lt(error, 0.1 * fabs(expected));
    ck_assert_double_eq_tol(mu[0], expected, 4.0 * error + 1e-3);
    ck_assert_double_eq_tol(mu[1] - mu[0], tail, 1e-6);
}
END_TEST

/** Mean of a column from row @p first on, and its error by 25 blocks. */
static double mean_of_column(const table *t, int column, int first, double *error)
{
    enum { N_BLOCKS = 25 };
    const int length = (t->n_rows - first) / N_BLOCKS;
    double sum = 0.0, sum2 = 0.0;
    for (int b = 0; b < N_BLOCKS; ++b) {
        double mean = 0.0;
        for (int k = 0; k < length; ++k) mean += cell(t, first + b * length + k, column) / length;
        sum += mean;
        sum2 += mean * mean;
    }
    const double mean = sum / N_BLOCKS;
    *error = sqrt((sum2 / N_BLOCKS - mean * mean) / (N_BLOCKS - 1));
    return mean;
}

/** Grand canonical ideal gas: N is Poisson's, of the mean z V; new atoms have Maxwell's velocities; others stay. */
START_TEST(test_ideal_exchange)
{
    const double volume = 6.0 * 5.0 * 4.0, expected = 40.0, mu = temperature * log(expected / volume), mass = 2.5;
    double error, error2, variance = 0.0;
    experiment e;
    open_experiment(&e, 1);
    deck(&e,
         "units lj\nregion b prism 0 6 0 5 0 4 1 -0.5 0.7\ncreate_box 2 b\ncreate_atoms 2 random 5 77 NULL\nmass 1 %g\n"
         "mass 2 1.0\npair_style none\nfix g all gcmc 1 160 40 1 4711 %g %g 2.0\nvariable o atom type==2\n"
         "compute o all reduce sum v_o\nvariable n equal atoms-c_o\nvariable k equal ke\n"
         "thermo_style custom step v_n v_k c_o f_g[1] f_g[3] f_g[5]\nthermo_modify norm no format float %%.12g\n"
         "thermo 1\ncompute_modify thermo_temp extra/dof 0 dynamic/dof yes\nrun 3000\n",
         mass, temperature, mu);
    table t = last_table(&e);
    const double mean = mean_of_column(&t, 1, 20, &error), kinetic = mean_of_column(&t, 2, 20, &error2);
    for (int row = 20; row < t.n_rows; ++row) variance += pow(cell(&t, row, 1) - mean, 2) / (t.n_rows - 20);
    printf("ideal gas: N %.2f, error %.2f, exact %.0f; variance %.1f; kinetic energy %.2f, error %.2f\n", mean, error,
           expected, variance, kinetic, error2);
    ck_assert_double_lt(error, 0.5);
    ck_assert_double_eq_tol(mean, expected, 4.0 * error);
    /* of n independent values the variance is known to sqrt(2/n); some 160 exchanges of 40 atoms lie between steps */
    ck_assert_double_eq_tol(variance, expected, 4.0 * sqrt(2.0 / 1000.0) * expected);
    ck_assert_double_eq_tol(kinetic, 1.5 * temperature * mean, 4.0 * error2 + 4.0 * 1.5 * temperature * error);
    ck_assert_double_eq(cell(&t, t.n_rows - 1, 3), 5.0);
    ck_assert_double_eq(cell(&t, t.n_rows - 1, 4) + cell(&t, t.n_rows - 1, 5) + cell(&t, t.n_rows - 1, 6),
                        200.0 * 3000.0);
    free(t.value);
    close_experiment(&e);
}
END_TEST

/** Grand canonical dilute gas: n = z - 2 B2 z^2 + 3 b3 z^3, the last term, with b3 < 2, below 0.3 % of it. */
START_TEST(test_dilute_exchange)
{
    const double t = 2.0, length = 22.0, z = 0.02, volume = length * length * length;
    double error;
    experiment e;
    open_experiment(&e, 1);
    deck(&e,
         "units lj\nregion b block 0 %g 0 %g 0 %g\ncreate_box 1 b\nmass 1 1.0\npair_style lj/cut %g\n"
         "pair_coeff 1 1 1.0 1.0\nneigh_modify one 4000\nfix g all gcmc 1 250 50 1 4711 %g %.17g 3.0\n"
         "thermo_style custom step atoms\nthermo 1\nrun 1300\n",
         length, length, length, cutoff, t, t * log(z));
    table rows = last_table(&e);
    const double mean = mean_of_column(&rows, 1, 25, &error), expected = volume * z * (1.0 + mayer_integral(t) * z);
    printf("dilute gas: N %.2f, error %.2f, second virial coefficient %.2f, ideal %.2f\n", mean, error, expected,
           volume * z);
    ck_assert_double_lt(4.0 * error, 0.5 * (expected - volume * z));
    ck_assert_double_eq_tol(mean, expected, 4.0 * error + 0.003 * expected);
    free(rows.value);
    close_experiment(&e);
}
END_TEST

/** In a region: of a slab that an atom fills half of, the other half is free. */
START_TEST(test_region)
{
    experiment e;
    open_experiment(&e, 1);
    deck(&e, "units lj\nboundary f f f\nregion b block 0 20 0 20 0 20\ncreate_box 1 b\ncreate_atoms 1 single 10 10 10\n"
             "mass 1 1.0\nregion s sphere 10 10 10 2\npair_style harmonic/cut\npair_coeff 1 1 1e30 1.0\n"
             "fix w all widom 1 4000 1 4711 1.0 region s\nthermo_style custom step f_w[*]\n"
             "thermo_modify format float %%.12g\nrun 20\n");
    table t = last_table(&e);
    /* hard spheres of diameter 1: an eighth of the sphere is taken, of 4000 places a tenth of it more or less */
    const double volume = 4.0 / 3.0 * M_PI * 8.0;
    ck_assert_double_eq_tol(cell(&t, t.n_rows - 1, 3), volume, 0.02 * volume);
    ck_assert_double_eq_tol(cell(&t, t.n_rows - 1, 4), -log(7.0 / 8.0), 4.0 * sqrt(1.0 / 8.0 / (7.0 / 8.0) / 80000.0));
    free(t.value);
    close_experiment(&e);
}
END_TEST

HS_LOOP_TEST_MAIN("Monte Carlo", {test_all_states, 2}, {test_ideal_mixture, 1}, {test_independent_atoms, 2},
                  {test_dilute_gas, 1}, {test_ideal_exchange, 1}, {test_dilute_exchange, 1}, {test_region, 1})
