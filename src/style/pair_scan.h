/** Pairs of atoms within any range, at the present positions: for what is measured from pairs.
 *
 *  Independent of the neighbor method, its lists and their range: a scan copies the positions, makes a halo of its own as
 *  wide as asked for, sorts all into cells and visits each pair once. It costs some timesteps' time and about 100 bytes an
 *  atom while it lasts. On several ranks each pair is visited on one of them. */
#ifndef HS_STYLE_PAIR_SCAN_H
#define HS_STYLE_PAIR_SCAN_H

#include "comm/halo.h"
#include "style/env.h"

enum { HS_PAIR_BATCH = 256 };

/** Some pairs: atom i is local, j local or of the scan's halo (j >= n_local). */
typedef struct hs_pair_batch {
    int n;
    int32_t i[HS_PAIR_BATCH], j[HS_PAIR_BATCH];
    double dx[3][HS_PAIR_BATCH]; /**< r_j - r_i, distance */
    double r2[HS_PAIR_BATCH];    /**< distance^2 */
} hs_pair_batch;

/** Called by several threads at once, each with a number below hs_threads_get(). */
typedef void (*hs_pair_visit)(void *context, int thread, const hs_pair_batch *batch);

typedef struct hs_pair_scan {
    double range;   /**< pairs closer than this */
    hs_atoms atoms; /**< owned: copies of local atoms (same indices), and the scan's own halo: x, type, id, mask */
    hs_halo halo;   /**< owned */
    int n_all;      /**< local and halo atoms */
    double lo[3], inv_edge[3];
    int n_cells[3];
    int32_t *source_of; /**< owned [n_halo]: local index of the original of a halo atom, -1: on another rank */
    int32_t *start; /**< owned [cells + 1] */
    int32_t *index; /**< owned [n_all]: atoms in the order of cells */
    double *x[3];   /**< owned [n_all]: their positions in that order */
    uint32_t *mask; /**< atom field of the copies with room for the halo */
    int64_t *id;    /**< the same */
} hs_pair_scan;

/** Get ready to visit pairs (collective). Zero the scan before; always followed by hs_pair_scan_end, also after an error. */
HS_MUST_USE hs_status hs_pair_scan_begin(hs_pair_scan *scan, const hs_env *env, double range, hs_error *err);
/** Visit every pair once, in the same batches for any number of threads, though on different ones. Not collective. */
void hs_pair_scan_visit(const hs_pair_scan *scan, hs_pair_visit visit, void *context);
/** Values per atom, summed over pairs by the threads: scan->atoms.f of the local and halo atoms is three such values. Add
 *  those of halo atoms to their owners' (collective). */
void hs_pair_scan_reverse(hs_pair_scan *scan);
/** Local index of a halo atom whose original is on this rank; -1 when it is another's. */
int hs_pair_scan_source(const hs_pair_scan *scan, int j);
void hs_pair_scan_end(hs_pair_scan *scan);

#endif
