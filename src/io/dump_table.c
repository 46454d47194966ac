/* Snapshots of atoms: formats, headers, rows, files. */
#include "io/dump_table.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "base/memory.h"
#include "io/user_format.h"

static void clear_columns(hs_dump_table *table)
{
    for (int k = 0; k < table->n_columns; ++k) hs_dump_fini_column(&table->column[k]);
    HS_FREE(table->column);
    table->n_columns = 0;
    hs_text_clear(&table->header);
}

static hs_status add_column(hs_dump *dump, const hs_args *args, const char *word, hs_error *err)
{
    hs_dump_table *table = dump->state;
    HS_TRY(HS_GROW(table->column, (size_t)table->n_columns, (size_t)table->n_columns + 1, err));
    hs_dump_column *added = &table->column[table->n_columns];
    hs_status status =
        table->is_local ? hs_dump_parse_local_column(word, added, err) : hs_dump_parse_column(word, added, err);
    if (status == HS_OK) status = hs_attribute_check(added->attribute, dump->env->atoms, err);
    if (status != HS_OK) {
        hs_dump_fini_column(added);
        hs_error cause = *err;
        hs_error_clear(err);
        return hs_fail(err, cause.status, "%s: %s", args->command, cause.text);
    }
    const hs_dump_column *column = &table->column[table->n_columns++];
    if (column->attribute == HS_ATTR_VARIABLE)
        HS_TRY(hs_value_check(dump->env, &column->reference, hs_dump_shape(table), args->command, err));
    return hs_text_printf(&table->header, err, " %s", word);
}

hs_status hs_dump_set_columns(hs_dump *dump, const hs_args *args, hs_error *err)
{
    hs_dump_table *table = dump->state;
    clear_columns(table);
    for (int i = 0; i < args->n; ++i) {
        if (!hs_value_is_reference(args->word[i]) || strchr(args->word[i], '*') == NULL) {
            HS_TRY(add_column(dump, args, args->word[i], err));
            continue;
        }
        /* c_ID[*]: a column for each */
        hs_value *values;
        int n;
        HS_TRY(hs_values_read(&values, &n, dump->env, args, i, 1, hs_dump_shape(table), err));
        hs_status status = HS_OK;
        for (int k = 0; k < n && status == HS_OK; ++k) status = add_column(dump, args, values[k].word, err);
        hs_values_destroy(&values, n);
        HS_TRY(status);
    }
    return HS_OK;
}

hs_status hs_dump_table_begin(hs_dump *dump, const hs_args *args, const hs_dump_layout *layout, hs_error *err)
{
    hs_dump_table *table = dump->state;
    table->layout = layout;
    table->delay = table->max_files = -1;
    return hs_syntax_check(&dump->style->about.syntax, args, false, err);
}

void hs_dump_table_destroy(hs_dump *dump)
{
    hs_dump_table *table = dump->state;
    hs_writer_abandon(&table->writer); /* every snapshot was committed when it was written */
    clear_columns(table);
    hs_text_fini(&table->header);
    for (int k = 0; k < table->n_elements; ++k) HS_FREE(table->element[k]);
    HS_FREE(table->element);
    HS_FREE(table->format_line);
    HS_FREE(table->format_int);
    HS_FREE(table->format_float);
    HS_FREE(table->label);
    hs_where_fini(&table->where);
    hs_dump_clear_conditions(dump);
    HS_FREE(table->condition);
    HS_FREE(table->recent);
    HS_FREE(table->order);
}

/** Text columns: the name of a type. */
static bool is_text(const hs_dump_table *table, int k)
{
    return table->column[k].attribute == HS_ATTR_ELEMENT || (table->layout->is_element_first && k == 0);
}

static hs_format_kind kind_of(const hs_dump_table *table, int k)
{
    if (is_text(table, k)) return HS_FORMAT_STRING;
    return hs_dump_is_int(&table->column[k]) ? HS_FORMAT_INT : HS_FORMAT_FLOAT;
}

