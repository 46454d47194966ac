/* Commands before the box: units, dimension, boundary, atom_style, atom_modify, newton, processors. */
#include <string.h>

#include "core/atom_style.h"
#include "deck/command.h"
#include "deck/place_atoms.h"

static hs_status need_no_box(const hs_deck *deck, const char *command, hs_error *err)
{
    if (!deck->sim->box.exists) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT,
                   "%s: must come before the box is made (create_box, read_data); 'clear' starts anew", command);
}

static bool is_variable(const char *word) { return strchr(word, '$') != NULL; }

/* ---- units ---- */

/** Unit systems of LAMMPS that Halfshell does not have: refused by name. */
static hs_status units_check(const hs_args *args, bool has_variables, hs_error *err)
{
    (void)has_variables;
    if (is_variable(args->word[0]) || hs_units_find(args->word[0]) != NULL) return HS_OK;
    return hs_arg_refuse(args, 0, "one of lj, real, metal, si, cgs, electron, micro, nano", hs_units_names, err);
}

static hs_status units_run(hs_deck *deck, const hs_args *args, hs_error *err)
{
    HS_TRY(need_no_box(deck, args->command, err));
    HS_TRY(units_check(args, false, err));
    hs_sim *sim = deck->sim;
    sim->env.units = hs_units_find(args->word[0]);
    sim->env.dt = sim->env.units->dt;
    sim->neighbor.settings.skin = sim->env.units->skin;
    return HS_OK;
}

/* ---- dimension, boundary ---- */

static hs_status dimension_run(hs_deck *deck, const hs_args *args, hs_error *err)
{
    HS_TRY(need_no_box(deck, args->command, err));
    int64_t dimension;
    HS_TRY(hs_arg_int(args, 0, 2, 3, &dimension, err));
    deck->sim->box.dimension = (int)dimension;
    return HS_OK;
}

static hs_status boundary_check(const hs_args *args, bool has_variables, hs_error *err)
{
    (void)has_variables;
    hs_boundary faces[2];
    for (int axis = 0; axis < 3; ++axis) {
        if (is_variable(args->word[axis])) return HS_OK;
        HS_TRY(hs_boundary_read(args, axis, axis, faces, err));
    }
    return HS_OK;
}

static hs_status boundary_run(hs_deck *deck, const hs_args *args, hs_error *err)
{
    HS_TRY(need_no_box(deck, args->command, err));
    hs_box *box = &deck->sim->box;
    HS_TRY(boundary_check(args, false, err));
    for (int axis = 0; axis < 3; ++axis) {
        HS_TRY(hs_boundary_read(args, axis, axis, box->boundary[axis], err));
        box->periodic[axis] = box->boundary[axis][0] == HS_BOUNDARY_PERIODIC;
    }
    return HS_OK;
}

/* ---- box ---- */

static const hs_keyword box_keywords[] = {
    {"tilt", 1, "small|large", "refuse boxes whose tilt is more than half of an edge (default), or warn of them"},
    {NULL, 0, NULL, NULL},
};

static hs_status box_run(hs_deck *deck, const hs_args *args, hs_error *err)
{
    static const char *const tilts[] = {"small", "large", NULL};
    HS_TRY(need_no_box(deck, args->command, err));
    HS_TRY(hs_arg_need(args, 1, "tilt small or tilt large", err));
    for (int i = 0; i < args->n; i += 2) {
        int which;
        HS_TRY(hs_arg_choice(args, i + 1, tilts, &which, err));
        deck->sim->may_be_skewed = which == 1;
    }
    return HS_OK;
}

/* ---- atom_style, atom_modify ---- */

/** A word of atom_style as a part of the style. */
static hs_status read_part(const hs_args *args, int i, int *part, hs_error *err)
{
    static const char *const others[] = {
        "angle",  "body",      "bond", "charge", "dpd", "edpd", "electron", "full",     "mdpd", "ellipsoid",  "line",
        "mesont", "molecular", "peri", "smd",    "sph", "spin", "tdpd",     "template", "tri",  "wavepacket", NULL};
    for (int k = 0; others[k] != NULL; ++k)
        if (strcmp(args->word[i], others[k]) == 0)
            return hs_fail(err, HS_ERROR_INPUT,
                           "atom_style: '%s' is not supported: atoms are points (atomic), spheres (sphere), have a "
                           "direction (dipole), or both (hybrid dipole sphere)",
                           args->word[i]);
    return hs_arg_choice(args, i, hs_atom_part_names, part, err);
}

