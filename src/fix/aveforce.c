/* Gives every atom of a group the mean force: f = sum(f) / N + F. */
#include "style/applied_force.h"

static hs_status init(hs_fix *fix, hs_error *err)
{
    return hs_applied_force_init(&((hs_replaced_force *)fix->state)->force, fix, false, err);
}

static void add_forces(const hs_atoms *atoms, const void *context, int begin, int end, hs_exact_sum *sums)
{
    const hs_fix *fix = context;
    int32_t found[HS_EXACT_ARRAY_MAX];
    const int n = hs_applied_force_find(&((const hs_replaced_force *)fix->state)->force, fix, begin, end, found);
    hs_replaced_force_add(atoms, found, n, sums);
}

static void set_forces(const hs_fix *fix, const double mean[3])
{
    const hs_applied_force *force = &((const hs_replaced_force *)fix->state)->force;
    const hs_atoms *atoms = fix->env->atoms;
#pragma omp for schedule(static) nowait
    for (int i = 0; i < atoms->n_local; ++i) {
        if (!hs_applied_force_acts(force, fix, i)) continue;
        for (int axis = 0; axis < 3; ++axis)
            if (!force->is_free[axis]) atoms->f[axis][i] = mean[axis];
    }
}

static hs_status post_force(hs_fix *fix, hs_error *err)
{
    hs_replaced_force *state = fix->state;
    double mean[3] = {0.0};
    HS_TRY(hs_applied_force_update(&state->force, fix, err));
    hs_late_sums_make(&state->before, fix->env->atoms, add_forces, fix, HS_N_SHOWN);
    const double *before = hs_late_sums_read(&state->before, fix->env->parallel);
    if (!(before[3] > 0.0)) return HS_OK;
    for (int axis = 0; axis < 3; ++axis) mean[axis] = before[axis] / before[3] + state->force.value[axis];
    HS_ON_THREADS(set_forces(fix, mean));
    return HS_OK;
}

const hs_fix_style hs_fix_style_aveforce = {
    .about = {.name = "aveforce",
              .syntax = {.usage = "<fx> <fy> <fz> [region <region-ID>]",
                         .n_min = 3,
                         .n_max = 3,
                         .keywords = hs_replaced_force_keywords},
              .summary = "give every atom of a group the mean force",
              .details = "At every step the force on each atom of the group becomes the mean of the forces on them "
                         "plus fx, fy, fz (force units), so that equal atoms move as one. `NULL` leaves a component as "
                         "it is; `v_name` is an equal-style variable, evaluated at every step. With `region` only "
                         "atoms that are in the region at the step are averaged and concerned.\n\nThe vector `f_ID[1]` "
                         "... `f_ID[3]` is the sum of the forces on these atoms before.",
              .example = "fix plate wall aveforce NULL -0.5 NULL\nfix 1 top aveforce v_pull 0 0"},
    HS_REPLACED_FORCE_HOOKS,
    .init = init,
    .post_force = post_force,
};
