/* Cubic splines: they are the curve itself where that is a cubic, and converge to any other smooth one. */
#include <math.h>

#include "core/cubic_spline.h"
#include "support/harness.h"

static double cubic(double x) { return 1.0 - 2.0 * x + 0.5 * x * x - 0.25 * x * x * x; }
static double slope(double x) { return -2.0 + x - 0.75 * x * x; }

/** A cubic has one solution, so only rounding is left: a few units in the last place of values up to 10. */
START_TEST(reproduces_cubics)
{
    const double x[] = {-1.0, -0.7, 0.1, 0.2, 1.5, 2.0, 3.1};
    for (int n = 2; n <= 7; ++n) {
        hs_spline spline = {.n = 0};
        hs_error err = {0};
        double y[7];
        for (int k = 0; k < n; ++k) y[k] = cubic(x[k]);
        ck_assert_int_eq(hs_spline_fit(&spline, n, x, y, slope(x[0]), slope(x[n - 1]), &err), HS_OK);
        for (int k = 0; k <= 100; ++k) {
            const double at = x[0] - 0.1 + (x[n - 1] - x[0] + 0.2) * k / 100.0;
            ck_assert_double_eq_tol(hs_spline_at(&spline, at), cubic(at), 1e-13);
        }
        hs_spline_fini(&spline);
    }
}
END_TEST

/** The error of a spline with right slopes at its ends is at most (5/384) h^4 max|y''''| (Hall 1968). */
START_TEST(converges)
{
    for (int n = 5; n <= 81; n = 2 * n - 1) {
        hs_spline spline = {.n = 0};
        hs_error err = {0};
        double x[81], y[81], worst = 0.0;
        const double h = 3.0 / (n - 1);
        for (int k = 0; k < n; ++k) y[k] = sin(x[k] = k * h);
        ck_assert_int_eq(hs_spline_fit(&spline, n, x, y, 1.0, cos(3.0), &err), HS_OK);
        for (int k = 0; k <= 1000; ++k) worst = fmax(worst, fabs(hs_spline_at(&spline, 0.003 * k) - sin(0.003 * k)));
        ck_assert_double_le(worst, 5.0 / 384.0 * h * h * h * h);
        hs_spline_fini(&spline);
    }
}
END_TEST

HS_TEST_MAIN("cubic splines", reproduces_cubics, converges)
