/* fix viscosity: what exchanges of velocities must keep, which way momentum flows, and what f_ID counts. */
#include "physics.h"

static const char *const fluid =
    "units lj\nlattice fcc 0.6\nregion box block 0 4 0 4 0 8\ncreate_box 2 box\ncreate_atoms 1 box\n"
    "displace_atoms all move 0 0 0.1\n"
    "set type 1 type/fraction 2 0.3 4711\nmass 1 1.0\nmass 2 1.8\nvelocity all create 1.35 87287 loop geom\n"
    "pair_style none\nneigh_modify delay 0 every 1 check yes\nthermo_modify norm no\n"
    "variable low equal \"vcm(all,x,bottom)*mass(all,bottom)\"\n"
    "variable mid equal \"vcm(all,x,middle)*mass(all,middle)\"\n"
    "region bottom block INF INF INF INF -0.1 0.9\nregion middle block INF INF INF INF 3.9 4.9\n"
    "fix flow all viscosity 1 x z 8 swap 3\n";

static double number(experiment *e, const char *formula)
{
    double value;
    deck(e, "variable n equal %s\n", formula);
    need(e, hs_simulation_get_variable(e->simulation, "n", &value));
    return value;
}

START_TEST(atoms_at_rest_exchange)
{
    experiment e;
    open_experiment(&e, 1);
    /* nothing moves the atoms (no integrator), so that the layers keep their atoms */
    deck(&e, "%s", fluid);
    const double ke = number(&e, "ke"),
                 p[3] = {number(&e, "vcm(all,x)"), number(&e, "vcm(all,y)"), number(&e, "vcm(all,z)")};
    const double low = number(&e, "v_low"), mid = number(&e, "v_mid"), mass = number(&e, "mass(all)");
    deck(&e, "run 4\n");
    /* sums of some hundred terms of order 1, each of them rounded */
    ck_assert_double_eq_tol(number(&e, "ke"), ke, 1e-12 * ke);
    ck_assert_double_eq_tol(number(&e, "vcm(all,x)") * mass, p[0] * mass, 1e-11);
    ck_assert_double_eq_tol(number(&e, "vcm(all,y)"), p[1], 1e-13);
    ck_assert_double_eq_tol(number(&e, "vcm(all,z)"), p[2], 1e-13);
    /* the lowest layer's momentum goes to the middle one, and f_flow is what the lowest one gained */
    const double gained = number(&e, "f_flow");
    ck_assert_double_lt(gained, -10.0); /* twelve pairs of the fastest atoms, each some 2 times 1.5 */
    ck_assert_double_eq_tol(number(&e, "v_low") - low, gained, 1e-11);
    ck_assert_double_eq_tol(number(&e, "v_mid") - mid, -gained, 1e-11);
    close_experiment(&e);
}
END_TEST

HS_TEST_MAIN("exchange of momentum", atoms_at_rest_exchange)
