/* How far displacements are from a Gaussian distribution: alpha_2 = d/(d + 2) <r^4>/<r^2>^2 - 1 in d dimensions. */
#include "base/memory.h"
#include "style/atom_sum.h"
#include "style/atom_vector.h"
#include "style/compute.h"
#include "style/moments.h"
#include "style/places.h"

typedef struct nongauss_state {
    hs_atom_vector origin; /**< unwrapped places at the start, with com relative to the center of mass */
    bool has_com;
    double center[3];
} nongauss_state;

static const hs_keyword keywords[] = {
    {"com", 1, "yes|no", "displacements relative to the drift of the center of mass (default: no)"},
    {NULL, 0, NULL, NULL},
};

static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    nongauss_state *state = compute->state;
    const hs_env *env = compute->env;
    for (int i = 0; i + 1 < args->n; i += 2) HS_TRY(hs_arg_bool(args, i + 1, &state->has_com, err));
    compute->n_vector = 3;
    HS_TRY(HS_ALLOC(compute->vector, 3, err));
    HS_TRY(hs_atom_vector_add(env->atoms, &state->origin, "compute", compute->id, "origin", err));
    if (state->has_com) hs_center_of_mass(env, compute->mask, state->center, NULL);
    hs_atom_vector_set_places(&state->origin, env, state->center);
    return HS_OK;
}

static void destroy(hs_compute *compute)
{
    hs_atom_vector_remove(compute->env->atoms, &((nongauss_state *)compute->state)->origin);
    HS_FREE(compute->vector);
}

static void add_terms(const hs_atoms *atoms, const void *context, int begin, int end, hs_exact_sum *sums)
{
    const hs_compute *compute = context;
    const nongauss_state *state = compute->state;
    for (int i = begin; i < end; ++i) {
        double r2 = 0.0;
        if (!(atoms->mask[i] & compute->mask)) continue;
        for (int axis = 0; axis < 3; ++axis) {
            const double d = hs_unwrapped(compute->env, axis, i) - state->center[axis] - state->origin.of[axis][i];
            r2 += d * d;
        }
        hs_exact_add(&sums[0], r2);
        hs_exact_add(&sums[1], r2 * r2);
    }
}

static hs_status vector(hs_compute *compute, hs_error *err)
{
    nongauss_state *state = compute->state;
    const hs_env *env = compute->env;
    const double d = env->box->dimension;
    double *v = compute->vector;
    (void)err;
    if (state->has_com) hs_center_of_mass(env, compute->mask, state->center, NULL);
    hs_atom_sum(env->atoms, env->parallel, add_terms, compute, 2, v);
    const int64_t n = hs_atom_count(env->atoms, env->parallel, compute->mask);
    for (int k = 0; k < 2; ++k) v[k] = n > 0 ? v[k] / (double)n : 0.0;
    v[2] = v[0] > 0.0 ? d / (d + 2.0) * v[1] / (v[0] * v[0]) - 1.0 : 0.0;
    return HS_OK;
}

const hs_compute_style hs_compute_style_msd_nongauss = {
    .about =
        {.name = "msd/nongauss",
         .syntax = {.usage = "[com yes|no]", .n_min = 0, .n_max = 0, .keywords = keywords},
         .summary = "non-Gaussian parameter of the displacements",
         .details =
             "The vector `c_ID[1]` ... `c_ID[3]` is the mean over the group's atoms of r^2 and r^4 (distance^2 and "
             "^4), and the non-Gaussian parameter alpha_2 = d/(d + 2) <r^4>/<r^2>^2 - 1 in d dimensions (3/5 in "
             "three, 1/2 in two): 0 where displacements are Gaussian, as in free diffusion, positive where some "
             "atoms go far and others are caged. r is the displacement from the place where the atom was when the "
             "compute was defined, crossings of periodic faces included; while nothing has moved, alpha_2 is 0. "
             "Starting places travel with the atoms and are part of checkpoints. `fix ave/self` averages over "
             "many starting times.",
         .reference = "A. Rahman, Phys. Rev. 136, A405 (1964), doi:10.1103/PhysRev.136.A405",
         .example = "compute ng all msd/nongauss com yes\nthermo_style custom step temp c_ng[1] c_ng[3]"},
    .state_size = sizeof(nongauss_state),
    .create = create,
    .destroy = destroy,
    .vector = vector,
    .needs_fixed_group = true,
};
