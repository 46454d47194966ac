#include "neighbor/grid.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "neighbor/cells.h"

const char *const hs_cell_order_names[] = {"morton", "row", "none", NULL};

/* Cells along one axis at most: so that three coordinates fit the 63 bits of a Morton code. */
static const double cells_max = 1 << 20;
/* A place is rounded to some 2^-32 of a cell at worst. Cells are made wider by `slack`, and count as nearer by `doubt` of
 * their edge, so that no rounding hides a pair and cells as wide as the reach still need their next neighbors only. */
static const double slack = 4e-9, doubt = 1e-9;

static void set_axis(hs_grid *grid, int a, const hs_grid_plan *plan)
{
    const double extent = plan->hi[a] - plan->lo[a];
    grid->lo[a] = plan->lo[a];
    grid->n[a] = 1;
    grid->pitch[a] = INFINITY;
    grid->inv_pitch[a] = 0.0;
    if (a >= plan->dimension || !(extent > 0.0)) return;
    const double n = fmin(fmax(floor(extent / (plan->edge * (1.0 + slack))), 1.0), cells_max);
    grid->n[a] = (int)n;
    grid->pitch[a] = extent / n;
    grid->inv_pitch[a] = n / extent;
}

/** Farthest cell along an axis that is within reach. */
static int farthest(const hs_grid *grid, const hs_grid_plan *plan, int a)
{
    if (grid->inv_pitch[a] == 0.0) return 0;
    const int m = (int)ceil(plan->reach * grid->inv_pitch[a] + doubt);
    return plan->wraps[a] || m < grid->n[a] ? m : grid->n[a] - 1;
}

/** Whether a sphere of radius `reach` around a point of cell 0 can enter the cell at offset d. */
static bool can_reach(const hs_grid *grid, double reach, const int d[3])
{
    double r2 = 0.0;
    for (int a = 0; a < 3; ++a) {
        if (d[a] == 0) continue;
        const double gap = (abs(d[a]) - 1 - doubt) * grid->pitch[a];
        if (gap > 0.0) r2 += gap * gap;
    }
    return r2 < reach * reach;
}

static hs_status set_stencil(hs_grid *grid, const hs_grid_plan *plan, hs_error *err)
{
    const int m[3] = {farthest(grid, plan, 0), farthest(grid, plan, 1), farthest(grid, plan, 2)};
    const double most = (m[0] + 1.0) * (2.0 * m[1] + 1.0) * (2.0 * m[2] + 1.0);
    if (most > 1e8)
        return hs_fail(err, HS_ERROR_INPUT, "cells of %g are too small for a reach of %g: make them larger", plan->edge,
                       plan->reach);
    if (most > grid->capacity_stencil) {
        HS_TRY(HS_GROW(grid->stencil, 0, (size_t)most, err));
        grid->capacity_stencil = (int)most;
    }
    grid->n_stencil = 0;
    for (int a = 0; a <= m[0]; ++a)
        for (int b = a > 0 ? -m[1] : 0; b <= m[1]; ++b)
            for (int c = a > 0 || b > 0 ? -m[2] : 1; c <= m[2]; ++c) {
                const int d[3] = {a, b, c};
                if (plan->is_cube || can_reach(grid, plan->reach, d))
                    memcpy(grid->stencil[grid->n_stencil++], d, sizeof d);
            }
    return HS_OK;
}

hs_status hs_grid_set(hs_grid *grid, const hs_grid_plan *plan, bool *has_changed, hs_error *err)
{
    const hs_grid before = *grid;
    for (int a = 0; a < 3; ++a) set_axis(grid, a, plan);
    if (has_changed != NULL)
        *has_changed = memcmp(before.lo, grid->lo, sizeof grid->lo) != 0 ||
                       memcmp(before.pitch, grid->pitch, sizeof grid->pitch) != 0 ||
                       memcmp(before.n, grid->n, sizeof grid->n) != 0;
    return set_stencil(grid, plan, err);
}

int64_t hs_grid_n_cells(const hs_grid *grid) { return (int64_t)grid->n[0] * grid->n[1] * grid->n[2]; }

uint64_t hs_grid_key(const hs_grid *grid, hs_cell_order order, const int c[3])
{
    if (order == HS_CELL_ORDER_MORTON) return hs_morton_encode_3d((uint32_t)c[0], (uint32_t)c[1], (uint32_t)c[2]);
    return (uint64_t)hs_grid_place(grid, c);
}

void hs_grid_fini(hs_grid *grid)
{
    HS_FREE(grid->stencil);
    memset(grid, 0, sizeof *grid);
}
