/* Stochastic motion against exact solutions: free, trapped and active Brownian particles, Langevin dynamics.
 *
 * All seeds are fixed, so every run gives the same numbers. Means are compared within 3 standard errors of the sample
 * (0.3 % by chance, once, when the seeds were chosen), distributions by Kolmogorov-Smirnov at the 1 % limit
 * 1.63/sqrt(n). */
#include "physics/physics.h"

typedef struct estimate {
    double mean, error; /**< standard error of the mean */
} estimate;

static estimate mean_of(const double *sample, int64_t n)
{
    estimate e = {0};
    for (int64_t i = 0; i < n; ++i) e.mean += sample[i] / (double)n;
    for (int64_t i = 0; i < n; ++i) e.error += (sample[i] - e.mean) * (sample[i] - e.mean);
    e.error = sqrt(e.error / (double)(n - 1) / (double)n);
    return e;
}

#define CHECK_MEAN(what, estimated, exact)                                                                             \
    ck_assert_msg(fabs((estimated).mean - (exact)) < 3.0 * (estimated).error, "%s: %.8g +- %.2g, theory %.8g", what,   \
                  (estimated).mean, (estimated).error, (double)(exact))

static int by_value(const void *a, const void *b)
{
    const double p = *(const double *)a, q = *(const double *)b;
    return (p > q) - (p < q);
}

/** Whether a sample is normal with mean 0 and that variance. */
static void check_normal(const char *what, double *sample, int64_t n, double variance)
{
    double distance = 0.0;
    qsort(sample, (size_t)n, sizeof *sample, by_value);
    for (int64_t i = 0; i < n; ++i) {
        const double expected = 0.5 * erfc(-sample[i] / sqrt(2.0 * variance));
        distance =
            fmax(distance, fmax(fabs(expected - (double)i / (double)n), fabs(expected - (double)(i + 1) / (double)n)));
    }
    ck_assert_msg(distance < 1.63 / sqrt((double)n), "%s: Kolmogorov-Smirnov distance %g of %lld numbers", what,
                  distance, (long long)n);
}

/** Squared displacements of all atoms since @p x0. The caller frees them. */
static double *squared_displacements(experiment *e, const double *x0)
{
    const int64_t n = hs_simulation_n_atoms(e->simulation);
    double *x, *v, *r2 = new_vector(n);
    get_state(e, &x, &v);
    for (int64_t i = 0; i < n; ++i)
        for (int axis = 0; axis < 3; ++axis) r2[i] += pow(x[3 * i + axis] - x0[3 * i + axis], 2);
    free(x), free(v);
    return r2;
}

/** Particles that do not know of each other, far from nothing. */
static void free_particles(experiment *e, int dimension, int64_t n, const char *style)
{
    deck(e,
         "units lj\ndimension %d\natom_style %s\nregion all block 0 20 0 20 %s units box\ncreate_box 1 all\n"
         "create_atoms 1 random %lld 4242 NULL\n",
         dimension, style, dimension == 2 ? "-0.5 0.5" : "0 20", (long long)n);
    deck(e, "pair_style none\nthermo 1000000\n");
}

