/* The public cell lists, include/halfshell/cells.h: settings and the build. */
#include "neighbor/cell_list.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "neighbor/counting_sort.h"
#include "parallel/limits.h"

/* Cells of the grid for each particle beyond which only the occupied ones are kept. */
enum { CELLS_PER_PARTICLE_MAX = 8, CELLS_ALWAYS = 4096 };

static hs_code finish(hs_status status) { return status == HS_OK ? HS_CODE_OK : (hs_code)hs_exit_code(status); }

const char *hs_cell_list_error(const hs_cell_list *list)
{
    return list != NULL ? list->error.text : "there is no memory for a cell list";
}

static hs_status check_box(const hs_cell_list_box *box, hs_error *err)
{
    if (box == NULL) return hs_fail(err, HS_ERROR_INPUT, "the box is NULL");
    if (box->dimension != 2 && box->dimension != 3)
        return hs_fail(err, HS_ERROR_INPUT, "box.dimension is %d; it must be 2 or 3", box->dimension);
    for (int axis = 0; axis < box->dimension; ++axis) {
        const double length = box->hi[axis] - box->lo[axis];
        if (!(length > 0.0) || !isfinite(length))
            return hs_fail(err, HS_ERROR_INPUT, "the box has no extent in %c: lo is %g, hi is %g", "xyz"[axis],
                           box -> lo[axis], box -> hi[axis]);
    }
    return HS_OK;
}

static hs_status set_box(hs_cell_list *list, const hs_cell_list_box *box, hs_error *err)
{
    list->n = list->n_cells = 0;
    HS_TRY(check_box(box, err));
    list->box = *box;
    hs_grid_plan plan = {.dimension = box->dimension, .reach = list->reach, .edge = list->cell * list->reach};
    for (int axis = 0; axis < 3; ++axis) {
        plan.lo[axis] = box->lo[axis];
        plan.hi[axis] = box->hi[axis];
        plan.wraps[axis] = axis < box->dimension && box->periodic[axis];
        if (plan.wraps[axis] && list->reach > 100.0 * (box->hi[axis] - box->lo[axis]))
            return hs_fail(err, HS_ERROR_INPUT, "the reach %g is more than a hundred times the periodic box in %c",
                           list->reach, "xyz"[axis]);
    }
    return hs_grid_set(&list->grid, &plan, NULL, err);
}

static hs_status read_options(hs_cell_list *list, const hs_cell_list_options *given, hs_error *err)
{
    hs_cell_list_options options = HS_CELL_LIST_OPTIONS_INIT;
    if (given != NULL) {
        if (given->size == 0 || given->size > sizeof options)
            return hs_fail(err, HS_ERROR_INPUT,
                           "hs_cell_list_options: size is %zu, this library knows up to %zu; set it with "
                           "HS_CELL_LIST_OPTIONS_INIT",
                           given->size, sizeof options);
        memcpy(&options, given, given->size);
    }
    if (options.cell != 0.0 && !(options.cell >= 0.05 && options.cell <= 20.0))
        return hs_fail(err, HS_ERROR_INPUT,
                       "options.cell is %g; it must be a fraction of the reach from 0.05 to 20, or 0", options.cell);
    if (options.n_threads < 0 || options.n_threads > HS_THREADS_MAX)
        return hs_fail(err, HS_ERROR_INPUT, "options.n_threads is %d; it must be from 0 to %d", options.n_threads,
                       HS_THREADS_MAX);
    list->cell = options.cell != 0.0 ? options.cell : 1.0;
    list->n_threads = options.n_threads;
    return HS_OK;
}

static hs_status create(hs_cell_list *list, const hs_cell_list_box *box, double reach,
                        const hs_cell_list_options *options)
{
    if (!(reach > 0.0) || !isfinite(reach))
        return hs_fail(&list->error, HS_ERROR_INPUT, "the reach is %g; it must be a number above 0", reach);
    list->reach = reach;
    HS_TRY(read_options(list, options, &list->error));
    return set_box(list, box, &list->error);
}

hs_code hs_cell_list_create(hs_cell_list **list, const hs_cell_list_box *box, double reach,
                            const hs_cell_list_options *options)
{
    *list = calloc(1, sizeof **list);
    if (*list == NULL) return HS_CODE_FAILED;
    return finish(create(*list, box, reach, options));
}

hs_code hs_cell_list_set_box(hs_cell_list *list, const hs_cell_list_box *box)
{
    hs_error_clear(&list->error);
    return finish(set_box(list, box, &list->error));
}

