/* Temperature of the atoms that are in a region now. */
#include "style/region.h"
#include "style/temperature.h"

typedef struct region_state {
    hs_temperature temperature;
    hs_where where;
} region_state;

static hs_status find_region(hs_compute *compute, hs_error *err)
{
    return hs_where_find(&((region_state *)compute->state)->where, compute->env, hs_compute_who(compute).text, err);
}

static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    region_state *state = compute->state;
    HS_TRY(hs_where_set(&state->where, args->word[0], err));
    HS_TRY(find_region(compute, err));
    HS_TRY(hs_temperature_create(compute, HS_ALL_AXES, err));
    state->temperature.is_dynamic = true;
    return HS_OK;
}

/** The region as it is now. */
static hs_status renew_region(hs_compute *compute, hs_error *err)
{
    HS_TRY(find_region(compute, err));
    return hs_where_update(&((const region_state *)compute->state)->where, err);
}

static void destroy(hs_compute *compute)
{
    hs_where_fini(&((region_state *)compute->state)->where);
    hs_temperature_destroy(compute);
}

static bool counts(const hs_compute *compute, int i)
{
    return hs_where_has(&((const region_state *)compute->state)->where, compute->env->atoms, i);
}

static void bias(const hs_compute *compute, int i, double v[3])
{
    const bool is_inside = counts(compute, i);
    for (int axis = 0; axis < 3; ++axis) v[axis] = is_inside ? 0.0 : compute->env->atoms->v[axis][i];
}

static hs_status init(hs_compute *compute, hs_error *err)
{
    HS_TRY(find_region(compute, err));
    return hs_temperature_init(compute, err);
}

static hs_status scalar(hs_compute *compute, double *value, hs_error *err)
{
    HS_TRY(renew_region(compute, err));
    return hs_temperature_scalar(compute, value, err);
}

static hs_status vector(hs_compute *compute, hs_error *err)
{
    HS_TRY(renew_region(compute, err));
    return hs_temperature_vector(compute, err);
}

const hs_compute_style hs_compute_style_temp_region = {
    .about = {.name = "temp/region",
              .syntax = {.usage = "<region-ID>", .n_min = 1, .n_max = 1},
              .summary = "temperature of the atoms in a region",
              .details = "The scalar `c_ID` is the temperature of the group's atoms that are in the region at the "
                         "step, with dim N - dim degrees of freedom (`compute_modify extra/dof` changes the second "
                         "number). The vector is their kinetic-energy tensor as in compute temp. Thermostats that use "
                         "this temperature change the atoms in the region only.",
              .example = "region hot block INF INF INF INF 0 1\ncompute Thot all temp/region hot"},
    .state_size = sizeof(region_state),
    .create = create,
    .destroy = destroy,
    .init = init,
    .scalar = scalar,
    .vector = vector,
    .modify = hs_temperature_modify,
    .bias = bias,
    .counts = counts,
    .is_vector_extensive = true,
    .is_temperature = true,
};
