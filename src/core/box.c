#include "core/box.h"

#include <math.h>
#include <string.h>

void hs_box_init(hs_box *box)
{
    memset(box, 0, sizeof *box);
    box->dimension = 3;
    for (int axis = 0; axis < 3; ++axis) {
        box->periodic[axis] = true;
        box->boundary[axis][0] = box->boundary[axis][1] = HS_BOUNDARY_PERIODIC;
    }
}

void hs_box_shift(const hs_box *box, const int32_t n[3], double shift[3])
{
    const double *tilt = box->tilt;
    shift[0] = n[0] * hs_box_length(box, 0) + n[1] * tilt[0] + n[2] * tilt[1];
    shift[1] = n[1] * hs_box_length(box, 1) + n[2] * tilt[2];
    shift[2] = n[2] * hs_box_length(box, 2);
}

void hs_box_fractions(const hs_box *box, const double x[3], double fraction[3])
{
    const double *tilt = box->tilt;
    fraction[2] = (x[2] - box->lo[2]) / hs_box_length(box, 2);
    fraction[1] = (x[1] - box->lo[1] - tilt[2] * fraction[2]) / hs_box_length(box, 1);
    fraction[0] = (x[0] - box->lo[0] - tilt[0] * fraction[1] - tilt[1] * fraction[2]) / hs_box_length(box, 0);
}

void hs_box_place(const hs_box *box, const double fraction[3], double x[3])
{
    const double *tilt = box->tilt;
    x[0] = box->lo[0] + fraction[0] * hs_box_length(box, 0) + fraction[1] * tilt[0] + fraction[2] * tilt[1];
    x[1] = box->lo[1] + fraction[1] * hs_box_length(box, 1) + fraction[2] * tilt[2];
    x[2] = box->lo[2] + fraction[2] * hs_box_length(box, 2);
}

double hs_box_thickness(const hs_box *box, int axis)
{
    /* volume / area of the face that the other two edges span */
    const double lx = hs_box_length(box, 0), ly = hs_box_length(box, 1), lz = hs_box_length(box, 2);
    const double xy = box->tilt[0], xz = box->tilt[1], yz = box->tilt[2];
    if (axis == 2) return lz;
    if (axis == 1) return ly * lz / hypot(lz, yz);
    const double bxc[3] = {ly * lz, -xy * lz, xy * yz - ly * xz};
    return lx * ly * lz / sqrt(bxc[0] * bxc[0] + bxc[1] * bxc[1] + bxc[2] * bxc[2]);
}

double hs_box_reach(const hs_box *box, int axis, double reach)
{
    if (!box->is_tilted) return reach;
    /* a hair more, against the rounding of upright coordinates */
    return reach * (hs_box_length(box, axis) / hs_box_thickness(box, axis)) * (1.0 + 1e-10);
}

void hs_box_bounds(const hs_box *box, double lo[3], double hi[3])
{
    const double xy = box->tilt[0], xz = box->tilt[1], yz = box->tilt[2];
    memcpy(lo, box->lo, 3 * sizeof *lo);
    memcpy(hi, box->hi, 3 * sizeof *hi);
    lo[0] += fmin(fmin(0.0, xy), fmin(xz, xy + xz));
    hi[0] += fmax(fmax(0.0, xy), fmax(xz, xy + xz));
    lo[1] += fmin(0.0, yz);
    hi[1] += fmax(0.0, yz);
}

