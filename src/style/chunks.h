/** Chunks: a number for each atom that says which part of the system it belongs to now. Compute chunk/atom makes them;
 *  what is summed by chunk reads them through here. */
#ifndef HS_STYLE_CHUNKS_H
#define HS_STYLE_CHUNKS_H

#include "style/compute.h"

/** The state of compute chunk/atom begins with this. compute->atoms holds the chunk of each atom, from 1; 0: none. */
typedef struct hs_chunks {
    int64_t n;          /**< chunks */
    int n_axes;         /**< coordinates of a chunk's center: 0 to 3 */
    double *place;      /**< owned [n][n_axes]: centers, distance or fractions of the box */
    int64_t *original;  /**< owned [n]: numbers before they were compressed; NULL when they were not */
    double volume;      /**< of one chunk: distance^3, distance^2 in two dimensions */
    double *volumes;    /**< owned [n]: where they differ; NULL: all have `volume` */
    int64_t n_locks;    /**< while there are some (hs_chunks_hold), chunks stay as many, and where, they are */
    bool is_compressed; /**< only chunks with atoms have numbers */
    bool is_once;       /**< counted or numbered once: at the start of the first run */
    bool is_by_window;  /**< ids nfreq: numbers, too, stay while there are locks, and only then */
} hs_chunks;

/** The compute chunk/atom of that ID; an error naming @p command otherwise. */
HS_MUST_USE hs_status hs_chunks_find(hs_env *env, const char *id, const char *command, hs_compute **compute,
                                     hs_error *err);
/** Let the compute chunk/atom of that ID keep its chunks, as many and where they are (@p hold), or no longer. *is_holding says whether
 *  the caller, who calls again with false when it ends, has them kept. Without such a compute nothing happens. */
void hs_chunks_hold(hs_env *env, const char *id, bool hold, bool *is_holding);
/** Volume of chunk c, from 0. */
static inline double hs_chunks_volume(const hs_chunks *chunks, int64_t c)
{
    return chunks->volumes != NULL ? chunks->volumes[c] : chunks->volume;
}
static inline hs_chunks *hs_chunks_of(const hs_compute *compute) { return compute->state; }

/** sums[n_bins]: values[n_local] of the atoms with a group bit of @p mask, added up by their bin[n_local], from 1 (0:
 *  none). The same bits for any threads, ranks and order of atoms; exact to 2^-59 of the largest value. Collective. */
HS_MUST_USE hs_status hs_bins_sum(const hs_env *env, uint32_t mask, const double *bin, size_t n_bins,
                                  const double *values, double *sums, hs_error *err);
/** The same by chunk (compute->atoms must be current). */
HS_MUST_USE hs_status hs_chunks_sum(const hs_compute *compute, uint32_t mask, const double *values, double *sums,
                                    hs_error *err);

#endif
