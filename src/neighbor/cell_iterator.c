/* The public cell lists, include/halfshell/cells.h: walks over pairs, and around a point.
 *
 * A walk goes from block to block: a block is two runs of particles, a and b, and the shift by box lengths that brings b to
 * the image at hand. For pairs, a is a cell and b the same cell (then b comes after a) or one of the half stencil; around a
 * point, a is the point alone. Coordinates of cells go on beyond periodic faces, so that every image is met once. */
#include <math.h>

#include "neighbor/cell_list.h"

/** The cell at coordinates that may lie beyond periodic faces becomes b; false when there is none or it is empty. */
static bool take_cell(hs_cell_iterator *it, const int64_t at[3])
{
    const hs_cell_list *list = it->list;
    int c[3];
    for (int axis = 0; axis < 3; ++axis) {
        const int64_t n = list->grid.n[axis];
        int64_t image = 0;
        if (at[axis] < 0 || at[axis] >= n) {
            if (axis >= list->box.dimension || !list->box.periodic[axis]) return false;
            image = at[axis] >= 0 ? at[axis] / n : -((n - 1 - at[axis]) / n);
        }
        c[axis] = (int)(at[axis] - image * n);
        it->shift[axis] = (double)image * (list->box.hi[axis] - list->box.lo[axis]);
    }
    const int64_t cell = hs_cell_list_number(list, c);
    if (cell < 0) return false;
    it->b_begin = list->start[cell];
    it->b_end = list->start[cell + 1];
    return it->b_begin < it->b_end;
}

/** Coordinates of the cell of pairs. */
static void locate_cell(const hs_cell_list *list, int64_t cell, int64_t at[3])
{
    int c[3];
    hs_grid_cell_at(&list->grid, list->is_hashed ? list->table.place_of[cell] : cell, c);
    for (int axis = 0; axis < 3; ++axis) at[axis] = c[axis];
}

/** Begin with particle a of the block. step 0: b is the same cell. */
static void begin_a(hs_cell_iterator *it)
{
    for (int axis = 0; axis < 3 && !it->is_around; ++axis)
        it->origin[axis] = it->list->x[axis][it->a] - it->shift[axis];
    it->b = !it->is_around && it->step == 0 ? it->a + 1 : it->b_begin;
}

/** The next two cells of pairs: step 0 is a cell with itself, step k with cell k - 1 of the stencil. */
static bool next_cells(hs_cell_iterator *it)
{
    const hs_cell_list *list = it->list;
    for (;;) {
        if (it->step >= list->grid.n_stencil || it->a_begin == it->a_end) {
            if (++it->cell >= it->cell_end) return false;
            it->step = -1;
            it->a_begin = list->start[it->cell];
            it->a_end = list->start[it->cell + 1];
            if (it->a_begin == it->a_end) continue;
            locate_cell(list, it->cell, it->at);
        }
        ++it->step;
        int64_t there[3];
        for (int axis = 0; axis < 3; ++axis)
            there[axis] = it->at[axis] + (it->step > 0 ? list->grid.stencil[it->step - 1][axis] : 0);
        if (take_cell(it, there)) break;
    }
    it->a = it->a_begin;
    begin_a(it);
    return true;
}

/** The next cell of the block of cells around a point. */
static bool next_around(hs_cell_iterator *it)
{
    for (;;) {
        int axis = 2;
        while (axis >= 0 && ++it->at[axis] > it->hi[axis]) {
            it->at[axis] = it->lo[axis];
            --axis;
        }
        if (axis < 0) return false;
        if (take_cell(it, it->at)) break;
    }
    it->a = 0;
    begin_a(it);
    return true;
}

/** Fill in the pair at hand; whether it is within reach. */
static inline bool is_near(const hs_cell_iterator *it, hs_cell_pair *pair)
{
    const hs_cell_list *list = it->list;
    double r2 = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        pair->d[axis] = list->x[axis][it->b] - it->origin[axis];
        if (it->is_around) pair->d[axis] += it->shift[axis];
        r2 += pair->d[axis] * pair->d[axis];
    }
    if (!(r2 < it->reach2)) return false;
    pair->r2 = r2;
    pair->i = it->is_around ? -1 : list->index[it->a];
    pair->j = list->index[it->b];
    return true;
}

