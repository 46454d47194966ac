/* Commands of data files: read_data, write_data. */
#include <string.h>

#include "base/memory.h"
#include "base/text.h"
#include "deck/command.h"
#include "deck/frames.h"
#include "io/data_file.h"
#include "io/writer.h"

static const hs_keyword read_keywords[] = {
    {"add", 1, "<append | merge | N>",
     "add to the atoms there are; ids go on after the largest, as they are, or plus N"},
    {"offset", 5, "<types> <0> <0> <0> <0>",
     "add this to the atom types of the file; the other four, for bonds, must be 0"},
    {"shift", 3, "<x> <y> <z>", "move the atoms and the box of the file, distance"},
    {"extra/atom/types", 1, "<N>", "make N more atom types than the file has"},
    {"group", 1, "<group-ID>", "the new atoms join this group, which is made if need be"},
    {"fix", 3, "<fix-ID> NULL <section>",
     "the section of that name has values of this fix (property/atom), one line for each atom; may be said again for "
     "others"},
    {"nocoeff", 0, "", "pass over the coefficients in the file"},
    {NULL, 0, NULL, NULL},
};

static hs_status read_add(const hs_args *args, int i, hs_data_options *options, hs_error *err)
{
    options->is_added = true;
    if (strcmp(args->word[i], "append") == 0)
        options->is_appended = true;
    else if (strcmp(args->word[i], "merge") != 0)
        return hs_arg_int(args, i, 0, INT64_MAX / 2, &options->id_offset, err);
    return HS_OK;
}

static hs_status read_offset(const hs_args *args, int i, hs_data_options *options, hs_error *err)
{
    int64_t offset;
    HS_TRY(hs_arg_int(args, i, 0, HS_DATA_TYPES_MAX, &offset, err));
    options->type_offset = (int)offset;
    for (int k = 1; k < 5; ++k) {
        HS_TRY(hs_arg_int(args, i + k, 0, INT32_MAX, &offset, err));
        if (offset != 0) return hs_arg_refuse(args, i + k, "0: there are no bonds", NULL, err);
    }
    return HS_OK;
}

/** fix <ID> <header> <section> */
static hs_status read_section(hs_deck *deck, const hs_args *args, int i, hs_data_options *options, hs_error *err)
{
    hs_fix *fix = hs_sim_find_fix(deck->sim, args->word[i]);
    const int n = options->n_sections;
    if (fix == NULL) return hs_fail(err, HS_ERROR_INPUT, "read_data: there is no fix with the ID '%s'", args->word[i]);
    if (fix->style->data == NULL)
        return hs_fail(err, HS_ERROR_INPUT, "read_data: %s reads nothing from data files", hs_fix_who(fix).text);
    if (strcmp(args->word[i + 1], "NULL") != 0)
        return hs_arg_refuse(args, i + 1, "NULL: fixes have no lines in the header", NULL, err);
    for (int k = 0; k < n; ++k)
        if (strcmp(options->section[k].name, args->word[i + 2]) == 0)
            return hs_fail(err, HS_ERROR_INPUT, "read_data: the section '%s' is that of %s already", args->word[i + 2],
                           hs_fix_who(options->section[k].fix).text);
    HS_TRY(HS_GROW(options->section, (size_t)n, (size_t)n + 1, err));
    options->section[options->n_sections++] = (hs_data_section){.fix = fix, .name = args->word[i + 2]};
    return HS_OK;
}

static hs_status read_options(hs_deck *deck, const hs_args *args, hs_data_options *options, hs_error *err)
{
    for (int i = 1; i < args->n; ++i) {
        const char *keyword = args->word[i];
        int64_t extra;
        int bit;
        if (strcmp(keyword, "add") == 0) {
            HS_TRY(read_add(args, ++i, options, err));
        } else if (strcmp(keyword, "offset") == 0) {
            HS_TRY(read_offset(args, i + 1, options, err));
            i += 5;
        } else if (strcmp(keyword, "shift") == 0) {
            for (int axis = 0; axis < 3; ++axis) HS_TRY(hs_arg_double(args, ++i, &options->shift[axis], err));
        } else if (strcmp(keyword, "extra/atom/types") == 0) {
            HS_TRY(hs_arg_int(args, ++i, 0, HS_DATA_TYPES_MAX, &extra, err));
            options->n_extra_types = (int)extra;
        } else if (strcmp(keyword, "group") == 0) {
            HS_TRY(hs_groups_add(&deck->sim->groups, args->word[++i], &bit, err));
            options->mask |= hs_group_mask(bit);
        } else if (strcmp(keyword, "fix") == 0) {
            HS_TRY(read_section(deck, args, i + 1, options, err));
            i += 3;
        } else {
            options->no_coeffs = true; /* nocoeff; the syntax allows nothing else */
        }
    }
    return HS_OK;
}

