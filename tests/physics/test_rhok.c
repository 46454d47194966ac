/* The bias on a Fourier mode of the density (fix rhok): its forces, the energy they keep, and modes that are known. */
#include "physics/physics.h"

/** Row of the columns at rest, of a crystal whose atom 7 is displaced by h along an axis. */
static void measure(int axis, double h, const char *columns, double *row, int n)
{
    double d[3] = {0.0, 0.0, 0.0};
    experiment e;
    d[axis] = h;
    open_experiment(&e, 1);
    deck(&e,
         "lattice fcc 0.8\nregion b block 0 3 0 3 0 4\ncreate_box 1 b\ncreate_atoms 1 box\nmass 1 1.0\n"
         "displace_atoms all random 0.3 0.3 0.3 4711\npair_style zero 1.0\npair_coeff * *\ngroup one id 7\n"
         "displace_atoms one move %.17g %.17g %.17g units box\ngroup most id 1:90\nfix 1 all nve\n"
         "fix r most rhok 2 -1 3 5.0 1.5\nfix_modify r energy yes\nvariable e equal pe*atoms\n"
         "variable fx equal fx[7]\nvariable fy equal fy[7]\nvariable fz equal fz[7]\n",
         d[0], d[1], d[2]);
    table t = run_table(&e, 0, 1, columns);
    for (int k = 0; k < n; ++k) row[k] = cell(&t, 0, 1 + k);
    free(t.value);
    close_experiment(&e);
}

START_TEST(forces_are_derivatives)
{
    double force[3], more, less;
    measure(0, 0.0, "v_fx v_fy v_fz", force, 3);
    for (int axis = 0; axis < 3; ++axis) {
        const double h = 1e-4; /* error h^2/6 times the third derivative, K k^3, some 1e-6; rounding 1e-11 */
        measure(axis, h, "v_e", &more, 1);
        measure(axis, -h, "v_e", &less, 1);
        ck_assert_double_eq_tol(force[axis], -(more - less) / (2.0 * h), 2e-6);
        ck_assert(fabs(force[axis]) > 1e-3); /* else nothing was tested */
    }
}
END_TEST

/* Energy of bias and motion is kept: errors of velocity Verlet are of the order of dt^2. */
START_TEST(energy)
{
    experiment e;
    double change[2];
    for (int k = 0; k < 2; ++k) {
        open_experiment(&e, 2);
        deck(&e,
             "lattice fcc 0.8\nregion b block 0 4 0 3 0 4\ncreate_box 1 b\ncreate_atoms 1 box\nmass 1 1.0\n"
             "velocity all create 0.5 4711\npair_style lj/cut 2.5\npair_coeff * * 1 1\npair_modify shift yes\n"
             "fix 1 all nve\nfix r all rhok 8 0 0 3.0 9.0\nfix_modify r energy yes\n"
             "timestep %g\n",
             k == 0 ? 0.004 : 0.001);
        table t = run_table(&e, k == 0 ? 100 : 400, k == 0 ? 10 : 40, "etotal f_r");
        change[k] = 0.0;
        for (int row = 1; row < t.n_rows; ++row) change[k] = fmax(change[k], fabs(cell(&t, row, 1) - cell(&t, 0, 1)));
        ck_assert(fabs(cell(&t, t.n_rows - 1, 2) - cell(&t, 0, 2)) > 1.0); /* the bias has done work */
        free(t.value);
        close_experiment(&e);
    }
    ck_assert_double_lt(change[1], 0.2 * change[0]); /* a sixteenth, but for the jump of forces at the cutoff */
    ck_assert_double_lt(change[0], 1e-3);            /* an atom */
}
END_TEST

/* All atoms of a crystal scatter in phase: |rho_k| is the root of their number, where k is of its reciprocal lattice,
 * else 0. */
START_TEST(crystal)
{
    experiment e;
    open_experiment(&e, 1);
    deck(&e,
         "lattice fcc 0.8\nregion b block 0 4 0 3 0 5\ncreate_box 1 b\ncreate_atoms 1 box\nmass 1 1.0\n"
         "pair_style zero 1.0\npair_coeff * *\nfix 1 all nve\nfix a all rhok 8 0 0 0 0\nfix c all rhok 8 6 -10 0 0\n"
         "fix d all rhok 4 0 0 0 0\n");
    table t = run_table(&e, 0, 1, "f_a[3] f_c[3] f_d[3] f_a[1] f_a");
    ck_assert_double_eq_tol(cell(&t, 0, 1), sqrt(240.0), 1e-10);
    ck_assert_double_eq_tol(cell(&t, 0, 2), sqrt(240.0), 1e-10);
    ck_assert_double_eq_tol(cell(&t, 0, 3), 0.0, 1e-10);
    ck_assert_double_eq_tol(cell(&t, 0, 4), sqrt(240.0), 1e-10);
    ck_assert(cell(&t, 0, 5) == 0.0);
    free(t.value);
    close_experiment(&e);
}
END_TEST

HS_TEST_MAIN("bias on a mode of the density", forces_are_derivatives, energy, crystal)
