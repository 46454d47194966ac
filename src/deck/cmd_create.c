/* Commands that make atoms: create_atoms, mass. */
#include <string.h>

#include "base/memory.h"
#include "base/text.h"
#include "base/timer.h"
#include "core/atom_style.h"
#include "deck/command.h"
#include "deck/creation.h"
#include "deck/marsaglia.h"
#include "style/box_shape.h"

static const char *const create_styles[] = {"box", "region", "single", "random", NULL};
/** Words after the style's name. */
static const int create_words[] = {0, 1, 3, 3};

static const hs_keyword create_keywords[] = {
    {"basis", 2, "<m> <type>", "type of the atoms on basis site m (from 1) of the lattice; repeat for more sites"},
    {"remap", 1, "yes|no", "style single: bring an atom outside of a periodic box back into it (default no)"},
    {"units", 1, "lattice|box", "the place of a single atom is in lattice spacings (default) or distance units"},
    {"ratio", 2, "<fraction> <seed>", "fill only this fraction of the sites, chosen at random; styles box and region"},
    {"subset", 2, "<N> <seed>", "fill only so many of the sites, chosen at random; styles box and region"},
    {"var", 1, "<name>", "create only where this equal-style variable is not 0"},
    {"set", 2, "<x|y|z> <name>", "internal variable that is set to the coordinate before `var` is evaluated"},
    {NULL, 0, NULL, NULL},
};

static hs_status create_check(const hs_args *args, bool has_variables, hs_error *err)
{
    int style;
    if (strchr(args->word[1], '$') != NULL) return HS_OK;
    HS_TRY(hs_arg_choice(args, 1, create_styles, &style, err));
    for (int i = 2 + create_words[style]; i < args->n; ++i) {
        const char *word = args->word[i];
        if (strcmp(word, "mol") == 0 || strcmp(word, "rotate") == 0)
            return hs_fail(err, HS_ERROR_INPUT,
                           "create_atoms: the keyword '%s' is for molecules, which are not supported", word);
    }
    const hs_syntax syntax = {
        "<type> box | region <ID> | single <x> <y> <z> | random <N> <seed> <region-ID>|NULL [keyword value ...]",
        2 + create_words[style], 2 + create_words[style], create_keywords};
    return hs_syntax_check(&syntax, args, has_variables, err);
}

static hs_status read_type(const hs_sim *sim, const hs_args *args, int i, int *type, hs_error *err)
{
    int64_t number;
    HS_TRY(hs_arg_type(args, i, sim->atoms.n_types, &number, err));
    *type = (int)number;
    return HS_OK;
}

/** ratio and subset. */
static hs_status read_subset(hs_creation *c, const hs_args *args, int i, hs_error *err)
{
    int64_t seed;
    if (c->style != HS_CREATE_BOX && c->style != HS_CREATE_REGION)
        return hs_fail(err, HS_ERROR_INPUT, "create_atoms: '%s' is only for the styles box and region", args->word[i]);
    c->ratio = -1.0;
    c->n_subset = -1;
    if (strcmp(args->word[i], "ratio") == 0) {
        HS_TRY(hs_arg_double(args, i + 1, &c->ratio, err));
        if (!(c->ratio >= 0.0 && c->ratio <= 1.0))
            return hs_arg_refuse(args, i + 1, "a fraction from 0 to 1", NULL, err);
    } else {
        HS_TRY(hs_arg_int(args, i + 1, 1, INT64_MAX, &c->n_subset, err));
    }
    HS_TRY(hs_arg_int(args, i + 2, 1, HS_MARSAGLIA_SEED_MAX, &seed, err));
    c->subset_seed = (int)seed;
    return HS_OK;
}

