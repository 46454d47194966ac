/* Between the drift and the forces: atoms that left are found, coordinates wrapped, atoms sorted, the halo made
 * anew. */
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "comm/migrate.h"
#include "neighbor/occupied.h"
#include "sim/methods.h"
#include "sim/thermo.h"

/** Box lengths that an atom may be away from the box where atoms are placed: image numbers are of 32 bits. */
static const double farthest_placed = 1e9;
/** The same for atoms that move: one that crosses a whole box between two exchanges was thrown there by a nonsensical
 *  force. */
static const double farthest_moved = 1.0;
/** Cutoffs from the origin at which shrink-wrapped faces follow an atom no more. */
static const double farthest_wrapped = 1e9;

/** Wrap one atom along one periodic axis, and its listed position with it. An atom farther from the box than so many
 *  box lengths is left where it is, and counts as lost: false. */
static inline bool wrap_axis(const hs_box *box, hs_atoms *atoms, double *listed, int axis, int i, double farthest)
{
    const double lo = box->lo[axis], hi = box->hi[axis], length = hi - lo;
    double *x = &atoms->x[axis][i];
    if (*x >= lo && *x < hi) return true;
    if (!(*x >= lo - farthest * length && *x < hi + farthest * length)) return false;
    const double before = *x;
    int32_t crossings = 0;
    if (*x < lo - length || *x >= hi + length) crossings = (int32_t)floor((*x - lo) / length);
    *x -= crossings * length;
    if (*x < lo) *x += length, --crossings;
    if (*x >= hi) *x -= length, ++crossings;
    /* an atom a hair below lo may round to hi exactly: it belongs to lo */
    if (*x < lo) *x = lo;
    atoms->image[axis][i] += crossings;
    listed[i] += *x - before;
    return true;
}

/** The same along all axes of a tilted box. */
static bool wrap_tilted(const hs_box *box, hs_atoms *atoms, double *const listed[3], int i, double farthest)
{
    double x[3] = {atoms->x[0][i], atoms->x[1][i], atoms->x[2][i]};
    int32_t image[3] = {atoms->image[0][i], atoms->image[1][i], atoms->image[2][i]};
    if (!hs_box_wrap_tilted(box, farthest, x, image)) return false;
    for (int axis = 0; axis < 3; ++axis) {
        listed[axis][i] += x[axis] - atoms->x[axis][i];
        atoms->x[axis][i] = x[axis];
        atoms->image[axis][i] = image[axis];
    }
    return true;
}

/** Box lengths that atoms may be away from a tilted box: a short way crosses many edges where faces lie close to each
 *  other. */
static double farthest_tilted(const hs_box *box, bool has_moved)
{
    double leaning = 0.0;
    if (!has_moved) return farthest_placed;
    for (int axis = 0; axis < 3; ++axis)
        leaning = fmax(leaning, hs_box_length(box, axis) / hs_box_thickness(box, axis));
    return farthest_moved + leaning;
}

static void wrap_share(hs_sim *sim, bool *is_wrapped)
{
    hs_atoms *atoms = &sim->atoms;
    double farthest = sim->is_initialized ? farthest_moved : farthest_placed;
    bool is_share_wrapped = true;
    if (sim->box.is_tilted) {
        farthest = farthest_tilted(&sim->box, sim->is_initialized);
#pragma omp for schedule(static) nowait
        for (int i = 0; i < atoms->n_local; ++i)
            is_share_wrapped = wrap_tilted(&sim->box, atoms, sim->neighbor.x_listed, i, farthest) && is_share_wrapped;
    }
    for (int axis = 0; axis < 3; ++axis) {
        if (!sim->box.periodic[axis] || sim->box.is_tilted) continue;
        double *listed = sim->neighbor.x_listed[axis];
#pragma omp for schedule(static) nowait
        for (int i = 0; i < atoms->n_local; ++i)
            is_share_wrapped = wrap_axis(&sim->box, atoms, listed, axis, i, farthest) && is_share_wrapped;
    }
    if (is_share_wrapped) return;
#pragma omp atomic write
    *is_wrapped = false;
}

/** Bring atoms back into the box along periodic axes; false when one is too far away. */
static bool wrap(hs_sim *sim)
{
    bool is_wrapped = true;
    HS_ON_THREADS(wrap_share(sim, &is_wrapped));
    return is_wrapped;
}

