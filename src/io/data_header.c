/* Header of a data file: counts and box. */
#include <ctype.h>
#include <math.h>
#include <string.h>

#include "io/data_internal.h"

/** Distance: squares of lengths below it, and sums of them, are finite. */
static const double longest = 1e150;

/** Lines of the header by the words after their numbers. */
typedef enum { ATOMS, TYPES, XBOUNDS, YBOUNDS, ZBOUNDS, TILT, MUST_BE_ZERO } header_kind;

static const struct {
    const char *text;
    int n_numbers;
    header_kind kind;
} header_lines[] = {
    {"atoms", 1, ATOMS},
    {"atom types", 1, TYPES},
    {"xlo xhi", 2, XBOUNDS},
    {"ylo yhi", 2, YBOUNDS},
    {"zlo zhi", 2, ZBOUNDS},
    {"xy xz yz", 3, TILT},
    {"bonds", 1, MUST_BE_ZERO},
    {"angles", 1, MUST_BE_ZERO},
    {"dihedrals", 1, MUST_BE_ZERO},
    {"impropers", 1, MUST_BE_ZERO},
    {"bond types", 1, MUST_BE_ZERO},
    {"angle types", 1, MUST_BE_ZERO},
    {"dihedral types", 1, MUST_BE_ZERO},
    {"improper types", 1, MUST_BE_ZERO},
    {"extra bond per atom", 1, MUST_BE_ZERO},
    {"extra angle per atom", 1, MUST_BE_ZERO},
    {"extra dihedral per atom", 1, MUST_BE_ZERO},
    {"extra improper per atom", 1, MUST_BE_ZERO},
    {"extra special per atom", 1, MUST_BE_ZERO},
    {"ellipsoids", 1, MUST_BE_ZERO},
    {"lines", 1, MUST_BE_ZERO},
    {"triangles", 1, MUST_BE_ZERO},
    {"bodies", 1, MUST_BE_ZERO},
};
enum { N_HEADER_LINES = sizeof header_lines / sizeof header_lines[0] };

static bool is_number_like(const char *word)
{
    return isdigit((unsigned char)word[0]) || strchr("+-.", word[0]) != NULL;
}

static hs_status read_count(const hs_lines *lines, int64_t *count, hs_error *err)
{
    if (hs_text_to_int64(lines->word[0], count) && *count >= 0) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "'%s' is not a count (a whole number of 0 or more)", lines->word[0]);
}

static hs_status read_bounds(hs_data_reader *reader, int axis, hs_error *err)
{
    const hs_lines *lines = &reader->lines;
    if (!hs_text_to_double(lines->word[0], &reader->lo[axis]) || !hs_text_to_double(lines->word[1], &reader->hi[axis]))
        return hs_fail(err, HS_ERROR_INPUT, "box bounds must be two finite numbers, not '%s %s'", lines->word[0],
                       lines->word[1]);
    const double length = reader->hi[axis] - reader->lo[axis];
    if (length >= longest)
        return hs_fail(err, HS_ERROR_INPUT, "the box bounds '%s %s' are too far apart: a box is less than %g long",
                       lines->word[0], lines->word[1], longest);
    if (!(length > 0.0))
        return hs_fail(err, HS_ERROR_INPUT,
                       "the box bounds '%s %s' do not leave a box: the first must be less than the second",
                       lines->word[0], lines->word[1]);
    reader->has_bounds[axis] = true;
    return HS_OK;
}

static hs_status read_tilts(hs_data_reader *reader, hs_error *err)
{
    const hs_lines *lines = &reader->lines;
    for (int k = 0; k < 3; ++k)
        if (!hs_text_to_double(lines->word[k], &reader->tilt[k]) || !(fabs(reader->tilt[k]) < longest))
            return hs_fail(err, HS_ERROR_INPUT, "tilts must be three numbers of a size below %g, and '%s' is none",
                           longest, lines->word[k]);
    reader->is_tilted = true;
    return HS_OK;
}