static hs_status read_atom_style(const hs_args *args, bool has_variables, hs_atom_style *style, hs_error *err)
{
    memset(style, 0, sizeof *style);
    style->is_hybrid = strcmp(args->word[0], "hybrid") == 0;
    if (style->is_hybrid && args->n == 1) return hs_arg_need(args, 1, "a style after hybrid", err);
    for (int i = style->is_hybrid; i < args->n; ++i) {
        int part;
        if (has_variables && is_variable(args->word[i])) return HS_OK;
        const bool is_flag = strcmp(args->word[i], "0") == 0 || strcmp(args->word[i], "1") == 0;
        if (is_flag && i > 0 && strcmp(args->word[i - 1], "sphere") == 0) continue; /* whether diameters may change */
        if (i > 0 && !style->is_hybrid)
            return hs_fail(err, HS_ERROR_INPUT,
                           "atom_style: unexpected word '%s' after %s; 'hybrid' joins several styles", args->word[i],
                           args->word[0]);
        HS_TRY(read_part(args, i, &part, err));
        if (hs_atom_style_has(style, (hs_atom_part)part))
            return hs_fail(err, HS_ERROR_INPUT, "atom_style: '%s' is there twice", args->word[i]);
        style->part[style->n_parts++] = (hs_atom_part)part;
    }
    return HS_OK;
}

static hs_status atom_style_check(const hs_args *args, bool has_variables, hs_error *err)
{
    hs_atom_style style;
    return read_atom_style(args, has_variables, &style, err);
}

static hs_status atom_style_run(hs_deck *deck, const hs_args *args, hs_error *err)
{
    hs_atom_style style;
    HS_TRY(need_no_box(deck, args->command, err));
    HS_TRY(read_atom_style(args, false, &style, err));
    if (hs_atom_style_has(&style, HS_ATOM_SPHERE) && style.n_parts > 1)
        hs_warn(deck->out, "atom_style hybrid: each atom has a mass of its own (diameter 1 and density 1 at first), "
                           "and those of the command mass are not used");
    return hs_atoms_set_style(&deck->sim->atoms, &style, err);
}

static const hs_keyword atom_modify_keywords[] = {
    {"id", 1, "yes|no", "atoms have IDs; only `yes` is supported"},
    {"map", 1, "yes|array|hash", "how LAMMPS looks atoms up by ID; no effect"},
    {"first", 1, "<group-ID>", "group that LAMMPS keeps first in memory; no effect"},
    {"sort", 2, "<every> <bin-size>", "how often LAMMPS sorts atoms in memory; no effect"},
    {NULL, 0, NULL, NULL},
};

static hs_status atom_modify_run(hs_deck *deck, const hs_args *args, hs_error *err)
{
    for (int i = 0; i < args->n; ++i) {
        const char *keyword = args->word[i++];
        if (strcmp(keyword, "sort") == 0) {
            int64_t every;
            double size;
            HS_TRY(hs_arg_int(args, i, 0, INT32_MAX, &every, err));
            HS_TRY(hs_arg_not_negative(args, ++i, &size, err));
        } else if (strcmp(keyword, "first") == 0) {
            int group;
            HS_TRY(hs_groups_get(&deck->sim->groups, args->word[i], &group, err));
        } else {
            HS_TRY(need_no_box(deck, strcmp(keyword, "id") == 0 ? "atom_modify id" : "atom_modify map", err));
            if (strcmp(keyword, "id") == 0 && strcmp(args->word[i], "no") == 0)
                return hs_fail(err, HS_ERROR_INPUT, "atom_modify: 'id no' is not supported: every atom has an ID");
        }
    }
    return HS_OK;
}

/* ---- newton, processors ---- */

static hs_status newton_run(hs_deck *deck, const hs_args *args, hs_error *err)
{
    static const char *const words[] = {"on", "off", "yes", "no", NULL};
    int ignored;
    if (deck->sim->box.exists && args->n == 2) HS_TRY(need_no_box(deck, args->command, err));
    for (int i = 0; i < args->n; ++i) HS_TRY(hs_arg_choice(args, i, words, &ignored, err));
    return HS_OK;
}

