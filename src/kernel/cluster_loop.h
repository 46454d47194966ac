/** The one loop of all fast kernels: four i-atoms against the j-clusters of a list.
 *
 *  Included by kernel/instantiate.h after the file of a pair style has defined evaluate() and N_PARAMS. The form is
 *  constant where it is called, so the compiler makes a kernel of its own for each. */

#include "kernel/accumulate.h"
#include "kernel/cluster_memory.h"
#include "kernel/tally.h"

/** Rows one by one, with constant numbers: compilers keep in registers what they index by constants when they first read it,
 *  but not what loops index that are unrolled later. */
#define EACH_ROW(act)                                                                                                  \
    act(0);                                                                                                            \
    act(1);                                                                                                            \
    act(2);                                                                                                            \
    act(3)
_Static_assert(HS_CLUSTER == 4, "EACH_ROW counts to four");

/** What a kernel is for. */
typedef struct cluster_form {
    bool with_energy; /**< and virial */
    bool by_type;     /**< parameters by the types of each pair; else all pairs have those of types 1 and 1 */
    bool listed_only; /**< see hs_kernel_input */
    bool counting;    /**< distances go to the tally */
    bool in_turn;     /**< see hs_kernel_set */
} cluster_form;

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
    hs_frame frame, frame_listed;              /**< of present positions, and of those when the list was due */
    hs_real x[3][HS_CLUSTER];                  /**< of the i-atoms, in the frame */
    hs_real x_listed[3][HS_CLUSTER];           /**< only with listed_only */
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

/** Vectors of j-atoms on their way through the loop. Unless the form says in_turn, their pairs are measured one vector ahead of the
 *  potential and the sums: a row's operations wait for each other, and a core that finds no others within its window (64 on a Zen 4) is
 *  idle. */
typedef struct vector_state {
    const hs_cluster_entry *entry;
    int sub;
    uint32_t rows; /**< bits of the i-atoms that have pairs with it */
    hs_vec x[3];   /**< in the frame of the i-atoms */
} vector_state;

/** What is known of the rows (i-atoms) of the vector that was measured last. */
typedef struct measured_rows {
    hs_vec r2[HS_CLUSTER];
    hs_msk near[HS_CLUSTER]; /**< pairs that count */
} measured_rows;

/** Parameter k of the pairs of a row. */
HS_INLINE hs_vec row_param(const hs_kernel_input *in, const cluster_constants *constants, const vector_state *v,
                           int row, int k, bool by_type)
{
    const int stride = HS_TABLE_PARAMS + N_PARAMS;
    return by_type ? hs_lookup(constants->row_table[row] + k, in->type, stride, v->entry, v->sub)
                   : constants->params[k];
}

HS_INLINE hs_vec row_reach(const hs_kernel_input *in, const cluster_constants *constants, const vector_state *v,
                           int row)
{
    return hs_load_clusters(in->radius, 0.0, v->entry, v->sub) + hs_set1(constants->radius[row]);
}

/** First half of a row: which of its pairs count. */
HS_INLINE void measure_row(const hs_kernel_input *in, const cluster_constants *constants, const vector_state *v,
                           int row, hs_masks masks, measured_rows *measured, bool by_type, bool listed_only)
{
    const hs_vec dx = v->x[0] - hs_set1(constants->x[0][row]), dy = v->x[1] - hs_set1(constants->x[1][row]),
                 dz = v->x[2] - hs_set1(constants->x[2][row]);
    const hs_vec r2 = hs_fma(dz, dz, hs_fma(dy, dy, dx * dx));
    hs_msk mask =
        hs_mask_and(hs_masks_row(masks, row), hs_less(r2, row_param(in, constants, v, row, HS_TABLE_CUT_R2, by_type)));
    const hs_vec reach = HS_HAS_RADII ? row_reach(in, constants, v, row) : hs_set1(0.0);
    if (HS_HAS_RADII) mask = hs_mask_and(mask, hs_less(r2, reach * reach));
    if (listed_only) {
        hs_vec d[3];
        hs_load_near(in, true, &constants->frame_listed, v->entry, v->sub, d);
        for (int axis = 0; axis < 3; ++axis) d[axis] -= hs_set1(constants->x_listed[axis][row]);
        /* rounded as in refine.c: the same pairs in both */
        const hs_vec listed_r2 = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
        mask = hs_mask_and(mask, hs_less(listed_r2, row_param(in, constants, v, row, HS_TABLE_LISTED_R2, by_type)));
        if (HS_HAS_RADII && in->listed_by_radius) {
            const hs_vec listed_reach = reach + hs_set1(in->skin);
            mask = hs_mask_and(mask, hs_less(listed_r2, listed_reach * listed_reach));
        }
    }
    measured->r2[row] = r2;
    measured->near[row] = mask;
}