int hs_cell_iterator_next(hs_cell_iterator *it, hs_cell_pair *pair)
{
    for (;;) {
        while (it->b < it->b_end)
            if (is_near(it, pair)) {
                ++it->b;
                return 1;
            } else {
                ++it->b;
            }
        if (it->a + 1 < it->a_end) {
            ++it->a;
            begin_a(it);
        } else if (!(it->is_around ? next_around(it) : next_cells(it))) {
            it->b = it->b_end = it->a = it->a_end = 0; /* asked again, it ends again */
            for (int axis = 0; axis < 3; ++axis) it->hi[axis] = it->lo[axis] - 1;
            return 0;
        }
    }
}

hs_cell_iterator hs_cell_list_pairs_of_part(const hs_cell_list *list, int part, int n_parts)
{
    hs_cell_iterator it = {.list = list, .reach2 = list->reach * list->reach};
    if (n_parts < 1 || part < 0 || part >= n_parts || list->n == 0) return it; /* no cells: nothing to walk over */
    /* shares of equal numbers of particles, in whole cells: the first cell that begins at or after the particle */
    int64_t bound[2];
    for (int side = 0; side < 2; ++side) {
        const int64_t particle = list->n * (part + side) / n_parts;
        int64_t lo = 0, hi = list->n_cells;
        while (lo < hi) {
            const int64_t middle = lo + (hi - lo) / 2;
            if (list->start[middle] < particle)
                lo = middle + 1;
            else
                hi = middle;
        }
        bound[side] = part + side == n_parts ? list->n_cells : lo;
    }
    it.cell = bound[0] - 1;
    it.cell_end = bound[1];
    return it;
}

hs_cell_iterator hs_cell_list_pairs(const hs_cell_list *list) { return hs_cell_list_pairs_of_part(list, 0, 1); }

hs_cell_iterator hs_cell_list_around(const hs_cell_list *list, const double point[3], double radius)
{
    hs_cell_iterator it = {.list = list, .is_around = 1, .reach2 = radius * radius, .lo = {1, 1, 1}};
    if (list->n == 0 || !(radius > 0.0)) return it; /* hi is below lo: no cells */
    int64_t lo[3], hi[3];
    for (int axis = 0; axis < 3; ++axis) {
        const hs_grid *grid = &list->grid;
        lo[axis] = hi[axis] = 0;
        it.origin[axis] = 0.0;
        if (axis >= list->box.dimension) continue;
        /* a millionth of a cell more on both sides, so that no rounding hides a particle */
        const double first = (point[axis] - radius - grid->lo[axis]) * grid->inv_pitch[axis] - 1e-6,
                     last = (point[axis] + radius - grid->lo[axis]) * grid->inv_pitch[axis] + 1e-6;
        if (!(fabs(first) < 1e15 && fabs(last) < 1e15)) return it;
        it.origin[axis] = point[axis];
        lo[axis] = (int64_t)floor(first);
        hi[axis] = (int64_t)floor(last);
        if (list->box.periodic[axis]) continue;
        const int64_t top = grid->n[axis] - 1; /* particles beyond a face are in the cells at it */
        lo[axis] = lo[axis] < 0 ? 0 : lo[axis] > top ? top : lo[axis];
        hi[axis] = hi[axis] < 0 ? 0 : hi[axis] > top ? top : hi[axis];
    }
    for (int axis = 0; axis < 3; ++axis) {
        it.lo[axis] = it.at[axis] = lo[axis];
        it.hi[axis] = hi[axis];
    }
    --it.at[2]; /* the first step leads to the first cell */
    return it;
}

int hs_cell_list_each_pair(const hs_cell_list *list, hs_cell_visit visit, void *context)
{
    hs_cell_pair pair;
    int result = 0;
    for (hs_cell_iterator it = hs_cell_list_pairs(list); result == 0 && hs_cell_iterator_next(&it, &pair);)
        result = visit(context, &pair);
    return result;
}

int hs_cell_list_query(const hs_cell_list *list, const double point[3], double radius, hs_cell_visit visit,
                       void *context)
{
    hs_cell_pair pair;
    int result = 0;
    for (hs_cell_iterator it = hs_cell_list_around(list, point, radius);
         result == 0 && hs_cell_iterator_next(&it, &pair);)
        result = visit(context, &pair);
    return result;
}
