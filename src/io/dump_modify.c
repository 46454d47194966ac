/* The command dump_modify. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "io/dump_table.h"
#include "io/user_format.h"

const hs_keyword hs_dump_modify_keywords[] = {
    {"acolor", 2, "<types> <colour>", "style image: colour of atom types; colours between / go round over the types"},
    {"adiam", 2, "<types> <diameter>", "style image: diameter of atom types, distance"},
    {"amap", -1, "<lo> <hi> <style> <delta> <N> <entries> | <lo> <hi> viridis|coolwarm|gray",
     "style image: colours of numbers, see dump image"},
    {"append", 1, "yes|no", "add to an existing file instead of emptying it (default no)"},
    {"backcolor", 1, "<colour>", "style image: colour of the background (default black)"},
    {"boxcolor", 1, "<colour>", "style image: colour of the box (default yellow)"},
    {"buffer", 1, "yes|no", "accepted: output is always buffered until a snapshot is whole"},
    {"color", 4, "<name> <red> <green> <blue>", "style image: a new colour name, from parts from 0 to 1"},
    {"compress", 1, "<level>", "style h5md: compress with zlib, 0 (not at all, the default) to 9"},
    {"delay", 1, "<step>", "write nothing before this step"},
    {"element", -1, "<name of type 1> <name of type 2> ...",
     "names of the types for xyz files and the attribute element"},
    {"every", 1, "<N>|v_<name>",
     "steps between snapshots, or an equal-style variable that gives the step of the next one"},
    {"first", 1, "yes|no",
     "write a snapshot at the first step of the dump's first run even if it is not due (default no)"},
    {"flush", 1, "yes|no", "accepted: every snapshot goes to the system when it is whole"},
    {"format", -1, "<line 'formats' | int format | float format | N format | none>", "printf formats of the columns"},
    {"header", 1, "yes|no", "write the lines above the rows (default yes)"},
    {"image", 1, "yes|no", "style atom: columns ix iy iz (default no)"},
    {"label", 1, "<word>", "style local: what the rows are called above them (default ENTRIES)"},
    {"maxfiles", 1, "<N>", "keep only the last N files of a name with *; -1: all (default)"},
    {"pad", 1, "<digits>", "leading zeros of the step in file names"},
    {"pbc", 1, "yes|no", "write the atoms' images in the box: places, image numbers, velocities (default no)"},
    {"region", 1, "<region | none>", "only atoms in the region"},
    {"scale", 1, "yes|no", "style atom: positions scaled to 0 ... 1 (default yes)"},
    {"sort", 1, "<off | id | N | -N>", "order of rows: in memory, by id (default), or by column N up or down"},
    {"thresh", -1, "<attribute> <comparison> <value>|LAST | none",
     "only atoms that meet the condition, and all other ones; LAST: what the attribute was for this atom in the "
     "snapshot before (in the first one: what it is)"},
    {"time", 1, "yes|no", "write the simulated time (default no)"},
    {"units", 1, "yes|no", "write the unit system at the head of a file (default no)"},
    {"unwrap", 1, "yes|no", "style dcd: places unwrapped by the atoms' images (default no)"},
    {NULL, 0, NULL, NULL},
};

static hs_status modify_element(hs_dump *dump, const hs_args *args, int *n_used, hs_error *err)
{
    hs_dump_table *table = dump->state;
    const int n_types = dump->env->atoms->n_types;
    if (args->n < 1 + n_types)
        return hs_fail(err, HS_ERROR_INPUT, "%s: element needs a name for each of the %d atom types", args->command,
                       n_types);
    for (int k = 0; k < table->n_elements; ++k) HS_FREE(table->element[k]);
    table->n_elements = 0;
    HS_TRY(HS_GROW(table->element, 0, (size_t)n_types, err));
    for (int k = 0; k < n_types; ++k) {
        HS_TRY(hs_memory_strdup(&table->element[k], args->word[1 + k], err));
        table->n_elements = k + 1;
    }
    *n_used = 1 + n_types;
    return HS_OK;
}

static hs_status set_format(char **target, const hs_args *args, hs_format_kind kind, hs_error *err)
{
    char *normalized;
    HS_TRY(hs_format_normalize(&normalized, args->word[2], kind, "dump_modify format", err));
    HS_FREE(normalized);
    return hs_memory_replace(target, args->word[2], err);
}

/** format N S: the format of one column. */
static hs_status modify_column_format(hs_dump_table *table, const hs_args *args, hs_error *err)
{
    int64_t k;
    if (!hs_text_to_int64(args->word[1], &k)) {
        static const char *const words[] = {"line", "int", "float", "none", NULL};
        return hs_arg_refuse(args, 1, "line, int, float, none or a column number", words, err);
    }
    if (k < 1 || k > table->n_columns)
        return hs_fail(err, HS_ERROR_INPUT, "%s: format %lld: the columns are 1 to %d", args->command, (long long)k,
                       table->n_columns);
    hs_dump_column *column = &table->column[k - 1];
    const hs_format_kind kind = column->attribute == HS_ATTR_ELEMENT ? HS_FORMAT_STRING
                                : hs_dump_is_int(column)             ? HS_FORMAT_INT
                                                                     : HS_FORMAT_FLOAT;
    return set_format(&column->user_format, args, kind, err);
}

