/* The command set. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "base/text.h"
#include "deck/command.h"
#include "deck/set_styles.h"
#include "deck/set_types.h"
#include "style/custom_atom.h"

typedef enum { SET_ATOM, SET_TYPE, SET_GROUP, SET_REGION } set_style;
static const char *const set_styles[] = {"atom", "type", "group", "region", NULL};

static const hs_keyword set_keywords[] = {
    {"type", 1, "<type>", "new type: a number or an atom-style variable v_name"},
    {"type/fraction", 3, "<type> <fraction> <seed>", "new type for each atom with this probability"},
    {"type/ratio", 3, "<type> <fraction> <seed>", "new type for exactly this fraction of the atoms"},
    {"type/subset", 3, "<type> <N> <seed>", "new type for exactly N of the atoms"},
    {"x", 1, "<x>", "coordinate, distance: a number or an atom-style variable v_name"},
    {"y", 1, "<y>", "coordinate"},
    {"z", 1, "<z>", "coordinate"},
    {"vx", 1, "<vx>", "velocity: a number or an atom-style variable v_name"},
    {"vy", 1, "<vy>", "velocity"},
    {"vz", 1, "<vz>", "velocity"},
    HS_SET_STYLE_KEYWORDS,
    {"i_<name>", 1, "<value>",
     "whole number of fix property/atom; values of an atom-style variable v_name are cut off"},
    {"d_<name>", 1, "<value>", "real number of fix property/atom"},
    {"image", 3, "<ix> <iy> <iz>", "numbers of periodic images; NULL leaves one as it is"},
    {NULL, 0, NULL, NULL},
};

/** The atoms of one set command. */
typedef struct selection {
    hs_deck *deck;
    hs_sim *sim;
    unsigned char *flag; /**< owned [n_local] */
    int64_t n_all;       /**< selected on all ranks */
} selection;

static hs_status set_check(const hs_args *args, bool has_variables, hs_error *err)
{
    static const char *const others[] = {"mol",         "charge",   "shape", "length",       "tri",    "quat",
                                         "quat/random", "angmom",   "theta", "theta/random", "bond",   "angle",
                                         "dihedral",    "improper", "spin",  "spin/random",  "volume", "temperature",
                                         "cc",          "template", NULL};
    int style;
    if (strchr(args->word[0], '$') != NULL) return HS_OK;
    if (strcmp(args->word[0], "mol") == 0)
        return hs_fail(err, HS_ERROR_INPUT, "set: the style 'mol' is not supported: atoms belong to no molecules");
    HS_TRY(hs_arg_choice(args, 0, set_styles, &style, err));
    for (int i = 2; i < args->n; ++i)
        for (int k = 0; others[k] != NULL; ++k)
            if (strcmp(args->word[i], others[k]) == 0)
                return hs_fail(err, HS_ERROR_INPUT, "set: '%s' cannot be set: no supported atom style has it",
                               args->word[i]);
    const hs_syntax syntax = {"atom|type|group|region <ID> <keyword> <values> ...", 2, 2, set_keywords};
    HS_TRY(hs_syntax_check(&syntax, args, has_variables, err));
    if (args->n == 2 && !has_variables) return hs_arg_need(args, 2, "a keyword", err);
    return HS_OK;
}

/* ---- which atoms ---- */

/** n, *, n*, *n, m*n. */
static hs_status read_ids(const hs_args *args, int i, int64_t *lo, int64_t *hi, hs_error *err)
{
    char word[64];
    bool is_good = strlen(args->word[i]) < sizeof word;
    *lo = 1;
    *hi = INT64_MAX;
    if (is_good) {
        strcpy(word, args->word[i]);
        char *star = strchr(word, '*');
        if (star == NULL) {
            is_good = hs_text_to_int64(word, lo);
            *hi = *lo;
        } else {
            *star = '\0';
            is_good =
                (word[0] == '\0' || hs_text_to_int64(word, lo)) && (star[1] == '\0' || hs_text_to_int64(star + 1, hi));
        }
    }
    if (!is_good || *lo < 1 || *lo > *hi)
        return hs_arg_refuse(args, i, "an atom ID or range of IDs (n, *, n*, *n, m*n)", NULL, err);
    return HS_OK;
}

