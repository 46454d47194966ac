/* dump xyz: the xyz format that most viewers read. */
#include "io/dump_table.h"

static const hs_dump_layout layout = {.is_element_first = true};

static hs_status create(hs_dump *dump, const hs_args *args, hs_error *err)
{
    static const char *const words[] = {"type", "x", "y", "z"};
    const hs_args columns = {.command = "dump xyz", .n = 4, .word = words};
    HS_TRY(hs_dump_table_begin(dump, args, &layout, err));
    return hs_dump_set_columns(dump, &columns, err);
}

const hs_dump_style hs_dump_style_xyz = {
    .about = {.name = "xyz",
              .syntax = {.usage = "", .n_min = 0, .n_max = 0},
              .summary = "positions in the xyz format",
              .details =
                  "For each snapshot the number of atoms, a line with the step, and a row `type x y z` for each atom "
                  "(distance units). `dump_modify element` gives the types names. Rows are in the order of ids unless "
                  "`dump_modify sort` says otherwise.",
              .example = "dump d all xyz 100 run.xyz\ndump_modify d element Ar"},
    .state_size = sizeof(hs_dump_table),
    .create = create,
    .modify = hs_dump_table_modify,
    .destroy = hs_dump_table_destroy,
    .init = hs_dump_table_init,
    .position = hs_dump_table_position,
    .keep_state = hs_dump_table_keep,
    .write = hs_dump_table_write,
};
