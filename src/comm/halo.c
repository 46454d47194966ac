#include "comm/halo.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "parallel/parallel.h"

/* Parts into which the atoms are cut to find those with images: many more than threads. */
enum { N_PARTS = 64 };

/** Which shifts an atom needs, per axis: it has images at shifts lo..hi box lengths that fall within reach. */
typedef struct shift_range {
    int lo[3], hi[3];
} shift_range;

/** How images are numbered: direction (a, b, c) has the number ((a + m0) * (2 m1 + 1) + b + m1) * (2 m2 + 1) + c + m2,
 *  so that the "upper half" are the numbers above the middle one, in lexicographic order. */
typedef struct image_space {
    int max_shift[3];
    double lo[3], hi[3], length[3];
    double inner_lo[3]; /**< atoms from here on need no image at a positive shift along this axis */
    double reach;
    int middle, n_directions;
} image_space;

static hs_status image_space_init(image_space *space, const hs_box *box, double reach, hs_error *err)
{
    int64_t n = 1;
    space->reach = reach;
    for (int axis = 0; axis < 3; ++axis) {
        const bool has_images = box->periodic[axis] && axis < box->dimension;
        space->lo[axis] = box->lo[axis];
        space->hi[axis] = box->hi[axis];
        space->length[axis] = hs_box_length(box, axis);
        const double layers = has_images ? ceil(reach / space->length[axis]) : 0.0;
        if (layers > 100.0)
            return hs_fail(err, HS_ERROR_RUN,
                           "the box is %g long in %c, less than a hundredth of the reach %g of the "
                           "forces: make the box larger or the cutoff shorter",
                           space->length[axis], "xyz"[axis], reach);
        space->max_shift[axis] = (int)layers;
        space->inner_lo[axis] = has_images ? space->lo[axis] + reach : -INFINITY;
        n *= 2 * space->max_shift[axis] + 1;
    }
    space->middle = (int)(n / 2);
    space->n_directions = (int)(n - 1 - n / 2);
    return HS_OK;
}

/** Whether an atom has an image in the upper half of directions: only if it is near a lower face. */
static inline bool needs_images(const image_space *space, const double x[3])
{
    return x[0] < space->inner_lo[0] || x[1] < space->inner_lo[1] || x[2] < space->inner_lo[2];
}

static shift_range shifts_of(const image_space *space, const double x[3])
{
    shift_range range;
    for (int axis = 0; axis < 3; ++axis) {
        range.lo[axis] = range.hi[axis] = 0;
        const double length = space->length[axis];
        while (range.hi[axis] < space->max_shift[axis] &&
               x[axis] + (range.hi[axis] + 1) * length < space->hi[axis] + space->reach)
            ++range.hi[axis];
        while (-range.lo[axis] < space->max_shift[axis] &&
               x[axis] + (range.lo[axis] - 1) * length >= space->lo[axis] - space->reach)
            --range.lo[axis];
    }
    return range;
}

/** Count (source == NULL) or write the images of local atoms [begin, end): next[d] is the place of the next image of
 *  direction d, or the count so far. */
static void list_images(const image_space *space, const hs_atoms *atoms, int64_t begin, int64_t end, int *next,
                        int32_t *source)
{
    const int *m = space->max_shift;
    for (int64_t i = begin; i < end; ++i) {
        const double x[3] = {atoms->x[0][i], atoms->x[1][i], atoms->x[2][i]};
        if (!needs_images(space, x)) continue;
        const shift_range range = shifts_of(space, x);
        for (int a = 0; a <= range.hi[0]; ++a)
            for (int b = range.lo[1]; b <= range.hi[1]; ++b)
                for (int c = range.lo[2]; c <= range.hi[2]; ++c) {
                    const int number = ((a + m[0]) * (2 * m[1] + 1) + b + m[1]) * (2 * m[2] + 1) + c + m[2];
                    if (number <= space->middle) continue;
                    const int d = number - space->middle - 1;
                    if (source != NULL) source[next[d]] = (int32_t)i;
                    ++next[d];
                }
    }
}

/** list_images for all parts of the local atoms. Atoms near lower faces, which have the images, stand together in the
 *  arrays; parts handed out in turn give every thread its share of them. */
static void list_parts(const image_space *space, const hs_atoms *atoms, int *next, int32_t *source)
{
#pragma omp parallel for schedule(static, 1)
    for (int part = 0; part < N_PARTS; ++part) {
        int64_t begin, end;
        hs_thread_range(atoms->n_local, 1, part, N_PARTS, &begin, &end);
        list_images(space, atoms, begin, end, next + (size_t)part * (size_t)space->n_directions, source);
    }
}

static void set_directions(hs_halo *halo, const image_space *space)
{
    const int *m = space->max_shift;
    for (int d = 0; d < halo->n_directions; ++d) {
        const int number = d + space->middle + 1;
        const int c = number % (2 * m[2] + 1) - m[2];
        const int b = number / (2 * m[2] + 1) % (2 * m[1] + 1) - m[1];
        const int a = number / (2 * m[2] + 1) / (2 * m[1] + 1) - m[0];
        halo->direction[d].shift[0] = a * space->length[0];
        halo->direction[d].shift[1] = b * space->length[1];
        halo->direction[d].shift[2] = c * space->length[2];
    }
}