void hs_cell_list_destroy(hs_cell_list **list)
{
    if (*list == NULL) return;
    for (int axis = 0; axis < 3; ++axis) {
        HS_FREE((*list)->x[axis]);
        HS_FREE((*list)->given[axis]);
    }
    HS_FREE((*list)->index);
    HS_FREE((*list)->start);
    HS_FREE((*list)->key);
    HS_FREE((*list)->place);
    hs_hash_table_fini(&(*list)->table);
    hs_grid_fini(&(*list)->grid);
    free(*list);
    *list = NULL;
}

/** Where the caller's coordinates are. */
typedef struct source {
    const char *x[3];
    size_t stride;
    bool is_float;
} source;

static inline double coordinate(const source *from, int axis, int64_t i)
{
    const char *at = from->x[axis] + (size_t)i * from->stride;
    if (!from->is_float) {
        double value;
        memcpy(&value, at, sizeof value); /* structures may be packed */
        return value;
    }
    float value;
    memcpy(&value, at, sizeof value);
    return value;
}

/** The image in the box of a coordinate along a periodic axis. */
static inline double wrapped(const hs_cell_list_box *box, int axis, double x)
{
    const double lo = box->lo[axis], hi = box->hi[axis], length = hi - lo;
    if (x >= lo && x < hi) return x;
    x -= length * floor((x - lo) / length);
    return x >= lo && x < hi ? x : lo; /* a hair below a face may round to the other */
}

static hs_status reserve(hs_cell_list *list, int64_t n, hs_error *err)
{
    if (n <= list->capacity && list->index != NULL) return HS_OK;
    const size_t capacity = (size_t)(n + n / 8 + 64);
    list->capacity = 0;
    for (int axis = 0; axis < 3; ++axis) {
        HS_TRY(HS_GROW(list->x[axis], 0, capacity, err));
        HS_TRY(HS_GROW(list->given[axis], 0, capacity, err));
    }
    HS_TRY(HS_GROW(list->index, 0, capacity, err));
    HS_TRY(HS_GROW(list->key, 0, capacity, err));
    HS_FREE(list->place);
    list->capacity = (int64_t)capacity;
    return HS_OK;
}

/** Copy the positions into the box; the number of the first one that is none, or n. */
static int64_t take_positions(hs_cell_list *list, const source *from, int64_t n, int n_threads)
{
    int64_t first_bad = n;
#pragma omp parallel for schedule(static) num_threads(n_threads) reduction(min : first_bad)
    for (int64_t i = 0; i < n; ++i)
        for (int axis = 0; axis < 3; ++axis) {
            double x = axis < list->box.dimension ? coordinate(from, axis, i) : 0.0;
            if (!isfinite(x) && i < first_bad) first_bad = i;
            if (axis < list->box.dimension && list->box.periodic[axis]) x = wrapped(&list->box, axis, x);
            list->given[axis][i] = x;
        }
    return first_bad;
}

static inline int64_t place_of(const hs_cell_list *list, int64_t i)
{
    int c[3];
    for (int axis = 0; axis < 3; ++axis) c[axis] = hs_grid_coordinate(&list->grid, axis, list->given[axis][i]);
    return hs_grid_place(&list->grid, c);
}

/** The cell of every particle: its place in the grid, or, where most cells are empty, the number of an occupied one. */
static hs_status number_cells(hs_cell_list *list, int64_t n, int n_threads, hs_error *err)
{
    const int64_t n_all = hs_grid_n_cells(&list->grid);
    list->is_hashed = n_all > CELLS_PER_PARTICLE_MAX * n + CELLS_ALWAYS || n_all > INT32_MAX;
    if (!list->is_hashed) {
        list->n_cells = n_all;
#pragma omp parallel for schedule(static) num_threads(n_threads)
        for (int64_t i = 0; i < n; ++i) list->key[i] = (int32_t)place_of(list, i);
        return HS_OK;
    }
    if (list->place == NULL) HS_TRY(HS_ALLOC(list->place, (size_t)list->capacity, err));
    HS_TRY(hs_hash_table_clear(&list->table, n, err));
#pragma omp parallel for schedule(static) num_threads(n_threads)
    for (int64_t i = 0; i < n; ++i) list->place[i] = place_of(list, i);
    for (int64_t i = 0; i < n; ++i) { /* one by one: cells are numbered in the order of their first particles */
        bool is_new;
        list->key[i] = hs_hash_table_insert(&list->table, list->place[i], &is_new);
    }
    list->n_cells = list->table.n_cells;
    return HS_OK;
}

