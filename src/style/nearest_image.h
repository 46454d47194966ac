/** Nearest periodic images. */
#ifndef HS_STYLE_NEAREST_IMAGE_H
#define HS_STYLE_NEAREST_IMAGE_H

#include <math.h>

#include "core/box.h"

/** Take whole edges off a difference of two places, along z, then y, then x, so that it is no longer than half of the
 *  box in any of them. If one of its images is shorter than half of the distance between any two faces, it is that
 *  one. */
static inline void hs_nearest_image(const hs_box *box, double d[3])
{
    for (int axis = 2; axis >= 0; --axis) {
        if (!box->periodic[axis]) continue;
        const double n = nearbyint(d[axis] / hs_box_length(box, axis));
        if (n == 0.0) continue;
        d[axis] -= n * hs_box_length(box, axis);
        for (int before = 0; before < axis && box->is_tilted; ++before) d[before] -= n * box->tilt[before + axis - 1];
    }
}

#endif
