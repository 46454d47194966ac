/* Snapshots in texts: LAMMPS's dump styles atom and custom, and XYZ. */
#include <stdio.h>
#include <string.h>

#include "io/frames_internal.h"

/** Errors from here on name the present line. */
static hs_status located(hs_frames *frames, hs_status status, hs_error *err)
{
    if (status != HS_OK) hs_error_locate(err, frames->lines.path, frames->lines.number);
    return status;
}

static hs_status open_text(hs_frames *frames, const char *path, hs_error *err)
{
    HS_TRY(hs_lines_open(&frames->lines, path, &frames->parallel, err));
    return HS_OK;
}

static void close_text(hs_frames *frames) { hs_lines_close(&frames->lines); }

/** The next line of a snapshot that has begun. */
static hs_status next_line(hs_frames *frames, hs_error *err)
{
    HS_TRY(hs_lines_next(&frames->lines, err));
    if (!frames->lines.at_end) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT,
                   "the file ends within a snapshot: the program that wrote it was stopped, or the file is cut. "
                   "Snapshots before this one are whole");
}

/** The whole number that is the next line. */
static hs_status read_count(hs_frames *frames, const char *what, int64_t *value, hs_error *err)
{
    HS_TRY(next_line(frames, err));
    const hs_lines *lines = &frames->lines;
    if (lines->n_words != 1 || !hs_text_to_int64(lines->word[0], value) || *value < 0)
        return hs_fail(err, HS_ERROR_INPUT, "the %s should stand here, a whole number of 0 or more", what);
    return HS_OK;
}

static hs_status skip_rows(hs_frames *frames, hs_error *err)
{
    hs_status status = HS_OK;
    for (; frames->n_seen < frames->n_rows && status == HS_OK; ++frames->n_seen) status = next_line(frames, err);
    return located(frames, status, err);
}

/** Up to a block of rows, each one line of n_columns words at least. */
static hs_status read_rows(hs_frames *frames, int *n, hs_error *err)
{
    const hs_lines *lines = &frames->lines;
    hs_status status = HS_OK;
    for (*n = 0; *n < HS_FRAME_BLOCK && frames->n_seen < frames->n_rows && status == HS_OK; ++*n, ++frames->n_seen) {
        status = next_line(frames, err);
        if (status == HS_OK && lines->n_words < frames->n_columns)
            status = hs_fail(err, HS_ERROR_INPUT, "an atom has %d values; this line has %d", frames->n_columns,
                             lines->n_words);
        frames->line[*n] = lines->number;
        frames->id[*n] = frames->n_seen + 1; /* where there are no ids */
        for (int field = 0; field < HS_N_FIELDS && status == HS_OK; ++field)
            if (frames->column[field] >= 0)
                status = hs_frames_number(frames, field, lines->word[frames->column[field]], *n, err);
    }
    return located(frames, status, err);
}

/* ---- LAMMPS ---- */

/** The present line: the bounds of an axis, and the tilt that stands behind them in a tilted box. */
static hs_status read_axis(const hs_lines *lines, int axis, hs_snapshot *snapshot, hs_error *err)
{
    double *lo = &snapshot->lo[axis], *hi = &snapshot->hi[axis];
    const int n_words = snapshot->is_tilted ? 3 : 2;
    if (lines->n_words != n_words || !hs_text_to_double(lines->word[0], lo) || !hs_text_to_double(lines->word[1], hi) ||
        (snapshot->is_tilted && !hs_text_to_double(lines->word[2], &snapshot->tilt[axis])))
        return hs_fail(err, HS_ERROR_INPUT, "the bounds of the box in %c%s should stand here, %s finite numbers",
                       "xyz"[axis], snapshot -> is_tilted ? " and a tilt" : "", snapshot->is_tilted ? "three" : "two");
    if (!(*lo < *hi)) return hs_fail(err, HS_ERROR_INPUT, "the box is empty in %c", "xyz"[axis]);
    return HS_OK;
}

/** A tilted box is given by what encloses it (hs_box_bounds). */
static hs_status undo_bounds(hs_snapshot *snapshot, hs_error *err)
{
    hs_box box = {.is_tilted = true};
    double lo[3], hi[3];
    memcpy(box.tilt, snapshot->tilt, sizeof box.tilt);
    hs_box_bounds(&box, lo, hi); /* of a box without size at the origin: how far the tilts reach */
    for (int axis = 0; axis < 3; ++axis) {
        snapshot->lo[axis] -= lo[axis];
        snapshot->hi[axis] -= hi[axis];
        if (!(snapshot->lo[axis] < snapshot->hi[axis]))
            return hs_fail(err, HS_ERROR_INPUT, "the bounds of the tilted box leave it no length in %c", "xyz"[axis]);
    }
    return HS_OK;
}

