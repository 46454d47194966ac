#include "neighbor/occupied.h"

#include <math.h>

#include "base/memory.h"
#include "base/wide.h"
#include "parallel/parallel.h"

/** Lower *least and raise *most to the numbers of a thread's share of x[n]. */
static void find_extremes(const double *x, int n, double *least, double *most)
{
    double lo = INFINITY, hi = -INFINITY;
#pragma omp for schedule(static) nowait
    for (int i = 0; i < n; ++i) {
        lo = x[i] < lo ? x[i] : lo;
        hi = x[i] > hi ? x[i] : hi;
    }
#pragma omp critical(hs_occupied)
    {
        *least = fmin(*least, lo);
        *most = fmax(*most, hi);
    }
}

/** Bounds of the local atoms along an axis, within the brick, and all of the brick where they come within `edge` of its face:
 *  a liquid that fills its brick has the same grid at every list build. */
static void bound(hs_occupied *o, const hs_atoms *atoms, int axis, double lo, double hi, double edge)
{
    double least = hi, most = lo;
    HS_ON_THREADS(find_extremes(atoms->x[axis], atoms->n_local, &least, &most));
    o->lo[axis] = least - edge <= lo || !(least <= most) ? lo : least;
    o->hi[axis] = most + edge >= hi || !(least <= most) ? hi : most;
}

/** Boxes along each axis: as long as `edge` or a little shorter, longer where there would be many more of them than atoms. */
static size_t count_boxes(const hs_occupied *o, int dimension, double edge, int n_atoms, int n[3])
{
    const double most = 4.0 * n_atoms + 4096.0;
    for (;; edge *= 1.25) {
        double total = 1.0;
        for (int axis = 0; axis < 3; ++axis) {
            const double wanted = axis < dimension ? fmax(ceil((o->hi[axis] - o->lo[axis]) / edge), 1.0) : 1.0;
            n[axis] = wanted < 1e9 ? (int)wanted : 1;
            total *= wanted;
        }
        if (total <= most) return (size_t)total;
    }
}

enum { BLOCK = 256 }; /* atoms whose boxes are found at a time */

/** Numbers box[k] (whole, as doubles: vector code for every instruction set) of the boxes of @p count atoms from `begin` on. */
HS_WIDE static void find_boxes(const hs_occupied *o, const double scale[3], const int n[3], int dimension,
                               const hs_atoms *atoms, int begin, int count, double box[BLOCK])
{
    for (int k = 0; k < count; ++k) box[k] = 0.0;
    for (int axis = 0; axis < dimension; ++axis) {
        const double *x = atoms->x[axis] + begin, lo = o->lo[axis], factor = scale[axis], width = n[axis],
                     last = width - 1.0;
        for (int k = 0; k < count; ++k) {
            double place = (x[k] - lo) * factor;
            place = place > 0.0 ? place : 0.0;
            place = place < last ? place : last;
            box[k] = box[k] * width + (double)(int)place;
        }
    }
}

/** Mark the boxes of a thread's share of the atoms. */
static void mark_boxes(const hs_occupied *o, const double scale[3], const int n[3], int dimension,
                       const hs_atoms *atoms, unsigned char *is_occupied)
{
    double box[BLOCK];
#pragma omp for schedule(static) nowait
    for (int begin = 0; begin < atoms->n_local; begin += BLOCK) {
        const int left = atoms->n_local - begin, count = left < BLOCK ? left : BLOCK;
        find_boxes(o, scale, n, dimension, atoms, begin, count, box);
        for (int k = 0; k < count; ++k) {
            unsigned char *flag = &is_occupied[(int64_t)box[k]], is_set;
#pragma omp atomic read
            is_set = *flag;
            if (is_set) continue; /* a store would take the line from the caches of other threads */
#pragma omp atomic write
            *flag = 1;
        }
    }
}

hs_status hs_occupied_find(hs_occupied *o, const double lo[3], const double hi[3], int dimension, double edge,
                           const hs_atoms *atoms, hs_error *err)
{
    int n[3];
    double scale[3] = {0.0, 0.0, 0.0}, box_volume = 1.0;
    unsigned char *is_occupied;
    for (int axis = 0; axis < dimension; ++axis) bound(o, atoms, axis, lo[axis], hi[axis], edge);
    for (int axis = dimension; axis < 3;
         ++axis) { /* flat: one box, however high the brick is above and below the plane */
        o->lo[axis] = lo[axis];
        o->hi[axis] = hi[axis];
    }
    const size_t n_boxes = count_boxes(o, dimension, edge, atoms->n_local, n);
    for (int axis = 0; axis < 3; ++axis) {
        if (axis >= dimension) continue;
        const double extent = o->hi[axis] - o->lo[axis], side = n[axis] > 1 ? extent / n[axis] : fmax(extent, edge);
        scale[axis] = 1.0 / side;
        box_volume *= side;
    }
    HS_TRY(HS_ALLOC(is_occupied, n_boxes, err));
    HS_ON_THREADS(mark_boxes(o, scale, n, dimension, atoms, is_occupied));
    int64_t count = 0;
    for (size_t k = 0; k < n_boxes; ++k) count += is_occupied[k];
    HS_FREE(is_occupied);
    o->volume = box_volume * (double)(count > 0 ? count : 1);
    return HS_OK;
}
