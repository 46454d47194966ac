/* Files that fixes write: comment lines name the columns, of a row a step or of a block of rows a step.
 *
 *     # Time-averaged data for fix 1          # Chunk-averaged data for fix 2 and group all
 *     # TimeStep c_temp c_press               # Timestep Number-of-chunks Total-count
 *     100 1.2 3.4                             # Chunk Coord1 Ncount temp
 *                                             100 10 864
 *                                               1 0.05 101 1.2 ... */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "io/table.h"

/** Comments may stand anywhere; the last two before the first row count. */
typedef struct fix_reader {
    hs_table_file *file;
    char *names[2];    /**< comment lines, without #: the block's, the rows'; borrowed */
    const char **name; /**< owned: names of the rows' columns */
    int n_names;
    size_t capacity_names;
    const char **word; /**< owned */
    int n;
    size_t capacity;
    int64_t rows_left; /**< of the present block */
} fix_reader;

static hs_status read_comments(fix_reader *reader, hs_table_lines *lines, char **first_row, hs_error *err)
{
    char *line, *title = NULL;
    while ((line = hs_table_next_line(lines)) != NULL && (line[strspn(line, " \t")] == '#' || line[0] == '\0')) {
        if (line[0] == '\0') continue;
        char *text = line + strspn(line, " \t#");
        if (title == NULL) title = text;
        reader->names[0] = reader->names[1];
        reader->names[1] = text;
    }
    *first_row = line;
    return hs_memory_strdup(&reader->file->about, title != NULL ? title : "", err);
}

static hs_status read_row(fix_reader *reader, hs_table_lines *lines, char *line, bool has_blocks, hs_error *err)
{
    HS_TRY(hs_table_split(line, &reader->word, &reader->capacity, &reader->n, err));
    if (reader->n == 0 || reader->word[0][0] == '#') return HS_OK;
    if (has_blocks && reader->rows_left == 0) {
        double step, rows;
        if (lines->is_cut) return HS_OK;
        if (reader->n < 2 || !hs_table_number(reader->word[0], &step) || !hs_table_number(reader->word[1], &rows) ||
            !(fabs(step) <= 1e15) || !(rows >= 0.0 && rows <= 1e15))
            return hs_fail(err, HS_ERROR_INPUT, "a step and a number of rows should stand here, not '%s'",
                           reader->word[0]);
        reader->rows_left = (int64_t)rows;
        return hs_table_add(reader->file, reader->name, reader->n_names, (int64_t)step, err);
    }
    if (reader->n != reader->n_names) {
        if (lines->is_cut) return HS_OK; /* the writer was stopped within its last line */
        const hs_table_file *file = reader->file;
        if (file->n_tables == 1 && file->table[0].n_rows == 0)
            return hs_fail(err, HS_ERROR_INPUT,
                           "%d words under a comment of %d: this is neither a log, nor a fix's output, nor CSV",
                           reader->n, reader->n_names);
        return hs_fail(err, HS_ERROR_INPUT, "this row has %d words, but there are %d columns", reader->n,
                       reader->n_names);
    }
    if (has_blocks) --reader->rows_left;
    return lines->is_cut ? HS_OK : hs_table_add_row(reader->file, reader->word, err);
}

static hs_status read_rows(fix_reader *reader, hs_table_lines *lines, char *line, hs_error *err)
{
    hs_table_file *file = reader->file;
    if (reader->names[1] == NULL)
        return hs_fail(err, HS_ERROR_INPUT,
                       "no comment names the columns: this is neither a log, nor a fix's output, nor CSV");
    HS_TRY(hs_table_split(reader->names[1], &reader->name, &reader->capacity_names, &reader->n_names, err));
    const bool has_blocks = reader->names[0] != NULL && strstr(reader->names[0], " Number-of-") != NULL;
    file->kind = has_blocks ? HS_TABLE_BLOCKS : HS_TABLE_SERIES;
    if (!has_blocks) HS_TRY(hs_table_add(file, reader->name, reader->n_names, 1, err));
    for (; line != NULL; line = hs_table_next_line(lines)) HS_TRY(read_row(reader, lines, line, has_blocks, err));
    return HS_OK;
}

hs_status hs_table_read_fix(hs_table_file *file, hs_table_lines *lines, hs_error *err)
{
    fix_reader reader = {.file = file};
    char *line;
    hs_status status = read_comments(&reader, lines, &line, err);
    if (status == HS_OK && line != NULL) status = read_rows(&reader, lines, line, err);
    HS_FREE(reader.name);
    HS_FREE(reader.word);
    return status;
}
