/* Atoms without forces, the velocities that are drawn for them, equipartition, and what happens at the faces of the
 * box and when forces are nonsense. */
#include <sys/wait.h>
#include <unistd.h>

#include "physics.h"

enum { N_GAS = 200 };

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double normal_cdf(double x) { return 0.5 * erfc(-x * M_SQRT1_2); }
/** Of a speed in units of sqrt(kT/m), in three dimensions. */
static double maxwell_cdf(double s) { return erf(s * M_SQRT1_2) - sqrt(2.0 / M_PI) * s * exp(-0.5 * s * s); }
/** Of a component that is even in [-sqrt(3), sqrt(3)], which has variance 1. */
static double even_cdf(double x) { return fmin(1.0, fmax(0.0, 0.5 + x / sqrt(12.0))); }

/** Kolmogorov and Smirnov's sqrt(n) D; above 1.95 with a chance of 0.001 if the samples follow the distribution. Sorts.
 *  Source: W. H. Press et al., Numerical Recipes in C (1992), eq. (14.3.9). */
static double kolmogorov_smirnov(double *sample, int n, double (*cdf)(double))
{
    double largest = 0.0;
    qsort(sample, (size_t)n, sizeof *sample, compare);
    for (int i = 0; i < n; ++i) {
        const double p = cdf(sample[i]);
        largest = fmax(largest, fmax(p - (double)i / n, (i + 1.0) / n - p));
    }
    return largest * (sqrt((double)n) + 0.12 + 0.11 / sqrt((double)n));
}

static const double ks_limit = 1.95;

/** Straight lines, with the box lengths that were crossed counted. */
START_TEST(test_ideal_gas)
{
    enum { N_STEPS = 2000 };
    static double x[3 * N_GAS], wrapped[3 * N_GAS];
    static const char *const methods[] = {"nsq", "cell", "cluster", "verlet"};
    const double dt = 0.01, length[3] = {7.0, 5.0, 3.0};
    for (size_t k = 0; k < sizeof methods / sizeof methods[0]; ++k) {
        double *x_start, *v_start, *x_end, *v_end;
        experiment e;
        open_experiment(&e, 2);
        deck(&e,
             "units lj\nregion box block 0 7 -1 4 2 5 units box\ncreate_box 1 box\ncreate_atoms 1 random %d 5512 NULL\n"
             "mass 1 2.0\nvelocity all create 3.0 87287 dist gaussian\npair_style none\nfix 1 all nve\ntimestep %g\n"
             "neighbor_method %s\n",
             N_GAS, dt, methods[k]);
        get_state(&e, &x_start, &v_start);
        need(&e, hs_simulation_run(e.simulation, N_STEPS));
        get_state(&e, &x_end, &v_end);
        need(&e, hs_simulation_get_positions(e.simulation, HS_ORDER_ID, N_GAS, wrapped));
        double farthest = 0.0, lo[3], hi[3];
        need(&e, hs_simulation_box(e.simulation, lo, hi, NULL));
        for (int i = 0; i < 3 * N_GAS; ++i) {
            const int axis = i % 3;
            x[i] = x_start[i] + N_STEPS * dt * v_start[i];
            farthest = fmax(farthest, fabs(x[i] - x_start[i]) / length[axis]);
            ck_assert_double_eq(v_end[i], v_start[i]);
            /* each of 2000 steps rounds the displacement to the position grid, 2^-47 for coordinates and lengths that add up to 14,
               by half of it at most; the unwrapped coordinate is rounded once */
            ck_assert_double_eq_tol(x_end[i], x[i], 0.5 * N_STEPS * 0x1p-47 + fabs(x[i]) * 0x1p-52);
            ck_assert(wrapped[i] >= lo[axis] && wrapped[i] < hi[axis]);
            const double images = (x_end[i] - wrapped[i]) / length[axis];
            ck_assert_double_eq_tol(images, round(images), 1e-13 * (1.0 + fabs(images)));
        }
        ck_assert_double_gt(farthest, 10.0); /* box lengths: else nothing was tested */
        const double volume = 7.0 * 5.0 * 3.0, n_dof = 3.0 * N_GAS - 3.0;
        ck_assert_double_eq_tol(thermo(&e, "temp"), 3.0, 1e-12);
        ck_assert_double_eq_tol(thermo(&e, "press"), n_dof * 3.0 / (3.0 * volume), 1e-12);
        ck_assert_double_eq(thermo(&e, "pe"), 0.0);
        free(x_start), free(v_start), free(x_end), free(v_end);
        close_experiment(&e);
    }
}
END_TEST

