#include "neighbor/cells.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "neighbor/counting_sort.h"
#include "parallel/parallel.h"

/** Interleave the bits of two 32-bit numbers: bit k of a goes to 2k+1, of b to 2k. */
static uint64_t morton_encode_2d(uint32_t a, uint32_t b)
{
    uint64_t code = 0;
    for (int bit = 0; bit < 32; ++bit)
        code |= ((uint64_t)(a >> bit & 1u) << (2 * bit + 1)) | ((uint64_t)(b >> bit & 1u) << (2 * bit));
    return code;
}

uint64_t hs_morton_encode_3d(uint32_t a, uint32_t b, uint32_t c)
{
    uint64_t code = 0;
    for (int bit = 0; bit < 21; ++bit)
        code |= ((uint64_t)(a >> bit & 1u) << (3 * bit + 2)) | ((uint64_t)(b >> bit & 1u) << (3 * bit + 1)) |
                ((uint64_t)(c >> bit & 1u) << (3 * bit));
    return code;
}

typedef struct ranked_column {
    uint64_t code;
    int32_t column;
} ranked_column;

static int compare_codes(const void *a, const void *b)
{
    const uint64_t code_a = ((const ranked_column *)a)->code, code_b = ((const ranked_column *)b)->code;
    return (code_a > code_b) - (code_a < code_b);
}

/** Number the columns along the Morton curve (gaps of a grid that is no power of two vanish), or row by row. */
static hs_status rank_columns(hs_cells *cells, hs_error *err)
{
    ranked_column *ranked;
    if (cells->curve != HS_CELL_ORDER_MORTON) {
        for (int column = 0; column < cells->n_columns; ++column) cells->column_rank[column] = column;
        cells->ranked_curve = cells->curve;
        return HS_OK;
    }
    HS_TRY(HS_ALLOC(ranked, (size_t)cells->n_columns, err));
    for (int c0 = 0; c0 < cells->n[0]; ++c0)
        for (int c1 = 0; c1 < cells->n[1]; ++c1) {
            const int column = c0 * cells->n[1] + c1;
            ranked[column] = (ranked_column){morton_encode_2d((uint32_t)c0, (uint32_t)c1), column};
        }
    qsort(ranked, (size_t)cells->n_columns, sizeof *ranked, compare_codes);
    for (int rank = 0; rank < cells->n_columns; ++rank) cells->column_rank[ranked[rank].column] = rank;
    HS_FREE(ranked);
    cells->ranked_curve = cells->curve;
    return HS_OK;
}

static int64_t count_cells(const double extent[3], const double pitch[3], int n[3])
{
    double total = 1.0;
    for (int a = 0; a < 3; ++a) {
        const double count = ceil(extent[a] / pitch[a]);
        if (!(count < 1e9)) return INT64_MAX;
        n[a] = count < 1.0 ? 1 : (int)count;
        total *= n[a];
    }
    return total < 1e15 ? (int64_t)total : INT64_MAX;
}

