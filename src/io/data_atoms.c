/* The sections Atoms and Velocities of a data file. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "comm/domain.h"
#include "core/atom_id.h"
#include "core/atom_style.h"
#include "io/data_internal.h"

enum { IMAGE_MAX = 1 << 30 };

hs_status hs_data_next_row(hs_data_reader *reader, const char *section, int64_t k, int64_t n, hs_error *err)
{
    const hs_lines *lines = &reader->lines;
    int64_t number;
    HS_TRY(hs_lines_next_filled(&reader->lines, err));
    if (!lines->at_end && hs_text_to_int64(lines->word[0], &number)) return HS_OK;
    if (!lines->at_end && strchr("0123456789+-.", lines->word[0][0]) != NULL)
        return hs_fail(err, HS_ERROR_INPUT, "section %s: '%s' is not a whole number", section, lines->word[0]);
    return hs_fail(err, HS_ERROR_INPUT, "section %s ends after %lld lines; the header says there are %lld", section,
                   (long long)k, (long long)n);
}

static hs_status read_doubles(const hs_lines *lines, int first, int n, double *values, const char *what, hs_error *err)
{
    for (int k = 0; k < n; ++k)
        if (!hs_text_to_double(lines->word[first + k], &values[k]))
            return hs_fail(err, HS_ERROR_INPUT, "'%s' is not a finite number (a %s)", lines->word[first + k], what);
    return HS_OK;
}

hs_status hs_data_read_id(const hs_data_reader *reader, const char *word, int64_t *id, hs_error *err)
{
    if (!hs_text_to_int64(word, id) || *id < 1 || *id > HS_ATOM_ID_MAX)
        return hs_fail(err, HS_ERROR_INPUT, "'%s' is not an atom id (a whole number from 1 to 2^62)", word);
    if (*id > HS_ATOM_ID_MAX - reader->id_offset)
        return hs_fail(err, HS_ERROR_INPUT, "the id '%s' is too large for the offset of %lld", word,
                       (long long)reader->id_offset);
    *id += reader->id_offset;
    return HS_OK;
}

static hs_status read_type(const hs_data_reader *reader, const char *word, int64_t *type, hs_error *err)
{
    if (!hs_text_to_int64(word, type) || *type < 1 || *type > reader->n_types)
        return hs_fail(err, HS_ERROR_INPUT, "'%s' is not an atom type from 1 to %lld", word,
                       (long long)reader->n_types);
    *type += reader->options->type_offset;
    if (*type <= reader->env->atoms->n_types) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "type %lld, with the offset, is more than the %d types of this system",
                   (long long)*type, reader->env->atoms->n_types);
}

/** Three image flags from word @p first on, or zeros when the line ends before. */
static hs_status read_images(const hs_lines *lines, int first, int32_t image[3], hs_error *err)
{
    for (int axis = 0; axis < 3; ++axis) {
        int64_t value = 0;
        const char *word = lines->n_words > first ? lines->word[first + axis] : "0";
        if (!hs_text_to_int64(word, &value) || value > IMAGE_MAX || value < -IMAGE_MAX)
            return hs_fail(err, HS_ERROR_INPUT, "'%s' is not an image flag (a whole number from -%d to %d)", word,
                           IMAGE_MAX, IMAGE_MAX);
        image[axis] = (int32_t)value;
    }
    return HS_OK;
}

