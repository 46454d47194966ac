/* Thermo tables of a log. A table begins with the line after "Per MPI rank memory allocation" and ends at "Loop time";
 * lines between that are no rows (warnings, output of fix print) are passed over. */
#include <string.h>

#include "base/memory.h"
#include "io/table.h"

static bool starts_with(const char *line, const char *start) { return strncmp(line, start, strlen(start)) == 0; }

static bool is_row(const char *const *words, int n, int n_columns)
{
    double value;
    if (n != n_columns) return false;
    for (int k = 0; k < n; ++k)
        if (!hs_table_number(words[k], &value)) return false;
    return true;
}

/** Words of the present run. */
typedef struct log_reader {
    hs_table_file *file;
    const char **word; /**< owned [capacity] */
    int n;
    size_t capacity;
    const char **name, **value; /**< thermo_style multi: of the present step, borrowed; owned arrays */
    int n_pairs, capacity_pairs;
} log_reader;

static hs_status add_pair(log_reader *reader, const char *name, const char *value, hs_error *err)
{
    if (reader->n_pairs == reader->capacity_pairs) {
        const int more = reader->capacity_pairs > 0 ? 2 * reader->capacity_pairs : 32;
        HS_TRY(HS_GROW(reader->name, (size_t)reader->n_pairs, (size_t)more, err));
        HS_TRY(HS_GROW(reader->value, (size_t)reader->n_pairs, (size_t)more, err));
        reader->capacity_pairs = more;
    }
    reader->name[reader->n_pairs] = name;
    reader->value[reader->n_pairs++] = value;
    return HS_OK;
}

/** thermo_style multi: the pairs of the step that ends here are a row; the run's first step gives the columns. */
static hs_status end_step(log_reader *reader, bool *is_first, hs_error *err)
{
    hs_table_file *file = reader->file;
    if (reader->n_pairs == 0) return HS_OK;
    if (*is_first) HS_TRY(hs_table_add(file, reader->name, reader->n_pairs, file->n_tables + 1, err));
    *is_first = false;
    const bool fits = file->table[file->n_tables - 1].n_columns == reader->n_pairs;
    reader->n_pairs = 0;
    return fits ? hs_table_add_row(file, reader->value, err) : HS_OK;
}

/** ---------------- Step      100 ----- CPU =      0.0087 (sec) ---------------- and then triples NAME = VALUE. */
static hs_status read_multi(log_reader *reader, hs_table_lines *lines, char *line, hs_error *err)
{
    bool is_first = true;
    for (; line != NULL && !starts_with(line, "Loop time"); line = hs_table_next_line(lines)) {
        double value;
        const bool is_head = starts_with(line, "----");
        HS_TRY(hs_table_split(line, &reader->word, &reader->capacity, &reader->n, err));
        const char *const *word = reader->word;
        if (is_head) HS_TRY(end_step(reader, &is_first, err));
        if (is_head && reader->n > 2 && hs_table_number(word[2], &value))
            HS_TRY(add_pair(reader, word[1], word[2], err));
        for (int k = 0; !is_head && k + 2 < reader->n; k += 3)
            if (strcmp(word[k + 1], "=") == 0 && hs_table_number(word[k + 2], &value))
                HS_TRY(add_pair(reader, word[k], word[k + 2], err));
    }
    return end_step(reader, &is_first, err);
}

static hs_status read_run(log_reader *reader, hs_table_lines *lines, hs_error *err)
{
    hs_table_file *file = reader->file;
    char *line = hs_table_next_line(lines);
    if (line == NULL) return HS_OK;
    if (starts_with(line, "----")) return read_multi(reader, lines, line, err);
    HS_TRY(hs_table_split(line, &reader->word, &reader->capacity, &reader->n, err));
    if (reader->n == 0) return HS_OK;
    const int n_columns = reader->n;
    HS_TRY(hs_table_add(file, reader->word, n_columns, file->n_tables + 1, err));
    while ((line = hs_table_next_line(lines)) != NULL && !starts_with(line, "Loop time")) {
        HS_TRY(hs_table_split(line, &reader->word, &reader->capacity, &reader->n, err));
        if (!lines->is_cut && is_row(reader->word, reader->n, n_columns))
            HS_TRY(hs_table_add_row(file, reader->word, err));
    }
    return HS_OK;
}

hs_status hs_table_read_log(hs_table_file *file, hs_table_lines *lines, hs_error *err)
{
    log_reader reader = {.file = file};
    hs_status status = HS_OK;
    file->kind = HS_TABLE_LOG;
    char *line = hs_table_next_line(lines);
    if (line != NULL) status = hs_memory_strdup(&file->about, line, err);
    for (; line != NULL && status == HS_OK; line = hs_table_next_line(lines))
        if (starts_with(line, "Per MPI rank memory allocation")) status = read_run(&reader, lines, err);
    HS_FREE(reader.word);
    HS_FREE(reader.name);
    HS_FREE(reader.value);
    return status;
}