static hs_status read_bounds(hs_frames *frames, hs_snapshot *snapshot, hs_error *err)
{
    const hs_lines *lines = &frames->lines;
    const int n_words = lines->n_words;
    snapshot->is_tilted = n_words > 5 && strcmp(lines->word[3], "xy") == 0 && strcmp(lines->word[4], "xz") == 0 &&
                          strcmp(lines->word[5], "yz") == 0;
    const int first = snapshot->is_tilted ? 6 : 3;
    for (int axis = 0; axis < 3 && n_words == first + 3; ++axis) {
        const char *word = lines->word[first + axis];
        if (strlen(word) != 2 || strspn(word, "pfsm") != 2)
            return hs_fail(err, HS_ERROR_INPUT, "'%s' is no boundary (two of the letters p, f, s, m)", word);
        memcpy(snapshot->boundary[axis], word, 2);
    }
    if (n_words != first && n_words != first + 3)
        return hs_fail(
            err, HS_ERROR_INPUT,
            "'ITEM: BOX BOUNDS' is followed by three boundaries, or nothing ('xy xz yz' before them in a tilted "
            "box)");
    for (int axis = 0; axis < 3; ++axis) {
        HS_TRY(next_line(frames, err));
        HS_TRY(read_axis(lines, axis, snapshot, err));
    }
    if (snapshot->is_tilted) HS_TRY(undo_bounds(snapshot, err));
    snapshot->has_box = true;
    return HS_OK;
}

static int find_column(const hs_lines *lines, const char *name)
{
    for (int i = 2; i < lines->n_words; ++i)
        if (strcmp(lines->word[i], name) == 0) return i - 2;
    return -1;
}

static hs_status refuse_field(const hs_lines *lines, int field, const char *name, hs_error *err)
{
    char columns[600] = "";
    for (int i = 2; i < lines->n_words && strlen(columns) < 500; ++i)
        snprintf(columns + strlen(columns), sizeof columns - strlen(columns), " %.80s", lines->word[i]);
    return hs_fail(err, HS_ERROR_INPUT, "the dump has no column '%s'%s; it has%s", name,
                   hs_field_is_place(field) ? " (nor that with s, u or su behind it)" : "", columns);
}

/** A coordinate may be a fraction of the box (s), unwrapped (u), or both. All that are read must agree. */
static hs_status find_place(hs_frames *frames, int field, hs_snapshot *snapshot, bool *is_first, hs_error *err)
{
    static const char *const endings[] = {"", "s", "u", "su"};
    bool is_scaled = frames->plan->is_scaled, is_wrapped = frames->plan->is_wrapped;
    if (frames->plan->label[field] == NULL) {
        int k = 0;
        for (; k < 4 && frames->column[field] < 0; ++k) {
            char name[8];
            snprintf(name, sizeof name, "%s%s", hs_field_names[field], endings[k]);
            frames->column[field] = find_column(&frames->lines, name);
        }
        if (frames->column[field] < 0) return refuse_field(&frames->lines, field, hs_field_names[field], err);
        is_scaled = k == 2 || k == 4; /* one more than the ending that was found */
        is_wrapped = k <= 2;
    }
    if (!*is_first && (is_scaled != snapshot->is_scaled || is_wrapped != snapshot->is_wrapped))
        return hs_fail(err, HS_ERROR_INPUT,
                       "the coordinates are not of one kind: all must be scaled (xs) or none, and wrapped or not (xu)");
    *is_first = false;
    snapshot->is_scaled = is_scaled;
    snapshot->is_wrapped = is_wrapped;
    return HS_OK;
}

static hs_status find_columns(hs_frames *frames, hs_snapshot *snapshot, hs_error *err)
{
    const hs_lines *lines = &frames->lines;
    bool is_first = true;
    frames->n_columns = lines->n_words - 2;
    for (int field = 0; field < HS_N_FIELDS; ++field) {
        frames->column[field] = -1;
        if (!frames->plan->wants[field]) continue;
        const char *label = frames->plan->label[field];
        if (label != NULL || !hs_field_is_place(field)) {
            const char *name = label != NULL ? label : hs_field_names[field];
            frames->column[field] = find_column(lines, name);
            if (frames->column[field] < 0) return refuse_field(lines, label != NULL ? 0 : field, name, err);
        }
        if (hs_field_is_place(field)) HS_TRY(find_place(frames, field, snapshot, &is_first, err));
    }
    if (snapshot->is_scaled && !snapshot->has_box)
        return hs_fail(err, HS_ERROR_INPUT, "coordinates are fractions of a box that the snapshot does not give");
    return HS_OK;
}

