/* The command displace_atoms. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "core/random.h"
#include "deck/command.h"
#include "deck/place_atoms.h"
#include "style/places.h"
#include "style/unit_vector.h"

typedef enum { DISPLACE_MOVE, DISPLACE_RAMP, DISPLACE_RANDOM, DISPLACE_ROTATE } displace_style;
static const char *const displace_styles[] = {"move", "ramp", "random", "rotate", NULL};
static const int displace_words[] = {3, 6, 4, 7};

static const hs_keyword displace_keywords[] = {
    {"units", 1, "lattice|box", "lengths are in lattice spacings (default) or in distance units"},
    {NULL, 0, NULL, NULL},
};

static hs_status displace_check(const hs_args *args, bool has_variables, hs_error *err)
{
    int style;
    if (strchr(args->word[1], '$') != NULL) return HS_OK;
    HS_TRY(hs_arg_choice(args, 1, displace_styles, &style, err));
    const hs_syntax syntax = {"<group-ID> move <dx> <dy> <dz> | ramp <x|y|z> <d1> <d2> <x|y|z> <c1> <c2> | random <dx> "
                              "<dy> <dz> <seed> | rotate <Px> <Py> <Pz> <Rx> <Ry> <Rz> <theta> [units lattice|box]",
                              2 + displace_words[style], 2 + displace_words[style], displace_keywords};
    return hs_syntax_check(&syntax, args, has_variables, err);
}

/** One displace_atoms command. */
typedef struct displacement {
    hs_deck *deck;
    hs_atoms *atoms;
    uint32_t mask;
    double scale[3]; /**< distance */
} displacement;

static hs_status move_axis(const displacement *d, const hs_args *args, int axis, hs_error *err)
{
    const char *word = args->word[2 + axis];
    const hs_atoms *atoms = d->atoms;
    double number = 0.0, *values = NULL;
    hs_status status = HS_OK;
    if (strncmp(word, "v_", 2) != 0) {
        HS_TRY(hs_arg_double(args, 2 + axis, &number, err));
    } else {
        HS_TRY(HS_ALLOC(values, (size_t)atoms->n_local, err));
        status = d->deck->sim->env.variable_atoms(d->deck, word + 2, values, err);
    }
    for (int i = 0; i < atoms->n_local && status == HS_OK; ++i)
        if (atoms->mask[i] & d->mask) atoms->x[axis][i] += d->scale[axis] * (values != NULL ? values[i] : number);
    HS_FREE(values);
    return status;
}

static hs_status move(const displacement *d, const hs_args *args, hs_error *err)
{
    for (int axis = 0; axis < 3; ++axis) HS_TRY(move_axis(d, args, axis, err));
    return HS_OK;
}

static hs_status ramp(const displacement *d, const hs_args *args, hs_error *err)
{
    static const char *const axes[] = {"x", "y", "z", NULL};
    const hs_atoms *atoms = d->atoms;
    int moved, along;
    double step[2], place[2];
    HS_TRY(hs_arg_choice(args, 2, axes, &moved, err));
    HS_TRY(hs_arg_choice(args, 5, axes, &along, err));
    for (int end = 0; end < 2; ++end) {
        HS_TRY(hs_arg_double(args, 3 + end, &step[end], err));
        HS_TRY(hs_arg_double(args, 6 + end, &place[end], err));
        step[end] *= d->scale[moved];
        place[end] *= d->scale[along];
    }
    if (place[0] == place[1])
        return hs_fail(err, HS_ERROR_INPUT, "%s: the ramp begins and ends at the same coordinate, %s", args->command,
                       args->word[6]);
    for (int i = 0; i < atoms->n_local; ++i) {
        if (!(atoms->mask[i] & d->mask)) continue;
        const double fraction = fmin(fmax((atoms->x[along][i] - place[0]) / (place[1] - place[0]), 0.0), 1.0);
        atoms->x[moved][i] += step[0] + fraction * (step[1] - step[0]);
    }
    return HS_OK;
}

/** As LAMMPS does: the numbers of an atom come from the seed and its place. */
static hs_status shake(const displacement *d, const hs_args *args, hs_error *err)
{
    const hs_atoms *atoms = d->atoms;
    double size[3];
    int64_t seed;
    for (int axis = 0; axis < 3; ++axis) {
        HS_TRY(hs_arg_double(args, 2 + axis, &size[axis], err));
        size[axis] *= d->scale[axis];
    }
    HS_TRY(hs_arg_int(args, 5, 1, INT32_MAX - 1, &seed, err));
    for (int i = 0; i < atoms->n_local; ++i) {
        const double x[3] = {atoms->x[0][i], atoms->x[1][i], atoms->x[2][i]};
        hs_park park;
        if (!(atoms->mask[i] & d->mask)) continue;
        hs_park_init(&park, (int)seed);
        hs_park_reset_at(&park, (int)seed, x);
        for (int axis = 0; axis < 3; ++axis) atoms->x[axis][i] += size[axis] * 2.0 * (hs_park_uniform(&park) - 0.5);
    }
    return HS_OK;
}

