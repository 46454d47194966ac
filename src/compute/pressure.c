/* Pressure from kinetic energy and virial.
 * P = (n_dof k T + sum_a W_aa) / (dim V),  P_ab = (sum m v_a v_b + W_ab) / V,  W = virial of pairs and fixes.
 * Source: A. P. Thompson, S. J. Plimpton, W. Mattson, J. Chem. Phys. 131, 154107 (2009), doi:10.1063/1.3245303. */
#include <string.h>

#include "base/memory.h"
#include "style/compute.h"
#include "style/stress_parts.h"

typedef struct pressure_state {
    char *temperature_id; /**< owned; NULL: no kinetic part */
    hs_stress_parts parts;
} pressure_state;

/** The compute that gives the temperature. */
static hs_status find_temperature(const hs_compute *compute, hs_compute **temperature, hs_error *err)
{
    const pressure_state *state = compute->state;
    return hs_compute_get(compute->env, state->temperature_id, HS_TEMPERATURE, hs_compute_who(compute).text,
                          temperature, err);
}

static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    pressure_state *state = compute->state;
    HS_TRY(hs_syntax_check(&compute->style->about.syntax, args, false, err));
    if (compute->group != 0)
        return hs_fail(err, HS_ERROR_INPUT,
                       "%s: the group must be all: the virial of a pair belongs to no single group", args->command);
    compute->n_vector = 6;
    HS_TRY(HS_ALLOC(compute->vector, 6, err));
    state->parts = hs_stress_parts_read(args, 1);
    if (strcmp(args->word[0], "NULL") != 0) HS_TRY(hs_memory_strdup(&state->temperature_id, args->word[0], err));
    if (!state->parts.has_ke) return HS_OK;
    if (state->temperature_id == NULL)
        return hs_fail(err, HS_ERROR_INPUT,
                       "%s: NULL leaves out the kinetic part, so a keyword such as 'virial' must say which parts are "
                       "wanted; otherwise name a temperature compute, for example thermo_temp",
                       args->command);
    hs_compute *temperature;
    return find_temperature(compute, &temperature, err);
}

static void destroy(hs_compute *compute)
{
    pressure_state *state = compute->state;
    HS_FREE(state->temperature_id);
    HS_FREE(compute->vector);
}

static hs_status set_temperature(hs_compute *compute, const char *id, hs_error *err)
{
    pressure_state *state = compute->state;
    HS_TRY(hs_memory_replace(&state->temperature_id, id, err));
    hs_compute_invalidate(compute);
    return HS_OK;
}

/** The temperature compute may have been removed since the last run. */
static hs_status init(hs_compute *compute, hs_error *err)
{
    hs_compute *temperature;
    return ((pressure_state *)compute->state)->parts.has_ke ? find_temperature(compute, &temperature, err) : HS_OK;
}

static hs_status scalar(hs_compute *compute, double *value, hs_error *err)
{
    const pressure_state *state = compute->state;
    const hs_env *env = compute->env;
    const int dim = env->box->dimension;
    double kinetic = 0.0, virial = 0.0, tail = 0.0;
    if (state->parts.has_ke) {
        hs_compute *temperature;
        double t;
        HS_TRY(find_temperature(compute, &temperature, err));
        HS_TRY(hs_compute_scalar(temperature, &t, err));
        kinetic = temperature->n_dof * env->units->boltz * t;
    }
    if (state->parts.has_pair) {
        for (int k = 0; k < dim; ++k) virial += env->pair_virial[k];
        tail = env->tail_pressure;
    }
    for (int k = 0; k < dim && state->parts.has_fix; ++k) virial += env->fix_virial[k];
    *value = (kinetic + virial) / (dim * hs_box_volume(env->box)) * env->units->nktv2p + tail;
    return HS_OK;
}

static hs_status vector(hs_compute *compute, hs_error *err)
{
    /* components that exist in 2D; the others stay 0 */
    static const bool is_planar[6] = {true, true, false, true, false, false};
    const pressure_state *state = compute->state;
    const hs_env *env = compute->env;
    const double volume = hs_box_volume(env->box);
    for (int k = 0; k < 6; ++k) {
        double kinetic = 0.0;
        compute->vector[k] = 0.0;
        if (env->box->dimension == 2 && !is_planar[k]) continue;
        if (state->parts.has_ke) {
            hs_compute *temperature;
            HS_TRY(find_temperature(compute, &temperature, err));
            HS_TRY(hs_compute_vector(temperature, k, &kinetic, err));
        }
        const double virial =
            (state->parts.has_pair ? env->pair_virial[k] : 0.0) + (state->parts.has_fix ? env->fix_virial[k] : 0.0);
        compute->vector[k] = (kinetic + virial) / volume * env->units->nktv2p;
        if (state->parts.has_pair && k < 3) compute->vector[k] += env->tail_pressure;
    }
    return HS_OK;
}

const hs_compute_style hs_compute_style_pressure = {
    .about =
        {.name = "pressure",
         .syntax = {.usage = "<temperature-compute | NULL> [ke pair virial bond angle dihedral improper kspace fix]",
                    .n_min = 1,
                    .n_max = 1,
                    .keywords = hs_stress_parts_keywords},
         .summary = "pressure and pressure tensor",
         .details = "The scalar `c_ID` is (n_dof k T + virial) / (dim V), the vector `c_ID[1]` ... `c_ID[6]` the "
                    "tensor in the order xx, yy, zz, xy, xz, yz (pressure units; in two dimensions V is the area and "
                    "zz, xz, yz are 0). The first word names the compute that gives the temperature; NULL leaves the "
                    "kinetic part out and needs a keyword. Without keywords every part counts; with keywords only the "
                    "parts they name. The group must be all. Every simulation has one of these, `thermo_press`.",
         .reference =
             "A. P. Thompson, S. J. Plimpton, W. Mattson, J. Chem. Phys. 131, 154107 (2009), doi:10.1063/1.3245303",
         .example = "compute w all pressure NULL virial\ncompute p all pressure thermo_temp"},
    .state_size = sizeof(pressure_state),
    .create = create,
    .destroy = destroy,
    .init = init,
    .scalar = scalar,
    .vector = vector,
    .set_temperature = set_temperature,
    .needs_energy = true,
    .is_pressure = true,
};
