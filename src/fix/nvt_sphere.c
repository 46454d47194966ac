/* Constant temperature of spheres that turn: Nose-Hoover chains. */
#include "style/nose_hoover.h"

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    ((hs_nose_hoover *)fix->state)->spheres.has_rotation = true;
    return hs_nose_hoover_create(fix, args, true, false, err);
}

const hs_fix_style hs_fix_style_nvt_sphere = {
    .about = {.name = "nvt/sphere",
              .syntax = {.usage = "temp <Tstart> <Tstop> <Tdamp> [keyword value ...]",
                         .n_min = 0,
                         .n_max = 0,
                         .keywords = hs_nose_hoover_nvt_sphere_keywords},
              .summary = "integrate spheres that turn at constant temperature",
              .details = "As `fix nvt`, and moves angular velocities (and dipoles) as `fix nve/sphere` does. The "
                         "thermostat acts on motion and rotation alike: its compute `ID_temp` is a temp/sphere.",
              .reference = HS_NOSE_HOOVER_REFERENCE,
              .example = "fix 1 all nvt/sphere temp 1.0 1.0 0.5\nfix 2 all nvt/sphere temp 1.0 1.0 0.5 update dipole"},
    HS_NOSE_HOOVER_HOOKS,
    .init = hs_nose_hoover_init,
    .allows_dynamic_group = true,
};
