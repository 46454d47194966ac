/* What is measured two ways agrees: correlations by transform and by the direct sum, structure factor and radial distribution
 * function, rdf from the force's list and from a scan of its own, energies and stresses per atom and their sums. */
#define _GNU_SOURCE
#include <complex.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "core/statistics.h"
#include "style/value.h"
#include "support/harness.h"
#include "support/run_deck.h"

static const char liquid[] =
    "units lj\nlattice fcc 0.8442\nregion b block 0 5 0 5 0 5\ncreate_box 1 b\ncreate_atoms 1 box\n"
    "mass 1 1.0\nvelocity all create 1.44 87287 loop geom\npair_style lj/cut 2.5\npair_coeff 1 1 1 1\n"
    "neigh_modify every 1 delay 0 check yes\nfix 1 all nve\nrun 100\nreset_timestep 0\n";

/* No two edges of the box at right angles. */
static const char tilted[] =
    "units lj\nlattice fcc 0.8442\nregion b prism 0 5 0 5 0 5 2 -1 1\ncreate_box 1 b\ncreate_atoms 1 box\n"
    "mass 1 1.0\nvelocity all create 1.44 87287 loop geom\npair_style lj/cut 2.5\npair_coeff 1 1 1 1\n"
    "neigh_modify every 1 delay 0 check yes\nfix 1 all nve\nrun 100\nreset_timestep 0\n";

/* Spheres of many sizes: whether a pair interacts, and whether it is listed, depends on the two atoms. */
static const char spheres[] =
    "units lj\natom_style sphere\nlattice fcc 0.9\nregion b block 0 5 0 5 0 5\ncreate_box 1 b\ncreate_atoms 1 box\n"
    "variable d atom 0.8+0.8*((id*61)%101)/100\nset group all diameter v_d\nset group all mass 1.0\n"
    "velocity all create 1.0 87287 loop geom\npair_style harmonic/sphere\npair_coeff 1 1 100.0\n"
    "neigh_modify every 1 delay 0 check yes\nfix 1 all nve\nrun 100\nreset_timestep 0\n";

/** Run the system and then more lines, with the check at the end. */
static void run_after(const char *system, const char *lines, void (*check)(hs_deck *deck, void *context))
{
    hs_error err = {0};
    char deck[8192];
    const hs_options options = {.n_threads = 2};
    snprintf(deck, sizeof deck, "%s%s", system, lines);
    free(hs_test_run_deck_with(deck, &options, check, NULL, &err));
    ck_assert_msg(err.status == HS_OK, "%s", err.text);
}

static void run(const char *lines, void (*check)(hs_deck *deck, void *context)) { run_after(liquid, lines, check); }

/** A vector or column of an array, which the caller frees with free. */
static double *fetch(hs_deck *deck, const char *word, int *n)
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

static void check_equal(hs_deck *deck, const char *a, const char *b, double tolerance)
{
    int n_a, n_b;
    double *x = fetch(deck, a, &n_a), *y = fetch(deck, b, &n_b);
    ck_assert_int_eq(n_a, n_b);
    for (int i = 0; i < n_a; ++i)
        ck_assert_msg(fabs(x[i] - y[i]) <= tolerance, "%s[%d] = %.15g, %s[%d] = %.15g", a, i + 1, x[i], b, i + 1, y[i]);
    free(x);
    free(y);
}

static void check_correlations(hs_deck *deck, void *context)
{
    (void)context;
    check_equal(deck, "f_d[2]", "f_f[2]", 0.0);
    check_equal(deck, "f_d[3]", "f_f[3]", 1e-10);
    check_equal(deck, "f_d[4]", "f_f[4]", 1e-10);
    check_equal(deck, "f_df[5]", "f_ff[5]", 1e-10);
    check_equal(deck, "f_df[4]", "f_ff[4]", 1e-10);
}

