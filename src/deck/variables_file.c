/* Variables whose values are the lines of a file. */
#include "base/memory.h"
#include "deck/unwritten.h"
#include "deck/variables.h"

static hs_status append(hs_variable *variable, size_t *capacity, const char *word, hs_error *err)
{
    HS_TRY(HS_EXTEND(variable->value, variable->n_values, *capacity, err));
    HS_TRY(hs_memory_strdup(&variable->value[variable->n_values], word, err));
    ++variable->n_values;
    return HS_OK;
}

static hs_status read_lines(hs_variable *variable, hs_lines *lines, hs_error *err)
{
    size_t capacity = 0;
    for (;;) {
        HS_TRY(hs_lines_next_filled(lines, err));
        if (lines->at_end) break;
        HS_TRY(append(variable, &capacity, lines->word[0], err));
    }
    if (variable->n_values > 0) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "variable: the file '%s' has no values: every line is blank or a comment",
                   lines->path);
}

hs_status hs_variables_read_file(hs_variable *variable, const char *path, const hs_deck *deck, hs_error *err)
{
    hs_lines lines = {0};
    HS_TRY(hs_unwritten_open(deck, &lines, path, err));
    const hs_status status = read_lines(variable, &lines, err);
    hs_lines_close(&lines);
    return status;
}
