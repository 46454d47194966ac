/* Scales velocities so that a group has a temperature. */
#include "fix/velocity_scaling.h"

typedef struct rescale_state {
    velocity_scaling scaling; /* first: velocity_scaling.h takes the state as one */
    int64_t every;
    double window, fraction;
} rescale_state;

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    rescale_state *state = fix->state;
    HS_TRY(hs_syntax_check(&fix->style->about.syntax, args, false, err));
    HS_TRY(hs_arg_int(args, 0, 1, INT64_MAX, &state->every, err));
    HS_TRY(hs_arg_not_negative(args, 3, &state->window, err));
    HS_TRY(hs_arg_not_negative(args, 4, &state->fraction, err));
    if (state->fraction > 1.0) return hs_arg_refuse(args, 4, "a fraction from 0 to 1", NULL, err);
    return scaling_create(fix, args, 1, err);
}

static hs_status end_of_step(hs_fix *fix, hs_error *err)
{
    const rescale_state *state = fix->state;
    hs_compute *temperature;
    double wanted, measured;
    if (fix->env->step % state->every != 0) return HS_OK;
    HS_TRY(scaling_measure(fix, &temperature, &wanted, &measured, err));
    if (measured > 0.0 && fabs(measured - wanted) > state->window)
        scaling_apply(fix, temperature, measured, measured - state->fraction * (measured - wanted));
    return HS_OK;
}

const hs_fix_style hs_fix_style_temp_rescale = {
    .about = {.name = "temp/rescale",
              .syntax = {.usage = "<N> <Tstart> <Tstop> <window> <fraction>", .n_min = 5, .n_max = 5},
              .summary = "scale velocities to a temperature",
              .details =
                  "At steps that are multiples of N, when the temperature is farther than window from the wanted one, "
                  "the velocities of the group are scaled so that the difference is smaller by the fraction (1: it "
                  "vanishes). " SCALING_DETAILS,
              .example = "fix 1 all temp/rescale 100 1.0 1.1 0.02 0.5\n"
                         "compute t beads temp/partial 0 1 1\nfix 2 beads temp/rescale 1 2.0 2.0 0 1\nfix_modify 2 "
                         "temp t"},
    .state_size = sizeof(rescale_state),
    .create = create,
    .end_of_step = end_of_step,
    SCALING_HOOKS,
    .allows_dynamic_group = true,
    .keeps_plane = true,
};
