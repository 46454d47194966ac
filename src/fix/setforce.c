/* Sets the forces on a group: f = F. */
#include "style/applied_force.h"

static hs_status init(hs_fix *fix, hs_error *err)
{
    return hs_applied_force_init(&((hs_replaced_force *)fix->state)->force, fix, true, err);
}

/** Set the forces, and add up what they were. */
static void set_forces(const hs_atoms *atoms, const void *context, int begin, int end, hs_exact_sum *sums)
{
    const hs_fix *fix = context;
    const hs_applied_force *force = &((const hs_replaced_force *)fix->state)->force;
    int32_t found[HS_EXACT_ARRAY_MAX];
    const int n = hs_applied_force_find(force, fix, begin, end, found);
    hs_replaced_force_add(atoms, found, n, sums);
    for (int axis = 0; axis < 3; ++axis) {
        const double *of_atom = force->of_atom[axis], value = force->value[axis];
        double *f = atoms->f[axis];
        for (int k = 0; !force->is_free[axis] && k < n; ++k) f[found[k]] = of_atom != NULL ? of_atom[found[k]] : value;
    }
}

static hs_status post_force(hs_fix *fix, hs_error *err)
{
    hs_replaced_force *state = fix->state;
    HS_TRY(hs_applied_force_update(&state->force, fix, err));
    hs_late_sums_make(&state->before, fix->env->atoms, set_forces, fix, HS_N_SHOWN);
    return HS_OK;
}

const hs_fix_style hs_fix_style_setforce = {
    .about = {.name = "setforce",
              .syntax = {.usage = "<fx> <fy> <fz> [region <region-ID>]",
                         .n_min = 3,
                         .n_max = 3,
                         .keywords = hs_replaced_force_keywords},
              .summary = "set the forces on a group",
              .details = "At every step, after all forces and after the fixes defined before, the force on each atom "
                         "of the group becomes fx, fy, fz (force units). `NULL` leaves a component as it is; `v_name` "
                         "is an equal-style variable, evaluated at every step, or an atom-style one. With `region` "
                         "only atoms that are in the region at the step are concerned. Atoms with no force and no "
                         "velocity stay where they are: `setforce 0 0 0` holds a wall.\n\nThe vector `f_ID[1]` ... "
                         "`f_ID[3]` is the sum of the forces on these atoms before they were set.",
              .example =
                  "velocity wall set 0 0 0\nfix hold wall setforce 0.0 0.0 0.0\nfix 1 edge setforce NULL 0.0 v_f"},
    HS_REPLACED_FORCE_HOOKS,
    .init = init,
    .post_force = post_force,
};