static hs_status modify_format(hs_dump *dump, const hs_args *args, int *n_used, hs_error *err)
{
    hs_dump_table *table = dump->state;
    HS_TRY(hs_arg_need(args, 1, "a word after format (line, int, float, a column number, none)", err));
    *n_used = 2;
    if (strcmp(args->word[1], "none") == 0) {
        HS_FREE(table->format_line);
        HS_FREE(table->format_int);
        HS_FREE(table->format_float);
        for (int k = 0; k < table->n_columns; ++k) HS_FREE(table->column[k].user_format);
        return HS_OK;
    }
    *n_used = 3;
    HS_TRY(hs_arg_need(args, 2, "the format itself", err));
    if (strcmp(args->word[1], "line") == 0) {
        if (hs_format_class(args->word[2]) == 0) return hs_arg_refuse(args, 2, "a line of printf formats", NULL, err);
        return hs_memory_replace(&table->format_line, args->word[2], err);
    }
    if (!table->layout->has_column_formats)
        return hs_fail(err, HS_ERROR_INPUT, "%s: dumps of style %s take only format line and format none",
                       args->command, dump->style->about.name);
    if (strcmp(args->word[1], "int") == 0) return set_format(&table->format_int, args, HS_FORMAT_INT, err);
    if (strcmp(args->word[1], "float") == 0) return set_format(&table->format_float, args, HS_FORMAT_FLOAT, err);
    return modify_column_format(table, args, err);
}

static void fini_condition(hs_dump *dump, hs_dump_condition *condition)
{
    hs_dump_last *last = condition->last;
    hs_dump_fini_column(&condition->column);
    if (last != NULL && last->values != NULL) hs_atoms_remove_field(dump->env->atoms, (void **)&last->values);
    if (last != NULL) HS_FREE(last->name);
    HS_FREE(condition->last);
}

void hs_dump_clear_conditions(hs_dump *dump)
{
    hs_dump_table *table = dump->state;
    for (int k = 0; k < table->n_conditions; ++k) fini_condition(dump, &table->condition[k]);
    table->n_conditions = 0;
}

/** Values of the latest snapshot, of which there is none yet, for condition k. */
static hs_status add_last(hs_dump *dump, hs_dump_condition *condition, int k, hs_error *err)
{
    hs_atoms *atoms = dump->env->atoms;
    hs_text name = {0};
    HS_TRY(HS_ALLOC(condition->last, 1, err));
    hs_dump_last *last = condition->last;
    hs_status status = hs_text_printf(&name, err, "dump %s last %d", dump->id, k + 1);
    if (status == HS_OK) status = hs_memory_strdup(&last->name, hs_text_get(&name), err);
    hs_text_fini(&name);
    HS_TRY(status);
    HS_TRY(hs_atoms_add_field(atoms, last->name, (void **)&last->values, sizeof *last->values, false, err));
    for (int i = 0; i < atoms->n_local; ++i) last->values[i] = NAN;
    return HS_OK;
}