/** In LAMMPS's order: the column's own format, then that of its kind, then the line's, then the default. */
static hs_status make_format(hs_dump *dump, int k, const char *line_word, hs_error *err)
{
    hs_dump_table *table = dump->state;
    const char *const float_format = table->layout->float_format;
    const char *const defaults[] = {"%d", float_format != NULL ? float_format : "%g", "%s"};
    const bool is_line = k < table->layout->n_line_columns;
    hs_dump_column *column = &table->column[k];
    const hs_format_kind kind = kind_of(table, k);
    const char *of_kind = kind == HS_FORMAT_INT     ? table->format_int
                          : kind == HS_FORMAT_FLOAT ? table->format_float
                                                    : NULL;
    const char *chosen = is_line                       ? (kind == HS_FORMAT_FLOAT ? "%f" : defaults[kind])
                         : column->user_format != NULL ? column->user_format
                         : of_kind != NULL             ? of_kind
                         : line_word != NULL           ? line_word
                                                       : defaults[kind];
    HS_FREE(column->format);
    return hs_format_normalize(&column->format, chosen, kind, "dump_modify format", err);
}

static hs_status make_formats(hs_dump *dump, hs_error *err)
{
    hs_dump_table *table = dump->state;
    char *words = NULL, *rest = NULL;
    hs_status status = HS_OK;
    if (table->format_line != NULL) HS_TRY(hs_memory_strdup(&words, table->format_line, err));
    char *word = words != NULL ? strtok_r(words, " \t", &rest) : NULL;
    for (int k = 0; k < table->n_columns && status == HS_OK; ++k) {
        if (words != NULL && word == NULL)
            status = hs_fail(err, HS_ERROR_INPUT, "%s: the format line has %d words but a row has %d columns",
                             hs_dump_who(dump).text, k, table->n_columns);
        else
            status = make_format(dump, k, word, err);
        if (word != NULL) word = strtok_r(NULL, " \t", &rest);
    }
    if (status == HS_OK && word != NULL)
        status = hs_fail(err, HS_ERROR_INPUT, "%s: the format line has more words than a row has columns (%d)",
                         hs_dump_who(dump).text, table->n_columns);
    HS_FREE(words);
    return status;
}

static bool is_file_per_step(const hs_dump *dump) { return strchr(dump->file, '*') != NULL || dump->is_single; }

/** The compute, fix or variable must be there and have values per atom, or local ones. */
static hs_status check_reference(hs_dump *dump, const hs_dump_column *column, hs_error *err)
{
    if (column->attribute != HS_ATTR_VARIABLE) return HS_OK;
    return hs_value_check(dump->env, &column->reference, hs_dump_shape(dump->state), hs_dump_who(dump).text, err);
}

/** The file that all snapshots go to; one of a resumed run is cut to where it was then. */
static hs_status open_growing(hs_dump *dump, hs_error *err)
{
    hs_dump_table *table = dump->state;
    HS_TRY(hs_writer_open(&table->writer, dump->file, dump->append ? HS_WRITE_APPEND : HS_WRITE_REPLACE, err));
    if (!dump->is_resumed || dump->resume_at < 0) return HS_OK;
    table->units_written = dump->resume_at > 0;
    return hs_writer_cut(table->writer, dump->resume_at, err);
}

hs_status hs_dump_table_init(hs_dump *dump, hs_error *err)
{
    hs_dump_table *table = dump->state;
    const hs_env *env = dump->env;
    HS_TRY(hs_where_find(&table->where, dump->env, hs_dump_who(dump).text, err));
    if (table->n_elements > 0 && table->n_elements != env->atoms->n_types)
        return hs_fail(err, HS_ERROR_INPUT, "%s: dump_modify element gave %d names, but there are %d atom types",
                       hs_dump_who(dump).text, table->n_elements, env->atoms->n_types);
    if (table->sort_column > table->n_columns)
        return hs_fail(err, HS_ERROR_INPUT, "%s: dump_modify sort %d: a row has %d columns", hs_dump_who(dump).text,
                       table->sort_column, table->n_columns);
    for (int k = 0; k < table->n_columns; ++k) HS_TRY(check_reference(dump, &table->column[k], err));
    for (int k = 0; k < table->n_conditions; ++k) HS_TRY(check_reference(dump, &table->condition[k].column, err));
    HS_TRY(make_formats(dump, err));
    if (env->dry_run || is_file_per_step(dump) || table->is_open) return HS_OK;
    if (env->parallel->rank == 0) HS_UNLESS_FAILED(err, open_growing(dump, err));
    HS_TRY(hs_parallel_agree(env->parallel, err));
    table->is_open = true;
    return HS_OK;
}