START_TEST(correlations_by_transform_are_those_of_the_direct_sum)
{
    run("variable a equal pxy\nvariable b equal temp\n"
        "fix d all ave/correlate 2 30 50 v_a v_b ave running\nfix f all ave/correlate/fft 2 30 50 v_a v_b\n"
        "fix df all ave/correlate 1 7 50 v_a v_b ave running type full\n"
        "fix ff all ave/correlate/fft 1 7 50 v_a v_b type full\nrun 250\n",
        check_correlations);
}
END_TEST

/** An element of a fix's vector or array equals @p expected. */
static void check_number(hs_deck *deck, const char *word, double expected, double tolerance)
{
    hs_error err = {0};
    hs_value value = {0};
    double number;
    const hs_args args = {.command = "test", .n = 1, .word = &word};
    ck_assert_hs_ok(hs_value_init(&value, &deck->sim->env, &args, 0, HS_VALUE_NUMBER, &err), err);
    ck_assert_hs_ok(hs_value_number(&deck->sim->env, &value, &number, &err), err);
    ck_assert_msg(fabs(number - expected) <= tolerance, "%s is %.15g, expected %.15g", word, number, expected);
    hs_value_fini(&value);
}

static void check_long(hs_deck *deck, void *context)
{
    int n, n_lag;
    double *t = fetch(deck, "f_t", &n), *lag = fetch(deck, "f_l[1]", &n_lag), *c = fetch(deck, "f_l[3]", &n_lag);
    (void)context;
    ck_assert_int_eq(n, 401);
    ck_assert_int_eq(n_lag, 10 + 2 * 5);
    check_equal(deck, "f_one[3]", "f_one2[3]", 0.0);
    for (int row = 0; row < n_lag; ++row) {
        const int size = row < 10 ? 1 : row < 15 ? 2 : 4, steps = row < 10 ? row : (5 + row % 5) * size;
        ck_assert(lag[row] == steps);
        double sum = 0.0;
        int count = 0;
        for (int s = steps; s + size <= n; s += size, ++count) {
            double a = 0.0, b = 0.0;
            for (int i = 0; i < size; ++i) a += t[s - steps + i] / size, b += t[s + i] / size;
            sum += a * b;
        }
        ck_assert_double_eq_tol(c[row], sum / count, 1e-12);
    }
    free(t), free(lag), free(c);
}

START_TEST(correlations_beyond_the_window_are_those_of_means_over_samples)
{
    run("variable p equal pxy\nfix t all vector 1 v_p\nfix l all ave/correlate/fft 1 10 400 v_p levels 3\n"
        "fix one all ave/correlate/fft 1 10 400 v_p\nfix one2 all ave/correlate/fft 1 10 400 v_p error yes\nrun 400\n",
        check_long);
}
END_TEST

static void check_spectrum(hs_deck *deck, void *context)
{
    enum { N = 64, SEGMENTS = 5 };
    int n;
    double *t = fetch(deck, "f_t", &n), *f = fetch(deck, "f_s[1]", &n), *p = fetch(deck, "f_s[3]", &n);
    hs_series series[N / 2 + 1] = {{0}};
    (void)context;
    ck_assert_int_eq(n, N / 2 + 1);
    for (int segment = 0; segment < SEGMENTS; ++segment)
        for (int k = 0; k <= N / 2; ++k) {
            double complex sum = 0.0;
            for (int i = 0; i < N; ++i) sum += t[segment * N / 2 + i] * cexp(-2.0 * M_PI * I * k * i / N);
            hs_series_add(&series[k], 2 * 0.005 * (k == 0 || k == N / 2 ? 1 : 2) * cabs(sum) * cabs(sum) / N, 1.0);
        }
    for (int k = 0; k <= N / 2; ++k) {
        const hs_estimate e = hs_series_estimate(&series[k]);
        ck_assert_double_eq_tol(f[k], k / (N * 2 * 0.005), 1e-12);
        ck_assert_double_eq_tol(p[k], e.mean, 1e-10 * fmax(1.0, e.mean));
        char word[32];
        snprintf(word, sizeof word, "f_s[%d][4]", k + 1);
        check_number(deck, word, e.error, 1e-10 * fmax(1.0, e.mean));
    }
    free(t), free(f), free(p);
}

