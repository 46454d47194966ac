/** The simulation box: extent, boundary conditions, periodic images.
 *
 *  A box is spanned by the edges a = (lx, 0, 0), b = (xy, ly, 0), c = (xz, yz, lz) from its corner `lo`; all tilts are 0 in an
 *  orthogonal box. `hi` is lo + (lx, ly, lz), as in LAMMPS: the far corner before tilting. */
#ifndef HS_CORE_BOX_H
#define HS_CORE_BOX_H

#include <stdint.h>

#include "base/error.h"

typedef enum {
    HS_BOUNDARY_PERIODIC = 'p',
    HS_BOUNDARY_FIXED = 'f',     /**< atoms that leave are lost */
    HS_BOUNDARY_SHRINK = 's',    /**< the face follows the outermost atom, at each rebuild */
    HS_BOUNDARY_SHRINK_MIN = 'm' /**< the same, but never inside its starting place */
} hs_boundary;

typedef struct hs_box {
    int dimension;       /**< 2 or 3; in 2D z is periodic and atoms stay at z = 0 unless a fix moves them */
    bool exists;         /**< create_box or read_data has been */
    double lo[3], hi[3]; /**< distance units */
    bool is_tilted;      /**< triclinic: it may have tilts, though all may be 0 at the moment */
    double tilt[3];      /**< xy, xz, yz: distance; 0 unless is_tilted, and where the second axis is not periodic */
    hs_boundary boundary[3][2]; /**< [axis][lo, hi] */
    bool periodic[3];
    double shrink_margin[3];   /**< gap between a shrink-wrapped face and its outermost atom; from the first box */
    double shrink_limit[3][2]; /**< for 'm' faces: the place they may not move inside of */
} hs_box;

/** 3D, periodic, nothing created. */
void hs_box_init(hs_box *box);
static inline double hs_box_length(const hs_box *box, int axis) { return box->hi[axis] - box->lo[axis]; }
/** The vector `n` edges long: n[0] a + n[1] b + n[2] c. Exact where lengths and tilts are multiples of a common power of two. */
void hs_box_shift(const hs_box *box, const int32_t n[3], double shift[3]);
/** Coordinates of x along the edges: 0 at the lower faces, 1 at the upper ones. */
void hs_box_fractions(const hs_box *box, const double x[3], double fraction[3]);
/** The place that has these coordinates along the edges. */
void hs_box_place(const hs_box *box, const double fraction[3], double x[3]);
/** Coordinate of x along an axis, distance, in the box pushed upright: lo and hi of the axis at its two faces, x[axis] itself in an
 *  orthogonal box. Bricks, halos and wrapping decide by it. */
static inline double hs_box_upright(const hs_box *box, const double x[3], int axis)
{
    if (!box->is_tilted || axis == 2) return x[axis];
    const double c = (x[2] - box->lo[2]) / hs_box_length(box, 2), y = x[1] - box->tilt[2] * c;
    if (axis == 1) return y;
    return x[0] - box->tilt[0] * ((y - box->lo[1]) / hs_box_length(box, 1)) - box->tilt[1] * c;
}
/** What a distance from a face comes to in that coordinate: all places nearer to a face than `reach` are nearer in it than this. */
double hs_box_reach(const hs_box *box, int axis, double reach);
/** Coordinate of a place without images: x and its images, n edges from there. */
static inline double hs_box_unwrapped(const hs_box *box, const double x[3], const int32_t n[3], int axis)
{
    const double along = x[axis] + n[axis] * hs_box_length(box, axis);
    if (!box->is_tilted || axis == 2) return along;
    return axis == 1 ? along + n[2] * box->tilt[2] : along + (n[1] * box->tilt[0] + n[2] * box->tilt[1]);
}
/** Distance between the two faces that axis's edge joins: hs_box_length in an orthogonal box. */
double hs_box_thickness(const hs_box *box, int axis);
/** The smallest orthogonal box around it (what dumps of tilted boxes give). */
void hs_box_bounds(const hs_box *box, double lo[3], double hi[3]);
/** Refuse tilts that a box cannot have: along an axis that is not periodic, out of the plane of two dimensions, or none at all in a box
 *  that is not tilted. @p command begins the message. */
HS_MUST_USE hs_status hs_box_check_tilt(const hs_box *box, const char *command, hs_error *err);
/** Volume, or area in 2D (LAMMPS counts the z extent out of 2D volumes). */
double hs_box_volume(const hs_box *box);
/** Finish a box that was just given its bounds: shrink-wrapped faces start a ten-thousandth of the box outside, as in
 *  LAMMPS, so that atoms on the bounds are within; 'm' faces remember their place. */
void hs_box_settle_faces(hs_box *box);
/** Bring x, which may be some boxes away, into the box along periodic axes and count the crossings in image. Exact when x is inside
 *  already. In a tilted box rounding may leave a place on a face a hair outside. */
void hs_box_wrap(const hs_box *box, double x[3], int32_t image[3]);
/** Boxes away that 32-bit image flags can count. */
#define HS_BOX_FARTHEST 1e9
/** The same in a tilted box, with shifts that are whole edges in every bit; false, with x as it was found, when x is farther away than so
 *  many boxes along an axis. */
bool hs_box_wrap_tilted(const hs_box *box, double farthest, double x[3], int32_t image[3]);

#endif
