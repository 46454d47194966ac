/* Constant pressure and enthalpy of spheres that turn. */
#include "style/nose_hoover.h"

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    ((hs_nose_hoover *)fix->state)->spheres.has_rotation = true;
    return hs_nose_hoover_create(fix, args, false, true, err);
}

const hs_fix_style hs_fix_style_nph_sphere = {
    .about = {.name = "nph/sphere",
              .syntax = {.usage = "<iso|aniso|tri|x|y|z|xy|xz|yz> <Pstart> <Pstop> <Pdamp> [keyword value ...]",
                         .n_min = 0,
                         .n_max = 0,
                         .keywords = hs_nose_hoover_npt_sphere_keywords},
              .summary = "integrate spheres that turn at constant pressure and enthalpy",
              .details =
                  "As `fix nph`, and moves angular velocities (and dipoles) as `fix nve/sphere` does. Its compute "
                  "`ID_temp` is a temp/sphere. As in LAMMPS the pressure `ID_press` then counts the rotation as if it "
                  "pushed the walls: `fix_modify temp` with a `compute temp` takes the rotation out of it.",
              .reference = HS_NOSE_HOOVER_REFERENCE,
              .example = "fix 1 all nph/sphere iso 0.0 0.0 5.0\nfix 2 all langevin 1.0 1.0 1.0 4711 omega yes"},
    HS_NOSE_HOOVER_HOOKS,
    .init = hs_nose_hoover_init,
    HS_NOSE_HOOVER_PRESSURE_HOOKS,
    .allows_dynamic_group = true,
};
