/* Constant temperature and pressure of spheres that turn. */
#include "style/nose_hoover.h"

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    ((hs_nose_hoover *)fix->state)->spheres.has_rotation = true;
    return hs_nose_hoover_create(fix, args, true, true, err);
}

const hs_fix_style hs_fix_style_npt_sphere = {
    .about = {.name = "npt/sphere",
              .syntax = {.usage =
                             "temp <Tstart> <Tstop> <Tdamp> <iso|aniso|tri|x|y|z|xy|xz|yz> <Pstart> <Pstop> <Pdamp> "
                             "[keyword value ...]",
                         .n_min = 0,
                         .n_max = 0,
                         .keywords = hs_nose_hoover_npt_sphere_keywords},
              .summary = "integrate spheres that turn at constant temperature and pressure",
              .details =
                  "As `fix npt`, and moves angular velocities (and dipoles) as `fix nve/sphere` does; thermostat and "
                  "barostat measure with a temp/sphere, `ID_temp`. As in LAMMPS the pressure `ID_press` then counts "
                  "the rotation as if it pushed the walls: at equilibrium it is too large by n k T for spheres of "
                  "number density n.",
              .reference = HS_NOSE_HOOVER_REFERENCE,
              .example = "fix 1 all npt/sphere temp 1.0 1.0 0.5 iso 0.0 0.0 5.0"},
    HS_NOSE_HOOVER_HOOKS,
    .init = hs_nose_hoover_init,
    HS_NOSE_HOOVER_PRESSURE_HOOKS,
    .allows_dynamic_group = true,
};