static hs_status read_keyword(hs_creation *c, const hs_args *args, int *i, hs_error *err)
{
    const char *keyword = args->word[*i];
    static const char *const axes[] = {"x", "y", "z", NULL};
    int64_t number;
    int axis;
    if (strcmp(keyword, "basis") == 0) {
        if (!c->sim->lattice.is_set)
            return hs_fail(err, HS_ERROR_INPUT,
                           "create_atoms: 'basis' needs a lattice: the command 'lattice' comes first");
        HS_TRY(hs_arg_int(args, *i + 1, 1, c->sim->lattice.n_basis, &number, err));
        HS_TRY(read_type(c->sim, args, *i + 2, &c->basis_type[number - 1], err));
        *i += 2;
    } else if (strcmp(keyword, "ratio") == 0 || strcmp(keyword, "subset") == 0) {
        HS_TRY(read_subset(c, args, *i, err));
        *i += 2;
    } else if (strcmp(keyword, "set") == 0) {
        HS_TRY(hs_arg_choice(args, *i + 1, axes, &axis, err));
        c->coordinate[axis] = args->word[*i + 2];
        *i += 2;
    } else {
        const char *value = args->word[++*i];
        if (strcmp(keyword, "var") == 0) c->test = value;
        if (strcmp(keyword, "remap") == 0) c->remap = strcmp(value, "yes") == 0;
        if (strcmp(keyword, "units") == 0) c->is_lattice_units = strcmp(value, "lattice") == 0;
    }
    return HS_OK;
}

/** The words of the style. */
static hs_status read_style(hs_creation *c, const hs_args *args, hs_error *err)
{
    int64_t seed;
    if (c->style == HS_CREATE_REGION) HS_TRY(hs_sim_need_region(c->sim, args->command, args->word[2], &c->region, err));
    if (c->style == HS_CREATE_SINGLE)
        for (int axis = 0; axis < 3; ++axis) HS_TRY(hs_arg_double(args, 2 + axis, &c->place[axis], err));
    if (c->style == HS_CREATE_RANDOM) {
        HS_TRY(hs_arg_int(args, 2, 0, INT32_MAX, &c->n_random, err));
        HS_TRY(hs_arg_int(args, 3, 1, INT32_MAX - 1, &seed, err));
        c->seed = (int)seed;
        if (strcmp(args->word[4], "NULL") != 0)
            HS_TRY(hs_sim_need_region(c->sim, args->command, args->word[4], &c->region, err));
    }
    if ((c->style == HS_CREATE_BOX || c->style == HS_CREATE_REGION) && !c->sim->lattice.is_set)
        return hs_fail(err, HS_ERROR_INPUT,
                       "create_atoms: there is no lattice to put atoms on; the command 'lattice' makes one");
    return HS_OK;
}

static hs_status read_words(hs_creation *c, const hs_args *args, hs_error *err)
{
    int style;
    HS_TRY(hs_arg_choice(args, 1, create_styles, &style, err));
    c->style = (hs_create_style)style;
    HS_TRY(read_type(c->sim, args, 0, &c->type, err));
    HS_TRY(read_style(c, args, err));
    const int n_basis = c->sim->lattice.n_basis;
    HS_TRY(HS_ALLOC(c->basis_type, (size_t)n_basis, err));
    for (int b = 0; b < n_basis; ++b) c->basis_type[b] = c->type;
    for (int i = 2 + create_words[style]; i < args->n; ++i) HS_TRY(read_keyword(c, args, &i, err));
    const bool has_coordinate = c->coordinate[0] != NULL || c->coordinate[1] != NULL || c->coordinate[2] != NULL;
    if ((c->test != NULL) != has_coordinate)
        return hs_fail(err, HS_ERROR_INPUT,
                       "create_atoms: 'var' and 'set' need each other: set x|y|z <name> names the internal variables "
                       "that the formula reads");
    return HS_OK;
}

