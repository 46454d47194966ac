#include "style/local_energy.h"

#include <math.h>

#include "base/memory.h"

/** The nearest image of an atom itself must be out of reach: moves change its type, and its own images would follow. */
static hs_status check_box(const hs_fix *fix, double cutoff, hs_error *err)
{
    const hs_box *box = fix->env->box;
    for (int axis = 0; axis < box->dimension; ++axis)
        if (box->periodic[axis] && hs_box_reach(box, axis, cutoff) > hs_box_length(box, axis))
            return hs_fail(
                err, HS_ERROR_INPUT,
                "fix '%s' (%s): the box is periodic in %c and thinner than the cutoff (%g), so that atoms would "
                "meet their own images; make it larger",
                fix->id, fix->style->about.name, "xyz"[axis], cutoff);
    return HS_OK;
}

static void find_bounds(hs_local_energy *local)
{
    const hs_atoms *atoms = local->env->atoms;
    for (int axis = 0; axis < 3; ++axis) {
        local->lo[axis] = INFINITY;
        local->hi[axis] = -INFINITY;
        for (int i = 0; i < atoms->n_local; ++i) {
            local->lo[axis] = fmin(local->lo[axis], atoms->x[axis][i]);
            local->hi[axis] = fmax(local->hi[axis], atoms->x[axis][i]);
        }
    }
}

/** Cells at least as large as the cutoff, and no more than there are atoms, or so. */
static void choose_cells(hs_local_energy *local)
{
    const int n_local = local->env->atoms->n_local;
    double edge = local->view.cutoff_max;
    for (double n_cells = INFINITY; n_cells > 2.0 * n_local + 8.0; edge *= 1.3) {
        n_cells = 1.0;
        for (int axis = 0; axis < 3; ++axis) {
            const double n = fmax(1.0, floor((local->hi[axis] - local->lo[axis]) / edge));
            n_cells *= n;
            local->n_cells[axis] = n < 1e6 ? (int)n : 1000000;
            local->inv_edge[axis] = n / fmax(local->hi[axis] - local->lo[axis], edge);
        }
    }
}

static int cell_along(const hs_local_energy *local, int axis, double x)
{
    const int c = (int)((x - local->lo[axis]) * local->inv_edge[axis]);
    return c < 0 ? 0 : c >= local->n_cells[axis] ? local->n_cells[axis] - 1 : c;
}

static int cell_of(const hs_local_energy *local, int i)
{
    double *const *x = local->env->atoms->x;
    const int a = cell_along(local, 0, x[0][i]), b = cell_along(local, 1, x[1][i]), c = cell_along(local, 2, x[2][i]);
    return (a * local->n_cells[1] + b) * local->n_cells[2] + c;
}

static hs_status sort_atoms(hs_local_energy *local, hs_error *err)
{
    const int n_local = local->env->atoms->n_local;
    const int n_cells = local->n_cells[0] * local->n_cells[1] * local->n_cells[2];
    HS_TRY(HS_ALLOC(local->start, (size_t)n_cells + 2, err));
    HS_TRY(HS_ALLOC(local->index, (size_t)n_local, err));
    for (int i = 0; i < n_local; ++i) ++local->start[cell_of(local, i) + 2];
    for (int c = 0; c < n_cells; ++c) local->start[c + 2] += local->start[c + 1];
    for (int i = 0; i < n_local; ++i) local->index[local->start[cell_of(local, i) + 1]++] = i;
    return HS_OK;
}

static hs_status begin_mine(hs_local_energy *local, hs_error *err)
{
    const hs_atoms *atoms = local->env->atoms;
    HS_TRY(HS_ALLOC(local->n_of_type, (size_t)atoms->n_types + 1, err));
    for (int i = 0; i < atoms->n_local; ++i) ++local->n_of_type[atoms->type[i]];
    if (atoms->n_local == 0 || local->view.pair == NULL) return HS_OK;
    find_bounds(local);
    choose_cells(local);
    return sort_atoms(local, err);
}

hs_status hs_local_energy_begin(hs_local_energy *local, const hs_fix *fix, double too_high, hs_error *err)
{
    hs_env *env = fix->env;
    *local = (hs_local_energy){.env = env, .too_high = too_high};
    env->view_pairs(env, &local->view);
    const hs_pair *pair = local->view.pair;
    if (pair != NULL) HS_TRY(check_box(fix, local->view.cutoff_max, err));
    if (pair != NULL && hs_pair_has_radii(pair, false))
        return hs_fail(
            err, HS_ERROR_INPUT,
            "fix '%s' (%s): the pair style '%s' goes by diameters, and types alone say nothing about energies", fix->id,
            fix->style->about.name, pair->style->about.name);
    for (int k = 0; pair != NULL && k < pair->n_parts; ++k) local->has_tail |= pair->part[k]->tail;
    HS_UNLESS_FAILED(err, begin_mine(local, err));
    HS_TRY(hs_parallel_agree(env->parallel, err));
    hs_parallel_sum_int64(env->parallel, local->n_of_type, env->atoms->n_types + 1);
    return HS_OK;
}

void hs_local_energy_end(hs_local_energy *local)
{
    HS_FREE(local->start);
    HS_FREE(local->index);
    HS_FREE(local->n_of_type);
}

int hs_local_energy_class(const hs_local_energy *local, int i)
{
    return local->view.type[i] / (local->env->atoms->n_types + 1);
}

