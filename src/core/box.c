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

void hs_box_wrap(const hs_box *box, double x[3], int32_t image[3])
{
    for (int axis = 0; axis < 3; ++axis) {
        if (!box->periodic[axis]) continue;
        const double lo = box->lo[axis], hi = box->hi[axis], length = hi - lo;
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
}