static hs_status select_region(selection *s, const hs_args *args, hs_error *err)
{
    const hs_atoms *atoms = &s->sim->atoms;
    const hs_region *region;
    HS_TRY(hs_sim_need_region(s->sim, "set", args->word[1], &region, err));
    for (int i = 0; i < atoms->n_local; ++i) s->flag[i] = hs_region_has(region, atoms, i);
    return HS_OK;
}

static hs_status select_atoms(selection *s, set_style style, const hs_args *args, hs_error *err)
{
    const hs_atoms *atoms = &s->sim->atoms;
    int type_lo, type_hi, group;
    int64_t lo, hi;
    if (style == SET_ATOM) {
        HS_TRY(read_ids(args, 1, &lo, &hi, err));
        for (int i = 0; i < atoms->n_local; ++i) s->flag[i] = atoms->id[i] >= lo && atoms->id[i] <= hi;
    } else if (style == SET_TYPE) {
        HS_TRY(hs_arg_range(args, 1, atoms->n_types, &type_lo, &type_hi, err));
        for (int i = 0; i < atoms->n_local; ++i) s->flag[i] = atoms->type[i] >= type_lo && atoms->type[i] <= type_hi;
    } else if (style == SET_GROUP) {
        HS_TRY(hs_groups_get(&s->sim->groups, args->word[1], &group, err));
        for (int i = 0; i < atoms->n_local; ++i) s->flag[i] = (atoms->mask[i] & hs_group_mask(group)) != 0;
    } else {
        HS_TRY(select_region(s, args, err));
    }
    for (int i = 0; i < atoms->n_local; ++i) s->n_all += s->flag[i];
    hs_parallel_sum_int64(&s->sim->parallel, &s->n_all, 1);
    return HS_OK;
}

/* ---- values ---- */

static int words_of(const char *keyword)
{
    for (const hs_keyword *k = set_keywords; k->name != NULL; ++k)
        if (strcmp(k->name, keyword) == 0) return k->n_values;
    return hs_custom_atom_is_name(keyword) ? 1 : 0;
}

/** The value of every local atom from word i: a number, or v_name: (*values)[n_local], owned by the caller. */
static hs_status read_values(const selection *s, const hs_args *args, int i, double **values, hs_error *err)
{
    const int n = s->sim->atoms.n_local;
    double value = 0.0;
    const bool is_variable = strncmp(args->word[i], "v_", 2) == 0;
    *values = NULL;
    if (!is_variable) HS_TRY(hs_arg_double(args, i, &value, err));
    HS_TRY(HS_ALLOC(*values, (size_t)n, err));
    if (is_variable) return s->sim->env.variable_atoms(s->deck, args->word[i] + 2, *values, err);
    for (int k = 0; k < n; ++k) (*values)[k] = value;
    return HS_OK;
}

static hs_status set_types(const selection *s, const hs_args *args, int i, const double *values, hs_error *err)
{
    hs_atoms *atoms = &s->sim->atoms;
    for (int k = 0; k < atoms->n_local; ++k) {
        if (!s->flag[k]) continue;
        if (!(values[k] >= 1.0 && values[k] <= atoms->n_types) || values[k] != floor(values[k]))
            return hs_fail(err, HS_ERROR_INPUT, "set: %s gives the type %g; types are the whole numbers from 1 to %d",
                           args->word[i], values[k], atoms->n_types);
        atoms->type[k] = (int32_t)values[k];
    }
    return HS_OK;
}