/** Coordinate of an atom that is between lo and hi of the box while the atom is within the faces of the axis. */
static inline double coordinate_of(const hs_sim *sim, int axis, int i)
{
    const hs_atoms *atoms = &sim->atoms;
    if (!sim->box.is_tilted) return atoms->x[axis][i];
    return hs_box_upright(&sim->box, (const double[3]){atoms->x[0][i], atoms->x[1][i], atoms->x[2][i]}, axis);
}

void hs_sim_shrink_box(hs_sim *sim)
{
    hs_box *box = &sim->box;
    for (int axis = 0; axis < 3; ++axis) {
        if (box->periodic[axis]) continue;
        double extent[2] = {-DBL_MAX, -DBL_MAX}; /* -min, max */
        for (int i = 0; i < sim->atoms.n_local; ++i) {
            const double x = coordinate_of(sim, axis, i);
            if (-x > extent[0]) extent[0] = -x;
            if (x > extent[1]) extent[1] = x;
        }
        hs_parallel_max_double(&sim->parallel, extent, 2);
        if (extent[0] == -DBL_MAX) continue; /* no atoms: nothing to follow */
        const double lo = -extent[0] - box->shrink_margin[axis], hi = extent[1] + box->shrink_margin[axis];
        const hs_boundary *kind = box->boundary[axis];
        if (kind[0] == HS_BOUNDARY_SHRINK) box->lo[axis] = lo;
        if (kind[0] == HS_BOUNDARY_SHRINK_MIN) box->lo[axis] = fmin(lo, box->shrink_limit[axis][0]);
        if (kind[1] == HS_BOUNDARY_SHRINK) box->hi[axis] = hi;
        if (kind[1] == HS_BOUNDARY_SHRINK_MIN) box->hi[axis] = fmax(hi, box->shrink_limit[axis][1]);
    }
}

static inline bool is_shrink_wrapped(hs_boundary kind)
{
    return kind == HS_BOUNDARY_SHRINK || kind == HS_BOUNDARY_SHRINK_MIN;
}

/** Whether an atom is lost. Shrink-wrapped faces follow the atoms, though only when lists are made: nothing is ever
 *  outside of them, unless it is so far away that no cells can be laid over the box. */
static inline bool is_outside(const hs_sim *sim, int i)
{
    const hs_box *box = &sim->box;
    const double cutoff = sim->pair->cutoff_max, farthest = cutoff > 0.0 ? farthest_wrapped * cutoff : DBL_MAX;
    for (int axis = 0; axis < 3; ++axis) {
        /* rounding may leave wrapped atoms of tilted boxes a hair outside */
        const double hair = box->is_tilted && box->periodic[axis] ? 1e-9 * hs_box_length(box, axis) : 0.0;
        const double x = coordinate_of(sim, axis, i);
        if (!(x >= (is_shrink_wrapped(box->boundary[axis][0]) ? -farthest : box->lo[axis] - hair))) return true;
        if (!(x <= (is_shrink_wrapped(box->boundary[axis][1]) ? farthest : box->hi[axis] + hair))) return true;
    }
    return false;
}

static hs_status report_lost(const hs_sim *sim, int i, hs_error *err)
{
    const hs_atoms *atoms = &sim->atoms;
    const double *tilt = sim->box.tilt;
    char tilts[96] = "";
    if (sim->box.is_tilted) snprintf(tilts, sizeof tilts, ", tilted by xy %g, xz %g, yz %g", tilt[0], tilt[1], tilt[2]);
    return hs_fail(err, HS_ERROR_ATOMS,
                   "at step %lld atom %lld at (%g %g %g), velocity (%g %g %g), has left the box (%g %g) x (%g %g) x "
                   "(%g %g)%s. Usually the timestep is too long, atoms overlap, or a fixed boundary needs a wall "
                   "('thermo_modify lost ignore' lets atoms go)",
                   (long long)sim->env.step, (long long)atoms->id[i], atoms->x[0][i], atoms->x[1][i], atoms->x[2][i],
                   atoms->v[0][i], atoms->v[1][i], atoms->v[2][i], sim->box.lo[0], sim->box.hi[0], sim->box.lo[1],
                   sim->box.hi[1], sim->box.lo[2], sim->box.hi[2], tilts);
}

