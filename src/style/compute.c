#include "style/compute.h"

#include "base/memory.h"
#include "base/text.h"

const hs_compute_style *hs_compute_style_find(const char *name)
{
    for (int k = 0; hs_compute_styles[k] != NULL; ++k)
        if (hs_text_is_style(name, hs_compute_styles[k]->about.name)) return hs_compute_styles[k];
    return NULL;
}

hs_who hs_compute_who(const hs_compute *compute)
{
    hs_who who;
    snprintf(who.text, sizeof who.text, "compute '%.128s' (%.40s)", compute->id, compute->style->about.name);
    return who;
}

hs_status hs_compute_get(hs_env *env, const char *id, hs_measure what, const char *who, hs_compute **compute,
                         hs_error *err)
{
    *compute = env->find_compute(env, id);
    if (*compute == NULL) return hs_fail(err, HS_ERROR_INPUT, "%s: there is no compute '%s'", who, id);
    const hs_compute_style *style = (*compute)->style;
    if (what == HS_TEMPERATURE ? style->is_temperature : style->is_pressure) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "%s: %s does not compute a %s", who, hs_compute_who(*compute).text,
                   what == HS_TEMPERATURE ? "temperature" : "pressure");
}

hs_status hs_compute_create(hs_compute **compute, hs_env *env, const hs_compute_style *style, const char *id, int group,
                            const hs_args *args, hs_error *err)
{
    hs_compute *new_one;
    *compute = NULL;
    HS_TRY(HS_ALLOC(new_one, 1, err));
    *new_one = (hs_compute){.style = style,
                            .group = group,
                            .mask = hs_group_mask(group),
                            .env = env,
                            .is_extensive = style->is_extensive,
                            .is_vector_extensive = style->is_vector_extensive,
                            .has_scalar = style->scalar != NULL,
                            .has_vector = style->vector != NULL,
                            .has_array = style->array != NULL,
                            .has_atoms = style->per_atom != NULL,
                            .has_local = style->local != NULL};
    hs_compute_invalidate(new_one);
    hs_status status = hs_memory_strdup(&new_one->id, id, err);
    if (status == HS_OK) status = hs_memory_alloc(&new_one->state, 1, style->state_size + 1, err);
    if (status == HS_OK && style->create != NULL) status = style->create(new_one, args, err);
    if (status == HS_OK)
        *compute = new_one;
    else
        hs_compute_destroy(&new_one);
    return status;
}

void hs_compute_destroy(hs_compute **compute)
{
    hs_compute *old = *compute;
    if (old == NULL) return;
    if (old->state != NULL && old->style->destroy != NULL) old->style->destroy(old);
    HS_FREE(old->atoms);
    hs_local_rows_fini(&old->local);
    HS_FREE(old->state);
    HS_FREE(old->id);
    HS_FREE(*compute);
}

/** The pair energy and virial of this step exist only when the step was told to compute them. */
static hs_status check_energy(const hs_compute *compute, hs_error *err)
{
    const hs_env *env = compute->env;
    if (!compute->style->needs_energy || env->energy_step == env->step) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT,
                   "%s needs the energy or virial of step %lld, which was not computed on that step; use it on steps "
                   "with thermo output, or after 'run 0'",
                   hs_compute_who(compute).text, (long long)env->step);
}

/** Whether a result of revision @p at still holds. */
static bool is_current(const hs_compute *compute, uint64_t at) { return at != 0 && at == compute->env->revision; }

hs_status hs_compute_scalar(hs_compute *compute, double *value, hs_error *err)
{
    if (!compute->has_scalar)
        return hs_fail(err, HS_ERROR_INPUT, "%s has no scalar value%s", hs_compute_who(compute).text,
                       compute->has_vector ? "; its elements are c_ID[1], ..." : "");
    HS_TRY(check_energy(compute, err));
    if (!is_current(compute, compute->scalar_at)) {
        HS_TRY(compute->style->scalar(compute, &compute->scalar, err));
        compute->scalar_at = compute->env->revision;
    }
    *value = compute->scalar;
    return HS_OK;
}

hs_status hs_compute_eval_vector(hs_compute *compute, hs_error *err)
{
    if (!compute->has_vector) return hs_fail(err, HS_ERROR_INPUT, "%s has no vector", hs_compute_who(compute).text);
    HS_TRY(check_energy(compute, err));
    if (is_current(compute, compute->vector_at)) return HS_OK;
    HS_TRY(compute->style->vector(compute, err));
    compute->vector_at = compute->env->revision;
    return HS_OK;
}

hs_status hs_compute_eval_array(hs_compute *compute, hs_error *err)
{
    if (!compute->has_array) return hs_fail(err, HS_ERROR_INPUT, "%s has no array", hs_compute_who(compute).text);
    HS_TRY(check_energy(compute, err));
    if (is_current(compute, compute->array_at)) return HS_OK;
    HS_TRY(compute->style->array(compute, err));
    compute->array_at = compute->env->revision;
    return HS_OK;
}

hs_status hs_compute_eval_atoms(hs_compute *compute, hs_error *err)
{
    if (!compute->has_atoms)
        return hs_fail(err, HS_ERROR_INPUT, "%s has no values per atom", hs_compute_who(compute).text);
    HS_TRY(check_energy(compute, err));
    if (is_current(compute, compute->atoms_at)) return HS_OK;
    const size_t n =
        (size_t)compute->env->atoms->n_local * (size_t)(compute->n_atom_columns + !compute->n_atom_columns);
    HS_TRY(HS_RESERVE(compute->atoms, compute->capacity_atoms, n, err));
    HS_TRY(compute->style->per_atom(compute, err));
    compute->atoms_at = compute->env->revision;
    return HS_OK;
}

hs_status hs_compute_eval_local(hs_compute *compute, hs_error *err)
{
    if (!compute->has_local)
        return hs_fail(err, HS_ERROR_INPUT, "%s has no local values", hs_compute_who(compute).text);
    HS_TRY(check_energy(compute, err));
    if (is_current(compute, compute->local_at)) return HS_OK;
    HS_UNLESS_FAILED(err, compute->style->local(compute, err));
    HS_TRY(hs_local_rows_number(&compute->local, compute->env->parallel, err));
    compute->local_at = compute->env->revision;
    return HS_OK;
}

hs_status hs_compute_vector(hs_compute *compute, int i, double *value, hs_error *err)
{
    if (!compute->has_vector)
        return hs_fail(err, HS_ERROR_INPUT, "%s has no vector%s", hs_compute_who(compute).text,
                       compute->has_scalar ? "; its value is c_ID" : "");
    if (i < 0 || (i >= compute->n_vector && !compute->has_variable_length))
        return hs_fail(err, HS_ERROR_INPUT, "c_%s[%d]: the vector of %s has the elements 1 to %d", compute->id, i + 1,
                       hs_compute_who(compute).text, compute->n_vector);
    HS_TRY(hs_compute_eval_vector(compute, err));
    *value = i < compute->n_vector ? compute->vector[i] : 0.0;
    return HS_OK;
}

void hs_compute_invalidate(hs_compute *compute)
{
    compute->scalar_at = compute->vector_at = compute->array_at = compute->atoms_at = compute->local_at = 0;
}
