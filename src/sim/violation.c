/* Atoms that overlap, are lost, or are nowhere: which ones, and a picture of the system just before and then.
 *
 * Why a picture and not a checkpoint: the state at the violation would only fail again, and a copy of the state before
 * it, kept in memory for this case alone, would cost a tenth of the memory. The positions of the last list build are
 * there anyway. */
#include "sim/violation.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "io/dump_table.h"
#include "sim/saving.h"

typedef struct place {
    double x;
    int32_t i;
} place;

typedef struct nearest {
    double r2;    /**< INFINITY: no pair within the largest cutoff */
    int32_t i, j; /**< local and halo atoms */
} nearest;

static int by_x(const void *a, const void *b)
{
    const double x = ((const place *)a)->x, y = ((const place *)b)->x;
    return (x > y) - (x < y);
}

/** The two atoms, at least one of them local, that are nearest to each other. */
static hs_status find_nearest(const hs_sim *sim, nearest *pair, hs_error *err)
{
    const hs_atoms *atoms = &sim->atoms;
    const int n = atoms->n_local + atoms->n_halo;
    double most2 = sim->pair->cutoff_max * sim->pair->cutoff_max;
    place *places;
    *pair = (nearest){.r2 = INFINITY};
    HS_TRY(HS_ALLOC(places, (size_t)n, err));
    for (int i = 0; i < n; ++i) places[i] = (place){atoms->x[0][i], i};
    qsort(places, (size_t)n, sizeof *places, by_x);
    for (int k = 0; k < n; ++k) {
        for (int l = k + 1; l < n; ++l) {
            const int32_t i = places[k].i, j = places[l].i;
            const double dx = places[l].x - places[k].x, dy = atoms->x[1][j] - atoms->x[1][i],
                         dz = atoms->x[2][j] - atoms->x[2][i], r2 = dx * dx + dy * dy + dz * dz;
            if (dx * dx >= most2) break;
            if (r2 >= most2 || (i >= atoms->n_local && j >= atoms->n_local)) continue;
            most2 = r2;
            *pair = (nearest){r2, i, j};
        }
    }
    HS_FREE(places);
    return HS_OK;
}

/** Whether part of the potential comes from a file, and may not go down to the distance 0. */
static bool has_table(const hs_pair *pair)
{
    for (int k = 0; k < pair->n_parts; ++k)
        if (pair->part[k]->style->shared != NULL) return true;
    return false;
}

hs_status hs_sim_report_overlap(hs_sim *sim, hs_error *err)
{
    const hs_atoms *atoms = &sim->atoms;
    nearest pair;
    if (find_nearest(sim, &pair, err) != HS_OK) pair.r2 = INFINITY;
    double least2 = pair.r2;
    hs_parallel_min_double(&sim->parallel, &least2, 1);
    if (least2 == INFINITY)
        (void)hs_fail(err, HS_ERROR_ATOMS, "at step %lld the force between two atoms is infinite",
                      (long long)sim->env.step);
    else if (pair.r2 == least2)
        (void)hs_fail(
            err, HS_ERROR_ATOMS,
            "at step %lld the force between two atoms is infinite: %lld at (%g %g %g) and %lld at (%g %g %g) are %g "
            "apart. %s",
            (long long)sim->env.step, (long long)atoms->id[pair.i], atoms->x[0][pair.i], atoms->x[1][pair.i],
            atoms->x[2][pair.i], (long long)atoms->id[pair.j], atoms->x[0][pair.j], atoms->x[1][pair.j],
            atoms->x[2][pair.j], sqrt(pair.r2),
            has_table(sim->pair) ? "A table of the potential begins at a larger distance, or atoms overlap at the start"
                                 : "Usually atoms were created twice or overlap at the start: check create_atoms and "
                                   "read_data");
    return hs_parallel_agree(&sim->parallel, err);
}

/** Exchange the present positions, box and step for those of the last list build, or back. */
static void swap_with_listed(hs_sim *sim)
{
    hs_neighbor *neighbor = &sim->neighbor;
    for (int axis = 0; axis < 3; ++axis) {
        double *const x = sim->atoms.x[axis];
        const double lo = sim->box.lo[axis], hi = sim->box.hi[axis];
        sim->atoms.x[axis] = neighbor->x_listed[axis];
        neighbor->x_listed[axis] = x;
        sim->box.lo[axis] = neighbor->lo_listed[axis];
        sim->box.hi[axis] = neighbor->hi_listed[axis];
        neighbor->lo_listed[axis] = lo;
        neighbor->hi_listed[axis] = hi;
        const double tilt = sim->box.tilt[axis];
        sim->box.tilt[axis] = neighbor->tilt_listed[axis];
        neighbor->tilt_listed[axis] = tilt;
    }
    const int64_t step = sim->env.step;
    sim->env.step = sim->listed_step;
    sim->listed_step = step;
    hs_env_changed(&sim->env);
}

/** Whether all atoms are at places that a picture can show: no farther from the box than a thousand times its size
 *  (collective). */
static bool is_worth_showing(const hs_sim *sim)
{
    double n_bad = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        const double farthest = 1e3 * hs_box_length(&sim->box, axis);
        for (int i = 0; i < sim->atoms.n_local; ++i)
            n_bad += !(fabs(sim->atoms.x[axis][i] - sim->box.lo[axis]) < farthest);
    }
    hs_parallel_max_double(&sim->parallel, &n_bad, 1);
    return n_bad == 0.0;
}

static hs_status write_frames(hs_sim *sim, hs_dump *dump, hs_error *err)
{
    static const char *const words[] = {"format", "float", "%.10g"};
    const hs_args digits = {.command = "dump_modify", .n = 3, .word = words};
    HS_TRY(hs_dump_modify(dump, &digits, err));
    if (dump->style->init != NULL) HS_TRY(dump->style->init(dump, err));
    const bool is_later = sim->env.step > sim->listed_step && is_worth_showing(sim);
    swap_with_listed(sim);
    const hs_status status = dump->style->write(dump, err);
    swap_with_listed(sim);
    HS_TRY(status);
    return is_later ? dump->style->write(dump, err) : HS_OK;
}

void hs_sim_show_violation(hs_sim *sim, hs_error *err)
{
    static const char id[] = "_violation_";
    static const char *const words[] = {"id", "type", "x", "y", "z", "ix", "iy", "iz"};
    const hs_args columns = {.command = "dump", .n = sizeof words / sizeof words[0], .word = words};
    hs_error ignored = {0}; /* what matters is told already */
    char path[64];
    if (!sim->saving->on_stop) return;
    snprintf(path, sizeof path, "failed.%lld.dump", (long long)sim->env.step);
    hs_status status = hs_sim_add_dump(sim, id, "all", "custom", 1, path, &columns, &ignored);
    if (status != HS_OK) return;
    status = write_frames(sim, hs_sim_find_dump(sim, id), &ignored);
    if (hs_sim_remove_dump(sim, id, &ignored) != HS_OK || status != HS_OK) return;
    const size_t n = strlen(err->text);
    snprintf(err->text + n, sizeof err->text - n, ". The atoms of step %lld%s are in '%s'", (long long)sim->listed_step,
             sim->listed_step < sim->env.step ? ", before it happened," : "", path);
}
