/* Holds the center of mass of a group at a place by shifting atoms after each drift. */
#include <math.h>
#include <string.h>

#include "core/lattice.h"
#include "style/fix.h"
#include "style/moments.h"
#include "style/places.h"

typedef struct recenter_state {
    bool is_held[3];    /**< NULL: this direction is free */
    bool is_initial[3]; /**< INIT: where it was at the start of the run */
    double word[3];     /**< as in the deck */
    enum { IN_BOX, IN_LATTICE, IN_FRACTIONS } units;
    double initial[3]; /**< distance, unwrapped */
    uint32_t shifted;  /**< groups that are moved */
    double shift[3];   /**< of the latest step, distance */
} recenter_state;

static const hs_keyword keywords[] = {
    {"shift", 1, "<group-ID>", "the atoms that are moved; default the fix's group"},
    {"units", 1, "lattice|box|fraction", "of the place; fraction: of the box; default lattice"},
    {NULL, 0, NULL, NULL},
};

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    static const char *const units[] = {"box", "lattice", "fraction", NULL};
    recenter_state *state = fix->state;
    HS_TRY(hs_syntax_check(&fix->style->about.syntax, args, false, err));
    state->shifted = fix->mask;
    state->units = IN_LATTICE;
    for (int axis = 0; axis < 3; ++axis) {
        state->is_held[axis] = strcmp(args->word[axis], "NULL") != 0;
        state->is_initial[axis] = strcmp(args->word[axis], "INIT") == 0;
        if (!state->is_held[axis] || state->is_initial[axis]) continue;
        HS_TRY(hs_arg_double(args, axis, &state->word[axis], err));
        if (axis == 2 && fix->env->box->dimension == 2)
            return hs_arg_refuse(args, 2, "NULL, since the system has two dimensions", NULL, err);
    }
    for (int i = 3; i < args->n; i += 2) {
        int choice;
        if (strcmp(args->word[i], "shift") == 0) {
            HS_TRY(hs_groups_get(fix->env->groups, args->word[i + 1], &choice, err));
            state->shifted = fix->other_groups = hs_group_mask(choice);
        } else {
            HS_TRY(hs_arg_choice(args, i + 1, units, &choice, err));
            state->units = choice == 0 ? IN_BOX : choice == 1 ? IN_LATTICE : IN_FRACTIONS;
        }
    }
    double center[3];
    if (hs_center_of_mass(fix->env, fix->mask, center, NULL) > 0.0) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "%s: the group has no atoms", args->command);
}

static hs_status init(hs_fix *fix, hs_error *err)
{
    (void)err;
    hs_center_of_mass(fix->env, fix->mask, ((recenter_state *)fix->state)->initial, NULL);
    return HS_OK;
}

static double target(const hs_fix *fix, int axis)
{
    const recenter_state *state = fix->state;
    const hs_box *box = fix->env->box;
    if (state->is_initial[axis]) return state->initial[axis];
    if (state->units == IN_FRACTIONS) { /* of what encloses a tilted box */
        double lo[3], hi[3];
        hs_box_bounds(box, lo, hi);
        return lo[axis] + state->word[axis] * (hi[axis] - lo[axis]);
    }
    return state->word[axis] * (state->units == IN_LATTICE ? fix->env->lattice->spacing[axis] : 1.0);
}

static hs_status initial_integrate(hs_fix *fix, hs_error *err)
{
    recenter_state *state = fix->state;
    const hs_atoms *atoms = fix->env->atoms;
    double center[3];
    (void)err;
    memset(state->shift, 0, sizeof state->shift);
    if (!(hs_center_of_mass(fix->env, fix->mask, center, NULL) > 0.0)) return HS_OK; /* no atoms */
    for (int axis = 0; axis < 3; ++axis) {
        if (!state->is_held[axis]) continue;
        const double shift = target(fix, axis) - center[axis];
        state->shift[axis] = shift;
#pragma omp parallel for schedule(static)
        for (int i = 0; i < atoms->n_local; ++i)
            if (atoms->mask[i] & state->shifted)
                atoms->x[axis][i] = hs_moved(atoms->x[axis][i], shift, fix->env->position_magic);
    }
    return HS_OK;
}

static hs_status scalar(hs_fix *fix, double *value, hs_error *err)
{
    const double *shift = ((recenter_state *)fix->state)->shift;
    (void)err;
    *value = sqrt(shift[0] * shift[0] + shift[1] * shift[1] + shift[2] * shift[2]);
    return HS_OK;
}

static hs_status vector(hs_fix *fix, int i, double *value, hs_error *err)
{
    (void)err;
    *value = ((recenter_state *)fix->state)->shift[i];
    return HS_OK;
}

static hs_status keep_state(hs_fix *fix, hs_state *kept, hs_error *err)
{
    return hs_state_double(kept, "initial", ((recenter_state *)fix->state)->initial, 3, err);
}

const hs_fix_style hs_fix_style_recenter = {
    .about = {.name = "recenter",
              .syntax = {.usage = "<x> <y> <z> [shift <group-ID>] [units lattice|box|fraction]",
                         .n_min = 3,
                         .n_max = 3,
                         .keywords = keywords},
              .summary = "hold the center of mass of a group at a place",
              .details = "In its turn among the fixes that integrate (so it should come after them), the atoms are "
                         "shifted so that the group's center of mass (unwrapped) is at x, y, z. `NULL` leaves a "
                         "direction free, `INIT` is where the center is at the start of a run. `shift` moves another "
                         "group, for example all. Numbers are in lattice spacings (default), distance units (`units "
                         "box`) or fractions of the box. Velocities are not changed.\n\nThe scalar `f_ID` is the "
                         "length of the last shift, the vector `f_ID[1]` ... `f_ID[3]` the shift (distance).",
              .example = "fix 1 all recenter INIT INIT NULL\nfix 1 drop recenter 0.5 0.5 0.5 units fraction shift all"},
    .state_size = sizeof(recenter_state),
    .create = create,
    .init = init,
    .initial_integrate = initial_integrate,
    .scalar = scalar,
    .vector = vector,
    .keep_state = keep_state,
    .n_vector = 3,
    .is_extensive = true, /* as in LAMMPS: thermo output divides the shift by the number of atoms in lj units */
    .is_vector_extensive = true,
};
