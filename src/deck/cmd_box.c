/* Commands that make the box: lattice, region, create_box. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "deck/command.h"
#include "style/box_shape.h"

static bool is_variable(const char *word) { return strchr(word, '$') != NULL; }

/* ---- lattice ---- */

static const hs_keyword lattice_keywords[] = {
    {"origin", 3, "<x> <y> <z>", "shift of all sites, in fractions of the spacings, 0 <= x < 1; default 0 0 0"},
    {"orient", 4, "<x|y|z> <i> <j> <k>",
     "integer vector of the lattice that becomes x, y or z; default x 1 0 0, y 0 1 0, z 0 0 1"},
    {"spacing", 3, "<dx> <dy> <dz>", "spacings in units of the scale, instead of the extent of the rotated cell"},
    {"a1", 3, "<x> <y> <z>", "first edge of the cell, in units of the scale; style custom only"},
    {"a2", 3, "<x> <y> <z>", "second edge"},
    {"a3", 3, "<x> <y> <z>", "third edge"},
    {"basis", 3, "<x> <y> <z>", "one atom of the cell, in fractions of a1, a2, a3; repeat for more; style custom only"},
    {NULL, 0, NULL, NULL},
};

static hs_status lattice_check(const hs_args *args, bool has_variables, hs_error *err)
{
    (void)has_variables;
    int style;
    if (is_variable(args->word[0])) return HS_OK;
    return hs_arg_choice(args, 0, hs_lattice_styles, &style, err);
}

static hs_status read_three(const hs_args *args, int i, double values[3], hs_error *err)
{
    for (int axis = 0; axis < 3; ++axis) HS_TRY(hs_arg_double(args, i + axis, &values[axis], err));
    return HS_OK;
}

static hs_status read_orient(const hs_args *args, int i, hs_lattice *lattice, hs_error *err)
{
    static const char *const axes[] = {"x", "y", "z", NULL};
    int axis;
    HS_TRY(hs_arg_choice(args, i, axes, &axis, err));
    for (int k = 0; k < 3; ++k) {
        int64_t value;
        HS_TRY(hs_arg_int(args, i + 1 + k, -10000, 10000, &value, err));
        lattice->orient[axis][k] = (int)value;
    }
    return HS_OK;
}

static hs_status read_basis(const hs_args *args, int i, hs_lattice *lattice, hs_error *err)
{
    double fraction[3];
    HS_TRY(read_three(args, i, fraction, err));
    for (int axis = 0; axis < 3; ++axis)
        if (!(fraction[axis] >= 0.0 && fraction[axis] < 1.0))
            return hs_arg_refuse(args, i + axis, "a fraction of the cell, from 0 to less than 1", NULL, err);
    return hs_lattice_add_basis(lattice, fraction, err);
}

/** Keywords of lattice; counts were checked. @p spacing is filled when *has_spacing. */
static hs_status read_lattice_keywords(const hs_args *args, hs_lattice *lattice, double spacing[3], bool *has_spacing,
                                       hs_error *err)
{
    const bool is_custom = strcmp(args->word[0], "custom") == 0;
    for (int i = 2; i < args->n; i += 4) {
        const char *keyword = args->word[i];
        if (strcmp(keyword, "origin") == 0) {
            HS_TRY(read_three(args, i + 1, lattice->origin, err));
        } else if (strcmp(keyword, "orient") == 0) {
            HS_TRY(read_orient(args, i + 1, lattice, err));
            ++i;
        } else if (strcmp(keyword, "spacing") == 0) {
            *has_spacing = true;
            for (int axis = 0; axis < 3; ++axis) HS_TRY(hs_arg_positive(args, i + 1 + axis, &spacing[axis], err));
        } else if (!is_custom) {
            return hs_fail(err, HS_ERROR_INPUT, "lattice: the keyword '%s' is only for the style custom, not for %s",
                           keyword, args->word[0]);
        } else if (strcmp(keyword, "basis") == 0) {
            HS_TRY(read_basis(args, i + 1, lattice, err));
        } else {
            HS_TRY(read_three(args, i + 1, lattice->a[keyword[1] - '1'], err));
        }
    }
    return HS_OK;
}

