/* The command change_box. */
#include <math.h>
#include <string.h>

#include "deck/command.h"
#include "deck/place_atoms.h"
#include "style/box_change.h"
#include "style/box_flow.h"
#include "style/box_shape.h"

/** The operations; the first three are lengths, the next three tilts. */
typedef enum {
    LENGTH_X,
    LENGTH_Z = 2,
    TILT_XY,
    TILT_YZ = TILT_XY + 2,
    BOUNDARY,
    ORTHO,
    TRICLINIC,
    SET,
    REMAP,
    UNITS
} box_word;
static const char *const box_words[] = {"x",     "y",         "z",   "xy",    "xz",    "yz", "boundary",
                                        "ortho", "triclinic", "set", "remap", "units", NULL};
static const char *const length_changes[] = {"final", "delta", "scale", "volume", NULL};
static const char *const tilt_changes[] = {"final", "delta", NULL};

/** The operation at word i, and how many words it has, itself included; an error when it is none. */
static hs_status find_operation(const hs_args *args, int i, box_word *word, int *n_words, hs_error *err)
{
    static const int lengths[] = {0, 0, 0, 3, 3, 3, 4, 1, 1, 1, 1, 2};
    static const int length_words[] = {4, 4, 3, 2};
    int which, change;
    HS_TRY(hs_arg_choice(args, i, box_words, &which, err));
    *word = (box_word)which;
    *n_words = lengths[which];
    if (*word <= LENGTH_Z) {
        HS_TRY(hs_arg_need(args, i + 1, "final, delta, scale or volume", err));
        HS_TRY(hs_arg_choice(args, i + 1, length_changes, &change, err));
        *n_words = length_words[change];
    } else if (*word <= TILT_YZ) {
        HS_TRY(hs_arg_need(args, i + 1, "final or delta", err));
        HS_TRY(hs_arg_choice(args, i + 1, tilt_changes, &change, err));
    }
    return hs_arg_need(args, i + *n_words - 1, "a word of the last operation", err);
}

static hs_status change_check(const hs_args *args, bool has_variables, hs_error *err)
{
    box_word word;
    int n_words;
    if (has_variables) return HS_OK;
    for (int i = 1; i < args->n; i += n_words) HS_TRY(find_operation(args, i, &word, &n_words, err));
    return HS_OK;
}

/** A change_box command under way. */
typedef struct change {
    hs_sim *sim;
    uint32_t mask;
    double scale[3]; /**< unit of lengths, distance */
    hs_box set;      /**< box that remap starts from */
    double v_before; /**< volume before the operation that changed it last; 0: none has */
} change;

static double volume_of(const hs_box *box)
{
    return hs_box_length(box, 0) * hs_box_length(box, 1) * hs_box_length(box, 2);
}

/** Another length around the same middle. */
static void set_length(hs_box *box, int axis, double length)
{
    const double middle = 0.5 * (box->lo[axis] + box->hi[axis]);
    box->lo[axis] = middle - 0.5 * length;
    box->hi[axis] = middle + 0.5 * length;
}

/** Whether word i begins `x volume` or the like. */
static bool is_volume(const hs_args *args, int i)
{
    return i + 1 < args->n && strchr("xyz", args->word[i][0]) != NULL && args->word[i][1] == '\0' &&
           strcmp(args->word[i + 1], "volume") == 0;
}

/** Give back the volume that the operation before has changed; two axes in turn share the work. */
static hs_status keep_volume(change *c, const hs_args *args, int i, int *n_used, hs_error *err)
{
    hs_box *box = &c->sim->box;
    const int axis = args->word[i][0] - 'x', other = is_volume(args, i + 2) ? args->word[i + 2][0] - 'x' : axis;
    if (c->v_before == 0.0)
        return hs_fail(err, HS_ERROR_INPUT,
                       "%s: '%s volume' must follow an operation that has changed the volume, such as 'x scale 1.1'",
                       args->command, args->word[i]);
    const double ratio = c->v_before / volume_of(box);
    c->v_before = 0.0;
    *n_used = other != axis ? 4 : 2;
    set_length(box, axis, hs_box_length(box, axis) * (other != axis ? sqrt(ratio) : ratio));
    if (other != axis) set_length(box, other, hs_box_length(box, other) * sqrt(ratio));
    return HS_OK;
}

