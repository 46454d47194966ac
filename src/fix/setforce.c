/* Sets the forces on a group: f = F. */
#include "style/applied_force.h"

static hs_status init(hs_fix *fix, hs_error *err)
{
    return hs_applied_force_init(&((hs_replaced_force *)fix->state)->force, fix, true, err);
}

static hs_status post_force(hs_fix *fix, hs_error *err)
{
    hs_replaced_force *state = fix->state;
    const hs_atoms *atoms = fix->env->atoms;
    HS_TRY(hs_replaced_force_measure(fix, err));
#pragma omp parallel for schedule(static)
    for (int i = 0; i < atoms->n_local; ++i) {
        if (!hs_applied_force_acts(&state->force, fix, i)) continue;
        for (int axis = 0; axis < 3; ++axis)
            if (!state->force.is_free[axis]) atoms->f[axis][i] = hs_applied_force_of(&state->force, axis, i);
    }
    return HS_OK;
}

const hs_fix_style hs_fix_style_setforce = {
    .about = {.name = "setforce",
              .syntax = {.usage = "<fx> <fy> <fz> [region <region-ID>]",
                         .n_min = 3,
                         .n_max = 3,
                         .keywords = hs_replaced_force_keywords},
              .summary = "set the forces on a group",
              .details =
                  "At every step, after all forces and after the fixes defined before, the force on each atom of the "
                  "group becomes fx, fy, fz (force units). `NULL` leaves a component as it is; `v_name` is an "
                  "equal-style variable, evaluated at every step, or an atom-style one. With `region` only atoms that "
                  "are in the region at the step are concerned. Atoms with no force and no velocity stay where they "
                  "are: `setforce 0 0 0` holds a wall.\n\nThe vector `f_ID[1]` ... `f_ID[3]` is the sum of the forces "
                  "on these atoms before they were set.",
              .example =
                  "velocity wall set 0 0 0\nfix hold wall setforce 0.0 0.0 0.0\nfix 1 edge setforce NULL 0.0 v_f"},
    .state_size = sizeof(hs_replaced_force),
    .create = hs_replaced_force_create,
    .destroy = hs_replaced_force_destroy,
    .init = init,
    .post_force = post_force,
    .acts_in_minimize = true,
    .keep_state = hs_replaced_force_keep_state,
    .vector = hs_replaced_force_vector,
    .n_vector = 3,
    .is_vector_extensive = true,
};
