/* What is constant under thermostats and barostats (`econserve`): the energy of the atoms and of everything that acts on them. Its
 * error goes with the square of the timestep, whatever may change of the box, for pressures that differ and for
 * shear stresses, and across flips of the box. A term that were missing, or wrong, would not go away with the timestep.
 * Source of the integrators' order: M. E. Tuckerman et al., J. Phys. A 39, 5629 (2006), doi:10.1088/0305-4470/39/19/S18. */
#include "physics.h"

/** Largest departure of econserve (per atom) from its start in 1.6 tau at that timestep; *xy is the tilt at the end. */
static double departure(const char *fix, double tilt, int steps_a_time, double *xy)
{
    enum { N_TIMES = 40 };
    double farthest = 0.0;
    experiment e;
    open_experiment(&e, 1);
    /* a crystal of its own images for either tilt; forces and energies go to zero smoothly at the cutoff */
    deck(&e,
         "units lj\nlattice fcc 1.0\nbox tilt large\nregion b prism 0 4 0 4 0 4 %g -0.5 0.5\ncreate_box 1 b\n"
         "create_atoms 1 box\nmass 1 1.0\nvelocity all create 0.6 87287 loop geom\npair_style lj/smooth/linear 2.5\n"
         "pair_coeff * * 1 1\nneigh_modify every 10 delay 0 check yes\ntimestep %.17g\nfix 1 all %s\n",
         tilt, 0.04 / steps_a_time, fix);
    table t = run_table(&e, N_TIMES * steps_a_time, steps_a_time, "econserve xy");
    ck_assert_int_eq(t.n_rows, N_TIMES + 1);
    for (int row = 1; row < t.n_rows; ++row) farthest = fmax(farthest, fabs(cell(&t, row, 1) - cell(&t, 0, 1)));
    *xy = cell(&t, t.n_rows - 1, 2);
    free(t.value);
    close_experiment(&e);
    return farthest;
}

START_TEST(test_second_order)
{
    static const char *const fixes[] = {
        "nph tri 3 3 0.4",
        "npt temp 0.3 0.3 0.2 iso 3 3 0.4",
        "nph x 4 4 0.4 y 2 2 0.4 z 3 3 0.4 xy 1 1 0.4 xz -0.5 -0.5 0.4 yz 0.3 0.3 0.4",
        "npt temp 0.3 0.3 0.2 x 4 4 0.4 y 2 2 0.5 z 3 3 0.4 xy 1 1 0.4 xz -0.5 -0.5 0.4 yz 0.3 0.3 0.4",
        "nph x 4 4 0.4 y 2 2 0.4 z 3 3 0.4 xy 0 0 0.4 xz 0 0 0.4 yz 0 0 0.4 pchain 0",
    };
    static const double tilts[] = {1.0, 3.0}; /* the second is more than 0.6 of the edge: the box flips */
    for (size_t k = 0; k < sizeof fixes / sizeof fixes[0]; ++k)
        for (int which = 0; which < 2; ++which) {
            double xy;
            const double coarse = departure(fixes[k], tilts[which], 10, &xy);
            ck_assert_msg(which == 0 || k == 1 || xy < 0.0, "%s: no flip, the tilt is %g", fixes[k], xy);
            const double fine = departure(fixes[k], tilts[which], 20, &xy);
            printf("  %-90s %.4f %.4f ratio %.3f\n", fixes[k], coarse, fine, coarse / fine);
            /* 4 but for terms of higher order, which are 1 % of the error at these timesteps */
            ck_assert_msg(fabs(coarse / fine - 4.0) < 0.1, "%s, tilt %g: %g at timestep 0.004, %g at 0.002", fixes[k],
                          tilts[which], coarse, fine);
        }
}
END_TEST

HS_TEST_MAIN("barostats", test_second_order)
