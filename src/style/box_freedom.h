/** Coordinates of the box that a minimisation of the energy moves together with those of the atoms. A fix that has
 *  them relaxes the box. */
#ifndef HS_STYLE_BOX_FREEDOM_H
#define HS_STYLE_BOX_FREEDOM_H

#include "core/box.h"

struct hs_fix;

/** Coordinates: strains along x, y, z, then of the tilts xy, xz, yz. Those that stay have no force. */
enum { HS_BOX_COORDINATES = 6 };

/** What such a fix does. Nothing here is of one rank alone: all ranks do and get the same. */
typedef struct hs_box_freedom {
    /** A minimisation begins in the present box: all coordinates are 0 there. Not called where one is resumed. */
    void (*begin)(struct hs_fix *fix);
    /** Energy of the box and forces along its coordinates (energy; coordinates have no unit), with the virial of the
     *  latest forces. */
    HS_MUST_USE hs_status (*measure)(struct hs_fix *fix, double *energy, double force[HS_BOX_COORDINATES],
                                     hs_error *err);
    /** Take new coordinates from the last ones that were kept: those + alpha direction. @p box becomes the box that
     *  has them. */
    void (*place)(struct hs_fix *fix, double alpha, const double direction[HS_BOX_COORDINATES], hs_box *box);
    /** Keep the present coordinates. */
    void (*keep)(struct hs_fix *fix);
    /** Largest |alpha direction| that a step may have. */
    double (*farthest)(const struct hs_fix *fix);
    /** After an iteration: whether energy and forces are others from now on, though nothing has moved. */
    bool (*renew)(struct hs_fix *fix);
    /** Number of coordinates, for the length of a cycle of search directions. */
    int (*count)(const struct hs_fix *fix);
    /** Group bits of the atoms that follow the box. */
    uint32_t (*followers)(const struct hs_fix *fix);
} hs_box_freedom;

#endif