/** Bring x into the box, or refuse a place outside of a box that is not periodic there. */
static hs_status settle(const hs_box *box, double x[3], int32_t image[3], hs_error *err)
{
    enum { FARTHEST = 1000 }; /* box lengths; further away is a mistake */
    for (int axis = 0; axis < 3; ++axis) {
        const double lo = box->lo[axis], hi = box->hi[axis], length = hi - lo, place = hs_box_upright(box, x, axis),
                     away = (place - lo) / length;
        if (!box->periodic[axis] && (place < lo || place > hi))
            return hs_fail(err, HS_ERROR_INPUT,
                           "the atom's %c = %.10g is outside of the box, %.10g to %.10g, which is not periodic there",
                           "xyz"[axis], x[axis], lo, hi);
        if (!box->periodic[axis]) continue;
        if (!(fabs(away) < FARTHEST))
            return hs_fail(err, HS_ERROR_INPUT, "the atom's %c = %.10g is more than %d box lengths outside of the box",
                           "xyz"[axis], x[axis], FARTHEST);
        if (box->is_tilted) continue;
        /* length by length, as LAMMPS does; far from the origin a length may be less than the places' last digit */
        for (int n = 0; x[axis] < lo && n <= FARTHEST; ++n, --image[axis]) x[axis] += length;
        for (int n = 0; x[axis] >= hi && n <= FARTHEST; ++n, ++image[axis]) x[axis] -= length;
        if (x[axis] < lo || x[axis] >= hi) x[axis] = lo;
    }
    if (box->is_tilted) hs_box_wrap(box, x, image);
    return HS_OK;
}

/** Where the box is not periodic there are no images: as LAMMPS does, set the flags to 0 and say so. */
static void forget_images(hs_data_reader *reader, int32_t image[3])
{
    for (int axis = 0; axis < 3; ++axis) {
        if (reader->env->box->periodic[axis] || image[axis] == 0) continue;
        image[axis] = 0;
        if (!reader->image_reset[axis])
            hs_warn(reader->env->out, "%s:%ld: image flags in %c are set to 0: the box is not periodic there",
                    reader->lines.path, reader->lines.number, "xyz"[axis]);
        reader->image_reset[axis] = true;
    }
}

static int ascending(const void *a, const void *b)
{
    const int64_t p = *(const int64_t *)a, q = *(const int64_t *)b;
    return (p > q) - (p < q);
}

/** Whether this rank watches that the id is given once. */
static bool is_watched(const hs_data_reader *reader, int64_t id)
{
    const hs_parallel *parallel = reader->env->parallel;
    return parallel->n_ranks <= 1 || id % parallel->n_ranks == parallel->rank;
}

/** Remember an atom that is this rank's, or was before, or is watched by it. */
static hs_status remember(hs_data_reader *reader, int64_t id, int32_t index, long line, hs_error *err)
{
    const bool was_here =
        reader->n_before > 0 && bsearch(&id, reader->before, (size_t)reader->n_before, sizeof id, ascending) != NULL;
    if (index < 0 && !was_here && !is_watched(reader, id)) return HS_OK;
    HS_TRY(HS_EXTEND(reader->id, reader->n_ids, reader->capacity_ids, err));
    reader->id[reader->n_ids++] = (hs_data_id){.id = id, .line = line, .index = index};
    return HS_OK;
}

/** The local atoms there were: their ids must not come again. */
static hs_status remember_before(hs_data_reader *reader, hs_error *err)
{
    const hs_atoms *atoms = reader->env->atoms;
    const int n = reader->n_before;
    HS_TRY(HS_ALLOC(reader->before, (size_t)n, err));
    for (int i = 0; i < n; ++i) reader->before[i] = atoms->id[i];
    if (n > 0) qsort(reader->before, (size_t)n, sizeof *reader->before, ascending);
    for (int i = 0; i < n; ++i) HS_TRY(remember(reader, atoms->id[i], i, 0, err));
    return HS_OK;
}