/** A command read_data that is carried out. */
typedef struct reading {
    hs_deck *deck;
    const hs_args *args;
    bool is_remembered; /**< as one that checkpoints hold: what it sets follows, as commands of their own */
} reading;

/** Remember a command that has the effect of a part of the file, which will not be there when a run is resumed. */
static hs_status remember_part(reading *r, const hs_args *command, hs_error *err)
{
    if (!r->is_remembered) HS_TRY(hs_deck_remember(r->deck, r->args, err));
    r->is_remembered = true;
    return hs_deck_remember(r->deck, command, err);
}

static hs_status set_coefficients(void *context, const hs_args *args, hs_error *err)
{
    reading *r = context;
    HS_TRY(hs_sim_pair_coeff(r->deck->sim, args, err));
    return remember_part(r, &(hs_args){.command = "pair_coeff", .n = args->n, .word = args->word}, err);
}

/** A group of the atoms that were read: when it is made again they bring their memberships. */
static hs_status remember_group(reading *r, const char *name, hs_error *err)
{
    const char *const words[] = {name, "empty"};
    return remember_part(r, &(hs_args){.command = "group", .n = 2, .word = words}, err);
}

static hs_status read_data(hs_deck *deck, const hs_args *args, hs_data_options *options, hs_error *err)
{
    hs_sim *sim = deck->sim;
    HS_TRY(read_options(deck, args, options, err));
    if (sim->box.exists && !options->is_added)
        return hs_fail(err, HS_ERROR_INPUT,
                       "read_data: there is a box already; the keyword 'add' adds to it, 'clear' starts anew");
    if (!sim->box.exists && options->is_added)
        return hs_fail(err, HS_ERROR_INPUT, "read_data: the keyword 'add' needs a box and atoms to add to");
    if (options->is_added && options->n_extra_types > 0)
        return hs_fail(err, HS_ERROR_INPUT, "read_data: extra/atom/types goes with the first file, not with 'add'");
    if (sim->box.dimension == 2 && !sim->box.periodic[2])
        return hs_fail(err, HS_ERROR_INPUT,
                       "read_data: in two dimensions the boundary of z must be periodic (boundary x y p)");
    if (hs_deck_ends_check(deck, args->command, args->word[0])) return HS_OK;
    HS_TRY(hs_data_read(&sim->env, args->word[0], options, err));
    hs_sim_atoms_changed(sim);
    return HS_OK;
}

static hs_status run_read_data(hs_deck *deck, const hs_args *args, hs_error *err)
{
    hs_sim *sim = deck->sim;
    reading context = {.deck = deck, .args = args};
    hs_data_options options = {.pair_style = sim->pair != NULL ? sim->pair->style->about.name : NULL,
                               .pair_coeff = set_coefficients,
                               .may_be_skewed = sim->may_be_skewed,
                               .context = &context};
    hs_status status = read_data(deck, args, &options, err);
    for (int group = 1; group < HS_GROUPS_MAX && status == HS_OK; ++group)
        if (options.mask & hs_group_mask(group)) status = remember_group(&context, sim->groups.name[group], err);
    HS_FREE(options.section);
    return status;
}

static const hs_keyword write_keywords[] = {
    {"pair", 1, "ii|ij", "coefficients of each type (default), or of each pair of types"},
    {"nocoeff", 0, "", "write no coefficients"},
    {"nofix", 0, "", "leave out the values of fix property/atom"},
    {NULL, 0, NULL, NULL},
};

static hs_status append_coefficients(void *context, int i, int j, hs_text *words, hs_error *err)
{
    const hs_pair *pair = context;
    return pair->style->write_coeff(pair, i, j, words, err);
}

