#include "style/chunk_bins.h"

#include <math.h>
#include <string.h>

#include "core/lattice.h"

static const char *const axis_names[] = {"x", "y", "z", NULL};

hs_status hs_chunk_bins_read(hs_chunk_bins *bins, const hs_env *env, const hs_args *args, int n_axes, hs_error *err)
{
    static const char *const origins[] = {"lower", "center", "upper", NULL};
    bins->n_axes = n_axes;
    for (int k = 0; k < n_axes; ++k) {
        hs_bins_axis *b = &bins->axis[k];
        int origin = 0;
        HS_TRY(hs_arg_need(args, 3 * k + 3, "an axis, an origin and a width of bins", err));
        HS_TRY(hs_arg_choice(args, 3 * k + 1, axis_names, &b->axis, err));
        for (int j = 0; j < k; ++j)
            if (bins->axis[j].axis == b->axis)
                return hs_arg_refuse(args, 3 * k + 1, "an axis that has no bins yet", NULL, err);
        if (b->axis == 2 && env->box->dimension == 2)
            return hs_arg_refuse(args, 3 * k + 1, "an axis of a two-dimensional box", NULL, err);
        b->from = HS_BINS_FROM_NUMBER;
        while (origins[origin] != NULL && strcmp(args->word[3 * k + 2], origins[origin]) != 0) ++origin;
        if (origins[origin] != NULL)
            b->from = (hs_bins_origin)origin;
        else if (hs_arg_double(args, 3 * k + 2, &b->origin, err) != HS_OK) {
            hs_error_clear(err);
            return hs_arg_refuse(args, 3 * k + 2, "lower, center, upper or a number", origins, err);
        }
        HS_TRY(hs_arg_positive(args, 3 * k + 3, &b->delta, err));
    }
    return HS_OK;
}

hs_status hs_chunk_bins_read_bound(hs_chunk_bins *bins, const hs_args *args, int i, hs_error *err)
{
    static const char *const faces[] = {"lower", "upper"};
    int axis, k = 0;
    HS_TRY(hs_arg_choice(args, i, axis_names, &axis, err));
    while (k < bins->n_axes && bins->axis[k].axis != axis) ++k;
    if (k == bins->n_axes) return hs_arg_refuse(args, i, "an axis along which there are bins", NULL, err);
    hs_bins_axis *b = &bins->axis[k];
    for (int end = 0; end < 2; ++end) {
        b->has_bound[end] = strcmp(args->word[i + 1 + end], faces[end]) != 0;
        if (b->has_bound[end]) HS_TRY(hs_arg_double(args, i + 1 + end, &b->bound[end], err));
    }
    if (b->has_bound[0] && b->has_bound[1] && !(b->bound[0] < b->bound[1]))
        return hs_arg_refuse(args, i + 2, "above the lower bound", NULL, err);
    return HS_OK;
}

/** `rmin rmax n` from word i on. */
static hs_status read_shells(hs_bins_shells *shells, const hs_args *args, int i, hs_error *err)
{
    for (int k = 0; k < 2; ++k) HS_TRY(hs_arg_double(args, i + k, &shells->radius[k], err));
    if (shells->radius[0] < 0.0) return hs_arg_refuse(args, i, "a radius of at least 0", NULL, err);
    if (!(shells->radius[0] < shells->radius[1]))
        return hs_arg_refuse(args, i + 1, "larger than the inner radius", NULL, err);
    return hs_arg_int(args, i + 2, 1, INT32_MAX, &shells->n, err);
}

hs_status hs_chunk_bins_read_sphere(hs_chunk_bins *bins, const hs_args *args, hs_error *err)
{
    HS_TRY(hs_arg_need(args, 6, "the center of a sphere, two radii and a number of shells", err));
    for (int axis = 0; axis < 3; ++axis) HS_TRY(hs_arg_double(args, 1 + axis, &bins->shells.center[axis], err));
    return read_shells(&bins->shells, args, 4, err);
}

hs_status hs_chunk_bins_read_cylinder(hs_chunk_bins *bins, const hs_env *env, const hs_args *args, hs_error *err)
{
    if (env->box->dimension == 2)
        return hs_fail(err, HS_ERROR_INPUT,
                       "%s: bin/cylinder needs three dimensions; in two, bin/sphere makes rings around a point",
                       args->command);
    HS_TRY(hs_chunk_bins_read(bins, env, args, 1, err));
    HS_TRY(hs_arg_need(args, 8, "where the axis of the cylinder is, two radii and a number of shells", err));
    for (int axis = 0, i = 4; axis < 3; ++axis)
        if (axis != bins->axis[0].axis) HS_TRY(hs_arg_double(args, i++, &bins->shells.center[axis], err));
    return read_shells(&bins->shells, args, 6, err);
}

