/** Fixes and commands that change the box, and bring atoms along. */
#ifndef HS_STYLE_BOX_CHANGE_H
#define HS_STYLE_BOX_CHANGE_H

#include "style/env.h"

/** Give the box new bounds and, where it is tilted, tilts (@p tilt NULL: those it has; not read in an orthogonal box).
 *  Atoms with a group bit of @p mask keep their fractions of the box (0: all atoms stay where they are). In
 *  reproducible runs bounds, tilts and displacements are rounded to the position grid, and an atom that follows moves
 *  alike in all its periodic images. One that stays does so in the image it is in, as in LAMMPS. Not collective; the
 *  same on all ranks. */
void hs_box_change(hs_env *env, const double lo[3], const double hi[3], const double tilt[3], uint32_t mask);

/** A box that becomes another: how places in it move. */
typedef struct hs_box_map {
    hs_box from, to;
    double inv_length[3];      /**< of the box before */
    double corner[3];          /**< by which the lower corner moves, */
    double length[3], tilt[3]; /**< and by which the edges grow, distance */
} hs_box_map;
hs_box_map hs_box_map_make(const hs_box *from, const hs_box *to);
/** Move a place along, as its image in the box does: it keeps its fractions. The displacement is rounded (@p magic, see
 *  hs_env). Exactly nothing moves when both boxes are the same. */
void hs_box_map_move(const hs_box_map *map, double magic, double x[3]);

/* For fixes that change tilts, in their hook pre_exchange: atoms are brought into the box after it. Not collective. */

/** The same lattice of periodic images with other edges: b becomes b + n[0] a, c becomes c + n[1] a + n[2] b, so that
 *  xy grows by n[0] lx, yz by n[2] ly, xz by n[1] lx + n[2] xy. Atoms stay where they are, and their image flags count
 *  the new edges; into the new box they come when they are wrapped. */
void hs_box_flip(hs_env *env, const int32_t n[3]);
/** Bring all atoms into the box. Those with a group bit of @p mask get the velocity of the image they go over to: edges
 *  change by rate[0] (of a), rate[1] (b), rate[2] (c) a unit of time, velocity. */
void hs_box_wrap_flowing(hs_env *env, const double rate[3][3], uint32_t mask);

#endif
