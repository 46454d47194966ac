/** The one loop of all fast kernels: four i-atoms against the j-clusters of a list.
 *
 *  Included by kernel/instantiate.h after the file of a pair style has defined evaluate() and N_PARAMS. The three bools
 *  are constants where it is called, so the compiler makes a kernel of its own for each combination. */

#include "kernel/accumulate.h"
#include "kernel/cluster_memory.h"

/** Sums over the pairs of one i-cluster, in vectors: minus the forces on the i-atoms, energy, virial. */
typedef struct cluster_sums {
    hs_acc f[HS_CLUSTER][3];
    hs_acc energy, virial[6];
    hs_vec peak_force, peak_energy; /**< fixed point: the largest force/r and energy */
} cluster_sums;

/** What stays the same over the list of one i-cluster. */
typedef struct cluster_constants {
    hs_vec params[HS_TABLE_PARAMS + N_PARAMS]; /**< of the only pair of types; unused by_type */
    const double *row_table[HS_CLUSTER];       /**< rows of the pair table for the four i-atoms, by_type */
    hs_place x[3][HS_CLUSTER];                 /**< of the i-atoms */
    hs_place x_listed[3][HS_CLUSTER];          /**< when the list was due; only with listed_only */
    hs_vec unit2;                              /**< square of the unit of length of differences */
    hs_real radius[HS_CLUSTER];                /**< of the i-atoms; only where the evaluator asks for them */
    hs_magic magic_force, magic_energy;
} cluster_constants;

/** virial += d F of the pairs of one vector, F = force_over_r d. */
HS_INLINE void add_virial(hs_acc virial[6], hs_vec force_over_r, hs_vec dx, hs_vec dy, hs_vec dz, hs_magic magic)
{
    const hs_vec fx = force_over_r * dx, fy = force_over_r * dy, fz = force_over_r * dz;
    hs_acc_add_product(&virial[0], dx, fx, magic);
    hs_acc_add_product(&virial[1], dy, fy, magic);
    hs_acc_add_product(&virial[2], dz, fz, magic);
    hs_acc_add_product(&virial[3], dx, fy, magic);
    hs_acc_add_product(&virial[4], dx, fz, magic);
    hs_acc_add_product(&virial[5], dy, fz, magic);
}

/** One row of one vector: i-atom `row` against the j-atoms at x_j; adds to sums and to the j-atoms' reaction. */
HS_INLINE void row_pairs(const hs_kernel_input *in, const cluster_constants *constants, int row, const hs_places x_j[3],
                         const hs_vec *params, hs_msk listed, const hs_cluster_entry *entry, int sub,
                         cluster_sums *sums, hs_acc reaction[3], bool with_energy, bool listed_only)
{
    /* from i to j, so that the i-atom's coordinate can be broadcast by the subtraction itself */
    const hs_place(*x_i)[HS_CLUSTER] = constants->x;
    const hs_vec dx = hs_apart(x_j[0], x_i[0][row]), dy = hs_apart(x_j[1], x_i[1][row]),
                 dz = hs_apart(x_j[2], x_i[2][row]);
    const hs_vec r2 = hs_in_length2(hs_fma(dz, dz, hs_fma(dy, dy, dx * dx)), constants->unit2);
    hs_msk mask = hs_mask_and(listed, hs_less(r2, params[HS_TABLE_CUT_R2]));
    const hs_vec reach = HS_HAS_RADII ? params[HS_TABLE_PARAMS + N_PARAMS] : hs_set1(0.0);
    if (HS_HAS_RADII) mask = hs_mask_and(mask, hs_less(r2, reach * reach));
    if (listed_only) {
        const hs_place(*from)[HS_CLUSTER] = constants->x_listed;
        const hs_vec lx = hs_apart(hs_load_places(hs_listed_places_of(in, 0), entry, sub), from[0][row]);
        const hs_vec ly = hs_apart(hs_load_places(hs_listed_places_of(in, 1), entry, sub), from[1][row]);
        const hs_vec lz = hs_apart(hs_load_places(hs_listed_places_of(in, 2), entry, sub), from[2][row]);
        /* rounded as in refine.c: the same pairs in both */
        const hs_vec listed_r2 = hs_in_length2(lx * lx + ly * ly + lz * lz, constants->unit2);
        mask = hs_mask_and(mask, hs_less(listed_r2, params[HS_TABLE_LISTED_R2]));
        if (HS_HAS_RADII && in->listed_by_radius) {
            const hs_vec listed_reach = reach + hs_set1(in->skin);
            mask = hs_mask_and(mask, hs_less(listed_r2, listed_reach * listed_reach));
        }
    }
    hs_vec force_over_r, energy = hs_set1(0.0);
    evaluate(params + HS_TABLE_PARAMS, r2, &force_over_r, &energy, with_energy);
    force_over_r = hs_keep(mask, force_over_r);
    hs_acc_note_peak(&sums->peak_force, force_over_r);
    const hs_acc term[3] = {hs_acc_term(force_over_r, dx, constants->magic_force),
                            hs_acc_term(force_over_r, dy, constants->magic_force),
                            hs_acc_term(force_over_r, dz, constants->magic_force)};
    for (int axis = 0; axis < 3; ++axis) {
        sums->f[row][axis] += term[axis];
        reaction[axis] += term[axis];
    }
    if (with_energy) {
        energy = hs_keep(mask, energy);
        hs_acc_note_peak(&sums->peak_energy, energy);
        hs_acc_add(&sums->energy, energy, constants->magic_energy);
        add_virial(sums->virial, force_over_r, dx, dy, dz, constants->magic_energy);
    }
}

