#include "io/potential_file.h"

#include <limits.h>
#include <math.h>
#include <string.h>

#include "base/memory.h"

double hs_tabulated_distance(int i, int n, double first, double last, bool by_square)
{
    if (!by_square) return first + (last - first) * i / (n - 1);
    return sqrt(first * first + (last * last - first * first) * i / (n - 1));
}

/** What the second line of a section says. */
typedef struct header {
    int n;
    bool has_r, by_square; /**< distances are computed from `end`, in r or in r^2 */
    bool has_slopes;
    double end[2], slope[2];
} header;

static hs_status number(const hs_lines *lines, int i, double *value, hs_error *err)
{
    if (i >= lines->n_words)
        return hs_fail(err, HS_ERROR_INPUT, "%s:%ld: a number is missing at the end of the line", lines->path,
                       lines->number);
    if (hs_text_to_double(lines->word[i], value)) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "%s:%ld: '%s' is not a number", lines->path, lines->number, lines->word[i]);
}

static hs_status read_header(hs_lines *lines, header *h, hs_error *err)
{
    *h = (header){.n = 0};
    HS_TRY(hs_lines_next_filled(lines, err));
    for (int i = 0; i < lines->n_words;) {
        const char *word = lines->word[i];
        if (strcmp(word, "N") == 0) {
            int64_t n;
            if (i + 1 >= lines->n_words || !hs_text_to_int64(lines->word[i + 1], &n) || n < 2 || n > INT_MAX)
                return hs_fail(err, HS_ERROR_INPUT, "%s:%ld: the number of rows after N must be 2 or more", lines->path,
                               lines->number);
            h->n = (int)n;
            i += 2;
        } else if (strcmp(word, "R") == 0 || strcmp(word, "RSQ") == 0 || strcmp(word, "FPRIME") == 0) {
            double *two = word[0] == 'F' ? h->slope : h->end;
            for (int k = 0; k < 2; ++k) HS_TRY(number(lines, i + 1 + k, &two[k], err));
            h->has_slopes |= word[0] == 'F';
            h->has_r |= word[0] == 'R';
            if (word[0] == 'R') h->by_square = word[1] == 'S';
            i += 3;
        } else {
            return hs_fail(err, HS_ERROR_INPUT,
                           "%s:%ld: '%s' is not known here; expected: N <n> [R|RSQ <first> <last>] "
                           "[FPRIME <first> <last>]%s",
                           lines->path, lines->number, word,
                           strcmp(word, "BITMAP") == 0 ? "; tables by the bits of r^2 are not supported" : "");
        }
    }
    if (h->n == 0)
        return hs_fail(err, HS_ERROR_INPUT, "%s:%ld: the line after the name of a section must be 'N <rows> ...'",
                       lines->path, lines->number);
    if (h->has_r && !(h->end[0] > 0.0 && h->end[1] > h->end[0]))
        return hs_fail(err, HS_ERROR_INPUT, "%s:%ld: the distances after %s must be positive and rise", lines->path,
                       lines->number, h->by_square ? "RSQ" : "R");
    return HS_OK;
}

static hs_status too_few(const hs_lines *lines, int rows, const char *section, int n, hs_error *err)
{
    return hs_fail(err, HS_ERROR_INPUT, "'%s' ends after %d of the %d rows of section '%s'", lines->path, rows, n,
                   section);
}

static hs_status read_rows(hs_tabulated *table, const header *h, hs_lines *lines, const char *section, hs_error *err)
{
    /* memory grows with what is there, not with what the header claims */
    for (int i = 0, room = 0; i < h->n; ++i, ++table->n) {
        HS_TRY(hs_lines_next_filled(lines, err));
        if (lines->at_end) return too_few(lines, i, section, h->n, err);
        if (i == room) {
            room = room < h->n / 2 ? 2 * room + 1024 : h->n;
            HS_TRY(HS_GROW(table->r, (size_t)i, (size_t)room, err));
            HS_TRY(HS_GROW(table->energy, (size_t)i, (size_t)room, err));
            HS_TRY(HS_GROW(table->force, (size_t)i, (size_t)room, err));
        }
        HS_TRY(number(lines, 1, &table->r[i], err));
        HS_TRY(number(lines, 2, &table->energy[i], err));
        HS_TRY(number(lines, 3, &table->force[i], err));
        if (h->has_r) table->r[i] = hs_tabulated_distance(i, h->n, h->end[0], h->end[1], h->by_square);
        if (!(table->r[i] > (i > 0 ? table->r[i - 1] : 0.0)))
            return hs_fail(err, HS_ERROR_INPUT,
                           "%s:%ld: the distance %g must be positive and larger than that of the "
                           "row before",
                           lines->path, lines->number, table->r[i]);
    }
    return HS_OK;
}

/** Slopes of the force at the ends, by the last two rows where the file does not say them. */
static void set_slopes(hs_tabulated *table, const header *h)
{
    for (int k = 0; k < 2; ++k) {
        const int i = k == 0 ? 0 : table->n - 2;
        table->slope[k] =
            h->has_slopes ? h->slope[k] : (table->force[i + 1] - table->force[i]) / (table->r[i + 1] - table->r[i]);
    }
}

static hs_status read_section(hs_tabulated *table, const char *command, hs_lines *lines, const char *section,
                              hs_error *err)
{
    header h;
    for (;;) {
        HS_TRY(hs_lines_next_filled(lines, err));
        if (lines->at_end)
            return hs_fail(err, HS_ERROR_INPUT, "%s: there is no section '%s' in '%s'", command, section, lines->path);
        const bool is_it = strcmp(lines->word[0], section) == 0;
        HS_TRY(read_header(lines, &h, err));
        if (is_it) break;
        for (int i = 0; i < h.n; ++i) {
            HS_TRY(hs_lines_next_filled(lines, err));
            if (lines->at_end) return too_few(lines, i, "before it", h.n, err);
        }
    }
    HS_TRY(read_rows(table, &h, lines, section, err));
    set_slopes(table, &h);
    return HS_OK;
}

hs_status hs_tabulated_read(hs_tabulated *table, const char *command, const char *path, const char *section,
                            const hs_parallel *parallel, hs_error *err)
{
    hs_lines lines = {0};
    HS_TRY(hs_lines_open(&lines, path, parallel, err));
    const hs_status status = read_section(table, command, &lines, section, err);
    hs_lines_close(&lines);
    return status;
}

void hs_tabulated_fini(hs_tabulated *table)
{
    HS_FREE(table->r);
    HS_FREE(table->energy);
    HS_FREE(table->force);
    *table = (hs_tabulated){.n = 0};
}
