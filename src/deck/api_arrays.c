/* The public API's per-atom arrays. Every rank sees the rows of all atoms: each fills in its own, and sums with zeros
   elsewhere bring them together. With one rank nothing is sent. */
#include <limits.h>
#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "deck/api_internal.h"
#include "style/places.h"

enum { SUM_MAX = 1 << 24 }; /* values summed at a time: the count of one sum is an int */

/** Which row each local atom has in the caller's array. */
typedef struct row_map {
    int64_t n;    /**< of all ranks */
    int64_t *row; /**< [n_local]; owned */
} row_map;

static int compare_ids(const void *a, const void *b)
{
    const int64_t x = *(const int64_t *)a, y = *(const int64_t *)b;
    return (x > y) - (x < y);
}

static void sum_int64(const hs_sim *sim, int64_t *values, int64_t n)
{
    if (sim->parallel.n_ranks == 1) return;
    for (int64_t i = 0; i < n; i += SUM_MAX)
        hs_parallel_sum_int64(&sim->parallel, values + i, (int)(n - i < SUM_MAX ? n - i : SUM_MAX));
}

static void sum_double(const hs_sim *sim, double *values, int64_t n)
{
    if (sim->parallel.n_ranks == 1) return;
    for (int64_t i = 0; i < n; i += SUM_MAX)
        hs_parallel_sum_double(&sim->parallel, values + i, (int)(n - i < SUM_MAX ? n - i : SUM_MAX));
}

/** Atoms of the ranks before this one (collective). */
static hs_status rank_offset(const hs_sim *sim, int64_t *offset, hs_error *err)
{
    int64_t *count;
    *offset = 0;
    HS_TRY(HS_ALLOC(count, (size_t)sim->parallel.n_ranks, err));
    count[sim->parallel.rank] = sim->atoms.n_local;
    sum_int64(sim, count, sim->parallel.n_ranks);
    for (int rank = 0; rank < sim->parallel.rank; ++rank) *offset += count[rank];
    HS_FREE(count);
    return HS_OK;
}

/** Rows by increasing id where ids have gaps: sort them all (collective). */
static hs_status rows_of_sparse_ids(const hs_sim *sim, int64_t offset, row_map *rows, hs_error *err)
{
    const hs_atoms *atoms = &sim->atoms;
    int64_t *id;
    HS_TRY(HS_ALLOC(id, (size_t)rows->n, err));
    for (int i = 0; i < atoms->n_local; ++i) id[offset + i] = atoms->id[i];
    sum_int64(sim, id, rows->n);
    qsort(id, (size_t)rows->n, sizeof *id, compare_ids);
    for (int i = 0; i < atoms->n_local; ++i) {
        const int64_t *at = bsearch(&atoms->id[i], id, (size_t)rows->n, sizeof *id, compare_ids);
        rows->row[i] = at - id;
    }
    HS_FREE(id);
    return HS_OK;
}

static hs_status make_rows(hs_simulation *simulation, hs_order order, int64_t n, row_map *rows)
{
    hs_error *err = &simulation->error;
    const hs_sim *sim = simulation->deck->sim;
    const hs_atoms *atoms = &sim->atoms;
    *rows = (row_map){.n = atoms->n_all};
    HS_TRY(hs_sim_need_box(sim, "per-atom arrays", err));
    if (order != HS_ORDER_ID && order != HS_ORDER_LOCAL)
        return hs_fail(err, HS_ERROR_INPUT, "order is %d; HS_ORDER_ID and HS_ORDER_LOCAL are the orders", (int)order);
    if (n != atoms->n_all)
        return hs_fail(err, HS_ERROR_INPUT,
                       "the array has room for %lld atoms, the simulation has %lld; see hs_simulation_n_atoms",
                       (long long)n, (long long)atoms->n_all);
    HS_TRY(HS_ALLOC(rows->row, (size_t)atoms->n_local, err));
    int64_t offset, max_id = hs_atoms_max_id(atoms);
    hs_status status = rank_offset(sim, &offset, err);
    if (status == HS_OK) hs_parallel_max_int64(&sim->parallel, &max_id, 1);
    if (status == HS_OK && order == HS_ORDER_ID && max_id != n)
        status = rows_of_sparse_ids(sim, offset, rows, err);
    else if (status == HS_OK)
        for (int i = 0; i < atoms->n_local; ++i) rows->row[i] = order == HS_ORDER_ID ? atoms->id[i] - 1 : offset + i;
    if (status != HS_OK) HS_FREE(rows->row);
    return status;
}

