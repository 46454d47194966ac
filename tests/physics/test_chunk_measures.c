/* What is known of groups and chunks beforehand: a body that turns as a whole has that angular velocity, a group with
 * itself has the energy of all, two groups pull at each other with opposite forces, and a thermostat leaves the motion
 * of chunks alone. */
#include "physics/measured.h"

#define LIQUID(region)                                                                                                 \
    "units lj\nlattice fcc 0.8442\nregion b " region "\ncreate_box 2 b\ncreate_atoms 1 box\n"                          \
    "set type 1 type/ratio 2 0.3 4711\nmass 1 1.0\nmass 2 2.5\nvelocity all create 1.44 87287 loop geom\n"             \
    "pair_style lj/cut 2.0\npair_coeff * * 1.0 1.0\nneigh_modify every 1 delay 0 check yes\nfix 1 all nve\nrun 50\n"

static const char *const liquids[] = {
    LIQUID("block 0 4 0 5 0 4"), LIQUID("prism 0 4 0 5 0 4 1.5 -1 0.7"), /* no two edges at right angles */
};
enum { N_LIQUIDS = 2 };

/* Sums of some hundred terms of up to 100, rounded in the last of 16 digits. */
static const double tolerance = 1e-11;

static void check_groups(hs_deck *deck, void *context)
{
    static const char *const forces[3][2] = {
        {"c_push[1]", "c_pull[1]"}, {"c_push[2]", "c_pull[2]"}, {"c_push[3]", "c_pull[3]"}};
    (void)context;
    const double all = number(deck, "c_all");
    ck_assert_double_lt(all, -100.0);
    ck_assert_double_eq_tol(all, number(deck, "c_pe"), tolerance * fabs(all));
    ck_assert_double_eq_tol(number(deck, "c_push") + number(deck, "c_one") + number(deck, "c_two"), all,
                            tolerance * fabs(all));
    ck_assert_double_eq(number(deck, "c_push"), number(deck, "c_pull"));
    for (int axis = 0; axis < 3; ++axis) {
        ck_assert_double_eq(number(deck, forces[axis][0]), -number(deck, forces[axis][1]));
        ck_assert_double_gt(fabs(number(deck, forces[axis][0])), 1e-3);
    }
    ck_assert_double_eq(number(deck, "c_all[2]"), 0.0);
}

START_TEST(groups_share_the_energy)
{
    for (int k = 0; k < N_LIQUIDS; ++k)
        run_after(
            liquids[k],
            "group two type 2\ngroup one subtract all two\ncompute pe all pe\ncompute all all group/group all\n"
            "compute push one group/group two\ncompute pull two group/group one\ncompute one one group/group one\n"
            "compute two two group/group two\nthermo_style custom step c_pe c_all c_push\nrun 3\n",
            check_groups);
}
END_TEST

/** Velocities were set to those of a rotation by (0.2, -0.3, 0.5) and a drift. */
static void check_rotation(hs_deck *deck, void *context)
{
    (void)context;
    for (int chunk = 1; chunk <= 2; ++chunk)
        for (int axis = 0; axis < 3; ++axis) {
            static const double omega[3] = {0.2, -0.3, 0.5};
            char word[32];
            snprintf(word, sizeof word, "c_w[%d][%d]", chunk, axis + 1);
            ck_assert_double_eq_tol(number(deck, word), omega[axis], tolerance);
        }
}

START_TEST(a_body_turns_as_a_whole)
{
    for (int k = 0; k < N_LIQUIDS; ++k)
        run_after(liquids[k],
                  "compute u all property/atom xu yu zu\nvariable xu atom c_u[1]\nvariable yu atom c_u[2]\n"
                  "variable zu atom c_u[3]\nvariable a atom -0.3*v_zu-0.5*v_yu+1\nvariable b atom 0.5*v_xu-0.2*v_zu\n"
                  "variable c atom 0.2*v_yu+0.3*v_xu-2\nvelocity all set v_a v_b v_c units box\n"
                  "compute kinds all chunk/atom type\ncompute w all omega/chunk kinds\n"
                  "thermo_style custom step c_w[1][1]\nrun 0\n",
                  check_rotation);
}
END_TEST

static void check_thermostat(hs_deck *deck, void *context)
{
    (void)context;
    ck_assert_double_eq_tol(number(deck, "c_t"), 0.5, 1e-9);
    ck_assert_double_eq_tol(number(deck, "c_m[1][1]"), 2.0, 1e-9); /* of a whole box: no force on it */
    ck_assert_double_eq_tol(number(deck, "c_m[1][2]"), -1.0, 1e-9);
}

START_TEST(thermostats_leave_the_motion_of_chunks)
{
    for (int k = 0; k < N_LIQUIDS; ++k)
        run_after(liquids[k],
                  "velocity all zero linear\nvelocity all set 2.0 -1.0 0.0 sum yes units box\n"
                  "compute whole all chunk/atom bin/1d x lower 1.0 units reduced\n"
                  "compute t all temp/chunk whole com yes cdof -3\ncompute m all vcm/chunk whole\n"
                  "fix 2 all temp/rescale 1 0.5 0.5 0.0 1.0\nfix_modify 2 temp t\n"
                  "thermo_style custom step c_t c_m[1][1]\nrun 20\n",
                  check_thermostat);
}
END_TEST

HS_TEST_MAIN("groups and chunks", groups_share_the_energy, a_body_turns_as_a_whole,
             thermostats_leave_the_motion_of_chunks)
