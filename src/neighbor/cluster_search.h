/** Search for cluster pairs; compiled for every instruction set, like the kernels. */
#ifndef HS_NEIGHBOR_CLUSTER_SEARCH_H
#define HS_NEIGHBOR_CLUSTER_SEARCH_H

#include "neighbor/clusters.h"

/** Clusters [begin, end) of one column. */
typedef struct hs_run {
    int32_t begin, end;
} hs_run;

/** Columns of one part around the column whose clusters are searched for: arrays of n, padded to whole vectors. */
typedef struct hs_column_list {
    float *bound[4];            /**< owned: lower, upper bound along grid axis 0, then 1; relative to the grid */
    int32_t *cell_lo, *cell_hi; /**< owned scratch: cells of the column that the batch at hand can reach */
    int32_t *column;            /**< owned: rank */
    hs_run *run;                /**< owned [n_runs]: what the batch can reach; of local columns its own one first */
    int n, n_runs, capacity;
} hs_column_list;

/** A search in progress on one thread. Zero it before first use; free with hs_cluster_search_fini. */
typedef struct hs_search {
    const hs_clusters *clusters; /**< borrowed, as all inputs, until the next begin */
    const hs_cells *cells;
    float reach;                /**< with a margin for float rounding */
    int column;                 /**< rank of the column at hand, -1 for none */
    int batch_begin, batch_end; /**< clusters of the column whose runs are there: they are found together */
    int n_reached;              /**< clusters of all runs */
    hs_column_list local, halo; /**< upper half of the local columns; all halo columns around */
    float skin;                 /**< of the search by motion; INFINITY: not that */
    hs_entry_list moved;        /**< owned: entries of the cluster at hand that have moved */
} hs_search;

/** Start searching pairs of clusters with atoms closer than `reach`. With a skin that is not INFINITY, pairs of clusters with atoms
 *  that may together have moved farther than that (hs_clusters_note_motion) go to search->moved instead. */
void hs_cluster_search_begin(hs_search *search, const hs_clusters *clusters, const hs_cells *cells, double reach,
                             double skin);
void hs_cluster_search_fini(hs_search *search);

/** List the columns around a column; called by hs_cluster_find when the column changes. */
HS_MUST_USE hs_status hs_cluster_search_column(hs_search *search, int column, hs_error *err);

/** Find the j-clusters with an atom possibly within reach of an atom of local cluster ci (which is in the column of rank
 *  `column`): local clusters of the upper half, so that each pair of clusters is found once, from one side, and halo
 *  clusters all around. Masks leave out pairs of an atom with itself, pairs met twice within a cluster, and lanes beyond a
 *  ragged end. Appends to *entries, growing it, and overwrites search->moved. Clusters should come column by column. Not collective. */
typedef hs_status (*hs_cluster_find)(hs_search *search, int ci, int column, hs_entry_list *entries, hs_error *err);

extern const hs_cluster_find hs_cluster_find_portable, hs_cluster_find_sse2, hs_cluster_find_avx2,
    hs_cluster_find_avx512;

#endif
