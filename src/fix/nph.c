/* Constant pressure and enthalpy: the barostat of Martyna, Tobias and Klein. */
#include "style/nose_hoover.h"

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    return hs_nose_hoover_create(fix, args, false, true, err);
}

const hs_fix_style hs_fix_style_nph = {
    .about = {.name = "nph",
              .syntax = {.usage = "<iso|aniso|tri|x|y|z|xy|xz|yz> <Pstart> <Pstop> <Pdamp> [keyword value ...]",
                         .n_min = 0,
                         .n_max = 0,
                         .keywords = hs_nose_hoover_npt_keywords},
              .summary = "integrate at constant pressure and enthalpy",
              .details = "Moves the atoms of the group, in the place of fix nve, and keeps the pressure by changing "
                         "the lengths of the box. No heat is exchanged: with `fix langevin` or another thermostat "
                         "beside it the ensemble is that of constant temperature and pressure. `ptemp` sets the masses "
                         "of the barostat.\n\n" HS_NOSE_HOOVER_PRESSURE_DETAILS,
              .reference = HS_NOSE_HOOVER_REFERENCE,
              .example = "fix 1 all nph iso 0.0 0.0 5.0\nfix 2 all langevin 1.0 1.0 1.0 4711"},
    HS_NOSE_HOOVER_HOOKS,
    .init = hs_nose_hoover_init,
    HS_NOSE_HOOVER_PRESSURE_HOOKS,
    .allows_dynamic_group = true,
};
