#include "io/table.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <zlib.h>

#include "base/memory.h"

static void fini_table(hs_table *table)
{
    for (int k = 0; k < table->n_columns; ++k) {
        hs_table_column *column = &table->column[k];
        for (int64_t i = 0; column->word != NULL && i < table->n_rows; ++i) HS_FREE(column->word[i]);
        HS_FREE(column->word);
        HS_FREE(column->value);
        HS_FREE(column->name);
    }
    HS_FREE(table->column);
}

void hs_table_file_fini(hs_table_file *file)
{
    for (int k = 0; k < file->n_tables; ++k) fini_table(&file->table[k]);
    HS_FREE(file->table);
    file->n_tables = 0;
    HS_FREE(file->path);
    HS_FREE(file->about);
    hs_text_fini(&file->text);
}

int hs_table_find(const hs_table *table, const char *name)
{
    for (int k = 0; k < table->n_columns; ++k)
        if (strcmp(table->column[k].name, name) == 0) return k;
    return -1;
}

char *hs_table_next_line(hs_table_lines *lines)
{
    if (lines->next >= lines->end) return NULL;
    char *line = lines->next, *newline = memchr(line, '\n', (size_t)(lines->end - line));
    lines->is_cut = newline == NULL;
    char *stop = newline != NULL ? newline : lines->end;
    lines->next = stop + 1;
    if (stop > line && stop[-1] == '\r') --stop;
    *stop = '\0'; /* the text has a terminator of its own, so this stays inside */
    ++lines->number;
    return line;
}

hs_status hs_table_split(char *line, const char ***words, size_t *capacity, int *n, hs_error *err)
{
    char *rest = NULL;
    *n = 0;
    for (char *word = strtok_r(line, " \t", &rest); word != NULL; word = strtok_r(NULL, " \t", &rest)) {
        HS_TRY(HS_EXTEND(*words, *n, *capacity, err));
        (*words)[(*n)++] = word;
    }
    return HS_OK;
}

bool hs_table_number(const char *word, double *value)
{
    char *end;
    *value = strtod(word, &end);
    if (end != word && *end == '\0') return true;
    *value = NAN;
    return false;
}

hs_status hs_table_add(hs_table_file *file, const char *const *names, int n, int64_t step, hs_error *err)
{
    HS_TRY(HS_GROW(file->table, (size_t)file->n_tables, (size_t)file->n_tables + 1, err));
    hs_table *table = &file->table[file->n_tables++];
    *table = (hs_table){.step = step};
    HS_TRY(HS_ALLOC(table->column, (size_t)n, err));
    table->n_columns = n;
    for (int k = 0; k < n; ++k) HS_TRY(hs_memory_strdup(&table->column[k].name, names[k], err));
    return HS_OK;
}

static hs_status grow_rows(hs_table *table, hs_error *err)
{
    const int64_t capacity = table->capacity > 0 ? 2 * table->capacity : 64;
    for (int k = 0; k < table->n_columns; ++k) {
        hs_table_column *column = &table->column[k];
        HS_TRY(HS_GROW(column->value, (size_t)table->n_rows, (size_t)capacity, err));
        if (column->word != NULL) HS_TRY(HS_GROW(column->word, (size_t)table->n_rows, (size_t)capacity, err));
    }
    table->capacity = capacity;
    return HS_OK;
}

hs_status hs_table_add_row(hs_table_file *file, const char *const *words, hs_error *err)
{
    hs_table *table = &file->table[file->n_tables - 1];
    const int64_t i = table->n_rows;
    if (i == table->capacity) HS_TRY(grow_rows(table, err));
    for (int k = 0; k < table->n_columns; ++k) {
        hs_table_column *column = &table->column[k];
        if (hs_table_number(words[k], &column->value[i])) continue;
        if (column->word == NULL) HS_TRY(HS_ALLOC(column->word, (size_t)table->capacity, err));
        HS_TRY(hs_memory_strdup(&column->word[i], words[k], err));
    }
    ++table->n_rows;
    return HS_OK;
}

hs_status hs_table_read_text(const char *path, hs_text *text, hs_error *err)
{
    enum { PIECE = 1 << 16 };
    struct stat about;
    if (stat(path, &about) != 0) return hs_fail(err, HS_ERROR_INPUT, "'%s' cannot be read: %s", path, strerror(errno));
    if (S_ISDIR(about.st_mode))
        return hs_fail(err, HS_ERROR_INPUT, "'%s' is a folder, not a file; halfshell report takes folders", path);
    gzFile stream = gzopen(path, "rb"); /* reads plain files too */
    if (stream == NULL) return hs_fail(err, HS_ERROR_INPUT, "'%s' cannot be read: %s", path, strerror(errno));
    char *piece;
    hs_status status = HS_ALLOC(piece, PIECE, err);
    int n = 1;
    while (status == HS_OK && (n = gzread(stream, piece, PIECE)) > 0)
        status = hs_text_append(text, piece, (size_t)n, err);
    HS_FREE(piece);
    if (status == HS_OK && n < 0) status = hs_fail(err, HS_ERROR_INPUT, "'%s' cannot be read: it is damaged", path);
    gzclose(stream);
    if (status != HS_OK) return status;
    if (text->length == 0) return hs_fail(err, HS_ERROR_INPUT, "'%s' is empty", path);
    if (memchr(text->data, '\0', text->length) != NULL)
        return hs_fail(err, HS_ERROR_INPUT, "'%s' is no text file", path);
    return HS_OK;
}

/** Where a thermo table begins in a log of Halfshell or LAMMPS. */
static bool is_log(const char *text)
{
    static const char mark[] = "Per MPI rank memory allocation";
    const char *found = strstr(text, mark);
    return found != NULL && (found == text || found[-1] == '\n');
}

hs_status hs_table_file_read(hs_table_file *file, const char *path, hs_error *err)
{
    memset(file, 0, sizeof *file);
    HS_TRY(hs_memory_strdup(&file->path, path, err));
    HS_TRY(hs_table_read_text(path, &file->text, err));
    const char *first = file->text.data + strspn(file->text.data, " \t\r\n");
    hs_table_lines lines = {.next = file->text.data, .end = file->text.data + file->text.length};
    hs_status status;
    if (is_log(file->text.data))
        status = hs_table_read_log(file, &lines, err);
    else if (*first == '#')
        status = hs_table_read_fix(file, &lines, err);
    else
        status = hs_table_read_csv(file, &lines, err);
    if (status == HS_OK && file->about == NULL) status = hs_memory_strdup(&file->about, "", err);
    if (status != HS_OK) {
        hs_error_locate(err, path, lines.number);
        return status;
    }
    bool has_rows = false;
    for (int k = 0; k < file->n_tables; ++k) has_rows |= file->table[k].n_rows > 0;
    if (!has_rows)
        return hs_fail(err, HS_ERROR_INPUT, "'%s' holds no rows of numbers%s", path,
                       file->kind == HS_TABLE_LOG ? ": no run in it got as far as its first thermo line" : "");
    return HS_OK;
}
