/* fix drag goes to the nearest image of the place, also in tilted boxes, and leaves directions that are NULL alone. */
#include <math.h>
#include <stdlib.h>

#include "support/harness.h"
#include "support/run_deck.h"

static const char beginning[] = "units lj\nregion b prism 0 10 0 8 0 6 2 0 0\ncreate_box 1 b\n"
                                "create_atoms 1 single 9.5 1 1\nmass 1 1.0\npair_style none\n";

static void check_force(hs_deck *deck, void *context)
{
    const double *expected = context;
    /* a few roundings of numbers up to 10 */
    for (int axis = 0; axis < 3; ++axis) ck_assert_double_eq_tol(deck->sim->atoms.f[axis][0], expected[axis], 1e-14);
}

static void check(const char *words, double fx, double fy, double fz)
{
    hs_error err = {0};
    char text[512];
    const hs_options options = {.n_threads = 1};
    double force[3] = {fx, fy, fz};
    snprintf(text, sizeof text, "%sfix d all drag %s\nrun 0\n", beginning, words);
    free(hs_test_run_deck_with(text, &options, check_force, force, &err));
    ck_assert_hs_ok(err.status, err);
}

START_TEST(nearest_image_is_the_aim)
{
    check("0.5 1 1 3.0 0.0", 3.0, 0.0, 0.0);                            /* one edge on */
    check("0.5 1 1 3.0 1.0", 0.0, 0.0, 0.0);                            /* as far as that: no force */
    check("10.5 8 1 1.0 0.0", -1.0 / sqrt(2.0), -1.0 / sqrt(2.0), 0.0); /* at (8.5, 0) below, by the tilted edge */
    check("6.5 5 1 10.0 0.0", -6.0, 8.0, 0.0);
    check("6.5 NULL NULL 10.0 2.9", -10.0, 0.0, 0.0);
    check("NULL NULL 4 -2.0 0.5", 0.0, 0.0, -2.0);
}
END_TEST

HS_TEST_MAIN("fix drag", nearest_image_is_the_aim)