/** type, x, y, z, vx, vy, vz. */
static hs_status set_plain(const selection *s, const hs_args *args, int i, hs_error *err)
{
    hs_atoms *atoms = &s->sim->atoms;
    const char *keyword = args->word[i];
    double *values;
    hs_status status = read_values(s, args, i + 1, &values, err);
    if (status == HS_OK && strcmp(keyword, "type") == 0) {
        status = set_types(s, args, i + 1, values, err);
    } else if (status == HS_OK) {
        double *target = keyword[0] == 'v' ? atoms->v[keyword[1] - 'x'] : atoms->x[keyword[0] - 'x'];
        for (int k = 0; k < atoms->n_local; ++k)
            if (s->flag[k]) target[k] = values[k];
    }
    HS_FREE(values);
    return status;
}

/** i_name, d_name. */
static hs_status set_custom(const selection *s, const hs_args *args, int i, hs_error *err)
{
    const hs_atom_field *field;
    double *values;
    int64_t whole;
    HS_TRY(hs_custom_atom_get(&s->sim->atoms, args->word[i], "set", &field, err));
    if (args->word[i][0] == 'i' && strncmp(args->word[i + 1], "v_", 2) != 0)
        HS_TRY(hs_arg_int(args, i + 1, INT32_MIN, INT32_MAX, &whole, err));
    hs_status status = read_values(s, args, i + 1, &values, err);
    if (status == HS_OK) status = hs_custom_atom_write(&s->sim->atoms, field, s->flag, values, "set", err);
    HS_FREE(values);
    return status;
}

static hs_status set_image(const selection *s, const hs_args *args, int i, hs_error *err)
{
    hs_atoms *atoms = &s->sim->atoms;
    for (int axis = 0; axis < 3; ++axis) {
        if (strcmp(args->word[i + 1 + axis], "NULL") == 0) continue;
        double *values;
        hs_status status = read_values(s, args, i + 1 + axis, &values, err);
        for (int k = 0; status == HS_OK && k < atoms->n_local; ++k) {
            if (!s->flag[k]) continue;
            if (values[k] != floor(values[k]) || fabs(values[k]) > 1.0e9)
                status = hs_fail(err, HS_ERROR_INPUT, "set: %s gives the image number %g; a whole number is needed",
                                 args->word[i + 1 + axis], values[k]);
            else if (values[k] != 0.0 && !s->sim->box.periodic[axis])
                status =
                    hs_fail(err, HS_ERROR_INPUT, "set: the image number along %c must be 0, since %c is not periodic",
                            "xyz"[axis], "xyz"[axis]);
            else
                atoms->image[axis][k] = (int32_t)values[k];
        }
        HS_FREE(values);
        HS_TRY(status);
    }
    return HS_OK;
}

/** Values that only some atom styles have. */
static hs_status set_of_style(const selection *s, const hs_args *args, int i, hs_error *err)
{
    hs_atoms *atoms = &s->sim->atoms;
    double *values[3] = {NULL};
    hs_status status = HS_OK;
    HS_TRY(hs_set_need_style(atoms, args->word[i], err));
    if (strcmp(args->word[i], "dipole/random") == 0) return hs_set_random_dipoles(s->sim, s->flag, args, i, err);
    for (int k = 0; k < words_of(args->word[i]) && status == HS_OK; ++k)
        status = read_values(s, args, i + 1 + k, &values[k], err);
    if (status == HS_OK) status = hs_set_style_values(atoms, s->flag, args->word[i], values, err);
    for (int k = 0; k < 3; ++k) HS_FREE(values[k]);
    return status;
}

/* ---- the command ---- */

/** One keyword with its values, and its message. */
static hs_status set_keyword(const selection *s, const hs_args *args, int i, hs_error *err)
{
    const char *keyword = args->word[i];
    int64_t n = s->n_all, type;
    if (strncmp(keyword, "type/", 5) == 0) {
        HS_TRY(hs_arg_type(args, i + 1, s->sim->atoms.n_types, &type, err));
        HS_TRY(hs_set_random_types(s->sim, s->flag, s->n_all, args, i, (int)type, &n, err));
        hs_parallel_sum_int64(&s->sim->parallel, &n, 1);
    } else if (hs_custom_atom_is_name(keyword)) {
        HS_TRY(set_custom(s, args, i, err));
    } else if (strcmp(keyword, "image") == 0) {
        HS_TRY(set_image(s, args, i, err));
    } else if (hs_set_is_style_keyword(keyword)) {
        HS_TRY(set_of_style(s, args, i, err));
    } else {
        HS_TRY(set_plain(s, args, i, err));
    }
    hs_say(s->deck->out, "  %lld settings made for %s\n", (long long)n, keyword);
    return HS_OK;
}

