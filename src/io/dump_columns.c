/* Values of atoms that dumps can write. */
#include <string.h>

#include "base/memory.h"
#include "io/dump_table.h"

/** Its name, and what it refers to if it does. */
static hs_status name_column(hs_dump_column *column, const char *word, hs_error *err)
{
    if (column->attribute == HS_ATTR_VARIABLE && strchr(word, '*') == NULL) {
        const hs_args args = {.command = "dump", .n = 1, .word = &word};
        hs_value *reference;
        int n;
        HS_TRY(hs_values_read(&reference, &n, NULL, &args, 0, 1, HS_VALUE_ATOMS, err));
        column->reference = *reference;
        HS_FREE(reference);
    }
    return hs_memory_strdup(&column->name, word, err);
}

hs_status hs_dump_parse_column(const char *word, hs_dump_column *column, hs_error *err)
{
    memset(column, 0, sizeof *column);
    column->attribute = HS_ATTR_VARIABLE;
    for (int k = 0; k < HS_N_ATTRIBUTES; ++k)
        if (strcmp(hs_attributes[k], word) == 0) column->attribute = (hs_attribute)k;
    if (column->attribute == HS_ATTR_VARIABLE && !hs_value_is_reference(word)) {
        if (strcmp(word, "mol") == 0)
            return hs_fail(err, HS_ERROR_INPUT,
                           "'mol' needs an atom style with molecules; atoms of style atomic have none");
        const char *nearest = hs_text_nearest(word, hs_attributes, HS_N_ATTRIBUTES);
        return hs_fail(err, HS_ERROR_INPUT, "unknown attribute '%s'%s%s%s", word,
                       nearest != NULL ? "; did you mean '" : "", nearest != NULL ? nearest : "",
                       nearest != NULL ? "'?" : "");
    }
    return name_column(column, word, err);
}

hs_status hs_dump_parse_local_column(const char *word, hs_dump_column *column, hs_error *err)
{
    memset(column, 0, sizeof *column);
    column->attribute = strcmp(word, "index") == 0 ? HS_ATTR_ID : HS_ATTR_VARIABLE;
    if (column->attribute == HS_ATTR_VARIABLE && (!hs_value_is_reference(word) || strchr("cf", word[0]) == NULL))
        return hs_fail(err, HS_ERROR_INPUT,
                       "'%s' is not a local value: index, or c_ID or c_ID[i] of a compute that has some", word);
    return name_column(column, word, err);
}

/** Fail unless words i to i + n - 1 are what @p parse takes for columns. */
static hs_status check_words(const hs_args *args, int i, int n,
                             hs_status (*parse)(const char *word, hs_dump_column *column, hs_error *err), hs_error *err)
{
    for (int k = i; k < i + n && k < args->n; ++k) {
        hs_dump_column column;
        hs_error cause = {0};
        if (strchr(args->word[k], '$') != NULL) continue;
        const hs_status status = parse(args->word[k], &column, &cause);
        if (status != HS_OK) return hs_fail(err, status, "%s: %s", args->command, cause.text);
        hs_dump_fini_column(&column);
    }
    return HS_OK;
}

hs_status hs_dump_check_words(const hs_args *args, int i, int n, hs_error *err)
{
    return check_words(args, i, n, hs_dump_parse_column, err);
}

hs_status hs_dump_check_local_words(const hs_args *args, hs_error *err)
{
    return check_words(args, 0, args->n, hs_dump_parse_local_column, err);
}

void hs_dump_fini_column(hs_dump_column *column)
{
    HS_FREE(column->name);
    hs_value_fini(&column->reference);
    HS_FREE(column->values);
    HS_FREE(column->user_format);
    HS_FREE(column->format);
}

bool hs_dump_is_int(const hs_dump_column *column)
{
    if (column->attribute == HS_ATTR_VARIABLE && column->reference.kind == 'i') return true;
    switch (column->attribute) {
    case HS_ATTR_ID:
    case HS_ATTR_TYPE:
    case HS_ATTR_PROC:
    case HS_ATTR_PROCP1:
    case HS_ATTR_IX:
    case HS_ATTR_IY:
    case HS_ATTR_IZ:
        return true;
    default:
        return false;
    }
}

hs_status hs_dump_write_name(const hs_dump_column *column, hs_writer *writer, hs_error *err)
{
    for (const char *c = column->name; *c != '\0'; ++c)
        if (*c != ']') HS_TRY(hs_writer_bytes(writer, *c == '[' ? "_" : c, 1, err));
    return HS_OK;
}

double hs_dump_value(const hs_dump *dump, const hs_dump_column *column, int i)
{
    const hs_dump_table *table = dump->state;
    if (column->attribute == HS_ATTR_VARIABLE) return column->values[i];
    if (table->is_local) return (double)(table->first_row + i + 1);
    return hs_attribute_value(dump->env, column->attribute, dump->wrap, i);
}
