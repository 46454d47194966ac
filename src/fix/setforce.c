/* Sets the forces on a group: f = F. */
#include "style/applied_force.h"
#include "style/atom_sum.h"

typedef struct setforce_state {
    hs_applied_force force;
    double before[3]; /**< sum of the forces before they were set; force */
} setforce_state;

static const hs_keyword keywords[] = {
    {"region", 1, "<region-ID>", "only atoms that are in this region at the step"},
    {NULL, 0, NULL, NULL},
};

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    setforce_state *state = fix->state;
    HS_TRY(hs_syntax_check(&fix->style->about.syntax, args, false, err));
    HS_TRY(hs_applied_force_create(&state->force, args, true, err));
    for (int i = 3; i < args->n; i += 2) HS_TRY(hs_applied_force_region(&state->force, fix, args, i + 1, err));
    return HS_OK;
}

static void destroy(hs_fix *fix) { hs_applied_force_fini(&((setforce_state *)fix->state)->force); }

static hs_status init(hs_fix *fix, hs_error *err)
{
    return hs_applied_force_init(&((setforce_state *)fix->state)->force, fix, true, err);
}

static void add_forces(const hs_atoms *atoms, const void *context, int begin, int end, hs_exact_sum *sums)
{
    const hs_fix *fix = context;
    const setforce_state *state = fix->state;
    for (int i = begin; i < end; ++i) {
        if (!hs_applied_force_acts(&state->force, fix, i)) continue;
        for (int axis = 0; axis < 3; ++axis) hs_exact_add(&sums[axis], atoms->f[axis][i]);
    }
}

static hs_status post_force(hs_fix *fix, hs_error *err)
{
    setforce_state *state = fix->state;
    const hs_atoms *atoms = fix->env->atoms;
    HS_TRY(hs_applied_force_update(&state->force, fix, err));
    hs_atom_sum(atoms, fix->env->parallel, add_forces, fix, 3, state->before);
#pragma omp parallel for schedule(static)
    for (int i = 0; i < atoms->n_local; ++i) {
        if (!hs_applied_force_acts(&state->force, fix, i)) continue;
        for (int axis = 0; axis < 3; ++axis)
            if (!state->force.is_free[axis]) atoms->f[axis][i] = hs_applied_force_of(&state->force, axis, i);
    }
    return HS_OK;
}

static hs_status vector(hs_fix *fix, int i, double *value, hs_error *err)
{
    (void)err;
    *value = ((setforce_state *)fix->state)->before[i];
    return HS_OK;
}

static hs_status keep_state(hs_fix *fix, hs_state *kept, hs_error *err)
{
    return hs_state_double(kept, "before", ((setforce_state *)fix->state)->before, 3, err);
}

const hs_fix_style hs_fix_style_setforce = {
    .about = {.name = "setforce",
              .syntax = {.usage = "<fx> <fy> <fz> [region <region-ID>]", .n_min = 3, .n_max = 3, .keywords = keywords},
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
    .state_size = sizeof(setforce_state),
    .create = create,
    .destroy = destroy,
    .init = init,
    .post_force = post_force,
    .keep_state = keep_state,
    .vector = vector,
    .n_vector = 3,
    .is_vector_extensive = true,
};
