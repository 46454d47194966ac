/** Systems of atoms for kernel tests, their forces by the neighbor methods, and by the slow obvious sum over all pairs
 *  and all periodic images. */
#ifndef HS_TESTS_PAIR_SYSTEM_H
#define HS_TESTS_PAIR_SYSTEM_H

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "comm/halo.h"
#include "kernel/cluster_list.h"
#include "kernel/pair_histogram.h"
#include "kernel/verlet_list.h"
#include "parallel/parallel.h"
#include "style/pair.h"
#include "support/harness.h"

static const double skin = 0.3;

typedef struct system {
    const hs_evaluator *evaluator;
    hs_box box;
    hs_atoms atoms;
    hs_pair_table table;
    double cutoff_max;
    double *radius; /**< atom field; NULL unless the evaluator needs radii */
} system_t;

static hs_error err;

/** Deterministic numbers in [0, 1): a 64-bit LCG (Knuth's MMIX constants), enough to place atoms. */
static double next_uniform(uint64_t *state)
{
    *state = *state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (double)(*state >> 11) * 0x1p-53;
}

/** A box without atoms whose table has room for the parameters of the evaluator, all zero. */
static void begin_box(system_t *s, const hs_evaluator *evaluator, int dimension, const double length[3],
                      const char *boundary, int n_types)
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
    s->evaluator = evaluator;
    if (evaluator->has_radii)
        ck_assert_hs_ok(hs_atoms_add_field(&s->atoms, "radius", (void **)&s->radius, sizeof *s->radius, true, &err),
                        err);
    s->table.n_types = n_types + 1;
    s->table.stride = HS_TABLE_PARAMS + evaluator->n_params;
    ck_assert_hs_ok(HS_ALLOC(s->table.values, (size_t)(s->table.n_types * s->table.n_types * s->table.stride), &err),
                    err);
}

/** Parameters and cutoff of a pair of types. */
static void set_row(system_t *s, int i, int j, double cutoff, const double *p)
{
    for (int swap = 0; swap < 2; ++swap) {
        double *row = s->table.values + (swap ? j * s->table.n_types + i : i * s->table.n_types + j) * s->table.stride;
        row[HS_TABLE_CUT_R2] = cutoff * cutoff;
        row[HS_TABLE_LISTED_R2] = (cutoff + skin) * (cutoff + skin);
        memcpy(row + HS_TABLE_PARAMS, p, (size_t)s->evaluator->n_params * sizeof *p);
    }
    s->cutoff_max = fmax(s->cutoff_max, cutoff);
}

