/* Walls of Lennard-Jones 12-6: E = 4 epsilon ((sigma/r)^12 - (sigma/r)^6) - E(cutoff), r the distance to the wall. */
#include "fix/wall_potential.h"

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    ((wall_state *)fix->state)->energy = wall_lj126;
    return wall_potential_read(fix, args, true, err);
}

const hs_fix_style hs_fix_style_wall_lj126 = {
    .about = {.name = "wall/lj126",
              .syntax = {.usage = WALL_USAGE, .n_min = 5, .n_max = -1},
              .summary = "flat walls with a Lennard-Jones 12-6 potential",
              .details =
                  "E = 4 epsilon ((sigma/r)^12 - (sigma/r)^6) at the distance r from the wall, shifted to 0 at the "
                  "cutoff; a cutoff of 2^(1/6) sigma makes the wall purely repulsive.\n\n" WALL_DETAILS,
              .example = "fix walls all wall/lj126 zlo EDGE 1.0 1.0 1.12 zhi EDGE 1.0 1.0 1.12"},
    WALL_HOOKS,
    .allows_dynamic_group = true,
};
