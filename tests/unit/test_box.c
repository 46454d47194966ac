/* Wrapping into the periodic box: the place that an atom and its image flags stand for never changes. */
#include <math.h>
#include <string.h>

#include "core/box.h"
#include "support/harness.h"

static hs_box periodic_box(double lo, double hi)
{
    hs_box box;
    memset(&box, 0, sizeof box);
    box.dimension = 3;
    for (int axis = 0; axis < 3; ++axis) box.lo[axis] = lo, box.hi[axis] = hi, box.periodic[axis] = true;
    return box;
}

static void check_wrap(double lo, double hi, double x)
{
    const hs_box box = periodic_box(lo, hi);
    const double length = hi - lo;
    double place[3] = {x, 0.5 * (lo + hi), x};
    int32_t image[3] = {0, 7, 0};
    hs_box_wrap(&box, place, image);
    ck_assert_double_ge(place[0], lo);
    ck_assert_double_lt(place[0], hi);
    /* two roundings at the size of the box */
    ck_assert_double_le(fabs(place[0] + image[0] * length - x), 2e-16 * (fabs(lo) + fabs(hi) + length));
    ck_assert_double_eq(place[0], place[2]);
    ck_assert_int_eq(image[0], image[2]);
    ck_assert_double_eq(place[1], 0.5 * (lo + hi));
    ck_assert_int_eq(image[1], 7);
}

START_TEST(test_wrap_keeps_the_place)
{
    const double boxes[][2] = {{0, 10}, {-5, 5}, {0.1, 1.7}, {1e-17, 1}, {-1.0 / 3, 7.0 / 9}, {-1e6, 1e6 + 0.1}};
    for (size_t k = 0; k < sizeof boxes / sizeof boxes[0]; ++k) {
        const double lo = boxes[k][0], hi = boxes[k][1], length = hi - lo;
        const double places[] = {lo,
                                 hi,
                                 lo - 1e-18,
                                 nextafter(lo, -INFINITY),
                                 nextafter(lo, INFINITY),
                                 nextafter(hi, -INFINITY),
                                 nextafter(hi, INFINITY),
                                 lo - 0.3 * length,
                                 hi + 0.3 * length,
                                 0.5 * lo + 0.5 * hi};
        for (size_t i = 0; i < sizeof places / sizeof places[0]; ++i) check_wrap(lo, hi, places[i]);
    }
}
END_TEST

START_TEST(test_closed_axes_stay)
{
    hs_box box = periodic_box(0.0, 1.0);
    box.periodic[1] = false;
    double x[3] = {1.5, 1.5, -0.5};
    int32_t image[3] = {0, 0, 0};
    hs_box_wrap(&box, x, image);
    ck_assert_double_eq(x[0], 0.5);
    ck_assert_double_eq(x[1], 1.5);
    ck_assert_double_eq(x[2], 0.5);
    ck_assert_int_eq(image[0], 1);
    ck_assert_int_eq(image[1], 0);
    ck_assert_int_eq(image[2], -1);
}
END_TEST

HS_TEST_MAIN("box", test_wrap_keeps_the_place, test_closed_axes_stay)