/** Atoms beyond a fixed face, or too far away to be wrapped, are lost: an error, or (thermo_modify lost warn|ignore)
 *  they are removed. */
static hs_status find_lost(hs_sim *sim, bool is_wrapped, hs_error *err)
{
    hs_atoms *atoms = &sim->atoms;
    if (is_wrapped && sim->box.periodic[0] && sim->box.periodic[1] && sim->box.periodic[2]) return HS_OK;
    int first = -1;
    for (int i = 0; i < atoms->n_local && first < 0; ++i)
        if (is_outside(sim, i)) first = i;
    if (first < 0) return HS_OK;
    if (hs_thermo_lost(sim->thermo) == HS_LOST_ERROR) return report_lost(sim, first, err);
    unsigned char *drop;
    HS_TRY(HS_ALLOC(drop, (size_t)atoms->n_local, err));
    for (int i = first; i < atoms->n_local; ++i) drop[i] = is_outside(sim, i);
    hs_atoms_remove(atoms, drop);
    HS_FREE(drop);
    return HS_OK;
}

/** Types that kernels see, for local and halo atoms. */
static void renew_kernel_types(hs_sim *sim)
{
    if (sim->kernel_type == NULL) return;
    hs_sim_set_kernel_types(sim);
    hs_halo_forward_array(&sim->halo, &sim->atoms, sim->kernel_type, sizeof *sim->kernel_type);
}

hs_status hs_sim_make_halo(hs_sim *sim, double reach, hs_error *err)
{
    HS_TRY(hs_halo_build(&sim->halo, &sim->domain, &sim->parallel, &sim->box, &sim->atoms, reach, err));
    hs_halo_forward_fields(&sim->halo, &sim->atoms);
    renew_kernel_types(sim);
    hs_timer_add_comm(&sim->timer, HS_COMM_EXCHANGE);
    return HS_OK;
}

/** Width of columns: the deck's, or the one that makes clusters cubic. */
static double column_width(const hs_sim *sim, const hs_occupied *occupied, double reach)
{
    const double fraction = sim->neighbor.settings.cell;
    double volume = occupied->volume;
    if (fraction > 0.0) return fraction * sim->pair->cutoff_max;
    if (sim->box.is_tilted) volume = fmin(volume, hs_domain_volume(&sim->domain, &sim->box));
    return hs_clusters_width(sim->box.dimension, (double)sim->atoms.n_local / volume, reach);
}

/** Sort the local atoms into cells laid over the part of this rank's brick where they are. */
static hs_status sort_local(hs_sim *sim, double reach, hs_error *err)
{
    hs_neighbor *neighbor = &sim->neighbor;
    hs_atoms *atoms = &sim->atoms;
    hs_occupied occupied;
    double lo[3], hi[3];
    hs_domain_brick(&sim->domain, &sim->box, lo, hi);
    HS_TRY(hs_occupied_find(&occupied, lo, hi, sim->box.dimension, reach, atoms, err));
    neighbor->cells.curve = neighbor->settings.order;
    HS_TRY(hs_cells_set_grid(&neighbor->cells, occupied.lo, occupied.hi, sim->box.dimension, reach,
                             column_width(sim, &occupied, reach), atoms->n_local, err));
    /* what encloses a tilted brick has halo atoms in it: they may be anywhere */
    if (sim->box.is_tilted) hs_cells_expect_halo_anywhere(&neighbor->cells);
    HS_TRY(hs_cells_sort_local(&neighbor->cells, atoms, err));
    return hs_atoms_permute(atoms, neighbor->cells.sort.order, err);
}

/** Sort the halo, fill its fields, and cut all atoms into clusters. */
static hs_status cluster(hs_sim *sim, hs_error *err)
{
    hs_neighbor *neighbor = &sim->neighbor;
    hs_atoms *atoms = &sim->atoms;
    HS_TRY(hs_cells_sort_halo(&neighbor->cells, atoms, err));
    hs_halo_reorder(&sim->halo, atoms, neighbor->cells.sort.order);
    hs_halo_forward_fields(&sim->halo, atoms);
    HS_TRY(hs_clusters_build(&neighbor->clusters, &neighbor->cells, atoms, err));
    renew_kernel_types(sim);
    hs_timer_add(&sim->timer, HS_PHASE_NEIGH);
    return HS_OK;
}

