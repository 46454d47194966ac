/* Transforms against the direct sums. */
#include <math.h>

#include "base/memory.h"
#include "core/multi_tau.h"
#include "support/harness.h"

static double uniform(uint64_t *state)
{
    *state = *state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (double)(*state >> 11) * 0x1p-53;
}

enum { LAGS = 300, N_SERIES = 1000 };

START_TEST(correlations_equal_the_direct_sum)
{
    hs_error err = {0};
    hs_correlator *correlator;
    double a[2 * LAGS + N_SERIES] = {0}, b[2 * LAGS + N_SERIES] = {0}, sums[LAGS] = {0};
    uint64_t state = 1;
    for (int s = 0; s < N_SERIES; ++s) {
        a[LAGS + s] = uniform(&state) - 0.3;
        b[LAGS + s] = uniform(&state) + 0.4 * a[LAGS + s];
    }
    ck_assert_hs_ok(hs_correlator_create(&correlator, LAGS, &err), err);
    for (int s = 0; s < N_SERIES; s += LAGS) hs_correlator_add(correlator, a + s, b + s, sums);
    hs_correlator_destroy(&correlator);
    for (int lag = 0; lag < LAGS; ++lag) {
        double direct = 0.0;
        for (int s = lag; s < N_SERIES; ++s) direct += a[LAGS + s - lag] * b[LAGS + s];
        /* rounding of transforms of 600 numbers: about 1e-15 times the largest sum, 300 */
        ck_assert_msg(fabs(sums[lag] - direct) < 1e-10 * N_SERIES, "lag %d: %.15g, direct %.15g", lag, sums[lag],
                      direct);
        ck_assert_double_eq_tol(sums[lag], direct, 1e-11);
    }
}
END_TEST

enum { TAU_LAGS = 24, TAU_LEVELS = 5, TAU_SAMPLES = 3001 };

/** Sum of products of two series of n values at a lag, over the number of products. */
static double direct_mean(const double *a, const double *b, int n, int lag)
{
    double sum = 0.0;
    for (int s = lag; s < n; ++s) sum += a[s - lag] * b[s];
    return sum / (n - lag);
}

START_TEST(multiple_tau_equals_the_direct_sum)
{
    enum { N_ROWS = TAU_LAGS + (TAU_LEVELS - 1) * TAU_LAGS / 2, N_PAIRS = 3 };
    static double series[TAU_LEVELS][2][TAU_SAMPLES];
    static double count[N_ROWS], value[N_ROWS][N_PAIRS], error[N_ROWS][N_PAIRS], inefficiency[N_ROWS][N_PAIRS];
    int pair[N_PAIRS][2] = {{0, 0}, {0, 1}, {1, 0}}, n[TAU_LEVELS] = {TAU_SAMPLES};
    hs_error err = {0};
    hs_multi_tau tau = {0};
    uint64_t state = 5;
    const hs_multi_tau_plan plan = {.n_values = 2,
                                    .n_pairs = N_PAIRS,
                                    .pair = pair,
                                    .n_lags = TAU_LAGS,
                                    .n_levels = TAU_LEVELS,
                                    .has_errors = true};
    ck_assert_hs_ok(hs_multi_tau_init(&tau, &plan, &err), err);
    ck_assert_int_eq(hs_multi_tau_rows(&tau), N_ROWS);
    for (int s = 0; s < TAU_SAMPLES; ++s) {
        series[0][0][s] = uniform(&state) - 0.3;
        series[0][1][s] = uniform(&state) + 0.4 * series[0][0][s];
        const double values[] = {series[0][0][s], series[0][1][s]};
        ck_assert_hs_ok(hs_multi_tau_add(&tau, values, &err), err);
    }
    for (int l = 1; l < TAU_LEVELS; ++l) {
        n[l] = n[l - 1] / 2;
        for (int v = 0; v < 2; ++v)
            for (int s = 0; s < n[l]; ++s)
                series[l][v][s] = 0.5 * (series[l - 1][v][2 * s] + series[l - 1][v][2 * s + 1]);
    }
    hs_multi_tau_result(&tau, count, &value[0][0], &error[0][0], &inefficiency[0][0]);
    int64_t last = -1;
    for (int row = 0; row < N_ROWS; ++row) {
        const int l = row < TAU_LAGS ? 0 : 1 + (row - TAU_LAGS) / (TAU_LAGS / 2);
        const int lag = (int)(hs_multi_tau_lag(&tau, row) >> l);
        ck_assert(hs_multi_tau_lag(&tau, row) > last && lag < TAU_LAGS && (l == 0 || lag >= TAU_LAGS / 2));
        last = hs_multi_tau_lag(&tau, row);
        ck_assert(count[row] == n[l] - lag);
        for (int p = 0; p < N_PAIRS; ++p) {
            const double expected = direct_mean(series[l][pair[p][0]], series[l][pair[p][1]], n[l], lag);
            ck_assert_double_eq_tol(value[row][p], expected, 1e-12);
            /* products of values below 2 in blocks of 24 or more */
            ck_assert(error[row][p] > 0.0 && error[row][p] < 0.5 && inefficiency[row][p] > 0.0);
        }
    }
    hs_multi_tau_fini(&tau);
}
END_TEST