static void end_system(system_t *s)
{
    if (s->radius != NULL) hs_atoms_remove_field(&s->atoms, (void **)&s->radius);
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
    double d[3], r2 = 0.0, over_r, energy;
    for (int axis = 0; axis < 3; ++axis) {
        d[axis] = s->atoms.x[axis][i] - s->atoms.x[axis][j] - shift[axis];
        r2 += d[axis] * d[axis];
    }
    const double sum_of_radii = s->radius != NULL ? s->radius[i] + s->radius[j] : 0.0;
    if (r2 == 0.0 || !hs_evaluator_pair(s->evaluator, &s->table, s->atoms.type[i], s->atoms.type[j], sum_of_radii, r2,
                                        &over_r, &energy))
        return;
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

/* GATHERED: method verlet with the machine's own gather instructions, where there are kernels that use them. IN_TURN: method cluster
   with rows in turn, where there are kernels that do so. */
typedef enum { NSQ, CELL, VERLET, GATHERED, CLUSTER, IN_TURN, N_METHODS } method_t;
static const char *const form_names[HS_N_PRECISIONS] = {"double", "mixed", "fixed point"};
static const char *const method_names[] = {"nsq", "cell", "verlet", "verlet, gathered", "cluster"};

/** The grid for forces and energies as large as those of an evaluation. */
static hs_fixed_grid finest_grid(const system_t *s, const hs_force_result *result)
{
    const double force = result->peak_force * s->cutoff_max;
    const double energy = fmax(force * s->cutoff_max, result->peak_energy);
    return (hs_fixed_grid){hs_fixed_exponent(force, HS_FIXED_BITS), hs_fixed_exponent(energy, HS_FIXED_BITS)};
}

/** Distances of pairs, counted by the kernels. */
typedef struct counting {
    hs_pair_counter counter;    /**< set its r_max and n_bins */
    int64_t *on_the_way, *anew; /**< owned [n_bins]: with the forces; by a pass over the list afterwards */
} counting_t;

static void count_anew(counting_t *counting, const hs_force_job *job, const hs_cluster_list *list)
{
    hs_pair_counter *counter = &counting->counter;
    hs_pair_counter_get(counter, counting->on_the_way);
    ck_assert_hs_ok(hs_pair_counter_list(counter, list, job->clusters, job->atoms->x, job->isa, &err), err);
    hs_pair_counter_get(counter, counting->anew);
}

/** @p counting: count distances, too (method cluster); NULL: do not. */
static forces_t evaluate_counting(system_t *s, method_t method, hs_isa isa, hs_precision precision, bool with_energy,
                                  counting_t *counting)
{
    const bool is_nsq = method == NSQ, is_verlet = method == VERLET || method == GATHERED,
               is_cluster = method == CLUSTER || method == IN_TURN;
    const double reach = s->cutoff_max + (is_cluster || is_verlet ? skin : 0.0);
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
        ck_assert_hs_ok(hs_atoms_permute(atoms, cells.sort.order, &err), err);
    }
    hs_domain_init(&domain, &one_rank);
    ck_assert_hs_ok(hs_domain_divide(&domain, &s->box, &err), err);
    ck_assert_hs_ok(hs_halo_build(&halo, &domain, &one_rank, &s->box, atoms, reach, &err), err);
    if (!is_nsq) {
        ck_assert_hs_ok(hs_cells_sort_halo(&cells, atoms, &err), err);
        hs_halo_reorder(&halo, atoms, cells.sort.order);
    }
    hs_halo_forward_fields(&halo, atoms);
    if (!is_nsq) {
        ck_assert_hs_ok(hs_clusters_build(&clusters, &cells, atoms, &err), err);
    }
    hs_force_job job = {.atoms = atoms,
                        .cells = &cells,
                        .clusters = &clusters,
                        .evaluator = s->evaluator,
                        .isa = isa,
                        .precision = precision,
                        .cutoff_max = reach,
                        .with_energy = with_energy,
                        .input = {.x = {atoms->x[0], atoms->x[1], atoms->x[2]},
                                  .type = atoms->type,
                                  .radius = s->radius,
                                  .listed_by_radius = s->radius != NULL,
                                  .skin = skin,
                                  .gathers = method == GATHERED,
                                  .looks_far = method == IN_TURN,
                                  .table = &s->table}};
    if (is_cluster) ck_assert_hs_ok(hs_cluster_list_build(&list, &space, &job, &err), err);
    if (is_verlet) ck_assert_hs_ok(hs_verlet_list_build(&verlet, &space, &job, &err), err);
    if (counting != NULL) {
        job.counter = &counting->counter;
        ck_assert(hs_force_can_count(&job, counting->counter.r_max));
    }
    const bool is_fixed = precision == HS_PRECISION_FIXED;
    hs_fixed_grid grid = {-20, -20}; /* coarse: to learn how large forces and energies are */
    for (int pass = 0; pass < (is_fixed ? 2 : 1); ++pass) {
        if (is_fixed) hs_force_job_set_grid(&job, grid);
        if (is_fixed)
            ck_assert_hs_ok(hs_force_find_open(&space, atoms->n_local, halo.source, halo.out.n, halo.version, &err),
                            err);
        if (pass == 1) job.settling_unit = ldexp(1.0, grid.force);
        if (is_cluster)
            ck_assert_hs_ok(hs_force_cluster(&space, &list, &job, &result, &err), err);
        else if (is_verlet)
            ck_assert_hs_ok(hs_force_verlet(&space, &verlet, &job, &result, &err), err);
        else
            ck_assert_hs_ok((is_nsq ? hs_force_nsq : hs_force_cell)(&space, &job, &result, &err), err);
        if (pass == 0) grid = finest_grid(s, &result);
    }
    if (counting != NULL) count_anew(counting, &job, &list);
    hs_halo_reverse(&halo, atoms, is_fixed);
    if (is_fixed) {
        hs_force_settle(&space, atoms, job.isa, grid.force, false);
        result.energy = ldexp((double)result.energy_fixed, grid.energy);
        for (int k = 0; k < 6; ++k) result.virial[k] = ldexp((double)result.virial_fixed[k], grid.energy);
    }
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

static forces_t evaluate_with(system_t *s, method_t method, hs_isa isa, hs_precision precision, bool with_energy)
{
    return evaluate_counting(s, method, isa, precision, with_energy, NULL);
}

/** Forces, energy and virial within the tolerance, relative to the largest force of one pair (energy: to the sum and
 *  n); forces that sum to zero. */
static void assert_same(const forces_t *a, const forces_t *b, int n, bool with_energy, double tolerance,
                        const char *what)
{
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

#endif
