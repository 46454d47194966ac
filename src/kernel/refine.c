/* From candidate cluster pairs to the pairs of atoms within the list's reach; compiled for every instruction set. */
#include "kernel/kernel.h"
#include "kernel/simd.h"

/** Masks of the entries of a vector from the bits of its lanes, which are HS_LANES for each row, one row after the other. */
static inline void split_masks(uint32_t near, uint32_t mask[HS_GROUP])
{
    for (int k = 0; k < HS_GROUP; ++k) {
        uint32_t bits = HS_GROUP == 1 ? near : near >> HS_CLUSTER * k & 0x0f0f0f0fu;
        if (HS_GROUP > 1) bits |= bits >> 4, bits = (bits & 0xffu) | (bits >> 8 & 0xff00u);
        mask[k] = bits;
    }
}

/** Which distances are to be compared with which; constant where it is called. */
typedef struct refine_form {
    bool is_uniform; /**< all pairs have the listed distance of types 1 and 1 */
    bool by_radius;  /**< and within that only those within their radii and the skin */
} refine_form;

/** Pair masks of the entries of one vector: which of the pairs allowed so far are within their listed distance. */
static inline __attribute__((always_inline)) void refine_vector(const hs_kernel_input *in, int first,
                                                                hs_cluster_entry *entry, const refine_form form)
{
    const hs_pair_table *table = in->table;
    const double only = table->values[(table->n_types + 1) * table->stride + HS_TABLE_LISTED_R2];
    uint32_t all = 0, refined[HS_GROUP];
    for (int sub = 0; sub < HS_SUBS; ++sub) {
        const hs_vec x_j[3] = {hs_load_clusters(in->x[0], 0.0, entry, sub), hs_load_clusters(in->x[1], 0.0, entry, sub),
                               hs_load_clusters(in->x[2], 0.0, entry, sub)};
        for (int row = 0; row < HS_CLUSTER; ++row) {
            const int i = first + row;
            const hs_vec dx = hs_set1(in->x[0][i]) - x_j[0], dy = hs_set1(in->x[1][i]) - x_j[1],
                         dz = hs_set1(in->x[2][i]) - x_j[2];
            hs_vec limit = hs_set1(only);
            if (!form.is_uniform) {
                const double *row_table =
                    table->values + (size_t)in->type[i] * (size_t)(table->n_types * table->stride);
                limit = hs_lookup(row_table + HS_TABLE_LISTED_R2, in->type, table->stride, entry, sub);
            }
            const hs_vec r2 = dx * dx + dy * dy + dz * dz;
            uint32_t near = hs_mask_to_bits(hs_less(r2, limit));
            if (form.by_radius) {
                const hs_vec reach =
                    hs_load_clusters(in->radius, 0.0, entry, sub) + hs_set1(in->radius[i]) + hs_set1(in->skin);
                near &= hs_mask_to_bits(hs_less(r2, reach * reach));
            }
            all |= near << (HS_GROUP * HS_CLUSTER * row + (HS_SUBS > 1 ? HS_LANES * sub : 0));
        }
    }
    split_masks(all, refined);
    for (int k = 0; k < HS_GROUP; ++k) entry[k].mask &= refined[k]; /* clears the bits of rows, too */
}

static inline __attribute__((always_inline)) void refine_vectors(const hs_kernel_input *in, int first,
                                                                 hs_cluster_entry *entry, int n, const refine_form form)
{
    for (int e = 0; e < n; e += HS_GROUP) refine_vector(in, first, entry + e, form);
}

/** Rows (i-atoms) that have any pair in a mask: each group of four bits folded into one. */
static inline uint32_t rows_of(uint32_t mask)
{
    uint32_t any = mask | mask >> 1;
    any = (any | any >> 2) & 0x1111u;
    return (any | any >> 3 | any >> 6 | any >> 9) & 0xfu;
}

