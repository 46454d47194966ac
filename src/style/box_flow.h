/** The velocity with which places of a box move that changes, as fix deform leaves word of it (hs_env.box_flow). */
#ifndef HS_STYLE_BOX_FLOW_H
#define HS_STYLE_BOX_FLOW_H

#include "style/env.h"

typedef struct hs_box_flow {
    double edge[3][3];         /**< how the edges a, b and c change, velocity */
    double corner[3];          /**< of the lower corner, velocity */
    bool sets_length[3];       /**< lengths, */
    bool sets_tilt[3];         /**< and tilts (xy, xz, yz) that are prescribed: no barostat may change them, too */
    uint32_t moves_places;     /**< groups whose atoms are taken along (remap x), */
    uint32_t moves_velocities; /**< or get the velocity of the image that they go over to (remap v) */
} hs_box_flow;

/** The velocity of all places that move with the box: that of the streaming fluid. Linear in the place; 0 where nothing
 *  changes the box. */
typedef struct hs_box_flow_map {
    double at_origin[3];   /**< velocity of the place 0 0 0 */
    double gradient[3][3]; /**< d v_a / d x_b, 1/time; 0 below the diagonal */
} hs_box_flow_map;

/** The map of the present box and flow. */
hs_box_flow_map hs_box_flow_now(const hs_env *env);
/** Velocity of a place. */
static inline void hs_box_flow_at(const hs_box_flow_map *map, double x, double y, double z, double v[3])
{
    const double(*g)[3] = map->gradient;
    v[0] = map->at_origin[0] + g[0][0] * x + g[0][1] * y + g[0][2] * z;
    v[1] = map->at_origin[1] + g[1][1] * y + g[1][2] * z;
    v[2] = map->at_origin[2] + g[2][2] * z;
}
/** An atom with these group bits is brought into the box from n edges away: its velocity v becomes that of its image
 *  there (remap v). */
void hs_box_flow_cross(const hs_env *env, uint32_t mask, const int32_t n[3], double v[3]);
#endif
