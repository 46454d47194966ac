/* Distances of the listed pairs of a chunk into fine bins; compiled for every instruction set. */
#include "kernel/cluster_list.h"
#include "kernel/tally.h"

enum { PIECE = 256 };

/** The pairs of one i-cluster. */
static inline void count_cluster(const double *const x[3], int first, const hs_cluster_entry *entry, int n_entries,
                                 hs_tally *tally, hs_histogram *histogram)
{
    const hs_vec limit = hs_set1(histogram->n_fine);
    for (int e = 0; e < n_entries; e += HS_GROUP) {
        /* rows with any pair; what is noted in the entries is for the kernels' own groups */
        uint32_t pairs = entry[e].mask;
        if (HS_GROUP > 1) pairs |= entry[e + 1].mask;
        for (int sub = 0; sub < HS_SUBS; ++sub) {
            const hs_masks masks = hs_masks_of(entry + e, sub);
            const hs_vec x_j[3] = {hs_load_clusters(x[0], 0.0, entry + e, sub),
                                   hs_load_clusters(x[1], 0.0, entry + e, sub),
                                   hs_load_clusters(x[2], 0.0, entry + e, sub)};
            for (int row = 0; row < HS_CLUSTER; ++row) {
                if (!(pairs >> 4 * row & 0xfu)) continue;
                const hs_vec dx = x_j[0] - hs_set1(x[0][first + row]), dy = x_j[1] - hs_set1(x[1][first + row]),
                             dz = x_j[2] - hs_set1(x[2][first + row]);
                const hs_vec r2 = hs_fma(dz, dz, hs_fma(dy, dy, dx * dx));
                hs_tally_add(tally, r2, hs_mask_and(hs_masks_row(masks, row), hs_less(r2 * tally->scale, limit)));
            }
        }
        hs_tally_settle(tally, histogram);
    }
}

/** Entries that name packed clusters (kernel/packed.h) as entries that name atoms. */
static inline void name_atoms(const hs_clusters *clusters, const hs_cluster_entry *entry, int n, hs_cluster_entry *to)
{
    for (int e = 0; e < n; ++e) to[e] = (hs_cluster_entry){hs_packed_atom(clusters, entry[e].first), entry[e].mask};
}

static void count_pairs(const double *const x[3], const hs_clusters *clusters, const hs_list_chunk *chunk,
                        bool is_packed, hs_histogram *histogram)
{
    hs_cluster_entry piece[PIECE];
    hs_tally tally = hs_tally_begin(histogram);
    for (int ci = chunk->begin; ci < chunk->end; ++ci) {
        const int end = chunk->start[ci - chunk->begin + 1], first = clusters->local.entry[ci].first;
        for (int begin = chunk->start[ci - chunk->begin]; begin < end; begin += PIECE) {
            const int n_entries = end - begin < PIECE ? end - begin : PIECE;
            const hs_cluster_entry *entry = chunk->entries.entry + begin;
            if (is_packed) {
                name_atoms(clusters, entry, n_entries, piece);
                entry = piece;
            }
            count_cluster(x, first, entry, n_entries, &tally, histogram);
        }
    }
    hs_tally_end(&tally, histogram);
}

#define PASTE_(a, b) a##b
#define PASTE(a, b)  PASTE_(a, b)
const hs_histogram_kernel PASTE(hs_histogram_kernel_, HS_KERNEL_ISA) = count_pairs;