/** The pair of an atom of a kernel type at x and local atom j. */
static void add_pair(const hs_local_energy *local, const double x[3], const int *kernel_type, int n, int j,
                     hs_exact_sum *sums, int64_t *n_overlaps)
{
    const hs_atoms *atoms = local->env->atoms;
    const hs_pair *pair = local->view.pair;
    const double d[3] = {atoms->x[0][j] - x[0], atoms->x[1][j] - x[1], atoms->x[2][j] - x[2]};
    const double r2 = d[0] * d[0] + d[1] * d[1] + d[2] * d[2], cutoff = local->view.cutoff_max;
    if (r2 >= cutoff * cutoff) return;
    /* the type of now: the view's may be that of before a move */
    const int type_j = hs_local_energy_class(local, j) * (atoms->n_types + 1) + atoms->type[j];
    for (int k = 0; k < n; ++k) {
        double energy = 0.0;
        for (int p = 0; p < pair->n_parts; ++p) {
            const hs_evaluator *evaluator = pair->part[p]->style->evaluator;
            double force, part;
            if (evaluator != NULL &&
                hs_evaluator_pair(evaluator, &local->view.table[p], kernel_type[k], type_j, 0.0, r2, &force, &part))
                energy += part;
        }
        if (energy < local->too_high)
            hs_exact_add(&sums[k], energy);
        else
            ++n_overlaps[k]; /* also what is not a number */
    }
}

/** The cells within the cutoff of one image of the place. */
static void add_image(const hs_local_energy *local, const double x[3], const int *kernel_type, int n,
                      const int64_t left_out[2], hs_exact_sum *sums, int64_t *n_overlaps)
{
    const double cutoff = local->view.cutoff_max;
    const int64_t *id = local->env->atoms->id;
    int from[3], to[3];
    for (int axis = 0; axis < 3; ++axis) {
        if (x[axis] + cutoff < local->lo[axis] || x[axis] - cutoff > local->hi[axis]) return;
        from[axis] = cell_along(local, axis, x[axis] - cutoff);
        to[axis] = cell_along(local, axis, x[axis] + cutoff);
    }
    for (int a = from[0]; a <= to[0]; ++a)
        for (int b = from[1]; b <= to[1]; ++b) {
            const int column = (a * local->n_cells[1] + b) * local->n_cells[2];
            for (int at = local->start[column + from[2]]; at < local->start[column + to[2] + 1]; ++at) {
                const int j = local->index[at];
                if (id[j] != left_out[0] && id[j] != left_out[1])
                    add_pair(local, x, kernel_type, n, j, sums, n_overlaps);
            }
        }
}

/** Numbers of edges along an axis by which images of a coordinate may be near this rank's atoms. */
static void find_shifts(const hs_local_energy *local, int axis, double x, int *first, int *last)
{
    const hs_box *box = local->env->box;
    const double cutoff = local->view.cutoff_max, length = hs_box_length(box, axis);
    *first = *last = 0;
    if (!box->periodic[axis] || axis >= box->dimension) return;
    *first = (int)ceil((local->lo[axis] - cutoff - x) / length - 1e-9);
    *last = (int)floor((local->hi[axis] + cutoff - x) / length + 1e-9);
}

void hs_local_energy_add(const hs_local_energy *local, const double x[3], int class, const int *type, int n,
                         const int64_t left_out[2], hs_exact_sum *sums, int64_t *n_overlaps)
{
    const hs_box *box = local->env->box;
    int kernel_type[HS_LOCAL_TYPES], first[3], last[3];
    if (local->n_cells[0] == 0 || n > HS_LOCAL_TYPES) return;
    for (int k = 0; k < n; ++k) kernel_type[k] = class * (local->env->atoms->n_types + 1) + type[k];
    find_shifts(local, 2, x[2], &first[2], &last[2]);
    for (int c = first[2]; c <= last[2]; ++c) {
        const double z = x[2] + c * hs_box_length(box, 2), y_c = x[1] + c * box->tilt[2];
        find_shifts(local, 1, y_c, &first[1], &last[1]);
        for (int b = first[1]; b <= last[1]; ++b) {
            const double y = y_c + b * hs_box_length(box, 1), x_b = x[0] + c * box->tilt[1] + b * box->tilt[0];
            find_shifts(local, 0, x_b, &first[0], &last[0]);
            for (int a = first[0]; a <= last[0]; ++a)
                add_image(local, (const double[3]){x_b + a * hs_box_length(box, 0), y, z}, kernel_type, n, left_out,
                          sums, n_overlaps);
        }
    }
}

void hs_local_energy_total(const hs_local_energy *local, hs_exact_sum *sums, int n, double *energy, int64_t *n_overlaps)
{
    hs_exact_total(sums, n, local->env->parallel, energy);
    hs_parallel_sum_int64(local->env->parallel, n_overlaps, n);
}

double hs_local_energy_tail(const hs_local_energy *local, int type)
{
    const hs_pair *pair = local->view.pair;
    double sum = 0.0;
    for (int k = 0; local->has_tail && k < pair->n_parts; ++k) {
        const hs_pair *part = pair->part[k];
        for (int j = 1; j <= part->n_types && part->tail; ++j) {
            double energy, virial;
            if (part->cutoff[hs_pair_index(part, type, j)] <= 0.0) continue;
            part->style->tail(part, type < j ? type : j, type < j ? j : type, &energy, &virial);
            /* (n + 1)^2 - n^2 of its own type, 2 n of others */
            sum += (2.0 * (double)local->n_of_type[j] + (j == type ? 1.0 : 0.0)) * energy;
        }
    }
    return sum / hs_box_volume(local->env->box);
}
