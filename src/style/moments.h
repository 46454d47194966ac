/** Mass, place and velocity of the center of mass of a group. */
#ifndef HS_STYLE_MOMENTS_H
#define HS_STYLE_MOMENTS_H

#include "style/places.h"

/** Unwrapped place of a local atom, distance. */
static inline double hs_unwrapped(const hs_env *env, int axis, int i)
{
    const hs_places now = hs_places_now(env);
    return hs_places_unwrapped(&now, env->atoms, axis, i);
}

/** The same for the atoms [begin, end). */
static inline void hs_unwrapped_run(const hs_env *env, int axis, int begin, int end, double *unwrapped)
{
    const hs_box *box = env->box;
    const double *x = env->atoms->x[axis] + begin, length = hs_box_length(box, axis);
    const int32_t *image = env->atoms->image[axis] + begin;
    for (int k = 0; k < end - begin; ++k) unwrapped[k] = x[k] + image[k] * length;
    for (int edge = axis + 1; edge < 3 && box->is_tilted; ++edge) {
        const double tilt = box->tilt[axis + edge - 1];
        const int32_t *crossed = env->atoms->image[edge] + begin;
        for (int k = 0; k < end - begin; ++k) unwrapped[k] += crossed[k] * tilt;
    }
}

/** Total mass of the atoms with a bit of @p mask; center of mass from unwrapped places, or its velocity; 0 without
 *  atoms. Either may be NULL. Collective. */
double hs_center_of_mass(const hs_env *env, uint32_t mask, double x[3], double v[3]);

#endif
