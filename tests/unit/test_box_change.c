/* Boxes that change while atoms go along, flip, or flow: in reproducible runs all images of an atom stay images in
 * every bit. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "style/box_change.h"
#include "support/harness.h"
#include "support/run_deck.h"

enum { N = 60, N_IMAGES = 5 };

typedef struct world {
    hs_env env;
    hs_box box;
    hs_atoms atoms;
} world;

static hs_error err;
static const int32_t images[N_IMAGES][3] = {{0, 0, 0}, {1, 0, 0}, {0, -1, 1}, {-2, 3, -1}, {1, 1, 1}};

static double fraction_of(int i, int axis) { return ((double)((i * (37 + 8 * axis) + 11 * axis) % 101) + 0.5) / 102.0; }

/** Atoms at N places and at images of them, on a grid of 2^-30. */
static void begin(world *w, const double tilt[3])
{
    memset(w, 0, sizeof *w);
    memset(&err, 0, sizeof err);
    hs_box_init(&w->box);
    w->box.is_tilted = true;
    for (int axis = 0; axis < 3; ++axis) {
        w->box.lo[axis] = -1.0 + 0.25 * axis;
        w->box.hi[axis] = 6.0 + axis;
        w->box.tilt[axis] = tilt[axis];
    }
    ck_assert_hs_ok(hs_atoms_init(&w->atoms, &err), err);
    ck_assert_hs_ok(hs_atoms_set_types(&w->atoms, 1, &err), err);
    w->env.box = &w->box;
    w->env.atoms = &w->atoms;
    w->env.position_magic = ldexp(1.5, 52 - 30);
    for (int i = 0; i < N * N_IMAGES; ++i) {
        double x[3], shift[3];
        const double fraction[3] = {fraction_of(i / N_IMAGES, 0), fraction_of(i / N_IMAGES, 1),
                                    fraction_of(i / N_IMAGES, 2)};
        hs_box_place(&w->box, fraction, x);
        hs_box_shift(&w->box, images[i % N_IMAGES], shift);
        for (int axis = 0; axis < 3; ++axis) x[axis] = ldexp(rint(ldexp(x[axis], 30)), -30) + shift[axis];
        ck_assert_hs_ok(hs_atoms_add(&w->atoms, i + 1, 1, x, &err), err);
    }
}

static double unwrapped(const world *w, int i, int axis)
{
    const hs_atoms *atoms = &w->atoms;
    return hs_box_unwrapped(&w->box, (const double[3]){atoms->x[0][i], atoms->x[1][i], atoms->x[2][i]},
                            (const int32_t[3]){atoms->image[0][i], atoms->image[1][i], atoms->image[2][i]}, axis);
}

START_TEST(images_follow_as_images)
{
    static const double tilts[][3] = {{0.0, 0.0, 0.0}, {2.5, -1.25, 3.0}, {-3.5, 3.5, -4.0}};
    static const double lo[3] = {-1.3, -0.77, -0.4}, hi[3] = {6.21, 7.3, 7.9}, to[3] = {1.7, 2.2, -3.1};
    for (int k = 0; k < 3; ++k) {
        world w;
        begin(&w, tilts[k]);
        const hs_box before = w.box;
        double fraction[N][3];
        for (int i = 0; i < N; ++i)
            hs_box_fractions(
                &before,
                (const double[3]){w.atoms.x[0][i * N_IMAGES], w.atoms.x[1][i * N_IMAGES], w.atoms.x[2][i * N_IMAGES]},
                fraction[i]);
        hs_box_change(&w.env, lo, hi, to, 1);
        for (int axis = 0; axis < 3; ++axis) {
            ck_assert_double_eq_tol(w.box.lo[axis], lo[axis], 1e-9); /* the grid */
            ck_assert_double_eq_tol(w.box.hi[axis], hi[axis], 1e-9);
            ck_assert_double_eq_tol(w.box.tilt[axis], to[axis], 1e-9);
        }
        for (int i = 0; i < N * N_IMAGES; ++i) {
            double place[3], shift[3];
            hs_box_place(&w.box, fraction[i / N_IMAGES], place);
            hs_box_shift(&w.box, images[i % N_IMAGES], shift);
            for (int axis = 0; axis < 3; ++axis) {
                const double *x = w.atoms.x[axis];
                ck_assert_double_eq_tol(x[i], place[axis] + shift[axis], 4e-9); /* a few steps of the grid */
                ck_assert_double_eq(x[i] - shift[axis], x[i - i % N_IMAGES]);
                ck_assert_double_eq(ldexp(x[i], 30), rint(ldexp(x[i], 30)));
            }
        }
        hs_atoms_fini(&w.atoms);
    }
}
END_TEST

START_TEST(those_not_chosen_stay)
{
    world w;
    begin(&w, (const double[3]){1.0, 2.0, 3.0});
    double x[3];
    for (int axis = 0; axis < 3; ++axis) x[axis] = w.atoms.x[axis][7];
    hs_box_change(&w.env, (const double[3]){-2, -2, -2}, (const double[3]){9, 9, 9}, NULL, 0);
    for (int axis = 0; axis < 3; ++axis) ck_assert_double_eq(w.atoms.x[axis][7], x[axis]);
    ck_assert_double_eq(w.box.tilt[1], 2.0);
    hs_atoms_fini(&w.atoms);
}
END_TEST

