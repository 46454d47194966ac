/* Commands that make atoms: create_atoms, mass. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "base/text.h"
#include "base/timer.h"
#include "core/atom_style.h"
#include "core/random.h"
#include "deck/command.h"
#include "deck/marsaglia.h"
#include "deck/subset.h"
#include "deck/variables.h"
#include "style/box_shape.h"

typedef enum { CREATE_BOX, CREATE_REGION, CREATE_SINGLE, CREATE_RANDOM } create_style;

static const char *const create_styles[] = {"box", "region", "single", "random", NULL};
/** Words after the style's name. */
static const int create_words[] = {0, 1, 3, 3};

/** One create_atoms command. */
typedef struct creation {
    hs_deck *deck;
    hs_sim *sim;
    create_style style;
    int type;                /**< default type */
    int *basis_type;         /**< owned [n_basis]: type of each basis atom */
    const hs_region *region; /**< NULL: everywhere */
    bool is_lattice_units, remap;
    double place[3]; /**< single: distance */
    int64_t n_random;
    int seed;         /**< random */
    double ratio;     /**< fraction of the sites, or */
    int64_t n_subset; /**< number of sites, to fill; both negative: all */
    int subset_seed;
    const char *test;          /**< variable that must not be 0 at a site; NULL: none */
    const char *coordinate[3]; /**< internal variables that hold x, y, z for it, or NULL */
    double lo[3], hi[3];       /**< where atoms may be: lo <= x < hi, distance; x pushed upright in a tilted box */
    int64_t next_id;
    int64_t n_created; /**< on all ranks */
} creation;

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
                           "create_atoms: the keyword '%s' is for molecules, which are not "
                           "supported",
                           word);
    }
    const hs_syntax syntax = {"<type> box | region <ID> | single <x> <y> <z> | random <N> <seed> <region-ID>|NULL "
                              "[keyword value ...]",
                              2 + create_words[style], 2 + create_words[style], create_keywords};
    return hs_syntax_check(&syntax, args, has_variables, err);
}

static hs_status find_region(hs_sim *sim, const hs_args *args, int i, const hs_region **region, hs_error *err)
{
    *region = hs_sim_find_region(sim, args->word[i]);
    if (*region != NULL) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "%s: there is no region '%s'; the command 'region' makes one", args->command,
                   args->word[i]);
}

static hs_status read_type(const hs_sim *sim, const hs_args *args, int i, int *type, hs_error *err)
{
    int64_t number = 0;
    if (!hs_text_to_int64(args->word[i], &number)) return hs_arg_refuse(args, i, "an atom type", NULL, err);
    if (number < 1 || number > sim->atoms.n_types)
        return hs_fail(err, HS_ERROR_INPUT, "%s: there is no atom type %s; the box was made with %d", args->command,
                       args->word[i], sim->atoms.n_types);
    *type = (int)number;
    return HS_OK;
}