static hs_status check_condition(const hs_dump *dump, const hs_dump_condition *condition, const hs_args *args,
                                 hs_error *err)
{
    HS_TRY(hs_attribute_check(condition->column.attribute, dump->env->atoms, err));
    if (condition->column.attribute != HS_ATTR_ELEMENT) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "%s: thresh compares numbers; use type instead of element", args->command);
}

static hs_status modify_thresh(hs_dump *dump, const hs_args *args, int *n_used, hs_error *err)
{
    hs_dump_table *table = dump->state;
    hs_dump_condition condition = {.last = NULL};
    HS_TRY(hs_arg_need(args, 1, "the attribute after thresh", err));
    if (strcmp(args->word[1], "none") == 0) {
        hs_dump_clear_conditions(dump);
        *n_used = 2;
        return HS_OK;
    }
    *n_used = 4;
    HS_TRY(hs_arg_need(args, 3, "the attribute, comparison and value after thresh", err));
    HS_TRY(hs_arg_comparison(args, 2, &condition.how, err));
    const bool is_last = strcmp(args->word[3], "LAST") == 0;
    if (!is_last) HS_TRY(hs_arg_double(args, 3, &condition.value, err));
    HS_TRY(HS_GROW(table->condition, (size_t)table->n_conditions, (size_t)table->n_conditions + 1, err));
    if (strchr(args->word[1], '*') != NULL)
        return hs_arg_refuse(args, 1, "one value: c_ID, c_ID[i], f_ID, f_ID[i] or v_name", NULL, err);
    HS_TRY(hs_dump_parse_column(args->word[1], &condition.column, err));
    hs_status status = check_condition(dump, &condition, args, err);
    if (status == HS_OK && is_last) status = add_last(dump, &condition, table->n_conditions, err);
    if (status == HS_OK)
        table->condition[table->n_conditions++] = condition;
    else
        fini_condition(dump, &condition);
    return status;
}

static hs_status modify_sort(hs_dump_table *table, const hs_args *args, hs_error *err)
{
    int64_t k = 0;
    const bool is_number = hs_text_to_int64(args->word[1], &k);
    table->is_unsorted = strcmp(args->word[1], "off") == 0;
    if (!table->is_unsorted && strcmp(args->word[1], "id") != 0 &&
        (!is_number || k == 0 || k > 100000 || k < -100000)) {
        static const char *const words[] = {"id", "off", NULL};
        return hs_arg_refuse(args, 1, "id, off, a column number, or minus a column number", words, err);
    }
    table->sort_column = (int)(k < 0 ? -k : k);
    table->is_descending = k < 0;
    return HS_OK;
}

static hs_status modify_number(hs_dump *dump, const hs_args *args, bool *is_mine, hs_error *err)
{
    hs_dump_table *table = dump->state;
    int64_t value;
    *is_mine = true;
    if (strcmp(args->word[0], "every") == 0) return hs_dump_read_every(dump, args, err);
    if (strcmp(args->word[0], "delay") == 0) return hs_arg_int(args, 1, -1, INT64_MAX, &table->delay, err);
    if (strcmp(args->word[0], "pad") == 0) {
        HS_TRY(hs_arg_int(args, 1, 0, 18, &value, err));
        table->pad = (int)value;
        return HS_OK;
    }
    *is_mine = strcmp(args->word[0], "maxfiles") == 0;
    if (!*is_mine) return HS_OK;
    HS_TRY(hs_arg_int(args, 1, -1, 1000000, &value, err));
    if (value == 0) return hs_arg_refuse(args, 1, "-1, or 1 or more", NULL, err);
    if (strchr(dump->file, '*') == NULL)
        return hs_fail(err, HS_ERROR_INPUT, "%s: maxfiles needs a file name with *, one file a snapshot",
                       args->command);
    HS_FREE(table->recent);
    table->n_recent = 0;
    table->max_files = value;
    return HS_OK;
}