/** x final, delta or scale. */
static hs_status set_axis(change *c, const hs_args *args, int i, hs_error *err)
{
    hs_box *box = &c->sim->box;
    const int axis = args->word[i][0] - 'x';
    double number[2];
    c->v_before = volume_of(box);
    HS_TRY(hs_arg_double(args, i + 2, &number[0], err));
    if (args->word[i + 1][0] == 's') {
        HS_TRY(hs_arg_positive(args, i + 2, &number[0], err));
        set_length(box, axis, hs_box_length(box, axis) * number[0]);
        return HS_OK;
    }
    HS_TRY(hs_arg_double(args, i + 3, &number[1], err));
    const bool is_delta = args->word[i + 1][0] == 'd';
    const double lo = (is_delta ? box->lo[axis] : 0.0) + c->scale[axis] * number[0],
                 hi = (is_delta ? box->hi[axis] : 0.0) + c->scale[axis] * number[1];
    if (!(hi > lo))
        return hs_fail(err, HS_ERROR_INPUT, "%s: the box would reach from %g to %g in %c", args->command, lo, hi,
                       "xyz"[axis]);
    box->lo[axis] = lo;
    box->hi[axis] = hi;
    return HS_OK;
}

/** xy, xz or yz. */
static hs_status set_tilt(change *c, const hs_args *args, int i, int tilt, hs_error *err)
{
    hs_box *box = &c->sim->box;
    double number;
    if (!box->is_tilted)
        return hs_fail(err, HS_ERROR_INPUT,
                       "%s: an orthogonal box has no tilt %s; the operation 'triclinic' before it makes the box one "
                       "that can be tilted",
                       args->command, args->word[i]);
    HS_TRY(hs_arg_double(args, i + 2, &number, err));
    const double before = args->word[i + 1][0] == 'd' ? box->tilt[tilt] : 0.0;
    box->tilt[tilt] = before + c->scale[hs_tilt_first(tilt)] * number;
    return hs_box_check_shape(box, c->sim->may_be_skewed, c->sim->env.out, args->command, err);
}

/** ortho or triclinic. */
static hs_status set_kind(change *c, bool is_tilted, const hs_args *args, hs_error *err)
{
    hs_box *box = &c->sim->box;
    if (c->sim->n_dumps > 0)
        return hs_fail(err, HS_ERROR_INPUT,
                       "%s: a box cannot become triclinic or orthogonal while there are dumps: 'undump' ends them",
                       args->command);
    for (int k = 0; k < 3 && !is_tilted; ++k)
        if (box->tilt[k] != 0.0)
            return hs_fail(err, HS_ERROR_INPUT,
                           "%s: the box is tilted (%s = %g) and cannot be made orthogonal; '%s final 0' comes first",
                           args->command, hs_tilt_names[k], box->tilt[k], hs_tilt_names[k]);
    box->is_tilted = is_tilted;
    c->set.is_tilted = is_tilted; /* the same box with another name */
    return HS_OK;
}

static hs_status set_boundary(change *c, const hs_args *args, int i, hs_error *err)
{
    hs_box *box = &c->sim->box;
    if (c->sim->n_dumps > 0)
        return hs_fail(err, HS_ERROR_INPUT, "%s: boundaries cannot change while there are dumps: 'undump' ends them",
                       args->command);
    for (int axis = 0; axis < 3; ++axis) {
        HS_TRY(hs_boundary_read(args, i + 1 + axis, axis, box->boundary[axis], err));
        box->periodic[axis] = box->boundary[axis][0] == HS_BOUNDARY_PERIODIC;
    }
    return HS_OK;
}

/** The atoms of the group go along from the box that was set last to the present one. */
static void remap(change *c)
{
    const hs_box to = c->sim->box;
    memcpy(c->sim->box.lo, c->set.lo, sizeof to.lo);
    memcpy(c->sim->box.hi, c->set.hi, sizeof to.hi);
    memcpy(c->sim->box.tilt, c->set.tilt, sizeof to.tilt);
    hs_box_change(&c->sim->env, to.lo, to.hi, to.tilt, c->mask);
    c->set = c->sim->box;
}

