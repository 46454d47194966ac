/* dump custom: chosen values of every atom. */

#include "io/dump_table.h"

static const hs_dump_layout layout = {.has_atom_header = true, .has_column_formats = true};

static hs_status check(const char *file, const hs_args *args, hs_error *err)
{
    (void)file;
    return hs_dump_check_words(args, 0, args->n, err);
}

static hs_status create(hs_dump *dump, const hs_args *args, hs_error *err)
{
    HS_TRY(hs_dump_table_begin(dump, args, &layout, err));
    return hs_dump_set_columns(dump, args, err);
}

const hs_dump_style hs_dump_style_custom = {
    .about = {.name = "custom",
              .syntax = {.usage = "<attribute> ...", .n_min = 1, .n_max = -1},
              .summary = "chosen values of atoms in LAMMPS's text format",
              .details =
                  "One column for each attribute: `id`, `type`, `element`, `mass`, `proc`, `procp1`; positions `x y z` "
                  "(distance), scaled `xs ys zs`, unwrapped `xu yu zu`, unwrapped and scaled `xsu ysu zsu`; images `ix "
                  "iy iz`; velocities `vx vy vz` (distance/time); forces `fx fy fz` (energy/distance); values per atom "
                  "of computes and fixes `c_ID`, `c_ID[i]`, `c_ID[*]`, `f_ID`, `f_ID[i]`; `v_name` for an atom-style "
                  "variable. Rows are in the order of ids unless `dump_modify sort` says otherwise.",
              .example = "dump d all custom 100 run.*.dump id type x y z vx vy vz"},
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
