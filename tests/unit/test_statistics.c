/* Errors of means: series of known correlation, with fixed seeds. */
#include <math.h>
#include <stdint.h>
#include <stdio.h>

#include "core/statistics.h"
#include "support/harness.h"

/** splitmix64, for the tests alone. */
static double uniform(uint64_t *state)
{
    uint64_t z = (*state += UINT64_C(0x9e3779b97f4a7c15));
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return ((double)((z ^ (z >> 31)) >> 11) + 0.5) * 0x1p-53;
}

static double normal(uint64_t *state)
{
    const double r = sqrt(-2.0 * log(uniform(state)));
    return r * cos(2.0 * M_PI * uniform(state));
}

/** x_k = phi x_(k-1) + noise, of variance 1 and mean 0: its inefficiency is (1 + phi) / (1 - phi). */
static hs_estimate autoregressive(uint64_t seed, double phi, int n)
{
    hs_series series = {0};
    uint64_t state = seed * UINT64_C(7919) + 1;
    double x = normal(&state);
    for (int k = 0; k < n; ++k) {
        hs_series_add(&series, x, 1.0);
        x = phi * x + sqrt(1.0 - phi * phi) * normal(&state);
    }
    return hs_series_estimate(&series);
}

START_TEST(mean_and_variance_of_few_values)
{
    hs_series series = {0};
    hs_estimate e = hs_series_estimate(&series);
    ck_assert(e.n == 0 && e.error == 0.0);
    for (int k = 1; k <= 5; ++k) hs_series_add(&series, (double)k * k, 1.0);
    e = hs_series_estimate(&series);
    ck_assert_int_eq(e.n, 5);
    ck_assert_double_eq_tol(e.mean, 11.0, 1e-14);
    ck_assert_double_eq_tol(e.variance, 93.5, 1e-12);
}
END_TEST

START_TEST(constant_series_has_no_error)
{
    hs_series series = {0};
    for (int k = 0; k < 1000; ++k) hs_series_add(&series, 2.5, 1.0);
    const hs_estimate e = hs_series_estimate(&series);
    ck_assert(e.mean == 2.5 && e.error == 0.0 && e.is_converged);
}
END_TEST

/** Sum of two such series, of variances 1 - part and part, that forget within fast and slow steps. */
static hs_estimate two_times(uint64_t seed, double part, double fast, double slow, int n)
{
    hs_series series = {0};
    uint64_t state = seed * UINT64_C(7919) + 1;
    const double phi[2] = {exp(-1.0 / fast), exp(-1.0 / slow)}, size[2] = {sqrt(1.0 - part), sqrt(part)};
    double x[2] = {normal(&state), normal(&state)};
    for (int k = 0; k < n; ++k) {
        hs_series_add(&series, size[0] * x[0] + size[1] * x[1], 1.0);
        for (int i = 0; i < 2; ++i) x[i] = phi[i] * x[i] + sqrt(1.0 - phi[i] * phi[i]) * normal(&state);
    }
    return hs_series_estimate(&series);
}

enum { SERIES = 2000 };

/** The true mean, 0, must lie within one error in 68.3 % of the series, give or take 1.0 % by chance (one standard
 *  deviation for
 *  2000) and 2 % for what the estimate assumes. */
static void check_fraction(const char *what, int n_within, double lowest, double highest)
{
    const double fraction = (double)n_within / SERIES;
    ck_assert_msg(fraction >= lowest && fraction <= highest, "%s: %d of %d within one error", what, n_within, SERIES);
}

static void check_coverage(double phi, int n)
{
    int n_within = 0;
    double inefficiency = 0.0;
    char what[64];
    for (int seed = 0; seed < SERIES; ++seed) {
        const hs_estimate e = autoregressive((uint64_t)seed, phi, n);
        n_within += fabs(e.mean) <= e.error;
        inefficiency += e.inefficiency / SERIES;
    }
    const double expected = (1.0 + phi) / (1.0 - phi);
    snprintf(what, sizeof what, "phi %g, %d values", phi, n);
    check_fraction(what, n_within, 0.643, 0.723);
    /* scatters by 0.3 from series to series where 100 are independent */
    if (n > 100.0 * expected)
        ck_assert_msg(fabs(inefficiency / expected - 1.0) < 0.05, "%s: inefficiency %g, expected %g", what,
                      inefficiency, expected);
}

START_TEST(errors_are_honest)
{
    check_coverage(0.0, 5);
    check_coverage(0.0, 12);
    check_coverage(0.0, 25);
    check_coverage(0.0, 4096);
    check_coverage(0.5, 75);
    check_coverage(0.5, 5000);
    check_coverage(0.9, 400);
    check_coverage(0.9, 900);
    check_coverage(0.9, 4000);
    check_coverage(0.97, 4000);
}
END_TEST

