#include "io/read_dump.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "comm/migrate.h"
#include "io/id_map.h"

/** A snapshot that is being read. */
typedef struct reading {
    hs_env *env;
    hs_frames *frames;
    const hs_snapshot *snapshot;
    const hs_read_options *options;
    hs_read_counts *counts;
    hs_id_map local;        /**< ids of the atoms this rank had, and their indices */
    hs_id_map watched;      /**< ids of the snapshot's rows that this rank watches for being given twice */
    unsigned char *is_kept; /**< owned [n_before]: the snapshot has the atom */
    int n_before;
    int64_t max_id;    /**< of all ranks, with those that were added */
    int64_t *is_known; /**< owned [block]: some rank has the row's atom; with add */
    int n_known;
} reading;

static void finish(reading *self)
{
    hs_id_map_fini(&self->local);
    hs_id_map_fini(&self->watched);
    HS_FREE(self->is_kept);
    HS_FREE(self->is_known);
}

/* ---- Before the rows ---- */

static void set_box(const reading *self)
{
    const hs_snapshot *snapshot = self->snapshot;
    hs_box *box = self->env->box;
    for (int axis = 0; axis < 3; ++axis) {
        for (int side = 0; side < 2; ++side)
            if (snapshot->boundary[axis][side] != 0 &&
                snapshot->boundary[axis][side] != (char)box->boundary[axis][side]) {
                hs_warn(self->env->out,
                        "the boundaries of the snapshot (%c%c in %c) are not those of the simulation (%c%c)",
                        snapshot->boundary[axis][0], snapshot->boundary[axis][1], "xyz"[axis], box -> boundary[axis][0],
                        box -> boundary[axis][1]);
                break;
            }
        if (!self->options->box) continue;
        box->lo[axis] = snapshot->lo[axis];
        box->hi[axis] = snapshot->hi[axis];
    }
    if (self->options->box) hs_box_settle_faces(box);
}

/** As in LAMMPS a tilted box is for snapshots of tilted boxes and an orthogonal one for the others. */
static hs_status take_tilts(const reading *self, hs_error *err)
{
    const hs_snapshot *snapshot = self->snapshot;
    hs_box *box = self->env->box;
    if (!self->options->box) return HS_OK;
    const bool has_tilts = snapshot->tilt[0] != 0.0 || snapshot->tilt[1] != 0.0 || snapshot->tilt[2] != 0.0;
    if (!box->is_tilted && has_tilts)
        return hs_fail(err, HS_ERROR_INPUT,
                       "the snapshot has a tilted box, the simulation an orthogonal one: 'change_box all triclinic' "
                       "makes it one that can be tilted, 'box no' keeps it");
    memcpy(box->tilt, snapshot->tilt, sizeof box->tilt);
    return hs_box_check_tilt(box, "read_dump", err);
}

static hs_status remove_atoms(reading *self, bool all, int64_t *n_removed, hs_error *err)
{
    hs_atoms *atoms = self->env->atoms;
    unsigned char *drop;
    HS_TRY(HS_ALLOC(drop, (size_t)atoms->n_local, err));
    const int n = all ? atoms->n_local : self->n_before;
    for (int i = 0; i < n; ++i) {
        drop[i] = all || !self->is_kept[i];
        *n_removed += drop[i];
    }
    hs_atoms_remove(atoms, drop);
    HS_FREE(drop);
    return HS_OK;
}

static hs_status begin(reading *self, hs_error *err)
{
    const hs_atoms *atoms = self->env->atoms;
    if (self->options->purge) HS_TRY(remove_atoms(self, true, &self->counts->purged, err));
    self->n_before = atoms->n_local;
    self->max_id = hs_atoms_max_id(atoms);
    HS_TRY(HS_ALLOC(self->is_kept, (size_t)self->n_before, err));
    for (int i = 0; i < self->n_before; ++i) HS_TRY(hs_id_map_add(&self->local, atoms->id[i], i, err));
    return HS_OK;
}

/* ---- Rows ---- */

/** Coordinates that the row gives, into x. */
static void read_place(const hs_snapshot *snapshot, const hs_frame_rows *rows, int k, double x[3])
{
    hs_box box = {.is_tilted = snapshot->is_tilted};
    double fraction[3], place[3];
    memcpy(box.lo, snapshot->lo, sizeof box.lo);
    memcpy(box.hi, snapshot->hi, sizeof box.hi);
    memcpy(box.tilt, snapshot->tilt, sizeof box.tilt);
    if (snapshot->is_scaled && snapshot->is_tilted) hs_box_fractions(&box, x, fraction); /* those that are not given */
    for (int axis = 0; axis < 3; ++axis) {
        const double *value = rows->value[HS_FIELD_X + axis];
        if (value == NULL) continue;
        fraction[axis] = value[k];
        x[axis] = snapshot->is_scaled ? box.lo[axis] + value[k] * hs_box_length(&box, axis) : value[k];
    }
    if (!snapshot->is_scaled || !snapshot->is_tilted) return;
    hs_box_place(&box, fraction, place);
    memcpy(x, place, sizeof place);
}

