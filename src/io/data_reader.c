/* Reading a data file: the box, and the sections one after the other. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "base/timer.h"
#include "comm/domain.h"
#include "core/atom_style.h"
#include "io/data_internal.h"
#include "style/box_shape.h"

/** Atoms of another file go into a box of the same shape. */
static hs_status check_same_shape(const hs_data_reader *reader, hs_error *err)
{
    const hs_box *box = reader->env->box;
    bool is_same = box->is_tilted == reader->is_tilted;
    for (int k = 0; k < 3; ++k) is_same = is_same && box->tilt[k] == reader->tilt[k];
    if (is_same) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT,
                   "the file's tilts xy xz yz (%g %g %g) are not those of the present box (%g %g %g): atoms can be "
                   "added from files with the same ones only",
                   reader->tilt[0], reader->tilt[1], reader->tilt[2], box->tilt[0], box->tilt[1], box->tilt[2]);
}

/** Make the box and the types, or widen the box to hold the file's. */
static hs_status make_box(hs_data_reader *reader, hs_error *err)
{
    hs_env *env = reader->env;
    const hs_data_options *options = reader->options;
    hs_box box = *env->box;
    for (int axis = 0; axis < 3; ++axis) {
        box.lo[axis] = reader->lo[axis] + options->shift[axis];
        box.hi[axis] = reader->hi[axis] + options->shift[axis];
        if (!(box.lo[axis] < box.hi[axis]) || !isfinite(box.hi[axis] - box.lo[axis]))
            return hs_fail(err, HS_ERROR_INPUT, "the shift along %c leaves no box", "xyz"[axis]);
    }
    if (!options->is_added) {
        box.is_tilted = reader->is_tilted;
        memcpy(box.tilt, reader->tilt, sizeof box.tilt);
        hs_box_say(env->out, "  ", &box);
        HS_TRY(hs_box_check_shape(&box, options->may_be_skewed, env->out, "the header", err));
    }
    hs_box_settle_faces(&box);
    if (options->is_added) {
        HS_TRY(check_same_shape(reader, err));
        for (int axis = 0; axis < 3; ++axis) {
            box.lo[axis] = fmin(box.lo[axis], env->box->lo[axis]);
            box.hi[axis] = fmax(box.hi[axis], env->box->hi[axis]);
        }
        hs_box_say(env->out, "  ", &box);
        if (reader->n_types + options->type_offset > env->atoms->n_types)
            return hs_fail(err, HS_ERROR_INPUT,
                           "the file has %lld atom types (offset %d), but the system has %d; 'extra/atom/types' of the "
                           "first read_data makes room for more",
                           (long long)reader->n_types, options->type_offset, env->atoms->n_types);
    } else {
        const int64_t n_types = reader->n_types + options->n_extra_types + options->type_offset;
        if (n_types > HS_DATA_TYPES_MAX)
            return hs_fail(err, HS_ERROR_INPUT, "%lld atom types are more than the %d there may be", (long long)n_types,
                           HS_DATA_TYPES_MAX);
        HS_TRY(hs_atoms_set_types(env->atoms, (int)n_types, err));
    }
    box.exists = true;
    *env->box = box;
    if (!options->is_added) HS_TRY(hs_domain_divide(env->domain, &box, err));
    hs_say(env->out, "  %d by %d by %d MPI processor grid\n", env->domain->n[0], env->domain->n[1], env->domain->n[2]);
    return HS_OK;
}

