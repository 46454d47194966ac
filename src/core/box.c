#include "core/box.h"

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
