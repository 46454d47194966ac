/* The public C API, used as an outside program uses it. */
#define _GNU_SOURCE /* fopencookie, memmem */
#include <halfshell/halfshell.h>
#include <locale.h>
#include <math.h>
#include <omp.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "support/harness.h"

static const char melt[] = "units lj\n"
                           "lattice fcc 0.8442\n"
                           "region box block 0 4 0 4 0 4\n"
                           "create_box 1 box\n"
                           "create_atoms 1 box\n"
                           "mass 1 1.0\n"
                           "velocity all create 1.44 87287 loop geom\n"
                           "pair_style lj/cut 2.5\n"
                           "pair_coeff 1 1 1.0 1.0 2.5\n"
                           "neighbor 0.3 bin\n"
                           "neigh_modify delay 0 every 1 check yes\n"
                           "fix 1 all nve\n";

enum { N_ATOMS = 256 };

static void need(hs_simulation *simulation, hs_code code)
{
    ck_assert_msg(code == HS_CODE_OK, "code %d: %s", (int)code, hs_simulation_error(simulation));
    ck_assert_str_eq(hs_simulation_error(simulation), "");
}

static void expect(hs_simulation *simulation, hs_code code, hs_code wanted, const char *part)
{
    ck_assert_int_eq(code, wanted);
    ck_assert_msg(strstr(hs_simulation_error(simulation), part) != NULL, "'%s' is not in: %s", part,
                  hs_simulation_error(simulation));
}

/** A new simulation: made before the check, as arguments are evaluated in any order. */
static hs_simulation *create(const hs_simulation_options *options)
{
    hs_simulation *simulation;
    const hs_code code = hs_simulation_create(&simulation, options);
    need(simulation, code);
    return simulation;
}

static hs_simulation *create_melt(void)
{
    hs_simulation *simulation = create(NULL);
    need(simulation, hs_simulation_deck_text(simulation, melt));
    return simulation;
}

START_TEST(test_empty)
{
    hs_simulation *simulation = create(NULL);
    ck_assert_int_eq(hs_simulation_n_atoms(simulation), 0);
    ck_assert_int_eq(hs_simulation_n_types(simulation), 0);
    ck_assert_int_eq(hs_simulation_step(simulation), 0);
    double value;
    expect(simulation, hs_simulation_get_positions(simulation, HS_ORDER_ID, 0, &value), HS_CODE_INPUT, "box");
    expect(simulation, hs_simulation_box(simulation, NULL, NULL, NULL), HS_CODE_INPUT, "box");
    expect(simulation, hs_simulation_thermo(simulation, "temp", &value), HS_CODE_INPUT, "box");
    expect(simulation, hs_simulation_run(simulation, 1), HS_CODE_INPUT, "box");
    hs_simulation_destroy(&simulation);
    ck_assert_ptr_null(simulation);
    hs_simulation_destroy(&simulation);
    hs_simulation_destroy(NULL);
}
END_TEST

START_TEST(test_options)
{
    ck_assert_int_gt((int)strlen(hs_version()), 4);
    hs_simulation *simulation;
    hs_simulation_options options = HS_SIMULATION_OPTIONS_INIT;
    options.neighbor_method = "no-such-method";
    ck_assert_int_eq(hs_simulation_create(&simulation, &options), HS_CODE_INPUT);
    expect(simulation, HS_CODE_INPUT, HS_CODE_INPUT, "no-such-method");
    expect(simulation, hs_simulation_run(simulation, 1), HS_CODE_INPUT, "could not be created");
    ck_assert_int_eq(hs_simulation_n_atoms(simulation), 0);
    hs_simulation_destroy(&simulation);

    options = (hs_simulation_options)HS_SIMULATION_OPTIONS_INIT;
    options.n_threads = 200000;
    ck_assert_int_eq(hs_simulation_create(&simulation, &options), HS_CODE_INPUT);
    expect(simulation, HS_CODE_INPUT, HS_CODE_INPUT, "n_threads is 200000; it must be from 0 to 4096");
    hs_simulation_destroy(&simulation);

    options = (hs_simulation_options)HS_SIMULATION_OPTIONS_INIT;
    options.size += 8; /* a program built against a later version with a setting unknown here */
    ck_assert_int_eq(hs_simulation_create(&simulation, &options), HS_CODE_INPUT);
    expect(simulation, HS_CODE_INPUT, HS_CODE_INPUT, "size");
    hs_simulation_destroy(&simulation);

    options.size = offsetof(hs_simulation_options, screen); /* and one built against an earlier version */
    options.neighbor_method = "nsq";
    options.n_threads = 2;
    simulation = create(&options);
    hs_simulation_destroy(&simulation);
}
END_TEST

