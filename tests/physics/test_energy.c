/* Velocity Verlet: the energy error goes with the square of the timestep, the energy does not drift, and reversed
 * velocities lead back to the start.
 * Source: W. C. Swope et al., J. Chem. Phys. 76, 637 (1982), doi:10.1063/1.442716; for the dt^2 of the energy and why
 * there is no drift: E. Hairer, C. Lubich, G. Wanner, Acta Numerica 12, 399 (2003), doi:10.1017/S0962492902000144. */
#include "physics.h"

enum { N_ATOMS = 500, N3 = 3 * N_ATOMS };

/* The force of lj/cut jumps at the cutoff, and every pair that crosses it changes the energy by up to jump * v * dt, a
   random walk that would hide dt^2 at short timesteps. At 4 sigma the jump is 24 (2/4^13 - 1/4^7) = 1.5e-3, 27 times
   smaller than at 2.5. */
static void create_liquid(experiment *e)
{
    open_experiment(e, 1);
    deck(
        e,
        "units lj\nlattice fcc 0.8442\nregion box block 0 5 0 5 0 5\ncreate_box 1 box\ncreate_atoms 1 box\nmass 1 1.0\n"
        "velocity all create 1.44 87287 loop geom\npair_style lj/cut 4.0\npair_modify shift yes\npair_coeff 1 1 1.0 "
        "1.0\n"
        "neighbor 0.3 bin\nneigh_modify every 1 delay 0 check yes\nfix 1 all nve\n");
    ck_assert_int_eq(hs_simulation_n_atoms(e->simulation), N_ATOMS);
}

/** A liquid that has forgotten its crystal. The caller frees x and v. */
static void create_melted(experiment *e, double **x, double **v)
{
    create_liquid(e);
    deck(e, "timestep 0.004\nrun 800\nvelocity all scale 0.75\nrun 400\n");
    get_state(e, x, v);
}

/** Root mean square of the total energy per atom about its mean; the first row is the start. */
static double energy_fluctuation(const table *t)
{
    double mean = 0.0, square = 0.0;
    for (int i = 0; i < t->n_rows; ++i) mean += cell(t, i, 1) / t->n_rows;
    for (int i = 0; i < t->n_rows; ++i) square += (cell(t, i, 1) - mean) * (cell(t, i, 1) - mean) / t->n_rows;
    return sqrt(square);
}

/** The same start, the same time, the same moments of measurement, timesteps over a factor of eight. */
START_TEST(test_error_is_second_order)
{
    /* 0.024 tau between measurements is a whole number of each of these timesteps */
    enum { N_DT = 7, N_SAMPLES = 100 };
    static const int steps_a_sample[N_DT] = {24, 16, 12, 8, 6, 4, 3};
    double log_dt[N_DT], log_error[N_DT], *x, *v;
    experiment e;
    create_melted(&e, &x, &v);
    printf("  dt        rms of E/N - <E/N> over %.3g tau\n", 0.024 * N_SAMPLES);
    for (int k = 0; k < N_DT; ++k) {
        const double dt = 0.024 / steps_a_sample[k];
        set_state(&e, x, v);
        deck(&e, "reset_timestep 0\ntimestep %.17g\n", dt);
        table t = run_table(&e, N_SAMPLES * steps_a_sample[k], steps_a_sample[k], "etotal");
        ck_assert_int_eq(t.n_rows, N_SAMPLES + 1);
        const double error = energy_fluctuation(&t);
        log_dt[k] = log(dt), log_error[k] = log(error);
        printf("  %.4f    %.4e\n", dt, error);
        free(t.value);
    }
    const double slope = slope_of(log_dt, log_error, N_DT);
    printf("  slope %.3f\n", slope);
    ck_assert_double_eq_tol(slope, 2.0, 0.1);
    free(x), free(v);
    close_experiment(&e);
}
END_TEST

