/* dump extxyz: the extended xyz format, which says its box and its columns. */
#include <string.h>

#include "base/memory.h"
#include "io/dump_table.h"

/** Columns that every row begins with. */
static const char *const always[] = {"element", "x", "y", "z", "id", "type"};
enum { N_ALWAYS = sizeof always / sizeof always[0] };

/** Attributes that are one property when they stand side by side, by the names that readers look for. */
static const struct {
    const char *attribute[3], *name;
} triples[] = {{{"x", "y", "z"}, "pos"},         {{"vx", "vy", "vz"}, "velo"},
               {{"fx", "fy", "fz"}, "forces"},   {{"ix", "iy", "iz"}, "image"},
               {{"mux", "muy", "muz"}, "mu"},    {{"omegax", "omegay", "omegaz"}, "omega"},
               {{"xu", "yu", "zu"}, "unwrapped"}};

/** Name of the triple that begins at column k, NULL when none does. */
static const char *triple_at(const hs_dump_table *table, int k)
{
    for (size_t t = 0; t < sizeof triples / sizeof triples[0] && k + 3 <= table->n_columns; ++t) {
        bool is_it = true;
        for (int axis = 0; axis < 3; ++axis)
            is_it = is_it && strcmp(table->column[k + axis].name, triples[t].attribute[axis]) == 0;
        if (is_it) return triples[t].name;
    }
    return NULL;
}

/** `:name:kind:n` of each property; brackets are no part of a name, so that c_s[1] is c_s_1. */
static hs_status write_properties(const hs_dump_table *table, hs_writer *writer, hs_error *err)
{
    HS_TRY(hs_writer_printf(writer, err, "Properties=species:S:1"));
    for (int k = 1; k < table->n_columns;) {
        const hs_dump_column *column = &table->column[k];
        const char *triple = triple_at(table, k);
        const bool is_name = column->attribute == HS_ATTR_ELEMENT;
        HS_TRY(hs_writer_printf(writer, err, ":%s", triple != NULL ? triple : ""));
        if (triple == NULL) HS_TRY(hs_dump_write_name(column, writer, err));
        HS_TRY(hs_writer_printf(writer, err, ":%c:%d",
                                is_name                  ? 'S'
                                : hs_dump_is_int(column) ? 'I'
                                                         : 'R',
                                triple != NULL ? 3 : 1));
        k += triple != NULL ? 3 : 1;
    }
    return HS_OK;
}

static hs_status write_header(hs_dump *dump, hs_writer *writer, hs_error *err)
{
    const hs_dump_table *table = dump->state;
    const hs_env *env = dump->env;
    const hs_box *box = env->box;
    HS_TRY(hs_writer_printf(writer, err,
                            "%lld\nLattice=\"%.16g 0 0 %.16g %.16g 0 %.16g %.16g %.16g\" Origin=\"%.16g %.16g %.16g\" ",
                            (long long)table->n_rows_all, hs_box_length(box, 0), box->tilt[0], hs_box_length(box, 1),
                            box->tilt[1], box->tilt[2], hs_box_length(box, 2), box->lo[0], box->lo[1], box->lo[2]));
    HS_TRY(write_properties(table, writer, err));
    return hs_writer_printf(writer, err, " pbc=\"%c %c %c\" Step=%lld Time=%.16g\n", box->periodic[0] ? 'T' : 'F',
                            box->periodic[1] ? 'T' : 'F', box->periodic[2] ? 'T' : 'F', (long long)env->step,
                            env->time_origin + (double)(env->step - env->time_origin_step) * env->dt);
}

static const hs_dump_layout layout = {
    .write_header = write_header, .unnamed = "X", .float_format = "%.10g", .has_column_formats = true};

static hs_status check(const char *file, const hs_args *args, hs_error *err)
{
    (void)file;
    return hs_dump_check_words(args, 0, args->n, err);
}

static hs_status create(hs_dump *dump, const hs_args *args, hs_error *err)
{
    const char **word;
    HS_TRY(hs_dump_table_begin(dump, args, &layout, err));
    HS_TRY(HS_ALLOC(word, (size_t)(N_ALWAYS + args->n), err));
    for (int k = 0; k < N_ALWAYS; ++k) word[k] = always[k];
    for (int k = 0; k < args->n; ++k) word[N_ALWAYS + k] = args->word[k];
    const hs_args columns = {.command = "dump extxyz", .n = N_ALWAYS + args->n, .word = word};
    const hs_status status = hs_dump_set_columns(dump, &columns, err);
    hs_memory_free((void *)(uintptr_t)word);
    return status;
}

const hs_dump_style hs_dump_style_extxyz = {
    .about = {.name = "extxyz",
              .syntax = {.usage = "[attribute ...]", .n_min = 0, .n_max = -1},
              .summary = "positions and more in the extended xyz format, which ASE and OVITO read",
              .details =
                  "For each snapshot the number of atoms, a line that names the box (`Lattice`, `Origin`, `pbc`), the "
                  "columns (`Properties`), `Step` and `Time`, and a row for each atom: its species, `x y z` (distance "
                  "units), `id`, `type`, and the further attributes, which are those of `dump custom`. `vx vy vz` side "
                  "by side become the property `velo`, `fx fy fz` `forces`, `ix iy iz` `image`.\n\n"
                  "`dump_modify element` gives the types the names of elements; without it every species is `X`, which "
                  "readers take for an unknown element. Numbers have ten digits unless `dump_modify format float` says "
                  "otherwise.",
              .example = "dump d all extxyz 100 run.xyz vx vy vz\ndump_modify d element Ar"},
    .state_size = sizeof(hs_dump_table),
    .check = check,
    .create = create,
    .modify = hs_dump_table_modify,
    .destroy = hs_dump_table_destroy,
    .init = hs_dump_table_init,
    .position = hs_dump_table_position,
    .keep_state = hs_dump_table_keep,
    .write = hs_dump_table_write,
};