static hs_status write_xyz_header(const hs_dump *dump, hs_writer *writer, hs_error *err)
{
    const hs_dump_table *table = dump->state;
    return hs_writer_printf(writer, err, "%lld\nAtoms. Timestep: %lld\n", (long long)table->n_rows_all,
                            (long long)dump->env->step);
}

static hs_status write_item_header(hs_dump *dump, hs_writer *writer, hs_error *err)
{
    hs_dump_table *table = dump->state;
    const hs_env *env = dump->env;
    const hs_box *box = env->box;
    const char *rows = !table->is_local ? "ATOMS" : table->label != NULL ? table->label : "ENTRIES";
    if (table->has_units && !table->units_written)
        HS_TRY(hs_writer_printf(writer, err, "ITEM: UNITS\n%s\n", env->units->name));
    table->units_written = !is_file_per_step(dump);
    if (table->has_time)
        HS_TRY(hs_writer_printf(writer, err, "ITEM: TIME\n%.16g\n",
                                env->time_origin + (double)(env->step - env->time_origin_step) * env->dt));
    HS_TRY(hs_writer_printf(writer, err, "ITEM: TIMESTEP\n%lld\nITEM: NUMBER OF %s\n%lld\nITEM: BOX BOUNDS",
                            (long long)env->step, rows, (long long)table->n_rows_all));
    if (box->is_tilted) HS_TRY(hs_writer_printf(writer, err, " xy xz yz"));
    for (int axis = 0; axis < 3; ++axis)
        HS_TRY(hs_writer_printf(writer, err, " %c%c", box->boundary[axis][0], box->boundary[axis][1]));
    double lo[3], hi[3];
    hs_box_bounds(box, lo, hi);
    for (int axis = 0; axis < 3; ++axis) {
        HS_TRY(hs_writer_printf(writer, err, "\n%-1.16e %-1.16e", lo[axis], hi[axis]));
        if (box->is_tilted) HS_TRY(hs_writer_printf(writer, err, " %-1.16e", box->tilt[axis]));
    }
    return hs_writer_printf(writer, err, "\nITEM: %s%s\n", rows, hs_text_get(&table->header));
}

/** The name of an atom's type: dump_modify element; else its number in xyz files, "C" in others, as LAMMPS has it. */
static hs_status append_type_name(const hs_dump *dump, const hs_dump_column *column, int i, hs_text *text,
                                  hs_error *err)
{
    const hs_dump_table *table = dump->state;
    const int type = dump->env->atoms->type[i];
    char number[16];
    if (table->n_elements > 0) return hs_text_printf(text, err, column->format, table->element[type - 1]);
    if (!table->layout->is_element_first)
        return hs_text_printf(text, err, column->format, table->layout->unnamed != NULL ? table->layout->unnamed : "C");
    snprintf(number, sizeof number, "%d", type);
    return hs_text_printf(text, err, column->format, number);
}

/** A value as it is written: places of layouts that have a spread. */
static double spread_value(const hs_dump_table *table, int k, double value)
{
    const hs_dump_layout *layout = table->layout;
    const bool is_place = k >= layout->n_line_columns && k < layout->n_line_columns + 3;
    return layout->spread > 0.0 && is_place ? (value - 0.5) / layout->spread + 0.5 : value;
}

static hs_status append_row(const void *context, int64_t row, hs_text *text, hs_error *err)
{
    const hs_dump *dump = context;
    const hs_dump_table *table = dump->state;
    const int i = table->order[row];
    for (int k = 0; k < table->n_columns; ++k) {
        const hs_dump_column *column = &table->column[k];
        const char *between = k <= table->layout->n_line_columns ? " \n" : " ";
        if (k > 0) HS_TRY(hs_text_append(text, between, strlen(between), err));
        if (is_text(table, k))
            HS_TRY(append_type_name(dump, column, i, text, err));
        else if (hs_dump_is_int(column))
            HS_TRY(hs_text_printf(text, err, column->format, (long long)hs_dump_value(dump, column, i)));
        else
            HS_TRY(hs_text_printf(text, err, column->format, spread_value(table, k, hs_dump_value(dump, column, i))));
    }
    return hs_text_append(text, "\n", 1, err);
}

static hs_status write_header(hs_dump *dump, hs_writer *writer, hs_error *err)
{
    const hs_dump_layout *layout = ((const hs_dump_table *)dump->state)->layout;
    if (layout->write_header != NULL) return layout->write_header(dump, writer, err);
    return layout->has_atom_header ? write_item_header(dump, writer, err) : write_xyz_header(dump, writer, err);
}