static hs_status create_atoms_run(hs_deck *deck, const hs_args *args, hs_error *err)
{
    const double start_s = hs_time_now_s();
    hs_sim *sim = deck->sim;
    HS_TRY(hs_sim_need_box(sim, args->command, err));
    HS_TRY(create_check(args, false, err));
    hs_creation c = {.deck = deck, .sim = sim, .is_lattice_units = true, .ratio = -1.0, .n_subset = -1};
    hs_status status = read_words(&c, args, err);
    if (status == HS_OK) status = hs_creation_run(&c, err);
    HS_FREE(c.basis_type);
    status = hs_parallel_agree(&sim->parallel, err); /* who failed has it in err */
    hs_sim_atoms_changed(sim);
    HS_TRY(status);
    hs_say(deck->out, "Created %lld atoms\n  using %s units in ", (long long)c.n_created,
           c.is_lattice_units ? "lattice" : "box");
    hs_box_say(deck->out, "", &sim->box);
    hs_say(deck->out, "  create_atoms CPU = %.3f seconds\n", hs_time_now_s() - start_s);
    return HS_OK;
}

static hs_status mass_run(hs_deck *deck, const hs_args *args, hs_error *err)
{
    hs_sim *sim = deck->sim;
    int lo, hi;
    double mass;
    HS_TRY(hs_sim_need_box(sim, args->command, err));
    if (sim->atoms.rmass != NULL && !hs_atom_style_has(&sim->atoms.style, HS_ATOM_DIPOLE))
        return hs_fail(err, HS_ERROR_INPUT,
                       "mass: atoms of style sphere have masses of their own; 'set type <type> density <value>' or "
                       "'set type <type> mass <value>' changes them");
    HS_TRY(hs_arg_range(args, 0, sim->atoms.n_types, &lo, &hi, err));
    HS_TRY(hs_arg_positive(args, 1, &mass, err));
    for (int type = lo; type <= hi; ++type) sim->atoms.mass[type] = mass;
    hs_sim_atoms_changed(sim);
    return HS_OK;
}

const hs_command hs_commands_create[] = {
    {
        .about =
            {
                .name = "create_atoms",
                .syntax = {"<type> box | region <ID> | single <x> <y> <z> | random <N> <seed> <region-ID>|NULL "
                           "[keyword value ...]",
                           2, -1, create_keywords},
                .summary = "Create atoms on the lattice, at one place, or at random places",
                .details =
                    "`box` fills the box with atoms on the sites of the lattice, `region` only a region of it. Sites "
                    "on the lower face\n"
                    "of a periodic box are filled, those on the upper face are not; on other faces, lower ones belong "
                    "to the box,\n"
                    "upper ones do not. IDs go on from the highest one; the third lattice direction is the slowest, "
                    "basis atoms are\n"
                    "the fastest. `single` makes one atom at x, y, z, or none if the place is outside of the box. "
                    "`random` makes N\n"
                    "atoms at random places of the box or of a region; the places may overlap. Places, IDs and the "
                    "choices of\n"
                    "`ratio` and `subset` are those of LAMMPS on one rank, whatever the number of ranks.\n\n"
                    "New atoms are at rest and in group all only. Molecules (`mol`, `rotate`) are not supported.\n",
                .example = "create_atoms 1 box\ncreate_atoms 1 box basis 2 2\ncreate_atoms 2 single 5 5 5 units box\n"
                           "create_atoms 1 random 500 4321 NULL",
            },
        .run = create_atoms_run,
        .check = create_check,
    },
    {
        .about =
            {
                .name = "mass",
                .syntax = {"<type> <mass>", 2, 2, NULL},
                .summary = "Mass of all atoms of a type",
                .details = "`type` is a number or a range (`*`, `2*`, `*3`, `2*3`); `mass` is greater than 0, in mass "
                           "units. Every type needs\n"
                           "one before the first run or the first `velocity`. The box must exist. Atoms of style "
                           "sphere have masses of their own: there the command is refused, or, with `hybrid dipole "
                           "sphere`, its values are not used (as in LAMMPS).\n",
                .example = "mass 1 1.0\nmass * 39.95",
            },
        .run = mass_run,
    },
    {.about = {.name = NULL}},
};