/** Whether the command leaves everything but positions, velocities and image numbers as it is. */
static bool only_moves(const hs_args *args)
{
    static const char *const movers[] = {"x", "y", "z", "vx", "vy", "vz", "image"};
    for (int i = 2; i < args->n; i += 1 + words_of(args->word[i])) {
        bool is_mover = false;
        for (size_t k = 0; k < sizeof movers / sizeof movers[0]; ++k)
            is_mover = is_mover || strcmp(args->word[i], movers[k]) == 0;
        if (!is_mover) return false;
    }
    return true;
}

static hs_status set_run(hs_deck *deck, const hs_args *args, hs_error *err)
{
    hs_sim *sim = deck->sim;
    int style;
    HS_TRY(hs_sim_need_box(sim, args->command, err));
    HS_TRY(set_check(args, false, err));
    HS_TRY(hs_arg_choice(args, 0, set_styles, &style, err));
    if (sim->atoms.n_all == 0) return hs_fail(err, HS_ERROR_INPUT, "set: there are no atoms yet");
    selection s = {.deck = deck, .sim = sim};
    hs_say(deck->out, "Setting atom values ...\n");
    hs_status status = HS_ALLOC(s.flag, (size_t)sim->atoms.n_local, err);
    if (status == HS_OK) status = select_atoms(&s, (set_style)style, args, err);
    for (int i = 2; status == HS_OK && i < args->n; i += 1 + words_of(args->word[i]))
        status = set_keyword(&s, args, i, err);
    HS_FREE(s.flag);
    if (only_moves(args))
        hs_sim_atoms_moved(sim);
    else
        hs_sim_atoms_changed(sim);
    return status;
}

const hs_command hs_commands_set[] = {
    {
        .about =
            {
                .name = "set",
                .syntax = {"atom|type|group|region <ID> <keyword> <values> ...", 2, -1, set_keywords},
                .summary = "Set types, positions, velocities, image numbers, sizes or directions of atoms",
                .details = "The atoms are chosen by ID or range of IDs (`atom 3`, `atom 5*10`), by type or range of "
                           "types, by group, or by\n"
                           "region, once for all keywords of the command, which act one after the other. A value "
                           "`v_name` takes an atom-style\n"
                           "variable's value for each atom. Positions are in distance units and are not wrapped into "
                           "the box until the\n"
                           "next run; `run ... pre no` after a command that sets only positions and velocities goes on "
                           "with the forces and lists\n"
                           "there are, which is what Monte Carlo moves want. `type/fraction` draws for each atom from "
                           "its place, so that the number of atoms is only about right;\n"
                           "`type/ratio` and `type/subset` hit it exactly, going through atoms by ID. The choices are "
                           "those of LAMMPS on\n"
                           "one rank (before the first run of a deck; after it LAMMPS has reordered its atoms), "
                           "whatever the number of ranks.\n"
                           "Image numbers must be 0 along axes that are not periodic.\n\n"
                           "`i_<name>` and `d_<name>` are values of your own, which fix property/atom has added.\n\n"
                           "`diameter`, `density`, `density/disc`, `mass` and `omega` need spheres, `dipole` and "
                           "`dipole/random` need dipoles (atom_style). `density` uses the present diameter, so set the "
                           "diameter first. `dipole/random` gives LAMMPS's directions; in three dimensions they are "
                           "not quite evenly spread, which rotational diffusion forgets.\n",
                .example = "set type 1 type/fraction 2 0.5 12393\nset group left vx 0.5\nset atom 7 x 1.0 y 1.0",
            },
        .run = set_run,
        .check = set_check,
    },
    {.about = {.name = NULL}},
};