START_TEST(periodogram_equals_the_direct_sum)
{
    enum { N = 90 };
    hs_error err = {0};
    uint64_t state = 9;
    double samples[N], mean = 0.0;
    for (int i = 0; i < N; ++i) {
        samples[i] = uniform(&state) + sin(2.0 * M_PI * 7.0 * i / N);
        mean += samples[i] / N;
    }
    for (int kind = 0; kind < 4; ++kind) {
        const bool has_window = kind & 1, subtracts = kind & 2;
        hs_periodogram *periodogram;
        double power[2 * (N / 2 + 1)], total = 0.0, square = 0.0, norm = 0.0;
        ck_assert_hs_ok(hs_periodogram_create(&periodogram, N, has_window, subtracts, &err), err);
        hs_periodogram_eval(periodogram, samples, power, 2);
        hs_periodogram_destroy(&periodogram);
        double complex sum[N / 2 + 1] = {0};
        for (int i = 0; i < N; ++i) {
            const double s = sin(M_PI * (i + 0.5) / N), w = has_window ? s * s : 1.0;
            const double x = samples[i] - (subtracts ? mean : 0.0);
            for (int k = 0; k <= N / 2; ++k) sum[k] += w * x * cexp(-2.0 * M_PI * I * k * i / N);
            norm += w * w;
            square += x * x / N;
        }
        for (int k = 0; k <= N / 2; ++k) {
            const double both = k == 0 || k == N / 2 ? 1.0 : 2.0;
            ck_assert_double_eq_tol(power[2 * k], both * cabs(sum[k]) * cabs(sum[k]) / norm, 1e-11);
            total += power[2 * k] / N;
        }
        if (!has_window) ck_assert_double_eq_tol(total, square, 1e-13); /* Parseval */
    }
}
END_TEST

enum { N_POINTS = 200 };

static void check_modes(const int n_max[3])
{
    hs_error err = {0};
    hs_modes *modes;
    double x[3][N_POINTS], largest = 0.0;
    uint32_t mask[N_POINTS];
    uint64_t state = 7;
    for (int i = 0; i < N_POINTS; ++i) {
        for (int axis = 0; axis < 3; ++axis) x[axis][i] = 3.0 * uniform(&state) - 1.0;
        mask[i] = i % 5 == 0 ? 2 : 1;
    }
    x[0][1] = -1e-18; /* wraps to the very end */
    ck_assert_hs_ok(hs_modes_create(&modes, n_max, &err), err);
    hs_modes_spread(modes, N_POINTS, (const double *const[3]){x[0], x[1], x[2]}, mask, 1, N_POINTS);
    hs_modes_transform(modes);
    for (int n0 = -n_max[0]; n0 <= n_max[0]; ++n0)
        for (int n1 = -n_max[1]; n1 <= n_max[1]; ++n1)
            for (int n2 = -n_max[2]; n2 <= n_max[2]; ++n2) {
                double complex direct = 0.0;
                for (int i = 0; i < N_POINTS; ++i)
                    if (mask[i] & 1) direct += cexp(-2.0 * M_PI * I * (n0 * x[0][i] + n1 * x[1][i] + n2 * x[2][i]));
                largest = fmax(largest, cabs(direct - hs_modes_get(modes, n0, n1, n2)));
            }
    hs_modes_destroy(&modes);
    ck_assert_msg(largest < 1e-10, "modes differ by %g", largest);
}

START_TEST(density_modes_equal_the_direct_sum)
{
    check_modes((const int[3]){4, 7, 5});
    check_modes((const int[3]){12, 9, 0});
    check_modes((const int[3]){0, 0, 30});
    check_modes((const int[3]){1, 1, 1});
}
END_TEST

HS_TEST_MAIN("fourier", correlations_equal_the_direct_sum, multiple_tau_equals_the_direct_sum,
             periodogram_equals_the_direct_sum, density_modes_equal_the_direct_sum)