static hs_status make_lattice(const hs_deck *deck, const hs_args *args, hs_lattice *lattice, hs_error *err)
{
    const int dimension = deck->sim->box.dimension;
    double spacing[3], value;
    bool has_spacing = false;
    if (!hs_lattice_fits_dimension(args->word[0], dimension))
        return hs_fail(err, HS_ERROR_INPUT, "lattice: the style %s is not for %s dimensions; %s", args->word[0],
                       dimension == 2 ? "two" : "three",
                       dimension == 2 ? "sq, sq2, hex and custom are" : "sc, bcc, fcc, hcp, diamond and custom are");
    HS_TRY(hs_arg_positive(args, 1, &value, err));
    HS_TRY(hs_lattice_begin(lattice, args->word[0], err));
    if (!lattice->is_set && args->n > 2)
        return hs_fail(err, HS_ERROR_INPUT, "lattice: unexpected word '%s': the style none has no keywords",
                       args->word[2]);
    HS_TRY(read_lattice_keywords(args, lattice, spacing, &has_spacing, err));
    const hs_lattice_size size = {.value = value,
                                  .is_density = strcmp(deck->sim->env.units->name, "lj") == 0 && lattice->is_set,
                                  .dimension = dimension,
                                  .spacing = has_spacing ? spacing : NULL};
    return hs_lattice_finish(lattice, &size, err);
}

static hs_status lattice_run(hs_deck *deck, const hs_args *args, hs_error *err)
{
    HS_TRY(lattice_check(args, false, err));
    hs_lattice lattice = {0};
    hs_status status = make_lattice(deck, args, &lattice, err);
    if (status != HS_OK) {
        hs_lattice_fini(&lattice);
        return status;
    }
    hs_lattice_fini(&deck->sim->lattice);
    deck->sim->lattice = lattice;
    if (lattice.is_set)
        hs_say(deck->out, "Lattice spacing in x,y,z = %#.8g %#.8g %#.8g\n", lattice.spacing[0], lattice.spacing[1],
               lattice.spacing[2]);
    return HS_OK;
}

/* ---- region ---- */

static hs_status region_check(const hs_args *args, bool has_variables, hs_error *err)
{
    if (is_variable(args->word[0])) return HS_OK;
    const hs_args rest = hs_args_from(args, 1, NULL);
    if (strcmp(rest.word[0], "delete") == 0 && rest.n == 1) return HS_OK;
    return hs_region_check(&rest, has_variables, err);
}

static hs_status region_run(hs_deck *deck, const hs_args *args, hs_error *err)
{
    HS_TRY(region_check(args, false, err));
    if (strcmp(args->word[1], "delete") == 0 && args->n == 2)
        return hs_sim_remove_region(deck->sim, args->word[0], err);
    char command[96];
    snprintf(command, sizeof command, "region %.40s %.40s", args->word[0], args->word[1]);
    const hs_args rest = hs_args_from(args, 2, command);
    return hs_sim_add_region(deck->sim, args->word[0], args->word[1], &rest, err);
}

/* ---- create_box ---- */

static const hs_keyword create_box_keywords[] = {
    {"extra/special/per/atom", 1, "<N>", "room for special neighbors in LAMMPS; no effect"},
    {NULL, 0, NULL, NULL},
};

