/* Temperature after a velocity profile, linear along an axis, is taken off. */
#include <math.h>
#include <string.h>

#include "core/lattice.h"
#include "style/temperature.h"

typedef struct ramp_state {
    hs_temperature temperature;
    int component, along;
    double v[2];     /**< at the ends, distance/time */
    double place[2]; /**< of the ends, distance */
} ramp_state;

static const hs_keyword keywords[] = {
    {"units", 1, "lattice|box", "lengths are in lattice spacings (default) or in distance units"},
    {NULL, 0, NULL, NULL},
};

static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    static const char *const components[] = {"vx", "vy", "vz", NULL}, *const axes[] = {"x", "y", "z", NULL};
    ramp_state *state = compute->state;
    const hs_env *env = compute->env;
    HS_TRY(hs_syntax_check(&compute->style->about.syntax, args, false, err));
    const bool is_box = args->n == 8 && strcmp(args->word[7], "box") == 0;
    HS_TRY(hs_arg_choice(args, 0, components, &state->component, err));
    HS_TRY(hs_arg_choice(args, 3, axes, &state->along, err));
    for (int end = 0; end < 2; ++end) {
        HS_TRY(hs_arg_double(args, 1 + end, &state->v[end], err));
        HS_TRY(hs_arg_double(args, 4 + end, &state->place[end], err));
        if (is_box) continue;
        state->v[end] *= env->lattice->spacing[state->component];
        state->place[end] *= env->lattice->spacing[state->along];
    }
    if (state->place[0] == state->place[1])
        return hs_fail(err, HS_ERROR_INPUT, "%s: the ramp begins and ends at the same coordinate, %s", args->command,
                       args->word[4]);
    return hs_temperature_create(compute, HS_ALL_AXES, err);
}

static void bias(const hs_compute *compute, int i, double v[3])
{
    const ramp_state *state = compute->state;
    const double x = compute->env->atoms->x[state->along][i],
                 fraction = fmin(fmax((x - state->place[0]) / (state->place[1] - state->place[0]), 0.0), 1.0);
    v[0] = v[1] = v[2] = 0.0;
    v[state->component] = state->v[0] + fraction * (state->v[1] - state->v[0]);
}

const hs_compute_style hs_compute_style_temp_ramp = {
    .about = {.name = "temp/ramp",
              .syntax = {.usage = "<vx|vy|vz> <v1> <v2> <x|y|z> <c1> <c2> [units lattice|box]",
                         .n_min = 6,
                         .n_max = 6,
                         .keywords = keywords},
              .summary = "temperature without a velocity that rises linearly along an axis",
              .details =
                  "From the component vx, vy or vz of each velocity that of a ramp is taken off: v1 where the "
                  "coordinate is c1 or below, v2 where it is c2 or above, and linear between. The scalar `c_ID` is the "
                  "temperature of what is left, with dim N - dim degrees of freedom; the vector is its kinetic-energy "
                  "tensor as in compute temp. Thermostats that use this temperature leave the ramp as it is. Lengths "
                  "(in velocities, too) are in lattice spacings unless `units box` is said.",
              .example = "compute t flow temp/ramp vx 0 2 y 2 20 units box"},
    .state_size = sizeof(ramp_state),
    .create = create,
    .destroy = hs_temperature_destroy,
    .init = hs_temperature_init,
    .scalar = hs_temperature_scalar,
    .vector = hs_temperature_vector,
    .modify = hs_temperature_modify,
    .bias = bias,
    .is_vector_extensive = true,
    .is_temperature = true,
};