/* Active Brownian particles: D_t = 0.8, speed 3, persistence time tau = 1 / ((d - 1) D_r), from t = 0 to 3 tau. */
static void check_free_abp(int dimension, const char *rng)
{
    enum { N = 4000 };
    const double gamma_t = 1.25, speed = 3.0, d_r = 0.7, tau = 1.0 / ((dimension - 1) * d_r), dt = 0.002 * tau;
    experiment e;
    double *x0, *v0;
    open_experiment(&e, 1);
    free_particles(&e, dimension, N, "hybrid dipole sphere");
    deck(&e,
         "set type 1 dipole 1 0 0\nfix 1 all brownian/sphere 1.0 77 gamma_t %g gamma_r %.17g rng %s\n"
         "fix 2 all propel/self dipole %g\ntimestep %.17g\n",
         gamma_t, 1.0 / d_r, rng, speed * gamma_t, dt);
    deck(&e, "compute mu all property/atom mux mu\ncompute mean all reduce ave c_mu[1] c_mu[2]\n"
             "thermo_style custom step c_mean[1] c_mean[2]\nthermo_modify format float %%.17g\nthermo 500\n");
    get_state(&e, &x0, &v0);
    for (int k = 1; k <= 3; ++k) {
        deck(&e, "run 500\n");
        const double t = 500.0 * k * dt;
        double *r2 = squared_displacements(&e, x0);
        /* Euler steps and the sum over steps for the integral: off by less than dt / tau = 0.2 %, the error is 1.5 % */
        const double exact =
            2.0 * dimension * t / gamma_t + 2.0 * pow(speed * tau, 2) * (t / tau - 1.0 + exp(-t / tau));
        CHECK_MEAN("mean-square displacement", mean_of(r2, N), exact);
        free(r2);
        table means = last_table(&e);
        const double c = exp(-t / tau), correlation = cell(&means, means.n_rows - 1, 1);
        /* variance of cos: (1 + <cos 2 theta>)/2 - c^2 with <cos 2 theta> = c^4 in the plane; (1 + 2 <P_2>)/3 - c^2 with
           <P_2> = c^3 in space */
        const double variance = (dimension == 2 ? (1.0 + pow(c, 4)) / 2.0 : (1.0 + 2.0 * pow(c, 3)) / 3.0) - c * c;
        const estimate e_mean = {.mean = correlation, .error = sqrt(variance / N)};
        CHECK_MEAN("orientation correlation", e_mean, c);
        ck_assert_double_eq_tol(cell(&means, means.n_rows - 1, 2), 1.0, 1e-12);
        free(means.value);
    }
    free(x0), free(v0);
    close_experiment(&e);
}

START_TEST(test_free_abp_2d) { check_free_abp(2, "gaussian"); }
END_TEST
START_TEST(test_free_abp_2d_uniform) { check_free_abp(2, "uniform"); }
END_TEST
START_TEST(test_free_abp_3d) { check_free_abp(3, "gaussian"); }
END_TEST

/** In two dimensions with normal noise, orientations are exact for any timestep: here one of D_r dt = 0.5. */
START_TEST(test_rotation_is_exact_for_long_steps)
{
    enum { N = 20000 };
    experiment e;
    open_experiment(&e, 1);
    free_particles(&e, 2, N, "dipole");
    deck(&e,
         "mass 1 1.0\nset type 1 dipole 0 2 0\nfix 1 all brownian/sphere 1.0 5 gamma_t 1.0 gamma_r 1.0 rng gaussian\n"
         "timestep 0.5\ncompute mu all property/atom muy\ncompute mean all reduce ave c_mu\n"
         "thermo_style custom step c_mean\nthermo_modify format float %%.17g\nrun 2\n");
    table means = last_table(&e);
    const double c = exp(-1.0);
    const estimate mean = {.mean = 0.5 * cell(&means, means.n_rows - 1, 1),
                           .error = sqrt(((1.0 + pow(c, 4)) / 2.0 - c * c) / N)};
    CHECK_MEAN("orientation after two long steps", mean, c);
    free(means.value);
    close_experiment(&e);
}
END_TEST

/** Free diffusion of points: displacements are normal with variance 2 D t, D = kT / gamma_t. */
START_TEST(test_free_brownian)
{
    enum { N = 5000 };
    experiment e;
    double *x0, *v0, *x, *v, *dx = new_vector(2 * N);
    open_experiment(&e, 1);
    free_particles(&e, 2, N, "atomic");
    deck(&e, "mass 1 1.0\nfix 1 all brownian 2.5 99 gamma_t 4.0\ntimestep 0.01\n");
    get_state(&e, &x0, &v0);
    deck(&e, "run 200\n");
    get_state(&e, &x, &v);
    for (int64_t i = 0; i < N; ++i)
        for (int axis = 0; axis < 2; ++axis) dx[2 * i + axis] = x[3 * i + axis] - x0[3 * i + axis];
    check_normal("displacements", dx, 2 * N, 2.0 * 2.5 / 4.0 * 2.0);
    for (int64_t i = 0; i < N; ++i) ck_assert(x[3 * i + 2] == x0[3 * i + 2]);
    free(x0), free(v0), free(x), free(v), free(dx);
    close_experiment(&e);
}
END_TEST

/** A Brownian particle on a spring: the Euler-Maruyama scheme has the variance (kT/k) / (1 - k dt / (2 gamma))
 *  exactly. */
