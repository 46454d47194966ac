#include "neighbor/neighbor.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "base/text.h"

const char *const hs_neighbor_methods[] = {"nsq",    "linked",  "incremental", "hash", "cell",
                                           "verlet", "cluster", "auto",        NULL};

hs_status hs_neighbor_init(hs_neighbor *neighbor, hs_atoms *atoms, double skin, hs_error *err)
{
    static const char *const names[3] = {"x listed", "y listed", "z listed"};
    memset(neighbor, 0, sizeof *neighbor);
    neighbor->settings =
        (hs_neighbor_settings){.skin = skin, .every = 1, .delay = 10, .check = true, .method = HS_METHOD_AUTO};
    for (int axis = 0; axis < 3; ++axis) {
        HS_TRY(hs_atoms_add_field(atoms, names[axis], (void **)&neighbor->x_listed[axis], sizeof(double), true, err));
        hs_atoms_keep_from_halo(atoms, (void **)&neighbor->x_listed[axis]); /* needed there on late steps only */
    }
    hs_neighbor_start(neighbor);
    return HS_OK;
}

void hs_neighbor_fini(hs_neighbor *neighbor)
{
    HS_FREE(neighbor->settings.exclusion);
    hs_cells_fini(&neighbor->cells);
    hs_clusters_fini(&neighbor->clusters);
    hs_chains_fini(&neighbor->chains);
    hs_chains_fini(&neighbor->coarse);
}

hs_status hs_neighbor_set_method(hs_neighbor *neighbor, const char *name, hs_error *err)
{
    for (int method = 0; method < HS_N_METHODS; ++method)
        if (strcmp(hs_neighbor_methods[method], name) == 0) {
            neighbor->settings.method = (hs_neighbor_method)method;
            return HS_OK;
        }
    const char *nearest = hs_text_nearest(name, hs_neighbor_methods, HS_N_METHODS);
    return hs_fail(err, HS_ERROR_INPUT, "there is no neighbor method '%s'; %s '%s'%s", name,
                   nearest != NULL ? "did you mean" : "one that there is:", nearest != NULL ? nearest : "cell",
                   nearest != NULL ? "?" : "");
}

void hs_neighbor_start(hs_neighbor *neighbor)
{
    neighbor->counters = (hs_neighbor_counters){.first_late_step = -1};
    neighbor->ago = 0;
    neighbor->is_late = false;
    neighbor->last_sort_step = -1;
}

void hs_neighbor_continue(hs_neighbor *neighbor)
{
    neighbor->counters.n_late_steps = 0;
    neighbor->counters.first_late_step = -1;
}

enum {
    WHOLE_LINES = 64
}; /* atoms: shares begin where vectors do not cross lines of the cache (they took twice as long) */

/** A thread's share of the local atoms; all->... become the largest displacement and all bits of z. */
static void settle_share(const hs_settle_input *in, int n_local, hs_settle settle, hs_settle_result *all)
{
    int64_t begin, end;
    hs_settle_result own = {0, 0};
    hs_thread_range(n_local, WHOLE_LINES, hs_thread_number(), hs_thread_count(), &begin, &end);
    settle(in, (int)begin, (int)end, &own);
#pragma omp critical(hs_neighbor_settle)
    {
        if (own.displacement2 > all->displacement2) all->displacement2 = own.displacement2;
        all->z |= own.z;
    }
}

hs_displacements hs_neighbor_settle(const hs_neighbor *neighbor, hs_atoms *atoms, double magic, bool is_2d,
                                    bool is_planar, hs_settle settle)
{
    hs_settle_input in = {.magic = magic, .is_flat = is_2d && neighbor->was_flat, .is_planar = is_planar};
    for (int axis = 0; axis < 3; ++axis) {
        in.x[axis] = atoms->x[axis];
        in.listed[axis] = neighbor->x_listed[axis];
    }
    hs_settle_result all = {0, 0};
    HS_ON_THREADS(settle_share(&in, atoms->n_local, settle, &all));
    double largest2;
    memcpy(&largest2, &all.displacement2, sizeof largest2);
    return (hs_displacements){.largest2 = largest2 < INFINITY ? largest2 : INFINITY,
                              .has_z = !in.is_flat || all.z != 0};
}

/** Positions whose squares are no numbers: none of a simulation that makes sense is so far away. */
static const double farthest = 1e150;

static hs_status report_bad_position(const hs_atoms *atoms, int64_t step, hs_error *err)
{
    int i = 0;
    while (i < atoms->n_local - 1 && fabs(atoms->x[0][i]) < farthest && fabs(atoms->x[1][i]) < farthest &&
           fabs(atoms->x[2][i]) < farthest)
        ++i;
    return hs_fail(err, HS_ERROR_ATOMS,
                   "at step %lld atom %lld has the position (%g %g %g) and the velocity (%g %g %g): the forces on it "
                   "were too large. Usually atoms overlap at the start or the timestep is too long: check "
                   "pair_coeff, the density, and 'timestep'",
                   (long long)step, (long long)atoms->id[i], atoms->x[0][i], atoms->x[1][i], atoms->x[2][i],
                   atoms->v[0][i], atoms->v[1][i], atoms->v[2][i]);
}