HS_INLINE cluster_constants make_constants(const hs_kernel_input *in, int first, const bool by_type,
                                           const bool listed_only)
{
    const hs_pair_table *table = in->table;
    const int stride = HS_TABLE_PARAMS + N_PARAMS;
    cluster_constants constants = {.magic_force = hs_magic_of(in->magic_force),
                                   .magic_energy = hs_magic_of(in->magic_energy)};
    const double *values = table->values + (size_t)(table->n_types + 1) * (size_t)stride;
    for (int row = 0; row < HS_CLUSTER && by_type; ++row)
        constants.row_table[row] = table->values + (size_t)in->type[first + row] * (size_t)(table->n_types * stride);
    for (int k = 0; k < stride && !by_type; ++k) constants.params[k] = hs_set1(values[k]);
    for (int row = 0; row < HS_CLUSTER && HS_HAS_RADII; ++row) constants.radius[row] = (hs_real)in->radius[first + row];
    constants.unit2 = hs_set1(hs_length2(in));
    for (int axis = 0; axis < 3; ++axis)
        for (int row = 0; row < HS_CLUSTER; ++row) {
            constants.x[axis][row] = hs_places_of(in, axis)[first + row];
            if (listed_only) constants.x_listed[axis][row] = hs_listed_places_of(in, axis)[first + row];
        }
    return constants;
}

/** Of a set of rows: how many they are, and a 1 for each in its place of 16 bits. */
static const unsigned char n_rows[16] = {0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4};
#define PLACE(row) ((uint64_t)1 << 16 * (row))
static const uint64_t one_each[16] = {
    0,
    PLACE(0),
    PLACE(1),
    PLACE(0) + PLACE(1),
    PLACE(2),
    PLACE(0) + PLACE(2),
    PLACE(1) + PLACE(2),
    PLACE(0) + PLACE(1) + PLACE(2),
    PLACE(3),
    PLACE(0) + PLACE(3),
    PLACE(1) + PLACE(3),
    PLACE(0) + PLACE(1) + PLACE(3),
    PLACE(2) + PLACE(3),
    PLACE(0) + PLACE(2) + PLACE(3),
    PLACE(1) + PLACE(2) + PLACE(3),
    PLACE(0) + PLACE(1) + PLACE(2) + PLACE(3),
};

/** One vector of j-atoms against the i-atoms whose bits are set in `rows`. */
HS_INLINE void vector_rows(const hs_kernel_input *in, hs_kernel_output *out, const hs_cluster_entry *entry, int sub,
                           const cluster_constants *constants, cluster_sums *sums, const uint32_t rows,
                           const bool with_energy, const bool by_type, const bool listed_only)
{
    const int stride = HS_TABLE_PARAMS + N_PARAMS;
    const hs_places x_j[3] = {hs_load_places(hs_places_of(in, 0), entry, sub),
                              hs_load_places(hs_places_of(in, 1), entry, sub),
                              hs_load_places(hs_places_of(in, 2), entry, sub)};
    const hs_vec radius_j = HS_HAS_RADII ? hs_load_clusters(in->radius, 0.0, entry, sub) : hs_set1(0.0);
    const hs_masks masks = hs_masks_of(entry, sub);
    hs_acc reaction[3] = {hs_acc_zero(), hs_acc_zero(), hs_acc_zero()};
#pragma GCC unroll 4
    for (int row = 0; row < HS_CLUSTER; ++row) {
        if ((rows >> row & 1u) == 0) continue;
        hs_vec params[HS_TABLE_PARAMS + N_PARAMS + HS_HAS_RADII];
        if (HS_HAS_RADII) params[stride] = radius_j + hs_set1(constants->radius[row]);
        for (int k = 0; k < stride; ++k)
            params[k] =
                by_type ? hs_lookup(constants->row_table[row] + k, in->type, stride, entry, sub) : constants->params[k];
        row_pairs(in, constants, row, x_j, params, hs_masks_row(masks, row), entry, sub, sums, reaction, with_energy,
                  listed_only);
    }
    for (int axis = 0; axis < 3; ++axis) {
        hs_acc_settle(&reaction[axis], n_rows[rows & 0xfu], constants->magic_force);
        hs_add_reaction(out, axis, entry, sub, reaction[axis]);
    }
}