START_TEST(test_trapped_brownian)
{
    enum { N = 4000 };
    const double k = 5.0, gamma = 2.0, dt = 0.2, t = 1.5;
    experiment e;
    double *x0, *v0, *x, *v, *dx = new_vector(3 * N);
    open_experiment(&e, 1);
    free_particles(&e, 3, N, "atomic");
    deck(&e, "mass 1 1.0\nfix trap all spring/self %g\nfix 1 all brownian %g 31 gamma_t %g rng gaussian\ntimestep %g\n",
         k, t, gamma, dt);
    get_state(&e, &x0, &v0);
    deck(&e, "run 60\n"); /* (1 - k dt / gamma)^60 = 1e-18 */
    get_state(&e, &x, &v);
    for (int64_t i = 0; i < 3 * N; ++i) dx[i] = x[i] - x0[i];
    const double variance = t / k / (1.0 - k * dt / (2.0 * gamma));
    double *square = new_vector(3 * N);
    for (int64_t i = 0; i < 3 * N; ++i) square[i] = dx[i] * dx[i];
    CHECK_MEAN("variance in the trap", mean_of(square, 3 * N), variance);
    check_normal("places in the trap", dx, 3 * N, variance);
    /* the fix's energy is that of the springs */
    double energy = 0.0;
    for (int64_t i = 0; i < 3 * N; ++i) energy += 0.5 * k * square[i];
    deck(&e, "thermo_style custom step f_trap\nthermo_modify norm no format float %%.17g\nrun 0\n");
    table f = last_table(&e);
    ck_assert_double_eq_tol(cell(&f, 0, 1), energy, 1e-9 * energy); /* unwrapped coordinates are rounded to 1e-14 */
    free(f.value);
    free(x0), free(v0), free(x), free(v), free(dx), free(square);
    close_experiment(&e);
}
END_TEST

/** Free Langevin particles: Maxwell's velocities, and <r^2> = 6 D (t - damp (1 - exp(-t/damp))), D = kT damp / m. The
 *  scheme has both exactly at whole steps, but for the exponential. */
START_TEST(test_free_langevin)
{
    enum { N = 4000 };
    const double t = 1.7, damp = 0.5, mass = 2.5, dt = 0.005;
    experiment e;
    double *x0, *v0, *x, *v;
    open_experiment(&e, 1);
    free_particles(&e, 3, N, "atomic");
    deck(&e,
         "mass 1 %g\nvelocity all create %g 12 dist gaussian loop geom\nfix 1 all nve\nfix 2 all langevin %g %g %g 48\n"
         "timestep %g\nrun 400\n",
         mass, t, t, t, damp, dt);
    get_state(&e, &x0, &v0);
    deck(&e, "run 600\n");
    get_state(&e, &x, &v);
    const double time = 600 * dt, d = t * damp / mass;
    double *r2 = squared_displacements(&e, x0);
    CHECK_MEAN("Langevin displacement", mean_of(r2, N), 6.0 * d * (time - damp * (1.0 - exp(-time / damp))));
    /* velocities forget themselves: <v(t) v(0)> = (kT/m) exp(-t/damp) */
    double *product = new_vector(3 * N);
    for (int64_t i = 0; i < 3 * N; ++i) product[i] = v[i] * v0[i];
    CHECK_MEAN("velocity correlation", mean_of(product, 3 * N), t / mass * exp(-time / damp));
    check_normal("Langevin velocities", v, 3 * N, t / mass);
    free(x0), free(v0), free(x), free(v), free(r2), free(product);
    close_experiment(&e);
}
END_TEST

/** Equipartition in a WCA mixture of light and heavy particles under Langevin dynamics: m <v^2> = 3 kT for both; with
 *  `tally yes` the energy given to the bath and the system's own sum to a constant. */