START_TEST(spectra_are_those_of_the_direct_sum)
{
    run("fix t all vector 2 c_thermo_temp\n"
        "fix s all ave/spectrum 2 64 400 c_thermo_temp window none mean keep error yes\nrun 400\n",
        check_spectrum);
}
END_TEST

static hs_estimate estimate_of(const double *values, int begin, int end)
{
    hs_series series = {0};
    for (int i = begin; i < end; ++i) hs_series_add(&series, values[i], 1.0);
    return hs_series_estimate(&series);
}

static void check_errors(hs_deck *deck, void *context)
{
    int n;
    double *t = fetch(deck, "f_t", &n); /* steps 0, 2, ..., 400 */
    (void)context;
    ck_assert_int_eq(n, 201);
    const hs_estimate all = estimate_of(t, 1, n), last = estimate_of(t, 101, n), windows = estimate_of(t, n - 20, n);
    check_number(deck, "f_r", all.mean, 1e-14);
    check_number(deck, "f_r[2]", all.error, 0.0);
    check_number(deck, "f_r[3]", all.inefficiency, 0.0);
    check_number(deck, "f_o[1]", last.mean, 1e-14);
    check_number(deck, "f_o[3]", last.error, 0.0);
    check_number(deck, "f_o[5]", last.inefficiency, 0.0);
    check_number(deck, "f_m[2]", windows.error, 0.0);
    check_number(deck, "f_c[1][3]", last.error, 1e-14);
    free(t);
}

START_TEST(errors_of_averages_are_those_of_their_samples)
{
    run("fix t all vector 2 c_thermo_temp\n"
        "fix r all ave/time 2 10 20 c_thermo_temp ave running error yes\n"
        "fix o all ave/time 2 100 200 c_thermo_temp c_thermo_press error yes\n"
        "fix m all ave/time 2 1 2 c_thermo_temp ave window 20 error yes\n"
        /* all atoms in one chunk; three degrees of freedom less, as in compute temp */
        "compute all all chunk/atom type\nfix c all ave/chunk 2 100 200 all temp cdof -3 error yes\nrun 400\n",
        check_errors);
}
END_TEST

/* Scattering functions and the motion of atoms against direct sums over a dump of all samples. */
enum { N_ATOMS = 500, N_FRAMES = 41, N_WINDOW = 8, N_SHELLS = 3, N_LONG = N_WINDOW + N_WINDOW / 2 };
#define Q_MAX 3.0
typedef struct frame {
    double r[3][N_ATOMS], v[3][N_ATOMS];
} frame;

static char dump_path[] = "/tmp/halfshell_frames_XXXXXX";

static frame *read_frames(void)
{
    frame *frames = calloc(N_FRAMES, sizeof *frames);
    FILE *stream = fopen(dump_path, "r");
    char line[512];
    int at = -1, id;
    ck_assert_ptr_nonnull(stream);
    while (fgets(line, sizeof line, stream) != NULL) {
        double x[6];
        if (strncmp(line, "ITEM: TIMESTEP", 14) == 0) ++at;
        if (sscanf(line, "%d %lf %lf %lf %lf %lf %lf", &id, &x[0], &x[1], &x[2], &x[3], &x[4], &x[5]) != 7) continue;
        for (int a = 0; a < 3; ++a) frames[at].r[a][id - 1] = x[a], frames[at].v[a][id - 1] = x[3 + a];
    }
    fclose(stream);
    ck_assert_int_eq(at, N_FRAMES - 1);
    return frames;
}