/** ratio and subset. */
static hs_status read_subset(creation *c, const hs_args *args, int i, hs_error *err)
{
    int64_t seed;
    if (c->style != CREATE_BOX && c->style != CREATE_REGION)
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

static hs_status read_keyword(creation *c, const hs_args *args, int *i, hs_error *err)
{
    const char *keyword = args->word[*i];
    static const char *const axes[] = {"x", "y", "z", NULL};
    int64_t number;
    int axis;
    if (strcmp(keyword, "basis") == 0) {
        if (!c->sim->lattice.is_set)
            return hs_fail(err, HS_ERROR_INPUT,
                           "create_atoms: 'basis' needs a lattice: the command 'lattice' comes "
                           "first");
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
static hs_status read_style(creation *c, const hs_args *args, hs_error *err)
{
    int64_t seed;
    if (c->style == CREATE_REGION) HS_TRY(find_region(c->sim, args, 2, &c->region, err));
    if (c->style == CREATE_SINGLE)
        for (int axis = 0; axis < 3; ++axis) HS_TRY(hs_arg_double(args, 2 + axis, &c->place[axis], err));
    if (c->style == CREATE_RANDOM) {
        HS_TRY(hs_arg_int(args, 2, 0, INT32_MAX, &c->n_random, err));
        HS_TRY(hs_arg_int(args, 3, 1, INT32_MAX - 1, &seed, err));
        c->seed = (int)seed;
        if (strcmp(args->word[4], "NULL") != 0) HS_TRY(find_region(c->sim, args, 4, &c->region, err));
    }
    if ((c->style == CREATE_BOX || c->style == CREATE_REGION) && !c->sim->lattice.is_set)
        return hs_fail(err, HS_ERROR_INPUT,
                       "create_atoms: there is no lattice to put atoms on; the command 'lattice' "
                       "makes one");
    return HS_OK;
}

static hs_status read_words(creation *c, const hs_args *args, hs_error *err)
{
    int style;
    HS_TRY(hs_arg_choice(args, 1, create_styles, &style, err));
    c->style = (create_style)style;
    HS_TRY(read_type(c->sim, args, 0, &c->type, err));
    HS_TRY(read_style(c, args, err));
    const int n_basis = c->sim->lattice.n_basis;
    HS_TRY(HS_ALLOC(c->basis_type, (size_t)n_basis, err));
    for (int b = 0; b < n_basis; ++b) c->basis_type[b] = c->type;
    for (int i = 2 + create_words[style]; i < args->n; ++i) HS_TRY(read_keyword(c, args, &i, err));
    const bool has_coordinate = c->coordinate[0] != NULL || c->coordinate[1] != NULL || c->coordinate[2] != NULL;
    if ((c->test != NULL) != has_coordinate)
        return hs_fail(err, HS_ERROR_INPUT,
                       "create_atoms: 'var' and 'set' need each other: set x|y|z <name> names "
                       "the internal variables that the formula reads");
    return HS_OK;
}

/** Where atoms may be. A lattice site on a periodic face, or its image on the opposite one,
    a hair to either side by rounding,
 *  must give exactly one atom: as in LAMMPS, the range is shifted down by a millionth of the box,
     and is that much smaller. */
static void set_bounds(creation *c)
{
    const hs_box *box = &c->sim->box;
    for (int axis = 0; axis < 3; ++axis) {
        const double hair = hs_box_length(box, axis) * 1.0e-6;
        const bool is_lattice = c->style == CREATE_BOX || c->style == CREATE_REGION;
        c->lo[axis] = box->lo[axis];
        c->hi[axis] = box->hi[axis];
        if (!is_lattice || !box->periodic[axis]) continue;
        c->lo[axis] -= hair;
        c->hi[axis] -= 2.0 * hair;
    }
}

static bool is_within(const creation *c, const double x[3])
{
    const hs_box *box = &c->sim->box;
    if (box->is_tilted) {
        for (int axis = 0; axis < 3; ++axis) {
            const double place = hs_box_upright(box, x, axis);
            if (!(place >= c->lo[axis] && place < c->hi[axis])) return false;
        }
        return true;
    }
    for (int axis = 0; axis < 3; ++axis)
        if (!(x[axis] >= c->lo[axis] && x[axis] < c->hi[axis])) return false;
    return true;
}

/** Add an atom with the next ID. All ranks see all atoms, and each keeps those of its brick, so that IDs do not depend on
 *  the number of ranks. */
static hs_status add_atom(creation *c, int type, const double x[3], hs_error *err)
{
    const int64_t id = c->next_id++;
    ++c->n_created;
    if (c->sim->parallel.n_ranks > 1 && !hs_domain_owns(&c->sim->domain, &c->sim->box, x)) return HS_OK;
    return hs_atoms_add(&c->sim->atoms, id, type, x, err);
}

/** Region and variable: may an atom be at x? */
static hs_status test_place(const creation *c, const double x[3], bool *is_wanted, hs_error *err)
{
    *is_wanted = c->region == NULL || hs_region_contains(c->region, x);
    if (!*is_wanted || c->test == NULL) return HS_OK;
    for (int axis = 0; axis < 3; ++axis)
        if (c->coordinate[axis] != NULL)
            HS_TRY(hs_variables_set_internal(c->deck->variables, c->coordinate[axis], x[axis], err));
    double value;
    HS_TRY(c->sim->env.variable_value(c->deck, c->test, &value, err));
    *is_wanted = value != 0.0;
    return HS_OK;
}

static hs_status stop_if_asked(const creation *c, hs_error *err)
{
    if (c->sim->stop_requested == NULL || !*c->sim->stop_requested) return HS_OK;
    return hs_fail(err, HS_INTERRUPTED, "stopped by a signal while atoms were created");
}

/** What encloses the places where atoms may be. */
static void enclose(const creation *c, double lo[3], double hi[3])
{
    hs_box places = c->sim->box;
    memcpy(places.lo, c->lo, sizeof places.lo);
    memcpy(places.hi, c->hi, sizeof places.hi);
    hs_box_bounds(&places, lo, hi);
    for (int axis = 0; axis < 3 && places.is_tilted; ++axis) { /* a hair more, for the shift of the places */
        const double hair = 1e-5 * (hi[axis] - lo[axis]);
        lo[axis] -= hair;
        hi[axis] += hair;
    }
}

/** Go through the sites in LAMMPS's order: the third cell index slowest, then the second, the first, the basis.
 *  @param mark     create atoms where mark[number of the site] is not 0; NULL: everywhere
 *  @param n_sites  if not NULL: count sites, create nothing */
static hs_status visit_sites(creation *c, const unsigned char *mark, int64_t *n_sites, hs_error *err)
{
    const hs_lattice *lattice = &c->sim->lattice;
    double from[3], to[3];
    double least[3], most[3];
    int lo[3], hi[3];
    int64_t n = 0;
    enclose(c, least, most);
    for (int axis = 0; axis < 3; ++axis) { /* no need to look where the region is not */
        const bool is_bounded = c->region != NULL && c->region->has_extent;
        from[axis] = is_bounded ? fmax(least[axis], c->region->extent[axis][0]) : least[axis];
        to[axis] = is_bounded ? fmin(most[axis], c->region->extent[axis][1]) : most[axis];
        if (from[axis] > to[axis]) to[axis] = from[axis];
    }
    HS_TRY(hs_lattice_range(lattice, from, to, lo, hi, err));
    for (int k = lo[2]; k <= hi[2]; ++k)
        for (int j = lo[1]; j <= hi[1]; ++j)
            for (int i = lo[0]; i <= hi[0]; ++i) {
                HS_TRY(stop_if_asked(c, err));
                for (int b = 0; b < lattice->n_basis; ++b) {
                    double x[3];
                    bool is_wanted;
                    hs_lattice_site(lattice, i, j, k, b, x);
                    if (!is_within(c, x)) continue;
                    HS_TRY(test_place(c, x, &is_wanted, err));
                    if (!is_wanted) continue;
                    const int64_t site = n++;
                    if (n_sites == NULL && (mark == NULL || mark[site])) HS_TRY(add_atom(c, c->basis_type[b], x, err));
                }
            }
    if (n_sites != NULL) *n_sites = n;
    return HS_OK;
}

/** A box that is to be filled as a whole tells beforehand whether its atoms find room. */
static hs_status check_room(const creation *c, hs_error *err)
{
    const hs_box *box = &c->sim->box;
    if (c->region != NULL || c->test != NULL || c->ratio >= 0.0 || c->n_subset >= 0) return HS_OK;
    const double n_sites = hs_lattice_density(&c->sim->lattice, box->dimension) * hs_box_volume(box),
                 n_local = n_sites / c->sim->parallel.n_ranks;
    if (n_local < 1e18) return hs_atoms_check_room(&c->sim->atoms, (int64_t)n_local, 0, err);
    return hs_fail(err, HS_ERROR_INPUT, "create_atoms: the box has some %.0e lattice sites; is it in the right units?",
                   n_sites);
}

static hs_status create_on_lattice(creation *c, hs_error *err)
{
    HS_TRY(check_room(c, err));
    if (c->ratio < 0.0 && c->n_subset < 0) return visit_sites(c, NULL, NULL, err);
    int64_t n_sites;
    HS_TRY(visit_sites(c, NULL, &n_sites, err));
    const int64_t n_wanted = c->n_subset >= 0 ? c->n_subset : (int64_t)(c->ratio * (double)n_sites);
    if (n_wanted > n_sites)
        return hs_fail(err, HS_ERROR_INPUT, "create_atoms: a subset of %lld sites is wanted, but there are only %lld",
                       (long long)n_wanted, (long long)n_sites);
    unsigned char *mark = NULL;
    HS_TRY(HS_ALLOC(mark, (size_t)n_sites, err));
    hs_status status = hs_subset_select(mark, n_sites, n_wanted, c->subset_seed, err);
    if (status == HS_OK) status = visit_sites(c, mark, NULL, err);
    HS_FREE(mark);
    return status;
}

static hs_status create_single(creation *c, hs_error *err)
{
    const hs_box *box = &c->sim->box;
    double x[3];
    for (int axis = 0; axis < 3; ++axis)
        x[axis] = c->is_lattice_units ? c->place[axis] * c->sim->lattice.spacing[axis] : c->place[axis];
    if (c->remap) {
        int32_t image[3] = {0, 0, 0};
        for (int axis = 0; axis < 3; ++axis)
            if (box->periodic[axis] && !(x[axis] > box->lo[axis] - 1000.0 * hs_box_length(box, axis) &&
                                         x[axis] < box->hi[axis] + 1000.0 * hs_box_length(box, axis)))
                return hs_fail(err, HS_ERROR_INPUT, "create_atoms: the place %g along %c is more than 1000 boxes away",
                               x[axis], "xyz"[axis]);
        for (int n = 0; n < 1001; ++n) hs_box_wrap(box, x, image);
    }
    return is_within(c, x) ? add_atom(c, c->type, x, err) : HS_OK;
}

/** The part of the box where random atoms are drawn: a bounded region's extent cuts it. */
static hs_status random_range(const creation *c, double lo[3], double hi[3], hs_error *err)
{
    hs_box_bounds(&c->sim->box, lo, hi);
    for (int axis = 0; axis < 3; ++axis) {
        if (c->region == NULL || !c->region->has_extent) continue;
        if (c->region->extent[axis][0] > lo[axis]) lo[axis] = c->region->extent[axis][0];
        if (c->region->extent[axis][1] < hi[axis]) hi[axis] = c->region->extent[axis][1];
        if (lo[axis] > hi[axis])
            return hs_fail(err, HS_ERROR_INPUT, "create_atoms: the region '%s' lies outside of the box along %c",
                           c->region->id, "xyz"[axis]);
    }
    return HS_OK;
}

static hs_status create_random(creation *c, hs_error *err)
{
    enum { N_WARM_UP = 30, N_TRIES = 50000000 };
    double lo[3], hi[3];
    hs_park park;
    HS_TRY(random_range(c, lo, hi, err));
    HS_TRY(hs_atoms_check_room(&c->sim->atoms, c->n_random / c->sim->parallel.n_ranks, 0, err));
    hs_park_init(&park, c->seed);
    for (int n = 0; n < N_WARM_UP; ++n) (void)hs_park_uniform(&park);
    for (int64_t n = 0; n < c->n_random; ++n) {
        HS_TRY(stop_if_asked(c, err));
        bool is_wanted = false;
        double x[3];
        for (int try = 0; !is_wanted; ++try) {
            if (try == N_TRIES)
                return hs_fail(err, HS_ERROR_INPUT,
                               "create_atoms: %d tries found no place for a random atom; does "
                               "the region have a volume inside of the box?",
                               N_TRIES);
            for (int axis = 0; axis < 3; ++axis) x[axis] = lo[axis] + hs_park_uniform(&park) * (hi[axis] - lo[axis]);
            if (c->sim->box.dimension == 2) x[2] = lo[2] + 0.5 * (hi[2] - lo[2]);
            /* what encloses a tilted box has places outside of it */
            if (!c->sim->box.is_tilted || is_within(c, x)) HS_TRY(test_place(c, x, &is_wanted, err));
        }
        if (is_within(c, x)) HS_TRY(add_atom(c, c->type, x, err));
    }
    return HS_OK;
}

static hs_status create_all(creation *c, const hs_args *args, hs_error *err)
{
    HS_TRY(read_words(c, args, err));
    set_bounds(c);
    int64_t max_id = hs_atoms_max_id(&c->sim->atoms);
    hs_parallel_max_int64(&c->sim->parallel, &max_id, 1);
    c->next_id = max_id + 1;
    switch (c->style) {
    case CREATE_SINGLE:
        return create_single(c, err);
    case CREATE_RANDOM:
        return create_random(c, err);
    default:
        return create_on_lattice(c, err);
    }
}

static hs_status create_atoms_run(hs_deck *deck, const hs_args *args, hs_error *err)
{
    const double start_s = hs_time_now_s();
    hs_sim *sim = deck->sim;
    HS_TRY(hs_sim_need_box(sim, args->command, err));
    HS_TRY(create_check(args, false, err));
    creation c = {.deck = deck, .sim = sim, .is_lattice_units = true, .ratio = -1.0, .n_subset = -1};
    (void)create_all(&c, args, err);
    HS_FREE(c.basis_type);
    const hs_status status = hs_parallel_agree(&sim->parallel, err);
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
                .syntax =
                    {"<type> box | region <ID> | single <x> <y> <z> | random <N> <seed> <region-ID>|NULL [keyword "
                     "value ...]",
                     2, -1, create_keywords},
                .summary = "Create atoms on the lattice, at one place, or at random places",
                .details =
                    "`box` fills the box with atoms on the sites of the lattice, `region` only a region of it. Sites "
                    "on "
                    "the lower face\n"
                    "of a periodic box are filled, those on the upper face are not; on other faces, lower ones belong "
                    "to "
                    "the box,\n"
                    "upper ones do not. IDs go on from the highest one; the third lattice direction is the slowest, "
                    "basis "
                    "atoms are\n"
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
                .details =
                    "`type` is a number or a range (`*`, `2*`, `*3`, `2*3`); `mass` is greater than 0, in mass units. "
                    "Every type needs\n"
                    "one before the first run or the first `velocity`. The box must exist. Atoms of style sphere have "
                    "masses of "
                    "their own: there the command is refused, or, with `hybrid dipole sphere`, its values are not used "
                    "(as in "
                    "LAMMPS).\n",
                .example = "mass 1 1.0\nmass * 39.95",
            },
        .run = mass_run,
    },
    {.about = {.name = NULL}},
};