/** Place and image flags as they will be, from the row and what the atom had. */
static hs_status place_atom(const reading *self, const hs_frame_rows *rows, int k, double x[3], int32_t image[3],
                            hs_error *err)
{
    const double farthest = 1e9; /* box lengths: image flags are of 32 bits */
    const hs_snapshot *snapshot = self->snapshot;
    const hs_box *box = self->env->box;
    read_place(snapshot, rows, k, x);
    for (int axis = 0; axis < 3; ++axis) {
        const double *value = rows->value[HS_FIELD_X + axis], *flag = rows->value[HS_FIELD_IX + axis];
        if (flag != NULL)
            image[axis] = (int32_t)flag[k];
        else if (value != NULL && !snapshot->is_wrapped)
            image[axis] = 0;
        const double lo = box->lo[axis], length = box->hi[axis] - lo,
                     away = (hs_box_upright(box, x, axis) - lo) / length;
        const bool is_below = x[axis] < lo && box->boundary[axis][0] == HS_BOUNDARY_FIXED,
                   is_above = x[axis] > box->hi[axis] && box->boundary[axis][1] == HS_BOUNDARY_FIXED;
        if (!(fabs(away) < farthest))
            return hs_fail(err, HS_ERROR_INPUT, "atom %lld has %c = %.10g, more than %g box lengths from the box",
                           (long long)rows->id[k], "xyz"[axis], x[axis], farthest);
        if (is_below || is_above)
            return hs_fail(err, HS_ERROR_INPUT,
                           "atom %lld has %c = %.10g, outside of the box, %.10g to %.10g, which is not periodic there",
                           (long long)rows->id[k], "xyz"[axis], x[axis], lo, box -> hi[axis]);
    }
    hs_box_wrap(box, x, image);
    return HS_OK;
}

static hs_status set_atom(const reading *self, const hs_frame_rows *rows, int k, int i, hs_error *err)
{
    hs_atoms *atoms = self->env->atoms;
    double x[3];
    int32_t image[3];
    for (int axis = 0; axis < 3; ++axis) {
        x[axis] = atoms->x[axis][i];
        image[axis] = atoms->image[axis][i];
    }
    HS_TRY(place_atom(self, rows, k, x, image, err));
    for (int axis = 0; axis < 3; ++axis) {
        const double *velocity = rows->value[HS_FIELD_VX + axis];
        atoms->x[axis][i] = x[axis];
        atoms->image[axis][i] = image[axis];
        if (velocity != NULL) atoms->v[axis][i] = velocity[k];
    }
    return HS_OK;
}

/** A row that no rank has an atom for: the rank that owns its place adds one. */
static hs_status add_atom(reading *self, const hs_frame_rows *rows, int k, hs_error *err)
{
    hs_atoms *atoms = self->env->atoms;
    double x[3] = {0.0, 0.0, 0.0};
    int32_t image[3] = {0, 0, 0};
    const double type = rows->value[HS_FIELD_TYPE][k];
    const bool keeps_id = self->options->add == HS_ADD_KEEP;
    if (!keeps_id && self->max_id == INT64_MAX)
        return hs_fail(err, HS_ERROR_INPUT, "there is no id left for a new atom");
    const int64_t id = keeps_id ? rows->id[k] : ++self->max_id;
    if (!(type <= atoms->n_types))
        return hs_fail(err, HS_ERROR_INPUT, "atom %lld has type %.0f; there are %d types", (long long)rows->id[k], type,
                       atoms->n_types);
    HS_TRY(place_atom(self, rows, k, x, image, err));
    if (!hs_domain_owns(self->env->domain, self->env->box, x)) return HS_OK;
    const int i = atoms->n_local;
    HS_TRY(hs_atoms_add(atoms, id, (int)type, x, err));
    ++self->counts->added;
    return set_atom(self, rows, k, i, err);
}

/** Each id may come once. One rank watches over it. */
static hs_status watch(reading *self, int64_t id, hs_error *err)
{
    const hs_parallel *parallel = self->env->parallel;
    if (parallel->n_ranks > 1 && id % parallel->n_ranks != parallel->rank) return HS_OK;
    ++self->counts->in_snapshot;
    if (hs_id_map_find(&self->watched, id) != NULL)
        return hs_fail(err, HS_ERROR_INPUT, "the snapshot has atom %lld twice", (long long)id);
    return hs_id_map_add(&self->watched, id, 0, err);
}