/** Header and rows into the first rank's file (collective). */
static hs_status write_snapshot(hs_dump *dump, hs_writer *writer, hs_error *err)
{
    const hs_dump_table *table = dump->state;
    HS_UNLESS_FAILED(err, hs_dump_select(dump, err));
    if (!table->no_header && writer != NULL) HS_UNLESS_FAILED(err, write_header(dump, writer, err));
    const hs_text_rows rows = {.n = table->n_rows,
                               .is_descending = table->is_descending,
                               .by_rank = table->is_unsorted,
                               .key = hs_dump_key,
                               .format = append_row,
                               .context = dump};
    return hs_text_rows_write(&rows, writer, dump->env->parallel, err);
}

/** dump_modify maxfiles: remember the new file and delete the one written max_files snapshots ago. */
static hs_status keep_recent(hs_dump *dump, hs_error *err)
{
    hs_dump_table *table = dump->state;
    if (table->max_files < 0) return HS_OK;
    if (table->recent == NULL) HS_TRY(HS_ALLOC(table->recent, (size_t)table->max_files, err));
    int64_t *slot = &table->recent[table->n_recent % table->max_files];
    if (table->n_recent++ >= table->max_files && *slot != dump->env->step && dump->env->parallel->rank == 0) {
        char *name = NULL;
        HS_TRY(hs_writer_step_name(&name, dump->file, *slot, table->pad, err));
        unlink(name);
        HS_FREE(name);
    }
    *slot = dump->env->step;
    return HS_OK;
}

hs_status hs_dump_table_keep(hs_dump *dump, hs_state *state, hs_error *err)
{
    static const char count[] = "files written";
    hs_dump_table *table = dump->state;
    if (table->max_files < 0 || (state->is_reading && hs_state_find(state, count) == NULL)) return HS_OK;
    HS_TRY(hs_state_int64(state, count, &table->n_recent, 1, err));
    if (table->n_recent < 0) table->n_recent = 0; /* no program has written this */
    if (table->n_recent == 0) return HS_OK;
    if (table->recent == NULL) HS_TRY(HS_ALLOC(table->recent, (size_t)table->max_files, err));
    const int64_t n_kept = table->n_recent < table->max_files ? table->n_recent : table->max_files;
    return hs_state_int64(state, "steps of files", table->recent, n_kept, err);
}

hs_status hs_dump_write_step_file(hs_dump *dump, hs_status (*write)(hs_dump *dump, hs_writer *writer, hs_error *err),
                                  hs_error *err)
{
    hs_dump_table *table = dump->state;
    const hs_parallel *parallel = dump->env->parallel;
    const bool is_mine = parallel->rank == 0;
    hs_writer *writer = NULL;
    char *name = NULL;
    if (is_mine) HS_UNLESS_FAILED(err, hs_writer_step_name(&name, dump->file, dump->env->step, table->pad, err));
    if (is_mine) HS_UNLESS_FAILED(err, hs_writer_open(&writer, name, HS_WRITE_WHOLE, err));
    hs_status status = hs_parallel_agree(parallel, err);
    if (status == HS_OK) status = write(dump, writer, err);
    if (status != HS_OK) hs_writer_abandon(&writer);
    if (is_mine) HS_UNLESS_FAILED(err, hs_writer_close(&writer, err));
    HS_FREE(name);
    HS_UNLESS_FAILED(err, keep_recent(dump, err));
    return hs_parallel_agree(parallel, err);
}

int64_t hs_dump_table_position(const hs_dump *dump)
{
    const hs_dump_table *table = dump->state;
    return table->writer != NULL ? hs_writer_committed(table->writer) : -1;
}

hs_status hs_dump_table_write(hs_dump *dump, hs_error *err)
{
    hs_dump_table *table = dump->state;
    if (dump->env->step == dump->last_written || dump->env->step < table->delay) return HS_OK;
    dump->last_written = dump->env->step;
    if (is_file_per_step(dump)) return hs_dump_write_step_file(dump, write_snapshot, err);
    const hs_status status = write_snapshot(dump, table->writer, err);
    if (status != HS_OK) {
        hs_writer_abandon(&table->writer);
        table->is_open = false;
        return status;
    }
    if (table->writer != NULL) HS_UNLESS_FAILED(err, hs_writer_commit(table->writer, err));
    return hs_parallel_agree(dump->env->parallel, err);
}