static hs_status create_box_check(const hs_args *args, bool has_variables, hs_error *err)
{
    static const char *const molecular[] = {"bond/types",
                                            "angle/types",
                                            "dihedral/types",
                                            "improper/types",
                                            "extra/bond/per/atom",
                                            "extra/angle/per/atom",
                                            "extra/dihedral/per/atom",
                                            "extra/improper/per/atom",
                                            NULL};
    for (int i = 2; i < args->n; ++i)
        for (int k = 0; molecular[k] != NULL; ++k)
            if (strcmp(args->word[i], molecular[k]) == 0)
                return hs_fail(err, HS_ERROR_INPUT,
                               "create_box: '%s' is for bonded atoms, which the atom style atomic has not",
                               args->word[i]);
    const hs_syntax syntax = {"<N> <region-ID> [extra/special/per/atom <N>]", 2, 2, create_box_keywords};
    return hs_syntax_check(&syntax, args, has_variables, err);
}

static hs_status check_box_region(hs_sim *sim, const hs_args *args, const hs_region **region, hs_error *err)
{
    HS_TRY(hs_sim_need_region(sim, "create_box", args->word[1], region, err));
    if (!(*region)->has_extent)
        return hs_fail(
            err, HS_ERROR_INPUT,
            "create_box: the region '%s' has no bounds (a plane, side out, or one that follows variables); use a block",
            args->word[1]);
    for (int axis = 0; axis < 3; ++axis) {
        const double lo = (*region)->extent[axis][0], hi = (*region)->extent[axis][1];
        if (!(lo < hi) || !isfinite(lo) || !isfinite(hi) || hi - lo > HS_REGION_FAR)
            return hs_fail(err, HS_ERROR_INPUT,
                           "create_box: the region '%s' extends from %g to %g along %c, which cannot be a box",
                           args->word[1], lo, hi, "xyz"[axis]);
    }
    return HS_OK;
}

static hs_status tilt_box(hs_sim *sim, const hs_region *prism, hs_error *err)
{
    hs_box tilted = sim->box;
    tilted.is_tilted = true;
    memcpy(tilted.lo, prism->prism_lo, sizeof tilted.lo);
    memcpy(tilted.hi, prism->prism_hi, sizeof tilted.hi);
    memcpy(tilted.tilt, prism->prism_tilt, sizeof tilted.tilt);
    HS_TRY(hs_box_check_shape(&tilted, sim->may_be_skewed, sim->env.out, "create_box", err));
    sim->box = tilted;
    return HS_OK;
}

static hs_status create_box_run(hs_deck *deck, const hs_args *args, hs_error *err)
{
    hs_sim *sim = deck->sim;
    hs_box *box = &sim->box;
    const hs_region *region;
    int64_t n_types;
    if (box->exists) return hs_fail(err, HS_ERROR_INPUT, "create_box: there is a box already; 'clear' starts anew");
    HS_TRY(create_box_check(args, false, err));
    HS_TRY(hs_arg_int(args, 0, 1, 10000, &n_types, err));
    HS_TRY(check_box_region(sim, args, &region, err));
    if (box->dimension == 2 && !box->periodic[2])
        return hs_fail(err, HS_ERROR_INPUT,
                       "create_box: in two dimensions the boundary of z must be periodic (boundary x y p)");
    for (int i = 2; i < args->n; i += 2) {
        int64_t ignored;
        HS_TRY(hs_arg_int(args, i + 1, 0, INT32_MAX, &ignored, err));
    }
    HS_TRY(hs_atoms_set_types(&sim->atoms, (int)n_types, err));
    for (int axis = 0; axis < 3; ++axis) {
        box->lo[axis] = region->extent[axis][0];
        box->hi[axis] = region->extent[axis][1];
    }
    if (region->is_prism) HS_TRY(tilt_box(sim, region, err));
    box->exists = true;
    hs_box_say(deck->out, "Created ", box);
    HS_TRY(hs_domain_divide(&sim->domain, box, err));
    hs_say(deck->out, "  %d by %d by %d MPI processor grid\n", sim->domain.n[0], sim->domain.n[1], sim->domain.n[2]);
    hs_box_settle_faces(box);
    hs_sim_atoms_changed(sim);
    return HS_OK;
}