/** Stable counting sort by cell. */
static hs_status sort(hs_cell_list *list, int64_t n, int n_threads, hs_error *err)
{
    const int64_t n_cells = list->n_cells;
    if (n_cells >= list->capacity_cells) {
        const int64_t capacity = n_cells + n_cells / 8 + 64;
        HS_TRY(HS_GROW(list->start, 0, (size_t)capacity, err));
        list->capacity_cells = capacity;
    }
    int32_t *histogram = NULL;
    int64_t *share_sum = NULL;
    hs_status status = HS_ALLOC(histogram, (size_t)(n_cells * n_threads), err);
    if (status == HS_OK) status = HS_ALLOC(share_sum, (size_t)n_threads, err);
    if (status == HS_OK) {
#pragma omp parallel num_threads(n_threads)
        {
            const int thread = hs_thread_number(), n_here = hs_thread_count();
            int32_t *mine = histogram + thread * n_cells;
            int64_t begin, end;
            hs_thread_range(n, 1, thread, n_here, &begin, &end);
            for (int64_t i = begin; i < end; ++i) ++mine[list->key[i]];
#pragma omp barrier
            hs_counting_sort_prefix(histogram, list->start, n_cells, thread, n_here, share_sum);
            for (int64_t i = begin; i < end; ++i) {
                const int32_t to = mine[list->key[i]]++;
                list->index[to] = (int32_t)i;
                for (int axis = 0; axis < 3; ++axis) list->x[axis][to] = list->given[axis][i];
            }
        }
    }
    HS_FREE(histogram);
    HS_FREE(share_sum);
    return status;
}

static hs_status build(hs_cell_list *list, int64_t n, const source *from, hs_error *err)
{
    hs_error_clear(err);
    list->n = list->n_cells = 0;
    if (list->grid.inv_pitch[0] == 0.0)
        return hs_fail(err, HS_ERROR_INPUT, "this list has no box: its creation, or the last set_box, failed");
    if (n < 0 || n > INT32_MAX - 64)
        return hs_fail(err, HS_ERROR_INPUT, "%lld particles: a list holds from 0 to 2^31", (long long)n);
    for (int axis = 0; axis < list->box.dimension && n > 0; ++axis)
        if (from->x[axis] == NULL) return hs_fail(err, HS_ERROR_INPUT, "the %c coordinates are NULL", "xyz"[axis]);
    const int n_threads = list->n_threads > 0 ? list->n_threads : hs_threads_get();
    HS_TRY(reserve(list, n, err));
    const int64_t first_bad = take_positions(list, from, n, n_threads);
    if (first_bad < n)
        return hs_fail(err, HS_ERROR_INPUT, "particle %lld has a coordinate that is not a finite number: (%g %g %g)",
                       (long long)first_bad, coordinate(from, 0, first_bad), coordinate(from, 1, first_bad),
                       list->box.dimension == 3 ? coordinate(from, 2, first_bad) : 0.0);
    HS_TRY(number_cells(list, n, n_threads, err));
    const hs_status status = sort(list, n, n_threads, err);
    if (status != HS_OK) list->n_cells = 0;
    if (status == HS_OK) list->n = n;
    return status;
}

hs_code hs_cell_list_build(hs_cell_list *list, int64_t n, const double *x, const double *y, const double *z,
                           size_t stride)
{
    const source from = {{(const char *)x, (const char *)y, (const char *)z}, stride, false};
    return finish(build(list, n, &from, &list->error));
}

hs_code hs_cell_list_build_float(hs_cell_list *list, int64_t n, const float *x, const float *y, const float *z,
                                 size_t stride)
{
    const source from = {{(const char *)x, (const char *)y, (const char *)z}, stride, true};
    return finish(build(list, n, &from, &list->error));
}

int64_t hs_cell_list_n(const hs_cell_list *list) { return list->n; }

size_t hs_cell_list_memory(const hs_cell_list *list)
{
    const size_t per_particle = 6 * sizeof(double) + 2 * sizeof(int32_t) + (list->place != NULL ? sizeof(int64_t) : 0);
    return sizeof *list + (size_t)list->capacity * per_particle + (size_t)list->capacity_cells * sizeof(int32_t) +
           (size_t)list->table.capacity_slots * sizeof(int32_t) + (size_t)list->table.capacity_cells * sizeof(int64_t) +
           (size_t)list->grid.capacity_stencil * sizeof *list->grid.stencil;
}