/** A hot gas between walls that throw atoms back at random comes to their temperature and velocity, whatever the
 *  accommodation; its density stays even. */
START_TEST(test_stochastic_walls)
{
    enum { N = 3000 };
    static const char *const walls[] = {"diffusive 4711 zlo EDGE 0.5 0.4 0 0 zhi EDGE 0.5 0.4 0 0",
                                        "maxwell 4711 zlo EDGE 0.5 0.4 0 0 0.5 zhi EDGE 0.5 0.4 0 0 0.7",
                                        "ccl 4711 zlo EDGE 0.5 0.4 0 0 0.5 0.4 0.6 zhi EDGE 0.5 0.4 0 0 0.7 1 0.3"};
    const double temperature = 0.5, drift = 0.4, mass = 2.0;
    for (size_t k = 0; k < sizeof walls / sizeof walls[0]; ++k) {
        static double component[3][N], height[N];
        double *x, *v, ks[4];
        experiment e;
        open_experiment(&e, 2);
        deck(&e,
             "units lj\nboundary p p f\nregion box block 0 7 0 5 0 1 units box\ncreate_box 1 box\n"
             "create_atoms 1 random %d 5512 NULL\nmass 1 %g\nvelocity all create 2.0 87287 dist gaussian\n"
             "pair_style none\nfix 1 all nve\nfix w all wall/reflect/stochastic %s\ntimestep 0.01\nrun 6000\n",
             N, mass, walls[k]);
        get_state(&e, &x, &v);
        for (int i = 0; i < N; ++i) {
            for (int axis = 0; axis < 3; ++axis)
                component[axis][i] = (v[3 * i + axis] - (axis == 0 ? drift : 0.0)) * sqrt(mass / temperature);
            height[i] = (x[3 * i + 2] - 0.5) * sqrt(12.0);
            ck_assert(x[3 * i + 2] >= 0.0 && x[3 * i + 2] <= 1.0);
        }
        for (int axis = 0; axis < 3; ++axis) ks[axis] = kolmogorov_smirnov(component[axis], N, normal_cdf);
        ks[3] = kolmogorov_smirnov(height, N, even_cdf);
        printf("  walls %.9s sqrt(n) D: velocities %.2f %.2f %.2f, heights %.2f (limit %.2f)\n", walls[k], ks[0], ks[1],
               ks[2], ks[3], ks_limit);
        for (int test = 0; test < 4; ++test) ck_assert_double_lt(ks[test], ks_limit);
        free(x), free(v);
        close_experiment(&e);
    }
}
END_TEST

