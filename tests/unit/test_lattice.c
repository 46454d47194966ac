/* Lattices: densities, spacings, sites, and what is refused. Bits of sites are in golden.setup. */
#include <math.h>
#include <string.h>

#include "core/lattice.h"
#include "support/harness.h"

static void make(hs_lattice *lattice, const char *style, double value, bool is_density, int dimension)
{
    hs_error err = {0};
    const hs_lattice_size size = {.value = value, .is_density = is_density, .dimension = dimension};
    ck_assert_hs_ok(hs_lattice_begin(lattice, style, &err), err);
    ck_assert_hs_ok(hs_lattice_finish(lattice, &size, &err), err);
}

/** Sites in a block of n spacings a side (exact periods of the unrotated cell). */
static int count_sites(const hs_lattice *lattice, const double n[3])
{
    hs_error err = {0};
    double box_lo[3], box_hi[3], x[3];
    int lo[3], hi[3], count = 0;
    for (int axis = 0; axis < 3; ++axis) {
        box_lo[axis] = -1e-6;
        box_hi[axis] = n[axis] * lattice->spacing[axis] - 2e-6;
    }
    ck_assert_hs_ok(hs_lattice_range(lattice, box_lo, box_hi, lo, hi, &err), err);
    for (int k = lo[2]; k <= hi[2]; ++k)
        for (int j = lo[1]; j <= hi[1]; ++j)
            for (int i = lo[0]; i <= hi[0]; ++i)
                for (int b = 0; b < lattice->n_basis; ++b) {
                    hs_lattice_site(lattice, i, j, k, b, x);
                    bool is_in = true;
                    for (int axis = 0; axis < 3; ++axis)
                        is_in = is_in && x[axis] >= box_lo[axis] && x[axis] < box_hi[axis];
                    count += is_in;
                }
    return count;
}

START_TEST(test_density)
{
    static const struct {
        const char *style;
        int dimension;
    } cases[] = {{"sc", 3}, {"bcc", 3}, {"fcc", 3}, {"hcp", 3}, {"diamond", 3}, {"sq", 2}, {"sq2", 2}, {"hex", 2}};
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; ++k) {
        hs_lattice lattice;
        make(&lattice, cases[k].style, 0.8442, true, cases[k].dimension);
        const double n[3] = {3.0, 2.0, cases[k].dimension == 3 ? 2.0 : 1e-3};
        double volume = 1.0;
        for (int axis = 0; axis < cases[k].dimension; ++axis) volume *= n[axis] * lattice.spacing[axis];
        const int count = count_sites(&lattice, n);
        ck_assert_msg(fabs(count / volume - 0.8442) < 1e-13, "%s: %d sites, density %.17g", cases[k].style, count,
                      count / volume);
        hs_lattice_fini(&lattice);
    }
}
END_TEST

START_TEST(test_spacing)
{
    hs_lattice lattice;
    make(&lattice, "fcc", 0.8442, true, 3);
    ck_assert(lattice.spacing[0] == 1.6795961913825073); /* lmp, bench deck in.lj */
    hs_lattice_fini(&lattice);
    make(&lattice, "hcp", 2.0, false, 3);
    ck_assert_double_eq_tol(lattice.spacing[1], 2.0 * sqrt(3.0), 1e-15);
    ck_assert_double_eq_tol(lattice.spacing[2], 2.0 * sqrt(8.0 / 3.0), 1e-15);
    hs_lattice_fini(&lattice);
    make(&lattice, "none", 2.5, true, 3);
    ck_assert(!lattice.is_set && lattice.spacing[2] == 2.5);
    hs_lattice_fini(&lattice);
}
END_TEST

START_TEST(test_orientation)
{
    hs_error err = {0};
    hs_lattice lattice;
    const int orient[3][3] = {{1, 1, 0}, {-1, 1, 0}, {0, 0, 1}};
    const hs_lattice_size size = {.value = 1.0, .dimension = 3};
    ck_assert_hs_ok(hs_lattice_begin(&lattice, "sc", &err), err);
    memcpy(lattice.orient, orient, sizeof orient);
    ck_assert_hs_ok(hs_lattice_finish(&lattice, &size, &err), err);
    ck_assert_double_eq_tol(lattice.spacing[0], sqrt(2.0), 1e-15);
    double x[3];
    hs_lattice_site(&lattice, 1, 1, 0, 0, x); /* [110] becomes x */
    ck_assert_double_eq_tol(x[0], sqrt(2.0), 1e-15);
    ck_assert_double_eq_tol(x[1], 0.0, 1e-15);
    hs_lattice_fini(&lattice);
}
END_TEST

