/** The one loop of all fast kernels: four i-atoms against the j-clusters of a list.
 *
 *  Included by kernel/instantiate.h after the file of a pair style has defined evaluate() and N_PARAMS. The three bools
 *  are constants where it is called, so the compiler makes a kernel of its own for each combination. */

#define HS_INLINE static inline __attribute__((always_inline))

/** Sums over the pairs of one i-cluster, in vectors: minus the forces on the i-atoms, energy, virial. */
typedef struct cluster_sums {
    hs_vec f[HS_CLUSTER][3];
    hs_vec energy, virial[6];
} cluster_sums;

/** What stays the same over the list of one i-cluster. */
typedef struct cluster_constants {
    hs_vec params[HS_TABLE_PARAMS + N_PARAMS]; /**< of the only pair of types; unused by_type */
    const double *row_table[HS_CLUSTER];       /**< rows of the pair table for the four i-atoms, by_type */
    double origin[3], listed_origin[3];        /**< coordinates are relative to these in single precision */
    hs_real x[3][HS_CLUSTER];                  /**< of the i-atoms */
    hs_real x_listed[3][HS_CLUSTER];           /**< when the list was due; only with listed_only */
} cluster_constants;

/** One row of one vector: i-atom `row` against the j-atoms at x_j; adds to sums and to the j-atoms' reaction. */
HS_INLINE void row_pairs(const hs_kernel_input *in, const cluster_constants *constants, int row, const hs_vec x_j[3],
                         const hs_vec *params, hs_msk listed, const hs_cluster_entry *entry, int sub,
                         cluster_sums *sums, hs_vec reaction[3], bool with_energy, bool listed_only)
{
    /* from i to j, so that the i-atom's coordinate can be broadcast by the subtraction itself */
    const hs_real(*x_i)[HS_CLUSTER] = constants->x;
    const hs_vec dx = x_j[0] - hs_set1(x_i[0][row]), dy = x_j[1] - hs_set1(x_i[1][row]),
                 dz = x_j[2] - hs_set1(x_i[2][row]);
    const hs_vec r2 = hs_fma(dz, dz, hs_fma(dy, dy, dx * dx));
    hs_msk mask = hs_mask_and(listed, hs_less(r2, params[HS_TABLE_CUT_R2]));
    if (listed_only) {
        const double *from = constants->listed_origin;
        const hs_vec lx = hs_load_clusters(in->x_listed[0], from[0], entry, sub) - hs_set1(constants->x_listed[0][row]);
        const hs_vec ly = hs_load_clusters(in->x_listed[1], from[1], entry, sub) - hs_set1(constants->x_listed[1][row]);
        const hs_vec lz = hs_load_clusters(in->x_listed[2], from[2], entry, sub) - hs_set1(constants->x_listed[2][row]);
        const hs_vec listed_r2 = hs_fma(lz, lz, hs_fma(ly, ly, lx * lx));
        mask = hs_mask_and(mask, hs_less(listed_r2, params[HS_TABLE_LISTED_R2]));
    }
    hs_vec force_over_r, energy = hs_set1(0.0);
    evaluate(params + HS_TABLE_PARAMS, r2, &force_over_r, &energy, with_energy);
    force_over_r = hs_keep(mask, force_over_r);
    const hs_vec fx = force_over_r * dx, fy = force_over_r * dy, fz = force_over_r * dz;
    sums->f[row][0] += fx;
    sums->f[row][1] += fy;
    sums->f[row][2] += fz;
    reaction[0] += fx;
    reaction[1] += fy;
    reaction[2] += fz;
    if (with_energy) {
        sums->energy += hs_keep(mask, energy);
        sums->virial[0] = hs_fma(dx, fx, sums->virial[0]);
        sums->virial[1] = hs_fma(dy, fy, sums->virial[1]);
        sums->virial[2] = hs_fma(dz, fz, sums->virial[2]);
        sums->virial[3] = hs_fma(dx, fy, sums->virial[3]);
        sums->virial[4] = hs_fma(dx, fz, sums->virial[4]);
        sums->virial[5] = hs_fma(dy, fz, sums->virial[5]);
    }
}