void hs_chunk_bins_scale(hs_chunk_bins *bins, const hs_env *env)
{
    const double *spacing = env->lattice->spacing;
    if (bins->units != HS_BINS_LATTICE) return;
    for (int k = 0; k < bins->n_axes; ++k) {
        hs_bins_axis *b = &bins->axis[k];
        b->origin *= spacing[b->axis];
        b->delta *= spacing[b->axis];
        /* as in LAMMPS, which takes the number of the axis among those with bins for the axis itself: x of bin/1d x is scaled,
           z of bin/1d z is not */
        if (b->axis >= bins->n_axes) continue;
        for (int end = 0; end < 2; ++end) b->bound[end] *= spacing[bins->axis[b->axis].axis];
    }
    if (bins->n_axes > 0) return; /* c1, c2 and radii of cylinders are distances in LAMMPS, too */
    for (int axis = 0; axis < 3; ++axis) bins->shells.center[axis] *= spacing[axis];
    for (int end = 0; end < 2; ++end) bins->shells.radius[end] *= spacing[0];
}

/** @p axis_of_radius is that whose length makes fractions of the box radii. */
static void lay_shells(hs_bins_shells *shells, const hs_box *box, bool is_reduced, int axis_of_radius)
{
    for (int axis = 0; axis < 3; ++axis)
        shells->place[axis] =
            is_reduced ? box->lo[axis] + shells->center[axis] * hs_box_length(box, axis) : shells->center[axis];
    for (int end = 0; end < 2; ++end)
        shells->ends[end] = shells->radius[end] * (is_reduced ? hs_box_length(box, axis_of_radius) : 1.0);
}

/** The bins of an axis: edges are at origin + i delta, and as few as cover the range. */
static hs_status lay_axis(hs_bins_axis *b, const hs_box *box, bool is_reduced, const char *command, hs_error *err)
{
    const double lo = is_reduced ? 0.0 : box->lo[b->axis], hi = is_reduced ? 1.0 : box->hi[b->axis];
    const double range[2] = {b->has_bound[0] ? b->bound[0] : lo, b->has_bound[1] ? b->bound[1] : hi};
    const double from[] = {range[0], 0.5 * (range[0] + range[1]), range[1], b->origin};
    const double origin = from[b->from];
    double end[2];
    for (int k = 0; k < 2; ++k) {
        const double bound = range[k], sign = bound < origin ? -1.0 : 1.0;
        const double hair =
            1e-9 * b->delta; /* the box of a reproducible run is rounded: that makes no bin of its own */
        /* whole bins towards the bound; one more where these do not reach it */
        end[k] = origin + sign * trunc((fabs(bound - origin) + hair) / b->delta) * b->delta;
        if (k == 0 ? end[k] > bound + hair : end[k] < bound - hair) end[k] += k == 0 ? -b->delta : b->delta;
    }
    const double n = floor((end[1] - end[0]) / b->delta + 0.5);
    if (!(n >= 1.0 && n <= INT32_MAX))
        return hs_fail(err, HS_ERROR_INPUT, "%s: %.10g bins along %s; there must be 1 to %d", command, n,
                       axis_names[b->axis], INT32_MAX);
    b->offset = end[0];
    b->n = (int64_t)n;
    return HS_OK;
}

hs_status hs_chunk_bins_lay(hs_chunk_bins *bins, const hs_env *env, const char *command, int64_t *n, double *volume,
                            hs_error *err)
{
    const hs_box *box = env->box;
    const bool is_reduced = bins->units == HS_BINS_REDUCED;
    if (box->is_tilted && ((bins->n_axes > 0 && !is_reduced) || bins->shells.n > 0))
        return hs_fail(err, HS_ERROR_INPUT, "%s: in a tilted box bins must be slabs in units reduced", command);
    *n = 1;
    *volume = 1.0;
    for (int axis = 0; axis < box->dimension; ++axis) *volume *= hs_box_length(box, axis);
    if (bins->shells.n > 0) {
        lay_shells(&bins->shells, box, is_reduced, bins->n_axes > 0 && bins->axis[0].axis == 0 ? 1 : 0);
        *n = bins->shells.n;
    }
    for (int k = 0; k < bins->n_axes; ++k) {
        hs_bins_axis *b = &bins->axis[k];
        HS_TRY(lay_axis(b, box, is_reduced, command, err));
        if (b->n > INT32_MAX / *n)
            return hs_fail(err, HS_ERROR_INPUT, "%s: there are more than %d bins", command, INT32_MAX);
        *n *= b->n;
        *volume *= is_reduced ? b->delta : b->delta / hs_box_length(box, b->axis);
    }
    return HS_OK;
}