/** One mode of all frames: its correlation is added to the sums of a shell, at the lags of two levels. */
static void add_mode(const frame *frames, const double q[3], double sums[N_LONG])
{
    double complex rho[2][N_FRAMES] = {{0}};
    for (int s = 0; s < N_FRAMES; ++s)
        for (int i = 0; i < N_ATOMS; ++i)
            rho[0][s] += cexp(-I * (q[0] * frames[s].r[0][i] + q[1] * frames[s].r[1][i] + q[2] * frames[s].r[2][i]));
    for (int s = 0; s < N_FRAMES / 2; ++s) rho[1][s] = 0.5 * (rho[0][2 * s] + rho[0][2 * s + 1]);
    for (int row = 0; row < N_LONG; ++row) {
        const int level = row < N_WINDOW ? 0 : 1, lag = row < N_WINDOW ? row : row - N_WINDOW / 2;
        const int n = level == 0 ? N_FRAMES : N_FRAMES / 2;
        for (int s = lag; s < n; ++s)
            sums[row] += creal(conj(rho[level][s - lag]) * rho[level][s]) / ((n - lag) * (double)N_ATOMS);
    }
}

static void check_coherent(hs_deck *deck, const frame *frames)
{
    const double unit = 2.0 * M_PI / hs_box_length(&deck->sim->box, 0);
    const int n_max = (int)(Q_MAX / unit);
    double sums[N_SHELLS][N_LONG] = {{0}};
    int n[3], n_vectors[N_SHELLS] = {0};
    for (n[0] = -n_max; n[0] <= n_max; ++n[0])
        for (n[1] = -n_max; n[1] <= n_max; ++n[1])
            for (n[2] = 0; n[2] <= n_max; ++n[2]) {
                const double q[3] = {n[0] * unit, n[1] * unit, n[2] * unit};
                const double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2]);
                if (length > Q_MAX || length == 0.0) continue;
                if (n[2] == 0 && (n[1] < 0 || (n[1] == 0 && n[0] < 0))) continue; /* of q and -q one */
                const int shell = (int)(length / Q_MAX * N_SHELLS);
                ++n_vectors[shell];
                add_mode(frames, q, sums[shell]);
            }
    for (int shell = 0, column = 3; shell < N_SHELLS; ++shell) {
        char word[32];
        int n_rows;
        if (n_vectors[shell] == 0) continue;
        snprintf(word, sizeof word, "f_F[%d]", column++);
        double *f = fetch(deck, word, &n_rows);
        ck_assert_int_eq(n_rows, N_LONG);
        for (int row = 0; row < N_LONG; ++row)
            ck_assert_double_eq_tol(f[row], sums[shell][row] / n_vectors[shell], 1e-10);
        free(f);
    }
}

static void check_self(hs_deck *deck, const frame *frames)
{
    int n_rows;
    double *f[4];
    for (int k = 0; k < 4; ++k) {
        char word[32];
        snprintf(word, sizeof word, "f_S[%d]", 3 + k);
        f[k] = fetch(deck, word, &n_rows);
    }
    ck_assert_int_eq(n_rows, N_WINDOW);
    for (int lag = 0; lag < N_WINDOW; ++lag) {
        double mean[4] = {0};
        int n_origins = 0;
        for (int s = 0; s + N_WINDOW - 1 < N_FRAMES; s += 4, ++n_origins) {
            double sum[4] = {0};
            for (int i = 0; i < N_ATOMS; ++i) {
                double d2 = 0.0, vv = 0.0;
                for (int a = 0; a < 3; ++a) {
                    const double d = frames[s + lag].r[a][i] - frames[s].r[a][i];
                    d2 += d * d;
                    vv += frames[s + lag].v[a][i] * frames[s].v[a][i];
                }
                sum[0] += d2 / N_ATOMS, sum[1] += vv / N_ATOMS, sum[2] += d2 * d2 / N_ATOMS;
                sum[3] += (d2 > 0.0 ? sin(7.2 * sqrt(d2)) / (7.2 * sqrt(d2)) : 1.0) / N_ATOMS;
            }
            mean[0] += sum[0], mean[1] += sum[1], mean[3] += sum[3];
            mean[2] += lag > 0 ? 0.6 * sum[2] / (sum[0] * sum[0]) - 1.0 : 0.0;
        }
        for (int k = 0; k < 4; ++k) ck_assert_double_eq_tol(f[k][lag], mean[k] / n_origins, 1e-10);
    }
    for (int k = 0; k < 4; ++k) free(f[k]);
}

