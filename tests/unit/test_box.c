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

/** A box whose edges are multiples of 1/16, so that all sums of edges are exact. */
static hs_box tilted_box(void)
{
    hs_box box = periodic_box(-2.0, 3.0);
    box.hi[1] = 2.5;
    box.hi[2] = 4.125;
    box.is_tilted = true;
    box.tilt[0] = 1.75, box.tilt[1] = -2.0625, box.tilt[2] = 0.5;
    return box;
}

START_TEST(test_fractions_of_a_tilted_box)
{
    const hs_box box = tilted_box();
    const double inside[3] = {0.25, 0.5, 0.875};
    double x[3], fraction[3];
    hs_box_place(&box, inside, x);
    hs_box_fractions(&box, x, fraction);
    for (int axis = 0; axis < 3; ++axis) ck_assert_double_eq_tol(fraction[axis], inside[axis], 1e-15);
    for (int32_t n0 = -2; n0 <= 2; ++n0)
        for (int32_t n1 = -2; n1 <= 2; ++n1)
            for (int32_t n2 = -2; n2 <= 2; ++n2) {
                const int32_t n[3] = {n0, n1, n2};
                double shift[3], shifted[3], place[3];
                for (int axis = 0; axis < 3; ++axis) shifted[axis] = inside[axis] + n[axis];
                hs_box_shift(&box, n, shift);
                hs_box_place(&box, shifted, place);
                for (int axis = 0; axis < 3; ++axis) ck_assert_double_eq(place[axis], x[axis] + shift[axis]);
            }
}
END_TEST

START_TEST(test_thickness_is_the_distance_of_faces)
{
    const hs_box box = tilted_box();
    const int32_t edge[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    double e[3][3];
    for (int axis = 0; axis < 3; ++axis) hs_box_shift(&box, edge[axis], e[axis]);
    for (int axis = 0; axis < 3; ++axis) {
        const double *a = e[(axis + 1) % 3], *b = e[(axis + 2) % 3];
        const double normal[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
        const double area = sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
        const double along = e[axis][0] * normal[0] + e[axis][1] * normal[1] + e[axis][2] * normal[2];
        ck_assert_double_eq_tol(hs_box_thickness(&box, axis), along / area, 1e-14);
    }
    const hs_box straight = periodic_box(-2.0, 3.0);
    for (int axis = 0; axis < 3; ++axis) ck_assert_double_eq(hs_box_thickness(&straight, axis), 5.0);
}
END_TEST

START_TEST(test_bounds_hold_all_corners)
{
    const hs_box box = tilted_box();
    double lo[3], hi[3], least[3] = {INFINITY, INFINITY, INFINITY}, most[3] = {-INFINITY, -INFINITY, -INFINITY};
    hs_box_bounds(&box, lo, hi);
    for (int corner = 0; corner < 8; ++corner) {
        const double fraction[3] = {corner & 1, corner >> 1 & 1, corner >> 2};
        double x[3];
        hs_box_place(&box, fraction, x);
        for (int axis = 0; axis < 3; ++axis) {
            least[axis] = fmin(least[axis], x[axis]);
            most[axis] = fmax(most[axis], x[axis]);
        }
    }
    for (int axis = 0; axis < 3; ++axis) {
        ck_assert_double_eq(lo[axis], least[axis]);
        ck_assert_double_eq(hi[axis], most[axis]);
    }
}
END_TEST

HS_TEST_MAIN("box", test_wrap_keeps_the_place, test_closed_axes_stay, test_fractions_of_a_tilted_box,
             test_thickness_is_the_distance_of_faces, test_bounds_hold_all_corners)