/** With coefficients for each type only, those given for unlike pairs are lost: say so. */
static void warn_of_unlike_pairs(const hs_sim *sim)
{
    const hs_pair *pair = sim->pair;
    for (int i = 1; i <= pair->n_types; ++i)
        for (int j = i + 1; j <= pair->n_types; ++j)
            if (pair->is_set[hs_pair_index(pair, i, j)]) {
                hs_warn(sim->env.out,
                        "write_data: the coefficients of the types %d %d were given and are not written; 'pair ij' "
                        "writes all",
                        i, j);
                return;
            }
}

static hs_status run_write_data(hs_deck *deck, const hs_args *args, hs_error *err)
{
    hs_sim *sim = deck->sim;
    hs_data_write_options options = {.pair = HS_DATA_PAIR_II, .fix = sim->fix, .n_fixes = sim->n_fixes};
    HS_TRY(hs_sim_need_box(sim, args->command, err));
    HS_TRY(hs_sim_need_masses(sim, args->command, err));
    for (int i = 1; i < args->n; ++i) {
        if (strcmp(args->word[i], "pair") == 0)
            options.pair = strcmp(args->word[++i], "ij") == 0 ? HS_DATA_PAIR_IJ : HS_DATA_PAIR_II;
        else if (strcmp(args->word[i], "nocoeff") == 0)
            options.pair = HS_DATA_PAIR_NONE;
        else
            options.n_fixes = 0; /* nofix */
    }
    if (options.pair != HS_DATA_PAIR_NONE && sim->pair != NULL && sim->pair->style->write_coeff != NULL) {
        HS_TRY(hs_sim_setup_pair(sim, err));
        options.pair_style = sim->pair->style->about.name;
        options.write_coeff = append_coefficients;
        options.context = sim->pair;
        if (options.pair == HS_DATA_PAIR_II) warn_of_unlike_pairs(sim);
    }
    if (options.pair != HS_DATA_PAIR_NONE && sim->pair != NULL && sim->pair->style->write_coeff == NULL &&
        hs_pair_has_forces(sim->pair))
        hs_warn(sim->env.out,
                "write_data: data files hold no coefficients of pair_style %s; the deck must give them again",
                sim->pair->style->about.name);
    deck->is_unwritten = true;
    if (deck->options.dry_run) return HS_OK;
    hs_sim_shrink_box(sim); /* the atoms may have moved out of it since the last list */
    char *name;
    HS_TRY(hs_writer_step_name(&name, args->word[0], sim->env.step, 0, err));
    const hs_status status = hs_data_write(&sim->env, name, &options, err);
    HS_FREE(name);
    return status;
}

const hs_command hs_commands_data[] = {
    {.about =
         {.name = "read_data",
          .syntax = {.usage = "<file> [<keyword> <value> ...]", .n_min = 1, .n_max = 1, .keywords = read_keywords},
          .summary = "Read box, atoms and coefficients from a LAMMPS data file",
          .details =
              "The file has the columns of the present atom_style (as in LAMMPS; charges must be 0) and may be "
              "compressed (`.gz`). The header gives `atoms`, `atom types`, `xlo xhi`, `ylo yhi`, `zlo zhi`; and, in a "
              "tilted box, `xy xz yz`; counts for bonds and the like must be 0. Sections: Masses, Atoms (`id type x y "
              "z` for style atomic, and three image flags or none), Velocities, Pair Coeffs, PairIJ Coeffs (these need "
              "a pair style before), and those that `fix` names: lines of an atom id and the values of a fix "
              "property/atom, which must be there before. Every number is checked; a bad one stops the run with file "
              "and line. Positions outside of a periodic box are wrapped, outside of another they are an error.",
          .example = "read_data start.data\nfix p all property/atom i_origin d_dose\nread_data doses.data fix p NULL "
                     "p\nread_data more.data.gz add append shift 20 0 0 group new"},
     .run = run_read_data},
    {.about = {.name = "write_data",
               .syntax = {.usage = "<output-file> [<keyword> <value> ...]",
                          .n_min = 1,
                          .n_max = 1,
                          .keywords = write_keywords},
               .summary = "Write box, atoms and coefficients to a LAMMPS data file",
               .details =
                   "A `*` in the name becomes the step; a name ending in `.gz` is compressed. Numbers have the "
                   "digits that give the same bits when read. Atoms are in the order of their ids. Values of fix "
                   "property/atom are in a section with the fix's ID. The file appears whole or not at all.",
               .example = "write_data end.data\nwrite_data end.*.data pair ij"},
     .run = run_write_data},
    {.run = NULL},
};