/** How far two corners of a tilted box have moved since lists were made: the sum of the largest displacements of two of them. */
static double corners_moved(const hs_neighbor *neighbor, const hs_box *box)
{
    hs_box listed = *box;
    double largest = 0.0, second = 0.0;
    memcpy(listed.lo, neighbor->lo_listed, sizeof listed.lo);
    memcpy(listed.hi, neighbor->hi_listed, sizeof listed.hi);
    memcpy(listed.tilt, neighbor->tilt_listed, sizeof listed.tilt);
    for (int corner = 0; corner < 8; ++corner) {
        const int32_t at[3] = {corner & 1, corner >> 1 & 1, corner >> 2};
        double now[3], then[3], d2 = 0.0;
        hs_box_shift(box, at, now);
        hs_box_shift(&listed, at, then);
        for (int axis = 0; axis < 3; ++axis) {
            const double d = box->lo[axis] + now[axis] - (listed.lo[axis] + then[axis]);
            d2 += d * d;
        }
        if (d2 > largest) {
            second = largest;
            largest = d2;
        } else {
            second = fmax(second, d2);
        }
    }
    return sqrt(largest) + sqrt(second);
}

/** How far atoms may move before two of them can have come nearer by the skin: half of it, less when the box has changed, for
 *  periodic images move with its corners. */
static double room_to_move(const hs_neighbor *neighbor, const hs_box *box)
{
    if (box->is_tilted) return fmax(0.0, 0.5 * (neighbor->settings.skin - corners_moved(neighbor, box)));
    double lo2 = 0.0, hi2 = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        const double dlo = box->lo[axis] - neighbor->lo_listed[axis], dhi = box->hi[axis] - neighbor->hi_listed[axis];
        lo2 += dlo * dlo;
        hi2 += dhi * dhi;
    }
    return fmax(0.0, 0.5 * (neighbor->settings.skin - (sqrt(lo2) + sqrt(hi2))));
}

hs_status hs_neighbor_is_due(hs_neighbor *neighbor, const hs_atoms *atoms, const hs_box *box,
                             const hs_displacements *moved, const hs_parallel *parallel, int64_t step, bool *is_due,
                             bool *stop, hs_error *err)
{
    const hs_neighbor_settings *settings = &neighbor->settings;
    if (moved->largest2 == INFINITY) (void)report_bad_position(atoms, step, err);
    double most[4] = {moved->largest2, err->status != HS_OK, *stop, moved->has_z};
    hs_parallel_max_double(parallel, most, 4);
    if (most[1] > 0.0) HS_TRY(hs_parallel_agree(parallel, err));
    *stop = most[2] > 0.0;
    neighbor->is_flat = most[3] == 0.0;

    const double room = room_to_move(neighbor, box);
    const bool has_moved = most[0] > room * room;
    ++neighbor->ago;
    if (settings->exact) {
        *is_due = has_moved;
        neighbor->is_late = false;
        return HS_OK;
    }
    *is_due = neighbor->ago >= settings->delay && neighbor->ago % settings->every == 0 && !settings->once &&
              (!settings->check || has_moved);
    if (*is_due && settings->check) {
        const int64_t earliest = settings->every > settings->delay ? settings->every : settings->delay;
        neighbor->counters.n_dangerous += neighbor->ago == earliest;
    }
    neighbor->is_late = has_moved && !*is_due;
    if (neighbor->is_late) {
        ++neighbor->counters.n_late_steps;
        if (neighbor->counters.first_late_step < 0) neighbor->counters.first_late_step = step;
    }
    return HS_OK;
}

/** Copy a thread's share of the positions; *has_z becomes true where a z is not 0. */
static void list_share(hs_neighbor *neighbor, const hs_atoms *atoms, bool *has_z)
{
    int64_t begin, end;
    bool has_own = false;
    hs_thread_range(atoms->n_local, WHOLE_LINES, hs_thread_number(), hs_thread_count(), &begin, &end);
    for (int axis = 0; axis < 3; ++axis)
        memcpy(neighbor->x_listed[axis] + begin, atoms->x[axis] + begin, (size_t)(end - begin) * sizeof(double));
    for (int64_t i = begin; i < end && !has_own; ++i) has_own = atoms->x[2][i] != 0.0;
    if (!has_own) return;
#pragma omp atomic write
    *has_z = true;
}

void hs_neighbor_list_now(hs_neighbor *neighbor, const hs_atoms *atoms)
{
    bool has_z = false;
    HS_ON_THREADS(list_share(neighbor, atoms, &has_z));
    neighbor->was_flat = !has_z;
    neighbor->is_flat = false; /* until the ranks agree on it, at the next step */
    neighbor->ago = 0;
    neighbor->is_late = false;
}
