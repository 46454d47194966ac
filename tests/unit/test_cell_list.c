/* The public cell lists against all pairs of particles and images, one by one. */
#include <halfshell/cells.h>
#include <math.h>
#include <stdio.h>

#include "support/harness.h"

enum { N = 160 };

typedef struct particle {
    char kind;
    float xf[3];
    double x[3];
} particle;

static double next_uniform(uint64_t *state)
{
    *state = *state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (double)(*state >> 11) * 0x1p-53;
}

#define ck_assert_list(call, list) ck_assert_msg((call) == HS_CODE_OK, "%s", hs_cell_list_error(list))

/** Particles in and around the box; half of them in one corner, so that most cells are empty. */
static void place(particle *p, const hs_cell_list_box *box, uint64_t seed)
{
    for (int i = 0; i < N; ++i)
        for (int axis = 0; axis < 3; ++axis) {
            const double width = (i % 2 ? 1.2 : 0.2) * (box->hi[axis] - box->lo[axis]);
            p[i].xf[axis] = (float)(box->lo[axis] + width * next_uniform(&seed) - (i % 2 ? 0.1 * width : 0.0));
            p[i].x[axis] = p[i].xf[axis];
        }
}

/** Number and sums of pairs: equal for equal sets of pairs, and hardly for others. Either particle may come first. */
typedef struct sums {
    int n;
    double r2, weighted;
} sums;

static void add(sums *s, int64_t i, int64_t j, double r2)
{
    const double lower = (double)(i < j ? i : j), upper = (double)(i < j ? j : i);
    ++s->n;
    s->r2 += r2;
    s->weighted += r2 * (1.0 + 0.013 * lower + 0.00041 * upper * upper);
}

static int add_visited(void *context, const hs_cell_pair *pair)
{
    add(context, pair->i, pair->j, pair->r2);
    return 0;
}

/** Pairs by brute force: i < j with all images, and i == j with half of them. point: only pairs of the point. */
static sums by_hand(const particle *p, const hs_cell_list_box *box, double reach, const double *point)
{
    sums s = {0};
    int m[3];
    double length[3];
    for (int axis = 0; axis < 3; ++axis) {
        length[axis] = box->hi[axis] - box->lo[axis];
        m[axis] = axis < box->dimension && box->periodic[axis] ? (int)ceil(reach / length[axis]) + 2 : 0;
    }
    for (int i = point != NULL ? -1 : 0; i < (point != NULL ? 0 : N); ++i)
        for (int j = point != NULL ? 0 : i; j < N; ++j)
            for (int a = -m[0]; a <= m[0]; ++a)
                for (int b = -m[1]; b <= m[1]; ++b)
                    for (int c = -m[2]; c <= m[2]; ++c) {
                        const int k[3] = {a, b, c};
                        if (i == j && !(a > 0 || (a == 0 && (b > 0 || (b == 0 && c > 0))))) continue;
                        double r2 = 0.0;
                        for (int axis = 0; axis < box->dimension; ++axis) {
                            const double d = p[j].x[axis] - (i < 0 ? point : p[i].x)[axis] + k[axis] * length[axis];
                            r2 += d * d;
                        }
                        if (r2 < reach * reach) add(&s, i, j, r2);
                    }
    return s;
}

static void assert_same(sums a, sums b, const char *what)
{
    ck_assert_msg(a.n == b.n, "%s: %d pairs, not %d", what, b.n, a.n);
    ck_assert_msg(fabs(a.r2 - b.r2) <= 1e-10 * (1.0 + a.r2), "%s: sum of r^2 %.15g, not %.15g", what, b.r2, a.r2);
    ck_assert_msg(fabs(a.weighted - b.weighted) <= 1e-10 * (1.0 + a.weighted), "%s: other pairs", what);
}

static sums by_parts(const hs_cell_list *list, int n_parts)
{
    sums s = {0};
    hs_cell_pair pair;
    for (int part = 0; part < n_parts; ++part)
        for (hs_cell_iterator at = hs_cell_list_pairs_of_part(list, part, n_parts);
             hs_cell_iterator_next(&at, &pair);) {
            double r2 = 0.0;
            for (int axis = 0; axis < 3; ++axis) r2 += pair.d[axis] * pair.d[axis];
            ck_assert(fabs(r2 - pair.r2) < 1e-12);
            add(&s, pair.i, pair.j, pair.r2);
        }
    return s;
}

static void check_list(const hs_cell_list *list, const particle *p, const hs_cell_list_box *box, double reach,
                       const char *what)
{
    const sums right = by_hand(p, box, reach, NULL);
    sums visited = {0};
    ck_assert_int_eq(hs_cell_list_each_pair(list, add_visited, &visited), 0);
    assert_same(right, visited, what);
    assert_same(right, by_parts(list, 1), what);
    assert_same(right, by_parts(list, 7), what);
    uint64_t state = 8;
    for (int trial = 0; trial < 8; ++trial) {
        const double radius = reach * (0.3 + 0.3 * trial);
        double point[3];
        for (int axis = 0; axis < 3; ++axis)
            point[axis] = box->lo[axis] + (1.4 * next_uniform(&state) - 0.2) * (box->hi[axis] - box->lo[axis]);
        visited = (sums){0};
        ck_assert_int_eq(hs_cell_list_query(list, point, radius, add_visited, &visited), 0);
        /* points outside of a periodic box need more images than by_hand makes: its margin of two suffices */
        assert_same(by_hand(p, box, radius, point), visited, what);
    }
}