static hs_status replace_atoms(reading *self, const hs_frame_rows *rows, int *k, hs_error *err)
{
    for (*k = 0; *k < rows->n; ++*k) {
        HS_TRY(watch(self, rows->id[*k], err));
        const int32_t *index = hs_id_map_find(&self->local, rows->id[*k]);
        if (self->is_known != NULL) self->is_known[*k] = index != NULL;
        if (index == NULL) continue;
        self->is_kept[*index] = 1;
        if (!self->options->replace) continue;
        HS_TRY(set_atom(self, rows, *k, *index, err));
        ++self->counts->replaced;
    }
    return HS_OK;
}

static hs_status add_atoms(reading *self, const hs_frame_rows *rows, int *k, hs_error *err)
{
    for (*k = 0; *k < rows->n; ++*k)
        if (self->is_known[*k] == 0) HS_TRY(add_atom(self, rows, *k, err));
    return HS_OK;
}

/** An error of this rank's at row k of the block, for all ranks. */
static hs_status agree(const reading *self, int k, hs_error *err)
{
    if (err->status != HS_OK) hs_frames_locate(self->frames, k, err);
    return hs_parallel_agree(self->env->parallel, err);
}

static hs_status take_rows(reading *self, const hs_frame_rows *rows, hs_error *err)
{
    int k = 0;
    const bool adds = self->options->add != HS_ADD_NO;
    if (adds && rows->n > self->n_known) {
        if (HS_GROW(self->is_known, 0, (size_t)rows->n, err) == HS_OK) self->n_known = rows->n;
        HS_TRY(hs_parallel_agree(self->env->parallel, err));
    }
    (void)!replace_atoms(self, rows, &k, err);
    HS_TRY(agree(self, k, err));
    if (!adds) return HS_OK;
    hs_parallel_sum_int64(self->env->parallel, self->is_known, rows->n);
    (void)!add_atoms(self, rows, &k, err);
    return agree(self, k, err);
}

/** Atoms that the snapshot left as they were may be outside of its box. */
static void wrap_all(const hs_env *env)
{
    hs_atoms *atoms = env->atoms;
    for (int i = 0; i < atoms->n_local; ++i) {
        double x[3];
        int32_t image[3];
        for (int axis = 0; axis < 3; ++axis) {
            x[axis] = atoms->x[axis][i];
            image[axis] = atoms->image[axis][i];
        }
        hs_box_wrap(env->box, x, image);
        for (int axis = 0; axis < 3; ++axis) {
            atoms->x[axis][i] = x[axis];
            atoms->image[axis][i] = image[axis];
        }
    }
}

static hs_status read_all(reading *self, hs_error *err)
{
    const hs_parallel *parallel = self->env->parallel;
    hs_frame_rows rows;
    (void)!begin(self, err);
    HS_TRY(hs_parallel_agree(parallel, err));
    hs_parallel_max_int64(parallel, &self->max_id, 1);
    do {
        HS_TRY(hs_frames_read(self->frames, &rows, err));
        HS_TRY(take_rows(self, &rows, err));
    } while (rows.n > 0);
    if (self->options->trim) (void)!remove_atoms(self, false, &self->counts->trimmed, err);
    ++self->env->atoms->generation;
    wrap_all(self->env);
    return hs_migrate(self->env->atoms, self->env->domain, parallel, self->env->box, err);
}

hs_status hs_read_snapshot(hs_env *env, hs_frames *frames, const hs_snapshot *snapshot, const hs_read_options *options,
                           hs_read_counts *counts, hs_error *err)
{
    reading self = {.env = env, .frames = frames, .snapshot = snapshot, .options = options, .counts = counts};
    *counts = (hs_read_counts){.before = env->atoms->n_local};
    if (options->box && !snapshot->has_box)
        return hs_fail(err, HS_ERROR_INPUT,
                       "the file does not tell the box of step %lld; 'box no' keeps the present one",
                       (long long)snapshot->step);
    if (snapshot->units[0] != '\0' && strcmp(snapshot->units, env->units->name) != 0)
        hs_warn(env->out, "the snapshot is in units %s, the simulation in %s", snapshot->units, env->units->name);
    set_box(&self);
    HS_TRY(take_tilts(&self, err));
    const hs_status status = read_all(&self, err);
    finish(&self);
    HS_TRY(status);
    counts->after = env->atoms->n_local;
    int64_t numbers[] = {counts->before,  counts->in_snapshot, counts->purged, counts->replaced,
                         counts->trimmed, counts->added,       counts->after};
    hs_parallel_sum_int64(env->parallel, numbers, sizeof numbers / sizeof numbers[0]);
    *counts = (hs_read_counts){numbers[0], numbers[1], numbers[2], numbers[3], numbers[4], numbers[5], numbers[6]};
    return HS_OK;
}