static hs_status reserve(hs_halo *halo, int64_t n, hs_error *err)
{
    if (n <= halo->capacity) return HS_OK;
    const int64_t limit = INT32_C(1) << 30;
    if (n > limit)
        return hs_fail(err, HS_ERROR_RUN, "%lld periodic images are more than a rank can hold", (long long)n);
    const size_t capacity = (size_t)(n + n / 8 + 64);
    HS_TRY(HS_GROW(halo->source, 0, capacity, err));
    HS_TRY(HS_GROW(halo->slot, 0, capacity, err));
    halo->capacity = (int)capacity;
    return HS_OK;
}

/** Turn the counts of all parts into places: next[part * n_directions + d]. Directions in order, parts within. */
static int64_t places_from_counts(hs_halo *halo, int *next)
{
    int64_t n = 0;
    for (int d = 0; d < halo->n_directions; ++d) {
        halo->direction[d].begin = (int)n;
        for (int part = 0; part < N_PARTS; ++part) {
            const int count = next[(size_t)part * (size_t)halo->n_directions + (size_t)d];
            next[(size_t)part * (size_t)halo->n_directions + (size_t)d] = (int)n;
            n += count;
        }
        halo->direction[d].end = (int)n;
    }
    return n;
}

hs_status hs_halo_build(hs_halo *halo, const hs_box *box, hs_atoms *atoms, double reach, hs_error *err)
{
    image_space space;
    HS_TRY(image_space_init(&space, box, reach, err));
    halo->n_directions = space.n_directions;
    if (space.n_directions > halo->capacity_directions) {
        HS_TRY(HS_GROW(halo->direction, 0, (size_t)space.n_directions, err));
        halo->capacity_directions = space.n_directions;
    }
    set_directions(halo, &space);

    int *next;
    HS_TRY(HS_ALLOC(next, (size_t)N_PARTS * (size_t)space.n_directions, err));
    list_parts(&space, atoms, next, NULL);
    const int64_t n = places_from_counts(halo, next);
    hs_status status = reserve(halo, n, err);
    if (status == HS_OK && n > atoms->capacity_halo)
        status = hs_atoms_reserve(atoms, atoms->n_local, n + n / 8 + 64, err);
    if (status == HS_OK) {
        list_parts(&space, atoms, next, halo->source);
        halo->n = (int)n;
        atoms->n_halo = (int)n;
        halo->generation = atoms->generation;
#pragma omp parallel for schedule(static)
        for (int k = 0; k < halo->n; ++k) halo->slot[k] = k;
        hs_halo_forward(halo, atoms);
        hs_halo_forward_int(halo, atoms, atoms->type);
    }
    HS_FREE(next);
    return status;
}

void hs_halo_reorder(hs_halo *halo, hs_atoms *atoms, const int32_t *order)
{
#pragma omp parallel for schedule(static)
    for (int q = 0; q < halo->n; ++q) halo->slot[order[q]] = q;
    hs_halo_forward(halo, atoms);
    hs_halo_forward_int(halo, atoms, atoms->type);
}

void hs_halo_forward_positions(const hs_halo *halo, const hs_atoms *atoms, double *const position[3])
{
    const int n_local = atoms->n_local;
#pragma omp parallel
    for (int d = 0; d < halo->n_directions; ++d) {
        const hs_halo_direction *direction = &halo->direction[d];
#pragma omp for schedule(static) nowait
        for (int k = direction->begin; k < direction->end; ++k)
            for (int axis = 0; axis < 3; ++axis)
                position[axis][n_local + halo->slot[k]] = position[axis][halo->source[k]] + direction->shift[axis];
    }
}

void hs_halo_forward(const hs_halo *halo, hs_atoms *atoms) { hs_halo_forward_positions(halo, atoms, atoms->x); }

void hs_halo_forward_int(const hs_halo *halo, const hs_atoms *atoms, int32_t *values)
{
    const int n_local = atoms->n_local;
#pragma omp parallel for schedule(static)
    for (int k = 0; k < halo->n; ++k) values[n_local + halo->slot[k]] = values[halo->source[k]];
}

void hs_halo_reverse(const hs_halo *halo, hs_atoms *atoms)
{
    const int n_local = atoms->n_local;
    /* Within one direction a source occurs once at most, so threads never meet; directions follow one another. */
#pragma omp parallel
    for (int d = 0; d < halo->n_directions; ++d) {
        const hs_halo_direction *direction = &halo->direction[d];
#pragma omp for schedule(static)
        for (int k = direction->begin; k < direction->end; ++k)
            for (int axis = 0; axis < 3; ++axis)
                atoms->f[axis][halo->source[k]] += atoms->f[axis][n_local + halo->slot[k]];
    }
}

void hs_halo_fini(hs_halo *halo)
{
    HS_FREE(halo->direction);
    HS_FREE(halo->source);
    HS_FREE(halo->slot);
    memset(halo, 0, sizeof *halo);
}