static hs_status carry_out(change *c, const hs_args *args, int i, int *n_used, hs_error *err)
{
    hs_box *box = &c->sim->box;
    box_word word;
    HS_TRY(find_operation(args, i, &word, n_used, err));
    switch (word) {
    case UNITS:
        return HS_OK;
    case BOUNDARY:
        HS_TRY(set_boundary(c, args, i, err));
        return hs_box_check_tilt(box, args->command, err);
    case ORTHO:
    case TRICLINIC:
        return set_kind(c, word == TRICLINIC, args, err);
    case SET:
        c->set = *box;
        return HS_OK;
    case REMAP:
        remap(c);
        return HS_OK;
    default:
        break;
    }
    if (word > LENGTH_Z) return set_tilt(c, args, i, (int)word - TILT_XY, err);
    if (word == LENGTH_Z && box->dimension == 2)
        return hs_fail(err, HS_ERROR_INPUT, "%s: a 2d box keeps its length in z", args->command);
    HS_TRY(is_volume(args, i) ? keep_volume(c, args, i, n_used, err) : set_axis(c, args, i, err));
    return hs_box_check_shape(box, c->sim->may_be_skewed, c->sim->env.out, args->command, err);
}

static hs_status read_units(change *c, const hs_args *args, hs_error *err)
{
    static const char *const units[] = {"lattice", "box", NULL};
    int which = 0, n_words;
    box_word word;
    for (int i = 1; i < args->n; i += n_words) {
        HS_TRY(find_operation(args, i, &word, &n_words, err));
        if (word == UNITS) HS_TRY(hs_arg_choice(args, i + 1, units, &which, err));
    }
    for (int axis = 0; axis < 3; ++axis) c->scale[axis] = which == 0 ? c->sim->lattice.spacing[axis] : 1.0;
    return HS_OK;
}

static hs_status change_run(hs_deck *deck, const hs_args *args, hs_error *err)
{
    hs_sim *sim = deck->sim;
    hs_box *box = &sim->box;
    change c = {.sim = sim};
    int bit, n_used;
    HS_TRY(hs_sim_need_box(sim, args->command, err));
    HS_TRY(hs_groups_get(&sim->groups, args->word[0], &bit, err));
    c.mask = hs_group_mask(bit);
    HS_TRY(read_units(&c, args, err));
    HS_TRY(hs_atoms_bring_back(sim, args->command, err)); /* first: those that do not follow stay where they are */
    hs_sim_shrink_box(sim); /* to the atoms as they are now, from which new margins and lengths follow, as in LAMMPS */
    c.set = *box;
    sim->env.position_magic = 0.0; /* between runs positions are on no grid */
    for (int i = 1; i < args->n; i += n_used) HS_TRY(carry_out(&c, args, i, &n_used, err));
    hs_box_settle_faces(box);
    hs_sim_shrink_box(sim);
    HS_TRY(hs_atoms_wrap_all(sim, args->command, err));
    hs_sim_atoms_changed(sim);
    hs_box_say(deck->out, "Changing box ...\n  ", box);
    return HS_OK;
}

const hs_command hs_commands_change_box[] = {
    {
        .about =
            {
                .name = "change_box",
                .syntax = {"<group-ID> <x|y|z> final <lo> <hi> | delta <dlo> <dhi> | scale <factor> | volume ... "
                           "<xy|xz|yz> final <tilt> | delta <dtilt> ... [triclinic|ortho] [boundary <x> <y> <z>] [set] "
                           "[remap] [units lattice|box]",
                           2, -1, NULL},
                .summary = "Change the lengths, tilts and boundaries of the box between runs",
                .details =
                    "Operations are carried out one after the other. `final` sets the bounds of an axis, `delta` moves "
                    "them, `scale` multiplies the length about its middle, `volume` gives the volume back that the "
                    "operation before has changed; two `volume` in a row share that. `xy`, `xz` and `yz` set a tilt "
                    "(`final`) or add to it (`delta`); `triclinic` makes an orthogonal box one that can be tilted, "
                    "`ortho` the opposite, when all tilts are 0. A tilt may be half of the length along its first "
                    "axis, unless `box tilt large` came before the box was made.\n\n"
                    "Atoms stay where they are, until `remap` brings those of the group along: from the box at the "
                    "start of the command, or at the last `set` or `remap`, to the present one. In the end atoms "
                    "outside of a periodic box are wrapped into it. `boundary` sets new boundaries (see "
                    "`boundary`).\n\n"
                    "Lengths are in lattice spacings unless `units box` is said: `xy` and `xz` in that of x, `yz` in "
                    "that of y.\n",
                .example = "change_box all x scale 1.1 y volume z volume remap\n"
                           "change_box all z final -5 25 boundary p p f units box\n"
                           "change_box all triclinic xy final 0.5 remap units box",
            },
        .run = change_run,
        .check = change_check,
    },
    {.about = {.name = NULL}},
};
