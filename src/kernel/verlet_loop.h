/** The loop of method `verlet`: each i-atom against its own list of j-atoms, HS_LANES of them at a time.
 *
 *  Included by kernel/instantiate.h after kernel/cluster_loop.h. The two bools are constants where it is called, so the
 *  compiler makes a kernel of its own for each combination. */

/** Sums over the pairs of one i-atom, in vectors: minus the force on it, energy, virial. */
typedef struct verlet_sums {
    hs_vec f[3];
    hs_vec energy, virial[6];
} verlet_sums;

/** What stays the same over the list of one i-atom. */
typedef struct verlet_atom {
    double x[3];             /**< coordinates are relative to these in single precision */
    hs_vec x_local[3];       /**< its own, as kernels use it, in all lanes */
    const double *row_table; /**< its row of the pair table, by_type */
} verlet_atom;

/** The parameters of the pairs of one vector. */
HS_INLINE void verlet_params(const hs_kernel_input *in, const verlet_atom *atom, const int32_t *j, hs_vec *params)
{
    const int stride = HS_TABLE_PARAMS + N_PARAMS;
    int32_t row[HS_LANES];
    for (int k = 0; k < HS_LANES; ++k) row[k] = stride * in->type[j[k]];
    for (int k = 0; k < stride; ++k) params[k] = hs_gather(atom->row_table + k, 0.0, row);
}

/** One vector of j-atoms, of which the first n count; is_full: all do. */
HS_INLINE void verlet_vector(const hs_kernel_input *in, hs_kernel_output *out, const verlet_atom *atom,
                             const int32_t *j, int n, const hs_vec *only, verlet_sums *sums, const bool is_full,
                             const bool with_energy, const bool by_type)
{
    hs_vec params[HS_TABLE_PARAMS + N_PARAMS];
    for (int k = 0; k < HS_TABLE_PARAMS + N_PARAMS && !by_type; ++k) params[k] = only[k];
    if (by_type) verlet_params(in, atom, j, params);
    const hs_vec dx = hs_gather(in->x[0], atom->x[0], j) - atom->x_local[0];
    const hs_vec dy = hs_gather(in->x[1], atom->x[1], j) - atom->x_local[1];
    const hs_vec dz = hs_gather(in->x[2], atom->x[2], j) - atom->x_local[2];
    const hs_vec r2 = hs_fma(dz, dz, hs_fma(dy, dy, dx * dx));
    const hs_msk near = hs_less(r2, params[HS_TABLE_CUT_R2]);
    const hs_msk mask = is_full ? near : hs_mask_and(hs_first_lanes(n), near);
    hs_vec force_over_r, energy = hs_set1(0.0);
    evaluate(params + HS_TABLE_PARAMS, r2, &force_over_r, &energy, with_energy);
    force_over_r = hs_keep(mask, force_over_r);
    const hs_vec fx = force_over_r * dx, fy = force_over_r * dy, fz = force_over_r * dz;
    sums->f[0] += fx;
    sums->f[1] += fy;
    sums->f[2] += fz;
    hs_scatter_add(out->f[0], j, fx);
    hs_scatter_add(out->f[1], j, fy);
    hs_scatter_add(out->f[2], j, fz);
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

HS_INLINE void verlet_loop(const hs_kernel_input *in, hs_kernel_output *out, int begin, int end, const int64_t *start,
                           const int32_t *list, const bool with_energy, const bool by_type)
{
    const hs_pair_table *table = in->table;
    const int stride = HS_TABLE_PARAMS + N_PARAMS;
    hs_vec only[HS_TABLE_PARAMS + N_PARAMS];
    for (int k = 0; k < stride && !by_type; ++k)
        only[k] = hs_set1(table->values[(size_t)(table->n_types + 1) * (size_t)stride + (size_t)k]);
    for (int i = begin; i < end; ++i) {
        int64_t at = start[i - begin];
        const int64_t stop = start[i - begin + 1];
        if (at == stop) continue;
        verlet_atom atom = {.x = {in->x[0][i], in->x[1][i], in->x[2][i]}};
        for (int axis = 0; axis < 3; ++axis) atom.x_local[axis] = hs_set1(hs_local(atom.x[axis], atom.x[axis]));
        if (by_type) atom.row_table = table->values + (size_t)in->type[i] * (size_t)(table->n_types * stride);
        verlet_sums sums = {0};
        for (; stop - at >= HS_LANES; at += HS_LANES)
            verlet_vector(in, out, &atom, list + at, HS_LANES, only, &sums, true, with_energy, by_type);
        if (at < stop)
            verlet_vector(in, out, &atom, list + at, (int)(stop - at), only, &sums, false, with_energy, by_type);
        for (int axis = 0; axis < 3; ++axis) out->f[axis][i] -= hs_sum(sums.f[axis]);
        if (with_energy) {
            out->energy += hs_sum(sums.energy);
            for (int k = 0; k < 6; ++k) out->virial[k] += hs_sum(sums.virial[k]);
        }
    }
}
