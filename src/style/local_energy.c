#include "style/local_energy.h"

#include <math.h>

#include "base/memory.h"

/** The nearest image of an atom itself must be out of reach: moves change its type, and its own images would follow. */
static hs_status check_box(const hs_fix *fix, double cutoff, hs_error *err)
{
    const hs_box *box = fix->env->box;
    for (int axis = 0; axis < box->dimension; ++axis)
        if (box->periodic[axis] && hs_box_reach(box, axis, cutoff) > hs_box_length(box, axis))
            return hs_fail(err, HS_ERROR_INPUT,
                           "%s: the box is periodic in %c and thinner than the cutoff (%g), so that atoms would meet "
                           "their own images; make it larger",
                           hs_fix_who(fix).text, "xyz"[axis], cutoff);
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

/** Atoms may be outside of the box as they are between wraps. Those that have flown off would have images without number. */
static hs_status check_bounds(const hs_local_energy *local, hs_error *err)
{
    enum { BOXES_MAX = 4 };
    const hs_box *box = local->env->box;
    for (int axis = 0; axis < box->dimension; ++axis) {
        double span = hs_box_length(box, axis);
        for (int edge = axis + 1; edge < 3; ++edge) span += fabs(box->tilt[axis + edge - 1]);
        const double beyond = fmax(box->lo[axis] - local->lo[axis], local->hi[axis] - box->hi[axis]);
        if (!box->periodic[axis] || beyond <= BOXES_MAX * span) continue;
        return hs_fail(err, HS_ERROR_ATOMS,
                       "at step %lld an atom is %g outside of the box in %c, which is %g long: it has flown off since "
                       "lists were made. Usually atoms overlap, or the timestep or a Monte Carlo displacement is too "
                       "long",
                       (long long)local->env->step, beyond, "xyz"[axis], hs_box_length(box, axis));
    }
    return HS_OK;
}

/** The atoms of this rank in cells of their own. Images are ours to find, as the lists know no tilted boxes: to them the atoms lie
 *  in a closed box. */
static hs_status sort_atoms(hs_local_energy *local, hs_error *err)
{
    const hs_atoms *atoms = local->env->atoms;
    const double cutoff = local->view.cutoff_max;
    hs_cell_list_box bounds = {.dimension = 3};
    find_bounds(local);
    HS_TRY(check_bounds(local, err));
    for (int axis = 0; axis < 3; ++axis) {
        bounds.lo[axis] = local->lo[axis];
        bounds.hi[axis] = fmax(local->hi[axis], local->lo[axis] + cutoff);
    }
    if (hs_cell_list_create(&local->cells, &bounds, cutoff, NULL) == HS_CODE_OK &&
        hs_cell_list_build(local->cells, atoms->n_local, atoms->x[0], atoms->x[1], atoms->x[2], sizeof(double)) ==
            HS_CODE_OK)
        return HS_OK;
    return hs_fail(err, HS_ERROR_RUN, "cells of the atoms: %s", hs_cell_list_error(local->cells));
}

static hs_status begin_mine(hs_local_energy *local, hs_error *err)
{
    const hs_atoms *atoms = local->env->atoms;
    HS_TRY(HS_ALLOC(local->n_of_type, (size_t)atoms->n_types + 1, err));
    for (int i = 0; i < atoms->n_local; ++i) ++local->n_of_type[atoms->type[i]];
    const bool interact = local->view.pair != NULL && local->view.cutoff_max > 0.0;
    return interact && atoms->n_local > 0 ? sort_atoms(local, err) : HS_OK;
}

hs_status hs_local_energy_begin(hs_local_energy *local, const hs_fix *fix, double too_high, hs_error *err)
{
    hs_env *env = fix->env;
    *local = (hs_local_energy){.env = env, .too_high = too_high};
    env->view_pairs(env, &local->view);
    const hs_pair *pair = local->view.pair;
    if (pair != NULL) HS_TRY(check_box(fix, local->view.cutoff_max, err));
    if (pair != NULL && hs_pair_has_radii(pair, false))
        return hs_fail(err, HS_ERROR_INPUT,
                       "%s: the pair style '%s' goes by diameters, and types alone say nothing about energies",
                       hs_fix_who(fix).text, pair->style->about.name);
    for (int k = 0; pair != NULL && k < pair->n_parts; ++k) local->has_tail |= pair->part[k]->tail;
    HS_UNLESS_FAILED(err, begin_mine(local, err));
    HS_TRY(hs_parallel_agree(env->parallel, err));
    hs_parallel_sum_int64(env->parallel, local->n_of_type, env->atoms->n_types + 1);
    return HS_OK;
}

void hs_local_energy_end(hs_local_energy *local)
{
    hs_cell_list_destroy(&local->cells);
    HS_FREE(local->n_of_type);
}

int hs_local_energy_class(const hs_local_energy *local, int i)
{
    return local->view.type[i] / (local->env->atoms->n_types + 1);
}

/** The atom at a place, of a kernel type for each energy, and where they are added. */
typedef struct visit {
    const hs_local_energy *local;
    const int *kernel_type;
    int n;
    const int64_t *left_out;
    hs_exact_sum *sums;
    int64_t *n_overlaps;
} visit;

static double pair_energy(const hs_local_energy *local, int type_i, int type_j, double r2)
{
    const hs_pair *pair = local->view.pair;
    double sum = 0.0;
    for (int p = 0; p < pair->n_parts; ++p) {
        const hs_evaluator *evaluator = pair->part[p]->style->evaluator;
        double force, energy;
        if (evaluator != NULL &&
            hs_evaluator_pair(evaluator, &local->view.table[p], type_i, type_j, 0.0, r2, &force, &energy))
            sum += energy;
    }
    return sum;
}

static int add_pair(void *context, const hs_cell_pair *near)
{
    const visit *at = context;
    const hs_local_energy *local = at->local;
    const hs_atoms *atoms = local->env->atoms;
    const int j = (int)near->j;
    if (atoms->id[j] == at->left_out[0] || atoms->id[j] == at->left_out[1]) return 0;
    /* the type of now: the view's may be that of before a move */
    const int type_j = hs_local_energy_class(local, j) * (atoms->n_types + 1) + atoms->type[j];
    for (int k = 0; k < at->n; ++k) {
        const double energy = pair_energy(local, at->kernel_type[k], type_j, near->r2);
        if (energy < local->too_high)
            hs_exact_add(&at->sums[k], energy);
        else
            ++at->n_overlaps[k]; /* also what is not a number */
    }
    return 0;
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
    visit at = {local, kernel_type, n, left_out, sums, n_overlaps};
    if (local->cells == NULL || n > HS_LOCAL_TYPES) return;
    for (int k = 0; k < n; ++k) kernel_type[k] = class * (local->env->atoms->n_types + 1) + type[k];
    find_shifts(local, 2, x[2], &first[2], &last[2]);
    for (int c = first[2]; c <= last[2]; ++c) {
        const double z = x[2] + c * hs_box_length(box, 2), y_c = x[1] + c * box->tilt[2];
        find_shifts(local, 1, y_c, &first[1], &last[1]);
        for (int b = first[1]; b <= last[1]; ++b) {
            const double y = y_c + b * hs_box_length(box, 1), x_b = x[0] + c * box->tilt[1] + b * box->tilt[0];
            find_shifts(local, 0, x_b, &first[0], &last[0]);
            for (int a = first[0]; a <= last[0]; ++a)
                hs_cell_list_query(local->cells, (const double[3]){x_b + a * hs_box_length(box, 0), y, z},
                                   local->view.cutoff_max, add_pair, &at);
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
