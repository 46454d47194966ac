#include "style/box_flow.h"

hs_box_flow_map hs_box_flow_now(const hs_env *env)
{
    const hs_box *box = env->box;
    const double lx = hs_box_length(box, 0), ly = hs_box_length(box, 1), lz = hs_box_length(box, 2);
    const double xy = box->tilt[0], xz = box->tilt[1], yz = box->tilt[2];
    /* d fraction[edge] / d x[axis] */
    const double inverse[3][3] = {{1.0 / lx, -xy / (lx * ly), (xy * yz - ly * xz) / (lx * ly * lz)},
                                  {0.0, 1.0 / ly, -yz / (ly * lz)},
                                  {0.0, 0.0, 1.0 / lz}};
    hs_box_flow_map map = {.at_origin = {0.0}};
    if (env->box_flow == NULL) return map;
    for (int a = 0; a < 3; ++a) {
        map.at_origin[a] = env->box_flow->corner[a];
        for (int b = a; b < 3; ++b) {
            for (int edge = a; edge <= b; ++edge) map.gradient[a][b] += env->box_flow->edge[edge][a] * inverse[edge][b];
            map.at_origin[a] -= map.gradient[a][b] * box->lo[b];
        }
    }
    return map;
}

void hs_box_flow_cross(const hs_env *env, uint32_t mask, const int32_t n[3], double v[3])
{
    const hs_box_flow *flow = env->box_flow;
    if (flow == NULL || !(mask & flow->moves_velocities)) return;
    for (int axis = 0; axis < 3; ++axis)
        for (int edge = axis; edge < 3; ++edge) v[axis] -= n[edge] * flow->edge[edge][axis];
}
