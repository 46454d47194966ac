/* A force of constant magnitude that drags atoms to a place:  F = -f (r - r0)/|r - r0| where |r - r0| > delta, and
 * U = f (|r - r0| - delta) there. */
#include <math.h>
#include <string.h>

#include "style/nearest_image.h"
#include "style/shown_sums.h"

typedef struct drag_state {
    hs_late_sums sums; /**< first, for shown_sums.h: of the forces, and energy */
    bool acts[3];      /**< directions that count (not NULL) */
    double place[3];   /**< distance */
    double magnitude;  /**< force */
    double delta;      /**< distance */
} drag_state;

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    drag_state *state = fix->state;
    HS_TRY(hs_syntax_check(&fix->style->about.syntax, args, false, err));
    for (int axis = 0; axis < 3; ++axis) {
        state->acts[axis] = strcmp(args->word[axis], "NULL") != 0;
        if (state->acts[axis]) HS_TRY(hs_arg_double(args, axis, &state->place[axis], err));
    }
    HS_TRY(hs_arg_double(args, 3, &state->magnitude, err));
    return hs_arg_not_negative(args, 4, &state->delta, err);
}

/** From the nearest image of the place to local atom i, along the directions that count; its length. */
static double distance_to(const hs_fix *fix, int i, double d[3])
{
    const drag_state *state = fix->state;
    for (int axis = 0; axis < 3; ++axis)
        d[axis] = state->acts[axis] ? fix->env->atoms->x[axis][i] - state->place[axis] : 0.0;
    hs_nearest_image(fix->env->box, d);
    for (int axis = 0; axis < 3; ++axis) d[axis] = state->acts[axis] ? d[axis] : 0.0;
    return sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
}

/** Drag the atoms [begin, end), and add up forces and energies. */
static void drag(const hs_atoms *atoms, const void *context, int begin, int end, hs_exact_sum *sums)
{
    const hs_fix *fix = context;
    const drag_state *state = fix->state;
    for (int i = begin; i < end; ++i) {
        double d[3];
        if (!(atoms->mask[i] & fix->mask)) continue;
        const double r = distance_to(fix, i, d);
        if (!(r > state->delta)) continue;
        for (int axis = 0; axis < 3; ++axis) {
            const double f = -state->magnitude * d[axis] / r;
            atoms->f[axis][i] += f;
            hs_exact_add(&sums[axis], f);
        }
        hs_exact_add(&sums[HS_SHOWN_ENERGY], state->magnitude * (r - state->delta));
    }
}

static hs_status post_force(hs_fix *fix, hs_error *err)
{
    (void)err;
    hs_late_sums_make(fix->state, fix->env->atoms, drag, fix, HS_N_SHOWN);
    return HS_OK;
}

const hs_fix_style hs_fix_style_drag = {
    .about = {.name = "drag",
              .syntax = {.usage = "<x> <y> <z> <f> <delta>", .n_min = 5, .n_max = 5},
              .summary = "a force of constant magnitude that drags atoms to a place",
              .details =
                  "On each atom of the group that is farther than delta (distance) from the nearest periodic image "
                  "of the place (x, y, z), in distance units, acts a force of the magnitude f (force) towards "
                  "it. A direction that is NULL counts neither for the distance nor for the force.\n\n"
                  "The vector `f_ID[1]` ... `f_ID[3]` is the sum of these forces, the scalar `f_ID` their "
                  "energy, the sum of f (r - delta); `fix_modify energy yes` adds it to the potential energy. "
                  "Does not act in minimisations, as in LAMMPS.",
              .example = "fix center few drag 0.0 10.0 NULL 5.0 2.0"},
    .state_size = sizeof(drag_state),
    .create = create,
    .post_force = post_force,
    .allows_dynamic_group = true,
    HS_SHOWN_HOOKS,
};
