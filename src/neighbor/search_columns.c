/* The columns around a column: prepared once for all clusters of the column. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "neighbor/cluster_search.h"

/* Elements beyond the last that vector code may read. */
enum { PAD = 16 };

void hs_cluster_search_begin(hs_search *search, const hs_clusters *clusters, const hs_cells *cells, double reach,
                             double skin)
{
    float extent = 0.0f;
    for (int a = 0; a < 3; ++a) extent = fmaxf(extent, (float)(cells->pitch[a] * cells->n[a]));
    search->clusters = clusters;
    search->cells = cells;
    search->column = -1;
    search->batch_begin = search->batch_end = 0;
    /* Boxes are rounded to float: a margin of some units in the last place of the largest coordinate keeps the search
       from missing a pair. */
    search->reach = (float)reach + 8.0f * FLT_EPSILON * (extent + (float)reach);
    search->skin = (float)skin * (1.0f - 8.0f * FLT_EPSILON);
}

static void fini_list(hs_column_list *list)
{
    for (int side = 0; side < 4; ++side) HS_FREE(list->bound[side]);
    HS_FREE(list->cell_lo);
    HS_FREE(list->cell_hi);
    HS_FREE(list->column);
    HS_FREE(list->run);
    memset(list, 0, sizeof *list);
}

void hs_cluster_search_fini(hs_search *search)
{
    fini_list(&search->local);
    fini_list(&search->halo);
    HS_FREE(search->moved.entry);
}

static hs_status add_column(hs_column_list *list, const hs_cells *cells, int c0, int c1, int column, hs_error *err)
{
    const size_t n = (size_t)list->n;
    if (list->n == list->capacity) {
        const size_t capacity = 2 * n + 32;
        for (int side = 0; side < 4; ++side) HS_TRY(HS_GROW(list->bound[side], n, capacity + PAD, err));
        HS_TRY(HS_GROW(list->cell_lo, 0, capacity + PAD, err));
        HS_TRY(HS_GROW(list->cell_hi, 0, capacity + PAD, err));
        HS_TRY(HS_GROW(list->column, n, capacity + PAD, err));
        HS_TRY(HS_GROW(list->run, 0, capacity, err));
        list->capacity = (int)capacity;
    }
    const float pitch0 = (float)cells->pitch[0], pitch1 = (float)cells->pitch[1];
    /* the outer columns hold also what lies beyond them */
    list->bound[0][n] = c0 == 0 ? -INFINITY : (float)c0 * pitch0;
    list->bound[1][n] = c0 == cells->n[0] - 1 ? INFINITY : (float)(c0 + 1) * pitch0;
    list->bound[2][n] = c1 == 0 ? -INFINITY : (float)c1 * pitch1;
    list->bound[3][n] = c1 == cells->n[1] - 1 ? INFINITY : (float)(c1 + 1) * pitch1;
    list->column[n] = column;
    ++list->n;
    return HS_OK;
}

/** Smallest distance between two columns that are d columns apart, along one axis. */
static inline float columns_gap(int d, float pitch) { return d == 0 ? 0.0f : (float)((d < 0 ? -d : d) - 1) * pitch; }

static inline int clamp(int value, int last) { return value < 0 ? 0 : value > last ? last : value; }

hs_status hs_cluster_search_column(hs_search *search, int column, hs_error *err)
{
    const hs_cells *cells = search->cells;
    const hs_clusters *clusters = search->clusters;
    const float pitch0 = (float)cells->pitch[0], pitch1 = (float)cells->pitch[1];
    const int n0 = cells->n[0], n1 = cells->n[1];
    const int own0 = clusters->column_at[column] / n1, own1 = clusters->column_at[column] % n1;
    const int far0 = (int)fminf(search->reach / pitch0 + 2.0f, 1e6f),
              far1 = (int)fminf(search->reach / pitch1 + 2.0f, 1e6f);
    search->column = column;
    search->local.n = search->halo.n = 0;
    for (int c0 = clamp(own0 - far0, n0 - 1); c0 <= clamp(own0 + far0, n0 - 1); ++c0)
        for (int c1 = clamp(own1 - far1, n1 - 1); c1 <= clamp(own1 + far1, n1 - 1); ++c1) {
            const float d0 = columns_gap(c0 - own0, pitch0), d1 = columns_gap(c1 - own1, pitch1);
            if (d0 * d0 + d1 * d1 > search->reach * search->reach) continue;
            const int other = cells->column_rank[c0 * n1 + c1];
            const bool is_upper = c0 > own0 || (c0 == own0 && c1 >= own1);
            if (is_upper && clusters->local.column_begin[other] < clusters->local.column_begin[other + 1])
                HS_TRY(add_column(&search->local, cells, c0, c1, other, err));
            if (clusters->halo.column_begin[other] < clusters->halo.column_begin[other + 1])
                HS_TRY(add_column(&search->halo, cells, c0, c1, other, err));
        }
    return HS_OK;
}
