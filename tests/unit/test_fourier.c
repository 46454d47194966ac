/* Transforms against the direct sums. */
#include <math.h>
#include <stdio.h>

#include "base/memory.h"
#include "core/fourier.h"
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
    hs_modes_spread(modes, N_POINTS, (const double *const[3]){x[0], x[1], x[2]}, mask, 1);
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

HS_TEST_MAIN("fourier", correlations_equal_the_direct_sum, density_modes_equal_the_direct_sum)
