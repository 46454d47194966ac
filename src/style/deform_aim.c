#include "style/deform_aim.h"

#include <math.h>
#include <string.h>

#include "style/box_shape.h"

/** Simulated time since the start of the run (or series of runs), in which the timestep may have changed. */
static double time_since_start(const hs_deformation *d, const hs_env *env)
{
    if (env->time_origin_step <= env->first_step) return (double)(env->step - env->ramp_start) * env->dt;
    return env->time_origin - d->start_time + (double)(env->step - env->time_origin_step) * env->dt;
}

static hs_status aim_axis(const hs_deformation *d, const hs_env *env, int axis, hs_deform_aim *to, hs_error *err)
{
    const hs_deform_path *path = &d->path[axis];
    const double *begin = d->start[axis], length = begin[1] - begin[0];
    double growth[2], rate[2];
    to->lo[axis] = env->box->lo[axis];
    to->hi[axis] = env->box->hi[axis];
    to->lo_rate[axis] = to->length_rate[axis] = 0.0;
    if (path->style == HS_DEFORM_NOT) return HS_OK;
    if (path->style == HS_DEFORM_FINAL || path->style == HS_DEFORM_DELTA) {
        for (int k = 0; k < 2; ++k) {
            const hs_deform_start start = {.value = begin[k], .k = k};
            HS_TRY(hs_deform_growth(path, env, &start, &growth[k], &rate[k], err));
        }
    } else { /* the same at both ends */
        const hs_deform_start start = {.length = length, .time = time_since_start(d, env), .every = d->every};
        HS_TRY(hs_deform_growth(path, env, &start, &growth[1], &rate[1], err));
        growth[1] *= 0.5, rate[1] *= 0.5;
        growth[0] = -growth[1], rate[0] = -rate[1];
    }
    to->lo[axis] = begin[0] + growth[0];
    to->hi[axis] = begin[1] + growth[1];
    to->lo_rate[axis] = rate[0];
    to->length_rate[axis] = rate[1] - rate[0];
    if (to->hi[axis] > to->lo[axis]) return HS_OK;
    return hs_fail(err, HS_ERROR_RUN, "%s: at step %lld the box would reach from %g to %g in %c", d->who.text,
                   (long long)env->step, to->lo[axis], to->hi[axis], "xyz"[axis]);
}

static hs_status aim_tilt(const hs_deformation *d, const hs_env *env, int tilt, hs_deform_aim *to, hs_error *err)
{
    const hs_deform_path *path = &d->path[3 + tilt];
    const double *across = d->start[hs_tilt_second(tilt)], begin = d->start_tilt[tilt];
    const hs_deform_start start = {.value = begin,
                                   .length = path->style == HS_DEFORM_TRUE_RATE ? begin : across[1] - across[0],
                                   .time = time_since_start(d, env),
                                   .every = d->every};
    double growth;
    HS_TRY(hs_deform_growth(path, env, &start, &growth, &to->tilt_rate[tilt], err));
    to->tilt[tilt] = begin + growth;
    return HS_OK;
}

/** The axes that keep the volume make up for the others that are deformed; two of them share that. What else changes the box (atoms
 *  in shrink-wrapped faces, a barostat) is no matter, as in LAMMPS. */
static void keep_volume(const hs_deformation *d, hs_deform_aim *to)
{
    double ratio = 1.0,
           growing = 0.0; /* volume at the start over that which the other axes would give; its rate, 1/time */
    int n_volumes = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double *begin = d->start[axis], length = to->hi[axis] - to->lo[axis];
        const bool is_volume = d->path[axis].style == HS_DEFORM_VOLUME;
        n_volumes += is_volume;
        if (is_volume || d->path[axis].style == HS_DEFORM_NOT) continue;
        ratio *= (begin[1] - begin[0]) / length;
        growing += to->length_rate[axis] / length;
    }
    for (int axis = 0; axis < 3; ++axis) {
        const double *begin = d->start[axis];
        if (d->path[axis].style != HS_DEFORM_VOLUME) continue;
        const double middle = 0.5 * (begin[0] + begin[1]),
                     half = 0.5 * (begin[1] - begin[0]) * (n_volumes == 2 ? sqrt(ratio) : ratio);
        to->lo[axis] = middle - half;
        to->hi[axis] = middle + half;
        to->length_rate[axis] = -2.0 * half * growing / n_volumes;
        to->lo_rate[axis] = -0.5 * to->length_rate[axis];
    }
}

hs_status hs_deform_find_aim(const hs_deformation *d, const hs_env *env, hs_deform_aim *to, hs_error *err)
{
    for (int axis = 0; axis < 3; ++axis) HS_TRY(aim_axis(d, env, axis, to, err));
    for (int tilt = 0; tilt < 3; ++tilt) HS_TRY(aim_tilt(d, env, tilt, to, err));
    keep_volume(d, to);
    return HS_OK;
}

void hs_deform_set_flow(hs_box_flow *flow, const hs_deform_aim *to)
{
    const double edge[3][3] = {{to->length_rate[0], 0.0, 0.0},
                               {to->tilt_rate[0], to->length_rate[1], 0.0},
                               {to->tilt_rate[1], to->tilt_rate[2], to->length_rate[2]}};
    memcpy(flow->edge, edge, sizeof edge);
    memcpy(flow->corner, to->lo_rate, sizeof flow->corner);
}

/** Rates of some styles are known once the box has changed, as in LAMMPS: variables cannot be asked before a run. */
static bool is_known_before(const hs_deform_path *path)
{
    return path->style != HS_DEFORM_TRUE_RATE && path->style != HS_DEFORM_WIGGLE && path->style != HS_DEFORM_VARIABLE;
}

hs_status hs_deform_begin_flow(const hs_deformation *d, const hs_env *env, hs_box_flow *flow, hs_error *err)
{
    hs_deform_aim to = {.lo = {0.0}};
    for (int axis = 0; axis < 3; ++axis) {
        to.lo[axis] = env->box->lo[axis];
        to.hi[axis] = env->box->hi[axis];
        to.length_rate[axis] = flow->edge[axis][axis];
        to.lo_rate[axis] = flow->corner[axis];
        if (is_known_before(&d->path[axis])) HS_TRY(aim_axis(d, env, axis, &to, err));
    }
    for (int tilt = 0; tilt < 3; ++tilt) {
        to.tilt_rate[tilt] = flow->edge[hs_tilt_second(tilt)][hs_tilt_first(tilt)];
        if (is_known_before(&d->path[3 + tilt])) HS_TRY(aim_tilt(d, env, tilt, &to, err));
    }
    keep_volume(d, &to);
    hs_deform_set_flow(flow, &to);
    return HS_OK;
}