static void check_frames(hs_deck *deck, void *context)
{
    frame *frames = read_frames();
    (void)context;
    check_coherent(deck, frames);
    check_self(deck, frames);
    free(frames);
}

START_TEST(scattering_functions_are_those_of_the_direct_sum)
{
    char lines[1024];
    const int file = mkstemp(dump_path);
    ck_assert(file >= 0);
    close(file);
    snprintf(lines, sizeof lines,
             "dump d all custom 5 %s id xu yu zu vx vy vz\ndump_modify d format float %%.17g\n"
             "fix F all ave/isf 5 8 200 3.0 3 levels 2 error yes\n"
             "fix S all ave/self 5 8 200 msd vacf alpha2 isf 7.2 origins 2 error yes\nrun 200\n",
             dump_path);
    run(lines, check_frames);
    unlink(dump_path);
}
END_TEST

static void check_rdfs(hs_deck *deck, void *context)
{
    (void)context;
    check_equal(deck, "c_list[2]", "c_scan[2]", 0.0);
    check_equal(deck, "c_list[3]", "c_scan[3]", 0.0);
}

START_TEST(rdf_from_the_list_is_that_of_the_scan)
{
    /* with a pair of types named, the list is not used */
    run("compute list all rdf 90\ncompute scan all rdf 90 1 1\nrun 37\n", check_rdfs);
    run_after(spheres, "compute list all rdf 90\ncompute scan all rdf 90 1 1\nrun 37\n", check_rdfs);
}
END_TEST

/** Both sides of one Fourier transform, weighted with a Gaussian so that both sums end: with G(r) = exp(-r^2/(2 w^2)) /
 *  (2 pi w^2)^(3/2),  rho / N sum over q of S(q) exp(-q^2 w^2/2) = sum over all ordered pairs and images of G(r) / N + G(0) - rho. */
static void check_width(hs_deck *deck, double w)
{
    enum { N = 500 };
    int n, n_q;
    double *r = fetch(deck, "c_g[1]", &n), *g = fetch(deck, "c_g[2]", &n);
    double *qx = fetch(deck, "c_s[1]", &n_q), *qy = fetch(deck, "c_s[2]", &n_q), *qz = fetch(deck, "c_s[3]", &n_q),
           *s = fetch(deck, "c_s[4]", &n_q);
    const double rho = 0.8442, dr = r[1] - r[0], peak = pow(2.0 * M_PI * w * w, -1.5);
    double from_s = 0.0, from_g = peak - rho;
    for (int k = 0; k < n_q; ++k) /* of q and -q one is listed */
        from_s += 2.0 * rho / N * s[k] * exp(-0.5 * w * w * (qx[k] * qx[k] + qy[k] * qy[k] + qz[k] * qz[k]));
    for (int i = 0; i < n; ++i) {
        const double lower = r[i] - 0.5 * dr, upper = r[i] + 0.5 * dr;
        const double shell = 4.0 * M_PI / 3.0 * (upper * upper * upper - lower * lower * lower);
        from_g += rho * (N - 1.0) / N * g[i] * shell * peak * exp(-0.5 * r[i] * r[i] / (w * w));
    }
    /* distances are known to half a bin, 0.0005: what remains is the rounding of some 20,000 distances, of random sign */
    ck_assert_msg(fabs(from_s - from_g) < 2e-4 * peak, "width %g: %.8g from S(q), %.8g from g(r)", w, from_s, from_g);
    free(r), free(g), free(qx), free(qy), free(qz), free(s);
}

static void check_structure(hs_deck *deck, void *context)
{
    (void)context;
    check_width(deck, 0.6);
    check_width(deck, 0.8);
}

