/* Walls of Lennard-Jones 9-3, a half space of Lennard-Jones particles:
 * E = epsilon (2/15 (sigma/r)^9 - (sigma/r)^3) - E(cutoff). */
#include "fix/wall_potential.h"

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    ((wall_state *)fix->state)->energy = wall_lj93;
    return wall_potential_read(fix, args, true, err);
}

const hs_fix_style hs_fix_style_wall_lj93 = {
    .about =
        {.name = "wall/lj93",
         .syntax = {.usage = WALL_USAGE, .n_min = 5, .n_max = -1},
         .summary = "flat walls with a Lennard-Jones 9-3 potential",
         .details =
             "E = epsilon (2/15 (sigma/r)^9 - (sigma/r)^3) at the distance r from the wall, shifted to 0 at the "
             "cutoff: a half space of Lennard-Jones particles. Its minimum is at (2/5)^(1/6) sigma.\n\n" WALL_DETAILS,
         .example = "fix walls all wall/lj93 xlo EDGE 1.0 1.0 2.5 xhi EDGE 1.0 1.0 2.5"},
    WALL_HOOKS,
    .allows_dynamic_group = true,
};
