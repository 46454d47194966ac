/** Search for cluster pairs; compiled for every instruction set, like the kernels. */
#ifndef HS_NEIGHBOR_CLUSTER_SEARCH_H
#define HS_NEIGHBOR_CLUSTER_SEARCH_H

#include "neighbor/clusters.h"

/** Find the j-clusters with an atom possibly within `reach` of an atom of local cluster ci: local clusters of the upper
 *  half (each pair of clusters is found once, from one side) and halo clusters all around. Masks leave out pairs of an
 *  atom with itself, pairs met twice within a cluster, and lanes beyond a ragged end. Appends to *entries, growing it.
 *  @p column is the rank of the cluster's column. Not collective; thread-safe for separate lists. */
typedef hs_status (*hs_cluster_search)(const hs_clusters *clusters, const hs_cells *cells, int ci, int column, double reach,
                                       hs_entry_list *entries, hs_error *err);

extern const hs_cluster_search hs_cluster_search_portable, hs_cluster_search_sse2, hs_cluster_search_avx2,
    hs_cluster_search_avx512;

#endif
