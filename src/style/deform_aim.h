/** The box that the paths of fix deform lead to. */
#ifndef HS_STYLE_DEFORM_AIM_H
#define HS_STYLE_DEFORM_AIM_H

#include "style/box_flow.h"
#include "style/deform_path.h"

enum { HS_DEFORM_PATHS = 6 }; /* of the lengths along x, y and z, then of the tilts xy, xz and yz */

typedef struct hs_deformation {
    hs_who who;    /**< the fix, for messages */
    int64_t every; /**< steps between two changes */
    hs_deform_path path[HS_DEFORM_PATHS];
    double start[3][2], start_tilt[3]; /**< bounds and tilts when the run (or series of runs) began, distance */
    double start_time;                 /**< simulated time then */
} hs_deformation;

/** The box that the paths give at the present step, without flips, and how fast it changes. */
typedef struct hs_deform_aim {
    double lo[3], hi[3], tilt[3];
    double length_rate[3], lo_rate[3], tilt_rate[3]; /**< velocity */
} hs_deform_aim;

/** Where the paths lead at the present step; an error when a length would not be above 0 (collective). */
HS_MUST_USE hs_status hs_deform_find_aim(const hs_deformation *d, const hs_env *env, hs_deform_aim *to, hs_error *err);
/** How fast the edges and the lower corner change. */
void hs_deform_set_flow(hs_box_flow *flow, const hs_deform_aim *to);
/** The flow that a run begins with; what is not known before its first change stays as it is in @p flow
 *  (collective). */
HS_MUST_USE hs_status hs_deform_begin_flow(const hs_deformation *d, const hs_env *env, hs_box_flow *flow,
                                           hs_error *err);

#endif
