/* Temperature without the motion of the center of mass. */
#include "style/moments.h"
#include "style/temperature.h"

typedef struct com_state {
    hs_temperature temperature;
    double v[3]; /**< of the group's center of mass */
} com_state;

static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    HS_TRY(hs_syntax_check(&compute->style->about.syntax, args, false, err));
    return hs_temperature_create(compute, HS_ALL_AXES, err);
}

static void bias(const hs_compute *compute, int i, double v[3])
{
    (void)i;
    for (int axis = 0; axis < 3; ++axis) v[axis] = ((const com_state *)compute->state)->v[axis];
}

static hs_status scalar(hs_compute *compute, double *value, hs_error *err)
{
    hs_center_of_mass(compute->env, compute->mask, NULL, ((com_state *)compute->state)->v);
    return hs_temperature_scalar(compute, value, err);
}

static hs_status vector(hs_compute *compute, hs_error *err)
{
    hs_center_of_mass(compute->env, compute->mask, NULL, ((com_state *)compute->state)->v);
    return hs_temperature_vector(compute, err);
}

/** A thermostat takes off the velocity of the latest evaluation, which was in the step before. */
static hs_status keep_state(hs_compute *compute, hs_state *kept, hs_error *err)
{
    return hs_state_double(kept, "velocity", ((com_state *)compute->state)->v, 3, err);
}

const hs_compute_style hs_compute_style_temp_com = {
    .about = {.name = "temp/com",
              .syntax = {.usage = "", .n_min = 0, .n_max = 0},
              .summary = "temperature without the motion of the center of mass",
              .details =
                  "As compute temp, with velocities relative to that of the group's center of mass. Thermostats that "
                  "use this temperature leave the motion of the center of mass as it is.",
              .example = "compute Trel drop temp/com"},
    .state_size = sizeof(com_state),
    .create = create,
    .destroy = hs_temperature_destroy,
    .init = hs_temperature_init,
    .scalar = scalar,
    .vector = vector,
    .modify = hs_temperature_modify,
    .bias = bias,
    .keep_state = keep_state,
    .is_vector_extensive = true,
    .is_temperature = true,
};
