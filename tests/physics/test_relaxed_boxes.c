/* Boxes that relax (fix box/relax) against lattice sums, and against the pressures that they are told to reach. */
#include "physics/physics.h"

static const double cutoff = 2.9; /* far from all shells of the crystals below: they stay within or beyond it */

/** Sums over the pairs of one atom in an fcc crystal of edge a: of r^-12, and of r^-6. */
static void lattice_sums(double a, double *sum12, double *sum6)
{
    enum { REACH = 6 };
    *sum12 = *sum6 = 0.0;
    for (int i = -REACH; i <= REACH; ++i)
        for (int j = -REACH; j <= REACH; ++j)
            for (int k = -REACH; k <= REACH; ++k) {
                /* sites are half of the whole numbers with an even sum */
                const double r2 = 0.25 * a * a * (i * i + j * j + k * k);
                if ((i + j + k) % 2 != 0 || r2 == 0.0 || r2 >= cutoff * cutoff) continue;
                *sum12 += pow(r2, -6.0);
                *sum6 += pow(r2, -3.0);
            }
}

/** Pressure of the crystal at rest: four atoms in a^3, each with half of its pairs. */
static double lattice_pressure(double a)
{
    double sum12, sum6;
    lattice_sums(a, &sum12, &sum6);
    return 4.0 * 0.5 * (48.0 * sum12 - 24.0 * sum6) / (3.0 * a * a * a);
}

/** The edge at which the crystal has that pressure, by bisection: pressure falls with the edge. */
static double lattice_edge(double pressure)
{
    double lo = 1.45, hi = 1.62;
    for (int k = 0; k < 60; ++k) {
        const double a = 0.5 * (lo + hi);
        if (lattice_pressure(a) > pressure)
            lo = a;
        else
            hi = a;
    }
    return 0.5 * (lo + hi);
}

/** A crystal of 4 x 4 x 4 cells, shifted so that no atom is on a face. */
static void open_crystal(experiment *e, int n_threads, const char *region)
{
    open_experiment(e, n_threads);
    deck(e,
         "lattice fcc 1.0 origin 0.25 0.3 0.35\nregion box %s\ncreate_box 1 box\ncreate_atoms 1 box\nmass 1 1.0\n"
         "pair_style lj/cut %g\npair_coeff 1 1 1.0 1.0\npair_modify shift yes\nfix 1 all nve\n",
         region, cutoff);
}

START_TEST(lattice_constant)
{
    const double pressures[] = {0.0, 4.0, -2.0};
    for (int k = 0; k < 3; ++k) {
        experiment e;
        open_crystal(&e, 2, "block 0 4 0 4 0 4");
        deck(&e, "fix r all box/relax iso %g vmax 0.01\nminimize 0 1e-9 1000 10000\n", pressures[k]);
        /* forces below 1e-9, energy for a strain of 1, of a crystal whose stiffness 9 K V is 5e4 and more: strains of
         * 1e-13; positions and
         *            box are rounded to some 1e-14 */
        ck_assert_double_eq_tol(thermo(&e, "lx") / 4.0, lattice_edge(pressures[k]), 1e-10);
        ck_assert_double_eq_tol(thermo(&e, "press"), pressures[k], 1e-8);
        close_experiment(&e);
    }
}
END_TEST

/** The components of the pressure against those that were asked for. */
static void check_pressures(experiment *e, const double wanted[6], double tolerance)
{
    static const char *const names[6] = {"pxx", "pyy", "pzz", "pxy", "pxz", "pyz"};
    for (int k = 0; k < 6; ++k)
        ck_assert_msg(fabs(thermo(e, names[k]) - wanted[k]) <= tolerance, "%s is %.10g, not %g", names[k],
                      thermo(e, names[k]), wanted[k]);
}

/* A crystal that was sheared and stretched finds its way back: lengths of the lattice, no tilt. */
START_TEST(strained_lattice)
{
    experiment e;
    open_crystal(&e, 1, "prism 0 4 0 4 0 4 0 0 0");
    deck(&e, "change_box all xy delta 0.2 xz delta -0.1 yz delta 0.15 x scale 1.02 y scale 0.97 remap units box\n"
             "displace_atoms all random 0.02 0.02 0.02 4711\n"
             "fix r all box/relax tri 0.0 vmax 0.005\nminimize 0 1e-7 5000 50000\n");
    const double edge = 4.0 * lattice_edge(0.0);
    const char *const lengths[] = {"lx", "ly", "lz"}, *const tilts[] = {"xy", "xz", "yz"};
    for (int k = 0; k < 3; ++k) {
        ck_assert_double_eq_tol(thermo(&e, lengths[k]), edge, 1e-8);
        ck_assert_double_eq_tol(thermo(&e, tilts[k]), 0.0, 1e-8);
    }
    check_pressures(&e, (const double[6]){0}, 1e-8);
    close_experiment(&e);
}
END_TEST

/* Unequal targets: along the axes, where forces are the derivatives of the energy, and in shear, where they are nearly
 * so in a box that is tilted, so that line searches end before the target is reached to the last digit. */
START_TEST(unequal_targets)
{
    const struct {
        const char *region, *targets;
        double pressure[6], tolerance;
    } cases[] = {{"block 0 4 0 4 0 4", "x 1.0 y 2.0 z 0.5", {1.0, 2.0, 0.5}, 1e-6},
                 {"prism 0 4 0 4 0 4 0.1 0 0", "x 1.0 y 2.0 z 0.5 xy 0.2", {1.0, 2.0, 0.5, 0.2}, 2e-3}};
    for (int k = 0; k < 2; ++k) {
        experiment e;
        open_crystal(&e, 1, cases[k].region);
        deck(&e,
             "fix r all box/relax %s vmax 0.005\nminimize 0 1e-6 1000 10000\nunfix r\n"
             "fix r all box/relax %s vmax 0.005 nreset 10\nminimize 0 1e-6 1000 10000\nminimize 0 1e-6 1000 10000\n",
             cases[k].targets, cases[k].targets);
        check_pressures(&e, cases[k].pressure, cases[k].tolerance);
        close_experiment(&e);
    }
}
END_TEST

/* One length and the mean of two others; the third does not move. */
START_TEST(some_lengths)
{
    experiment e;
    open_crystal(&e, 1, "block 0 4 0 4 0 4");
    const double before = thermo(&e, "ly"), corner = thermo(&e, "ylo");
    deck(&e, "fix r all box/relax x 1.5 z 1.5 couple xz vmax 0.01 fixedpoint 0 0 0\nminimize 0 1e-8 1000 10000\n");
    ck_assert(thermo(&e, "ly") == before && thermo(&e, "ylo") == corner);
    ck_assert_double_eq_tol(0.5 * (thermo(&e, "pxx") + thermo(&e, "pzz")), 1.5, 1e-8);
    /* equal strains keep the ratio but for rounding of the bounds */
    ck_assert_double_eq_tol(thermo(&e, "lx"), thermo(&e, "lz"), 1e-12);
    ck_assert(thermo(&e, "xlo") == 0.0 && thermo(&e, "zlo") == 0.0);
    close_experiment(&e);
}
END_TEST

HS_TEST_MAIN("boxes that relax", lattice_constant, strained_lattice, unequal_targets, some_lengths)