/** What `velocity create` draws: shapes of the distributions, the same temperature for light and heavy, no momentum. */
START_TEST(test_velocity_distributions)
{
    enum { N = 8000 };
    static double v[3 * N], component[3 * N], speed[N];
    static int32_t type[N];
    static const char *const loops[] = {"all", "geom", "local"};
    const double temperature = 1.7, mass[3] = {0.0, 1.0, 6.0};
    for (int k = 0; k < 6; ++k) {
        const bool is_gaussian = k < 3;
        experiment e;
        open_experiment(&e, 1);
        deck(&e,
             "units lj\nlattice sc 0.5\nregion box block 0 20 0 20 0 20\ncreate_box 2 box\ncreate_atoms 1 box\n"
             "set type 1 type/ratio 2 0.5 1234\nmass 1 1.0\nmass 2 6.0\nvelocity all create %g 4928459 dist %s loop "
             "%s\n",
             temperature, is_gaussian ? "gaussian" : "uniform", loops[k % 3]);
        need(&e, hs_simulation_get_velocities(e.simulation, HS_ORDER_ID, N, v));
        need(&e, hs_simulation_get_types(e.simulation, HS_ORDER_ID, N, type));
        double momentum[3] = {0.0, 0.0, 0.0}, mv2[3] = {0.0, 0.0, 0.0}, neighbors = 0.0;
        int n_of[3] = {0, 0, 0};
        for (int i = 0; i < 3 * N; ++i) {
            const int t = type[i / 3];
            component[i] = v[i] * sqrt(mass[t] / temperature);
            momentum[i % 3] += mass[t] * v[i];
            mv2[t] += mass[t] * v[i] * v[i];
            n_of[t] += i % 3 == 0;
            if (i > 0) neighbors += component[i - 1] * component[i];
        }
        for (int i = 0; i < N; ++i)
            speed[i] =
                sqrt(pow(component[3 * i], 2.0) + pow(component[3 * i + 1], 2.0) + pow(component[3 * i + 2], 2.0));
        for (int axis = 0; axis < 3; ++axis)
            ck_assert_double_eq_tol(momentum[axis], 0.0, 1e-9); /* 8000 roundings of 10 */
        /* the variance of m v^2/kT is 2 (Gaussian), 0.8 (uniform); 4 standard errors of its mean */
        for (int t = 1; t <= 2; ++t)
            ck_assert_double_eq_tol(mv2[t] / (3.0 * n_of[t] * temperature), 1.0, 4.0 * sqrt(2.0 / (3.0 * n_of[t])));
        ck_assert_double_eq_tol(neighbors / (3.0 * N), 0.0,
                                4.0 / sqrt(3.0 * N)); /* one draw tells nothing of the next */
        const double ks_component = kolmogorov_smirnov(component, 3 * N, is_gaussian ? normal_cdf : even_cdf);
        const double ks_speed = is_gaussian ? kolmogorov_smirnov(speed, N, maxwell_cdf) : 0.0;
        printf("  dist %-8s loop %-5s sqrt(n) D: components %.2f, speeds %.2f (limit %.2f)\n",
               is_gaussian ? "gaussian" : "uniform", loops[k % 3], ks_component, ks_speed, ks_limit);
        ck_assert_double_lt(ks_component, ks_limit);
        ck_assert_double_lt(ks_speed, ks_limit);
        if (!is_gaussian)
            ck_assert_double_gt(kolmogorov_smirnov(component, 3 * N, normal_cdf), ks_limit); /* it can tell */
        close_experiment(&e);
    }
}
END_TEST

