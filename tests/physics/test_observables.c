/* What an experiment would measure, mean-square displacement and pair correlation, from the double loop and from every
 * other neighbor method: the same bits, for runs are reproducible and count the same pairs. */
#include "physics/physics.h"

static const char *const methods[] = {"linked",      "linked cell 0.4 order none stencil cube",
                                      "incremental", "incremental cell 0.6",
                                      "hash",        "hash cell 1.6 order row",
                                      "cell",        "verlet",
                                      "cluster"};

/** Active discs in the plane. */
static const char active[] = "dimension 2\natom_style hybrid dipole sphere\nlattice sq 0.75\n"
                             "region box block 0 13 0 15 -0.5 0.5\ncreate_box 1 box\ncreate_atoms 1 box\n"
                             "set type 1 dipole/random 77 1.0\npair_style wca\npair_coeff 1 1 24.0 1.0\n"
                             "neighbor 0.3 bin\nneigh_modify every 1 delay 0 check yes\n"
                             "fix 1 all brownian/sphere 1.0 20110 gamma_t 1.0 gamma_r 0.3333333\n"
                             "fix 2 all propel/self dipole 24.0\nfix 3 all enforce2d\ntimestep 0.00005\n"
                             "compute g all rdf 12\nvariable n equal 400\n";
/** A liquid in space with friction and noise. */
static const char liquid[] = "lattice fcc 0.8\nregion box block 0 4 0 4 0 4\ncreate_box 1 box\ncreate_atoms 1 box\n"
                             "mass 1 1.0\nvelocity all create 1.2 11 dist gaussian\npair_style lj/cut 2.2\n"
                             "pair_coeff 1 1 1.0 1.0\nneighbor 0.2 bin\nneigh_modify every 3 delay 0 check yes\n"
                             "fix 1 all nve\nfix 2 all langevin 1.2 1.2 0.5 48279\ntimestep 0.004\n"
                             "compute g all rdf 12\nvariable n equal 100\n";
/** Grains of diameters from 0.4 to 2.4 between walls: small and large ones in cells of their own. */
static const char grains[] =
    "dimension 2\nboundary %s p\natom_style sphere\nlattice sq2 0.8\nregion box block 0 13 0 11 -0.5 0.5\n"
    "create_box 1 box\nregion inside block 0.5 12.5 0.5 10.5 -0.5 0.5\ncreate_atoms 1 region inside\n"
    "variable d atom 0.4+2.0*(((id*61)%%101)/100)^4\nset group all diameter v_d\nset group all mass 1.0\n"
    "velocity all create 1.0 99 loop geom\npair_style harmonic/sphere\npair_coeff 1 1 60.0\nneighbor 0.2 bin\n"
    "neigh_modify every 2 delay 0 check yes\nfix 1 all nve\nfix 2 all enforce2d\n"
    "fix 3 all wall/reflect xlo EDGE xhi EDGE ylo EDGE yhi EDGE\ntimestep 0.005\n"
    "compute g all rdf 12\nvariable n equal 150\n";

static table measure(const char *method, const char *system, int n_threads)
{
    experiment e;
    open_experiment(&e, n_threads);
    deck(&e, "neighbor_method %s\n", method);
    need(&e, hs_simulation_deck_text(e.simulation, system));
    deck(&e, "compute m all msd\nthermo_style custom step c_m[4] c_m[1] c_g[1][2] c_g[2][2] c_g[3][2] c_g[4][2] "
             "c_g[5][2] c_g[6][2] c_g[7][2] c_g[8][2] c_g[9][2] c_g[10][2] c_g[11][2] c_g[12][2]\n"
             "thermo_modify format float %%.17g\nthermo 50\nrun $n\n");
    const table t = last_table(&e);
    close_experiment(&e);
    return t;
}

static void check(const char *system)
{
    const table right = measure("nsq", system, 1);
    ck_assert_int_ge(right.n_rows, 3);
    ck_assert_double_gt(cell(&right, right.n_rows - 1, 1), 0.0);
    ck_assert_double_gt(cell(&right, right.n_rows - 1, 14), 0.1); /* there are pairs at the cutoff */
    for (size_t k = 0; k < sizeof methods / sizeof methods[0]; ++k) {
        table t = measure(methods[k], system, 1 + (int)k % 3);
        ck_assert_int_eq(t.n_rows, right.n_rows);
        for (int row = 0; row < t.n_rows; ++row)
            for (int c = 0; c < t.n_columns; ++c)
                ck_assert_msg(
                    memcmp(&t.value[row * t.n_columns + c], &right.value[row * t.n_columns + c], sizeof(double)) == 0,
                    "%s, step %g, column %d: %.17g, not %.17g", methods[k], cell(&right, row, 0), c, cell(&t, row, c),
                    cell(&right, row, c));
        free(t.value);
    }
    free(right.value);
}

START_TEST(test_active) { check(active); }
END_TEST

START_TEST(test_liquid) { check(liquid); }
END_TEST

START_TEST(test_grains)
{
    char text[2048];
    snprintf(text, sizeof text, grains, "f f");
    check(text);
    snprintf(text, sizeof text, grains, "p f"); /* walls across x are refused: no wall there */
    char *wall = strstr(text, "xlo EDGE xhi EDGE ");
    memmove(wall, wall + 18, strlen(wall + 18) + 1);
    check(text);
}
END_TEST

HS_TEST_MAIN("observables", test_active, test_liquid, test_grains)