/** Every wave vector up to q_max is there, is one of the reciprocal lattice, and has the S of the direct sum. */
static void check_vectors(hs_deck *deck, void *context)
{
    static const double q_max = 3.0;
    const hs_atoms *atoms = &deck->sim->atoms;
    const hs_box *box = &deck->sim->box;
    const double volume = hs_box_volume(box),
                 l[3] = {hs_box_length(box, 0), hs_box_length(box, 1), hs_box_length(box, 2)};
    const double a[3] = {l[0], 0.0, 0.0}, b[3] = {box->tilt[0], l[1], 0.0}, c[3] = {box->tilt[1], box->tilt[2], l[2]};
    const double *const edge[3] = {a, b, c};
    int n, n_wanted = 0;
    double *q[3], *s = fetch(deck, "c_v[4]", &n);
    (void)context;
    q[0] = fetch(deck, "c_v[1]", &n), q[1] = fetch(deck, "c_v[2]", &n), q[2] = fetch(deck, "c_v[3]", &n);
    for (int i = -20; i <= 20; ++i) /* n_a b x c + n_b c x a + n_c a x b, times 2 pi / V */
        for (int j = -20; j <= 20; ++j)
            for (int k = -20; k <= 20; ++k) {
                const int m[3] = {i, j, k};
                double p2 = 0.0;
                for (int axis = 0; axis < 3; ++axis) {
                    const int y = (axis + 1) % 3, z = (axis + 2) % 3;
                    double p = 0.0;
                    for (int e = 0; e < 3; ++e) {
                        const double *second = edge[(e + 1) % 3], *third = edge[(e + 2) % 3];
                        p += m[e] * (second[y] * third[z] - second[z] * third[y]);
                    }
                    p2 += p * p;
                }
                n_wanted += p2 > 0.0 && sqrt(p2) * 2.0 * M_PI / volume <= q_max;
            }
    ck_assert_int_eq(2 * n, n_wanted); /* of q and -q one */
    for (int k = 0; k < n; ++k) {
        double complex sum = 0.0;
        for (int e = 0; e < 3; ++e) {
            const double turns = (q[0][k] * edge[e][0] + q[1][k] * edge[e][1] + q[2][k] * edge[e][2]) / (2.0 * M_PI);
            ck_assert_double_eq_tol(turns, rint(turns), 1e-10);
        }
        for (int i = 0; i < atoms->n_local; ++i)
            sum += cexp(-I * (q[0][k] * atoms->x[0][i] + q[1][k] * atoms->x[1][i] + q[2][k] * atoms->x[2][i]));
        ck_assert_double_eq_tol(s[k], creal(sum * conj(sum)) / atoms->n_local, 1e-8);
    }
    free(q[0]), free(q[1]), free(q[2]), free(s);
}

START_TEST(structure_factor_of_a_tilted_box)
{
    run_after(tilted, "compute v all sq 3 vectors yes\nrun 20\n", check_vectors);
    run_after(tilted, "compute g all rdf 5000 cutoff 5.0\ncompute s all sq 11 vectors yes\nrun 20\n", check_structure);
}
END_TEST

START_TEST(structure_factor_is_the_transform_of_g)
{
    run("compute g all rdf 5000 cutoff 5.0\ncompute s all sq 11 vectors yes\nrun 20\n", check_structure);
}
END_TEST

static void check_sums(hs_deck *deck, void *context)
{
    hs_env *env = &deck->sim->env;
    hs_error err = {0};
    double pe, sum, press[6], stress[6];
    (void)context;
    ck_assert_hs_ok(hs_compute_scalar(env->find_compute(env, "thermo_pe"), &pe, &err), err);
    ck_assert_hs_ok(hs_compute_scalar(env->find_compute(env, "u"), &sum, &err), err);
    ck_assert_double_eq_tol(sum, pe, 1e-9 * fabs(pe));
    for (int k = 0; k < 6; ++k) {
        ck_assert_hs_ok(hs_compute_vector(env->find_compute(env, "thermo_press"), k, &press[k], &err), err);
        ck_assert_hs_ok(hs_compute_vector(env->find_compute(env, "p"), k, &stress[k], &err), err);
        ck_assert_double_eq_tol(-stress[k] / hs_box_volume(env->box), press[k], 1e-9);
    }
}

