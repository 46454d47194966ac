/* Gives every atom of a group the mean force: f = sum(f) / N + F. */
#include "style/applied_force.h"
#include "style/atom_sum.h"

typedef struct aveforce_state {
    hs_applied_force force;
    double before[4]; /**< sum of the forces before, and the number of atoms */
} aveforce_state;

static const hs_keyword keywords[] = {
    {"region", 1, "<region-ID>", "only atoms that are in this region at the step"},
    {NULL, 0, NULL, NULL},
};

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    aveforce_state *state = fix->state;
    HS_TRY(hs_syntax_check(&fix->style->about.syntax, args, false, err));
    HS_TRY(hs_applied_force_create(&state->force, args, true, err));
    for (int i = 3; i < args->n; i += 2) HS_TRY(hs_applied_force_region(&state->force, fix, args, i + 1, err));
    return HS_OK;
}

static void destroy(hs_fix *fix) { hs_applied_force_fini(&((aveforce_state *)fix->state)->force); }

static hs_status init(hs_fix *fix, hs_error *err)
{
    return hs_applied_force_init(&((aveforce_state *)fix->state)->force, fix, false, err);
}

static void add_forces(const hs_atoms *atoms, const void *context, int begin, int end, hs_exact_sum *sums)
{
    const hs_fix *fix = context;
    const aveforce_state *state = fix->state;
    for (int i = begin; i < end; ++i) {
        if (!hs_applied_force_acts(&state->force, fix, i)) continue;
        for (int axis = 0; axis < 3; ++axis) hs_exact_add(&sums[axis], atoms->f[axis][i]);
        hs_exact_add(&sums[3], 1.0);
    }
}

static hs_status post_force(hs_fix *fix, hs_error *err)
{
    aveforce_state *state = fix->state;
    const hs_atoms *atoms = fix->env->atoms;
    double mean[3] = {0.0};
    HS_TRY(hs_applied_force_update(&state->force, fix, err));
    hs_atom_sum(atoms, fix->env->parallel, add_forces, fix, 4, state->before);
    if (!(state->before[3] > 0.0)) return HS_OK;
    for (int axis = 0; axis < 3; ++axis) mean[axis] = state->before[axis] / state->before[3] + state->force.value[axis];
#pragma omp parallel for schedule(static)
    for (int i = 0; i < atoms->n_local; ++i) {
        if (!hs_applied_force_acts(&state->force, fix, i)) continue;
        for (int axis = 0; axis < 3; ++axis)
            if (!state->force.is_free[axis]) atoms->f[axis][i] = mean[axis];
    }
    return HS_OK;
}

static hs_status vector(hs_fix *fix, int i, double *value, hs_error *err)
{
    (void)err;
    *value = ((aveforce_state *)fix->state)->before[i];
    return HS_OK;
}

static hs_status keep_state(hs_fix *fix, hs_state *kept, hs_error *err)
{
    return hs_state_double(kept, "before", ((aveforce_state *)fix->state)->before, 4, err);
}

const hs_fix_style hs_fix_style_aveforce = {
    .about =
        {.name = "aveforce",
         .syntax = {.usage = "<fx> <fy> <fz> [region <region-ID>]", .n_min = 3, .n_max = 3, .keywords = keywords},
         .summary = "give every atom of a group the mean force",
         .details =
             "At every step the force on each atom of the group becomes the mean of the forces on them plus fx, "
             "fy, fz (force units), so that equal atoms move as one. `NULL` leaves a component as it is; `v_name` "
             "is an equal-style variable, evaluated at every step. With `region` only atoms that are in the region "
             "at the step are averaged and concerned.\n\nThe vector `f_ID[1]` ... `f_ID[3]` is the sum of the "
             "forces on these atoms before.",
         .example = "fix plate wall aveforce NULL -0.5 NULL\nfix 1 top aveforce v_pull 0 0"},
    .state_size = sizeof(aveforce_state),
    .create = create,
    .destroy = destroy,
    .init = init,
    .post_force = post_force,
    .keep_state = keep_state,
    .vector = vector,
    .n_vector = 3,
    .is_vector_extensive = true,
};
