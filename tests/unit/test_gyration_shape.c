/* Shapes of bodies that are known: compute gyration/shape. (LAMMPS's package with it is often not built in.) */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "style/compute.h"
#include "support/harness.h"
#include "support/run_deck.h"

static const char beginning[] = "units lj\nboundary f f f\nregion b block -9 9 -9 9 -9 9\ncreate_box 1 b\n%s\n"
                                "mass 1 1.0\npair_style none\ncompute g all gyration\n"
                                "compute s all gyration/shape g\nrun 0\n";

/** Moments and shape that a body must have. */
typedef struct shape {
    const char *atoms;
    double values[6];
} shape;

static const double *shape_of(hs_deck *deck)
{
    hs_error err = {0};
    hs_compute *compute = hs_sim_find_compute(deck->sim, "s");
    ck_assert_ptr_nonnull(compute);
    ck_assert_hs_ok(hs_compute_eval_vector(compute, &err), err);
    return compute->vector;
}

static void check_shape(hs_deck *deck, void *context)
{
    const shape *expected = context;
    const double *values = shape_of(deck);
    /* a few dozen roundings, of the turns of the axes, of numbers up to 9; places are rounded to 2^-46 or so */
    for (int k = 0; k < 6; ++k) ck_assert_double_eq_tol(values[k], expected->values[k], 1e-13);
}

static void run(const char *atoms, void (*at_end)(hs_deck *deck, void *context), void *context)
{
    hs_error err = {0};
    char text[2048];
    const hs_options options = {.n_threads = 2};
    snprintf(text, sizeof text, beginning, atoms);
    free(hs_test_run_deck_with(text, &options, at_end, context, &err));
    ck_assert_hs_ok(err.status, err);
}

#define ATOM(x, y, z) "create_atoms 1 single " #x " " #y " " #z "\n"

START_TEST(bodies_have_their_shapes)
{
    static shape bodies[] = {
        /* two atoms along a diagonal, 2 sqrt(3) apart: a line */
        {ATOM(1, 1, 1) ATOM(-1, -1, -1), {3.0, 0.0, 0.0, 3.0, 0.0, 1.0}},
        /* a square around z: a flat ring */
        {ATOM(2, 0, 0) ATOM(-2, 0, 0) ATOM(0, 2, 0) ATOM(0, -2, 0), {2.0, 2.0, 0.0, 1.0, 2.0, 0.25}},
        /* an octahedron */
        {ATOM(1, 0, 0) ATOM(-1, 0, 0) ATOM(0, 1, 0) ATOM(0, -1, 0) ATOM(0, 0, 1) ATOM(0, 0, -1),
         {1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0, 0.0, 0.0, 0.0}},
        /* crossed rods along (1,1,0), (1,-1,0) and z, of 1, 2 and 3 from the middle: l = 3, 4/3, 1/3 */
        {ATOM(0.7071067811865476, 0.7071067811865476, 0) ATOM(-0.7071067811865476, -0.7071067811865476, 0)
             ATOM(1.4142135623730951, -1.4142135623730951, 0) ATOM(-1.4142135623730951, 1.4142135623730951, 0)
                 ATOM(0, 0, 3) ATOM(0, 0, -3),
         {3.0, 4.0 / 3.0, 1.0 / 3.0, 3.0 - 5.0 / 6.0, 1.0, 1.5 * 98.0 / 196.0 - 0.5}},
        {ATOM(3, 2, 1), {0.0}},
    };
    for (size_t k = 0; k < sizeof bodies / sizeof bodies[0]; ++k) run(bodies[k].atoms, check_shape, &bodies[k]);
}
END_TEST

/** kappa^2 = (b^2 + (3/4) c^2)/R_g^4; sum and product of the eigenvalues are trace and determinant of the tensor. */
static void check_invariants(hs_deck *deck, void *context)
{
    const double *s = shape_of(deck), *t = hs_sim_find_compute(deck->sim, "g")->vector;
    const double trace = t[0] + t[1] + t[2];
    const double determinant =
        t[0] * (t[1] * t[2] - t[5] * t[5]) - t[3] * (t[3] * t[2] - t[5] * t[4]) + t[4] * (t[3] * t[5] - t[1] * t[4]);
    (void)context;
    /* tolerances: the roundings of the eigenvalues, relative to the largest */
    ck_assert(s[0] > s[1] && s[1] > s[2] && s[2] > 0.0);
    ck_assert_double_eq_tol(s[0] + s[1] + s[2], trace, 1e-14 * trace);
    ck_assert_double_eq_tol(s[0] * s[1] * s[2], determinant, 1e-13 * trace * trace * trace);
    ck_assert_double_eq_tol(s[5], (s[3] * s[3] + 0.75 * s[4] * s[4]) / (trace * trace), 1e-13);
}

START_TEST(any_cloud_keeps_the_invariants)
{
    run("region c block -8 3 -2 7 -1 2\ncreate_atoms 1 random 300 4711 c", check_invariants, NULL);
}
END_TEST

HS_TEST_MAIN("gyration/shape", bodies_have_their_shapes, any_cloud_keeps_the_invariants)
