/** The loop of method `verlet`: each i-atom against its own list of j-atoms, HS_LANES of them at a time.
 *
 *  Included by kernel/instantiate.h after kernel/cluster_loop.h. The two bools are constants where it is called, so the
 *  compiler makes a kernel of its own for each combination. */

/** Sums over the pairs of one i-atom, in vectors: minus the force on it, energy, virial. */
typedef struct verlet_sums {
    hs_acc f[3];
    hs_acc energy, virial[6];
    hs_vec peak_force, peak_energy; /**< fixed point: the largest force/r and energy */
    int n_terms;                    /**< vectors met */
} verlet_sums;

/** What stays the same over the list of one i-atom. */
typedef struct verlet_atom {
    double x[3];             /**< coordinates are relative to these in single precision */
    hs_vec x_local[3];       /**< its own, as kernels use it, in all lanes */
    const double *row_table; /**< its row of the pair table, by_type */
    hs_vec radius;           /**< in all lanes; only where the evaluator asks for it */
    hs_magic magic_force, magic_energy;
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
    const int stride = HS_TABLE_PARAMS + N_PARAMS;
    hs_vec params[HS_TABLE_PARAMS + N_PARAMS + HS_HAS_RADII];
    for (int k = 0; k < stride && !by_type; ++k) params[k] = only[k];
    if (HS_HAS_RADII) params[stride] = hs_gather(in->radius, 0.0, j) + atom->radius;
    if (by_type) verlet_params(in, atom, j, params);
    const hs_vec dx = hs_gather(in->x[0], atom->x[0], j) - atom->x_local[0];
    const hs_vec dy = hs_gather(in->x[1], atom->x[1], j) - atom->x_local[1];
    const hs_vec dz = hs_gather(in->x[2], atom->x[2], j) - atom->x_local[2];
    const hs_vec r2 = hs_fma(dz, dz, hs_fma(dy, dy, dx * dx));
    hs_msk near = hs_less(r2, params[HS_TABLE_CUT_R2]);
    if (HS_HAS_RADII) near = hs_mask_and(near, hs_less(r2, params[stride] * params[stride]));
    const hs_msk mask = is_full ? near : hs_mask_and(hs_first_lanes(n), near);
    hs_vec force_over_r, energy = hs_set1(0.0);
    evaluate(params + HS_TABLE_PARAMS, r2, &force_over_r, &energy, with_energy);
    force_over_r = hs_keep(mask, force_over_r);
    hs_acc_note_peak(&sums->peak_force, force_over_r);
    const hs_magic magic = atom->magic_force;
    hs_acc term[3] = {hs_acc_term(force_over_r, dx, magic), hs_acc_term(force_over_r, dy, magic),
                      hs_acc_term(force_over_r, dz, magic)};
    ++sums->n_terms;
    for (int axis = 0; axis < 3; ++axis) {
        sums->f[axis] += term[axis];
        hs_acc_settle(&term[axis], 1, magic);
        hs_acc_scatter_add(out->f[axis], j, term[axis]);
    }
    if (with_energy) {
        energy = hs_keep(mask, energy);
        hs_acc_note_peak(&sums->peak_energy, energy);
        hs_acc_add(&sums->energy, energy, atom->magic_energy);
        add_virial(sums->virial, force_over_r, dx, dy, dz, atom->magic_energy);
    }
}

HS_INLINE void begin_atom(verlet_sums *sums, const bool with_energy)
{
    for (int axis = 0; axis < 3; ++axis) sums->f[axis] = hs_acc_zero();
    sums->peak_force = hs_set1(0.0);
    sums->n_terms = 0;
    if (!with_energy) return;
    sums->energy = hs_acc_zero();
    for (int k = 0; k < 6; ++k) sums->virial[k] = hs_acc_zero();
    sums->peak_energy = hs_set1(0.0);
}

/** Add what one i-atom has met to the output. */
HS_INLINE void finish_atom(hs_kernel_output *out, int i, const verlet_atom *atom, verlet_sums *sums,
                           const bool with_energy)
{
    for (int axis = 0; axis < 3; ++axis) {
        hs_acc_settle(&sums->f[axis], sums->n_terms, atom->magic_force);
        hs_acc_subtract_from(out->f[axis], i, sums->f[axis]);
    }
    hs_acc_report_peak(&out->peak_force, sums->peak_force);
    if (!with_energy) return;
    hs_acc_settle(&sums->energy, sums->n_terms, atom->magic_energy);
    for (int k = 0; k < 6; ++k) hs_acc_settle(&sums->virial[k], sums->n_terms, atom->magic_energy);
    hs_acc_report(out, sums->energy, sums->virial, 1.0);
    hs_acc_report_peak(&out->peak_energy, sums->peak_energy);
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
        verlet_atom atom = {.x = {in->x[0][i], in->x[1][i], in->x[2][i]},
                            .magic_force = hs_magic_of(in->magic_force),
                            .magic_energy = hs_magic_of(in->magic_energy)};
        for (int axis = 0; axis < 3; ++axis) atom.x_local[axis] = hs_set1(hs_local(atom.x[axis], atom.x[axis]));
        if (HS_HAS_RADII) atom.radius = hs_set1(in->radius[i]);
        if (by_type) atom.row_table = table->values + (size_t)in->type[i] * (size_t)(table->n_types * stride);
        verlet_sums sums;
        begin_atom(&sums, with_energy);
        for (; stop - at >= HS_LANES; at += HS_LANES)
            verlet_vector(in, out, &atom, list + at, HS_LANES, only, &sums, true, with_energy, by_type);
        if (at < stop)
            verlet_vector(in, out, &atom, list + at, (int)(stop - at), only, &sums, false, with_energy, by_type);
        finish_atom(out, i, &atom, &sums, with_energy);
    }
}