/** Groups of entries after which counts and energies are passed on: so many that sums of HS_FIXED_BITS bits fit 63. */
enum { CHUNK_MAX = 1 << (63 - HS_FIXED_BITS - 5) };

/** Element by element: compilers clear the whole struct in memory, which took a seventh of the loop. */
HS_INLINE void begin_sums(cluster_sums *sums, const bool with_energy)
{
    for (int row = 0; row < HS_CLUSTER; ++row)
        for (int axis = 0; axis < 3; ++axis) sums->f[row][axis] = hs_acc_zero();
    sums->peak_force = hs_set1(0.0);
    if (!with_energy) return;
    sums->energy = hs_acc_zero();
    for (int k = 0; k < 6; ++k) sums->virial[k] = hs_acc_zero();
    sums->peak_energy = hs_set1(0.0);
}

/** Pass on energy and virial of n terms. */
HS_INLINE void report_energy(const hs_kernel_input *in, hs_kernel_output *out, const cluster_constants *constants,
                             cluster_sums *sums, int64_t n)
{
    const double length2 = hs_length2(in);
    hs_acc_settle(&sums->energy, n, constants->magic_energy);
    for (int k = 0; k < 6; ++k) hs_acc_settle(&sums->virial[k], n, constants->magic_energy);
    hs_acc_report(out, sums->energy, sums->virial, length2);
    sums->energy = hs_acc_zero();
    for (int k = 0; k < 6; ++k) sums->virial[k] = hs_acc_zero();
}

HS_INLINE void cluster_loop(const hs_kernel_input *in, hs_kernel_output *out, int first, const hs_cluster_entry *entry,
                            int n_entries, const bool with_energy, const bool by_type, const bool listed_only)
{
    const cluster_constants constants = make_constants(in, first, by_type, listed_only);
    cluster_sums sums;
    begin_sums(&sums, with_energy);
    int64_t n_terms[HS_CLUSTER] = {0}; /* vectors that each i-atom met */
    for (int begin = 0, end; begin < n_entries; begin = end) {
        uint64_t count = 0; /* the same since begin, 16 bits for each i-atom: one addition counts for all four */
        int64_t n_new = 0;
        end = n_entries - begin > CHUNK_MAX * HS_GROUP ? begin + CHUNK_MAX * HS_GROUP : n_entries;
        for (int e = begin; e < end; e += HS_GROUP) {
            const uint32_t rows = entry[e].mask >> HS_ENTRY_ROWS_SHIFT;
            for (int sub = 0; sub < HS_SUBS; ++sub)
                vector_rows(in, out, entry + e, sub, &constants, &sums, rows, with_energy, by_type, listed_only);
            count += one_each[rows & 0xfu];
        }
        for (int row = 0; row < HS_CLUSTER; ++row) {
            const int64_t n = (int64_t)(count >> 16 * row & 0xffff) * HS_SUBS;
            n_terms[row] += n;
            n_new += n;
        }
        if (with_energy) report_energy(in, out, &constants, &sums, n_new);
    }
    for (int axis = 0; axis < 3; ++axis) {
        hs_acc of_row[HS_CLUSTER];
        for (int row = 0; row < HS_CLUSTER; ++row) {
            of_row[row] = sums.f[row][axis];
            hs_acc_settle(&of_row[row], n_terms[row], constants.magic_force);
        }
        hs_acc_subtract_rows(hs_own_forces(out, axis, first), of_row);
    }
    hs_acc_report_peak(&out->peak_force, sums.peak_force);
    if (with_energy) hs_acc_report_peak(&out->peak_energy, sums.peak_energy);
}
