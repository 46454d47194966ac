/** Clusters packed for the kernels of mixed precision: sixteen 32-bit numbers for each, one line of the cache.
 *
 *  They are the x, y, z of the four atoms, as whole multiples of a unit of length, and their kernel types; a second array
 *  of the same shape takes their forces in single precision. Against reading and converting the atoms' own arrays, a vector
 *  of eight pairs needs six aligned loads and stores of half the size, and no conversion of forces.
 *  Clusters are numbered local ones first, then halo ones; what stands for an atom's index in lists and kernels is then
 *  16 times the cluster's number. */
#ifndef HS_KERNEL_PACKED_H
#define HS_KERNEL_PACKED_H

#include "core/atoms.h"
#include "kernel/kernel.h"
#include "neighbor/clusters.h"

enum {
    HS_PACKED = 16,            /**< numbers of a cluster */
    HS_PACKED_TYPES = 12,      /**< its types are from here on */
    HS_PACKED_BLOCK_BITS = 10, /**< forces are cleared and unpacked in blocks of 64 clusters */
    HS_PACKED_BLOCK = 1 << HS_PACKED_BLOCK_BITS,
};

/** Zero it before use. */
typedef struct hs_packed {
    int32_t *site;        /**< owned [n][16] */
    int32_t *site_listed; /**< owned [n][16]: of the listed positions; filled only for kernels that ask for them */
    double *radius;    /**< owned [n][16], of which the first four: atoms' radii; filled only where they are needed */
    int32_t *place_of; /**< owned [n_atoms]: 16 times the number of the cluster that begins with the atom */
    int n;             /**< clusters */
    int64_t capacity, capacity_listed, capacity_radius, capacity_atoms;
    double unit; /**< distance: a power of two. Whole numbers wrap around: only differences of neighbors count */
    const int32_t *type;         /**< borrowed from the input in use: what is packed */
    const double *source_radius; /**< borrowed, NULL where it has none */
    double origin[3];            /**< where 0 is: an atom, so that the numbers to be rounded are small */
} hs_packed;

/** Number the clusters, and choose unit and origin for the atoms' present positions; @p reach: distance within which
 *  clusters are neighbors. */
HS_MUST_USE hs_status hs_packed_begin(hs_packed *packed, const hs_clusters *clusters, const hs_atoms *atoms,
                                      double reach, hs_error *err);
/** Have *in, which names the atoms' arrays, read packed clusters, which hs_packed_fill must fill. */
HS_MUST_USE hs_status hs_packed_use(hs_packed *packed, hs_kernel_input *in, hs_error *err);
/** Pack clusters [begin, end): present positions and types, and of *in what it has of radii and listed positions. Threaded. */
void hs_packed_fill(hs_packed *packed, const hs_clusters *clusters, const hs_kernel_input *in, int begin, int end);
/** Turn entries that name atoms into entries that name packed clusters. */
void hs_packed_rename(const hs_packed *packed, hs_cluster_entry *entry, int n);
/** First atom of a packed cluster. */
static inline int hs_packed_atom(const hs_clusters *clusters, int place)
{
    const int c = place / HS_PACKED, n_local = clusters->local.n;
    return c < n_local ? clusters->local.entry[c].first : clusters->halo.entry[c - n_local].first;
}

/** The atoms' forces of one block of clusters: the sum of what n_parts arrays (as `site`, in float) hold there; added to
 *  what the atoms have if is_added. */
void hs_packed_unpack(const hs_packed *packed, const hs_clusters *clusters, int64_t block, const float *const *part,
                      int n_parts, hs_atoms *atoms, bool is_added);

void hs_packed_fini(hs_packed *packed);

#endif
