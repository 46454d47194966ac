/* Number formats of thermo output: thermo_modify format, else those of the style. */

#include "base/memory.h"
#include "io/user_format.h"
#include "sim/thermo_internal.h"

/** The words of thermo_modify format line, one for each column; *words is owned by the caller. */
static hs_status split_line(const hs_thermo *thermo, char **words, char **word, hs_error *err)
{
    int n = 0;
    HS_TRY(hs_memory_strdup(words, thermo->format_line, err));
    char *rest = NULL;
    for (char *at = strtok_r(*words, " \t", &rest); at != NULL; at = strtok_r(NULL, " \t", &rest)) {
        if (n < thermo->n_columns) word[n] = at;
        ++n;
    }
    if (n == thermo->n_columns) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "thermo_modify format line: the format has %d words but a row has %d columns",
                   n, thermo->n_columns);
}

/** In LAMMPS's order: the column's own format, then that for its kind of number, then the line's, then the default. */
static const char *choose_format(const hs_thermo *thermo, const hs_thermo_column *column, const char *line_word)
{
    const bool is_int = hs_thermo_is_int(column);
    const char *of_kind = is_int ? thermo->format_int : thermo->format_float;
    if (column->user_format != NULL) return column->user_format;
    if (of_kind != NULL) return of_kind;
    if (line_word != NULL) return line_word;
    if (thermo->is_multi_line) return is_int ? "%14d" : "%14.4f";
    return is_int ? "%8d" : "%12.8g";
}

static hs_status make_formats(hs_thermo *thermo, char **word, hs_error *err)
{
    for (int k = 0; k < thermo->n_columns; ++k) {
        hs_thermo_column *column = &thermo->column[k];
        const char *chosen = choose_format(thermo, column, word[k]);
        HS_FREE(column->format);
        HS_TRY(hs_format_normalize(&column->format, chosen, hs_thermo_is_int(column) ? HS_FORMAT_INT : HS_FORMAT_FLOAT,
                                   "thermo_modify format", err));
    }
    return HS_OK;
}

hs_status hs_thermo_make_formats(hs_thermo *thermo, hs_error *err)
{
    char *words = NULL, **word;
    HS_TRY(HS_ALLOC(word, (size_t)thermo->n_columns, err));
    hs_status status = thermo->format_line != NULL ? split_line(thermo, &words, word, err) : HS_OK;
    if (status == HS_OK) status = make_formats(thermo, word, err);
    HS_FREE(words);
    HS_FREE(word);
    return status;
}
