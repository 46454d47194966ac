#include "neighbor/clusters.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "parallel/parallel.h"

/* Elements beyond the last that vector loads may read. */
enum { BOX_PAD = 16 };

double hs_clusters_width(int dimension, double density, double reach)
{
    const double volume = HS_CLUSTER / (density > 1e-300 ? density : 1e-300);
    const double width = dimension == 2 ? sqrt(volume) : cbrt(volume);
    return width < reach ? width : reach;
}

static hs_status reserve(hs_cluster_part *part, int64_t n_clusters, int n_columns, hs_error *err)
{
    if (n_columns > part->capacity_columns) {
        part->capacity_columns = n_columns + n_columns / 8;
        HS_TRY(HS_GROW(part->column_begin, 0, (size_t)part->capacity_columns + 1, err));
    }
    if (n_clusters > part->capacity) {
        part->capacity = n_clusters + n_clusters / 8 + 16;
        HS_TRY(HS_GROW(part->first, 0, (size_t)part->capacity, err));
        HS_TRY(HS_GROW(part->size, 0, (size_t)part->capacity, err));
        for (int side = 0; side < 6; ++side)
            HS_TRY(HS_GROW(part->box[side], 0, (size_t)part->capacity + BOX_PAD, err));
    }
    return HS_OK;
}

static void bound_cluster(hs_cluster_part *part, const hs_cells *cells, const hs_atoms *atoms, int c)
{
    const int first = part->first[c], size = part->size[c];
    for (int a = 0; a < 3; ++a) {
        const double *x = atoms->x[cells->axis[a]] + first;
        double lo = x[0], hi = x[0];
        for (int k = 1; k < size; ++k) {
            lo = x[k] < lo ? x[k] : lo;
            hi = x[k] > hi ? x[k] : hi;
        }
        part->box[a][c] = (float)(lo - cells->lo[a]);
        part->box[a + 3][c] = (float)(hi - cells->lo[a]);
    }
}

static hs_status build_part(hs_cluster_part *part, const hs_cells *cells, const hs_atoms *atoms, const int32_t *start,
                            int first_atom, hs_error *err)
{
    const int n_columns = cells->n_columns, n2 = cells->n[2];
    HS_TRY(reserve(part, 0, n_columns, err));
    int n = 0;
    for (int column = 0; column < n_columns; ++column) {
        part->column_begin[column] = n;
        n += (start[(column + 1) * n2] - start[column * n2] + HS_CLUSTER - 1) / HS_CLUSTER;
    }
    part->column_begin[n_columns] = n;
    part->n = n;
    part->first_atom = first_atom;
    HS_TRY(reserve(part, n, n_columns, err));
#pragma omp parallel for schedule(static)
    for (int column = 0; column < n_columns; ++column) {
        const int end = start[(column + 1) * n2];
        int atom = start[column * n2];
        for (int c = part->column_begin[column]; c < part->column_begin[column + 1]; ++c, atom += HS_CLUSTER) {
            part->first[c] = first_atom + atom;
            part->size[c] = (unsigned char)(end - atom < HS_CLUSTER ? end - atom : HS_CLUSTER);
            bound_cluster(part, cells, atoms, c);
        }
    }
    return HS_OK;
}

hs_status hs_clusters_build(hs_clusters *clusters, const hs_cells *cells, const hs_atoms *atoms, hs_error *err)
{
    if (cells->n_columns > clusters->capacity_columns) {
        clusters->capacity_columns = cells->n_columns + cells->n_columns / 8;
        HS_TRY(HS_GROW(clusters->column_at, 0, (size_t)clusters->capacity_columns, err));
    }
    for (int column = 0; column < cells->n_columns; ++column) clusters->column_at[cells->column_rank[column]] = column;
    HS_TRY(build_part(&clusters->local, cells, atoms, cells->start_local, 0, err));
    HS_TRY(build_part(&clusters->halo, cells, atoms, cells->start_halo, atoms->n_local, err));
    clusters->generation = atoms->generation;
    return HS_OK;
}

static void fini_part(hs_cluster_part *part)
{
    HS_FREE(part->first);
    HS_FREE(part->size);
    HS_FREE(part->column_begin);
    for (int side = 0; side < 6; ++side) HS_FREE(part->box[side]);
}

/** The i-cluster of a search, in coordinates relative to the grid. */
typedef struct probe {
    float lo[3], hi[3];
    float reach, reach2;
    uint32_t rows;   /**< mask of the rows that are atoms */
} probe;

