/* Exact sums against known values, against long double where that is exact, and in any order. */
#include <float.h>
#include <math.h>

#include "core/exact_sum.h"
#include "support/harness.h"

static double sum_of(const double *x, int n)
{
    hs_exact_sum sum = {0};
    for (int k = 0; k < n; ++k) hs_exact_add_now(&sum, x[k]);
    return hs_exact_value(&sum);
}

START_TEST(cancellation_leaves_the_small_term)
{
    const double big_small_big[] = {1e300, 1.0, -1e300}, tiny[] = {DBL_MAX, 5e-324, -DBL_MAX};
    ck_assert_double_eq(sum_of(big_small_big, 3), 1.0);
    ck_assert_double_eq(sum_of(tiny, 3), 5e-324);
    ck_assert_double_eq(sum_of(NULL, 0), 0.0);
    const double one[] = {-0.1};
    ck_assert_double_eq(sum_of(one, 1), -0.1);
}
END_TEST

START_TEST(result_is_rounded_once_to_even)
{
    const double ulp = DBL_EPSILON;
    const double tie_down[] = {1.0, ulp / 2}, tie_up[] = {1.0 + ulp, ulp / 2}, above[] = {1.0, ulp / 2, 1e-300};
    ck_assert_double_eq(sum_of(tie_down, 2), 1.0);
    ck_assert_double_eq(sum_of(tie_up, 2), 1.0 + 2 * ulp);
    ck_assert_double_eq(sum_of(above, 3), 1.0 + ulp);
    const double negative[] = {-1.0, -ulp / 2, -1e-300};
    ck_assert_double_eq(sum_of(negative, 3), -1.0 - ulp);
}
END_TEST

START_TEST(sums_overflow_only_at_the_end)
{
    const double finite[] = {DBL_MAX, DBL_MAX, -DBL_MAX}, infinite[] = {DBL_MAX, DBL_MAX};
    ck_assert_double_eq(sum_of(finite, 3), DBL_MAX);
    ck_assert(isinf(sum_of(infinite, 2)));
}
END_TEST

START_TEST(terms_that_are_not_finite_show)
{
    const double infinite[] = {1.0, INFINITY}, both[] = {INFINITY, -INFINITY}, nan_[] = {1.0, NAN, 2.0};
    ck_assert(isinf(sum_of(infinite, 2)));
    ck_assert(isnan(sum_of(both, 2)));
    ck_assert(isnan(sum_of(nan_, 3)));
}
END_TEST

/** A number of either sign with an exponent from -range to range. */
static double some_number(uint64_t *state, int range)
{
    *state = *state * UINT64_C(6364136223846793005) + 1442695040888963407u;
    const double mantissa = (double)(int64_t)(*state >> 11) - 0x1p52;
    return ldexp(mantissa, (int)(*state >> 20 & 0xffff) % (2 * range + 1) - range - 52);
}

START_TEST(order_and_grouping_do_not_matter)
{
    enum { N = 2000 };
    double x[N];
    uint64_t state = 42;
    for (int k = 0; k < N; ++k) x[k] = some_number(&state, 300);
    const double forward = sum_of(x, N);
    hs_exact_sum parts[7] = {{.n_added = 0}}, all = {0};
    for (int k = N - 1; k >= 0; --k) hs_exact_add(&parts[k % 7], x[k]);
    for (int p = 0; p < 7; ++p) hs_exact_merge(&all, &parts[p]);
    ck_assert_double_eq(hs_exact_value(&all), forward);
}
END_TEST

START_TEST(equals_long_double_where_that_is_exact)
{
    uint64_t state = 7;
    for (int trial = 0; trial < 1000; ++trial) {
        hs_exact_sum sum = {0};
        long double expected = 0.0L; /* 64 bits: exact for few terms of 53 bits within 2^5 of each other */
        for (int k = 0; k < 16; ++k) {
            const double x = some_number(&state, 3);
            hs_exact_add(&sum, x);
            expected += (long double)x;
        }
        if (LDBL_MANT_DIG >= 64) ck_assert_double_eq(hs_exact_value(&sum), (double)expected);
    }
}
END_TEST

START_TEST(scaled_integers_are_exact)
{
    hs_exact_sum sum = {0};
    const __int128 big = ((__int128)1 << 100) + 12345;
    hs_exact_add_scaled(&sum, big, -40);
    hs_exact_add_scaled(&sum, -((__int128)1 << 100), -40);
    ck_assert_double_eq(hs_exact_value(&sum), ldexp(12345.0, -40));
    hs_exact_add_scaled(&sum, -12346, -40);
    ck_assert_double_eq(hs_exact_value(&sum), -ldexp(1.0, -40));
    hs_exact_add_scaled(&sum, 3, -1074);
    hs_exact_add(&sum, ldexp(1.0, -40));
    ck_assert_double_eq(hs_exact_value(&sum), 3 * 5e-324);
}
END_TEST

