/* Temperature from some components of the velocities. */
#include "style/temperature.h"

typedef struct partial_state {
    hs_temperature temperature;
    bool is_used[3];
} partial_state;

static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    partial_state *state = compute->state;
    int n_axes = 0;
    for (int axis = 0; axis < 3; ++axis) {
        int64_t flag;
        HS_TRY(hs_arg_int(args, axis, 0, 1, &flag, err));
        state->is_used[axis] = flag == 1;
        n_axes += (int)flag;
    }
    if (compute->env->box->dimension == 2 && state->is_used[2])
        return hs_fail(err, HS_ERROR_INPUT, "%s: in two dimensions nothing moves along z: the third flag must be 0",
                       args->command);
    return hs_temperature_create(compute, n_axes, err);
}

static void bias(const hs_compute *compute, int i, double v[3])
{
    const partial_state *state = compute->state;
    for (int axis = 0; axis < 3; ++axis) v[axis] = state->is_used[axis] ? 0.0 : compute->env->atoms->v[axis][i];
}

const hs_compute_style hs_compute_style_temp_partial = {
    .about = {.name = "temp/partial",
              .syntax = {.usage = "<x> <y> <z>", .n_min = 3, .n_max = 3},
              .summary = "temperature from some components of the velocities",
              .details =
                  "The flags say which components count (1) and which do not (0). The scalar `c_ID` is the temperature "
                  "with one degree of freedom for each component and atom, less one for each component; the vector "
                  "`c_ID[1]` ... `c_ID[6]` the kinetic-energy tensor as in compute temp, without what does not count. "
                  "Thermostats that use this temperature change the components that count.",
              .example = "compute flowless all temp/partial 0 1 1\nfix_modify 2 temp flowless"},
    .state_size = sizeof(partial_state),
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
