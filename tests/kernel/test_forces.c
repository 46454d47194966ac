/* Forces, energy and virial of the neighbor methods against the slow obvious sum over all pairs and all periodic images,
 * for every instruction set of this machine, over kinds of systems where cells, halos and ragged clusters go wrong. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "comm/halo.h"
#include "kernel/cluster_list.h"
#include "kernel/verlet_list.h"
#include "parallel/parallel.h"
#include "style/pair.h"
#include "support/harness.h"

extern const hs_evaluator hs_evaluator_lj_cut;

static const double skin = 0.3;

typedef struct system {
    hs_box box;
    hs_atoms atoms;
    hs_pair_table table;
    double cutoff_max;
} system_t;

static hs_error err;

/** Deterministic numbers in [0, 1): a 64-bit LCG (Knuth's MMIX constants), enough to place atoms. */
static double next_uniform(uint64_t *state)
{
    *state = *state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (double)(*state >> 11) * 0x1p-53;
}

static void set_pair(system_t *s, int i, int j, double epsilon, double sigma, double cutoff)
{
    const double p[5] = {48 * epsilon * pow(sigma, 12), -24 * epsilon * pow(sigma, 6), 4 * epsilon * pow(sigma, 12),
                         -4 * epsilon * pow(sigma, 6), 0.1 * i};
    for (int swap = 0; swap < 2; ++swap) {
        double *row = s->table.values + (swap ? j * s->table.n_types + i : i * s->table.n_types + j) * s->table.stride;
        row[HS_TABLE_CUT_R2] = cutoff * cutoff;
        row[HS_TABLE_LISTED_R2] = (cutoff + skin) * (cutoff + skin);
        memcpy(row + HS_TABLE_PARAMS, p, sizeof p);
    }
    s->cutoff_max = fmax(s->cutoff_max, cutoff);
}

static void begin_system(system_t *s, int dimension, const double length[3], const char *boundary, int n_types)
{
    memset(s, 0, sizeof *s);
    memset(&err, 0, sizeof err);
    hs_box_init(&s->box);
    s->box.dimension = dimension;
    for (int axis = 0; axis < 3; ++axis) {
        s->box.lo[axis] = -0.3 * length[axis];
        s->box.hi[axis] = 0.7 * length[axis];
        s->box.periodic[axis] = boundary[axis] == 'p';
    }
    ck_assert_hs_ok(hs_atoms_init(&s->atoms, &err), err);
    ck_assert_hs_ok(hs_atoms_set_types(&s->atoms, n_types, &err), err);
    s->table.n_types = n_types + 1;
    s->table.stride = HS_TABLE_PARAMS + hs_evaluator_lj_cut.n_params;
    ck_assert_hs_ok(HS_ALLOC(s->table.values, (size_t)(s->table.n_types * s->table.n_types * s->table.stride), &err),
                    err);
    for (int i = 1; i <= n_types; ++i)
        for (int j = i; j <= n_types; ++j)
            set_pair(s, i, j, 1.0 / i + 0.1 * j, 1.0 + 0.05 * (i + j - 2), 2.5 - 0.2 * (j - i));
    s->table.is_uniform = hs_pair_table_is_uniform(&s->table);
}

static void end_system(system_t *s)
{
    hs_atoms_fini(&s->atoms);
    HS_FREE(s->table.values);
}

/** Distance^2 to the nearest image of any atom so far: keeps random atoms from overlapping. */
static bool is_free(const system_t *s, const double x[3], double least)
{
    for (int i = 0; i < s->atoms.n_local; ++i) {
        double r2 = 0.0;
        for (int axis = 0; axis < 3; ++axis) {
            double d = x[axis] - s->atoms.x[axis][i];
            if (s->box.periodic[axis]) d -= hs_box_length(&s->box, axis) * round(d / hs_box_length(&s->box, axis));
            r2 += d * d;
        }
        if (r2 < least * least) return false;
    }
    return true;
}