hs_status hs_sim_sort_and_cluster(hs_sim *sim, double reach, hs_error *err)
{
    hs_atoms *atoms = &sim->atoms;
    (void)sort_local(sim, reach, err); /* the ranks agree on errors when they make the halo */
    hs_timer_add(&sim->timer, HS_PHASE_NEIGH);
    HS_TRY(hs_halo_build(&sim->halo, &sim->domain, &sim->parallel, &sim->box, atoms, reach, err));
    hs_timer_add_comm(&sim->timer, HS_COMM_EXCHANGE);
    return cluster(sim, err);
}

/** Where the last sort has put each atom. The cells need their keys no more. */
static const int32_t *places(hs_cells *cells, int n)
{
#pragma omp parallel for schedule(static)
    for (int k = 0; k < n; ++k) cells->sort.key[cells->sort.order[k]] = k;
    return cells->sort.key;
}

hs_status hs_sim_sort_again(hs_sim *sim, hs_error *err)
{
    hs_cells *cells = &sim->neighbor.cells;
    hs_atoms *atoms = &sim->atoms;
    HS_UNLESS_FAILED(err, hs_cells_sort_local(cells, atoms, err));
    HS_UNLESS_FAILED(err, hs_atoms_permute(atoms, cells->sort.order, err));
    HS_TRY(hs_parallel_agree(&sim->parallel, err));
    hs_timer_add(&sim->timer, HS_PHASE_NEIGH);
    hs_halo_follow(&sim->halo, atoms, places(cells, atoms->n_local));
    hs_timer_add_comm(&sim->timer, HS_COMM_EXCHANGE);
    return cluster(sim, err);
}

void hs_sim_forward_listed(hs_sim *sim)
{
    hs_box listed = sim->box;
    memcpy(listed.lo, sim->neighbor.lo_listed, sizeof listed.lo);
    memcpy(listed.hi, sim->neighbor.hi_listed, sizeof listed.hi);
    memcpy(listed.tilt, sim->neighbor.tilt_listed, sizeof listed.tilt);
    hs_halo_fit_box(&sim->halo, &listed);
    hs_halo_forward_positions(&sim->halo, &sim->atoms, sim->neighbor.x_listed);
    hs_halo_fit_box(&sim->halo, &sim->box);
}

static hs_status before_exchange(hs_sim *sim, hs_error *err)
{
    for (int k = 0; k < sim->n_fixes; ++k)
        if (sim->fix[k]->style->pre_exchange != NULL) {
            HS_TRY(hs_parallel_agree(&sim->parallel, err));
            HS_TRY(sim->fix[k]->style->pre_exchange(sim->fix[k], err));
        }
    return HS_OK;
}

hs_status hs_sim_exchange(hs_sim *sim, hs_error *err)
{
    hs_timer_mark(&sim->timer);
    if (sim->is_initialized) HS_TRY(before_exchange(sim, err));
    const bool is_wrapped = wrap(sim);
    const bool is_periodic = sim->box.periodic[0] && sim->box.periodic[1] && sim->box.periodic[2];
    (void)find_lost(sim, is_wrapped, err);
    if (!is_periodic) {
        HS_TRY(hs_parallel_agree(&sim->parallel, err));
        hs_sim_shrink_box(sim);
    }
    hs_sim_settle_positions(sim);
    HS_TRY(hs_migrate(&sim->atoms, &sim->domain, &sim->parallel, &sim->box, err));
    hs_neighbor_list_now(&sim->neighbor, &sim->atoms);
    sim->listed_step = sim->env.step;
    memcpy(sim->neighbor.lo_listed, sim->box.lo, sizeof sim->box.lo);
    memcpy(sim->neighbor.hi_listed, sim->box.hi, sizeof sim->box.hi);
    memcpy(sim->neighbor.tilt_listed, sim->box.tilt, sizeof sim->box.tilt);
    hs_timer_add_comm(&sim->timer, HS_COMM_EXCHANGE);
    if (sim->pair->cutoff_max <= 0.0) return HS_OK;

    HS_TRY(hs_sim_method(sim)->renew(sim, err));
    hs_timer_add(&sim->timer, HS_PHASE_NEIGH);
    return HS_OK;
}
