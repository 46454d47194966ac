/** Where in a rank's brick its atoms are: a droplet fills a small part of its box, and a grid must be made for that part. */
#ifndef HS_NEIGHBOR_OCCUPIED_H
#define HS_NEIGHBOR_OCCUPIED_H

#include "core/atoms.h"

typedef struct hs_occupied {
    double lo[3], hi[3]; /**< what bounds the atoms; faces of the brick where atoms are near them; distance */
    double volume;       /**< of the boxes of the given edge that hold atoms; area in 2D */
} hs_occupied;

/** Look where the local atoms are in the brick from lo to hi. Without atoms it is all of it. Not collective; threaded, the result
 *  does not depend on the number of threads. */
HS_MUST_USE hs_status hs_occupied_find(hs_occupied *occupied, const double lo[3], const double hi[3], int dimension,
                                       double edge, const hs_atoms *atoms, hs_error *err);

#endif
