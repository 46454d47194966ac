/** Mass, place and velocity of the center of mass of a group. */
#ifndef HS_STYLE_MOMENTS_H
#define HS_STYLE_MOMENTS_H

#include "style/env.h"

/** Total mass of the atoms with a bit of @p mask; center of mass from unwrapped places, or its velocity; 0 without
 *  atoms. Either may be NULL. Collective. */
double hs_center_of_mass(const hs_env *env, uint32_t mask, double x[3], double v[3]);

#endif
