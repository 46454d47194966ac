/* Variables whose values are the lines of a file. */
#include "base/memory.h"
#include "deck/variables.h"
#include "io/line_reader.h"

static hs_status append(hs_variable *variable, int *capacity, const char *word, hs_error *err)
{
    if (variable->n_values == *capacity) {
        const int wanted = 2 * *capacity + 16;
        HS_TRY(HS_GROW(variable->value, (size_t)variable->n_values, (size_t)wanted, err));
        *capacity = wanted;
    }
    HS_TRY(hs_memory_strdup(&variable->value[variable->n_values], word, err));
    ++variable->n_values;
    return HS_OK;
}

static hs_status read_lines(hs_variable *variable, hs_lines *lines, hs_error *err)
{
    int capacity = 0;
    for (;;) {
        HS_TRY(hs_lines_next_filled(lines, err));
        if (lines->at_end) break;
        HS_TRY(append(variable, &capacity, lines->word[0], err));
    }
    if (variable->n_values > 0) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "variable: the file '%s' has no values: every line is blank or a comment",
                   lines->path);
}

hs_status hs_variables_read_file(hs_variable *variable, const char *path, const hs_parallel *parallel, hs_error *err)
{
    hs_lines lines = {0};
    HS_TRY(hs_lines_open(&lines, path, parallel, err));
    const hs_status status = read_lines(variable, &lines, err);
    hs_lines_close(&lines);
    return status;
}