HS_INLINE cluster_constants make_constants(const hs_kernel_input *in, int first, const bool by_type,
                                           const bool listed_only)
{
    const hs_pair_table *table = in->table;
    const int stride = HS_TABLE_PARAMS + N_PARAMS;
    cluster_constants constants = {.row_table = {NULL}};
    const double *values = table->values + (size_t)(table->n_types + 1) * (size_t)stride;
    for (int row = 0; row < HS_CLUSTER && by_type; ++row)
        constants.row_table[row] = table->values + (size_t)in->type[first + row] * (size_t)(table->n_types * stride);
    for (int k = 0; k < stride && !by_type; ++k) constants.params[k] = hs_set1(values[k]);
    for (int axis = 0; axis < 3; ++axis) {
        constants.origin[axis] = in->x[axis][first];
        if (listed_only) constants.listed_origin[axis] = in->x_listed[axis][first];
        for (int row = 0; row < HS_CLUSTER; ++row) {
            constants.x[axis][row] = hs_local(in->x[axis][first + row], constants.origin[axis]);
            if (listed_only)
                constants.x_listed[axis][row] =
                    hs_local(in->x_listed[axis][first + row], constants.listed_origin[axis]);
        }
    }
    return constants;
}

/** One vector of j-atoms against the i-atoms whose bits are set in `rows`. */
HS_INLINE void vector_rows(const hs_kernel_input *in, hs_kernel_output *out, const hs_cluster_entry *entry, int sub,
                           const cluster_constants *constants, cluster_sums *sums, const uint32_t rows,
                           const bool with_energy, const bool by_type, const bool listed_only)
{
    const int stride = HS_TABLE_PARAMS + N_PARAMS;
    const double *origin = constants->origin;
    const hs_vec x_j[3] = {hs_load_clusters(in->x[0], origin[0], entry, sub),
                           hs_load_clusters(in->x[1], origin[1], entry, sub),
                           hs_load_clusters(in->x[2], origin[2], entry, sub)};
    const hs_masks masks = hs_masks_of(entry, sub);
    hs_vec reaction[3] = {hs_set1(0.0), hs_set1(0.0), hs_set1(0.0)};
#pragma GCC unroll 4
    for (int row = 0; row < HS_CLUSTER; ++row) {
        if ((rows >> row & 1u) == 0) continue;
        hs_vec params[HS_TABLE_PARAMS + N_PARAMS];
        for (int k = 0; k < stride; ++k)
            params[k] =
                by_type ? hs_lookup(constants->row_table[row] + k, in->type, stride, entry, sub) : constants->params[k];
        row_pairs(in, constants, row, x_j, params, hs_masks_row(masks, row), entry, sub, sums, reaction, with_energy,
                  listed_only);
    }
    for (int axis = 0; axis < 3; ++axis) hs_add_clusters(out->f[axis], entry, sub, reaction[axis]);
}

HS_INLINE void cluster_loop(const hs_kernel_input *in, hs_kernel_output *out, int first, const hs_cluster_entry *entry,
                            int n_entries, const bool with_energy, const bool by_type, const bool listed_only)
{
    const cluster_constants constants = make_constants(in, first, by_type, listed_only);
    cluster_sums sums = {0};
    for (int e = 0; e < n_entries; e += HS_GROUP) {
        const uint32_t rows = entry[e].mask >> HS_ENTRY_ROWS_SHIFT;
        for (int sub = 0; sub < HS_SUBS; ++sub) {
            vector_rows(in, out, entry + e, sub, &constants, &sums, rows, with_energy, by_type, listed_only);
        }
    }
    for (int row = 0; row < HS_CLUSTER; ++row)
        for (int axis = 0; axis < 3; ++axis) out->f[axis][first + row] -= hs_sum(sums.f[row][axis]);
    if (with_energy) {
        out->energy += hs_sum(sums.energy);
        for (int k = 0; k < 6; ++k) out->virial[k] += hs_sum(sums.virial[k]);
    }
}
