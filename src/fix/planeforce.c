/* Atoms that feel forces within a plane only. */
#include "fix/direction.h"

static hs_status post_force(hs_fix *fix, hs_error *err)
{
    (void)err;
    HS_ON_THREADS(direction_scale(fix, 0.0, 1.0));
    return HS_OK;
}

const hs_fix_style hs_fix_style_planeforce = {
    .about = {.name = "planeforce",
              .syntax = {.usage = "<x> <y> <z>", .n_min = 3, .n_max = 3},
              .summary = "let atoms feel forces within a plane only",
              .details =
                  "Of the force on each atom of the group the part along (x, y, z), the normal of the plane, is taken "
                  "away, at every step after all forces of the fixes defined before; the vector's length does not "
                  "matter. An atom without a velocity along the normal stays in its plane. Acts in minimisations, too.",
              .example = "fix layer top planeforce 0 0 1"},
    .state_size = sizeof(direction_state),
    .create = direction_create,
    .post_force = post_force,
    .acts_in_minimize = true,
    .allows_dynamic_group = true,
};