static hs_status take_line(hs_data_reader *reader, header_kind kind, const char *name, hs_error *err)
{
    int64_t count;
    switch (kind) {
    case ATOMS:
        return read_count(&reader->lines, &reader->n_atoms, err);
    case TYPES:
        HS_TRY(read_count(&reader->lines, &reader->n_types, err));
        if (reader->n_types >= 1 && reader->n_types <= HS_DATA_TYPES_MAX) return HS_OK;
        return hs_fail(err, HS_ERROR_INPUT, "the number of atom types must be from 1 to %d, not %s", HS_DATA_TYPES_MAX,
                       reader->lines.word[0]);
    case XBOUNDS:
    case YBOUNDS:
    case ZBOUNDS:
        return read_bounds(reader, (int)kind - XBOUNDS, err);
    case TILT:
        return read_tilts(reader, err);
    default:
        HS_TRY(read_count(&reader->lines, &count, err));
        if (count == 0) return HS_OK;
        return hs_fail(err, HS_ERROR_INPUT, "'%s' must be 0: the atom style atomic has none", name);
    }
}

/** The words after the numbers, joined by single spaces. */
static hs_status read_line(hs_data_reader *reader, hs_error *err)
{
    const hs_lines *lines = &reader->lines;
    const char *names[N_HEADER_LINES];
    char text[256] = "";
    int n_numbers = 0;
    while (n_numbers < lines->n_words && is_number_like(lines->word[n_numbers])) ++n_numbers;
    for (int k = n_numbers; k < lines->n_words; ++k) {
        if (strlen(text) + strlen(lines->word[k]) + 2 > sizeof text) break;
        if (text[0] != '\0') strcat(text, " ");
        strcat(text, lines->word[k]);
    }
    for (int k = 0; k < N_HEADER_LINES; ++k) {
        names[k] = header_lines[k].text;
        if (strcmp(header_lines[k].text, text) != 0) continue;
        if (n_numbers != header_lines[k].n_numbers)
            return hs_fail(err, HS_ERROR_INPUT, "'%s' needs %d number%s before it, not %d", text,
                           header_lines[k].n_numbers, header_lines[k].n_numbers == 1 ? "" : "s", n_numbers);
        return take_line(reader, header_lines[k].kind, text, err);
    }
    if (text[0] == '\0')
        return hs_fail(
            err, HS_ERROR_INPUT,
            "the header has a line of numbers without a word such as 'atoms' or 'xlo xhi': is this a data file?");
    const char *nearest = hs_text_nearest(text, names, N_HEADER_LINES);
    return hs_fail(err, HS_ERROR_INPUT, "unknown line '%s' in the header%s%s%s", text,
                   nearest != NULL ? "; did you mean '" : "", nearest != NULL ? nearest : "",
                   nearest != NULL ? "'?" : "");
}

static hs_status check_complete(const hs_data_reader *reader, hs_error *err)
{
    static const char *const bounds[] = {"xlo xhi", "ylo yhi", "zlo zhi"};
    if (reader->n_atoms < 0) return hs_fail(err, HS_ERROR_INPUT, "the header has no line '<N> atoms'");
    if (reader->n_types == 0) return hs_fail(err, HS_ERROR_INPUT, "the header has no line '<N> atom types'");
    for (int axis = 0; axis < 3; ++axis)
        if (!reader->has_bounds[axis])
            return hs_fail(err, HS_ERROR_INPUT, "the header has no line '<lo> <hi> %s'", bounds[axis]);
    return HS_OK;
}

hs_status hs_data_read_header(hs_data_reader *reader, hs_error *err)
{
    hs_lines *lines = &reader->lines;
    HS_TRY(hs_lines_next(lines, err)); /* the title */
    for (;;) {
        HS_TRY(hs_lines_next_filled(lines, err));
        if (lines->at_end || !is_number_like(lines->word[0])) break;
        HS_TRY(read_line(reader, err));
    }
    hs_lines_hold(lines);
    return check_complete(reader, err);
}
