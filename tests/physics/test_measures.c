/* What is measured two ways agrees: correlations by transform and by the direct sum, means and the errors of their
 * samples, rdf from the force's list and from a scan of its own, energies and stresses per atom and their sums. */
#define _GNU_SOURCE
#include <complex.h>

#include "core/statistics.h"
#include "physics/measured.h"

static const char liquid[] = LIQUID_OF_500("block 0 5 0 5 0 5");

/* Spheres of many sizes: whether a pair interacts, and whether it is listed, depends on the two atoms. */
static const char spheres[] =
    "units lj\natom_style sphere\nlattice fcc 0.9\nregion b block 0 5 0 5 0 5\ncreate_box 1 b\ncreate_atoms 1 box\n"
    "variable d atom 0.8+0.8*((id*61)%101)/100\nset group all diameter v_d\nset group all mass 1.0\n"
    "velocity all create 1.0 87287 loop geom\npair_style harmonic/sphere\npair_coeff 1 1 100.0\n"
    "neigh_modify every 1 delay 0 check yes\nfix 1 all nve\nrun 100\nreset_timestep 0\n";

static void run(const char *lines, void (*check)(hs_deck *deck, void *context)) { run_after(liquid, lines, check); }

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

/* A number's share of the upper bin is the mean of "it is above the middle"; and windows of one sample are samples. Of
 * values per atom, of which all but a few are counted, share and error are those of the ratio of two sums. */
static void check_shares(hs_deck *deck, void *context)
{
    static const char *const pairs[][2] = {{"f_h[2][3]", "f_t[1]"},     {"f_h[2][4]", "f_t[2]"},
                                           {"f_h[2][5]", "f_t[3]"},     {"f_w[2][3]", "f_h[2][3]"},
                                           {"f_w[2][4]", "f_h[2][4]"},  {"f_w[2][5]", "f_h[2][5]"},
                                           {"f_v[2][4]", "f_vw[2][4]"}, {"f_v[2][5]", "f_vw[2][5]"}};
    (void)context;
    for (size_t k = 0; k < sizeof pairs / sizeof pairs[0]; ++k)
        check_number(deck, pairs[k][0], number(deck, pairs[k][1]), 1e-12);
    const double share = number(deck, "f_h[2][3]"), counted = number(deck, "f_v[1]"), left_out = number(deck, "f_v[2]");
    ck_assert_msg(share > 0.1 && share < 0.9 && number(deck, "f_h[2][4]") > 0.0, "share %g", share);
    ck_assert(counted > 0.0 && left_out > 0.0 && number(deck, "f_v[2][4]") > 0.0);
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
             errors_of_averages_are_those_of_their_samples, rdf_from_the_list_is_that_of_the_scan,
             values_per_atom_add_up, errors_of_histograms_are_those_of_shares)