const hs_command hs_commands_box[] = {
    {
        .about =
            {
                .name = "lattice",
                .syntax = {"<style> <scale> [keyword value ...]", 2, 2, lattice_keywords},
                .summary = "Lattice on which atoms are created, and the unit of lengths in regions",
                .details = "`style` is one of `none`; in three dimensions `sc`, `bcc`, `fcc`, `hcp`, `diamond`; in two "
                           "`sq`, `sq2`, `hex`;\n"
                           "and `custom`, which needs at least one `basis`. `scale` is, in units lj, the reduced "
                           "density N sigma^d / V, from\n"
                           "which the length of the cell follows; in other units the length of one lattice unit. The "
                           "hexagonal cells are\n"
                           "rectangular: `hex` 1 by sqrt(3), `hcp` 1 by sqrt(3) by sqrt(8/3).\n\n"
                           "The spacings in x, y and z, which are printed, are the extent of the rotated cell; other "
                           "commands count lengths in\n"
                           "them unless told `units box`. Without a lattice, or after `none 1`, the spacings are 1.\n\n"
                           "The three `orient` vectors must be orthogonal and right-handed. In two dimensions the "
                           "lattice must lie in the\n"
                           "plane. The place of a site is: cell times edges, times scale, rotated, plus spacing times "
                           "origin.\n",
                .example = "lattice fcc 0.8442\nlattice custom 3.52 a1 1 0 0 a2 0.5 0.866 0 a3 0 0 1 basis 0 0 0 basis "
                           "0.5 0.5 0.5",
            },
        .run = lattice_run,
        .check = lattice_check,
    },
    {
        .about =
            {
                .name = "region",
                .syntax = {"<ID> <style> <words> ... [side in|out] [units lattice|box], or <ID> delete", 2, -1, NULL},
                .summary = "A part of space, for making boxes, atoms and groups",
                .details =
                    "The styles are `block`, `cone`, `cylinder`, `plane`, `prism`, `sphere`, `union` and `intersect`; "
                    "each has a page of its own.\n"
                    "`side out` takes the complement. Lengths are in lattice spacings at the time of the command "
                    "(`units lattice`, the\n"
                    "default) or in distance units (`units box`). Periodic images do not count: a region holds what "
                    "lies in it by\n"
                    "coordinates. `delete` removes a region.\n\n"
                    "`move v_dx v_dy v_dz` displaces the region by equal-style variables (distance; NULL: not at all), "
                    "`rotate v_angle Px Py Pz Rx Ry Rz` turns it by one (radians) about the axis through P along R, by "
                    "the right-hand rule, before it is displaced. Radii and centers of spheres and cylinders may be "
                    "variables, too. Whoever asks for such a region finds it as it is at that step. LAMMPS's `open` "
                    "is refused.\n",
                .example =
                    "region box block 0 10 0 10 0 10\nregion gap cylinder z 5 5 2 INF INF side out\nregion gap delete",
            },
        .run = region_run,
        .check = region_check,
    },
    {
        .about =
            {
                .name = "create_box",
                .syntax = {"<N> <region-ID> [extra/special/per/atom <N>]", 2, -1, NULL},
                .summary = "Make the simulation box from a region, with N types of atoms",
                .details =
                    "`N` is the number of atom types, from 1. The box is the extent of the region, which must have "
                    "bounds; of a `prism`\n"
                    "it is a tilted (triclinic) box, periodic along y where xy is not 0, and along z where xz or yz is "
                    "not 0. Shrink-wrapped faces (`boundary s`) start 0.0001 of the box outside of the\n"
                    "region, so that atoms on it are within. In two dimensions z must be periodic. Keywords for bonds "
                    "are refused.\n",
                .example = "region box block 0 20 0 20 0 20\ncreate_box 2 box",
            },
        .run = create_box_run,
        .check = create_box_check,
    },
    {.about = {.name = NULL}},
};