static hs_status read_masses(hs_data_reader *reader, hs_error *err)
{
    const hs_lines *lines = &reader->lines;
    if (reader->has_masses) return hs_fail(err, HS_ERROR_INPUT, "there is a section Masses already");
    reader->has_masses = true;
    const hs_atoms *atoms = reader->env->atoms;
    if (atoms->rmass != NULL && !hs_atom_style_has(&atoms->style, HS_ATOM_DIPOLE))
        return hs_fail(err, HS_ERROR_INPUT,
                       "atoms of style sphere have masses of their own (the densities in Atoms): no section Masses");
    for (int64_t k = 0; k < reader->n_types; ++k) {
        int64_t type;
        double mass;
        HS_TRY(hs_data_next_row(reader, "Masses", k, reader->n_types, err));
        if (lines->n_words != 2)
            return hs_fail(err, HS_ERROR_INPUT, "a line of Masses is 'type mass'; this one has %d words",
                           lines->n_words);
        if (!hs_text_to_int64(lines->word[0], &type) || type < 1 || type > reader->n_types)
            return hs_fail(err, HS_ERROR_INPUT, "'%s' is not an atom type from 1 to %lld", lines->word[0],
                           (long long)reader->n_types);
        if (!hs_text_to_double(lines->word[1], &mass) || !(mass > 0.0))
            return hs_fail(err, HS_ERROR_INPUT, "'%s' is not a mass (a number greater than 0)", lines->word[1]);
        reader->env->atoms->mass[type + reader->options->type_offset] = mass;
    }
    return HS_OK;
}

/** One type of a coefficient line as a word, the offset added. */
static hs_status shift_type(const hs_data_reader *reader, const char *word, char text[24], hs_error *err)
{
    int64_t type;
    if (!hs_text_to_int64(word, &type) || type < 1 || type > reader->n_types)
        return hs_fail(err, HS_ERROR_INPUT, "'%s' is not an atom type from 1 to %lld", word,
                       (long long)reader->n_types);
    snprintf(text, 24, "%lld", (long long)type + reader->options->type_offset);
    return HS_OK;
}

/** Pair Coeffs (a line for each type) or PairIJ Coeffs (for each pair of types). */
static hs_status read_coefficients(hs_data_reader *reader, bool is_ij, hs_error *err)
{
    const hs_lines *lines = &reader->lines;
    const hs_data_options *options = reader->options;
    const char *section = is_ij ? "PairIJ Coeffs" : "Pair Coeffs";
    const int64_t n = is_ij ? reader->n_types * (reader->n_types + 1) / 2 : reader->n_types;
    if (!options->no_coeffs && options->pair_style == NULL)
        return hs_fail(err, HS_ERROR_INPUT,
                       "the section %s needs a pair style: give pair_style before read_data, or the keyword nocoeff to "
                       "pass over the coefficients",
                       section);
    if (!options->no_coeffs && lines->comment[0] != '\0' && strcmp(lines->comment, options->pair_style) != 0)
        hs_warn(reader->env->out, "%s:%ld: the coefficients are for pair style '%s' but the present one is '%s'",
                lines->path, lines->number, lines->comment, options->pair_style);
    for (int64_t k = 0; k < n; ++k) {
        char first[24], second[24];
        const char *word[HS_LINE_WORDS_MAX + 1] = {first, is_ij ? second : first};
        HS_TRY(hs_data_next_row(reader, section, k, n, err));
        if (options->no_coeffs) continue;
        if (is_ij && lines->n_words < 2)
            return hs_fail(err, HS_ERROR_INPUT, "a line of %s begins with two types", section);
        HS_TRY(shift_type(reader, lines->word[0], first, err));
        if (is_ij) HS_TRY(shift_type(reader, lines->word[1], second, err));
        const int n_types = is_ij ? 2 : 1;
        for (int i = n_types; i < lines->n_words; ++i) word[2 + i - n_types] = lines->word[i];
        const hs_args args = {.command = section, .n = 2 + lines->n_words - n_types, .word = word};
        HS_TRY(options->pair_coeff(options->context, &args, err));
    }
    return HS_OK;
}

static const char *const sections[] = {"Masses", "Atoms", "Velocities", "Pair Coeffs", "PairIJ Coeffs"};
enum { MASSES, ATOMS, VELOCITIES, PAIR_COEFFS, PAIRIJ_COEFFS, N_SECTIONS };

/** Sections that LAMMPS has for other atom styles. */
static bool is_foreign(const char *name)
{
    static const char *const foreign[] = {"Bonds",       "Angles",       "Dihedrals",       "Impropers",
                                          "Bond Coeffs", "Angle Coeffs", "Dihedral Coeffs", "Improper Coeffs",
                                          "Ellipsoids",  "Lines",        "Triangles",       "Bodies"};
    for (size_t k = 0; k < sizeof foreign / sizeof foreign[0]; ++k)
        if (strcmp(foreign[k], name) == 0) return true;
    return false;
}

