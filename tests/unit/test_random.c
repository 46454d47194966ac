/* Random numbers that LAMMPS's commands draw. */
#include <math.h>

#include "core/random.h"
#include "support/harness.h"

START_TEST(test_minimal_standard)
{
    /* Park and Miller (1988): from seed 1 the 10000th state is 1043618065 */
    hs_park park;
    hs_park_init(&park, 1);
    for (int k = 0; k < 10000; ++k) (void)hs_park_uniform(&park);
    ck_assert_int_eq(park.seed, 1043618065);
}
END_TEST

START_TEST(test_uniform_is_product)
{
    hs_park park;
    hs_park_init(&park, 1);
    ck_assert(hs_park_uniform(&park) == 16807 * (1.0 / 2147483647.0));
    hs_park_init(&park, 2147483646);
    ck_assert(hs_park_uniform(&park) == (2147483647 - 16807) * (1.0 / 2147483647.0));
}
END_TEST

START_TEST(test_gaussian_moments)
{
    enum { N = 200000 };
    hs_park park;
    hs_park_init(&park, 4711);
    double sum[5] = {0.0};
    for (int k = 0; k < N; ++k) {
        const double g = hs_park_gaussian(&park);
        for (int p = 1; p < 5; ++p) sum[p] += pow(g, p);
    }
    /* standard errors sqrt(var/N): of g 1, g^2 sqrt 2, g^3 sqrt 15, g^4 sqrt 96, each / sqrt N; five of them */
    ck_assert(fabs(sum[1] / N) < 5.0 / sqrt(N));
    ck_assert(fabs(sum[2] / N - 1.0) < 5.0 * sqrt(2.0 / N));
    ck_assert(fabs(sum[3] / N) < 5.0 * sqrt(15.0 / N));
    ck_assert(fabs(sum[4] / N - 3.0) < 5.0 * sqrt(96.0 / N));
}
END_TEST

START_TEST(test_gaussian_pairs)
{
    /* the polar method gives two numbers for one accepted point, the second component's first */
    hs_park park, copy;
    hs_park_init(&park, 99);
    copy = park;
    double v1, v2, r2;
    do {
        v1 = 2.0 * hs_park_uniform(&copy) - 1.0;
        v2 = 2.0 * hs_park_uniform(&copy) - 1.0;
        r2 = v1 * v1 + v2 * v2;
    } while (r2 >= 1.0 || r2 == 0.0);
    const double scale = sqrt(-2.0 * log(r2) / r2);
    ck_assert(hs_park_gaussian(&park) == v2 * scale);
    ck_assert(hs_park_gaussian(&park) == v1 * scale);
    ck_assert_int_eq(park.seed, copy.seed);
}
END_TEST

START_TEST(test_place_decides)
{
    const double x[3] = {1.25, -3.5, 0.1}, other[3] = {1.25, -3.5, nextafter(0.1, 1.0)};
    hs_park a, b;
    hs_park_reset_at(&a, 87287, x);
    hs_park_init(&b, 5);
    (void)hs_park_gaussian(&b);
    hs_park_reset_at(&b, 87287, x);
    ck_assert_int_eq(a.seed, b.seed);
    ck_assert(!b.have_second);
    hs_park_reset_at(&b, 87287, other);
    ck_assert_int_ne(a.seed, b.seed);
    hs_park_reset_at(&b, 87288, x);
    ck_assert_int_ne(a.seed, b.seed);
    ck_assert_int_gt(a.seed, 0);
}
END_TEST

START_TEST(test_place_against_lammps)
{
    /* lmp: one type of mass 1, `velocity all create 1 87287 loop geom mom no`,
        atoms at 0 0 0 and 0.5 0.5 0: the velocities
       are the numbers drawn times one factor, so their ratios are those of the numbers. Values of lmp, %.17g. */
    static const double x[2][3] = {{0.0, 0.0, 0.0}, {0.5, 0.5, 0.0}};
    static const double v[2][3] = {{-0.099989125319485436, -0.4432793353623341, -1.3242315847715747},
                                   {0.47219533653042761, 0.69210232088055301, -0.58132801166175008}};
    double drawn[2][3];
    for (int k = 0; k < 2; ++k) {
        hs_park park;
        hs_park_reset_at(&park, 87287, x[k]);
        for (int axis = 0; axis < 3; ++axis) drawn[k][axis] = hs_park_uniform(&park) - 0.5;
    }
    for (int k = 0; k < 2; ++k)
        for (int axis = 0; axis < 3; ++axis)
            ck_assert_double_eq_tol(v[k][axis] / v[0][0], drawn[k][axis] / drawn[0][0],
                                    1.0e-14 * fabs(v[k][axis] / v[0][0]));
}
END_TEST

HS_TEST_MAIN("unit.random", test_minimal_standard, test_uniform_is_product, test_gaussian_moments, test_gaussian_pairs,
             test_place_decides, test_place_against_lammps)