/** Keywords that are yes or no. */
static hs_status modify_switch(hs_dump *dump, const hs_args *args, bool *is_mine, hs_error *err)
{
    hs_dump_table *table = dump->state;
    bool is_header = !table->no_header, is_ignored;
    const struct {
        const char *name;
        bool *target;
        bool is_atom_style;
    } switches[] = {
        {"append", &dump->append, false},    {"buffer", &is_ignored, false},     {"first", &dump->write_first, false},
        {"flush", &dump->flush, false},      {"header", &is_header, false},      {"image", &table->has_image, true},
        {"pbc", &dump->wrap, false},         {"scale", &table->is_scaled, true}, {"time", &table->has_time, false},
        {"units", &table->has_units, false},
    };
    *is_mine = false;
    for (size_t k = 0; k < sizeof switches / sizeof switches[0]; ++k) {
        if (strcmp(switches[k].name, args->word[0]) != 0) continue;
        *is_mine = true;
        if (switches[k].is_atom_style && !table->layout->has_scale_image)
            return hs_fail(err, HS_ERROR_INPUT, "%s: %s is for dumps of style atom; in style custom choose the columns",
                           args->command, args->word[0]);
        HS_TRY(hs_arg_bool(args, 1, switches[k].target, err));
        table->no_header = !is_header;
        if (dump->append && table->is_open && strcmp(args->word[0], "append") == 0)
            return hs_fail(err, HS_ERROR_INPUT, "%s: append must be set before the first run of the dump",
                           args->command);
        return HS_OK;
    }
    return HS_OK;
}

hs_status hs_dump_table_modify(hs_dump *dump, const hs_args *args, int *n_used, hs_error *err)
{
    hs_dump_table *table = dump->state;
    const char *keyword = args->word[0];
    bool is_mine;
    if (strcmp(keyword, "element") == 0) return modify_element(dump, args, n_used, err);
    if (strcmp(keyword, "format") == 0) return modify_format(dump, args, n_used, err);
    if (strcmp(keyword, "thresh") == 0) return modify_thresh(dump, args, n_used, err);
    HS_TRY(hs_arg_need(args, 1, "the value after the keyword", err));
    *n_used = 2;
    HS_TRY(modify_switch(dump, args, &is_mine, err));
    if (!is_mine) HS_TRY(modify_number(dump, args, &is_mine, err));
    if (is_mine) return HS_OK;
    if (strcmp(keyword, "sort") == 0) return modify_sort(table, args, err);
    if (strcmp(keyword, "region") != 0) {
        *n_used = 0;
        return HS_OK;
    }
    if (strcmp(args->word[1], "none") == 0) {
        hs_where_fini(&table->where);
        return HS_OK;
    }
    if (dump->env->find_region(dump->env, args->word[1]) == NULL)
        return hs_fail(err, HS_ERROR_INPUT, "%s: there is no region '%s'", args->command, args->word[1]);
    return hs_where_set(&table->where, args->word[1], err);
}

hs_status hs_dump_modify(hs_dump *dump, const hs_args *args, hs_error *err)
{
    const hs_syntax syntax = {.usage = "<keyword> <value> ...", .keywords = hs_dump_modify_keywords};
    HS_TRY(hs_syntax_check(&syntax, args, false, err));
    for (int i = 0, n_used; i < args->n; i += n_used) {
        const hs_args rest = hs_args_from(args, i, NULL);
        HS_TRY(dump->style->modify(dump, &rest, &n_used, err));
        if (n_used == 0)
            return hs_fail(err, HS_ERROR_INPUT, "%s: '%s' is not a keyword of dumps of style %s", args->command,
                           args->word[i], dump->style->about.name);
    }
    return HS_OK;
}
