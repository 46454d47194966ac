/* Forces, energy and virial of the neighbor methods against the slow obvious sum over all pairs and all periodic
 * images, for every instruction set of this machine, over kinds of systems where cells, halos and ragged clusters go
 * wrong. */
#include "kernel/pair_system.h"

extern const hs_evaluator hs_evaluator_lj_cut;

static void set_pair(system_t *s, int i, int j, double epsilon, double sigma, double cutoff)
{
    const double p[5] = {48 * epsilon * pow(sigma, 12), -24 * epsilon * pow(sigma, 6), 4 * epsilon * pow(sigma, 12),
                         -4 * epsilon * pow(sigma, 6), 0.1 * i};
    set_row(s, i, j, cutoff, p);
}

static void begin_system(system_t *s, int dimension, const double length[3], const char *boundary, int n_types)
{
    begin_box(s, &hs_evaluator_lj_cut, dimension, length, boundary, n_types);
    for (int i = 1; i <= n_types; ++i)
        for (int j = i; j <= n_types; ++j)
            set_pair(s, i, j, 1.0 / i + 0.1 * j, 1.0 + 0.05 * (i + j - 2), 2.5 - 0.2 * (j - i));
    s->table.is_uniform = hs_pair_table_is_uniform(&s->table);
}

static void add_lattice(system_t *s, const int n[3])
{
    for (int a = 0; a < n[0]; ++a)
        for (int b = 0; b < n[1]; ++b)
            for (int c = 0; c < n[2]; ++c) {
                const int k[3] = {a, b, c};
                double x[3];
                for (int axis = 0; axis < 3; ++axis)
                    x[axis] = s->box.dimension == 2 && axis == 2
                                  ? 0.0
                                  : s->box.lo[axis] + hs_box_length(&s->box, axis) * k[axis] / n[axis];
                ck_assert_hs_ok(
                    hs_atoms_add(&s->atoms, s->atoms.n_local + 1, 1 + (a + b + c) % s->atoms.n_types, x, &err), err);
            }
}

/** Relative to the largest pair force. Double: a force is a sum of at most some hundred terms, none larger than that,
 *  each with a relative error of some epsilon (2.2e-16) from r^-14 and from x_i - x_j. Mixed: coordinates up to 6 from
 *  the origin are rounded to 2.4e-7 (half a unit of float there), which r^-14 turns into 14 * 2.4e-7 / 0.8 = 4e-6 a
 *  pair, with some ten near pairs, and as much again from float arithmetic. Fixed point: 50 bits for the largest pair,
 *  as good as double. */
static const double tolerances[HS_N_PRECISIONS] = {1e-12, 4e-5, 1e-12};

static void check_all_methods(system_t *s, const char *what)
{
    const int n = s->atoms.n_local;
    forces_t right = sum_all_images(s);
    char name[160];
    /* Every method, instruction set, precision and kind of sum in every system; the number of threads goes round, so that
       each of these meets each number in a third of the systems. */
    static int n_systems = 0;
    ++n_systems;
    for (int kind = -3; kind < 3 * 2 * HS_N_PRECISIONS * ((int)hs_isa_best() + 1); ++kind) {
        const method_t method = kind < 0 ? NSQ : (method_t)(CELL + kind % 3);
        const bool with_energy = kind < 0 || kind / 3 % 2;
        const hs_precision precision = (hs_precision)(kind < 0 ? HS_PRECISION_DOUBLE : kind / 6 % HS_N_PRECISIONS);
        const hs_isa isa = kind < 0 ? HS_ISA_PORTABLE : (hs_isa)(kind / (6 * HS_N_PRECISIONS));
        const int threads = 1 + (kind + 3 + kind / 3 + n_systems) % 3;
        hs_threads_set(threads);
        forces_t given = evaluate_with(s, method, isa, precision, with_energy);
        snprintf(name, sizeof name, "%s, %s, %s, %s, %d threads, energy %d", what, method_names[method],
                 hs_isa_names[isa], form_names[precision], threads, with_energy);
        assert_same(&given, &right, n, with_energy, tolerances[precision], name);
        free_forces(&given);
    }
    free_forces(&right);
}

/** One system per combination of dimension, boundary and number of types. */
static void check_family(const char *kind, const double length_3d[3], int n, double least, bool on_lattice)
{
    static const char *const boundaries[] = {"ppp", "fff", "pfp", "fpp"};
    for (int dimension = 2; dimension <= 3; ++dimension)
        for (int b = 0; b < 4; ++b)
            for (int n_types = 1; n_types <= 3; n_types += 2) {
                system_t s;
                double length[3] = {length_3d[0], length_3d[1], dimension == 2 ? 1.0 : length_3d[2]};
                char boundary[4], what[120];
                memcpy(boundary, boundaries[b], sizeof boundary);
                if (dimension == 2) boundary[2] = 'p';
                begin_system(&s, dimension, length, boundary, n_types);
                const int side = (int)round(dimension == 2 ? sqrt(n) : cbrt(n));
                if (on_lattice)
                    add_lattice(&s, (const int[3]){side, side, dimension == 2 ? 1 : side});
                else
                    add_random(&s, n, least, 12345 + (uint64_t)b);
                snprintf(what, sizeof what, "%s, %dD, %s, %d types, %d atoms", kind, dimension, boundary, n_types,
                         s.atoms.n_local);
                check_all_methods(&s, what);
                end_system(&s);
            }
}

