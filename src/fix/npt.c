/* Constant temperature and pressure: Nose-Hoover chains and the barostat of Martyna, Tobias and Klein. */
#include "style/nose_hoover.h"

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    return hs_nose_hoover_create(fix, args, true, true, err);
}

const hs_fix_style hs_fix_style_npt = {
    .about =
        {.name = "npt",
         .syntax = {.usage = "temp <Tstart> <Tstop> <Tdamp> <iso|aniso|tri|x|y|z|xy|xz|yz> <Pstart> <Pstop> <Pdamp> "
                             "[keyword value ...]",
                    .n_min = 0,
                    .n_max = 0,
                    .keywords = hs_nose_hoover_npt_keywords},
         .summary = "integrate at constant temperature and pressure",
         .details =
             "Moves the atoms of the group, in the place of fix nve, keeps their temperature by a chain of thermostats "
             "(see fix nvt) and the pressure by changing the lengths of the box, and its "
             "tilts.\n\n" HS_NOSE_HOOVER_PRESSURE_DETAILS,
         .reference = HS_NOSE_HOOVER_REFERENCE,
         .example = "fix 1 all npt temp 1.0 1.0 0.5 iso 0.0 0.0 5.0\nfix 2 all npt temp 300 300 100 x 1.0 1.0 1000 y "
                    "1.0 1.0 1000 couple xy\nfix 3 all npt temp 0.3 0.3 0.5 tri 0.0 0.0 5.0"},
    HS_NOSE_HOOVER_HOOKS,
    .init = hs_nose_hoover_init,
    HS_NOSE_HOOVER_PRESSURE_HOOKS,
    .allows_dynamic_group = true,
};
