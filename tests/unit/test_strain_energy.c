/* Strain energy of boxes: forces are its derivatives, and in the reference box they are those of the stress asked
 * for. */
#include "style/strain_energy.h"
#include "support/harness.h"

static hs_box make_box(void)
{
    hs_box box;
    hs_box_init(&box);
    box.is_tilted = true;
    const double lo[3] = {-1.0, 0.5, 2.0}, length[3] = {6.5, 8.0, 7.0}, tilt[3] = {0.9, -0.6, 1.3};
    for (int axis = 0; axis < 3; ++axis) {
        box.lo[axis] = lo[axis];
        box.hi[axis] = lo[axis] + length[axis];
        box.tilt[axis] = tilt[axis];
    }
    return box;
}

/** Length or tilt k of a box: x y z xy xz yz. */
static double *coordinate(hs_box *box, int k) { return k < 3 ? &box->hi[k] : &box->tilt[k - 3]; }

static const double stress[6] = {0.7, -1.1, 0.4, 0.5, -0.3, 0.2};

START_TEST(forces_are_derivatives)
{
    const hs_box first = make_box();
    hs_box box = first;
    hs_strain_energy strain;
    double force[6];
    hs_strain_energy_set(&strain, &first, stress);
    for (int k = 0; k < 6; ++k) *coordinate(&box, k) += 0.1 * (k + 1) - 0.3;
    hs_strain_energy_forces(&strain, &box, force);
    for (int k = 0; k < 6; ++k) {
        /* a quadratic function: central differences are exact but for rounding, some 1e-16 V S / d */
        const double d = 1e-3;
        hs_box more = box, less = box;
        *coordinate(&more, k) += d;
        *coordinate(&less, k) -= d;
        const double slope = (hs_strain_energy_of(&strain, &more) - hs_strain_energy_of(&strain, &less)) / (2.0 * d);
        ck_assert_double_eq_tol(force[k], slope, 1e-9);
    }
}
END_TEST

START_TEST(stress_of_the_reference)
{
    static const int column[6] = {0, 1, 2, 1, 2, 2};
    const hs_box box = make_box();
    hs_strain_energy strain;
    double force[6];
    hs_strain_energy_set_at_rest(&strain, &box, stress);
    hs_strain_energy_forces(&strain, &box, force);
    for (int k = 0; k < 6; ++k)
        ck_assert_double_eq_tol(force[k] * hs_box_length(&box, column[k]) / hs_box_volume(&box), stress[k], 1e-13);
    ck_assert_double_eq_tol(strain.volume, 6.5 * 8.0 * 7.0, 1e-12);
}
END_TEST

/** The box with its edges strained: h (1 + w) from the left, with one component of w. */
static hs_box strained(const hs_box *box, int k, double w)
{
    hs_box other = *box;
    const double ly = hs_box_length(box, 1), lz = hs_box_length(box, 2);
    const double *t = box->tilt;
    if (k < 3) other.hi[k] += w * hs_box_length(box, k);
    const double of_tilts[6][3] = {{t[0], t[1], 0.0}, {0.0, 0.0, t[2]}, {0.0},
                                   {ly, t[2], 0.0},   {0.0, lz, 0.0},   {0.0, 0.0, lz}};
    for (int tilt = 0; tilt < 3; ++tilt) other.tilt[tilt] += w * of_tilts[k][tilt];
    return other;
}

/* What barostats work against: V0 S in the reference box, and the derivative by strains in any other. */
START_TEST(stress_against_strains)
{
    const hs_box first = make_box();
    hs_box box = first;
    hs_strain_energy strain;
    double against[6];
    hs_strain_energy_set(&strain, &first, stress);
    hs_strain_energy_stress(&strain, &first, against);
    for (int k = 0; k < 6; ++k) ck_assert_double_eq_tol(against[k] / hs_box_volume(&first), stress[k], 1e-13);
    for (int k = 0; k < 6; ++k) *coordinate(&box, k) += 0.1 * (k + 1) - 0.3;
    hs_strain_energy_stress(&strain, &box, against);
    for (int k = 0; k < 6; ++k) {
        const double d = 1e-4; /* quadratic again; rounding is divided by a smaller number */
        const hs_box more = strained(&box, k, d), less = strained(&box, k, -d);
        const double slope = (hs_strain_energy_of(&strain, &more) - hs_strain_energy_of(&strain, &less)) / (2.0 * d);
        ck_assert_double_eq_tol(against[k], slope, 1e-8);
    }
}
END_TEST

/* Without tilts it is V0/2 sum S (L/L0)^2. */
START_TEST(orthogonal_box)
{
    hs_box box = make_box();
    const double lengths[3] = {0.6, 0.7, 0.5};
    double wanted = 0.0;
    hs_strain_energy strain;
    box.tilt[0] = box.tilt[1] = box.tilt[2] = 0.0;
    hs_strain_energy_set(&strain, &box, (const double[6]){stress[0], stress[1], stress[2]});
    for (int axis = 0; axis < 3; ++axis) {
        const double before = hs_box_length(&box, axis), ratio = (before + lengths[axis]) / before;
        box.hi[axis] += lengths[axis];
        wanted += 0.5 * strain.volume * stress[axis] * ratio * ratio;
    }
    ck_assert_double_eq_tol(hs_strain_energy_of(&strain, &box), wanted, 1e-11);
}
END_TEST

HS_TEST_MAIN("strain energy", forces_are_derivatives, stress_of_the_reference, stress_against_strains, orthogonal_box)
