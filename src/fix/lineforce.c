/* Atoms that feel forces along a line only. */
#include "fix/direction.h"

static hs_status post_force(hs_fix *fix, hs_error *err)
{
    (void)err;
    HS_ON_THREADS(direction_scale(fix, 1.0, 0.0));
    return HS_OK;
}

const hs_fix_style hs_fix_style_lineforce = {
    .about = {.name = "lineforce",
              .syntax = {.usage = "<x> <y> <z>", .n_min = 3, .n_max = 3},
              .summary = "let atoms feel forces along a line only",
              .details = "Of the force on each atom of the group only the part along the direction (x, y, z) is left, "
                         "at every step after all forces of the fixes defined before; the vector's length does not "
                         "matter. An atom without a velocity across the line stays on it. Acts in minimisations, too.",
              .example = "fix rail some lineforce 0 1 0"},
    .state_size = sizeof(direction_state),
    .create = direction_create,
    .post_force = post_force,
    .acts_in_minimize = true,
    .allows_dynamic_group = true,
};