START_TEST(test_equipartition)
{
    experiment e;
    double *x, *v;
    open_experiment(&e, 1);
    deck(&e,
         "units lj\nlattice sc 0.5\nregion b block 0 12 0 12 0 12\ncreate_box 2 b\ncreate_atoms 1 box\n"
         "set type 1 type/ratio 2 0.5 771\nmass 1 1.0\nmass 2 9.0\npair_style wca\npair_coeff * * 1.0 1.0\n"
         "velocity all create 0.5 9 loop geom\nfix 1 all nve\nfix 2 all langevin 1.2 1.2 0.5 48 tally yes zero yes\n"
         "timestep 0.004\nthermo_modify norm no format float %%.17g\n");
    deck(&e, "thermo_style custom step etotal f_2\nthermo_modify norm no format float %%.17g\nthermo 100\nrun 1500\n");
    table t = last_table(&e);
    const double start = cell(&t, 0, 1) + cell(&t, 0, 2);
    /* the sum changes by the integrator's error of order dt^2 per atom, far below the energy exchanged */
    const int last = t.n_rows - 1;
    ck_assert_double_gt(fabs(cell(&t, last, 2)), 1000.0);
    ck_assert_double_eq_tol(cell(&t, last, 1) + cell(&t, last, 2), start, 0.03 * fabs(cell(&t, last, 2)));
    free(t.value);
    get_state(&e, &x, &v);
    const int64_t n = hs_simulation_n_atoms(e.simulation);
    int32_t *type = calloc((size_t)n, sizeof *type);
    need(&e, hs_simulation_get_types(e.simulation, HS_ORDER_ID, n, type));
    double *mv2[2] = {new_vector(3 * n), new_vector(3 * n)}, momentum[3] = {0.0};
    int64_t count[2] = {0, 0};
    for (int64_t i = 0; i < 3 * n; ++i) {
        const int k = type[i / 3] - 1;
        const double mass = k == 0 ? 1.0 : 9.0;
        mv2[k][count[k]++] = mass * v[i] * v[i];
        momentum[i % 3] += mass * v[i];
    }
    for (int k = 0; k < 2; ++k) CHECK_MEAN("m v^2 of a type", mean_of(mv2[k], count[k]), 1.2);
    (void)momentum;
    free(x), free(v), free(type), free(mv2[0]), free(mv2[1]);
    close_experiment(&e);
}
END_TEST

/** Free spheres that turn in a bath: k T for each direction of rotation, and angular velocities forgotten in (3/10) damp, the
 *  time of a sphere that a fluid sticks to; in the plane they turn about z alone. Standard errors: sqrt(2/n) and 1/sqrt(n) for n
 *  directions; four of them are allowed, and the scheme's error of order (dt/damp)^2 is far less. */
START_TEST(test_rotating_spheres)
{
    enum { N = 4000 };
    const int dimension = _i == 0 ? 3 : 2;
    const double t = 1.7, damp = 0.5, dt = 0.002, time = 100 * dt;
    experiment e;
    open_experiment(&e, 1);
    free_particles(&e, dimension, N, "sphere");
    deck(&e,
         "set group all diameter 1.3\nvelocity all create %g 12 dist gaussian loop geom\nfix 1 all nve/sphere\n"
         "fix 2 all langevin %g %g %g 48 omega yes\ncompute r all temp/sphere dof rotate\n"
         "compute w all property/atom omegax omegay omegaz\ntimestep %g\nrun 400\n",
         t, t, t, damp, dt);
    deck(&e,
         "fix s all store/state 0 c_w[1] c_w[2] c_w[3]\n"
         "variable p atom 0.4*mass*0.65^2*(c_w[1]*f_s[1]+c_w[2]*f_s[2]+c_w[3]*f_s[3])\ncompute p all reduce sum v_p\n"
         "compute m all reduce max c_w[1] c_w[2]\nthermo_style custom step c_r c_p c_m[1] c_m[2]\n"
         "thermo_modify norm no format float %%.17g\nrun 100\n");
    table rows = last_table(&e);
    const int last = rows.n_rows - 1;
    const double n = dimension == 3 ? 3.0 * N : N;
    ck_assert_double_eq_tol(cell(&rows, last, 1), t, 4.0 * t * sqrt(2.0 / n));
    ck_assert_double_eq_tol(cell(&rows, last, 2) / n, t * exp(-time * 10.0 / 3.0 / damp), 4.0 * t / sqrt(n));
    if (dimension == 2) ck_assert(cell(&rows, last, 3) == 0.0 && cell(&rows, last, 4) == 0.0);
    free(rows.value);
    close_experiment(&e);
}
END_TEST

/** Spheres that turn without torques: energy of rotation and angular velocity stay, and the dipole goes round at the angle
 *  omega t; with the simple update by atan(omega dt) a step, with DLM right to order dt^2. */