static const hs_keyword processors_keywords[] = {
    {"grid", 1, "onelevel|numa", "how LAMMPS chooses the grid; no effect"},
    {"map", 1, "cart|cart/reorder|xyz|xzy|yxz|yzx|zxy|zyx", "how LAMMPS maps ranks onto the grid; no effect"},
    {NULL, 0, NULL, NULL},
};

static hs_status processors_run(hs_deck *deck, const hs_args *args, hs_error *err)
{
    HS_TRY(need_no_box(deck, args->command, err));
    const int64_t n_ranks = deck->sim->parallel.n_ranks;
    int64_t product = 1;
    bool is_free = false;
    int wanted[3];
    for (int axis = 0; axis < 3; ++axis) {
        if (strcmp(args->word[axis], "*") == 0) {
            is_free = true;
            wanted[axis] = 0;
            continue;
        }
        int64_t n;
        HS_TRY(hs_arg_int(args, axis, 1, 1000000, &n, err));
        if (axis == 2 && deck->sim->box.dimension == 2 && n != 1)
            return hs_fail(err, HS_ERROR_INPUT, "processors: in two dimensions Pz must be 1 or *, not %s",
                           args->word[axis]);
        product *= n;
        wanted[axis] = (int)n;
    }
    if (is_free ? n_ranks % product != 0 : product != n_ranks)
        return hs_fail(err, HS_ERROR_INPUT,
                       "processors: a grid of %s x %s x %s does not fit this run's %lld MPI rank%s", args->word[0],
                       args->word[1], args->word[2], (long long)n_ranks, n_ranks == 1 ? "" : "s");
    memcpy(deck->sim->domain.wanted, wanted, sizeof wanted);
    return HS_OK;
}

