/* Temperature of a group from its kinetic energy: T = sum(m v^2) / (n_dof k), n_dof = dim N - dim. */
#include "style/temperature.h"

/** Momentum is conserved, so dim degrees of freedom are not thermal. */
static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    HS_TRY(hs_syntax_check(&compute->style->about.syntax, args, false, err));
    return hs_temperature_create(compute, HS_ALL_AXES, err);
}

const hs_compute_style hs_compute_style_temp = {
    .about = {.name = "temp",
              .syntax = {.usage = "", .n_min = 0, .n_max = 0},
              .summary = "temperature of a group",
              .details =
                  "The scalar `c_ID` is the temperature, sum(m v^2) / (n_dof k), with n_dof = dim N - dim degrees of "
                  "freedom (temperature units). The vector `c_ID[1]` ... `c_ID[6]` is the kinetic-energy tensor "
                  "sum(m v_a v_b) in the order xx, yy, zz, xy, xz, yz (energy units); under `thermo_modify norm yes` "
                  "thermo output divides it by the number of atoms. The degrees of freedom are counted at the start "
                  "of each run. Every simulation has one of these, `thermo_temp`, for group all.",
              .example = "compute slow lower temp"},
    .state_size = sizeof(hs_temperature),
    .create = create,
    .destroy = hs_temperature_destroy,
    .init = hs_temperature_init,
    .scalar = hs_temperature_scalar,
    .vector = hs_temperature_vector,
    .modify = hs_temperature_modify,
    .is_vector_extensive = true,
    .is_temperature = true,
};