/** Mask with the bits of columns (j) below `size` set, in all four rows. */
static inline uint32_t lanes_below(int size) { return ((1u << size) - 1u) * 0x1111u; }

/** Mask with the bits of rows (i) below `size` set. */
static inline uint32_t rows_below(int size) { return (1u << 4 * size) - 1u; }

/* Pairs within one cluster: j > i only. */
static const uint32_t self_mask = 0x8ceu;

static probe make_probe(const hs_clusters *clusters, const hs_cells *cells, int ci, double reach)
{
    const hs_cluster_part *local = &clusters->local;
    probe p;
    float extent = 0.0f;
    for (int a = 0; a < 3; ++a) {
        p.lo[a] = local->box[a][ci];
        p.hi[a] = local->box[a + 3][ci];
        const float length = (float)(cells->pitch[a] * cells->n[a]);
        extent = length > extent ? length : extent;
    }
    /* Boxes are rounded to float: a margin of several units in the last place of the largest coordinate keeps the
       search from missing a pair. */
    p.reach = (float)reach + 8.0f * FLT_EPSILON * (extent + (float)reach);
    p.reach2 = p.reach * p.reach;
    p.rows = rows_below(local->size[ci]);
    return p;
}

static hs_status reserve_entries(hs_entry_list *entries, int n_more, hs_error *err)
{
    if (entries->n + n_more <= entries->capacity) return HS_OK;
    const int64_t capacity = 2 * ((int64_t)entries->n + n_more) + 64;
    if (capacity > INT32_MAX) return hs_fail(err, HS_ERROR_RUN, "a neighbor list of more than 2^31 cluster pairs on one thread: use more ranks");
    HS_TRY(HS_GROW(entries->entry, (size_t)entries->n, (size_t)capacity, err));
    entries->capacity = (int)capacity;
    return HS_OK;
}

hs_status hs_entry_list_pad(hs_entry_list *entries, int begin, int group, int first, hs_error *err)
{
    HS_TRY(reserve_entries(entries, group, err));
    while ((entries->n - begin) % group != 0) entries->entry[entries->n++] = (hs_cluster_entry){first, 0};
    return HS_OK;
}

static inline float gap(float lo_i, float hi_i, float lo_j, float hi_j)
{
    const float below = lo_i - hi_j, above = lo_j - hi_i;
    const float larger = below > above ? below : above;
    return larger > 0.0f ? larger : 0.0f;
}

/** Test the bounding boxes of clusters [begin, end) and append those within reach. */
static void test_run(const hs_cluster_part *part, const probe *p, int begin, int end, hs_entry_list *entries)
{
    hs_cluster_entry *entry = entries->entry;
    int n = entries->n;
    for (int c = begin; c < end; ++c) {
        const float d0 = gap(p->lo[0], p->hi[0], part->box[0][c], part->box[3][c]);
        const float d1 = gap(p->lo[1], p->hi[1], part->box[1][c], part->box[4][c]);
        const float d2 = gap(p->lo[2], p->hi[2], part->box[2][c], part->box[5][c]);
        const bool is_near = d0 * d0 + d1 * d1 + d2 * d2 <= p->reach2;
        entry[n] = (hs_cluster_entry){part->first[c], p->rows & lanes_below(part->size[c])};
        n += is_near;   /* without a branch: whether a box is near is as good as random */
    }
    entries->n = n;
}

/** Clusters of one column whose atoms can be within dz of the probe along the run axis. */
static void cluster_range(const hs_cluster_part *part, const hs_cells *cells, const int32_t *start, int column,
                          const probe *p, float dz, int *begin, int *end)
{
    const float inv = (float)cells->inv_pitch[2];
    const float z_lo = (p->lo[2] - dz) * inv, z_hi = (p->hi[2] + dz) * inv;
    const int n2 = cells->n[2];
    /* one cell more on each side than the float arithmetic says, against its rounding */
    const int c_lo = z_lo <= 1.0f ? 0 : z_lo >= (float)n2 ? n2 - 1 : (int)z_lo - (z_lo - (float)(int)z_lo < 1e-3f);
    const int c_hi = z_hi <= 0.0f ? 0 : z_hi >= (float)(n2 - 1) ? n2 - 1 : (int)z_hi + (z_hi - (float)(int)z_hi > 0.999f);
    const int32_t *cell = start + (int64_t)column * n2;
    const int a_begin = cell[c_lo] - cell[0], a_end = cell[c_hi + 1] - cell[0];
    *begin = part->column_begin[column] + a_begin / HS_CLUSTER;
    *end = part->column_begin[column] + (a_end + HS_CLUSTER - 1) / HS_CLUSTER;
    if (a_begin >= a_end) *end = *begin;
}

