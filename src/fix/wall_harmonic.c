/* Soft walls: E = epsilon (r - cutoff)^2 below the cutoff. */
#include "fix/wall_potential.h"

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    ((wall_state *)fix->state)->energy = wall_harmonic;
    return wall_potential_read(fix, args, false, err);
}

const hs_fix_style hs_fix_style_wall_harmonic = {
    .about = {.name = "wall/harmonic",
              .syntax = {.usage = WALL_USAGE, .n_min = 5, .n_max = -1},
              .summary = "flat walls that push harmonically",
              .details = "E = epsilon (r - cutoff)^2 at distances r below the cutoff, 0 beyond. epsilon is in "
                         "energy/distance^2; sigma must be given, as in LAMMPS, and does not enter.\n\n" WALL_DETAILS,
              .example = "fix walls all wall/harmonic xlo EDGE 50.0 1.0 1.0 xhi EDGE 50.0 1.0 1.0"},
    WALL_HOOKS,
    .allows_dynamic_group = true,
};
