/** Clusters: up to four atoms that stand one after the other in a column of cells, and the search for cluster pairs.
 *
 *  Atoms are in the order of hs_cells, so a cluster is four consecutive indices; only the last cluster of a column may be
 *  shorter. Clusters are the unit of the fast force loops: four atoms against four gives vector loads without gathers
 *  (S. Pall, B. Hess, Comput. Phys. Commun. 184, 2641 (2013), doi:10.1016/j.cpc.2013.06.003). */
#ifndef HS_NEIGHBOR_CLUSTERS_H
#define HS_NEIGHBOR_CLUSTERS_H

#include "neighbor/cells.h"

enum { HS_CLUSTER = 4, HS_ENTRY_ROWS_SHIFT = 16 };

/** One entry of an i-cluster's list: a j-cluster and which of the 16 pairs count, bit 4 * i + j. Bits 16 to 19 say which
 *  rows (i-atoms) a kernel must visit for the vector that begins with this entry: those with a pair in any of its entries. */
typedef struct hs_cluster_entry {
    int32_t first; /**< index of the j-cluster's first atom */
    uint32_t mask;
} hs_cluster_entry;

/** A list of entries that grows. Zero it before use; free entry with HS_FREE. */
typedef struct hs_entry_list {
    hs_cluster_entry *entry; /**< owned */
    int n, capacity;
} hs_entry_list;

/** The clusters of one part (local or halo atoms). */
typedef struct hs_cluster_part {
    int n;                   /**< clusters */
    int first_atom;          /**< index of the part's first atom */
    hs_cluster_entry *entry; /**< owned [n + padding]: first atom, and all pairs with the atoms it has */
    unsigned char *size;     /**< owned [n]: 1 .. 4 */
    float *box[6];           /**< owned [n + padding]: bounding box lo, hi along the grid axes, relative to the grid */
    float *moved;            /**< owned [n + padding]: see hs_clusters_note_motion */
    int32_t *column_begin;   /**< owned [n_columns + 1]: first cluster of each column (by rank) */
    int64_t capacity, capacity_columns;
} hs_cluster_part;

typedef struct hs_clusters {
    hs_cluster_part local, halo;
    int32_t *column_at; /**< owned [n_columns]: grid column c0 * n[1] + c1 at each rank */
    int64_t capacity_columns;
    uint64_t generation; /**< of the atoms these clusters belong to */
    bool has_motion;     /**< moved is noted */
} hs_clusters;

/** Mask with the lanes (j-atoms) below `size` set, in all four rows; all rows are visited. */
static inline uint32_t hs_cluster_lanes(int size)
{
    return ((1u << size) - 1u) * 0x1111u | 0xfu << HS_ENTRY_ROWS_SHIFT;
}
/** Mask with all lanes of the rows (i-atoms) below `size` set; all rows are visited. */
static inline uint32_t hs_cluster_rows(int size) { return ((1u << 4 * size) - 1u) | 0xfu << HS_ENTRY_ROWS_SHIFT; }

/** Cut sorted atoms into clusters and bound them. */
HS_MUST_USE hs_status hs_clusters_build(hs_clusters *clusters, const hs_cells *cells, const hs_atoms *atoms,
                                        hs_error *err);
/** Note for every cluster the farthest that an atom of it is from its place in `from` (rounded up), halo atoms included. */
void hs_clusters_note_motion(hs_clusters *clusters, const hs_atoms *atoms, double *const from[3]);
void hs_clusters_fini(hs_clusters *clusters);

/** Width of columns that makes clusters of atoms at this number density roughly cubic, at most `reach`. */
double hs_clusters_width(int dimension, double density, double reach);

/** Make room for n_more entries. */
HS_MUST_USE hs_status hs_entry_list_reserve(hs_entry_list *entries, int n_more, hs_error *err);
/** Fill the list from place @p begin on up to a multiple of @p group with entries that do nothing (mask 0). */
HS_MUST_USE hs_status hs_entry_list_pad(hs_entry_list *entries, int begin, int group, int first, hs_error *err);
/** Rank of the column that local cluster ci belongs to. */
int hs_clusters_column(const hs_clusters *clusters, const hs_cells *cells, int ci);

#endif