/** Of every set of rows its place in the list: an order in which few rows change from one to the next, full ones first, so that
 *  neighbors in the list skip the same rows; no rows at all last. Of the orders that begin so it computes, in a liquid, the fewest
 *  lanes in vectors of two clusters (found by annealing). */
static const unsigned char place[16] = {15, 14, 4, 2, 12, 13, 5, 1, 8, 9, 7, 3, 11, 10, 6, 0};

enum {
    N_SETS = 16, /* of rows */
    /* Parts of a list whose entries are counted, and then written, in turn: from one to the next in a part, usually of the same set of rows,
       a counter that was just stored has to be read again, which took a quarter of the refinement. */
    N_PARTS = 4,
};

static inline int place_of(const hs_cluster_entry *entry) { return place[entry->mask >> HS_ENTRY_ROWS_SHIFT]; }

/** Write entries whose rows are noted to @p to, those of each set at its place; returns how many have any rows. */
static int order_by_rows(const hs_cluster_entry *entry, int n, hs_cluster_entry *to)
{
    int next[N_PARTS][N_SETS] = {0}, begin[N_SETS];
    const int size = n / N_PARTS;
    for (int e = 0; e < size; ++e)
        for (int part = 0; part < N_PARTS; ++part) ++next[part][place_of(&entry[part * size + e])];
    for (int e = N_PARTS * size; e < n; ++e) ++next[N_PARTS - 1][place_of(&entry[e])];
    for (int set = 0; set < N_SETS; ++set) begin[set] = next[0][set] + next[1][set] + next[2][set] + next[3][set];
    int n_before = 0;
    for (int set = 0; set < N_SETS; ++set) {
        const int count = begin[set];
        begin[set] = n_before;
        n_before += count;
    }
    const int n_kept = begin[N_SETS - 1]; /* those without rows are the last */
    for (int part = 0; part < N_PARTS; ++part) {
        for (int set = 0; set < N_SETS; ++set) {
            const int count = next[part][set];
            next[part][set] = begin[set];
            begin[set] += count;
        }
    }
    for (int e = 0; e < size; ++e) {
        for (int part = 0; part < N_PARTS; ++part) {
            const hs_cluster_entry *from = &entry[part * size + e];
            to[next[part][place_of(from)]++] = *from;
        }
    }
    for (int e = N_PARTS * size; e < n; ++e) to[next[N_PARTS - 1][place_of(&entry[e])]++] = entry[e];
    return n_kept;
}

/** Note in the first entry of each vector which rows it needs; `entry` is filled up with empty entries. */
static int note_rows(hs_cluster_entry *entry, int n, int group)
{
    for (; n % group != 0; ++n) entry[n] = (hs_cluster_entry){entry[0].first, 0};
    for (int e = 0; e < n; e += group)
        for (int k = 1; k < group; ++k) entry[e].mask |= entry[e + k].mask & 0xfu << HS_ENTRY_ROWS_SHIFT;
    return n;
}

static int refine(const hs_kernel_input *in, int first, hs_cluster_entry *entry, int n, int group, hs_cluster_entry *to,
                  int64_t *n_pairs)
{
    int n_near = 0;
    if (!in->table->is_uniform)
        refine_vectors(in, first, entry, n, (refine_form){.by_radius = in->listed_by_radius});
    else if (in->listed_by_radius)
        refine_vectors(in, first, entry, n, (refine_form){.is_uniform = true, .by_radius = true});
    else
        refine_vectors(in, first, entry, n, (refine_form){.is_uniform = true});
    for (int e = 0; e < n; ++e) n_near += __builtin_popcount(entry[e].mask);
    for (int e = 0; e < n; ++e) entry[e].mask |= rows_of(entry[e].mask) << HS_ENTRY_ROWS_SHIFT; /* vector code */
    *n_pairs += n_near;
    return note_rows(to, order_by_rows(entry, n, to), group);
}

#define PASTE_(a, b) a##b
#define PASTE(a, b)  PASTE_(a, b)
const hs_list_refine PASTE(hs_list_refine_, HS_KERNEL_ISA) = refine;