hs_status hs_box_check_tilt(const hs_box *box, const char *command, hs_error *err)
{
    static const char *const names[3] = {"xy", "xz", "yz"};
    static const int second[3] = {1, 2, 2};
    for (int k = 0; k < 3; ++k) {
        if (box->tilt[k] == 0.0) continue;
        if (!(fabs(box->tilt[k]) < INFINITY))
            return hs_fail(err, HS_ERROR_INPUT, "%s: the tilt %s, %g, is no length", command, names[k], box->tilt[k]);
        if (!box->is_tilted)
            return hs_fail(err, HS_ERROR_INPUT, "%s: the box is orthogonal and cannot have the tilt %s", command,
                           names[k]);
        if (box->dimension == 2 && k > 0)
            return hs_fail(err, HS_ERROR_INPUT, "%s: in two dimensions the tilts xz and yz must be 0, and %s is %g",
                           command, names[k], box->tilt[k]);
        if (!box->periodic[second[k]])
            return hs_fail(err, HS_ERROR_INPUT, "%s: with the tilt %s, %g, the boundary of %c must be periodic",
                           command, names[k], box->tilt[k], "xyz"[second[k]]);
    }
    return HS_OK;
}

double hs_box_volume(const hs_box *box)
{
    double area = hs_box_length(box, 0) * hs_box_length(box, 1);
    return box->dimension == 2 ? area : area * hs_box_length(box, 2);
}

void hs_box_settle_faces(hs_box *box)
{
    for (int axis = 0; axis < 3; ++axis) {
        const double margin = 1.0e-4 * (box->hi[axis] - box->lo[axis]);
        box->shrink_margin[axis] = margin;
        const double face[2] = {box->lo[axis], box->hi[axis]};
        if (box->boundary[axis][0] == HS_BOUNDARY_SHRINK) box->lo[axis] -= margin;
        if (box->boundary[axis][1] == HS_BOUNDARY_SHRINK) box->hi[axis] += margin;
        for (int end = 0; end < 2; ++end)
            if (box->boundary[axis][end] == HS_BOUNDARY_SHRINK_MIN) box->shrink_limit[axis][end] = face[end];
    }
}

bool hs_box_wrap_tilted(const hs_box *box, double farthest, double x[3], int32_t image[3])
{
    const double before[3] = {x[0], x[1], x[2]};
    int32_t n[3] = {0, 0, 0};
    for (int axis = 2; axis >= 0; --axis) { /* crossing c moves x and y, too, and b moves x */
        if (!box->periodic[axis]) continue;
        const double place = hs_box_upright(box, x, axis), length = hs_box_length(box, axis);
        if (place >= box->lo[axis] && place < box->hi[axis]) continue;
        const double away = floor((place - box->lo[axis]) / length);
        int32_t edges[3] = {0, 0, 0};
        double shift[3];
        if (!(fabs(away) <= farthest)) {
            memcpy(x, before, sizeof before);
            return false;
        }
        n[axis] = edges[axis] = (int32_t)away;
        hs_box_shift(box, edges, shift);
        for (int a = 0; a <= axis; ++a) x[a] -= shift[a];
    }
    for (int axis = 0; axis < 3; ++axis) image[axis] += n[axis];
    return true;
}

static void wrap_upright(const hs_box *box, double x[3], int32_t image[3], int axis)
{
    const double lo = box->lo[axis], hi = box->hi[axis], length = hi - lo;
    if (x[axis] < lo - length || x[axis] >= hi + length) {
        const double away = floor((x[axis] - lo) / length);
        if (!(fabs(away) < HS_BOX_FARTHEST)) return;
        x[axis] -= away * length;
        image[axis] += (int32_t)away;
    }
    if (x[axis] < lo) {
        x[axis] += length;
        --image[axis];
    }
    /* also an atom that rounding has just put from a hair below lo onto hi: there it would belong to the next image */
    if (x[axis] >= hi) {
        x[axis] -= length;
        ++image[axis];
        if (x[axis] < lo) x[axis] = lo;
    }
}

void hs_box_wrap(const hs_box *box, double x[3], int32_t image[3])
{
    if (box->is_tilted) {
        (void)hs_box_wrap_tilted(box, HS_BOX_FARTHEST, x, image);
        return;
    }
    for (int axis = 0; axis < 3; ++axis)
        if (box->periodic[axis]) wrap_upright(box, x, image, axis);
}