START_TEST(pairs_and_queries)
{
    static particle p[N];
    static const double cells[] = {0.0, 0.3, 1.9};
    const int dimension = 2 + _i % 2, boundary = _i / 2 % 4;
    const double size =
        (double[]){3.0, 8.0, 300.0}[_i / 8]; /* less than twice the reach; some cells; many empty ones */
    const hs_cell_list_box box = {.dimension = dimension,
                                  .lo = {-1.0, 2.0, -0.5 * size},
                                  .hi = {size - 1.0, 1.3 * size + 2.0, 0.5 * size},
                                  .periodic = {boundary & 1, boundary >> 1, boundary & 1}};
    const double reach = 1.7;
    place(p, &box, 31 + (uint64_t)_i);
    for (int k = 0; k < 3; ++k) {
        hs_cell_list_options options = HS_CELL_LIST_OPTIONS_INIT;
        hs_cell_list *list;
        char what[96];
        options.cell = cells[k];
        options.n_threads = 1 + k;
        snprintf(what, sizeof what, "%dD, periodic %d %d, size %g, cell %g", dimension, box.periodic[0],
                 box.periodic[1], size, cells[k]);
        ck_assert_list(hs_cell_list_create(&list, &box, reach, &options), list);
        ck_assert_list(hs_cell_list_build(list, N, &p[0].x[0], &p[0].x[1], &p[0].x[2], sizeof *p), list);
        ck_assert_int_eq(hs_cell_list_n(list), N);
        check_list(list, p, &box, reach, what);
        /* the float coordinates are the same numbers; a second build replaces the first */
        ck_assert_list(hs_cell_list_build_float(list, N, &p[0].xf[0], &p[0].xf[1], &p[0].xf[2], sizeof *p), list);
        check_list(list, p, &box, reach, what);
        hs_cell_list_destroy(&list);
        ck_assert_ptr_null(list);
    }
}
END_TEST

/** Arrays of their own, no z in 2D, few particles and none, a walk that is ended, one that is asked again. */
static int stop_at_third(void *context, const hs_cell_pair *pair)
{
    (void)pair;
    return ++*(int *)context == 3 ? 42 : 0;
}

START_TEST(edges_of_use)
{
    const double x[4] = {0.1, 0.2, 0.3, 9.9}, y[4] = {0.0, 0.0, 0.0, 0.0};
    const hs_cell_list_box box = {.dimension = 2, .hi = {10.0, 10.0, 0.0}, .periodic = {1, 0, 0}};
    hs_cell_list *list;
    hs_cell_pair pair;
    int n = 0;
    ck_assert_list(hs_cell_list_create(&list, &box, 1.0, NULL), list);
    hs_cell_iterator at = hs_cell_list_pairs(list); /* before any build */
    ck_assert_int_eq(hs_cell_iterator_next(&at, &pair), 0);
    ck_assert_list(hs_cell_list_build(list, 4, x, y, NULL, sizeof(double)), list);
    for (at = hs_cell_list_pairs(list); hs_cell_iterator_next(&at, &pair);) ++n;
    ck_assert_int_eq(n, 6); /* the last is across the face */
    ck_assert_int_eq(hs_cell_iterator_next(&at, &pair), 0);
    n = 0;
    ck_assert_int_eq(hs_cell_list_each_pair(list, stop_at_third, &n), 42);
    ck_assert_int_eq(n, 3);
    at = hs_cell_list_around(list, (const double[3]){10.0, 0.0, 5.0}, 0.15);
    ck_assert_int_eq(hs_cell_iterator_next(&at, &pair), 1); /* at 0.1 and 9.9: both 0.1 away, in 2D whatever z is */
    ck_assert_int_eq(hs_cell_iterator_next(&at, &pair), 1);
    ck_assert_double_eq_tol(fabs(pair.d[0]), 0.1, 1e-12);
    ck_assert_int_eq(pair.i, -1);
    ck_assert_int_eq(hs_cell_iterator_next(&at, &pair), 0);
    ck_assert_int_eq(hs_cell_iterator_next(&at, &pair), 0);
    for (int k = 0; k < 2; ++k) {
        at = hs_cell_list_around(list, (const double[3]){NAN, 0.0, 0.0}, k == 0 ? 1.0 : NAN);
        ck_assert_int_eq(hs_cell_iterator_next(&at, &pair), 0);
    }
    at = hs_cell_list_pairs_of_part(list, 3, 3);
    ck_assert_int_eq(hs_cell_iterator_next(&at, &pair), 0);
    ck_assert_list(hs_cell_list_build(list, 0, NULL, NULL, NULL, 0), list);
    at = hs_cell_list_pairs(list);
    ck_assert_int_eq(hs_cell_iterator_next(&at, &pair), 0);
    const hs_cell_list_box wide = {.dimension = 2, .hi = {20.0, 10.0, 0.0}, .periodic = {1, 0, 0}};
    ck_assert_list(hs_cell_list_build(list, 4, x, y, NULL, sizeof(double)), list);
    ck_assert_list(hs_cell_list_set_box(list, &wide), list);
    ck_assert_int_eq(hs_cell_list_n(list), 0);
    ck_assert_list(hs_cell_list_build(list, 4, x, y, NULL, sizeof(double)), list);
    n = 0;
    for (at = hs_cell_list_pairs(list); hs_cell_iterator_next(&at, &pair);) ++n;
    ck_assert_int_eq(n, 3);
    hs_cell_list_destroy(&list);
    hs_cell_list_destroy(&list);
}
END_TEST