START_TEST(values_per_atom_add_up)
{
    static const char lines[] = "compute ua all pe/atom\ncompute sa all stress/atom NULL\n"
                                "compute u all reduce sum c_ua\ncompute p all reduce sum c_sa[*]\nrun 20\n";
    run(lines, check_sums);
    run_after(spheres, lines, check_sums);
}
END_TEST

static double number_of(hs_deck *deck, const char *word)
{
    hs_error err = {0};
    hs_value value = {0};
    double number;
    hs_env *env = &deck->sim->env;
    const hs_args args = {.command = "test", .n = 1, .word = &word};
    ck_assert_hs_ok(hs_value_init(&value, env, &args, 0, HS_VALUE_NUMBER, &err), err);
    ck_assert_hs_ok(hs_value_number(env, &value, &number, &err), err);
    hs_value_fini(&value);
    return number;
}

/* A number's share of the upper bin is the mean of "it is above the middle"; and windows of one sample are samples. Of values per
 * atom, of which all but a few are counted, share and error are those of the ratio of two sums. */
static void check_shares(hs_deck *deck, void *context)
{
    static const char *const pairs[][2] = {{"f_h[2][3]", "f_t[1]"},     {"f_h[2][4]", "f_t[2]"},
                                           {"f_h[2][5]", "f_t[3]"},     {"f_w[2][3]", "f_h[2][3]"},
                                           {"f_w[2][4]", "f_h[2][4]"},  {"f_w[2][5]", "f_h[2][5]"},
                                           {"f_v[2][4]", "f_vw[2][4]"}, {"f_v[2][5]", "f_vw[2][5]"}};
    (void)context;
    for (size_t k = 0; k < sizeof pairs / sizeof pairs[0]; ++k)
        check_number(deck, pairs[k][0], number_of(deck, pairs[k][1]), 1e-12);
    const double share = number_of(deck, "f_h[2][3]"), counted = number_of(deck, "f_v[1]"),
                 left_out = number_of(deck, "f_v[2]");
    ck_assert_msg(share > 0.1 && share < 0.9 && number_of(deck, "f_h[2][4]") > 0.0, "share %g", share);
    ck_assert(counted > 0.0 && left_out > 0.0 && number_of(deck, "f_v[2][4]") > 0.0);
}

START_TEST(errors_of_histograms_are_those_of_shares)
{
    run("variable i equal c_thermo_temp>0.76\nfix t all ave/time 2 1 2 v_i ave running error yes\n"
        "fix h all ave/histo 2 1 2 0.26 1.26 2 c_thermo_temp beyond end ave running error yes\n"
        "fix w all ave/histo 2 1 2 0.26 1.26 2 c_thermo_temp beyond end ave window 1000 error yes\n"
        "fix v all ave/histo 2 1 2 -1 1 3 vx mode vector ave running error yes\n"
        "fix vw all ave/histo 2 1 2 -1 1 3 vx mode vector ave window 1000 error yes\nrun 400\n",
        check_shares);
}
END_TEST

HS_TEST_MAIN("measures", correlations_by_transform_are_those_of_the_direct_sum,
             correlations_beyond_the_window_are_those_of_means_over_samples, spectra_are_those_of_the_direct_sum,
             scattering_functions_are_those_of_the_direct_sum, errors_of_averages_are_those_of_their_samples,
             rdf_from_the_list_is_that_of_the_scan, structure_factor_is_the_transform_of_g,
             structure_factor_of_a_tilted_box, values_per_atom_add_up, errors_of_histograms_are_those_of_shares)