START_TEST(random_liquid) { check_family("random", (const double[]){9.0, 8.1, 7.7}, 380, 0.85, false); }
END_TEST
START_TEST(random_gas) { check_family("gas", (const double[]){30.0, 41.0, 27.0}, 120, 0.85, false); }
END_TEST
START_TEST(crystal) { check_family("lattice", (const double[]){7.6, 7.7, 7.8}, 343, 0.0, true); }
END_TEST
START_TEST(fewer_than_three_cells) { check_family("tiny", (const double[]){3.1, 4.0, 5.2}, 30, 0.8, false); }
END_TEST
START_TEST(smaller_than_the_cutoff)
{
    check_family("smaller than the cutoff", (const double[]){1.3, 1.9, 2.3}, 3, 0.8, false);
}
END_TEST
START_TEST(one_and_no_atom)
{
    check_family("one atom", (const double[]){2.0, 6.0, 3.0}, 1, 0.0, false);
    check_family("empty", (const double[]){5.0, 6.0, 7.0}, 0, 0.0, false);
}
END_TEST
START_TEST(long_and_flat) { check_family("long", (const double[]){2.6, 60.0, 3.0}, 200, 0.85, false); }
END_TEST

START_TEST(force_is_minus_gradient_of_energy)
{
    system_t s;
    begin_system(&s, 3, (const double[]){6.0, 6.5, 7.0}, "ppp", 2);
    add_random(&s, 120, 0.9, 99);
    const double h = 1e-5;
    for (int axis = 0; axis < 3; ++axis) {
        forces_t at = evaluate_with(&s, CLUSTER, hs_isa_best(), HS_PRECISION_DOUBLE, true);
        int i = 0;
        while (s.atoms.id[i] != 17) ++i;
        const double x = s.atoms.x[axis][i];
        double energy[2];
        for (int side = 0; side < 2; ++side) {
            for (i = 0; s.atoms.id[i] != 17;) ++i;
            s.atoms.x[axis][i] = x + (side ? h : -h);
            forces_t moved = evaluate_with(&s, CLUSTER, hs_isa_best(), HS_PRECISION_DOUBLE, true);
            energy[side] = moved.energy;
            free_forces(&moved);
        }
        for (i = 0; s.atoms.id[i] != 17;) ++i;
        s.atoms.x[axis][i] = x;
        /* central difference: truncation h^2 U''' / 6 with U''' below 1e5 near r = 0.9, rounding |U| eps / h */
        ck_assert_double_eq_tol(at.f[axis][16], -(energy[1] - energy[0]) / (2.0 * h), 2e-5);
        free_forces(&at);
    }
    end_system(&s);
}
END_TEST

/** Relative RMS error of the forces in mixed precision. */
static double mixed_error(system_t *s, method_t method, hs_isa isa, const forces_t *right)
{
    forces_t mixed = evaluate_with(s, method, isa, HS_PRECISION_MIXED, false);
    double error2 = 0.0, force2 = 0.0;
    for (int i = 0; i < s->atoms.n_local; ++i)
        for (int axis = 0; axis < 3; ++axis) {
            error2 += pow(mixed.f[axis][i] - right->f[axis][i], 2.0);
            force2 += pow(right->f[axis][i], 2.0);
        }
    free_forces(&mixed);
    return sqrt(error2 / force2);
}

/* The larger gap makes coordinates a thousand times as large, and the error no larger. */
static void check_mixed(double gap)
{
    system_t s;
    begin_system(&s, 3, (const double[]){40.0, 9.0, 9.0}, "ppp", 1);
    add_random(&s, 2300, 0.88, 7);
    const double middle = 0.5 * (s.box.lo[0] + s.box.hi[0]);
    for (int i = 0; i < s.atoms.n_local; ++i) s.atoms.x[0][i] += s.atoms.x[0][i] > middle ? gap : 0.0;
    s.box.hi[0] += gap;
    forces_t right = evaluate_with(&s, CLUSTER, hs_isa_best(), HS_PRECISION_DOUBLE, false);
    for (int method = CELL; method < N_METHODS; ++method)
        for (int isa = 0; isa <= (int)hs_isa_best(); ++isa) {
            const double error = mixed_error(&s, (method_t)method, (hs_isa)isa, &right);
            /* coordinates, up to 5 from the i-cluster's first atom, are floats: an error of at most 2.4e-7, of which r^-14
               makes 14 / 0.9 times as much, 4e-6; the RMS is less, but reaction and sums add their roundings */
            ck_assert_msg(error < 4e-6, "%s, %s: relative RMS error of forces %.2e", method_names[method],
                          hs_isa_names[isa], error);
        }
    free_forces(&right);
    end_system(&s);
}

START_TEST(mixed_precision_in_boxes_of_any_length)
{
    check_mixed(0.0);
    check_mixed(40000.0);
}
END_TEST

START_TEST(lj_values)
{
    const double p[5] = {48.0, -24.0, 4.0, -4.0, 0.0};
    double over_r, energy;
    hs_evaluator_lj_cut.single(p, NULL, 1.0, &over_r, &energy);
    ck_assert_double_eq_tol(over_r, 24.0, 1e-13);
    ck_assert_double_eq_tol(energy, 0.0, 1e-13);
    hs_evaluator_lj_cut.single(p, NULL, cbrt(2.0), &over_r, &energy);
    ck_assert_double_eq_tol(over_r, 0.0, 1e-13);
    ck_assert_double_eq_tol(energy, -1.0, 1e-13);
}
END_TEST

HS_TEST_MAIN("forces", random_liquid, random_gas, crystal, fewer_than_three_cells, smaller_than_the_cutoff,
             one_and_no_atom, long_and_flat, force_is_minus_gradient_of_energy, mixed_precision_in_boxes_of_any_length,
             lj_values)
