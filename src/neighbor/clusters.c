#include "neighbor/clusters.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "parallel/parallel.h"

/* Elements beyond the last that vector loads may read. */
enum { BOX_PAD = 16 };

double hs_clusters_width(int dimension, double density, double reach)
{
    const double volume = HS_CLUSTER / (density > 1e-300 ? density : 1e-300);
    /* Four atoms in a column are three gaps high: columns a quarter wider than the cube root make the boxes cubic.
       Measured: 118 lanes an atom in the liquid of 0.8442, against 133 with the cube root itself. */
    const double width = 1.25 * (dimension == 2 ? sqrt(volume) : cbrt(volume));
    return width < 2.0 * reach ? width : 2.0 * reach;
}

static hs_status reserve(hs_cluster_part *part, int64_t n_clusters, int n_columns, hs_error *err)
{
    if (n_columns > part->capacity_columns) {
        const int capacity = n_columns + n_columns / 8;
        HS_TRY(HS_GROW(part->column_begin, 0, (size_t)capacity + 1, err));
        part->capacity_columns = capacity;
    }
    if (n_clusters > part->capacity) {
        const int64_t capacity = n_clusters + n_clusters / 32 + 16;
        HS_TRY(HS_GROW(part->entry, 0, (size_t)capacity + BOX_PAD, err));
        HS_TRY(HS_GROW(part->size, 0, (size_t)capacity, err));
        for (int side = 0; side < 6; ++side) HS_TRY(HS_GROW(part->box[side], 0, (size_t)capacity + BOX_PAD, err));
        HS_TRY(HS_GROW(part->moved, 0, (size_t)capacity + BOX_PAD, err));
        part->capacity = capacity;
    }
    return HS_OK;
}

static void bound_cluster(hs_cluster_part *part, const hs_cells *cells, const hs_atoms *atoms, int c)
{
    const int first = part->entry[c].first, size = part->size[c];
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

/** Clusters of a thread's share of the columns. */
static void fill_columns(hs_cluster_part *part, const hs_cells *cells, const hs_atoms *atoms, const int32_t *start)
{
    const int n_columns = cells->n_columns, n2 = cells->n[2], first_atom = part->first_atom;
#pragma omp for schedule(static) nowait
    for (int column = 0; column < n_columns; ++column) {
        const int end = start[(column + 1) * n2];
        int atom = start[column * n2];
        for (int c = part->column_begin[column]; c < part->column_begin[column + 1]; ++c, atom += HS_CLUSTER) {
            part->size[c] = (unsigned char)(end - atom < HS_CLUSTER ? end - atom : HS_CLUSTER);
            part->entry[c] = (hs_cluster_entry){first_atom + atom, hs_cluster_lanes(part->size[c])};
            bound_cluster(part, cells, atoms, c);
        }
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
    HS_ON_THREADS(fill_columns(part, cells, atoms, start));
    return HS_OK;
}

hs_status hs_clusters_build(hs_clusters *clusters, const hs_cells *cells, const hs_atoms *atoms, hs_error *err)
{
    if (cells->n_columns > clusters->capacity_columns) {
        const int capacity = cells->n_columns + cells->n_columns / 8;
        HS_TRY(HS_GROW(clusters->column_at, 0, (size_t)capacity, err));
        clusters->capacity_columns = capacity;
    }
    for (int column = 0; column < cells->n_columns; ++column) clusters->column_at[cells->column_rank[column]] = column;
    HS_TRY(build_part(&clusters->local, cells, atoms, cells->start_local, 0, err));
    HS_TRY(build_part(&clusters->halo, cells, atoms, cells->start_halo, atoms->n_local, err));
    clusters->generation = atoms->generation;
    clusters->has_motion = false;
    return HS_OK;
}

static void note_motion(hs_cluster_part *part, const hs_atoms *atoms, double *const from[3])
{
    const double up = 1.0 + 1e-6; /* more than the rounding to float takes off */
#pragma omp for schedule(static) nowait
    for (int c = 0; c < part->n; ++c) {
        double largest2 = 0.0;
        for (int i = part->entry[c].first, end = i + part->size[c]; i < end; ++i) {
            const double dx = atoms->x[0][i] - from[0][i], dy = atoms->x[1][i] - from[1][i],
                         dz = atoms->x[2][i] - from[2][i], d2 = dx * dx + dy * dy + dz * dz;
            largest2 = d2 > largest2 ? d2 : largest2;
        }
        part->moved[c] = (float)(sqrt(largest2) * up);
    }
}

static void note_motion_of_all(hs_clusters *clusters, const hs_atoms *atoms, double *const from[3])
{
    note_motion(&clusters->local, atoms, from);
    note_motion(&clusters->halo, atoms, from);
}

void hs_clusters_note_motion(hs_clusters *clusters, const hs_atoms *atoms, double *const from[3])
{
    HS_ON_THREADS(note_motion_of_all(clusters, atoms, from));
    clusters->has_motion = true;
}

static void fini_part(hs_cluster_part *part)
{
    HS_FREE(part->entry);
    HS_FREE(part->size);
    HS_FREE(part->moved);
    HS_FREE(part->column_begin);
    for (int side = 0; side < 6; ++side) HS_FREE(part->box[side]);
}

hs_status hs_entry_list_reserve(hs_entry_list *entries, int n_more, hs_error *err)
{
    if (entries->n + n_more <= entries->capacity) return HS_OK;
    const int64_t capacity = ((int64_t)entries->n + n_more) * 5 / 4 + 256;
    if (capacity > INT32_MAX)
        return hs_fail(err, HS_ERROR_RUN,
                       "a neighbor list of more than 2^31 cluster pairs on one thread: use more ranks");
    HS_TRY(HS_GROW(entries->entry, (size_t)entries->n, (size_t)capacity, err));
    entries->capacity = (int)capacity;
    return HS_OK;
}

hs_status hs_entry_list_pad(hs_entry_list *entries, int begin, int group, int first, hs_error *err)
{
    HS_TRY(hs_entry_list_reserve(entries, group, err));
    while ((entries->n - begin) % group != 0) entries->entry[entries->n++] = (hs_cluster_entry){first, 0};
    return HS_OK;
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

void hs_clusters_fini(hs_clusters *clusters)
{
    fini_part(&clusters->local);
    fini_part(&clusters->halo);
    HS_FREE(clusters->column_at);
    memset(clusters, 0, sizeof *clusters);
}