/** Second half: adds the pairs' forces to sums and to the j-atoms' reaction, and the distances to the tally, if there is one: here,
 *  where they are known for long, nothing waits for them. */
HS_INLINE void add_row(const hs_kernel_input *in, const cluster_constants *constants, const vector_state *v, int row,
                       const measured_rows *measured, cluster_sums *sums, hs_acc reaction[3], bool with_energy,
                       bool by_type, hs_tally *tally)
{
    if (tally != NULL) hs_tally_add(tally, measured->r2[row], measured->near[row]);
    hs_vec params[N_PARAMS + HS_HAS_RADII], force_over_r, energy = hs_set1(0.0);
    for (int k = 0; k < N_PARAMS; ++k) params[k] = row_param(in, constants, v, row, HS_TABLE_PARAMS + k, by_type);
    if (HS_HAS_RADII) params[N_PARAMS] = row_reach(in, constants, v, row);
    evaluate_pairs(params, in->table->shared, measured->r2[row], &force_over_r, &energy, with_energy);
    force_over_r = hs_keep(measured->near[row], force_over_r);
    hs_acc_note_peak(&sums->peak_force, force_over_r);
    const hs_vec dx = v->x[0] - hs_set1(constants->x[0][row]), dy = v->x[1] - hs_set1(constants->x[1][row]),
                 dz = v->x[2] - hs_set1(constants->x[2][row]);
    const hs_magic magic = constants->magic_force;
    hs_acc_add_product(&sums->f[row][0], force_over_r, dx, magic);
    hs_acc_add_product(&reaction[0], force_over_r, dx, magic);
    hs_acc_add_product(&sums->f[row][1], force_over_r, dy, magic);
    hs_acc_add_product(&reaction[1], force_over_r, dy, magic);
    hs_acc_add_product(&sums->f[row][2], force_over_r, dz, magic);
    hs_acc_add_product(&reaction[2], force_over_r, dz, magic);
    if (with_energy) {
        energy = hs_keep(measured->near[row], energy);
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
    hs_frame_set(&constants.frame, in, false, first, constants.x);
    if (listed_only) hs_frame_set(&constants.frame_listed, in, true, first, constants.x_listed);
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

HS_INLINE vector_state vector_at(const hs_cluster_entry *entry, int sub)
{
    return (vector_state){.entry = entry, .sub = sub, .rows = entry->mask >> HS_ENTRY_ROWS_SHIFT};
}

/** Load a vector; the masks of its rows. */
HS_INLINE hs_masks begin_vector(const hs_kernel_input *in, const cluster_constants *constants, vector_state *v)
{
    hs_load_near(in, false, &constants->frame, v->entry, v->sub, v->x);
    return hs_masks_of(v->entry, v->sub);
}

/** Pass on the forces on the j-atoms of a vector. */
HS_INLINE void end_vector(hs_kernel_output *out, const cluster_constants *constants, const vector_state *v,
                          hs_acc reaction[3])
{
    for (int axis = 0; axis < 3; ++axis) hs_acc_settle(&reaction[axis], n_rows[v->rows & 0xfu], constants->magic_force);
    hs_add_reaction(out, v->entry, v->sub, reaction);
}

/** The pairs of one vector, row after row. */
HS_INLINE void take_vector(const hs_kernel_input *in, hs_kernel_output *out, const cluster_constants *constants,
                           vector_state *v, measured_rows *measured, cluster_sums *sums, const cluster_form form,
                           hs_tally *tally)
{
    hs_acc reaction[3] = {hs_acc_zero(), hs_acc_zero(), hs_acc_zero()};
    const hs_masks masks = begin_vector(in, constants, v);
#define ROW(row)                                                                                                       \
    do {                                                                                                               \
        if ((v->rows >> row & 1u) == 0) break;                                                                         \
        measure_row(in, constants, v, row, masks, measured, form.by_type, form.listed_only);                           \
        add_row(in, constants, v, row, measured, sums, reaction, form.with_energy, form.by_type, tally);               \
    } while (0)
    EACH_ROW(ROW);
#undef ROW
    end_vector(out, constants, v, reaction);
}

/** Measure vector `next` and add the pairs of vector `old`, which was measured before; either may be NULL. */
HS_INLINE void advance(const hs_kernel_input *in, hs_kernel_output *out, const cluster_constants *constants,
                       const vector_state *old, vector_state *next, measured_rows *measured, cluster_sums *sums,
                       const cluster_form form, hs_tally *tally)
{
    hs_masks masks = {0};
    hs_acc reaction[3] = {hs_acc_zero(), hs_acc_zero(), hs_acc_zero()};
    if (next != NULL) masks = begin_vector(in, constants, next);
#define ROW(row)                                                                                                       \
    do {                                                                                                               \
        if (old != NULL && (old->rows >> row & 1u) != 0)                                                               \
            add_row(in, constants, old, row, measured, sums, reaction, form.with_energy, form.by_type, tally);         \
        if (next != NULL && (next->rows >> row & 1u) != 0)                                                             \
            measure_row(in, constants, next, row, masks, measured, form.by_type, form.listed_only);                    \
    } while (0)
    EACH_ROW(ROW);
#undef ROW
    if (old != NULL) end_vector(out, constants, old, reaction);
}

/** Groups of entries after which counts and energies are passed on: so many that sums of HS_FIXED_BITS bits fit 63. */
enum { CHUNK_MAX = 1 << (63 - HS_FIXED_BITS - 5) };

HS_INLINE void begin_energy(cluster_sums *sums)
{
    sums->energy = sums->virial[0] = sums->virial[1] = sums->virial[2] = hs_acc_zero();
    sums->virial[3] = sums->virial[4] = sums->virial[5] = hs_acc_zero();
}

/** Element by element: compilers clear the whole struct in memory, which took a seventh of the loop. */
HS_INLINE void begin_sums(cluster_sums *sums, const bool with_energy)
{
#define ROW(row) sums->f[row][0] = sums->f[row][1] = sums->f[row][2] = hs_acc_zero()
    EACH_ROW(ROW);
#undef ROW
    sums->peak_force = hs_set1(0.0);
    if (!with_energy) return;
    begin_energy(sums);
    sums->peak_energy = hs_set1(0.0);
}

/** Pass on energy and virial of n terms. */
HS_INLINE void report_energy(hs_kernel_output *out, const cluster_constants *constants, cluster_sums *sums, int64_t n)
{
    hs_acc_settle(&sums->energy, n, constants->magic_energy);
#define PART(k) hs_acc_settle(&sums->virial[k], n, constants->magic_energy)
    PART(0);
    PART(1);
    PART(2);
    PART(3);
    PART(4);
    PART(5);
#undef PART
    hs_acc_report(out, sums->energy, sums->virial);
    begin_energy(sums);
}

/** Take the sums of one axis, of n_terms[row] vectors, off the i-atoms' forces. */
HS_INLINE void end_axis(hs_kernel_output *out, const cluster_constants *constants, cluster_sums *sums, const int axis,
                        int first, const int64_t n_terms[HS_CLUSTER])
{
    hs_acc of_row[HS_CLUSTER];
#define ROW(row)                                                                                                       \
    of_row[row] = sums->f[row][axis];                                                                                  \
    hs_acc_settle(&of_row[row], n_terms[row], constants->magic_force)
    EACH_ROW(ROW);
#undef ROW
    hs_acc_subtract_rows(hs_own_forces(out, axis, first), of_row);
}

/** The pairs with n entries, whole groups of them. Returns how many entries' vectors each i-atom met, 16 bits for each: one addition
 *  counts for all four. */
HS_INLINE uint64_t take_entries(const hs_kernel_input *in, hs_kernel_output *out, const cluster_constants *constants,
                                const hs_cluster_entry *entry, int n, measured_rows *measured, cluster_sums *sums,
                                const cluster_form form, hs_tally *tally)
{
    vector_state old = vector_at(entry, 0), next;
    uint64_t count = one_each[old.rows & 0xfu];
    if (form.in_turn)
        take_vector(in, out, constants, &old, measured, sums, form, tally);
    else
        advance(in, out, constants, NULL, &old, measured, sums, form, tally);
    for (int v = 1; v < n / HS_GROUP * HS_SUBS; ++v) {
        next = vector_at(entry + v / HS_SUBS * HS_GROUP, v % HS_SUBS);
        if (form.in_turn)
            take_vector(in, out, constants, &next, measured, sums, form, tally);
        else
            advance(in, out, constants, &old, &next, measured, sums, form, tally);
        if (form.counting) hs_tally_settle(tally, out->histogram);
        if (next.sub == 0) count += one_each[next.rows & 0xfu];
        old = next;
    }
    if (!form.in_turn) advance(in, out, constants, &old, NULL, measured, sums, form, tally);
    return count;
}

HS_INLINE void cluster_loop(const hs_kernel_input *in, hs_kernel_output *out, int first, const hs_cluster_entry *entry,
                            int n_entries, const cluster_form form)
{
    const cluster_constants constants = make_constants(in, first, form.by_type, form.listed_only);
    cluster_sums sums;
    begin_sums(&sums, form.with_energy);
    measured_rows measured; /* set before it is read, but compilers cannot see that */
#define ROW(row) measured.r2[row] = hs_set1(1.0), measured.near[row] = hs_less(measured.r2[row], measured.r2[row])
    EACH_ROW(ROW);
#undef ROW
    hs_tally counts, *const tally = form.counting ? &counts : NULL;
    if (form.counting) counts = hs_tally_begin(out->histogram);
    int64_t n_terms[HS_CLUSTER] = {0}; /* vectors that each i-atom met */
    for (int begin = 0, end; begin < n_entries; begin = end) {
        int64_t n_new = 0;
        end = n_entries - begin > CHUNK_MAX * HS_GROUP ? begin + CHUNK_MAX * HS_GROUP : n_entries;
        const uint64_t count =
            take_entries(in, out, &constants, entry + begin, end - begin, &measured, &sums, form, tally);
        for (int row = 0; row < HS_CLUSTER; ++row) {
            const int64_t n = (int64_t)(count >> 16 * row & 0xffff) * HS_SUBS;
            n_terms[row] += n;
            n_new += n;
        }
        if (form.with_energy) report_energy(out, &constants, &sums, n_new);
    }
    if (form.counting) hs_tally_end(&counts, out->histogram);
    end_axis(out, &constants, &sums, 0, first, n_terms);
    end_axis(out, &constants, &sums, 1, first, n_terms);
    end_axis(out, &constants, &sums, 2, first, n_terms);
    hs_acc_report_peak(&out->peak_force, sums.peak_force);
    if (form.with_energy) hs_acc_report_peak(&out->peak_energy, sums.peak_energy);
}