/** All kinetic energy is given to the light atoms; collisions share it out equally, and make the speeds Maxwell's. */
START_TEST(test_equipartition)
{
    enum { N = 864, N_BLOCKS = 16 };
    static double v[3 * N], component[3 * N], speed[N];
    static int32_t type[N];
    experiment e;
    open_experiment(&e, 1);
    deck(&e, "units lj\nlattice fcc 0.7\nregion box block 0 6 0 6 0 6\ncreate_box 2 box\ncreate_atoms 1 box\n"
             "set type 1 type/ratio 2 0.5 1234\nmass 1 1.0\nmass 2 4.0\ngroup light type 1\ngroup heavy type 2\n"
             "velocity light create 4.0 4928459 dist uniform\npair_style lj/cut 2.5\npair_modify shift yes\n"
             "pair_coeff * * 1.0 1.0\nneigh_modify every 1 delay 0 check yes\nfix 1 all nve\ntimestep 0.004\n"
             "compute light light ke\ncompute heavy heavy ke\nthermo_modify norm no\nrun 3000\n");
    need(&e, hs_simulation_get_types(e.simulation, HS_ORDER_ID, N, type));
    int n_light = 0;
    for (int i = 0; i < N; ++i) n_light += type[i] == 1;
    const double total_mass = n_light + 4.0 * (N - n_light);
    /* The momentum is zero: a particle of mass m has 3/2 kT (1 - m/M) of kinetic energy. */
    const double share_light = n_light * (1.0 - 1.0 / total_mass),
                 share_heavy = (N - n_light) * (1.0 - 4.0 / total_mass);
    double ratio[N_BLOCKS], mean = 0.0, square = 0.0;
    for (int b = 0; b < N_BLOCKS; ++b) {
        deck(&e, "thermo_style custom step c_light c_heavy\nthermo_modify norm no format float %%.17g\nthermo 10\nrun "
                 "250\n");
        table t = last_table(&e);
        double light = 0.0, heavy = 0.0;
        for (int i = 0; i < t.n_rows; ++i) light += cell(&t, i, 1) / share_light, heavy += cell(&t, i, 2) / share_heavy;
        ratio[b] = light / heavy;
        mean += ratio[b] / N_BLOCKS;
        free(t.value);
    }
    for (int b = 0; b < N_BLOCKS; ++b) square += (ratio[b] - mean) * (ratio[b] - mean);
    const double error = sqrt(square / (N_BLOCKS * (N_BLOCKS - 1.0)));
    printf("  temperature of light over heavy atoms after all energy was with the light: %.4f ± %.4f\n", mean, error);
    /* (omega dt)^2/4, by which the kinetic temperature at full steps falls short, is 0.001 for the light, a quarter
       of that for the heavy */
    ck_assert_double_eq_tol(mean, 1.0, 4.0 * error + 0.001);
    ck_assert_double_lt(error, 0.02);

    need(&e, hs_simulation_get_velocities(e.simulation, HS_ORDER_ID, N, v));
    const double temperature = thermo(&e, "temp");
    for (int i = 0; i < 3 * N; ++i) component[i] = v[i] * sqrt((type[i / 3] == 1 ? 1.0 : 4.0) / temperature);
    for (int i = 0; i < N; ++i)
        speed[i] = sqrt(pow(component[3 * i], 2.0) + pow(component[3 * i + 1], 2.0) + pow(component[3 * i + 2], 2.0));
    ck_assert_double_lt(kolmogorov_smirnov(component, 3 * N, normal_cdf), ks_limit);
    ck_assert_double_lt(kolmogorov_smirnov(speed, N, maxwell_cdf), ks_limit);
    close_experiment(&e);
}
END_TEST

/** A droplet flies apart; thermo of LAMMPS (29 Sep 2021) for the same decks, made with
 *  `thermo_style custom step temp pe etotal press vol lx ly lz`, `thermo_modify format float %.10g`. */
START_TEST(test_shrink_wrapped_box)
{
    static const struct {
        const char *boundary;
        double edge, row[4][9];
    } decks[] = {
        {"s s s",
         3.9,
         {{0, 1.5, -5.352599625, -3.111388687, -4.193462883, 190.6829839, 5.75577727, 5.75577727, 5.75577727},
          {40, 0.7865045453, -4.306428952, -3.131280559, 1.987868802, 248.3161091, 6.267837304, 6.297359214,
           6.29113077},
          {100, 0.6634110497, -4.102488293, -3.111258892, -0.2237991364, 383.7739768, 7.153620742, 7.489913635,
           7.162634673},
          {200, 0.4941401163, -3.827221589, -3.088906767, -0.4908165038, 495.8277244, 7.653203052, 8.0284286,
           8.069693158}}},
        {"m s p",
         4.0,
         {{0, 1.5, -5.925265036, -3.684054099, -3.88815969, 242.7450187, 6.412792608, 5.75577727, 6.576565532},
          {40, 0.7560275013, -4.84091356, -3.711302156, 2.065855119, 275.4947972, 6.642124551, 6.306773506,
           6.576565532},
          {100, 0.6701513956, -4.695642075, -3.69434165, 0.4065230545, 340.1507056, 6.957387019, 7.434059995,
           6.576565532},
          {200, 0.5161820384, -4.445379758, -3.674131204, -0.6342174886, 400.7434391, 7.337391128, 8.304731553,
           6.576565532}}},
    };
    for (size_t k = 0; k < sizeof decks / sizeof decks[0]; ++k) {
        experiment e;
        open_experiment(&e, 1);
        deck(&e,
             "units lj\nboundary %s\nlattice fcc 0.9\nregion box block 0 3.9 0 3.9 0 %g\ncreate_box 1 box\n"
             "create_atoms 1 box\nmass 1 1.0\nvelocity all create 1.5 87287 loop geom\npair_style lj/cut 2.5\n"
             "pair_coeff 1 1 1.0 1.0\nneigh_modify every 1 delay 0 check yes\nfix 1 all nve\n",
             decks[k].boundary, decks[k].edge);
        table t = run_table(&e, 200, 20, "temp pe etotal press vol lx ly lz");
        for (int r = 0; r < 4; ++r) {
            const int i = (int)decks[k].row[r][0] / 20;
            for (int c = 0; c < 9; ++c) /* half of the last printed digit, and rounding grown over 200 steps */
                ck_assert_double_eq_tol(cell(&t, i, c), decks[k].row[r][c], 1e-9 * (1.0 + fabs(decks[k].row[r][c])));
        }
        static double x[3 * 512];
        double lo[3], hi[3];
        const int64_t n = hs_simulation_n_atoms(e.simulation);
        need(&e, hs_simulation_box(e.simulation, lo, hi, NULL));
        need(&e, hs_simulation_get_positions(e.simulation, HS_ORDER_ID, n, x));
        for (int64_t i = 0; i < 3 * n; ++i) /* faces move when lists are made, that is after half the skin at most */
            ck_assert(x[i] >= lo[i % 3] - 0.15 && x[i] <= hi[i % 3] + 0.15);
        free(t.value);
        close_experiment(&e);
    }
}
END_TEST