const hs_command hs_commands_system[] = {
    {
        .about =
            {
                .name = "units",
                .syntax = {"lj|real|metal|si|cgs|electron|micro|nano", 1, 1, NULL},
                .summary = "Choose the units of all numbers in the deck and of all output",
                .details = "| | lj | real | metal |\n|---|---|---|---|\n"
                           "| mass | m | g/mol | g/mol |\n| distance | sigma | Angstrom | Angstrom |\n"
                           "| time | tau | fs | ps |\n| energy | epsilon | kcal/mol | eV |\n"
                           "| velocity | sigma/tau | Angstrom/fs | Angstrom/ps |\n"
                           "| temperature | epsilon/k | K | K |\n| pressure | epsilon/sigma^3 | atm | bar |\n"
                           "| default timestep | 0.005 | 1 | 0.001 |\n| default skin | 0.3 | 2 | 2 |\n\n"
                           "| | si | cgs | electron | micro | nano |\n|---|---|---|---|---|---|\n"
                           "| mass | kg | g | u | picogram | attogram |\n| distance | m | cm | bohr | micrometer | "
                           "nanometer |\n"
                           "| time | s | s | fs | microsecond | nanosecond |\n"
                           "| energy | J | erg | hartree | pg um^2/us^2 | ag nm^2/ns^2 |\n"
                           "| velocity | m/s | cm/s | bohr/(1.03275 fs) | um/us | nm/ns |\n| temperature | K | K | K | "
                           "K | K |\n"
                           "| pressure | Pa | dyn/cm^2 | Pa | pg/(um us^2) | ag/(nm ns^2) |\n"
                           "| default timestep | 1e-8 | 1e-8 | 0.001 | 2 | 0.00045 |\n| default skin | 0.001 | 0.1 | 2 "
                           "| 0.1 | 0.1 |\n\n"
                           "Must come before the box; the default is `lj`. Also sets the timestep and the skin to the "
                           "defaults of the\n"
                           "system. In `lj`, the number of the command `lattice` is a density and energies are printed "
                           "per atom. Atoms in `si` and `cgs` units need double precision, and a skin of their own "
                           "(`neighbor`).\n",
                .example = "units lj",
            },
        .run = units_run,
        .check = units_check,
    },
    {
        .about =
            {
                .name = "box",
                .syntax = {"tilt small|large", 0, 0, box_keywords},
                .summary = "Allow or refuse boxes that are tilted more than they need be",
                .details = "A box whose tilt `xy` is more than half of its length in x (`xz` likewise, `yz` in y) has "
                           "the same periodic images as one with a tilt that is less by that length. As in LAMMPS such "
                           "boxes are refused, with `tilt large` they are only worth a warning: they have more surface "
                           "to their volume, so that runs are slower. Must come before the box.\n",
                .example = "box tilt large",
            },
        .run = box_run,
    },
    {
        .about =
            {
                .name = "dimension",
                .syntax = {"2|3", 1, 1, NULL},
                .summary = "Two or three dimensions",
                .details = "Must come before the box; the default is 3. In two dimensions z must be periodic and atoms "
                           "lie at z = 0;\n"
                           "temperatures count two degrees of freedom an atom, and volumes are areas.\n",
                .example = "dimension 2",
            },
        .run = dimension_run,
    },
    {
        .about =
            {
                .name = "boundary",
                .syntax = {"<x> <y> <z>", 3, 3, NULL},
                .summary = "Periodic, fixed or shrink-wrapped faces of the box",
                .details = "One word for each axis, of one letter for both faces or of two for the lower and the upper "
                           "one: `p` periodic\n"
                           "(both faces or neither), `f` fixed: atoms that leave are lost, `s` shrink-wrapped: the "
                           "face follows the\n"
                           "outermost atom, `m` the same, but never inside of its first place. Must come before the "
                           "box; the default\n"
                           "is `p p p`.\n",
                .example = "boundary p p fs",
            },
        .run = boundary_run,
        .check = boundary_check,
    },
    {
        .about =
            {
                .name = "atom_style",
                .syntax = {"atomic | sphere [0|1] | dipole | hybrid <style> ...", 1, -1, NULL},
                .summary = "What atoms have: size, own mass, direction",
                .details = "`atomic` (the default): atoms are points with a type, a position and a velocity; masses "
                           "belong to types. `sphere`: each atom also has a diameter, a mass (set by its density) and "
                           "an angular velocity; new atoms have diameter 1 and density 1, and the command mass is "
                           "refused (a 0 or 1 after it, LAMMPS's mark of diameters that may change, has no effect: "
                           "they may). `dipole`: each atom has a dipole moment, 0 at first, which is also the "
                           "direction of an active particle; there are no charges and no dipole forces. `hybrid` joins "
                           "them; `hybrid dipole sphere` is the style of active Brownian particles. As in LAMMPS, "
                           "masses of types are then not used. Must come before the box.\n",
                .example = "atom_style atomic\natom_style hybrid dipole sphere",
            },
        .run = atom_style_run,
        .check = atom_style_check,
    },
    {
        .about =
            {
                .name = "atom_modify",
                .syntax = {"[id yes] [map yes|array|hash] [first <group-ID>] [sort <every> <bin-size>]", 0, 0,
                           atom_modify_keywords},
                .summary = "Settings of LAMMPS's storage of atoms, accepted without effect",
                .details = "Halfshell always keeps IDs, finds atoms by ID without a map, and sorts atoms itself; so "
                           "`map`, `first` and\n"
                           "`sort` are checked and change nothing. `id no` is refused. `id` and `map` must come before "
                           "the box.\n",
                .example = "atom_modify map array sort 0 0.0",
            },
        .run = atom_modify_run,
    },
    {
        .about =
            {
                .name = "newton",
                .syntax = {"on|off [on|off]", 1, 2, NULL},
                .summary = "Use of Newton's third law between ranks in LAMMPS, accepted without effect",
                .details = "One word for pairs and bonds, or one for each. Halfshell computes every pair once and "
                           "chooses itself how; the\n"
                           "results do not depend on it.\n",
                .example = "newton on",
            },
        .run = newton_run,
    },
    {
        .about =
            {
                .name = "processors",
                .syntax = {"<Px> <Py> <Pz> [grid onelevel|numa] [map <order>]", 3, 3, processors_keywords},
                .summary = "Grid of MPI ranks as LAMMPS divides the box, checked against the number of ranks",
                .details = "`Px Py Pz` are ranks along each axis, `*` leaves one free. The grid must fit the number of "
                           "ranks of the run, as\n"
                           "in LAMMPS; how the box is then divided is up to Halfshell, and results do not depend on "
                           "it. Must come\n"
                           "before the box.\n",
                .example = "processors * * 1",
            },
        .run = processors_run,
    },
    {.about = {.name = NULL}},
};
