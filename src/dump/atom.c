/* dump atom: id, type and position of every atom. */
#include "io/dump_table.h"

static const hs_dump_layout layout = {.has_atom_header = true, .has_scale_image = true};

/** The columns follow dump_modify scale and image. */
static hs_status set_columns(hs_dump *dump, hs_error *err)
{
    static const char *const scaled[] = {"id", "type", "xs", "ys", "zs", "ix", "iy", "iz"};
    static const char *const plain[] = {"id", "type", "x", "y", "z", "ix", "iy", "iz"};
    const hs_dump_table *table = dump->state;
    const hs_args columns = {
        .command = "dump atom", .n = table->has_image ? 8 : 5, .word = table->is_scaled ? scaled : plain};
    return hs_dump_set_columns(dump, &columns, err);
}

static hs_status create(hs_dump *dump, const hs_args *args, hs_error *err)
{
    HS_TRY(hs_dump_table_begin(dump, args, &layout, err));
    ((hs_dump_table *)dump->state)->is_scaled = true;
    return set_columns(dump, err);
}

static hs_status init(hs_dump *dump, hs_error *err)
{
    HS_TRY(set_columns(dump, err));
    return hs_dump_table_init(dump, err);
}

const hs_dump_style hs_dump_style_atom = {
    .about =
        {.name = "atom",
         .syntax = {.usage = "", .n_min = 0, .n_max = 0},
         .summary = "id, type and position of atoms in LAMMPS's text format",
         .details =
             "Columns `id type xs ys zs` with positions scaled to 0 ... 1 of the box; `dump_modify scale no` writes "
             "`x y z` (distance units), `dump_modify image yes` adds `ix iy iz`. Rows are in the order of ids "
             "unless `dump_modify sort` says otherwise.",
         .example = "dump d all atom 100 run.dump\ndump_modify d scale no"},
    .state_size = sizeof(hs_dump_table),
    .create = create,
    .modify = hs_dump_table_modify,
    .destroy = hs_dump_table_destroy,
    .init = init,
    .position = hs_dump_table_position,
    .keep_state = hs_dump_table_keep,
    .write = hs_dump_table_write,
};