/** What the program says about a deck, and its exit code. */
typedef struct outcome {
    int exit_code;
    char text[16384];
} outcome;

static outcome run_program(const char *text)
{
    outcome o = {-1, ""};
    char path[] = "/tmp/halfshell-boundary-XXXXXX", command[1024];
    const int file = mkstemp(path);
    ck_assert_int_ge(file, 0);
    ck_assert_int_eq(write(file, text, strlen(text)), (ssize_t)strlen(text));
    close(file);
    snprintf(command, sizeof command, "%s -in %s -log none -threads 2 2>&1", HALFSHELL_PROGRAM, path);
    FILE *pipe = popen(command, "r");
    ck_assert_ptr_nonnull(pipe);
    o.text[fread(o.text, 1, sizeof o.text - 1, pipe)] = '\0';
    const int status = pclose(pipe);
    unlink(path);
    if (WIFEXITED(status)) o.exit_code = WEXITSTATUS(status);
    return o;
}

static void expect(const char *text, int exit_code, const char *const *parts)
{
    const outcome o = run_program(text);
    ck_assert_msg(o.exit_code == exit_code, "exit code %d, not %d: %s", o.exit_code, exit_code, o.text);
    for (; *parts != NULL; ++parts) ck_assert_msg(strstr(o.text, *parts) != NULL, "'%s' is not in: %s", *parts, o.text);
}

/** A column of words is easier to read as a list. */
#define PARTS(...) ((const char *const[]){__VA_ARGS__, NULL})

#define CLOSED_BOX                                                                                                     \
    "units lj\nboundary f f f\nregion box block 0 10 0 10 0 10 units box\ncreate_box 1 box\n"                          \
    "create_atoms 1 single 5 5 5 units box\ncreate_atoms 1 single 5.01 2 3 units box\n"                                \
    "create_atoms 1 single 8 8 8 units box\nmass 1 1.0\nset atom 2 vx 10\npair_style lj/cut 2.5\n"                     \
    "pair_coeff * * 1 1\nneighbor 0.55 bin\nneigh_modify every 1 delay 0 check yes\nfix 1 all nve\n"                   \
    "timestep 0.005\nthermo 50\n"
#define CELL "neighbor_method cell\n"

/** Atom 2 flies free and is at 5.01 + 0.05 n after n steps: beyond 10 at step 100. All methods look when lists are due,
 *  here at every sixth step: 0.3 is more than half the skin. */