hs_status hs_cells_set_grid(hs_cells *cells, const double brick_lo[3], const double brick_hi[3], int dimension,
                            double reach, double width, int64_t n_atoms, hs_error *err)
{
    static const int axes[2][3] = {{0, 2, 1}, {0, 1, 2}};
    const bool is_3d = dimension == 3;
    double extent[3], pitch[3], lo[3];
    int n[3];
    for (int a = 0; a < 3; ++a) {
        const int axis = axes[is_3d][a];
        const bool is_flat = !is_3d && axis == 2;
        const double margin = is_flat ? 0.0 : reach;
        lo[a] = brick_lo[axis] - margin;
        extent[a] = brick_hi[axis] - brick_lo[axis] + 2.0 * margin;
        pitch[a] = is_flat ? extent[a] : a == 2 ? width / 3.0 : width;
    }
    for (int a = 0; a < 3; ++a)
        if (!(pitch[a] > 0.0 && pitch[a] <= DBL_MAX && extent[a] / pitch[a] <= DBL_MAX))
            return hs_fail(
                err, HS_ERROR_RUN,
                "the box, %g long in %c here, cannot be cut into cells: lengths must be of a size that their "
                "cube is a number",
                extent[a], "xyz"[axes[is_3d][a]]);
    const int64_t most = 4 * n_atoms + 4096;
    while (count_cells(extent, pitch, n) > most)
        for (int a = 0; a < 3; ++a) pitch[a] *= 1.25;

    const bool has_same_columns =
        cells->column_rank != NULL && cells->n[0] == n[0] && cells->n[1] == n[1] && cells->ranked_curve == cells->curve;
    const int64_t n_columns = (int64_t)n[0] * n[1], n_cells = n_columns * n[2];
    for (int a = 0; a < 3; ++a) {
        cells->axis[a] = axes[is_3d][a];
        cells->lo[a] = lo[a];
        cells->brick_hi[a] = brick_hi[cells->axis[a]] - lo[a];
        cells->pitch[a] = pitch[a];
        cells->inv_pitch[a] = 1.0 / pitch[a];
        cells->n[a] = n[a];
    }
    cells->n_columns = (int)n_columns;
    if (!has_same_columns) cells->ranked_curve = HS_CELL_ORDER_NONE; /* until they are ranked */
    if (n_cells > cells->capacity_cells) {
        const int64_t capacity = n_cells + n_cells / 8;
        HS_TRY(HS_GROW(cells->start_local, 0, (size_t)capacity + 1, err));
        HS_TRY(HS_GROW(cells->start_halo, 0, (size_t)capacity + 1, err));
        cells->capacity_cells = capacity;
    }
    if (has_same_columns) return HS_OK;
    if (n_columns > cells->capacity_columns) {
        const int64_t capacity = n_columns + n_columns / 8;
        HS_TRY(HS_GROW(cells->column_rank, 0, (size_t)capacity, err));
        cells->capacity_columns = capacity;
    }
    return rank_columns(cells, err);
}

void hs_cells_expect_halo_anywhere(hs_cells *cells)
{
    for (int a = 0; a < 3; ++a) cells->brick_hi[a] = -INFINITY;
}

/** Where the sorted atoms come from: local or halo part of the arrays. */
typedef struct sort_input {
    const double *x[3]; /**< coordinates along the grid axes, of atom 0 of this part */
    const int64_t *id;  /**< breaks ties; NULL for halo atoms, which keep their order */
    int n;
    int32_t *start;
} sort_input;

static void count_keys(const hs_cells *cells, const sort_input *in, int64_t begin, int64_t end, int32_t *histogram)
{
    const int n1 = cells->n[1], n2 = cells->n[2];
    for (int64_t i = begin; i < end; ++i) {
        const int c0 = hs_cells_coordinate(cells, 0, in->x[0][i]), c1 = hs_cells_coordinate(cells, 1, in->x[1][i]),
                  c2 = hs_cells_coordinate(cells, 2, in->x[2][i]);
        const int32_t key = cells->column_rank[c0 * n1 + c1] * n2 + c2;
        cells->sort.key[i] = key;
        ++histogram[key];
    }
}

static inline bool stands_before(const sort_input *in, int32_t a, int32_t b)
{
    const double xa = in->x[2][a], xb = in->x[2][b];
    if (xa != xb) return xa < xb;
    return in->id != NULL && in->id[a] < in->id[b];
}

static void sift_down(const sort_input *in, int32_t *heap, int root, int n)
{
    for (int child = 2 * root + 1; child < n; root = child, child = 2 * root + 1) {
        if (child + 1 < n && stands_before(in, heap[child], heap[child + 1])) ++child;
        if (!stands_before(in, heap[root], heap[child])) return;
        const int32_t atom = heap[root];
        heap[root] = heap[child];
        heap[child] = atom;
    }
}

/** Order the atoms of one cell along the run axis. Cells hold a few atoms, nearly in order from the step before, for
 *  which insertion is best; a cell with very many (a dense spot in an empty box) is sorted by a heap. */
static void order_cell(const sort_input *in, int32_t *order, int n)
{
    enum { FEW = 48 };
    if (n > FEW) {
        for (int root = n / 2 - 1; root >= 0; --root) sift_down(in, order, root, n);
        for (int last = n - 1; last > 0; --last) {
            const int32_t atom = order[0];
            order[0] = order[last];
            order[last] = atom;
            sift_down(in, order, 0, last);
        }
        return;
    }
    for (int k = 1; k < n; ++k) {
        const int32_t atom = order[k];
        int place = k;
        while (place > 0 && stands_before(in, atom, order[place - 1])) order[place] = order[place - 1], --place;
        order[place] = atom;
    }
}

