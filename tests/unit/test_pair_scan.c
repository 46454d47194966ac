/* Pairs for measuring: the search among sorted atoms with every instruction set, and energies and stresses of atoms against a double
 * loop over all images, with the same bits from any threads. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "kernel/kernel.h"
#include "style/compute.h"
#include "support/harness.h"
#include "support/run_deck.h"

START_TEST(every_instruction_set_finds_the_same_places)
{
    enum { N = 200 };
    double *x[3]; /* no longer than they must be: sanitizers see what is read beyond */
    int32_t near[N + HS_NEAR_PAD];
    srand(4711);
    for (int axis = 0; axis < 3; ++axis) {
        x[axis] = malloc(N * sizeof(double));
        for (int i = 0; i < N; ++i) x[axis][i] = rand() / (double)RAND_MAX;
    }
    const double *const place[3] = {x[0], x[1], x[2]};
    for (hs_isa isa = 0; isa < HS_N_ISAS; ++isa) {
        hs_error err = {0};
        if (hs_isa_get(hs_isa_names[isa], &isa, &err) != HS_OK) continue;
        for (int begin = 0; begin < N; begin += 3)
            for (int end = begin; end <= N && end < begin + 130; end += 1 + end % 5) {
                const double at[3] = {x[0][begin], x[1][begin], x[2][begin]};
                const int n = hs_isa_near(isa)(place, at, 0.3 * 0.3, begin, end, near);
                int k = 0;
                for (int i = begin; i < end; ++i) {
                    const double d[3] = {x[0][i] - at[0], x[1][i] - at[1], x[2][i] - at[2]};
                    if (!(d[0] * d[0] + d[1] * d[1] + d[2] * d[2] < 0.3 * 0.3)) continue;
                    ck_assert_msg(k < n && near[k] == i, "%s: place %d of %d to %d is missing", hs_isa_names[isa], i,
                                  begin, end);
                    ++k;
                }
                ck_assert_int_eq(k, n);
            }
    }
    for (int axis = 0; axis < 3; ++axis) free(x[axis]);
}
END_TEST

/* A liquid with some atoms off their lattice, in a tilted box that is shorter than twice the cutoff along one axis. */
static const char liquid[] =
    "lattice fcc 0.8\nregion b prism 0 5 0 4 0 2 0.7 -0.4 0.3\ncreate_box 2 b\ncreate_atoms 1 box\n"
    "mass * 1.0\nset type 1 type/fraction 2 0.5 77\ndisplace_atoms all random 0.1 0.1 0.1 123\n"
    "pair_style lj/cut 2.5\npair_coeff * * 1.0 1.0\npair_coeff 1 2 0.5 1.1 2.0\n"
    "compute e all pe/atom\ncompute s all stress/atom NULL virial\nfix 1 all nve\n"
    "neigh_modify every 1 delay 0 check yes\n";

enum { N_VALUES = 7 };

/** Add the halves of a pair's energy and virial, in the order of the stress, to values[N_VALUES]. */
static void add_pair(const hs_sim *sim, int i, int j, const double d[3], double *values)
{
    const bool is_unlike = sim->atoms.type[i] != sim->atoms.type[j];
    const double cutoff = is_unlike ? 2.0 : 2.5, epsilon = is_unlike ? 0.5 : 1.0, sigma = is_unlike ? 1.1 : 1.0;
    const double r2 = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    if (r2 >= cutoff * cutoff || r2 == 0.0) return;
    const double s6 = pow(sigma * sigma / r2, 3.0), force_over_r = 24.0 * epsilon * (2.0 * s6 * s6 - s6) / r2;
    const int a[6] = {0, 1, 2, 0, 0, 1}, b[6] = {0, 1, 2, 1, 2, 2};
    values[0] += 2.0 * epsilon * (s6 * s6 - s6);
    for (int k = 0; k < 6; ++k) values[1 + k] -= 0.5 * force_over_r * d[a[k]] * d[b[k]];
}

/** Energy and stress of atom i from all images of all atoms. */
static void sum_images(const hs_sim *sim, int i, double *values)
{
    const hs_atoms *atoms = &sim->atoms;
    memset(values, 0, N_VALUES * sizeof *values);
    for (int j = 0; j < atoms->n_local; ++j)
        for (int n = 0; n < 125; ++n) {
            const int image[3] = {n / 25 - 2, n / 5 % 5 - 2, n % 5 - 2};
            double shift[3], d[3];
            hs_box_shift(&sim->box, image, shift);
            for (int axis = 0; axis < 3; ++axis) d[axis] = atoms->x[axis][j] + shift[axis] - atoms->x[axis][i];
            add_pair(sim, i, j, d, values);
        }
}

/** Values of the computes in the order of ids. */
typedef struct measured {
    double *value; /**< owned [n][N_VALUES] */
    int n;
} measured;

static void measure(hs_deck *deck, void *context)
{
    measured *m = context;
    hs_error err = {0};
    const hs_sim *sim = deck->sim;
    hs_compute *energy = hs_sim_find_compute(deck->sim, "e"), *stress = hs_sim_find_compute(deck->sim, "s");
    ck_assert_hs_ok(hs_compute_eval_atoms(energy, &err), err);
    ck_assert_hs_ok(hs_compute_eval_atoms(stress, &err), err);
    m->n = sim->atoms.n_local;
    m->value = malloc((size_t)m->n * N_VALUES * sizeof(double));
    for (int i = 0; i < m->n; ++i) {
        double expected[N_VALUES], *value = m->value + (sim->atoms.id[i] - 1) * N_VALUES;
        sum_images(sim, i, expected);
        value[0] = energy->atoms[i];
        for (int k = 0; k < 6; ++k) value[1 + k] = stress->atoms[k * m->n + i];
        /* some 50 pairs, the largest of about 100, each rounded */
        for (int k = 0; k < N_VALUES; ++k) ck_assert_double_eq_tol(value[k], expected[k], 1e-11);
    }
}

/** Run the deck and measure; on so many threads, with these settings. */
static measured run(const char *more, int n_threads)
{
    measured m = {0};
    hs_error err = {0};
    char text[2048];
    const hs_options options = {.n_threads = n_threads};
    snprintf(text, sizeof text, "%s%s", liquid, more);
    free(hs_test_run_deck_with(text, &options, measure, &m, &err));
    ck_assert_hs_ok(err.status, err);
    return m;
}

/* After a run all is known of its largest pair; without energies, or when atoms were moved nearer to each other since, it must be looked
   for. */
START_TEST(energies_and_stresses_are_those_of_a_double_loop)
{
    static const char *const ways[] = {"run 3\n", "reproducible off\nrun 3\n",
                                       "run 3\ndisplace_atoms all random 0.05 0.05 0.05 9\n"};
    for (size_t way = 0; way < sizeof ways / sizeof ways[0]; ++way) {
        const measured one = run(ways[way], 1);
        for (int n_threads = 2; n_threads <= 3 && way != 1; ++n_threads) {
            const measured other = run(ways[way], n_threads);
            ck_assert_int_eq(one.n, other.n);
            ck_assert_int_eq(memcmp(one.value, other.value, (size_t)one.n * N_VALUES * sizeof(double)), 0);
            free(other.value);
        }
        free(one.value);
    }
}
END_TEST

HS_TEST_MAIN("pair scan", every_instruction_set_finds_the_same_places, energies_and_stresses_are_those_of_a_double_loop)