static void add_random(system_t *s, int n, double least, uint64_t seed)
{
    for (int k = 0, tries = 0; k < n && tries < 400 * n; ++tries) {
        double x[3];
        for (int axis = 0; axis < 3; ++axis)
            x[axis] = s->box.lo[axis] + next_uniform(&seed) * hs_box_length(&s->box, axis);
        if (s->box.dimension == 2) x[2] = 0.0;
        if (!is_free(s, x, least)) continue;
        ++k;
        ck_assert_hs_ok(hs_atoms_add(&s->atoms, k, 1 + (int)(next_uniform(&seed) * s->atoms.n_types), x, &err), err);
    }
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

/** Result of an evaluation, by atom id - 1. */
typedef struct forces {
    double *f[3];
    double energy, virial[6];
    double largest_pair; /**< largest force of one pair: the scale of rounding errors; only from sum_all_images */
} forces_t;

static forces_t make_forces(int n)
{
    forces_t out = {.energy = 0.0};
    for (int axis = 0; axis < 3; ++axis) ck_assert_hs_ok(HS_ALLOC(out.f[axis], (size_t)n, &err), err);
    return out;
}

static void free_forces(forces_t *forces)
{
    for (int axis = 0; axis < 3; ++axis) HS_FREE(forces->f[axis]);
}

static void add_image_pair(const system_t *s, forces_t *out, int i, int j, const double shift[3])
{
    const double *row = s->table.values + (s->atoms.type[i] * s->table.n_types + s->atoms.type[j]) * s->table.stride;
    double d[3], r2 = 0.0, over_r, energy;
    for (int axis = 0; axis < 3; ++axis) {
        d[axis] = s->atoms.x[axis][i] - s->atoms.x[axis][j] - shift[axis];
        r2 += d[axis] * d[axis];
    }
    if (r2 >= row[HS_TABLE_CUT_R2] || r2 == 0.0) return;
    hs_evaluator_lj_cut.single(row + HS_TABLE_PARAMS, r2, &over_r, &energy);
    static const int first[6] = {0, 1, 2, 0, 0, 1}, second[6] = {0, 1, 2, 1, 2, 2};
    for (int axis = 0; axis < 3; ++axis) out->f[axis][s->atoms.id[i] - 1] += over_r * d[axis];
    out->largest_pair = fmax(out->largest_pair, fabs(over_r) * sqrt(r2));
    out->energy += 0.5 * energy; /* ordered pairs: each is met from both sides */
    for (int k = 0; k < 6; ++k) out->virial[k] += 0.5 * d[first[k]] * over_r * d[second[k]];
}

/** The oracle: ordered pairs, all images, nothing clever. */
static forces_t sum_all_images(const system_t *s)
{
    forces_t out = make_forces(s->atoms.n_local);
    int m[3];
    for (int axis = 0; axis < 3; ++axis)
        m[axis] = s->box.periodic[axis] && axis < s->box.dimension
                      ? (int)ceil(s->cutoff_max / hs_box_length(&s->box, axis))
                      : 0;
    for (int i = 0; i < s->atoms.n_local; ++i)
        for (int j = 0; j < s->atoms.n_local; ++j)
            for (int a = -m[0]; a <= m[0]; ++a)
                for (int b = -m[1]; b <= m[1]; ++b)
                    for (int c = -m[2]; c <= m[2]; ++c) {
                        const double shift[3] = {a * hs_box_length(&s->box, 0), b * hs_box_length(&s->box, 1),
                                                 c * hs_box_length(&s->box, 2)};
                        if (i != j || a != 0 || b != 0 || c != 0) add_image_pair(s, &out, i, j, shift);
                    }
    return out;
}

typedef enum { NSQ, CELL, VERLET, CLUSTER, N_METHODS } method_t;
static const char *const method_names[] = {"nsq", "cell", "verlet", "cluster"};

static forces_t evaluate_with(system_t *s, method_t method, hs_isa isa, hs_precision precision, bool with_energy)
{
    const bool is_nsq = method == NSQ;
    const double reach = s->cutoff_max + (method == CLUSTER || method == VERLET ? skin : 0.0);
    hs_cluster_list list = {0};
    hs_verlet_list verlet = {0};
    hs_cells cells = {0};
    hs_clusters clusters = {0};
    hs_halo halo = {0};
    hs_domain domain;
    const hs_parallel one_rank = {.n_ranks = 1};
    hs_force_space space = {0};
    hs_force_result result;
    hs_atoms *atoms = &s->atoms;
    if (!is_nsq) {
        const double density = atoms->n_local / hs_box_volume(&s->box);
        ck_assert_hs_ok(hs_cells_set_grid(&cells, s->box.lo, s->box.hi, s->box.dimension, reach,
                                          hs_clusters_width(s->box.dimension, density, reach), atoms->n_local, &err),
                        err);
        ck_assert_hs_ok(hs_cells_sort_local(&cells, atoms, &err), err);
        ck_assert_hs_ok(hs_atoms_permute(atoms, cells.order, &err), err);
    }
    hs_domain_init(&domain, &one_rank);
    ck_assert_hs_ok(hs_domain_divide(&domain, &s->box, &err), err);
    ck_assert_hs_ok(hs_halo_build(&halo, &domain, &one_rank, &s->box, atoms, reach, &err), err);
    if (!is_nsq) {
        ck_assert_hs_ok(hs_cells_sort_halo(&cells, atoms, &err), err);
        hs_halo_reorder(&halo, atoms, cells.order);
    }
    hs_halo_forward_fields(&halo, atoms);
    if (!is_nsq) {
        ck_assert_hs_ok(hs_clusters_build(&clusters, &cells, atoms, &err), err);
    }
    hs_force_job job = {
        .atoms = atoms,
        .cells = &cells,
        .clusters = &clusters,
        .evaluator = &hs_evaluator_lj_cut,
        .isa = isa,
        .precision = precision,
        .cutoff_max = reach,
        .with_energy = with_energy,
        .input = {.x = {atoms->x[0], atoms->x[1], atoms->x[2]}, .type = atoms->type, .table = &s->table}};
    if (method == CLUSTER) {
        ck_assert_hs_ok(hs_cluster_list_build(&list, &space, &job, &err), err);
        ck_assert_hs_ok(hs_force_cluster(&space, &list, &job, &result, &err), err);
    } else if (method == VERLET) {
        ck_assert_hs_ok(hs_verlet_list_build(&verlet, &space, &job, &err), err);
        ck_assert_hs_ok(hs_force_verlet(&space, &verlet, &job, &result, &err), err);
    } else {
        ck_assert_hs_ok((is_nsq ? hs_force_nsq : hs_force_cell)(&space, &job, &result, &err), err);
    }
    hs_halo_reverse(&halo, atoms);
    forces_t out = make_forces(atoms->n_local);
    for (int i = 0; i < atoms->n_local; ++i)
        for (int axis = 0; axis < 3; ++axis) out.f[axis][atoms->id[i] - 1] = atoms->f[axis][i];
    out.energy = result.energy;
    memcpy(out.virial, result.virial, sizeof out.virial);
    hs_cluster_list_fini(&list);
    hs_verlet_list_fini(&verlet);
    hs_force_space_fini(&space);
    hs_halo_fini(&halo);
    hs_domain_fini(&domain);
    hs_clusters_fini(&clusters);
    hs_cells_fini(&cells);
    return out;
}

/** Relative to the largest pair force. Double: a force is a sum of at most some hundred terms, none larger than that, each
 *  with a relative error of some epsilon (2.2e-16) from r^-14 and from x_i - x_j. Mixed: coordinates up to 6 from the origin
 *  are rounded to 2.4e-7 (half a unit of float there), which r^-14 turns into 14 * 2.4e-7 / 0.8 = 4e-6 a pair, with some ten
 *  near pairs, and as much again from float arithmetic. */
static const double tolerances[HS_N_PRECISIONS] = {1e-12, 4e-5};

static void assert_same(const forces_t *a, const forces_t *b, int n, bool with_energy, hs_precision precision,
                        const char *what)
{
    const double tolerance = tolerances[precision];
    const double scale = fmax(b->largest_pair, 1e-300);
    double sum[3] = {0}, virial_scale = 1e-300;
    for (int i = 0; i < n; ++i)
        for (int axis = 0; axis < 3; ++axis) sum[axis] += a->f[axis][i];
    for (int i = 0; i < n; ++i)
        for (int axis = 0; axis < 3; ++axis)
            ck_assert_msg(fabs(a->f[axis][i] - b->f[axis][i]) <= tolerance * scale,
                          "%s: force %c of atom %d: %.17g, not %.17g", what, "xyz"[axis], i + 1, a->f[axis][i],
                          b->f[axis][i]);
    for (int axis = 0; axis < 3; ++axis)
        ck_assert_msg(fabs(sum[axis]) <= 0.1 * tolerance * scale * (n + 1), "%s: forces sum to %g along %c", what,
                      sum[axis], "xyz"[axis]);
    if (!with_energy) return;
    for (int k = 0; k < 6; ++k) virial_scale = fmax(virial_scale, fabs(b->virial[k]));
    ck_assert_msg(fabs(a->energy - b->energy) <= tolerance * (fabs(b->energy) + n), "%s: energy %.17g, not %.17g", what,
                  a->energy, b->energy);
    for (int k = 0; k < 6; ++k)
        ck_assert_msg(fabs(a->virial[k] - b->virial[k]) <= tolerance * (virial_scale + n * scale),
                      "%s: virial %d %.17g, not %.17g", what, k, a->virial[k], b->virial[k]);
}

static void check_all_methods(system_t *s, const char *what)
{
    const int n = s->atoms.n_local;
    forces_t right = sum_all_images(s);
    char name[160];
    for (int threads = 1; threads <= 3; ++threads) {
        hs_threads_set(threads);
        forces_t nsq = evaluate_with(s, NSQ, HS_ISA_PORTABLE, HS_PRECISION_DOUBLE, true);
        snprintf(name, sizeof name, "%s, nsq, %d threads", what, threads);
        assert_same(&nsq, &right, n, true, HS_PRECISION_DOUBLE, name);
        free_forces(&nsq);
        for (int kind = 0; kind < 3 * 2 * 2 * ((int)hs_isa_best() + 1); ++kind) {
            const method_t method = (method_t)(CELL + kind % 3);
            const bool with_energy = kind / 3 % 2;
            const hs_precision precision = kind / 6 % 2 ? HS_PRECISION_MIXED : HS_PRECISION_DOUBLE;
            const hs_isa isa = (hs_isa)(kind / 12);
            forces_t fast = evaluate_with(s, method, isa, precision, with_energy);
            snprintf(name, sizeof name, "%s, %s, %s, %s, %d threads, energy %d", what, method_names[method],
                     hs_isa_names[isa], hs_precision_names[precision], threads, with_energy);
            assert_same(&fast, &right, n, with_energy, precision, name);
            free_forces(&fast);
        }
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

START_TEST(mixed_precision_is_within_1e_5_rms)
{
    system_t s;
    begin_system(&s, 3, (const double[]){40.0, 9.0, 9.0}, "ppp", 1); /* long: coordinates are large in x */
    add_random(&s, 2300, 0.88, 7);
    forces_t right = evaluate_with(&s, CLUSTER, hs_isa_best(), HS_PRECISION_DOUBLE, false);
    for (int isa = 0; isa <= (int)hs_isa_best(); ++isa) {
        forces_t mixed = evaluate_with(&s, CLUSTER, (hs_isa)isa, HS_PRECISION_MIXED, false);
        double error2 = 0.0, force2 = 0.0;
        for (int i = 0; i < s.atoms.n_local; ++i)
            for (int axis = 0; axis < 3; ++axis) {
                error2 += pow(mixed.f[axis][i] - right.f[axis][i], 2.0);
                force2 += pow(right.f[axis][i], 2.0);
            }
        printf("mixed precision, %s: relative RMS error of forces %.2e\n", hs_isa_names[isa], sqrt(error2 / force2));
        ck_assert_msg(error2 < 1e-10 * force2, "%s: relative RMS error %g", hs_isa_names[isa], sqrt(error2 / force2));
        free_forces(&mixed);
    }
    free_forces(&right);
    end_system(&s);
}
END_TEST

START_TEST(lj_values)
{
    const double p[5] = {48.0, -24.0, 4.0, -4.0, 0.0};
    double over_r, energy;
    hs_evaluator_lj_cut.single(p, 1.0, &over_r, &energy);
    ck_assert_double_eq_tol(over_r, 24.0, 1e-13);
    ck_assert_double_eq_tol(energy, 0.0, 1e-13);
    hs_evaluator_lj_cut.single(p, cbrt(2.0), &over_r, &energy);
    ck_assert_double_eq_tol(over_r, 0.0, 1e-13);
    ck_assert_double_eq_tol(energy, -1.0, 1e-13);
}
END_TEST

HS_TEST_MAIN("forces", random_liquid, random_gas, crystal, fewer_than_three_cells, smaller_than_the_cutoff,
             one_and_no_atom, long_and_flat, force_is_minus_gradient_of_energy, mixed_precision_is_within_1e_5_rms,
             lj_values)
