/** The neighbors of each atom, the nearest first: for order parameters of atoms. */
#ifndef HS_STYLE_NEAREST_H
#define HS_STYLE_NEAREST_H

#include "style/compute.h"

/** A neighbor as seen from an atom. */
typedef struct hs_near {
    double r2;   /**< distance^2 */
    double d[3]; /**< to it, distance */
    int64_t id;
    int32_t type; /**< as hs_pair_view.excluded tells types apart */
} hs_near;

/** Neighbors of the local atoms, one atom after the other. Zero it before; free with hs_nearest_fini. */
typedef struct hs_nearest {
    int64_t *start; /**< owned [n + 2] */
    hs_near *item;  /**< owned */
    int n;
} hs_nearest;

/** Distance within which a compute looks for neighbors: @p cutoff, or when that is 0 the cutoff of the pair style; an
 *  error when there is none. */
HS_MUST_USE hs_status hs_nearest_range(const hs_compute *compute, double cutoff, double *range, hs_error *err);
/** Find the neighbors closer than @p range of all local atoms, sorted by distance, then by ID, so that they come in the
 *  same order on any ranks. The first @p n_wanted of each are certain to be there (0: all). Collective. */
HS_MUST_USE hs_status hs_nearest_find(hs_nearest *nearest, hs_env *env, double range, int n_wanted, hs_error *err);
/** The neighbors of local atom i: *n of them, at most @p n_wanted (0: all). */
const hs_near *hs_nearest_of(const hs_nearest *nearest, int i, int n_wanted, int *n);
void hs_nearest_fini(hs_nearest *nearest);

#endif