/** A thread's part of the sort. */
static void sort_share(hs_cells *cells, const sort_input *in, int64_t n_cells, int64_t *share_sum)
{
    int64_t begin, end;
    const int thread = hs_thread_number(), n_threads = hs_thread_count();
    int32_t *histogram = cells->histogram + (int64_t)thread * n_cells;
    memset(histogram, 0, (size_t)n_cells * sizeof *histogram);
    hs_thread_range(in->n, 1, thread, n_threads, &begin, &end);
    count_keys(cells, in, begin, end, histogram);
#pragma omp barrier
    hs_counting_sort_prefix(cells->histogram, in->start, n_cells, thread, n_threads, share_sum);
    for (int64_t i = begin; i < end; ++i) cells->sort.order[histogram[cells->sort.key[i]]++] = (int32_t)i;
#pragma omp barrier
    hs_thread_range(n_cells, 16, thread, n_threads, &begin, &end);
    for (int64_t c = begin; c < end; ++c)
        order_cell(in, cells->sort.order + in->start[c], in->start[c + 1] - in->start[c]);
}

static hs_status sort(hs_cells *cells, const hs_atoms *atoms, const sort_input *in, hs_error *err)
{
    const int n_threads = hs_threads_get();
    const int64_t n_cells = (int64_t)cells->n_columns * cells->n[2], n_histogram = n_cells * n_threads;
    if (n_histogram > cells->capacity_histogram) {
        const int64_t capacity = n_histogram + n_histogram / 8;
        HS_TRY(HS_GROW(cells->histogram, 0, (size_t)capacity, err));
        cells->capacity_histogram = capacity;
    }
    cells->sort = hs_atoms_sort_scratch(atoms, in->n);
    int64_t share_sum[n_threads];
    HS_ON_THREADS(sort_share(cells, in, n_cells, share_sum));
    return HS_OK;
}

hs_status hs_cells_sort_local(hs_cells *cells, const hs_atoms *atoms, hs_error *err)
{
    const sort_input in = {.x = {atoms->x[cells->axis[0]], atoms->x[cells->axis[1]], atoms->x[cells->axis[2]]},
                           .id = atoms->id,
                           .n = atoms->n_local,
                           .start = cells->start_local};
    return sort(cells, atoms, &in, err);
}

/** How deep atoms of a thread's share are below the upper faces. */
static void find_deepest(const sort_input *in, const double hi[3], double *deepest)
{
    double most = 0.0;
#pragma omp for schedule(static) nowait
    for (int i = 0; i < in->n; ++i) {
        const double depth[3] = {hi[0] - in->x[0][i], hi[1] - in->x[1][i], hi[2] - in->x[2][i]};
        double least = depth[0] < depth[1] ? depth[0] : depth[1];
        least = least < depth[2] ? least : depth[2];
        most = least > most ? least : most;
    }
#pragma omp critical(hs_cells_deepest)
    *deepest = fmax(*deepest, most);
}

/** Halo atoms lie beyond an upper face of the brick when the halo is new, but may come into the brick while it is kept:
 *  lower the faces as far as they have come. */
static void lower_faces(hs_cells *cells, const sort_input *in)
{
    double deepest = 0.0, hi[3];
    for (int a = 0; a < 3; ++a) hi[a] = cells->lo[a] + cells->brick_hi[a];
    HS_ON_THREADS(find_deepest(in, hi, &deepest));
    for (int a = 0; a < 3; ++a) cells->brick_hi[a] -= deepest;
}

hs_status hs_cells_sort_halo(hs_cells *cells, const hs_atoms *atoms, hs_error *err)
{
    const int at = atoms->n_local;
    const sort_input in = {
        .x = {atoms->x[cells->axis[0]] + at, atoms->x[cells->axis[1]] + at, atoms->x[cells->axis[2]] + at},
        .id = NULL,
        .n = atoms->n_halo,
        .start = cells->start_halo};
    lower_faces(cells, &in);
    return sort(cells, atoms, &in, err);
}

void hs_cells_fini(hs_cells *cells)
{
    HS_FREE(cells->column_rank);
    HS_FREE(cells->start_local);
    HS_FREE(cells->start_halo);
    HS_FREE(cells->histogram);
    memset(cells, 0, sizeof *cells);
}
