/* Velocity autocorrelation of a group since the compute was defined: <v(t) v(0)>. */
#include "base/memory.h"
#include "base/wide.h"
#include "style/atom_sum.h"
#include "style/atom_vector.h"
#include "style/compute.h"

typedef struct vacf_state {
    hs_atom_vector origin; /**< velocities at the start */
} vacf_state;

static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    vacf_state *state = compute->state;
    hs_atoms *atoms = compute->env->atoms;
    HS_TRY(hs_syntax_check(&compute->style->about.syntax, args, false, err));
    compute->n_vector = 4;
    HS_TRY(HS_ALLOC(compute->vector, 4, err));
    HS_TRY(hs_atom_vector_add(atoms, &state->origin, "compute", compute->id, "origin", err));
    for (int axis = 0; axis < 3; ++axis)
        for (int i = 0; i < atoms->n_local; ++i) state->origin.of[axis][i] = atoms->v[axis][i];
    return HS_OK;
}

static void destroy(hs_compute *compute)
{
    vacf_state *state = compute->state;
    hs_atom_vector_remove(compute->env->atoms, &state->origin);
    HS_FREE(compute->vector);
}

HS_WIDE static void add_terms(const hs_atoms *atoms, const void *context, int begin, int end, hs_exact_sum *sums)
{
    const hs_compute *compute = context;
    const vacf_state *state = compute->state;
    const uint32_t *mask = atoms->mask + begin, group = compute->mask;
    const int n = end - begin;
    double product[HS_EXACT_ARRAY_MAX];
    for (int axis = 0; axis < 3; ++axis) {
        const int next = (axis + 1) % 3, from = axis < 2 ? begin : end;
        HS_FETCH(atoms->v[next] + from, n);
        HS_FETCH(state->origin.of[next] + from, n);
        const double *v = atoms->v[axis] + begin, *origin = state->origin.of[axis] + begin;
        for (int i = 0; i < n; ++i) product[i] = mask[i] & group ? v[i] * origin[i] : 0.0;
        hs_exact_add_array(&sums[axis], product, n);
    }
}

static hs_status vector(hs_compute *compute, hs_error *err)
{
    const hs_env *env = compute->env;
    (void)err;
    hs_atom_sum(env->atoms, env->parallel, add_terms, compute, 3, compute->vector);
    compute->vector[3] = compute->vector[0] + compute->vector[1] + compute->vector[2];
    const int64_t n = hs_atom_count(env->atoms, env->parallel, compute->mask);
    for (int k = 0; k < 4; ++k) compute->vector[k] = n > 0 ? compute->vector[k] / (double)n : 0.0;
    return HS_OK;
}

const hs_compute_style hs_compute_style_vacf = {
    .about =
        {.name = "vacf",
         .syntax = {.usage = "", .n_min = 0, .n_max = 0},
         .summary = "velocity autocorrelation",
         .details =
             "The vector `c_ID[1]` ... `c_ID[4]` is the mean over the group's atoms of v_x(t) v_x(0), the same of y "
             "and z, and of their sum (velocity^2), with t counted from the definition of the compute. The integral of "
             "`c_ID[4]` over time is dim D, with D the diffusion coefficient. Starting velocities travel with the "
             "atoms and are part of checkpoints; after `read_restart` a compute of the same ID goes on from them.",
         .reference = "R. Kubo, J. Phys. Soc. Jpn. 12, 570 (1957), doi:10.1143/JPSJ.12.570",
         .example = "compute vacf all vacf\nfix 5 all vector 1 c_vacf[4]\nvariable D equal dt*trap(f_5)/3"},
    .state_size = sizeof(vacf_state),
    .create = create,
    .destroy = destroy,
    .vector = vector,
    .needs_fixed_group = true,
};