static hs_status read_atom(hs_data_reader *reader, hs_error *err)
{
    const hs_lines *lines = &reader->lines;
    hs_atoms *atoms = reader->env->atoms;
    int64_t id, type;
    double x[3], value[HS_LINE_WORDS_MAX];
    int32_t image[3];
    const hs_data_columns layout = hs_data_columns_of(&atoms->style);
    if (lines->n_words != layout.n_words && lines->n_words != layout.n_words + 3)
        return hs_data_refuse_columns(&atoms->style, lines->n_words, err);
    HS_TRY(hs_data_read_id(reader, lines->word[0], &id, err));
    HS_TRY(read_type(reader, lines->word[1], &type, err));
    HS_TRY(read_doubles(lines, 2, layout.n_words - 2, value, layout.n > 1 ? "value of an atom" : "coordinate", err));
    HS_TRY(read_images(lines, layout.n_words, image, err));
    int place = 0;
    for (int k = 0; layout.column[k] != HS_DATA_PLACE; ++k) place += hs_data_column_words(layout.column[k]);
    for (int axis = 0; axis < 3; ++axis) x[axis] = value[place + axis] + reader->options->shift[axis];
    HS_TRY(settle(reader->env->box, x, image, err));
    forget_images(reader, image);
    const int i = atoms->n_local;
    if (!hs_domain_owns(reader->env->domain, reader->env->box, x)) return remember(reader, id, -1, lines->number, err);
    HS_TRY(remember(reader, id, i, lines->number, err));
    HS_TRY(hs_atoms_add(atoms, id, (int)type, x, err));
    for (int axis = 0; axis < 3; ++axis) atoms->image[axis][i] = image[axis];
    atoms->mask[i] |= reader->options->mask;
    for (int k = 0, word = 0; k < layout.n; word += hs_data_column_words(layout.column[k++]))
        if (hs_data_set_column(atoms, i, layout.column[k], value + word, &reader->late) != HS_OK)
            hs_error_locate(&reader->late, lines->path, lines->number);
    return HS_OK;
}

static int by_id(const void *a, const void *b)
{
    const hs_data_id *p = a, *q = b;
    if (p->id != q->id) return p->id < q->id ? -1 : 1;
    return (p->line > q->line) - (p->line < q->line);
}

/** Sort the ids and refuse equal ones. */
static hs_status check_ids(hs_data_reader *reader, hs_error *err)
{
    if (reader->n_ids > 0) qsort(reader->id, (size_t)reader->n_ids, sizeof *reader->id, by_id);
    for (int64_t k = 1; k < reader->n_ids; ++k) {
        const hs_data_id *a = &reader->id[k - 1], *b = &reader->id[k];
        if (a->id != b->id) continue;
        reader->lines.number = b->line;
        if (a->line == 0)
            return hs_fail(err, HS_ERROR_INPUT, "atom id %lld exists already; 'add append' numbers new atoms on",
                           (long long)b->id);
        return hs_fail(err, HS_ERROR_INPUT, "atom id %lld was given on line %ld already", (long long)b->id, a->line);
    }
    return HS_OK;
}

/** Bring an error that some ranks alone have met, at the present line, to all (collective). */
static hs_status agree(hs_data_reader *reader, hs_error *err)
{
    if (err->status != HS_OK) hs_error_locate(err, reader->lines.path, reader->lines.number);
    return hs_parallel_agree(reader->env->parallel, err);
}

hs_status hs_data_read_atoms(hs_data_reader *reader, hs_error *err)
{
    if (reader->has_atoms) return hs_fail(err, HS_ERROR_INPUT, "there is a section Atoms already");
    char style[HS_ATOM_STYLE_NAME_SIZE];
    const hs_atoms *atoms = reader->env->atoms;
    hs_atom_style_name(&atoms->style, style);
    if (atoms->style.is_hybrid) *strchr(style, ' ') = '\0'; /* LAMMPS writes the first word only */
    if (reader->lines.comment[0] != '\0' && strncmp(reader->lines.comment, style, strlen(style)) != 0)
        hs_warn(reader->env->out, "%s:%ld: the comment says the atom style is '%s'; it is read as %s",
                reader->lines.path, reader->lines.number, reader->lines.comment, style);
    hs_say(reader->env->out, "  reading atoms ...\n");
    HS_TRY(remember_before(reader, err));
    /* Room grows as lines are read, so that a wrong count in the header costs no memory. */
    for (int64_t k = 0; k < reader->n_atoms; ++k) {
        HS_TRY(hs_data_next_row(reader, "Atoms", k, reader->n_atoms, err));
        HS_TRY(read_atom(reader, err));
    }
    const long end = reader->lines.number;
    if (reader->late.status != HS_OK) *err = reader->late;
    HS_UNLESS_FAILED(err, check_ids(reader, err));
    HS_TRY(agree(reader, err));
    reader->lines.number = end;
    reader->has_atoms = true;
    hs_say(reader->env->out, "  %lld atoms\n", (long long)reader->n_atoms);
    return HS_OK;
}

