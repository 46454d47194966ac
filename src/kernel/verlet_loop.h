/** The loops of method `verlet`: each i-atom against its own list of j-atoms, HS_LANES of them at a time; and lists of pairs.
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

/** Pairs after which energies are passed on: so many that sums of terms of HS_FIXED_BITS bits fit 63. */
enum { PAIRS_MAX = 1 << (63 - HS_FIXED_BITS - 1) };

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
    for (int k = 0; k < stride; ++k) params[k] = hs_gather(atom->row_table + k, 0.0, row, in->gathers);
}

/** What the pairs of one vector, d from i to j, exert on their j-atoms: terms of the forces, to be settled; energy and virial go
 *  to the sums. Pairs beyond their cutoff, or outside of @p counts, exert nothing. */
HS_INLINE void vector_terms(const hs_kernel_input *in, const hs_vec *params, const hs_vec d[3], const hs_msk *counts,
                            hs_magic magic_force, hs_magic magic_energy, verlet_sums *sums, hs_acc term[3],
                            const bool with_energy)
{
    const int stride = HS_TABLE_PARAMS + N_PARAMS;
    const hs_vec r2 = hs_fma(d[2], d[2], hs_fma(d[1], d[1], d[0] * d[0]));
    hs_msk mask = hs_less(r2, params[HS_TABLE_CUT_R2]);
    if (HS_HAS_RADII) mask = hs_mask_and(mask, hs_less(r2, params[stride] * params[stride]));
    if (counts != NULL) mask = hs_mask_and(mask, *counts);
    hs_vec force_over_r, energy = hs_set1(0.0);
    evaluate_pairs(params + HS_TABLE_PARAMS, in->table->shared, r2, &force_over_r, &energy, with_energy);
    force_over_r = hs_keep(mask, force_over_r);
    hs_acc_note_peak(&sums->peak_force, force_over_r);
    for (int axis = 0; axis < 3; ++axis) term[axis] = hs_acc_term(force_over_r, d[axis], magic_force);
    ++sums->n_terms;
    if (!with_energy) return;
    energy = hs_keep(mask, energy);
    hs_acc_note_peak(&sums->peak_energy, energy);
    hs_acc_add(&sums->energy, energy, magic_energy);
    add_virial(sums->virial, force_over_r, d[0], d[1], d[2], magic_energy);
}