/** Energy and pressure of LAMMPS's melt at step 0, and the same energy after steps. */
START_TEST(test_thermo)
{
    hs_simulation *simulation = create_melt();
    double temperature, energy, pressure, total, total_later, x_edge;
    ck_assert_int_eq(hs_simulation_n_atoms(simulation), N_ATOMS);
    ck_assert_int_eq(hs_simulation_n_types(simulation), 1);
    need(simulation, hs_simulation_thermo(simulation, "temp", &temperature));
    need(simulation, hs_simulation_thermo(simulation, "epair", &energy));
    need(simulation, hs_simulation_thermo(simulation, "press", &pressure));
    need(simulation, hs_simulation_thermo(simulation, "etotal", &total));
    need(simulation, hs_simulation_thermo(simulation, "lx", &x_edge));
    ck_assert_double_eq_tol(temperature, 1.44, 1e-12);
    ck_assert_double_eq_tol(energy, -6.7733681, 5e-8); /* the perfect crystal, whatever its size */
    ck_assert_double_eq_tol(x_edge, 4.0 * cbrt(4.0 / 0.8442), 1e-12);
    ck_assert_double_eq_tol(total, energy + 1.5 * temperature * (N_ATOMS - 1) / N_ATOMS, 1e-12);
    need(simulation, hs_simulation_run(simulation, 50));
    ck_assert_int_eq(hs_simulation_step(simulation), 50);
    need(simulation, hs_simulation_thermo(simulation, "etotal", &total_later));
    ck_assert_double_eq_tol(total_later, total, 0.02); /* dt = 0.005 and a cutoff without shift */
    expect(simulation, hs_simulation_thermo(simulation, "tmep", &energy), HS_CODE_INPUT, "'temp'");
    double lo[3], hi[3];
    int periodic[3];
    need(simulation, hs_simulation_box(simulation, lo, hi, periodic));
    ck_assert_double_eq_tol(hi[2] - lo[2], x_edge, 1e-12);
    ck_assert_int_eq(periodic[0] + periodic[1] + periodic[2], 3);
    hs_simulation_destroy(&simulation);
}
END_TEST

START_TEST(test_arrays)
{
    static double x[3 * N_ATOMS], x_local[3 * N_ATOMS], f[3 * N_ATOMS], v[3 * N_ATOMS];
    static int64_t id[N_ATOMS], id_local[N_ATOMS];
    static int32_t type[N_ATOMS];
    hs_simulation *simulation = create_melt();
    need(simulation, hs_simulation_run(simulation, 20));
    need(simulation, hs_simulation_get_forces(simulation, HS_ORDER_ID, N_ATOMS, f));
    need(simulation, hs_simulation_get_positions(simulation, HS_ORDER_ID, N_ATOMS, x));
    need(simulation, hs_simulation_get_positions(simulation, HS_ORDER_LOCAL, N_ATOMS, x_local));
    need(simulation, hs_simulation_get_velocities(simulation, HS_ORDER_ID, N_ATOMS, v));
    need(simulation, hs_simulation_get_ids(simulation, HS_ORDER_ID, N_ATOMS, id));
    need(simulation, hs_simulation_get_ids(simulation, HS_ORDER_LOCAL, N_ATOMS, id_local));
    need(simulation, hs_simulation_get_types(simulation, HS_ORDER_ID, N_ATOMS, type));
    double lo[3], hi[3], sum_f = 0.0, sum_v = 0.0, largest_f = 0.0;
    need(simulation, hs_simulation_box(simulation, lo, hi, NULL));
    int n_moved = 0;
    for (int i = 0; i < N_ATOMS; ++i) {
        ck_assert_int_eq(id[i], i + 1);
        ck_assert_int_eq(type[i], 1);
        n_moved += id_local[i] != i + 1;
        for (int axis = 0; axis < 3; ++axis) {
            ck_assert_double_eq(x_local[3 * i + axis], x[3 * (id_local[i] - 1) + axis]);
            ck_assert_double_ge(x[3 * i + axis], lo[axis]);
            ck_assert_double_lt(x[3 * i + axis], hi[axis]);
        }
        sum_f += f[3 * i], sum_v += v[3 * i];
        largest_f = fmax(largest_f, fabs(f[3 * i]));
    }
    ck_assert_int_gt(n_moved, 0); /* else the two orders were not told apart */
    ck_assert_double_gt(largest_f, 1.0);
    ck_assert_double_eq_tol(sum_f, 0.0, 1e-10);
    ck_assert_double_eq_tol(sum_v, 0.0, 1e-10);
    expect(simulation, hs_simulation_get_positions(simulation, HS_ORDER_ID, N_ATOMS - 1, x), HS_CODE_INPUT, "256");
    expect(simulation, hs_simulation_get_positions(simulation, (hs_order)7, N_ATOMS, x), HS_CODE_INPUT, "order");
    hs_simulation_destroy(&simulation);
}
END_TEST