typedef enum { GET_POSITION, GET_UNWRAPPED, GET_VELOCITY, GET_FORCE } vector_kind;

static void read_vector(const hs_sim *sim, vector_kind kind, int i, double out[3])
{
    const hs_atoms *atoms = &sim->atoms;
    int32_t image[3] = {atoms->image[0][i], atoms->image[1][i], atoms->image[2][i]};
    double *const *from = kind == GET_VELOCITY ? atoms->v : kind == GET_FORCE ? atoms->f : atoms->x;
    for (int axis = 0; axis < 3; ++axis) out[axis] = from[axis][i];
    if (kind == GET_POSITION) hs_box_wrap(&sim->box, out, image); /* atoms may drift out until the next sort */
    if (kind == GET_UNWRAPPED) hs_unwrapped_place(&sim->env, i, out);
}

static hs_code get_vectors(hs_simulation *simulation, vector_kind kind, hs_order order, int64_t n, double *xyz)
{
    row_map rows = {0};
    hs_status status = hs_api_begin(simulation);
    if (status == HS_OK && kind == GET_FORCE) status = hs_api_need_forces(simulation);
    if (status == HS_OK) status = make_rows(simulation, order, n, &rows);
    if (status == HS_OK) {
        const hs_sim *sim = simulation->deck->sim;
        for (int64_t i = 0; sim->parallel.n_ranks > 1 && i < 3 * n; ++i) xyz[i] = 0.0;
        for (int i = 0; i < sim->atoms.n_local; ++i) read_vector(sim, kind, i, &xyz[3 * rows.row[i]]);
        sum_double(sim, xyz, 3 * n);
    }
    HS_FREE(rows.row);
    return hs_api_finish(simulation, status);
}

hs_code hs_simulation_get_positions(hs_simulation *simulation, hs_order order, int64_t n, double *xyz)
{
    return get_vectors(simulation, GET_POSITION, order, n, xyz);
}

hs_code hs_simulation_get_unwrapped(hs_simulation *simulation, hs_order order, int64_t n, double *xyz)
{
    return get_vectors(simulation, GET_UNWRAPPED, order, n, xyz);
}

hs_code hs_simulation_get_velocities(hs_simulation *simulation, hs_order order, int64_t n, double *xyz)
{
    return get_vectors(simulation, GET_VELOCITY, order, n, xyz);
}

hs_code hs_simulation_get_forces(hs_simulation *simulation, hs_order order, int64_t n, double *xyz)
{
    return get_vectors(simulation, GET_FORCE, order, n, xyz);
}

hs_code hs_simulation_get_ids(hs_simulation *simulation, hs_order order, int64_t n, int64_t *ids)
{
    row_map rows = {0};
    hs_status status = hs_api_begin(simulation);
    if (status == HS_OK) status = make_rows(simulation, order, n, &rows);
    if (status == HS_OK) {
        const hs_sim *sim = simulation->deck->sim;
        for (int64_t i = 0; sim->parallel.n_ranks > 1 && i < n; ++i) ids[i] = 0;
        for (int i = 0; i < sim->atoms.n_local; ++i) ids[rows.row[i]] = sim->atoms.id[i];
        sum_int64(sim, ids, n);
    }
    HS_FREE(rows.row);
    return hs_api_finish(simulation, status);
}