START_TEST(arrays_add_as_their_terms)
{
    static const int ranges[] = {0, 3, 40, 900};
    double x[HS_EXACT_ARRAY_MAX + 5];
    uint64_t state = 99;
    for (size_t r = 0; r < sizeof ranges / sizeof ranges[0]; ++r)
        for (int n = 0; n <= HS_EXACT_ARRAY_MAX + 5; n += n < 20 ? 1 : 167) {
            hs_exact_sum sum = {0}, one_by_one = {0};
            for (int k = 0; k < n; ++k) x[k] = k % 7 == 3 ? 0.0 : some_number(&state, ranges[r]);
            hs_exact_add_array(&sum, x, n);
            ck_assert_double_eq(hs_exact_value(&sum), sum_of(x, n));
            for (int k = 0; k < n; ++k) hs_exact_add(&one_by_one, x[k]);
            ck_assert_double_eq(hs_exact_value(&one_by_one), sum_of(x, n)); /* some of them wait still */
            hs_exact_carry(&one_by_one);
            ck_assert_double_eq(hs_exact_value(&one_by_one), sum_of(x, n));
        }
    /* all as large as possible, which must not be rounded; and what is not finite */
    hs_exact_sum sum = {0}, none = {0}, endless = {0};
    for (int k = 0; k < HS_EXACT_ARRAY_MAX; ++k) x[k] = 1.0 + DBL_EPSILON * (k % 2);
    hs_exact_add_array(&sum, x, HS_EXACT_ARRAY_MAX);
    ck_assert_double_eq(hs_exact_value(&sum), HS_EXACT_ARRAY_MAX * (1.0 + DBL_EPSILON / 2));
    x[700] = NAN;
    hs_exact_add_array(&none, x, HS_EXACT_ARRAY_MAX);
    ck_assert(isnan(hs_exact_value(&none)));
    x[700] = INFINITY;
    hs_exact_add_array(&endless, x, HS_EXACT_ARRAY_MAX);
    ck_assert(isinf(hs_exact_value(&endless)));
}
END_TEST

/** Arrays of unlike size after each other: each is cut where the one before was, if that will do. */
START_TEST(arrays_follow_each_other)
{
    static const int exponents[] = {0, 3, -2, 45, 44, -60, 700, -700, 90, 51, 0, -1022, 12, 1020, -3};
    enum { N_ARRAYS = sizeof exponents / sizeof exponents[0], N = 300 };
    double x[N];
    uint64_t state = 5;
    hs_exact_sum sum = {0}, one_by_one = {0};
    for (int a = 0; a < N_ARRAYS; ++a) {
        for (int k = 0; k < N; ++k)
            x[k] = k % 11 == 5 ? -0.0 : ldexp(some_number(&state, 2), exponents[a] > 1000 ? 1000 : exponents[a]);
        hs_exact_add_array(&sum, x, N);
        for (int k = 0; k < N; ++k) hs_exact_add_now(&one_by_one, x[k]);
        ck_assert_double_eq(hs_exact_value(&sum), hs_exact_value(&one_by_one));
        for (int k = 0; k < N; ++k) x[k] = -x[k]; /* so that the next array's digits are seen */
        hs_exact_add_array(&sum, x, N);
        for (int k = 0; k < N; ++k) hs_exact_add_now(&one_by_one, x[k]);
        ck_assert_double_eq(hs_exact_value(&sum), hs_exact_value(&one_by_one));
    }
    ck_assert_double_eq(hs_exact_value(&sum), 0.0);
    x[7] = -INFINITY;
    hs_exact_add_array(&sum, x, N);
    ck_assert(hs_exact_value(&sum) == -INFINITY);
    x[8] = NAN;
    hs_exact_add_array(&sum, x, N);
    ck_assert(isnan(hs_exact_value(&sum)));
}
END_TEST

HS_TEST_MAIN("exact sums", cancellation_leaves_the_small_term, result_is_rounded_once_to_even,
             sums_overflow_only_at_the_end, terms_that_are_not_finite_show, order_and_grouping_do_not_matter,
             equals_long_double_where_that_is_exact, scaled_integers_are_exact, arrays_add_as_their_terms,
             arrays_follow_each_other)