/** A change to a custom lattice that must be refused with this text. */
static void refuse(const char *expected, void (*change)(hs_lattice *lattice), int dimension)
{
    hs_error err = {0};
    hs_lattice lattice;
    const double basis[3] = {0.0, 0.0, 0.0};
    const hs_lattice_size size = {.value = 1.0, .dimension = dimension};
    ck_assert_hs_ok(hs_lattice_begin(&lattice, "custom", &err), err);
    ck_assert_hs_ok(hs_lattice_add_basis(&lattice, basis, &err), err);
    change(&lattice);
    ck_assert_int_eq(hs_lattice_finish(&lattice, &size, &err), HS_ERROR_INPUT);
    ck_assert_msg(strstr(err.text, expected) != NULL, "'%s' is not in '%s'", expected, err.text);
    hs_lattice_fini(&lattice);
}

static void flat(hs_lattice *lattice) { lattice->a[2][2] = 0.0; }
static void left_handed_cell(hs_lattice *lattice) { lattice->a[2][2] = -1.0; }
static void skew(hs_lattice *lattice) { lattice->orient[0][1] = 1; }
static void left_handed(hs_lattice *lattice) { lattice->orient[2][2] = -1; }
static void null_orient(hs_lattice *lattice) { lattice->orient[1][1] = 0; }
static void far_origin(hs_lattice *lattice) { lattice->origin[1] = 1.0; }
static void nan_origin(hs_lattice *lattice) { lattice->origin[1] = NAN; }
static void no_basis(hs_lattice *lattice) { lattice->n_basis = 0; }
static void high_origin(hs_lattice *lattice) { lattice->origin[2] = 0.5; }
static void out_of_plane(hs_lattice *lattice) { lattice->a[0][2] = 0.5; }

START_TEST(test_refusals)
{
    refuse("span the volume", flat, 3);
    refuse("span the volume", left_handed_cell, 3);
    refuse("not orthogonal", skew, 3);
    refuse("right-handed", left_handed, 3);
    refuse("orientation of y is 0 0 0", null_orient, 3);
    refuse("origin's y", far_origin, 3);
    refuse("origin's y", nan_origin, 3);
    refuse("at least one 'basis", no_basis, 3);
    refuse("z must be 0", high_origin, 2);
    refuse("in the plane", out_of_plane, 2);
}
END_TEST

START_TEST(test_sizes)
{
    static const double bad[] = {0.0, -1.0, NAN};
    const double lo[3] = {0.0, 0.0, 0.0}, hi[3] = {1e300, 1.0, 1.0};
    int range_lo[3], range_hi[3];
    hs_lattice lattice;
    for (int k = 0; k < 3; ++k) {
        hs_error err = {0};
        const hs_lattice_size size = {.value = bad[k], .is_density = true, .dimension = 3};
        ck_assert_hs_ok(hs_lattice_begin(&lattice, "fcc", &err), err);
        ck_assert_int_eq(hs_lattice_finish(&lattice, &size, &err), HS_ERROR_INPUT);
        hs_lattice_fini(&lattice);
    }
    hs_error err = {0};
    make(&lattice, "fcc", 1.0, true, 3);
    ck_assert_int_eq(hs_lattice_range(&lattice, lo, hi, range_lo, range_hi, &err), HS_ERROR_INPUT);
    hs_lattice_fini(&lattice);
    ck_assert(!hs_lattice_fits_dimension("hex", 3));
    ck_assert(!hs_lattice_fits_dimension("fcc", 2));
    ck_assert(hs_lattice_fits_dimension("custom", 2));
}
END_TEST

HS_TEST_MAIN("unit.lattice", test_density, test_spacing, test_orientation, test_refusals, test_sizes)