/** Reversed velocities bring the system back to where it started. */
START_TEST(test_reversal)
{
    static double start[3 * N_ATOMS], end[3 * N_ATOMS], v[3 * N_ATOMS];
    hs_simulation *simulation = create_melt();
    need(simulation, hs_simulation_get_unwrapped(simulation, HS_ORDER_ID, N_ATOMS, start));
    need(simulation, hs_simulation_run(simulation, 40));
    need(simulation, hs_simulation_get_velocities(simulation, HS_ORDER_ID, N_ATOMS, v));
    for (int i = 0; i < 3 * N_ATOMS; ++i) v[i] = -v[i];
    need(simulation, hs_simulation_set_velocities(simulation, HS_ORDER_ID, N_ATOMS, v));
    need(simulation, hs_simulation_run(simulation, 40));
    need(simulation, hs_simulation_get_unwrapped(simulation, HS_ORDER_ID, N_ATOMS, end));
    for (int i = 0; i < 3 * N_ATOMS; ++i)
        ck_assert_double_eq_tol(end[i], start[i], 1e-9); /* rounding, grown e-fold some five times in 80 steps */
    hs_simulation_destroy(&simulation);
}
END_TEST

/** The melt in a box that is sheared: a translation by whole edges changes nothing, and comes back unwrapped. */
START_TEST(test_tilted_box)
{
    static double x[3 * N_ATOMS], back[3 * N_ATOMS];
    hs_simulation *simulation = create_melt();
    double before, after, lo[3], hi[3], tilt[3];
    need(simulation, hs_simulation_tilt(simulation, tilt));
    ck_assert(tilt[0] == 0.0 && tilt[1] == 0.0 && tilt[2] == 0.0);
    need(simulation,
         hs_simulation_command(simulation, "change_box all triclinic xy final 2.0 yz final -1.0 remap units box"));
    need(simulation, hs_simulation_thermo(simulation, "pe", &before));
    need(simulation, hs_simulation_box(simulation, lo, hi, NULL));
    need(simulation, hs_simulation_tilt(simulation, tilt));
    /* a reproducible run rounds them to some 1e-14 */
    ck_assert_double_eq_tol(tilt[0], 2.0, 1e-12);
    ck_assert_double_eq_tol(tilt[1], 0.0, 1e-12);
    ck_assert_double_eq_tol(tilt[2], -1.0, 1e-12);
    need(simulation, hs_simulation_get_positions(simulation, HS_ORDER_ID, N_ATOMS, x));
    const double edge[3][3] = {
        {hi[0] - lo[0], 0.0, 0.0}, {tilt[0], hi[1] - lo[1], 0.0}, {tilt[1], tilt[2], hi[2] - lo[2]}};
    for (int i = 0; i < N_ATOMS; ++i)
        for (int axis = 0; axis < 3; ++axis) x[3 * i + axis] += 3.0 * edge[1][axis] - 2.0 * edge[2][axis];
    need(simulation, hs_simulation_set_positions(simulation, HS_ORDER_ID, N_ATOMS, x));
    need(simulation, hs_simulation_thermo(simulation, "pe", &after));
    ck_assert_double_eq_tol(after, before, 1e-9);
    need(simulation, hs_simulation_get_unwrapped(simulation, HS_ORDER_ID, N_ATOMS, back));
    for (int i = 0; i < 3 * N_ATOMS; ++i) ck_assert_double_eq_tol(back[i], x[i], 1e-12 * 60.0);
    hs_simulation_destroy(&simulation);
}
END_TEST