/** Over 40 tau the energy keeps to its place. */
START_TEST(test_no_drift)
{
    enum { N_STEPS = 10000, EVERY = 10 };
    const double dt = 0.004;
    double *x, *v;
    experiment e;
    create_melted(&e, &x, &v);
    deck(&e, "reset_timestep 0\n");
    table t = run_table(&e, N_STEPS, EVERY, "etotal");
    double *time = new_vector(t.n_rows), *energy = new_vector(t.n_rows);
    for (int i = 0; i < t.n_rows; ++i) time[i] = dt * cell(&t, i, 0), energy[i] = cell(&t, i, 1);
    const double duration = N_STEPS * dt, drift = duration * slope_of(time, energy, t.n_rows);
    const double fluctuation = energy_fluctuation(&t);
    /* Pairs that cross the cutoff: each atom meets rho 4 pi rc^2 <|v_r|>/2 = 0.8442 * 201 * 0.49 = 83 a tau in one
       direction, twice that in both, half as many pairs; each changes the energy by jump * v dt * u, u even in
       [-1/2, 1/2]: rms 1.5e-3 * 1.2 * 0.004/sqrt(12) = 2e-6. A line through a random walk of n such steps rises by
       about their rms times sqrt(n). */
    const double n_crossings = 83.0 * N_ATOMS * duration, walk = 2e-6 * sqrt(n_crossings) / N_ATOMS;
    printf("  over %g tau at dt %g: drift of E/N %.2e, rms %.2e; random walk at the cutoff %.2e\n", duration, dt, drift,
           fluctuation, walk);
    ck_assert_double_le(fabs(drift), 5.0 * walk);
    ck_assert_double_le(fluctuation, 3e-4); /* of the order of the dt^2 table above: no slow wandering either */
    free(time), free(energy), free(t.value), free(x), free(v);
    close_experiment(&e);
}
END_TEST

static void reverse(experiment *e)
{
    double *v = new_vector(N3);
    need(e, hs_simulation_get_velocities(e->simulation, HS_ORDER_ID, N_ATOMS, v));
    for (int i = 0; i < N3; ++i) v[i] = -v[i];
    need(e, hs_simulation_set_velocities(e->simulation, HS_ORDER_ID, N_ATOMS, v));
    free(v);
}

/** By how much a small random displacement of all atoms grows in so many steps: exp(Lyapunov exponent * time),
 *  measured. */
static double growth_of(experiment *e, const double *x, const double *v, int n_steps)
{
    const double size = 1e-8;
    double *moved = new_vector(N3), *x_end[2], *v_end[2];
    uint64_t state = 12345;
    for (int i = 0; i < N3; ++i) {
        state = state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
        moved[i] = x[i] + size * ((double)(state >> 11) * 0x1p-53 - 0.5);
    }
    const double *const start[2] = {x, moved};
    for (int k = 0; k < 2; ++k) {
        set_state(e, start[k], v);
        need(e, hs_simulation_run(e->simulation, n_steps));
        get_state(e, &x_end[k], &v_end[k]);
    }
    const double growth = distance_of(x_end[0], x_end[1], N3) / distance_of(x, moved, N3);
    for (int k = 0; k < 2; ++k) free(x_end[k]), free(v_end[k]);
    free(moved);
    return growth;
}

/** n steps, velocities reversed, n steps: back at the start, but for rounding and its growth. */
START_TEST(test_reversal)
{
    static const int n_steps[] = {50, 200, 500, 1000};
    double *x, *v;
    experiment e;
    create_melted(&e, &x, &v);
    printf("  steps   distance from start (all atoms)   expected from rounding   growth of a disturbance\n");
    for (size_t k = 0; k < sizeof n_steps / sizeof n_steps[0]; ++k) {
        const int n = n_steps[k];
        const double growth = growth_of(&e, x, v, n);
        double *x_end, *v_end;
        set_state(&e, x, v);
        need(&e, hs_simulation_run(e.simulation, n));
        reverse(&e);
        need(&e, hs_simulation_run(e.simulation, n));
        get_state(&e, &x_end, &v_end);
        /* Every step rounds 3 N coordinates to the position grid, 2^-46 here (rms 2^-46/sqrt(12)). A rounding error made s steps
           from the start, on the way out or back, is carried back to the start over s steps and grows on that way at
           most as a disturbance grows over all n. 2 n of them add up as a random walk. An upper bound therefore. */
        const double rounding = 0x1p-46 / sqrt(12.0) * sqrt((double)N3) * sqrt(2.0 * n);
        const double distance = distance_of(x, x_end, N3);
        printf("  %5d   %.3e                         %.3e                %.3g\n", n, distance, rounding * growth,
               growth);
        ck_assert_double_le(distance, rounding * fmax(growth, 1.0));
        double largest_v = 0.0;
        for (int i = 0; i < N3; ++i) largest_v = fmax(largest_v, fabs(v_end[i] + v[i]));
        /* velocities turn into displacements within one oscillation, 1/omega of about 0.06 tau */
        ck_assert_double_le(largest_v, 20.0 * rounding * fmax(growth, 1.0));
        free(x_end), free(v_end);
    }
    free(x), free(v);
    close_experiment(&e);
}
END_TEST

HS_TEST_MAIN("energy", test_error_is_second_order, test_no_drift, test_reversal)