/** One vector of j-atoms, of which the first n count; is_full: all do. */
HS_INLINE void verlet_vector(const hs_kernel_input *in, hs_kernel_output *out, const verlet_atom *atom,
                             const int32_t *j, int n, const hs_vec *only, verlet_sums *sums, const bool is_full,
                             const bool with_energy, const bool by_type)
{
    const int stride = HS_TABLE_PARAMS + N_PARAMS;
    hs_vec params[HS_TABLE_PARAMS + N_PARAMS + HS_HAS_RADII];
    for (int k = 0; k < stride && !by_type; ++k) params[k] = only[k];
    if (HS_HAS_RADII) params[stride] = hs_gather(in->radius, 0.0, j, in->gathers) + atom->radius;
    if (by_type) verlet_params(in, atom, j, params);
    const int n_axes = in->is_flat ? 2 : 3;
    hs_vec d[3] = {hs_gather(in->x[0], atom->x[0], j, in->gathers) - atom->x_local[0],
                   hs_gather(in->x[1], atom->x[1], j, in->gathers) - atom->x_local[1], hs_set1(0.0)};
    if (n_axes == 3) d[2] = hs_gather(in->x[2], atom->x[2], j, in->gathers) - atom->x_local[2];
    const hs_msk counts = hs_first_lanes(n);
    hs_acc term[3];
    vector_terms(in, params, d, is_full ? NULL : &counts, atom->magic_force, atom->magic_energy, sums, term,
                 with_energy);
    for (int axis = 0; axis < n_axes; ++axis) {
        sums->f[axis] += term[axis];
        hs_acc_settle(&term[axis], 1, atom->magic_force);
        hs_acc_scatter_add(out->f[axis], j, term[axis]);
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

/** Add energy, virial and the largest terms to the output. */
HS_INLINE void report_sums(hs_kernel_output *out, hs_magic magic_energy, verlet_sums *sums, const bool with_energy)
{
    hs_acc_report_peak(&out->peak_force, sums->peak_force);
    if (!with_energy) return;
    hs_acc_settle(&sums->energy, sums->n_terms, magic_energy);
    for (int k = 0; k < 6; ++k) hs_acc_settle(&sums->virial[k], sums->n_terms, magic_energy);
    hs_acc_report(out, sums->energy, sums->virial);
    hs_acc_report_peak(&out->peak_energy, sums->peak_energy);
}

/** Add what one i-atom has met to the output. */
HS_INLINE void finish_atom(hs_kernel_output *out, int i, int n_axes, const verlet_atom *atom, verlet_sums *sums,
                           const bool with_energy)
{
    for (int axis = 0; axis < n_axes; ++axis) {
        hs_acc_settle(&sums->f[axis], sums->n_terms, atom->magic_force);
        hs_acc_subtract_from(out->f[axis], i, sums->f[axis]);
    }
    report_sums(out, atom->magic_energy, sums, with_energy);
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
        finish_atom(out, i, in->is_flat ? 2 : 3, &atom, &sums, with_energy);
    }
}

/** The parameters of the pairs (i, j) of one vector, from the first to before the last. */
HS_INLINE void pair_params(const hs_kernel_input *in, const int32_t *i, const int32_t *j, int first, int last,
                           hs_vec *params, const bool gathers)
{
    const int stride = HS_TABLE_PARAMS + N_PARAMS;
    int32_t row[HS_LANES];
    for (int k = 0; k < HS_LANES; ++k) row[k] = stride * (in->type[i[k]] * in->table->n_types + in->type[j[k]]);
    for (int k = first; k < last; ++k) params[k] = hs_gather(in->table->values + k, 0.0, row, gathers);
}

/** Vectors d between the atoms of some pairs. */
HS_INLINE void pair_distances(const hs_kernel_input *in, const int32_t *i, const int32_t *j, hs_vec d[3],
                              const bool gathers)
{
    d[0] = hs_gather_between(in->x[0], i, j, gathers);
    d[1] = hs_gather_between(in->x[1], i, j, gathers);
    d[2] = in->is_flat ? hs_set1(0.0) : hs_gather_between(in->x[2], i, j, gathers);
}

/** One vector of pairs (i, j), of which the first n count; is_full: all do. */
HS_INLINE void pairs_vector(const hs_kernel_input *in, hs_kernel_output *out, const int32_t *i, const int32_t *j,
                            const hs_vec d[3], int n, hs_vec *params, verlet_sums *sums, const bool is_full,
                            const bool with_energy, const bool by_type, const bool gathers)
{
    const int n_axes = in->is_flat ? 2 : 3;
    const hs_magic magic_force = hs_magic_of(in->magic_force), magic_energy = hs_magic_of(in->magic_energy);
    const hs_msk counts = hs_first_lanes(n);
    hs_acc term[3];
    if (by_type) pair_params(in, i, j, 0, HS_TABLE_PARAMS + N_PARAMS, params, gathers);
    if (HS_HAS_RADII)
        params[HS_TABLE_PARAMS + N_PARAMS] =
            hs_gather(in->radius, 0.0, i, gathers) + hs_gather(in->radius, 0.0, j, gathers);
    vector_terms(in, params, d, is_full ? NULL : &counts, magic_force, magic_energy, sums, term, with_energy);
    for (int axis = 0; axis < n_axes; ++axis) {
        hs_acc_settle(&term[axis], 1, magic_force);
        hs_acc_scatter_subtract(out->f[axis], i, term[axis]);
        hs_acc_scatter_add(out->f[axis], j, term[axis]);
    }
}

/** Pairs that are taken at once. */
enum { PAIRS_AT_ONCE = 16 * HS_LANES };

#ifdef HS_COMPRESSES
/* Of the pairs of short lists a third to a half is beyond the cutoff, and what is done for a pair after its distance costs as much as
   what is done before. Where vectors can be compressed, the others are set aside until they fill vectors: that made runs of active
   particles 12 % faster (mixed precision 24 %), a dilute gas 15 %. With AVX2, whose vectors of four must be permuted by a table, it
   cost 15 %. */

/** Pairs within their cutoff. */
typedef struct close_pairs {
    int n;
    int32_t i[PAIRS_AT_ONCE + 2 * HS_LANES], j[PAIRS_AT_ONCE + 2 * HS_LANES];
    hs_real d[3][PAIRS_AT_ONCE + 2 * HS_LANES]; /**< from i to j; the third is not there when all is flat */
} close_pairs;

/** Append the close ones of a vector of pairs, of which the first n count. */
HS_INLINE void find_close(const hs_kernel_input *in, const int32_t *i, const int32_t *j, int n, hs_vec *params,
                          close_pairs *close, const bool by_type, const bool gathers)
{
    const int at = close->n, n_axes = in->is_flat ? 2 : 3;
    hs_vec d[3];
    pair_distances(in, i, j, d, gathers);
    if (by_type) pair_params(in, i, j, HS_TABLE_CUT_R2, HS_TABLE_CUT_R2 + 1, params, gathers);
    const hs_vec r2 = hs_fma(d[2], d[2], hs_fma(d[1], d[1], d[0] * d[0]));
    hs_msk mask = hs_less(r2, params[HS_TABLE_CUT_R2]);
    if (HS_HAS_RADII) {
        const hs_vec reach = hs_gather(in->radius, 0.0, i, gathers) + hs_gather(in->radius, 0.0, j, gathers);
        mask = hs_mask_and(mask, hs_less(r2, reach * reach));
    }
    if (n < HS_LANES) mask = hs_mask_and(mask, hs_first_lanes(n));
    hs_append_indices(close->i + at, mask, i);
    hs_append_indices(close->j + at, mask, j);
    for (int axis = 0; axis < n_axes; ++axis) close->n = at + hs_append(close->d[axis] + at, mask, d[axis]);
}

HS_INLINE void close_vector(const hs_kernel_input *in, hs_kernel_output *out, const close_pairs *close, int at, int n,
                            hs_vec *params, verlet_sums *sums, const bool is_full, const bool with_energy,
                            const bool by_type, const bool gathers)
{
    const int n_axes = in->is_flat ? 2 : 3;
    hs_vec d[3] = {hs_set1(0.0), hs_set1(0.0), hs_set1(0.0)};
    for (int axis = 0; axis < n_axes; ++axis) memcpy(&d[axis], close->d[axis] + at, sizeof d[axis]);
    pairs_vector(in, out, close->i + at, close->j + at, d, n, params, sums, is_full, with_energy, by_type, gathers);
}

/** The pairs that are left, less than a vector, go from @p at to the front; lanes beyond them name some atom. */
HS_INLINE void keep_rest(close_pairs *close, int at, int n_axes)
{
    close->n -= at;
    for (int k = 0; k < HS_LANES; ++k) {
        const int from = k < close->n ? at + k : at;
        close->i[k] = close->i[from];
        close->j[k] = close->j[from];
        for (int axis = 0; axis < n_axes; ++axis) close->d[axis][k] = close->d[axis][from];
    }
}

HS_INLINE void take_pairs(const hs_kernel_input *in, hs_kernel_output *out, const int32_t *i, const int32_t *j, int n,
                          hs_vec *params, close_pairs *close, verlet_sums *sums, const bool with_energy,
                          const bool by_type, const bool gathers)
{
    int done = 0;
    for (int at = 0; at < n; at += HS_LANES) find_close(in, i + at, j + at, n - at, params, close, by_type, gathers);
    for (; close->n - done >= HS_LANES; done += HS_LANES)
        close_vector(in, out, close, done, HS_LANES, params, sums, true, with_energy, by_type, gathers);
    keep_rest(close, done, in->is_flat ? 2 : 3);
}

HS_INLINE void take_rest(const hs_kernel_input *in, hs_kernel_output *out, hs_vec *params, const close_pairs *close,
                         verlet_sums *sums, const bool with_energy, const bool by_type, const bool gathers)
{
    if (close->n > 0) close_vector(in, out, close, 0, close->n, params, sums, false, with_energy, by_type, gathers);
}
#else
/** None are set aside. */
typedef struct close_pairs {
    int n;
} close_pairs;

HS_INLINE void take_pairs(const hs_kernel_input *in, hs_kernel_output *out, const int32_t *i, const int32_t *j, int n,
                          hs_vec *params, close_pairs *close, verlet_sums *sums, const bool with_energy,
                          const bool by_type, const bool gathers)
{
    hs_vec d[3];
    int at = 0;
    (void)close;
    for (; n - at >= HS_LANES; at += HS_LANES) {
        pair_distances(in, i + at, j + at, d, gathers);
        pairs_vector(in, out, i + at, j + at, d, HS_LANES, params, sums, true, with_energy, by_type, gathers);
    }
    if (at == n) return;
    pair_distances(in, i + at, j + at, d, gathers);
    pairs_vector(in, out, i + at, j + at, d, n - at, params, sums, false, with_energy, by_type, gathers);
}

HS_INLINE void take_rest(const hs_kernel_input *in, hs_kernel_output *out, hs_vec *params, const close_pairs *close,
                         verlet_sums *sums, const bool with_energy, const bool by_type, const bool gathers)
{
    (void)in, (void)out, (void)params, (void)close, (void)sums, (void)with_energy, (void)by_type, (void)gathers;
}
#endif

/** Pairs one by one, whatever their atoms: what is left of the lists when the full vectors of each i-atom are taken, and all of short
 *  lists, for which a vector of their own would be mostly empty. */
HS_INLINE void all_pairs(const hs_kernel_input *in, hs_kernel_output *out, int64_t n, const int32_t *i,
                         const int32_t *j, const bool with_energy, const bool by_type, const bool gathers)
{
    const hs_pair_table *table = in->table;
    const int stride = HS_TABLE_PARAMS + N_PARAMS;
    const hs_magic magic_energy = hs_magic_of(in->magic_energy);
    hs_vec params[HS_TABLE_PARAMS + N_PARAMS + HS_HAS_RADII];
    close_pairs close;
    verlet_sums sums;
    for (int k = 0; k < stride && !by_type; ++k)
        params[k] = hs_set1(table->values[(size_t)(table->n_types + 1) * (size_t)stride + (size_t)k]);
    close.n = 0;
    begin_atom(&sums, with_energy);
    for (int64_t at = 0; at < n; at += PAIRS_AT_ONCE) {
        const int n_now = n - at > PAIRS_AT_ONCE ? PAIRS_AT_ONCE : (int)(n - at);
        take_pairs(in, out, i + at, j + at, n_now, params, &close, &sums, with_energy, by_type, gathers);
        /* sums are passed on before they can leave their 64 bits */
        if (sums.n_terms < (PAIRS_MAX - 2 * PAIRS_AT_ONCE) / HS_LANES) continue;
        report_sums(out, magic_energy, &sums, with_energy);
        begin_atom(&sums, with_energy);
    }
    take_rest(in, out, params, &close, &sums, with_energy, by_type, gathers);
    report_sums(out, magic_energy, &sums, with_energy);
}

/** How pairs are gathered is a constant for compilers, too: asked for every vector, it cost half of what the machine's instructions gain. */
HS_INLINE void pairs_loop(const hs_kernel_input *in, hs_kernel_output *out, int64_t n, const int32_t *i,
                          const int32_t *j, const bool with_energy, const bool by_type)
{
#ifdef HS_GATHERS
    if (in->gathers) {
        all_pairs(in, out, n, i, j, with_energy, by_type, true);
        return;
    }
#endif
    all_pairs(in, out, n, i, j, with_energy, by_type, false);
}