/** Rotation of the unwrapped places by an angle about an axis through a point: the part of r along the axis stays, the
 *  rest turns. */
static hs_status rotate(const displacement *d, const hs_args *args, hs_error *err)
{
    const hs_env *env = &d->deck->sim->env;
    const hs_atoms *atoms = d->atoms;
    double point[3], u[3], theta;
    for (int axis = 0; axis < 3; ++axis) {
        HS_TRY(hs_arg_double(args, 2 + axis, &point[axis], err));
        point[axis] *= d->scale[axis];
    }
    HS_TRY(hs_arg_direction(args, 5, u, err));
    HS_TRY(hs_arg_double(args, 8, &theta, err));
    if (d->deck->sim->box.dimension == 2 && (u[0] != 0.0 || u[1] != 0.0))
        return hs_fail(err, HS_ERROR_INPUT, "%s: a 2d system can turn about the z axis only", args->command);
    const double cosine = cos(theta * M_PI / 180.0), sine = sin(theta * M_PI / 180.0);
    for (int i = 0; i < atoms->n_local; ++i) {
        double r[3];
        if (!(atoms->mask[i] & d->mask)) continue;
        for (int axis = 0; axis < 3; ++axis) r[axis] = hs_unwrapped(env, axis, i) - point[axis];
        const double along = r[0] * u[0] + r[1] * u[1] + r[2] * u[2];
        for (int axis = 0; axis < 3; ++axis) {
            const int next = (axis + 1) % 3, after = (axis + 2) % 3;
            const double rest = r[axis] - along * u[axis], turned = u[next] * r[after] - u[after] * r[next];
            atoms->x[axis][i] += along * u[axis] + rest * cosine + turned * sine - r[axis];
        }
    }
    return HS_OK;
}

static hs_status displace(const displacement *d, int style, const hs_args *args, hs_error *err)
{
    switch ((displace_style)style) {
    case DISPLACE_MOVE:
        return move(d, args, err);
    case DISPLACE_RAMP:
        return ramp(d, args, err);
    case DISPLACE_RANDOM:
        return shake(d, args, err);
    default:
        return rotate(d, args, err);
    }
}

static hs_status displace_run(hs_deck *deck, const hs_args *args, hs_error *err)
{
    hs_sim *sim = deck->sim;
    displacement d = {.deck = deck, .atoms = &sim->atoms};
    int bit, style;
    bool is_box = false;
    HS_TRY(displace_check(args, false, err));
    HS_TRY(hs_sim_need_box(sim, args->command, err));
    HS_TRY(hs_groups_get(&sim->groups, args->word[0], &bit, err));
    HS_TRY(hs_arg_choice(args, 1, displace_styles, &style, err));
    for (int i = 2 + displace_words[style]; i + 1 < args->n; i += 2) is_box = strcmp(args->word[i + 1], "box") == 0;
    d.mask = hs_group_mask(bit);
    for (int axis = 0; axis < 3; ++axis) d.scale[axis] = is_box ? 1.0 : sim->lattice.spacing[axis];
    (void)displace(&d, style, args, err);
    HS_TRY(hs_atoms_wrap_all(sim, args->command, err));
    hs_sim_shrink_box(sim); /* at once, as in LAMMPS: walls at EDGE are made where the faces are then */
    hs_sim_atoms_changed(sim);
    return HS_OK;
}

const hs_command hs_commands_displace[] = {
    {
        .about =
            {
                .name = "displace_atoms",
                .syntax = {"<group-ID> <style> <words> ... [keyword value ...]", 5, -1, NULL},
                .summary = "Move atoms between runs",
                .details = "`move <dx> <dy> <dz>` moves the atoms of a group; a number may be an equal- or atom-style "
                           "variable `v_name`, whose values are in the same unit.\n\n"
                           "`ramp <x|y|z> <d1> <d2> <x|y|z> <c1> <c2>` moves them along the first axis by d1 where "
                           "their coordinate along the second is c1 or below, by d2 where it is c2 or above, and by "
                           "what lies between in between.\n\n"
                           "`random <dx> <dy> <dz> <seed>` moves each by random amounts between -dx and dx and so on, "
                           "which are those of LAMMPS, on any number of ranks.\n\n"
                           "`rotate <Px> <Py> <Pz> <Rx> <Ry> <Rz> <theta>` turns them by theta degrees about the axis "
                           "R through the point P: as in LAMMPS from their unwrapped places, so that what crosses a "
                           "face stays in one piece.\n\n"
                           "Lengths are in lattice spacings unless `units box` is said. Atoms that leave a periodic "
                           "box come back on the other side; nothing keeps atoms from being moved onto one another.\n",
                .example = "displace_atoms top move 0 -5 0 units box\ndisplace_atoms all random 0.1 0.1 0.1 4711\n"
                           "displace_atoms grain rotate 5 5 0 0 0 1 30",
            },
        .run = displace_run,
        .check = displace_check,
    },
    {.about = {.name = NULL}},
};
