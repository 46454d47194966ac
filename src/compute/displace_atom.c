/* Displacement of each atom from where it was when the compute was defined. */
#include <math.h>

#include "style/atom_vector.h"
#include "style/compute.h"
#include "style/places.h"

typedef struct displace_state {
    hs_atom_vector origin; /**< unwrapped places at the start */
} displace_state;

static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    displace_state *state = compute->state;
    const hs_env *env = compute->env;
    HS_TRY(hs_syntax_check(&compute->style->about.syntax, args, false, err));
    compute->n_atom_columns = 4;
    HS_TRY(hs_atom_vector_add(env->atoms, &state->origin, "compute", compute->id, "origin", err));
    hs_atom_vector_set_places(&state->origin, env, (const double[3]){0.0});
    return HS_OK;
}

static void destroy(hs_compute *compute)
{
    hs_atom_vector_remove(compute->env->atoms, &((displace_state *)compute->state)->origin);
}

static hs_status per_atom(hs_compute *compute, hs_error *err)
{
    const displace_state *state = compute->state;
    const hs_atoms *atoms = compute->env->atoms;
    const int n = atoms->n_local;
    double *const column[] = {compute->atoms, compute->atoms + n, compute->atoms + 2 * (size_t)n,
                              compute->atoms + 3 * (size_t)n};
    (void)err;
#pragma omp parallel for schedule(static)
    for (int i = 0; i < n; ++i) {
        double sum = 0.0;
        for (int axis = 0; axis < 3; ++axis) {
            const double d =
                atoms->mask[i] & compute->mask ? hs_unwrapped(compute->env, axis, i) - state->origin.of[axis][i] : 0.0;
            column[axis][i] = d;
            sum += d * d;
        }
        column[3][i] = sqrt(sum);
    }
    return HS_OK;
}

const hs_compute_style hs_compute_style_displace_atom = {
    .about =
        {.name = "displace/atom",
         .syntax = {.usage = "", .n_min = 0, .n_max = 0},
         .summary = "displacement of each atom since the compute was defined",
         .details =
             "The values per atom `c_ID[1]` ... `c_ID[4]` are dx, dy, dz and their length (distance units), from the "
             "place where the atom was when the compute was defined, crossings of periodic faces included; atoms "
             "outside the group have 0. Starting places travel with the atoms and are part of checkpoints; "
             "after `read_restart` a compute of the same ID goes on from them.",
         .example = "compute d all displace/atom\ncompute far all reduce max c_d[4]"},
    .state_size = sizeof(displace_state),
    .create = create,
    .destroy = destroy,
    .per_atom = per_atom,
    .needs_fixed_group = true,
};
