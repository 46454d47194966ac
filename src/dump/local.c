/* dump local: rows of local values, such as pairs of atoms. */
#include <string.h>

#include "base/memory.h"
#include "io/dump_table.h"

static const hs_dump_layout layout = {.has_atom_header = true, .has_column_formats = true};

/** Rows that are only numbered show nothing, and nobody knows how many there are. */
static hs_status need_values(const hs_args *args, hs_error *err)
{
    for (int i = 0; i < args->n; ++i)
        if (strcmp(args->word[i], "index") != 0) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "%s: at least one local value of a compute, c_ID or c_ID[i], is needed",
                   args->command);
}

static hs_status check(const char *file, const hs_args *args, hs_error *err)
{
    (void)file;
    HS_TRY(hs_dump_check_local_words(args, err));
    return need_values(args, err);
}

static hs_status create(hs_dump *dump, const hs_args *args, hs_error *err)
{
    HS_TRY(hs_dump_table_begin(dump, args, &layout, err));
    ((hs_dump_table *)dump->state)->is_local = true;
    HS_TRY(need_values(args, err));
    return hs_dump_set_columns(dump, args, err);
}

static hs_status modify(hs_dump *dump, const hs_args *args, int *n_used, hs_error *err)
{
    static const char *const of_atoms[] = {"element", "image", "pbc", "region", "scale", "thresh"};
    hs_dump_table *table = dump->state;
    for (size_t k = 0; k < sizeof of_atoms / sizeof of_atoms[0]; ++k)
        if (strcmp(args->word[0], of_atoms[k]) == 0)
            return hs_fail(err, HS_ERROR_INPUT, "%s: '%s' is about atoms, and rows of dump local are none",
                           args->command, args->word[0]);
    if (args->n > 1 && strcmp(args->word[0], "sort") == 0 && strcmp(args->word[1], "id") == 0)
        return hs_fail(err, HS_ERROR_INPUT,
                       "%s: rows of dump local have no id: they are in the order of the compute, or of a column, "
                       "whose number follows 'sort'",
                       args->command);
    if (strcmp(args->word[0], "label") != 0) return hs_dump_table_modify(dump, args, n_used, err);
    *n_used = 2;
    HS_TRY(hs_arg_need(args, 1, "the word after label", err));
    return hs_memory_replace(&table->label, args->word[1], err);
}

const hs_dump_style hs_dump_style_local = {
    .about = {.name = "local",
              .syntax = {.usage = "<value> ...", .n_min = 1, .n_max = -1},
              .summary = "local values, such as those of pairs of atoms, in LAMMPS's text format",
              .details = "A row for each pair of atoms, or whatever else the local values are of, and a column for "
                         "each value: local values of computes `c_ID`, `c_ID[i]`, `c_ID[*]`, all with the same rows, "
                         "and `index`, the number of the row from 1. Rows are in the order that the compute states, "
                         "whatever the number of ranks and threads (LAMMPS's follows its lists), or in that of a "
                         "column with `dump_modify sort`. `dump_modify label` says what stands in place of ENTRIES "
                         "above the rows. The group has no meaning: the compute has one.",
              .example = "compute p all pair/local dist eng\ncompute i all property/local patom1 patom2\n"
                         "dump d all local 1000 pairs.*.dump index c_i[*] c_p[*]\ndump_modify d label PAIRS"},
    .state_size = sizeof(hs_dump_table),
    .check = check,
    .create = create,
    .modify = modify,
    .destroy = hs_dump_table_destroy,
    .init = hs_dump_table_init,
    .position = hs_dump_table_position,
    .keep_state = hs_dump_table_keep,
    .write = hs_dump_table_write,
};
