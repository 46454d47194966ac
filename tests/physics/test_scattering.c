/* Scattering functions and the motion of atoms against direct sums over a dump of all samples; the structure factor
 * against its direct sum and against the radial distribution function, of which it is the transform. */
#define _GNU_SOURCE
#include <complex.h>
#include <string.h>
#include <unistd.h>

#include "physics/measured.h"

static const char *const liquids[] = {
    LIQUID_OF_500("block 0 5 0 5 0 5"), LIQUID_OF_500("prism 0 5 0 5 0 5 2 -1 1"), /* no two edges at right angles */
};
enum { N_LIQUIDS = 2 };

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
    run_after(liquids[0], lines, check_frames);
    unlink(dump_path);
}
END_TEST

/** Both sides of one Fourier transform, weighted with a Gaussian so that both sums end: with G(r) = exp(-r^2/(2 w^2)) /
 *  (2 pi w^2)^(3/2),  rho / N sum over q of S(q) exp(-q^2 w^2/2) = sum over all ordered pairs and images of G(r) / N +
 *  G(0) - rho. */
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
    /* distances are known to half a bin, 0.0005: what remains is the rounding of some 20,000 distances, of random
     * sign */
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
        /* 500 unit phases, each rounded in its 16th digit, and so is the grid of the transform: 1e-13 was seen */
        ck_assert_double_eq_tol(s[k], creal(sum * conj(sum)) / atoms->n_local, 1e-10);
    }
    free(q[0]), free(q[1]), free(q[2]), free(s);
}

START_TEST(structure_factor_is_that_of_the_direct_sum)
{
    for (int k = 0; k < N_LIQUIDS; ++k)
        run_after(liquids[k], "compute v all sq 3 vectors yes\nrun 20\n", check_vectors);
}
END_TEST

START_TEST(structure_factor_is_the_transform_of_g)
{
    for (int k = 0; k < N_LIQUIDS; ++k)
        run_after(liquids[k], "compute g all rdf 5000 cutoff 5.0\ncompute s all sq 11 vectors yes\nrun 20\n",
                  check_structure);
}
END_TEST

HS_TEST_MAIN("scattering", scattering_functions_are_those_of_the_direct_sum, structure_factor_is_that_of_the_direct_sum,
             structure_factor_is_the_transform_of_g)
