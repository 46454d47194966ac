/* CSV: the first line names the columns. Without a comma in it, cells stand between blanks; a first line of numbers
 * only is a row, and the columns are numbered. */
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "io/table.h"

/** Cut a line at its commas, in place; cells in double quotes may hold commas, and "" for a quote. */
static hs_status split_commas(char *line, const char ***words, size_t *capacity, int *n, hs_error *err)
{
    *n = 0;
    for (char *from = line; from != NULL;) {
        char *to, *cell;
        from += strspn(from, " \t");
        if (*from == '"') {
            cell = to = from++;
            for (; *from != '\0' && (*from != '"' || from[1] == '"'); ++from) {
                if (*from == '"') ++from;
                *to++ = *from;
            }
            from = strchr(from, ',');
        } else {
            cell = from;
            from = strchr(from, ',');
            to = from != NULL ? from : cell + strlen(cell);
            while (to > cell && (to[-1] == ' ' || to[-1] == '\t')) --to;
        }
        if (from != NULL) ++from;
        *to = '\0';
        HS_TRY(HS_EXTEND(*words, *n, *capacity, err));
        (*words)[(*n)++] = cell;
    }
    return HS_OK;
}

static hs_status add_numbered(hs_table_file *file, int n, hs_error *err)
{
    char(*number)[16];
    const char **names;
    HS_TRY(HS_ALLOC(number, (size_t)n, err));
    hs_status status = HS_ALLOC(names, (size_t)n, err);
    for (int k = 0; k < n && status == HS_OK; ++k) {
        snprintf(number[k], sizeof number[k], "%d", k + 1);
        names[k] = number[k];
    }
    if (status == HS_OK) status = hs_table_add(file, names, n, 1, err);
    HS_FREE(names);
    HS_FREE(number);
    return status;
}

static hs_status read_lines(hs_table_file *file, hs_table_lines *lines, const char ***words, size_t *capacity,
                            hs_error *err)
{
    bool has_commas = false;
    char *line;
    while ((line = hs_table_next_line(lines)) != NULL) {
        int n;
        const bool is_first = file->n_tables == 0;
        if (line[strspn(line, " \t")] == '\0' || line[0] == '#') continue;
        if (is_first) has_commas = strchr(line, ',') != NULL;
        HS_TRY(has_commas ? split_commas(line, words, capacity, &n, err)
                          : hs_table_split(line, words, capacity, &n, err));
        if (is_first) {
            bool is_row = true;
            double value;
            for (int k = 0; k < n; ++k) is_row &= hs_table_number((*words)[k], &value);
            HS_TRY(is_row ? add_numbered(file, n, err) : hs_table_add(file, *words, n, 1, err));
            if (!is_row) continue;
        }
        if (n != file->table[0].n_columns) {
            if (lines->is_cut) return HS_OK;
            if (file->table[0].n_rows == 0)
                return hs_fail(err, HS_ERROR_INPUT,
                               "%d words under a line of %d: this is neither a log, nor a fix's output, nor CSV", n,
                               file->table[0].n_columns);
            return hs_fail(err, HS_ERROR_INPUT, "this row has %d cells, but there are %d columns", n,
                           file->table[0].n_columns);
        }
        HS_TRY(hs_table_add_row(file, *words, err));
    }
    return HS_OK;
}

hs_status hs_table_read_csv(hs_table_file *file, hs_table_lines *lines, hs_error *err)
{
    const char **words = NULL;
    size_t capacity = 0;
    file->kind = HS_TABLE_CSV;
    const hs_status status = read_lines(file, lines, &words, &capacity, err);
    HS_FREE(words);
    return status;
}
