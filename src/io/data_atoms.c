/* The sections Atoms and Velocities of a data file. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
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

static hs_status read_id(const hs_data_reader *reader, const char *word, int64_t *id, hs_error *err)
{
    if (!hs_text_to_int64(word, id) || *id < 1)
        return hs_fail(err, HS_ERROR_INPUT, "'%s' is not an atom id (a whole number of 1 or more)", word);
    if (*id > INT64_MAX - reader->id_offset)
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
            return hs_fail(err, HS_ERROR_INPUT, "'%s' is not an image flag (a whole number)", word);
        image[axis] = (int32_t)value;
    }
    return HS_OK;
}

/** Bring x into the box, or refuse a place outside of a box that is not periodic there. */
static hs_status settle(const hs_box *box, double x[3], int32_t image[3], hs_error *err)
{
    const double far = 1000.0; /* box lengths; further away is a mistake */
    for (int axis = 0; axis < 3; ++axis) {
        const double lo = box->lo[axis], hi = box->hi[axis], length = hi - lo, away = (x[axis] - lo) / length;
        if (!box->periodic[axis] && (x[axis] < lo || x[axis] > hi))
            return hs_fail(err, HS_ERROR_INPUT,
                           "the atom's %c = %.10g is outside of the box, %.10g to %.10g, which is not periodic "
                           "there",
                           "xyz"[axis], x[axis], lo, hi);
        if (!box->periodic[axis]) continue;
        if (!(fabs(away) < far))
            return hs_fail(err, HS_ERROR_INPUT, "the atom's %c = %.10g is more than %g box lengths outside of the box",
                           "xyz"[axis], x[axis], far);
        for (; x[axis] < lo; --image[axis]) x[axis] += length;
        for (; x[axis] >= hi; ++image[axis]) x[axis] -= length;
        if (x[axis] < lo) x[axis] = lo;
    }
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
    HS_TRY(read_id(reader, lines->word[0], &id, err));
    HS_TRY(read_type(reader, lines->word[1], &type, err));
    HS_TRY(read_doubles(lines, 2, layout.n_words - 2, value, layout.n > 1 ? "value of an atom" : "coordinate", err));
    HS_TRY(read_images(lines, layout.n_words, image, err));
    int place = 0;
    for (int k = 0; layout.column[k] != HS_DATA_PLACE; ++k) place += hs_data_column_words(layout.column[k]);
    for (int axis = 0; axis < 3; ++axis) x[axis] = value[place + axis] + reader->options->shift[axis];
    HS_TRY(settle(reader->env->box, x, image, err));
    forget_images(reader, image);
    HS_TRY(hs_atoms_add(atoms, id, (int)type, x, err));
    const int i = atoms->n_local - 1;
    for (int axis = 0; axis < 3; ++axis) atoms->image[axis][i] = image[axis];
    atoms->mask[i] |= reader->options->mask;
    for (int k = 0, word = 0; k < layout.n; word += hs_data_column_words(layout.column[k++]))
        HS_TRY(hs_data_set_column(atoms, i, layout.column[k], value + word, err));
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
    for (int k = 1; k < reader->n_ids; ++k) {
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

static hs_status append_id(hs_data_reader *reader, int *capacity, long line, hs_error *err)
{
    const int i = reader->n_ids;
    if (i == *capacity) {
        const int grown = *capacity * 2 + 1024;
        HS_TRY(HS_GROW(reader->id, (size_t)i, (size_t)grown, err));
        *capacity = grown;
    }
    reader->id[i] = (hs_data_id){.id = reader->env->atoms->id[i], .line = line, .index = i};
    ++reader->n_ids;
    return HS_OK;
}

hs_status hs_data_read_atoms(hs_data_reader *reader, hs_error *err)
{
    hs_atoms *atoms = reader->env->atoms;
    int capacity = 0;
    if (reader->has_atoms) return hs_fail(err, HS_ERROR_INPUT, "there is a section Atoms already");
    char style[HS_ATOM_STYLE_NAME_SIZE];
    hs_atom_style_name(&atoms->style, style);
    if (atoms->style.is_hybrid) *strchr(style, ' ') = '\0'; /* LAMMPS writes the first word only */
    if (reader->lines.comment[0] != '\0' && strncmp(reader->lines.comment, style, strlen(style)) != 0)
        hs_warn(reader->env->out, "%s:%ld: the comment says the atom style is '%s'; it is read as %s",
                reader->lines.path, reader->lines.number, reader->lines.comment, style);
    hs_say(reader->env->out, "  reading atoms ...\n");
    for (int i = 0; i < reader->n_before; ++i) HS_TRY(append_id(reader, &capacity, 0, err));
    /* Room grows as lines are read, so that a wrong count in the header costs no memory. */
    for (int64_t k = 0; k < reader->n_atoms; ++k) {
        HS_TRY(hs_data_next_row(reader, "Atoms", k, reader->n_atoms, err));
        HS_TRY(read_atom(reader, err));
        HS_TRY(append_id(reader, &capacity, reader->lines.number, err));
    }
    const long end = reader->lines.number;
    HS_TRY(check_ids(reader, err));
    reader->lines.number = end;
    reader->has_atoms = true;
    hs_say(reader->env->out, "  %lld atoms\n", (long long)(atoms->n_local - reader->n_before));
    return HS_OK;
}

static hs_status read_velocity(hs_data_reader *reader, hs_error *err)
{
    const hs_lines *lines = &reader->lines;
    hs_data_id key = {0};
    double v[6];
    const bool has_omega = reader->env->atoms->omega[0] != NULL;
    const int n_values = has_omega ? 6 : 3;
    if (lines->n_words != 1 + n_values)
        return hs_fail(err, HS_ERROR_INPUT, "a line of Velocities is 'id vx vy vz%s'; this one has %d words",
                       has_omega ? " wx wy wz" : "", lines->n_words);
    HS_TRY(read_id(reader, lines->word[0], &key.id, err));
    HS_TRY(read_doubles(lines, 1, n_values, v, "velocity", err));
    /* line is not compared: every id occurs once */
    int lo = 0, hi = reader->n_ids;
    while (lo < hi) {
        const int middle = lo + (hi - lo) / 2;
        if (reader->id[middle].id < key.id)
            lo = middle + 1;
        else
            hi = middle;
    }
    hs_data_id *found = lo < reader->n_ids && reader->id[lo].id == key.id ? &reader->id[lo] : NULL;
    if (found == NULL || found->line == 0)
        return hs_fail(err, HS_ERROR_INPUT, "the section Atoms has no atom with id %s", lines->word[0]);
    if (found->has_velocity) return hs_fail(err, HS_ERROR_INPUT, "atom %s has a velocity already", lines->word[0]);
    found->has_velocity = true;
    for (int axis = 0; axis < 3; ++axis) reader->env->atoms->v[axis][found->index] = v[axis];
    for (int axis = 0; axis < 3 && has_omega; ++axis) reader->env->atoms->omega[axis][found->index] = v[3 + axis];
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
    reader->has_velocities = true;
    hs_say(reader->env->out, "  %lld velocities\n", (long long)reader->n_atoms);
    return HS_OK;
}