START_TEST(test_free_rotation)
{
    static const char *const words[2] = {"dipole", "dipole/dlm"};
    const double dt = 0.01, omega = 1.5;
    const int n_steps = 200;
    experiment e;
    open_experiment(&e, 1);
    deck(&e,
         "units lj\natom_style hybrid dipole sphere\nregion b block 0 10 0 10 0 10\ncreate_box 1 b\n"
         "create_atoms 1 single 5 5 5\nset group all dipole 0.5 0 1.2\nset group all omega 0 0 %g\npair_style none\n"
         "timestep %g\nfix 1 all nve/sphere update %s\ncompute w all property/atom mux muy muz omegaz\n"
         "compute s all reduce sum c_w[1] c_w[2] c_w[3] c_w[4]\ncompute e all erotate/sphere\n"
         "thermo_style custom step c_s[*] c_e\nthermo_modify norm no format float %%.17g lost ignore\nrun %d\n",
         omega, dt, words[_i], n_steps);
    table t = last_table(&e);
    const int last = t.n_rows - 1;
    const double angle = n_steps * (_i == 0 ? atan(omega * dt) : omega * dt);
    if (_i == 1) {
        const double error = 5.0 * omega * omega * dt * dt; /* of the angle, a few (omega dt)^2 */
        ck_assert_double_eq_tol(atan2(cell(&t, last, 2), cell(&t, last, 1)), remainder(angle, 2.0 * M_PI), error);
        ck_assert_double_eq_tol(cell(&t, last, 3), 1.2, error);
    } else { /* brought back to its length, the dipole sinks towards the plane: only the part in it grows */
        ck_assert_double_eq_tol(atan2(cell(&t, last, 2), cell(&t, last, 1)), remainder(angle, 2.0 * M_PI), 1e-12);
    }
    const double length = sqrt(pow(cell(&t, last, 1), 2) + pow(cell(&t, last, 2), 2) + pow(cell(&t, last, 3), 2));
    ck_assert_double_eq_tol(length, 1.3, 1e-13);
    ck_assert_double_eq_tol(cell(&t, last, 4), omega, 1e-3 * omega);
    ck_assert_double_eq_tol(cell(&t, last, 5), cell(&t, 0, 5), 1e-12);
    free(t.value);
    close_experiment(&e);
}
END_TEST

/** Active particles that repel each other: the same bits on one thread and on three, and after the run is cut in
 *  two. */
START_TEST(test_threads_and_cut_runs)
{
    double *x[3], *v[3];
    for (int k = 0; k < 3; ++k) {
        experiment e;
        open_experiment(&e, k == 1 ? 3 : 1);
        deck(&e,
             "units lj\ndimension 2\natom_style hybrid dipole sphere\nlattice sq 0.6\nregion b block 0 30 0 30 -0.5 "
             "0.5\n"
             "create_box 1 b\ncreate_atoms 1 box\nset type 1 dipole/random 5 1.0\npair_style wca\npair_coeff 1 1 10 1\n"
             "neighbor_method nsq\nfix 1 all brownian/sphere 1.0 3 gamma_t 1 gamma_r 0.3\nfix 2 all propel/self dipole "
             "20\n"
             "timestep 1e-4\n");
        deck(&e, k == 2 ? "run 20\nrun 30\n" : "run 50\n");
        get_state(&e, &x[k], &v[k]);
        close_experiment(&e);
    }
    for (int i = 0; i < 3 * 900; ++i) {
        /* sums of pair forces differ in the last bits between numbers of threads, noise does not */
        ck_assert_double_eq_tol(x[0][i], x[1][i], 1e-9);
        ck_assert(x[0][i] == x[2][i]);
    }
    for (int k = 0; k < 3; ++k) free(x[k]), free(v[k]);
}
END_TEST

HS_LOOP_TEST_MAIN("active matter", {test_free_abp_2d, 1}, {test_free_abp_2d_uniform, 1}, {test_free_abp_3d, 1},
                  {test_rotation_is_exact_for_long_steps, 1}, {test_free_brownian, 1}, {test_trapped_brownian, 1},
                  {test_free_langevin, 1}, {test_equipartition, 1}, {test_rotating_spheres, 2}, {test_free_rotation, 2},
                  {test_threads_and_cut_runs, 1})
