/* The command change_box. */
#include <math.h>
#include <string.h>

#include "deck/command.h"
#include "deck/place_atoms.h"
#include "style/box_change.h"

static hs_status refuse_tilted(const hs_args *args, int i, hs_error *err)
{
    static const char *const words[] = {"xy", "xz", "yz", "triclinic", NULL};
    for (int k = 0; words[k] != NULL; ++k)
        if (strcmp(args->word[i], words[k]) == 0)
            return hs_fail(err, HS_ERROR_INPUT,
                           "%s: '%s' is about tilted boxes, which this version does not have; x, y and z change the "
                           "lengths of the box",
                           args->command, words[k]);
    return HS_OK;
}

static const char *const box_words[] = {"x", "y", "z", "boundary", "ortho", "set", "remap", "units", NULL};
static const char *const box_changes[] = {"final", "delta", "scale", "volume", NULL};

/** Words of the operation at word i, itself included; an error when it is none. */
static hs_status operation_length(const hs_args *args, int i, int *n_words, hs_error *err)
{
    static const int lengths[] = {0, 0, 0, 4, 1, 1, 1, 2};
    static const int change_lengths[] = {4, 4, 3, 2};
    int word, change;
    HS_TRY(refuse_tilted(args, i, err));
    HS_TRY(hs_arg_choice(args, i, box_words, &word, err));
    *n_words = lengths[word];
    if (word < 3) {
        HS_TRY(hs_arg_need(args, i + 1, "final, delta, scale or volume", err));
        HS_TRY(hs_arg_choice(args, i + 1, box_changes, &change, err));
        *n_words = change_lengths[change];
    }
    return hs_arg_need(args, i + *n_words - 1, "a word of the last operation", err);
}

static hs_status change_check(const hs_args *args, bool has_variables, hs_error *err)
{
    int n_words;
    if (has_variables) return HS_OK;
    for (int i = 1; i < args->n; i += n_words) HS_TRY(operation_length(args, i, &n_words, err));
    return HS_OK;
}

/** A change_box command under way. */
typedef struct change {
    hs_sim *sim;
    uint32_t mask;
    double scale[3];             /**< unit of lengths, distance */
    double set_lo[3], set_hi[3]; /**< box that remap starts from */
    double v_before;             /**< volume before the operation that changed it last; 0: none has */
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

static void remember_box(change *c)
{
    memcpy(c->set_lo, c->sim->box.lo, sizeof c->set_lo);
    memcpy(c->set_hi, c->sim->box.hi, sizeof c->set_hi);
}

/** The atoms of the group go along from the box that was set last to the present one. */
static void remap(change *c)
{
    hs_box *box = &c->sim->box;
    double lo[3], hi[3];
    memcpy(lo, box->lo, sizeof lo);
    memcpy(hi, box->hi, sizeof hi);
    memcpy(box->lo, c->set_lo, sizeof box->lo);
    memcpy(box->hi, c->set_hi, sizeof box->hi);
    hs_box_change(&c->sim->env, lo, hi, NULL, c->mask);
    remember_box(c);
}

static hs_status carry_out(change *c, const hs_args *args, int i, int *n_used, hs_error *err)
{
    const char *word = args->word[i];
    HS_TRY(operation_length(args, i, n_used, err));
    if (strcmp(word, "units") == 0 || strcmp(word, "ortho") == 0) return HS_OK;
    if (strcmp(word, "boundary") == 0) return set_boundary(c, args, i, err);
    if (strcmp(word, "set") == 0) remember_box(c);
    if (strcmp(word, "remap") == 0) remap(c);
    if (strlen(word) > 1) return HS_OK;
    if (word[0] == 'z' && c->sim->box.dimension == 2)
        return hs_fail(err, HS_ERROR_INPUT, "%s: a 2d box keeps its length in z", args->command);
    return is_volume(args, i) ? keep_volume(c, args, i, n_used, err) : set_axis(c, args, i, err);
}

static hs_status read_units(change *c, const hs_args *args, hs_error *err)
{
    static const char *const units[] = {"lattice", "box", NULL};
    int which = 0, n_words;
    for (int i = 1; i < args->n; i += n_words) {
        HS_TRY(operation_length(args, i, &n_words, err));
        if (strcmp(args->word[i], "units") == 0) HS_TRY(hs_arg_choice(args, i + 1, units, &which, err));
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
    remember_box(&c);
    sim->env.position_magic = 0.0; /* between runs positions are on no grid */
    for (int i = 1; i < args->n; i += n_used) HS_TRY(carry_out(&c, args, i, &n_used, err));
    hs_box_settle_faces(box);
    HS_TRY(hs_atoms_wrap_all(sim, args->command, err));
    hs_sim_atoms_changed(sim);
    hs_say(deck->out, "Changing box ...\n  orthogonal box = (%#.8g %#.8g %#.8g) to (%#.8g %#.8g %#.8g)\n", box->lo[0],
           box->lo[1], box->lo[2], box->hi[0], box->hi[1], box->hi[2]);
    return HS_OK;
}

const hs_command hs_commands_change_box[] = {
    {
        .about =
            {
                .name = "change_box",
                .syntax = {"<group-ID> <x|y|z> final <lo> <hi> | delta <dlo> <dhi> | scale <factor> | volume ... "
                           "[boundary <x> <y> <z>] [set] [remap] [units lattice|box]",
                           2, -1, NULL},
                .summary = "Change the lengths and boundaries of the box between runs",
                .details =
                    "Operations are carried out one after the other. `final` sets the bounds of an axis, `delta` moves "
                    "them, `scale` multiplies the length about its middle, `volume` gives the volume back that the "
                    "operation before has changed; two `volume` in a row share that.\n\n"
                    "Atoms stay where they are, until `remap` brings those of the group along: from the box at the "
                    "start "
                    "of the command, or at the last `set` or `remap`, to the present one. In the end atoms outside of "
                    "a periodic box are wrapped into it. `boundary` sets new boundaries (see `boundary`).\n\n"
                    "Lengths are in lattice spacings unless `units box` is said. Tilted boxes are not supported.\n",
                .example = "change_box all x scale 1.1 y volume z volume remap\n"
                           "change_box all z final -5 25 boundary p p f units box",
            },
        .run = change_run,
        .check = change_check,
    },
    {.about = {.name = NULL}},
};
