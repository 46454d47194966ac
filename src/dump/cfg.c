/* dump cfg: AtomEye's extended configuration files: fractions of the box, and any other columns. */
#include <string.h>

#include "base/memory.h"
#include "io/dump_table.h"

enum { N_FIRST = 5 }; /**< columns that every row has */

/** How much longer than the box is the one that unwrapped places are written in: atoms may have gone half of it. */
enum { SPREAD = 10 };

static hs_status write_header(hs_dump *dump, hs_writer *writer, hs_error *err)
{
    const hs_dump_table *table = dump->state;
    const hs_box *box = dump->env->box;
    const double edges[3][3] = {{hs_box_length(box, 0), 0.0, 0.0},
                                {box->tilt[0], hs_box_length(box, 1), 0.0},
                                {box->tilt[1], box->tilt[2], hs_box_length(box, 2)}};
    HS_TRY(hs_writer_printf(writer, err, "Number of particles = %lld\nA = %d Angstrom (basic length-scale)\n",
                            (long long)table->n_rows_all, table->layout->spread > 0.0 ? SPREAD : 1));
    for (int a = 0; a < 3; ++a)
        for (int axis = 0; axis < 3; ++axis) /* a blank ends lines off the diagonal, as in LAMMPS's files */
            HS_TRY(hs_writer_printf(writer, err, "H0(%d,%d) = %g A%s\n", a + 1, axis + 1, edges[a][axis],
                                    axis != a ? " " : ""));
    HS_TRY(hs_writer_printf(writer, err, ".NO_VELOCITY.\nentry_count = %d\n", table->n_columns - 2));
    for (int k = N_FIRST; k < table->n_columns; ++k) {
        HS_TRY(hs_writer_printf(writer, err, "auxiliary[%d] = ", k - N_FIRST));
        HS_TRY(hs_dump_write_name(&table->column[k], writer, err));
        HS_TRY(hs_writer_printf(writer, err, "\n"));
    }
    return HS_OK;
}

static const hs_dump_layout in_box = {.write_header = write_header, .n_line_columns = 2, .has_column_formats = true};
static const hs_dump_layout unwrapped = {
    .write_header = write_header, .n_line_columns = 2, .has_column_formats = true, .spread = SPREAD};

/** *layout: which of the two the first words say; left as it is when they hold variables. */
static hs_status read_first(const hs_args *args, const hs_dump_layout **layout, hs_error *err)
{
    static const char *const words[2][N_FIRST + 1] = {{"mass", "type", "xs", "ys", "zs", NULL},
                                                      {"mass", "type", "xsu", "ysu", "zsu", NULL}};
    const bool is_unwrapped = strcmp(args->word[2], "xsu") == 0;
    for (int i = 0; i < N_FIRST; ++i) {
        if (strchr(args->word[i], '$') != NULL) return HS_OK;
        if (strcmp(args->word[i], words[is_unwrapped][i]) != 0)
            return hs_arg_refuse(args, i, "what the format begins with: mass type xs ys zs, or mass type xsu ysu zsu",
                                 NULL, err);
    }
    *layout = is_unwrapped ? &unwrapped : &in_box;
    return HS_OK;
}

static hs_status check(const char *file, const hs_args *args, hs_error *err)
{
    const hs_dump_layout *ignored;
    (void)file;
    HS_TRY(read_first(args, &ignored, err));
    return hs_dump_check_words(args, N_FIRST, args->n - N_FIRST, err);
}

static hs_status create(hs_dump *dump, const hs_args *args, hs_error *err)
{
    hs_dump_table *table = dump->state;
    const char **word;
    HS_TRY(hs_dump_table_begin(dump, args, &in_box, err));
    HS_TRY(read_first(args, &table->layout, err));
    HS_TRY(HS_ALLOC(word, (size_t)args->n, err));
    for (int i = 0; i < args->n; ++i) word[i] = i == 1 ? "element" : args->word[i];
    const hs_args columns = {.command = args->command, .n = args->n, .word = word};
    const hs_status status = hs_dump_set_columns(dump, &columns, err);
    hs_memory_free((void *)(uintptr_t)word);
    return status;
}

static hs_status init(hs_dump *dump, hs_error *err)
{
    if (strchr(dump->file, '*') == NULL && !dump->is_single)
        return hs_fail(err, HS_ERROR_INPUT,
                       "%s: every snapshot is a file of its own: the name '%s' needs a *, which becomes the step",
                       hs_dump_who(dump).text, dump->file);
    return hs_dump_table_init(dump, err);
}

const hs_dump_style hs_dump_style_cfg = {
    .about =
        {.name = "cfg",
         .syntax = {.usage = "mass type <xs ys zs | xsu ysu zsu> [attribute ...]", .n_min = N_FIRST, .n_max = -1},
         .summary = "AtomEye's configuration files, which OVITO and ASE read",
         .details =
             "One file a snapshot: its name needs a `*`. For each atom its mass, the name of its type "
             "(`dump_modify element`; without it `C`) and a row with its place as fractions of the box and the "
             "further attributes, which are those of `dump custom`. With `xsu ysu zsu` places are unwrapped; as the "
             "format knows nothing beyond the box, they are written as in a box ten times as long, whose middle is "
             "the box's, with `A = 10`. Formats of `dump_modify` leave masses and names as they are.",
         .example = "dump d all cfg 100 run.*.cfg mass type xs ys zs id vx vy vz\ndump_modify d element Ar"},
    .state_size = sizeof(hs_dump_table),
    .check = check,
    .create = create,
    .modify = hs_dump_table_modify,
    .destroy = hs_dump_table_destroy,
    .init = init,
    .position = hs_dump_table_position,
    .keep_state = hs_dump_table_keep,
    .write = hs_dump_table_write,
};