/** Another set of edges of the same lattice: no atom moves, and unwrapped places neither, before and after wrapping. */
START_TEST(flips_keep_places)
{
    for (int k = 0; k < 27; ++k) {
        const int32_t n[3] = {k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1};
        world w;
        double place[3][N * N_IMAGES];
        begin(&w, (const double[3]){2.5, -1.25, 3.0});
        for (int i = 0; i < N * N_IMAGES; ++i)
            for (int axis = 0; axis < 3; ++axis) w.atoms.image[axis][i] = (i * (axis + 2)) % 7 - 3;
        for (int i = 0; i < N * N_IMAGES; ++i)
            for (int axis = 0; axis < 3; ++axis) place[axis][i] = unwrapped(&w, i, axis);
        hs_box_flip(&w.env, n);
        ck_assert_double_eq(w.box.tilt[0], 2.5 + 7.0 * n[0]);
        ck_assert_double_eq(w.box.tilt[1], -1.25 + 7.0 * n[1] + 2.5 * n[2]);
        ck_assert_double_eq(w.box.tilt[2], 3.0 + 7.75 * n[2]);
        for (int is_wrapped = 0; is_wrapped < 2; ++is_wrapped) {
            for (int i = 0; i < N * N_IMAGES; ++i)
                for (int axis = 0; axis < 3; ++axis) ck_assert_double_eq(unwrapped(&w, i, axis), place[axis][i]);
            static const double rate[3][3] = {{0}};
            hs_box_wrap_flowing(&w.env, rate, 1);
        }
        for (int i = 0; i < N * N_IMAGES; ++i) {
            double fraction[3];
            hs_box_fractions(&w.box, (const double[3]){w.atoms.x[0][i], w.atoms.x[1][i], w.atoms.x[2][i]}, fraction);
            for (int axis = 0; axis < 3; ++axis) ck_assert(fraction[axis] > -1e-12 && fraction[axis] < 1.0 + 1e-12);
        }
        hs_atoms_fini(&w.atoms);
    }
}
END_TEST

/** Lees and Edwards: who leaves through the top comes in at the bottom, slower by the speed of the top. */
START_TEST(velocities_of_images)
{
    static const double rate[3][3] = {{0.5, 0.0, 0.0}, {0.25, -1.0, 0.0}, {0.125, 2.0, 4.0}};
    for (int mask = 0; mask < 2; ++mask) {
        world w;
        begin(&w, (const double[3]){2.5, -1.25, 3.0});
        hs_box_wrap_flowing(&w.env, rate, (uint32_t)mask);
        for (int i = 0; i < N * N_IMAGES; ++i)
            for (int axis = 0; axis < 3; ++axis) {
                double v = 0.0;
                for (int edge = 0; edge < 3; ++edge) v -= images[i % N_IMAGES][edge] * rate[edge][axis];
                ck_assert_int_eq(w.atoms.image[axis][i], images[i % N_IMAGES][axis]);
                ck_assert_double_eq(w.atoms.v[axis][i], mask ? v : 0.0);
            }
        hs_atoms_fini(&w.atoms);
    }
}
END_TEST

/** A rate is a rate of time, whatever becomes of the timestep in the midst of a run: the box neither jumps nor slows down. */
START_TEST(rates_when_the_timestep_changes)
{
    hs_error error = {0};
    char *log = hs_test_run_deck("lattice fcc 0.8442\n"
                                 "region b block 0 3 0 3 0 3\n"
                                 "create_box 1 b\n"
                                 "create_atoms 1 box\n"
                                 "mass 1 1\n"
                                 "velocity all create 1.44 87287 loop geom\n"
                                 "pair_style lj/cut 2.5\n"
                                 "pair_coeff 1 1 1 1\n"
                                 "timestep 0.001\n"
                                 "fix 1 all nve\n"
                                 "fix d all deform 1 x erate 0.1\n"
                                 "fix r all dt/reset 5 0.0001 0.01 0.01 units box\n"
                                 "thermo_style custom step lx time\n"
                                 "thermo_modify format float %.15g\n"
                                 "thermo 1\n"
                                 "run 40\n",
                                 &error);
    ck_assert_hs_ok(error.status, error);
    double first = 0.0, step, length, time = 0.0;
    int n = 0;
    for (const char *row = strstr(log, "\nStep "); row != NULL; row = strchr(row + 1, '\n')) {
        if (sscanf(row, "%lf %lf %lf", &step, &length, &time) != 3) continue;
        if (step == 0.0) first = length;
        /* the position grid of so small a box is finer than 1e-12 */
        ck_assert_msg(fabs(length - first * (1.0 + 0.1 * time)) < 1e-9, "step %g: %.15g at %.15g", step, length, time);
        ++n;
    }
    ck_assert_int_eq(n, 41);
    ck_assert(fabs(time - 40 * 0.001) > 0.01); /* the timestep did change */
    free(log);
}
END_TEST

HS_TEST_MAIN("changing boxes", images_follow_as_images, those_not_chosen_stay, flips_keep_places, velocities_of_images,
             rates_when_the_timestep_changes)