START_TEST(test_set_positions)
{
    static double x[3 * N_ATOMS], back[3 * N_ATOMS];
    hs_simulation *simulation = create_melt();
    double before, after, lo[3], hi[3];
    need(simulation, hs_simulation_thermo(simulation, "pe", &before));
    need(simulation, hs_simulation_box(simulation, lo, hi, NULL));
    need(simulation, hs_simulation_get_positions(simulation, HS_ORDER_ID, N_ATOMS, x));
    for (int i = 0; i < N_ATOMS; ++i) x[3 * i] += 7.25 * (hi[0] - lo[0]); /* a translation changes no energy */
    need(simulation, hs_simulation_set_positions(simulation, HS_ORDER_ID, N_ATOMS, x));
    need(simulation, hs_simulation_thermo(simulation, "pe", &after));
    ck_assert_double_eq_tol(after, before, 1e-9);
    need(simulation, hs_simulation_get_unwrapped(simulation, HS_ORDER_ID, N_ATOMS, back));
    for (int i = 0; i < 3 * N_ATOMS; ++i) ck_assert_double_eq_tol(back[i], x[i], 1e-12 * 60.0);
    x[4] = NAN;
    expect(simulation, hs_simulation_set_positions(simulation, HS_ORDER_ID, N_ATOMS, x), HS_CODE_INPUT, "row 1");
    x[4] = 1e300;
    expect(simulation, hs_simulation_set_positions(simulation, HS_ORDER_ID, N_ATOMS, x), HS_CODE_INPUT, "outside");
    need(simulation, hs_simulation_thermo(simulation, "pe", &after));
    ck_assert_double_eq_tol(after, before, 1e-9);
    hs_simulation_destroy(&simulation);
}
END_TEST

/** Two at a time, interleaved, give the bits that each gives alone. */
START_TEST(test_two_at_a_time)
{
    static double alone[2][3 * N_ATOMS], together[3 * N_ATOMS];
    const char *const seed[2] = {"velocity all create 1.0 1", "velocity all create 2.0 2"};
    for (int k = 0; k < 2; ++k) {
        hs_simulation *simulation = create_melt();
        need(simulation, hs_simulation_command(simulation, seed[k]));
        for (int step = 0; step < 4; ++step) need(simulation, hs_simulation_run(simulation, 5));
        need(simulation, hs_simulation_get_positions(simulation, HS_ORDER_ID, N_ATOMS, alone[k]));
        hs_simulation_destroy(&simulation);
    }
    hs_simulation *pair[2] = {create_melt(), create_melt()};
    for (int k = 0; k < 2; ++k) need(pair[k], hs_simulation_command(pair[k], seed[k]));
    for (int step = 0; step < 4; ++step)
        for (int k = 0; k < 2; ++k) need(pair[k], hs_simulation_run(pair[k], 5));
    for (int k = 0; k < 2; ++k) {
        need(pair[k], hs_simulation_get_positions(pair[k], HS_ORDER_ID, N_ATOMS, together));
        ck_assert_mem_eq(together, alone[k], sizeof together);
        hs_simulation_destroy(&pair[k]);
    }
    ck_assert_mem_ne(alone[0], alone[1], sizeof together);
}
END_TEST

START_TEST(test_variables_and_errors)
{
    hs_simulation *simulation = create(NULL);
    const char *const values[] = {"3.5"};
    double value;
    need(simulation, hs_simulation_set_variable(simulation, "a", 1, values));
    need(simulation, hs_simulation_deck_text(simulation, "variable a index 1\nvariable b equal 2*${a}\n"));
    need(simulation, hs_simulation_get_variable(simulation, "b", &value));
    ck_assert_double_eq(value, 7.0);
    expect(simulation, hs_simulation_get_variable(simulation, "no_such", &value), HS_CODE_INPUT, "no_such");
    expect(simulation, hs_simulation_deck_text(simulation, "units lj\n\natom_stile atomic\n"), HS_CODE_INPUT,
           ":3: error: ");
    expect(simulation, HS_CODE_INPUT, HS_CODE_INPUT, "atom_style");
    expect(simulation, hs_simulation_command(simulation, "unitts lj"), HS_CODE_INPUT, "units");
    expect(simulation, hs_simulation_deck_file(simulation, "/no/such/deck.in"), HS_CODE_INPUT, "/no/such/deck.in");
    need(simulation, hs_simulation_deck_text(simulation, melt)); /* errors leave the simulation usable */
    expect(simulation, hs_simulation_run(simulation, -1), HS_CODE_INPUT, "run");
    need(simulation, hs_simulation_run(simulation, 1));
    hs_simulation_destroy(&simulation);
}
END_TEST