static hs_status read_section(hs_data_reader *reader, hs_error *err)
{
    const hs_lines *lines = &reader->lines;
    char name[256] = "";
    for (int k = 0; k < lines->n_words && strlen(name) + strlen(lines->word[k]) + 2 <= sizeof name; ++k)
        strcat(strcat(name, k > 0 ? " " : ""), lines->word[k]);
    const hs_data_section *of_fix = hs_data_find_section(reader, name);
    int section = 0;
    if (of_fix != NULL) return hs_data_read_section(reader, of_fix, err);
    while (section < N_SECTIONS && strcmp(sections[section], name) != 0) ++section;
    switch (section) {
    case MASSES:
        return read_masses(reader, err);
    case ATOMS:
        return hs_data_read_atoms(reader, err);
    case VELOCITIES:
        return hs_data_read_velocities(reader, err);
    case PAIR_COEFFS:
        return read_coefficients(reader, false, err);
    case PAIRIJ_COEFFS:
        return read_coefficients(reader, true, err);
    default:
        break;
    }
    if (is_foreign(name))
        return hs_fail(err, HS_ERROR_INPUT, "the section '%s' is not for atoms of the supported styles", name);
    if (strchr("0123456789+-.", name[0]) != NULL)
        return hs_fail(err, HS_ERROR_INPUT,
                       "a section name was expected, not '%s': the section before has more lines than the header says, "
                       "or this one has no name",
                       name);
    const char *nearest = hs_text_nearest(name, sections, N_SECTIONS);
    if (nearest != NULL) return hs_fail(err, HS_ERROR_INPUT, "unknown section '%s'; did you mean '%s'?", name, nearest);
    return hs_fail(err, HS_ERROR_INPUT,
                   "unknown section '%s'; values of a fix property/atom are read with 'read_data ... fix <ID> NULL %s'",
                   name, name);
}

static hs_status read_file(hs_data_reader *reader, hs_error *err)
{
    HS_TRY(hs_data_read_header(reader, err));
    HS_TRY(make_box(reader, err));
    for (;;) {
        HS_TRY(hs_lines_next_filled(&reader->lines, err));
        if (reader->lines.at_end) break;
        HS_TRY(read_section(reader, err));
    }
    if (reader->n_atoms > 0 && !reader->has_atoms)
        return hs_fail(err, HS_ERROR_INPUT, "the file has no section Atoms, but the header says there are %lld atoms",
                       (long long)reader->n_atoms);
    hs_data_warn_of_missing(reader);
    return HS_OK;
}

/** A failed file leaves no atoms and no box behind. */
static void undo(const hs_data_reader *reader, const hs_box *box_before)
{
    *reader->env->box = *box_before;
    if (reader->env->atoms->n_local == reader->n_before) return;
    reader->env->atoms->n_local = reader->n_before;
    ++reader->env->atoms->generation;
}

hs_status hs_data_read(hs_env *env, const char *path, const hs_data_options *options, hs_error *err)
{
    hs_data_reader reader = {.env = env, .options = options, .n_atoms = -1, .n_before = env->atoms->n_local};
    const hs_box box_before = *env->box;
    const double start_s = hs_time_now_s();
    int64_t max_id = hs_atoms_max_id(env->atoms);
    hs_parallel_max_int64(env->parallel, &max_id, 1);
    reader.id_offset = options->is_appended ? max_id : options->id_offset;
    hs_say(env->out, "Reading data file ...\n");
    HS_TRY(HS_ALLOC(reader.has_section, (size_t)options->n_sections, err));
    hs_status status = hs_lines_open(&reader.lines, path, env->parallel, err);
    if (status != HS_OK) {
        HS_FREE(reader.has_section);
        return status;
    }
    status = read_file(&reader, err);
    if (status != HS_OK) {
        hs_error_locate(err, path, reader.lines.number);
        undo(&reader, &box_before);
    } else {
        hs_say(env->out, "  read_data CPU = %.3f seconds\n", hs_time_now_s() - start_s);
    }
    hs_lines_close(&reader.lines);
    HS_FREE(reader.id);
    HS_FREE(reader.before);
    HS_FREE(reader.has_section);
    return status;
}
