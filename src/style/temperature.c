#include "style/temperature.h"

#include <string.h>

#include "base/memory.h"
#include "core/atom_style.h"
#include "style/atom_sum.h"

hs_status hs_temperature_create(hs_compute *compute, int n_axes, hs_error *err)
{
    hs_temperature *state = compute->state;
    state->n_axes = n_axes;
    compute->n_vector = 6;
    compute->n_dof = -1.0;
    return HS_ALLOC(compute->vector, 6, err);
}

void hs_temperature_destroy(hs_compute *compute) { HS_FREE(compute->vector); }

static void thermal(const hs_compute *compute, const hs_atoms *atoms, int i, double v[3])
{
    double bias[3];
    for (int axis = 0; axis < 3; ++axis) v[axis] = atoms->v[axis][i];
    if (compute->style->bias == NULL) return;
    compute->style->bias(compute, i, bias);
    for (int axis = 0; axis < 3; ++axis) v[axis] -= bias[axis];
}

/** Atoms that the temperature is about: all of the group, or those that the style says. */
static bool counts(const hs_compute *compute, const hs_atoms *atoms, int i)
{
    return (atoms->mask[i] & compute->mask) != 0 &&
           (compute->style->counts == NULL || compute->style->counts(compute, i));
}

bool hs_temperature_is_recounted(const hs_compute *compute)
{
    return ((const hs_temperature *)compute->state)->is_dynamic || (compute->env->groups->dynamic & compute->mask) != 0;
}

hs_status hs_temperature_check_freedom(const hs_compute *compute, int64_t n, hs_error *err)
{
    if (compute->n_dof >= 0.0 || n == 0 || hs_temperature_is_recounted(compute)) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "%s: %lld atoms have fewer than 0 degrees of freedom",
                   hs_compute_who(compute).text, (long long)n);
}

hs_status hs_temperature_init(hs_compute *compute, hs_error *err)
{
    const hs_temperature *state = compute->state;
    const hs_env *env = compute->env;
    int64_t n = 0;
    for (int i = 0; i < env->atoms->n_local; ++i) n += counts(compute, env->atoms, i);
    hs_parallel_sum_int64(env->parallel, &n, 1);
    const int n_axes = state->n_axes != HS_ALL_AXES ? state->n_axes : env->box->dimension;
    /* those that are not thermal are spread evenly over the box's axes */
    const double n_fixed = state->has_n_fixed ? state->n_fixed : env->box->dimension;
    compute->n_dof = (double)n_axes * (double)n - n_fixed * n_axes / env->box->dimension - state->n_bias;
    return hs_temperature_check_freedom(compute, n, err);
}

static void add_mv2(const hs_atoms *atoms, const void *context, int begin, int end, hs_exact_sum *sums)
{
    const hs_compute *compute = context;
    for (int i = begin; i < end; ++i) {
        double v[3];
        if (!counts(compute, atoms, i)) continue;
        thermal(compute, atoms, i, v);
        hs_exact_add(&sums[0], (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) * hs_atom_mass(atoms, i));
    }
}

static void add_tensor(const hs_atoms *atoms, const void *context, int begin, int end, hs_exact_sum *sums)
{
    const hs_compute *compute = context;
    for (int i = begin; i < end; ++i) {
        double v[3];
        if (!counts(compute, atoms, i)) continue;
        thermal(compute, atoms, i, v);
        const double m = hs_atom_mass(atoms, i);
        const double term[6] = {m * v[0] * v[0], m * v[1] * v[1], m * v[2] * v[2],
                                m * v[0] * v[1], m * v[0] * v[2], m * v[1] * v[2]};
        for (int k = 0; k < 6; ++k) hs_exact_add(&sums[k], term[k]);
    }
}

hs_status hs_temperature_scalar(hs_compute *compute, double *value, hs_error *err)
{
    const hs_env *env = compute->env;
    double sum;
    if (compute->n_dof < 0.0 || hs_temperature_is_recounted(compute)) HS_TRY(hs_temperature_init(compute, err));
    hs_atom_sum(env->atoms, env->parallel, add_mv2, compute, 1, &sum);
    *value = compute->n_dof > 0.0 ? sum * (env->units->mvv2e / (compute->n_dof * env->units->boltz)) : 0.0;
    return HS_OK;
}

hs_status hs_temperature_vector(hs_compute *compute, hs_error *err)
{
    (void)err;
    const hs_env *env = compute->env;
    hs_atom_sum(env->atoms, env->parallel, add_tensor, compute, 6, compute->vector);
    for (int k = 0; k < 6; ++k) compute->vector[k] *= env->units->mvv2e;
    return HS_OK;
}

hs_status hs_temperature_modify(hs_compute *compute, const hs_args *args, int *n_used, hs_error *err)
{
    hs_temperature *state = compute->state;
    *n_used = 2;
    if (strcmp(args->word[0], "extra") == 0 || strcmp(args->word[0], "extra/dof") == 0) {
        compute->n_dof = -1.0;
        state->has_n_fixed = true;
        return hs_arg_double(args, 1, &state->n_fixed, err);
    }
    if (strcmp(args->word[0], "dynamic") == 0 || strcmp(args->word[0], "dynamic/dof") == 0)
        return hs_arg_bool(args, 1, &state->is_dynamic, err);
    *n_used = 0;
    return HS_OK;
}