/* What hs_simulation_create gives when there is no memory at all. */
START_TEST(test_no_simulation)
{
    double value;
    ck_assert_int_eq(hs_simulation_deck_text(NULL, melt), HS_CODE_FAILED);
    ck_assert_int_eq(hs_simulation_deck_file(NULL, "in.melt"), HS_CODE_FAILED);
    ck_assert_int_eq(hs_simulation_command(NULL, "units lj"), HS_CODE_FAILED);
    ck_assert_int_eq(hs_simulation_run(NULL, 1), HS_CODE_FAILED);
    ck_assert_int_eq(hs_simulation_thermo(NULL, "temp", &value), HS_CODE_FAILED);
    ck_assert_int_eq(hs_simulation_get_variable(NULL, "a", &value), HS_CODE_FAILED);
    ck_assert_int_eq(hs_simulation_get_positions(NULL, HS_ORDER_ID, 0, NULL), HS_CODE_FAILED);
    ck_assert_int_eq(hs_simulation_set_positions(NULL, HS_ORDER_ID, 0, NULL), HS_CODE_FAILED);
    ck_assert_int_eq(hs_simulation_box(NULL, NULL, NULL, NULL), HS_CODE_FAILED);
    ck_assert_int_eq(hs_simulation_n_atoms(NULL), 0);
    ck_assert_str_eq(hs_simulation_error(NULL), "out of memory");
    hs_simulation_stop(NULL);
    hs_simulation_destroy(NULL);
}
END_TEST

/** A stop asked for from outside: here by the log stream, which is written to during the run. */
static hs_simulation *to_stop;

static ssize_t stop_on_write(void *cookie, const char *text, size_t n)
{
    (void)cookie;
    if (memmem(text, n, "Step", 4) != NULL && to_stop != NULL) hs_simulation_stop(to_stop);
    return (ssize_t)n;
}

START_TEST(test_stop)
{
    FILE *log = fopencookie(NULL, "w", (cookie_io_functions_t){.write = stop_on_write});
    ck_assert_ptr_nonnull(log);
    setvbuf(log, NULL, _IOLBF, 4096);
    hs_simulation_options options = HS_SIMULATION_OPTIONS_INIT;
    options.log = log;
    to_stop = create(&options);
    need(to_stop, hs_simulation_deck_text(to_stop, melt));
    ck_assert_int_eq(hs_simulation_run(to_stop, 100000), HS_CODE_INTERRUPTED);
    ck_assert_int_ge(hs_simulation_step(to_stop), 1);
    ck_assert_int_lt(hs_simulation_step(to_stop), 1000);
    hs_simulation *stopped = to_stop;
    to_stop = NULL;
    const int64_t step = hs_simulation_step(stopped);
    need(stopped, hs_simulation_run(stopped, 3));
    ck_assert_int_eq(hs_simulation_step(stopped), step + 3);
    hs_simulation_destroy(&stopped);
    fclose(log);
}
END_TEST

/** Simulations that measure by Fourier transforms, made and destroyed again and again; NULL, or what went wrong. */
static void *transform_often(void *number)
{
    static const char failed[] = "a simulation failed";
    const int first = *(const int *)number;
    char deck[1024];
    const char *result = NULL;
    for (int round = 0; round < 20 && result == NULL; ++round) {
        hs_simulation *simulation;
        const int n = 10 + 2 * (first + 4 * round);
        snprintf(deck, sizeof deck,
                 "%sfix s all ave/spectrum 1 %d %d c_thermo_temp\ncompute s all sq %d.0\nvariable s equal c_s[1][2]\n"
                 "thermo_style custom step v_s\nrun 1\n",
                 melt, n, n, 3 + round % 8);
        if (hs_simulation_create(&simulation, NULL) != HS_CODE_OK ||
            hs_simulation_deck_text(simulation, deck) != HS_CODE_OK)
            result = failed;
        hs_simulation_destroy(&simulation);
    }
    return (void *)result;
}

