/** The box cut into one brick for each rank.
 *
 *  Planes cut the whole box across: n[axis] bricks along an axis have n[axis] + 1 planes, the first and the last of which
 *  are the faces of the box. Planes are kept as fractions of the box, so that they follow a box that changes. Along axes
 *  that are not periodic the outer bricks reach to infinity: they own what lies beyond the faces. All ranks hold the same
 *  numbers and compute the same planes from them, bit for bit. In a tilted box planes lie parallel to its faces, and places are
 *  compared with them by hs_box_upright. */
#ifndef HS_COMM_DOMAIN_H
#define HS_COMM_DOMAIN_H

#include "core/box.h"
#include "parallel/parallel.h"

typedef struct hs_domain {
    int wanted[3];  /**< bricks per axis that the command `processors` asks for; 0: free */
    int n[3];       /**< bricks per axis; 0: the box is not cut yet */
    int at[3];      /**< this rank's brick */
    double *cut[3]; /**< owned [n + 1]: planes as fractions of the box, 0 = cut[0] < ... < cut[n] = 1 */
    int rank, n_ranks;
} hs_domain;

/** One brick of n per axis until hs_domain_divide. */
void hs_domain_init(hs_domain *domain, const hs_parallel *parallel);
void hs_domain_fini(hs_domain *domain);
/** Cut the box into equal bricks, as many as there are ranks, with the least surface between them that `wanted` allows.
 *  The same on all ranks, not collective. */
HS_MUST_USE hs_status hs_domain_divide(hs_domain *domain, const hs_box *box, hs_error *err);
static inline bool hs_domain_is_divided(const hs_domain *domain) { return domain->n[0] > 0; }

/** Plane k of an axis, in the coordinate of hs_box_upright. Planes below 0 and above n are those of the periodic images. */
double hs_domain_plane(const hs_domain *domain, const hs_box *box, int axis, int k);
/** Bounds of this rank's brick, of what encloses it in a tilted box: lower faces belong to it, upper ones to the next brick. */
void hs_domain_brick(const hs_domain *domain, const hs_box *box, double lo[3], double hi[3]);
/** Volume of this rank's brick, area in 2D. */
double hs_domain_volume(const hs_domain *domain, const hs_box *box);
/** Which brick of an axis owns the place with the coordinate x (hs_box_upright), which must have been wrapped into the box. */
int hs_domain_owner(const hs_domain *domain, const hs_box *box, int axis, double x);
/** Whether this rank's brick owns the place. */
bool hs_domain_owns(const hs_domain *domain, const hs_box *box, const double x[3]);
/** Rank of a brick; coordinates outside of 0 .. n - 1 are those of periodic images. */
int hs_domain_rank(const hs_domain *domain, const int at[3]);

#endif