double hs_chunk_bins_volume(const hs_chunk_bins *bins, const hs_box *box, int64_t c, double volume)
{
    const hs_bins_shells *shells = &bins->shells;
    if (shells->n == 0) return volume;
    const int64_t n_planes = bins->n_axes > 0 ? bins->axis[0].n : 1;
    const double width = (shells->ends[1] - shells->ends[0]) / (double)shells->n;
    const double inner = shells->ends[0] + (double)(c / n_planes) * width, outer = inner + width;
    if (bins->n_axes == 0 && box->dimension == 3)
        return 4.0 / 3.0 * M_PI * (outer * outer * outer - inner * inner * inner);
    const double area = M_PI * (outer * outer - inner * inner);
    if (box->dimension == 2) return area;
    return area * bins->axis[0].delta * (bins->units == HS_BINS_REDUCED ? hs_box_length(box, bins->axis[0].axis) : 1.0);
}

/** A coordinate on the side of the box that atoms belong to: they have been wrapped some steps ago. */
static inline double wrapped(const hs_box *box, int axis, double x)
{
    if (!box->periodic[axis]) return x;
    if (x < box->lo[axis]) x += hs_box_length(box, axis);
    return x >= box->hi[axis] ? x - hs_box_length(box, axis) : x;
}

/** The number below a distance in units of bins. Lattice sites on an edge belong to the upper bin, whatever the last
 *  bit of their coordinates. */
static inline double whole(double at) { return floor(at + 1e-10); }

/** Shell of local atom i, from 0, or -1. */
static int64_t find_shell(const hs_chunk_bins *bins, const hs_env *env, int i)
{
    const hs_bins_shells *shells = &bins->shells;
    const hs_box *box = env->box;
    double r2 = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        if (bins->n_axes > 0 && axis == bins->axis[0].axis) continue;
        const double length = hs_box_length(box, axis);
        double d = wrapped(box, axis, env->atoms->x[axis][i]) - shells->place[axis];
        if (shells->is_periodic && box->periodic[axis]) d -= length * rint(d / length);
        r2 += d * d;
    }
    const double at = whole((sqrt(r2) - shells->ends[0]) * ((double)shells->n / (shells->ends[1] - shells->ends[0])));
    if (at >= 0.0 && at < (double)shells->n) return (int64_t)at;
    if (bins->discard == HS_DISCARD_YES) return -1;
    return at < 0.0 ? 0 : shells->n - 1;
}

int64_t hs_chunk_bins_find(const hs_chunk_bins *bins, const hs_env *env, int i)
{
    const hs_box *box = env->box;
    int64_t place = bins->shells.n > 0 ? find_shell(bins, env, i) : 0;
    if (place < 0) return -1;
    for (int k = 0; k < bins->n_axes; ++k) {
        const hs_bins_axis *b = &bins->axis[k];
        const double length = hs_box_length(box, b->axis);
        const double site[3] = {env->atoms->x[0][i], env->atoms->x[1][i], env->atoms->x[2][i]};
        double x = wrapped(box, b->axis, hs_box_upright(box, site, b->axis));
        if (bins->units == HS_BINS_REDUCED) x = (x - box->lo[b->axis]) / length;
        const double at = whole((x - b->offset) * (1.0 / b->delta));
        const bool is_below = at < 0.0, is_above = at >= (double)b->n;
        if ((is_below || is_above) &&
            (bins->discard == HS_DISCARD_YES || (bins->discard == HS_DISCARD_MIXED && b->has_bound[is_above])))
            return -1;
        place = place * b->n + (is_below ? 0 : is_above ? b->n - 1 : (int64_t)at);
    }
    return place;
}

void hs_chunk_bins_place(const hs_chunk_bins *bins, int64_t c, double *place)
{
    const hs_bins_shells *shells = &bins->shells;
    double *of_axis = place + (shells->n > 0);
    for (int k = bins->n_axes; k-- > 0; c /= bins->axis[k].n) {
        const hs_bins_axis *b = &bins->axis[k];
        of_axis[k] = b->offset + ((double)(c % b->n) + 0.5) * b->delta;
    }
    if (shells->n > 0)
        place[0] = shells->ends[0] + ((double)c + 0.5) * (shells->ends[1] - shells->ends[0]) / (double)shells->n;
}