static void assert_refused(const hs_cell_list_box *box, double reach, const hs_cell_list_options *options,
                           const char *message)
{
    hs_cell_list *list;
    ck_assert_int_eq(hs_cell_list_create(&list, box, reach, options), HS_CODE_INPUT);
    ck_assert_str_eq(hs_cell_list_error(list), message);
    hs_cell_list_destroy(&list);
}

START_TEST(bad_input)
{
    const hs_cell_list_box good = {.dimension = 3, .hi = {5.0, 5.0, 5.0}}, line = {.dimension = 1, .hi = {5.0}},
                           flat = {.dimension = 3, .hi = {5.0, 5.0, 0.0}};
    hs_cell_list_options fine = HS_CELL_LIST_OPTIONS_INIT, negative = HS_CELL_LIST_OPTIONS_INIT;
    fine.cell = 0.001;
    negative.n_threads = -1;
    assert_refused(&good, 0.0, NULL, "the reach is 0; it must be a number above 0");
    assert_refused(&good, NAN, NULL, "the reach is nan; it must be a number above 0");
    assert_refused(NULL, 1.0, NULL, "the box is NULL");
    assert_refused(&line, 1.0, NULL, "box.dimension is 1; it must be 2 or 3");
    assert_refused(&flat, 1.0, NULL, "the box has no extent in z: lo is 0, hi is 0");
    assert_refused(&good, 1.0, &fine,
                   "options.cell is 0.001; it must be a fraction of the reach from 0.05 to 20, or 0");
    assert_refused(&good, 1.0, &negative, "options.n_threads is -1; it must be from 0 to 4096");
    negative.n_threads = 200000;
    assert_refused(&good, 1.0, &negative, "options.n_threads is 200000; it must be from 0 to 4096");
    double x[3][3] = {{1.0, 1.0, 1.0}, {2.0, NAN, 1.0}, {3.0, 1.0, INFINITY}};
    hs_cell_list *list;
    ck_assert_list(hs_cell_list_create(&list, &good, 1.0, NULL), list);
    ck_assert_int_eq(hs_cell_list_build(list, 3, &x[0][0], &x[0][1], &x[0][2], sizeof x[0]), HS_CODE_INPUT);
    ck_assert_str_eq(hs_cell_list_error(list), "particle 1 has a coordinate that is not a finite number: (2 nan 1)");
    ck_assert_int_eq(hs_cell_list_n(list), 0);
    ck_assert_int_eq(hs_cell_list_build(list, 1, &x[0][0], &x[0][1], NULL, sizeof x[0]), HS_CODE_INPUT);
    ck_assert_str_eq(hs_cell_list_error(list), "the z coordinates are NULL");
    ck_assert_int_eq(hs_cell_list_build(list, -1, &x[0][0], &x[0][1], &x[0][2], sizeof x[0]), HS_CODE_INPUT);
    hs_cell_list_destroy(&list);
}
END_TEST

/** The same particles in a box of 10^12 times the volume need the same memory within a tenth. */
START_TEST(memory_goes_by_particles)
{
    static double x[3 * N];
    size_t bytes[2];
    uint64_t state = 4;
    for (int k = 0; k < 3 * N; ++k) x[k] = 4.0 * next_uniform(&state);
    for (int k = 0; k < 2; ++k) {
        const double size = k == 0 ? 1e3 : 1e7;
        const hs_cell_list_box box = {.dimension = 3, .hi = {size, size, size}, .periodic = {1, 1, 1}};
        hs_cell_list *list;
        ck_assert_list(hs_cell_list_create(&list, &box, 1.0, NULL), list);
        ck_assert_list(hs_cell_list_build(list, N, x, x + 1, x + 2, 3 * sizeof *x), list);
        bytes[k] = hs_cell_list_memory(list);
        hs_cell_list_destroy(&list);
    }
    /* cells lie a little otherwise in the larger box, so that a few more or fewer are occupied */
    ck_assert(fabs((double)bytes[1] - (double)bytes[0]) < 0.1 * (double)bytes[0]);
    ck_assert_uint_lt(bytes[0], 200 * N + 4096);
}
END_TEST

HS_LOOP_TEST_MAIN("cell list", {pairs_and_queries, 24}, {edges_of_use, 1}, {bad_input, 1},
                  {memory_goes_by_particles, 1})