static bool is_item(const hs_lines *lines, const char *second, const char *third)
{
    return lines->n_words >= 2 && strcmp(lines->word[0], "ITEM:") == 0 && strcmp(lines->word[1], second) == 0 &&
           (third == NULL || (lines->n_words >= 3 && strcmp(lines->word[2], third) == 0));
}

/** The items of a snapshot from TIMESTEP to ATOMS, whose line is the present one at the end. */
static hs_status read_items(hs_frames *frames, hs_snapshot *snapshot, hs_error *err)
{
    const hs_lines *lines = &frames->lines;
    bool has_step = false, has_number = false;
    for (bool is_first = true;; is_first = false) {
        if (!is_first) HS_TRY(next_line(frames, err));
        if (is_item(lines, "TIMESTEP", NULL)) {
            HS_TRY(read_count(frames, "number of the timestep", &snapshot->step, err));
            has_step = true;
        } else if (is_item(lines, "NUMBER", "OF")) {
            HS_TRY(read_count(frames, "number of atoms", &frames->n_rows, err));
            has_number = true;
        } else if (is_item(lines, "BOX", "BOUNDS")) {
            HS_TRY(read_bounds(frames, snapshot, err));
        } else if (is_item(lines, "UNITS", NULL)) {
            HS_TRY(next_line(frames, err));
            snprintf(snapshot->units, sizeof snapshot->units, "%s", lines->n_words > 0 ? lines->word[0] : "");
        } else if (is_item(lines, "TIME", NULL)) {
            HS_TRY(next_line(frames, err));
        } else if (is_item(lines, "ATOMS", NULL)) {
            break;
        } else {
            return hs_fail(err, HS_ERROR_INPUT,
                           "'%.60s' is not what a dump of style atom or custom has here: 'ITEM: TIMESTEP', 'NUMBER OF "
                           "ATOMS', 'BOX BOUNDS', 'UNITS', 'TIME' or 'ATOMS'",
                           lines->n_words > 0 ? lines->word[lines->n_words > 1] : "");
        }
    }
    if (has_step && has_number) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "the snapshot has no 'ITEM: %s' before its atoms",
                   has_step ? "NUMBER OF ATOMS" : "TIMESTEP");
}

static hs_status next_native(hs_frames *frames, hs_snapshot *snapshot, bool *is_there, hs_error *err)
{
    frames->n_rows = frames->n_seen = 0;
    hs_status status = hs_lines_next_filled(&frames->lines, err);
    *is_there = status == HS_OK && !frames->lines.at_end;
    if (*is_there) status = read_items(frames, snapshot, err);
    if (*is_there && status == HS_OK) status = find_columns(frames, snapshot, err);
    return located(frames, status, err);
}

const hs_frames_reader hs_frames_native = {
    .open = open_text, .close = close_text, .next = next_native, .read = read_rows, .skip = skip_rows};

/* ---- XYZ: the number of atoms, a line of comment, and a line "type x y z" for each ---- */

static hs_status next_xyz(hs_frames *frames, hs_snapshot *snapshot, bool *is_there, hs_error *err)
{
    const hs_lines *lines = &frames->lines;
    frames->n_seen = 0;
    hs_status status = hs_lines_next_filled(&frames->lines, err);
    *is_there = status == HS_OK && !lines->at_end;
    if (!*is_there) return located(frames, status, err);
    if (lines->n_words != 1 || !hs_text_to_int64(lines->word[0], &frames->n_rows) || frames->n_rows < 0)
        status = hs_fail(err, HS_ERROR_INPUT, "the number of atoms of a snapshot should stand here");
    if (status == HS_OK) status = next_line(frames, err);
    frames->n_columns = 4;
    for (int field = 0; field < HS_N_FIELDS; ++field) frames->column[field] = -1;
    for (int field = HS_FIELD_TYPE; field <= HS_FIELD_Z; ++field)
        if (frames->plan->wants[field]) frames->column[field] = field - HS_FIELD_TYPE;
    snapshot->step = frames->n_snapshots;
    return located(frames, status, err);
}

const hs_frames_reader hs_frames_xyz = {
    .open = open_text, .close = close_text, .next = next_xyz, .read = read_rows, .skip = skip_rows};
