/** The velocity with which places of a box move that changes, as fix deform leaves word of it (hs_env.box_flow). */
#ifndef HS_STYLE_BOX_FLOW_H
#define HS_STYLE_BOX_FLOW_H

#include "style/env.h"

typedef struct hs_box_flow {
    double edge[3][3];         /**< how the edges a, b and c change, velocity */
    double corner[3];          /**< of the lower corner, velocity */
    uint32_t moves_places;     /**< groups whose atoms are taken along (remap x), */
    uint32_t moves_velocities; /**< or get the velocity of the image that they go over to (remap v) */
} hs_box_flow;

/** Velocity of a place that moves with the box: the streaming velocity of a fluid that follows it. 0 where nothing changes the box. */
void hs_box_flow_at(const hs_env *env, const double x[3], double v[3]);
/** An atom with these group bits is brought into the box from n edges away: its velocity v becomes that of its image there (remap v). */
void hs_box_flow_cross(const hs_env *env, uint32_t mask, const int32_t n[3], double v[3]);
/** Gradient of that velocity: gradient[a][b] = d v_a / d x_b, 1/time; 0 below the diagonal. */
void hs_box_flow_gradient(const hs_env *env, double gradient[3][3]);

#endif