/** The rank that watches an id finds out whether there is such an atom, and whether it had its line already. The others
 *  read on, so it keeps the first error for the end of the section. */
static void note_line(hs_data_reader *reader, hs_data_id *found, int32_t section, const char *name)
{
    const hs_lines *lines = &reader->lines;
    if (found == NULL)
        (void)hs_fail(&reader->late, HS_ERROR_INPUT, "the section Atoms has no atom with id %s", lines->word[0]);
    else if (found->section == section && section == HS_DATA_VELOCITIES)
        (void)hs_fail(&reader->late, HS_ERROR_INPUT, "atom %s has a velocity already", lines->word[0]);
    else if (found->section == section)
        (void)hs_fail(&reader->late, HS_ERROR_INPUT, "atom %s has a line in section %s already", lines->word[0], name);
    else
        found->section = section;
    if (reader->late.status != HS_OK) hs_error_locate(&reader->late, lines->path, lines->number);
}

int hs_data_find_atom(hs_data_reader *reader, int64_t id, int32_t section, const char *name, bool *is_new)
{
    /* line is not compared: every id occurs once */
    int64_t lo = 0, hi = reader->n_ids;
    while (lo < hi) {
        const int64_t middle = lo + (hi - lo) / 2;
        if (reader->id[middle].id < id)
            lo = middle + 1;
        else
            hi = middle;
    }
    hs_data_id *found = lo < reader->n_ids && reader->id[lo].id == id ? &reader->id[lo] : NULL;
    *is_new = found != NULL && found->line != 0;
    if (is_watched(reader, id)) note_line(reader, *is_new ? found : NULL, section, name);
    return *is_new ? found->index : -1;
}

static hs_status read_velocity(hs_data_reader *reader, hs_error *err)
{
    const hs_lines *lines = &reader->lines;
    int64_t id;
    bool is_new;
    double v[6];
    const bool has_omega = reader->env->atoms->omega[0] != NULL;
    const int n_values = has_omega ? 6 : 3;
    if (lines->n_words != 1 + n_values)
        return hs_fail(err, HS_ERROR_INPUT, "a line of Velocities is 'id vx vy vz%s'; this one has %d words",
                       has_omega ? " wx wy wz" : "", lines->n_words);
    HS_TRY(hs_data_read_id(reader, lines->word[0], &id, err));
    HS_TRY(read_doubles(lines, 1, n_values, v, "velocity", err));
    const int i = hs_data_find_atom(reader, id, HS_DATA_VELOCITIES, "Velocities", &is_new);
    if (i < 0) return HS_OK;
    for (int axis = 0; axis < 3; ++axis) reader->env->atoms->v[axis][i] = v[axis];
    for (int axis = 0; axis < 3 && has_omega; ++axis) reader->env->atoms->omega[axis][i] = v[3 + axis];
    return HS_OK;
}

hs_status hs_data_read_velocities(hs_data_reader *reader, hs_error *err)
{
    if (!reader->has_atoms) return hs_fail(err, HS_ERROR_INPUT, "the section Velocities must come after Atoms");
    if (reader->has_velocities) return hs_fail(err, HS_ERROR_INPUT, "there is a section Velocities already");
    hs_say(reader->env->out, "  reading velocities ...\n");
    for (int64_t k = 0; k < reader->n_atoms; ++k) {
        HS_TRY(hs_data_next_row(reader, "Velocities", k, reader->n_atoms, err));
        HS_TRY(read_velocity(reader, err));
    }
    if (reader->late.status != HS_OK) *err = reader->late;
    HS_TRY(hs_parallel_agree(reader->env->parallel, err));
    reader->has_velocities = true;
    hs_say(reader->env->out, "  %lld velocities\n", (long long)reader->n_atoms);
    return HS_OK;
}