START_TEST(test_lost_atom)
{
    expect(CLOSED_BOX "run 99\n", 0, PARTS("Loop time"));
    expect(CLOSED_BOX CELL "run 99\n", 0, PARTS("Loop time"));
    expect(CLOSED_BOX CELL "run 200\n", 2,
           PARTS(":18: error: at step 102 atom 2 at (10.11 2 3), velocity (10 0 0)", "thermo_modify lost ignore"));
    expect(CLOSED_BOX "run 200\n", 2, PARTS(":17: error: at step 102 atom 2 at (10.11 2 3), velocity (10 0 0)"));
    expect(
        CLOSED_BOX CELL "thermo_style custom step atoms\nthermo_modify lost ignore\nrun 150\n", 0,
        PARTS("\n       0        3 \n", "\n      50        3 \n", "\n     100        3 \n", "\n     150        2 \n"));
    expect(CLOSED_BOX CELL "thermo_style custom step atoms\nthermo_modify lost warn\nrun 150\n", 0,
           PARTS("\n     150        2 \n", "WARNING: "));
}
END_TEST

#define BOX_OF_THREE                                                                                                   \
    "region box block 0 10 0 10 0 10 units box\ncreate_box 1 box\n"                                                    \
    "create_atoms 1 single 8 8 8 units box\ncreate_atoms 1 single 2 2 2 units box\n"                                   \
    "create_atoms 1 single 2 2 2 units box\nmass 1 1.0\npair_style lj/cut 2.5\n"                                       \
    "pair_coeff * * 1 1\nneigh_modify every 1 delay 0 check yes\nfix 1 all nve\nthermo 50\n"

/** Atoms on top of one another, or nearly: the run stops and names one of them. */
START_TEST(test_overlap)
{
    expect("units lj\n" BOX_OF_THREE "run 200\n", 2,
           PARTS(":13: error: at step 0 the force between two atoms is infinite", "created twice"));
    expect("units lj\nreproducible off\n" BOX_OF_THREE "run 200\n", 2,
           PARTS(":14: error: at step 1 atom 2 has the position (", "overlap"));
    /* 48 / d^13 * dt^2 beyond the box in the first step */
    expect("units lj\n" BOX_OF_THREE "set atom 3 x 2.0000000001\nrun 200\n", 2,
           PARTS("error: at step 1 atom 2 at (-", "overlap"));
    expect("units lj\n" BOX_OF_THREE "set atom 3 x 2.001\nrun 200\n", 2,
           PARTS("error: at step 1 atom 2 at (-6e+35 2 2)", "overlap"));
    expect("units lj\n" BOX_OF_THREE "set atom 3 x 2.2\nrun 200\n", 2,
           PARTS("error: at step 1 atom 2 at (-", "overlap"));
    /* a shrink-wrapped box follows atoms, but not to 1e120 */
    expect("units lj\nboundary s s s\n" BOX_OF_THREE "set atom 3 x 2.0000000001\nrun 200\n", 2,
           PARTS("error: at step 1 atom 2 at (-", "overlap"));
}
END_TEST

/** Ten times the timestep that the melt can bear. */
START_TEST(test_long_timestep)
{
    static const char *const methods[] = {"nsq", "cell", "cluster", "verlet"};
    for (size_t k = 0; k < sizeof methods / sizeof methods[0]; ++k) {
        char text[1024];
        snprintf(text, sizeof text,
                 "units lj\nlattice fcc 0.8442\nregion box block 0 5 0 5 0 5\ncreate_box 1 box\ncreate_atoms 1 box\n"
                 "mass 1 1.0\nvelocity all create 3.0 87287\npair_style lj/cut 2.5\npair_coeff * * 1 1\nfix 1 all nve\n"
                 "neigh_modify every 1 delay 0 check yes\nneighbor_method %s\ntimestep 0.05\nthermo 100\nrun 1000\n",
                 methods[k]);
        expect(text, 2, PARTS(":15: error: at step ", " atom ", "velocity (", "the timestep is too long"));
    }
}
END_TEST

HS_TEST_MAIN("ideal gas and boundaries", test_ideal_gas, test_stochastic_walls, test_velocity_distributions,
             test_equipartition, test_shrink_wrapped_box, test_lost_atom, test_overlap, test_long_timestep)
