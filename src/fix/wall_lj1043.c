/* Walls of Lennard-Jones 10-4-3: layers of Lennard-Jones particles, the first of them seen as a plane.
 * E = 2 pi epsilon (2/5 (sigma/r)^10 - (sigma/r)^4 - sqrt(2)/3 (sigma/(r + 0.61/sqrt(2) sigma))^3) - E(cutoff). */
#include "fix/wall_potential.h"

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    ((wall_state *)fix->state)->energy = wall_lj1043;
    return wall_potential_read(fix, args, true, err);
}

const hs_fix_style hs_fix_style_wall_lj1043 = {
    .about = {.name = "wall/lj1043",
              .syntax = {.usage = WALL_USAGE, .n_min = 5, .n_max = -1},
              .summary = "flat walls with a Lennard-Jones 10-4-3 potential",
              .details =
                  "E = 2 pi epsilon (2/5 (sigma/r)^10 - (sigma/r)^4 - sqrt(2)/3 (sigma/(r + 0.61/sqrt(2) sigma))^3) at "
                  "the distance r from the wall, shifted to 0 at the cutoff: layers of Lennard-Jones particles, the "
                  "first of them spread over its plane, the others over the half space behind it.\n\n" WALL_DETAILS,
              .reference = "J. Magda, M. Tirrell, H. T. Davis, J. Chem. Phys. 83, 1888 (1985), doi:10.1063/1.449375",
              .example = "fix walls all wall/lj1043 zlo EDGE 1.0 1.0 2.5 zhi EDGE 1.0 1.0 2.5"},
    WALL_HOOKS,
    .allows_dynamic_group = true,
};