hs_code hs_simulation_get_types(hs_simulation *simulation, hs_order order, int64_t n, int32_t *types)
{
    row_map rows = {0};
    int64_t *wide = NULL;
    hs_status status = hs_api_begin(simulation);
    if (status == HS_OK) status = make_rows(simulation, order, n, &rows);
    if (status == HS_OK) status = HS_ALLOC(wide, (size_t)n, &simulation->error);
    if (status == HS_OK) {
        const hs_sim *sim = simulation->deck->sim;
        for (int i = 0; i < sim->atoms.n_local; ++i) wide[rows.row[i]] = sim->atoms.type[i];
        sum_int64(sim, wide, n);
        for (int64_t i = 0; i < n; ++i) types[i] = (int32_t)wide[i];
    }
    HS_FREE(wide);
    HS_FREE(rows.row);
    return hs_api_finish(simulation, status);
}

static hs_status check_finite(const double *xyz, int64_t n, const char *what, hs_error *err)
{
    for (int64_t i = 0; i < 3 * n; ++i)
        if (!isfinite(xyz[i]))
            return hs_fail(err, HS_ERROR_INPUT, "%s of row %lld: %g is not a finite number", what, (long long)(i / 3),
                           xyz[i]);
    return HS_OK;
}

/** New positions must be inside fixed faces, and within a few billion box lengths of periodic ones (image counts are
 *  32-bit). Shrink-wrapped faces follow the atoms. */
static hs_status check_inside(const hs_box *box, const double *xyz, int64_t n, hs_error *err)
{
    const double images_max = HS_BOX_FARTHEST;
    for (int64_t row = 0; row < n; ++row)
        for (int axis = 0; axis < 3; ++axis) {
            const double x = hs_box_upright(box, &xyz[3 * row], axis), length = hs_box_length(box, axis);
            const bool is_out = box->periodic[axis]
                                    ? fabs(x - box->lo[axis]) / length > images_max
                                    : (box->boundary[axis][0] == HS_BOUNDARY_FIXED && x < box->lo[axis]) ||
                                          (box->boundary[axis][1] == HS_BOUNDARY_FIXED && x > box->hi[axis]);
            if (is_out)
                return hs_fail(err, HS_ERROR_INPUT, "position of row %lld: %c = %g is outside of the box, [%g, %g]",
                               (long long)row, "xyz"[axis], xyz[3 * row + axis], box -> lo[axis], box -> hi[axis]);
        }
    return HS_OK;
}

static void write_position(hs_sim *sim, int i, const double *xyz)
{
    hs_atoms *atoms = &sim->atoms;
    double x[3] = {xyz[0], xyz[1], xyz[2]};
    int32_t image[3] = {0, 0, 0};
    hs_box_wrap(&sim->box, x, image);
    for (int axis = 0; axis < 3; ++axis) {
        atoms->x[axis][i] = x[axis];
        atoms->image[axis][i] = image[axis];
    }
}

hs_code hs_simulation_set_positions(hs_simulation *simulation, hs_order order, int64_t n, const double *xyz)
{
    row_map rows = {0};
    hs_status status = hs_api_begin(simulation);
    if (status == HS_OK) status = make_rows(simulation, order, n, &rows);
    if (status == HS_OK) status = check_finite(xyz, n, "position", &simulation->error);
    if (status == HS_OK) status = check_inside(&simulation->deck->sim->box, xyz, n, &simulation->error);
    if (status == HS_OK) {
        hs_sim *sim = simulation->deck->sim;
        for (int i = 0; i < sim->atoms.n_local; ++i) write_position(sim, i, &xyz[3 * rows.row[i]]);
        hs_sim_atoms_changed(sim);
    }
    HS_FREE(rows.row);
    return hs_api_finish(simulation, status);
}

hs_code hs_simulation_set_velocities(hs_simulation *simulation, hs_order order, int64_t n, const double *xyz)
{
    row_map rows = {0};
    hs_status status = hs_api_begin(simulation);
    if (status == HS_OK) status = make_rows(simulation, order, n, &rows);
    if (status == HS_OK) status = check_finite(xyz, n, "velocity", &simulation->error);
    if (status == HS_OK) {
        hs_sim *sim = simulation->deck->sim;
        for (int i = 0; i < sim->atoms.n_local; ++i)
            for (int axis = 0; axis < 3; ++axis) sim->atoms.v[axis][i] = xyz[3 * rows.row[i] + axis];
        hs_sim_atoms_changed(sim);
    }
    HS_FREE(rows.row);
    return hs_api_finish(simulation, status);
}