int hs_clusters_column(const hs_clusters *clusters, const hs_cells *cells, int ci)
{
    int lo = 0, hi = cells->n_columns;
    while (hi - lo > 1) {
        const int middle = lo + (hi - lo) / 2;
        if (clusters->local.column_begin[middle] <= ci)
            lo = middle;
        else
            hi = middle;
    }
    return lo;
}

static inline int clamp(int value, int last) { return value < 0 ? 0 : value > last ? last : value; }

/** Search one part in the columns around the probe. For the local part (own_column >= 0) only the upper half of them. */
static hs_status search(const hs_clusters *clusters, const hs_cells *cells, const hs_cluster_part *part, const int32_t *start,
                        const probe *p, int ci, int own_column, hs_entry_list *entries, hs_error *err)
{
    const bool is_local = own_column >= 0;
    const float pitch0 = (float)cells->pitch[0], pitch1 = (float)cells->pitch[1];
    const int n1 = cells->n[1];
    const int own0 = is_local ? clusters->column_at[own_column] / n1 : -1;
    const int own1 = is_local ? clusters->column_at[own_column] % n1 : -1;
    const int first0 = is_local ? own0 : clamp((int)floorf((p->lo[0] - p->reach) / pitch0), cells->n[0] - 1);
    const int last0 = clamp((int)floorf((p->hi[0] + p->reach) / pitch0), cells->n[0] - 1);
    const int first1 = clamp((int)floorf((p->lo[1] - p->reach) / pitch1), n1 - 1);
    const int last1 = clamp((int)floorf((p->hi[1] + p->reach) / pitch1), n1 - 1);
    for (int c0 = first0; c0 <= last0; ++c0) {
        const float d0 = gap(p->lo[0], p->hi[0], (float)c0 * pitch0, (float)(c0 + 1) * pitch0);
        for (int c1 = c0 == own0 ? own1 : first1; c1 <= last1; ++c1) {
            const float d1 = gap(p->lo[1], p->hi[1], (float)c1 * pitch1, (float)(c1 + 1) * pitch1);
            const float rest2 = p->reach2 - d0 * d0 - d1 * d1;
            if (rest2 <= 0.0f) continue;
            const int column = cells->column_rank[c0 * n1 + c1];
            int begin, end;
            cluster_range(part, cells, start, column, p, sqrtf(rest2), &begin, &end);
            if (column == own_column && begin <= ci) begin = ci + 1;
            if (begin >= end) continue;
            HS_TRY(reserve_entries(entries, end - begin, err));
            test_run(part, p, begin, end, entries);
        }
    }
    return HS_OK;
}

/** Whether halo atoms can be near: they all lie beyond an upper face of the box. */
static bool is_near_halo(const hs_cells *cells, const probe *p)
{
    for (int a = 0; a < 3; ++a)
        if (p->hi[a] + p->reach >= (float)cells->box_hi[a]) return true;
    return false;
}

hs_status hs_clusters_find(const hs_clusters *clusters, const hs_cells *cells, int ci, int column, double reach,
                           hs_entry_list *entries, hs_error *err)
{
    const probe p = make_probe(clusters, cells, ci, reach);
    const int size = clusters->local.size[ci];
    HS_TRY(reserve_entries(entries, 1, err));
    if (size > 1)
        entries->entry[entries->n++] =
            (hs_cluster_entry){clusters->local.first[ci], self_mask & p.rows & lanes_below(size)};
    HS_TRY(search(clusters, cells, &clusters->local, cells->start_local, &p, ci, column, entries, err));
    if (clusters->halo.n == 0 || !is_near_halo(cells, &p)) return HS_OK;
    return search(clusters, cells, &clusters->halo, cells->start_halo, &p, ci, -1, entries, err);
}

void hs_clusters_fini(hs_clusters *clusters)
{
    fini_part(&clusters->local);
    fini_part(&clusters->halo);
    HS_FREE(clusters->column_at);
    memset(clusters, 0, sizeof *clusters);
}