START_TEST(test_threads_of_the_caller)
{
    int number[4];
    pthread_t thread[4];
    for (int k = 0; k < 4; ++k) {
        number[k] = k;
        ck_assert_int_eq(pthread_create(&thread[k], NULL, transform_often, &number[k]), 0);
    }
    for (int k = 0; k < 4; ++k) {
        void *result;
        pthread_join(thread[k], &result);
        ck_assert_ptr_null(result);
    }
}
END_TEST

/** What the caller has set for OpenMP regions of its own is as it was after any call; within such a region, which leaves no threads for
 *  others, the results are the same. */
START_TEST(test_openmp_of_the_caller)
{
    static double alone[3 * N_ATOMS], within[3 * N_ATOMS];
    const char *const methods[] = {"cluster", "cell", "nsq", "linked"};
    for (size_t k = 0; k < sizeof methods / sizeof methods[0]; ++k) {
        hs_simulation_options options = HS_SIMULATION_OPTIONS_INIT;
        options.n_threads = 2;
        options.neighbor_method = methods[k];
        omp_set_num_threads(3);
        omp_set_dynamic(1);
        hs_simulation *simulation = create(&options), *other = create(&options);
        need(simulation, hs_simulation_deck_text(simulation, melt));
        need(simulation, hs_simulation_run(simulation, 20));
        need(simulation, hs_simulation_get_positions(simulation, HS_ORDER_ID, N_ATOMS, alone));
        ck_assert_int_eq(omp_get_max_threads(), 3);
        ck_assert_int_ne(omp_get_dynamic(), 0);
        hs_simulation_destroy(&simulation);
        ck_assert_int_eq(omp_get_max_threads(), 3);
        hs_code code = HS_CODE_FAILED;
        need(other, hs_simulation_deck_text(other, melt));
        int n_callers = 0;
        omp_set_dynamic(0); /* which makes the team small on a busy machine: it must have another thread */
#pragma omp parallel num_threads(2)
#pragma omp single
        {
            n_callers = omp_get_num_threads();
            code = hs_simulation_run(other, 20);
        }
        ck_assert_int_eq(n_callers, 2);
        need(other, code);
        need(other, hs_simulation_get_positions(other, HS_ORDER_ID, N_ATOMS, within));
        ck_assert_mem_eq(within, alone, sizeof alone);
        hs_simulation_destroy(&other);
    }
    omp_set_dynamic(0);
    omp_set_num_threads(1);
}
END_TEST

/** Numbers have a point where the caller's have a comma. */
START_TEST(test_locale_of_the_caller)
{
    char folder[] = "/tmp/halfshell-locale-XXXXXX", command[256];
    const char *found = NULL;
    ck_assert_ptr_nonnull(mkdtemp(folder));
    snprintf(command, sizeof command, "localedef -i de_DE -f UTF-8 %s/de_DE.UTF-8 >/dev/null 2>&1", folder);
    if (system(command) == 0) setenv("LOCPATH", folder, 1);
    found = setlocale(LC_ALL, "de_DE.UTF-8");
    snprintf(command, sizeof command, "rm -r %s", folder);
    ck_assert_int_eq(system(command), 0);
    if (found == NULL) return; /* this machine has no such locale */
    double value;
    char text[32];
    hs_simulation *simulation = create_melt();
    need(simulation, hs_simulation_command(simulation, "variable half equal 0.5"));
    need(simulation, hs_simulation_get_variable(simulation, "half", &value));
    ck_assert_double_eq(value, 0.5);
    need(simulation, hs_simulation_run(simulation, 1));
    hs_simulation_destroy(&simulation);
    snprintf(text, sizeof text, "%g", 0.5);
    ck_assert_str_eq(text, "0,5"); /* the caller's own numbers are as they were */
    setlocale(LC_ALL, "C");
}
END_TEST

HS_TEST_MAIN("api", test_empty, test_options, test_thermo, test_arrays, test_reversal, test_tilted_box,
             test_set_positions, test_two_at_a_time, test_variables_and_errors, test_no_simulation, test_stop,
             test_threads_of_the_caller, test_openmp_of_the_caller, test_locale_of_the_caller)