/* A slow mode with a tenth of the variance and most of the error: by blocks alone 45 % to 55 % would be within one
 * error. */
START_TEST(slow_modes_are_seen)
{
    int n_within[2] = {0};
    for (int seed = 0; seed < SERIES; ++seed) {
        hs_estimate e = two_times((uint64_t)seed, 0.1, 1.0, 20.0, 600); /* 1.9 + 4.0: 100 independent values */
        n_within[0] += fabs(e.mean) <= e.error;
        e = two_times((uint64_t)seed, 0.1, 1.0, 20.0, 4000);
        n_within[1] += fabs(e.mean) <= e.error;
    }
    check_fraction("600 values", n_within[0], 0.643, 0.723);
    check_fraction("4000 values", n_within[1], 0.643, 0.723);
}
END_TEST

/* Values that follow each other with opposite signs have a mean that is better known than independent ones'. */
START_TEST(inefficiency_below_one) { check_coverage(-0.5, 4000); }
END_TEST

START_TEST(short_series_say_so)
{
    ck_assert(!autoregressive(3, 0.999, 500).is_converged);
    ck_assert(autoregressive(3, 0.5, 5000).is_converged);
}
END_TEST

/** Means of groups that vary in size: sums over 0 to 8 correlated values each, with the number as the weight. The
 *  errors of the ratio of both sums must be honest too; series 1 of the set has no weights and is the plain mean. */
START_TEST(errors_of_ratios_are_honest)
{
    enum { N = 1000 };
    int n_within = 0, n_within_plain = 0;
    for (int seed = 0; seed < SERIES; ++seed) {
        hs_error err = {0};
        hs_series_set set = {.n_series = 2};
        uint64_t state = (uint64_t)seed * UINT64_C(104729) + 3;
        double x = normal(&state), size = normal(&state);
        for (int k = 0; k < N; ++k) {
            x = 0.8 * x + 0.6 * normal(&state);
            size = 0.9 * size + sqrt(1.0 - 0.81) * normal(&state);
            const double weight = fmin(fmax(rint(4.0 + 2.0 * size), 0.0), 8.0);
            const double values[] = {weight * (5.0 + x), x}, weights[] = {weight, 1.0};
            ck_assert_hs_ok(hs_series_set_add(&set, values, weights, &err), err);
        }
        const hs_estimate ratio = hs_series_set_estimate(&set, 0), plain = hs_series_set_estimate(&set, 1);
        n_within += fabs(ratio.mean - 5.0) <= ratio.error;
        n_within_plain += fabs(plain.mean) <= plain.error;
        hs_series_set_fini(&set);
    }
    check_fraction("ratio", n_within, 0.643, 0.723);
    check_fraction("mean", n_within_plain, 0.643, 0.723);
}
END_TEST

START_TEST(a_set_is_its_series)
{
    enum { N = 1000 };
    hs_error err = {0};
    hs_series_set set = {.n_series = 2};
    hs_series series[2] = {{0}};
    uint64_t state = 11;
    for (int k = 0; k < N; ++k) {
        const double values[] = {normal(&state), 100.0 + uniform(&state)};
        ck_assert_hs_ok(hs_series_set_add(&set, values, NULL, &err), err);
        for (int i = 0; i < 2; ++i) hs_series_add(&series[i], values[i], 1.0);
    }
    for (int i = 0; i < 2; ++i) {
        const hs_estimate a = hs_series_set_estimate(&set, i), b = hs_series_estimate(&series[i]);
        ck_assert(a.n == N && a.mean == b.mean && a.error == b.error && a.inefficiency == b.inefficiency);
    }
    hs_series_set_clear(&set);
    ck_assert(hs_series_set_estimate(&set, 0).n == 0);
    hs_series_set_fini(&set);
}
END_TEST

START_TEST(slope_of_a_line)
{
    hs_line line = {0};
    double slope, error;
    uint64_t state = 5;
    for (int k = 0; k < 400; ++k) hs_line_add(&line, 0.1 * k, 3.0 - 0.25 * 0.1 * k + 0.01 * normal(&state));
    hs_line_slope(&line, &slope, &error);
    /* 0.01 / sqrt(sum (x - mean)^2) = 4.3e-5 */
    ck_assert_double_eq_tol(error, 4.3e-5, 0.3e-5);
    ck_assert_double_eq_tol(slope, -0.25, 4.0 * error);
}
END_TEST

HS_TEST_MAIN("statistics", mean_and_variance_of_few_values, constant_series_has_no_error, errors_are_honest,
             slow_modes_are_seen, inefficiency_below_one, errors_of_ratios_are_honest, a_set_is_its_series,
             short_series_say_so, slope_of_a_line)
