#include "style/compute.h"

/** The pair energy and virial of this step exist only when the step was told to compute them. */
static hs_status check_energy(const hs_compute *compute, hs_error *err)
{
    const hs_env *env = compute->env;
    if (!compute->style->needs_energy || env->energy_step == env->step) return HS_OK;
    return hs_fail(
        err, HS_ERROR_INPUT,
        "compute '%s' (%s) needs the energy or virial of step %lld, which was not computed on that step; use it "
        "on steps with thermo output, or after 'run 0'",
        compute->id, compute->style->about.name, (long long)env->step);
}

hs_status hs_compute_scalar(hs_compute *compute, double *value, hs_error *err)
{
    if (compute->style->scalar == NULL)
        return hs_fail(err, HS_ERROR_INPUT, "compute '%s' (%s) has no scalar value%s", compute->id,
                       compute->style->about.name,
                       compute->style->vector != NULL ? "; its elements are c_ID[1], ..." : "");
    HS_TRY(check_energy(compute, err));
    if (compute->scalar_step != compute->env->step) {
        HS_TRY(compute->style->scalar(compute, &compute->scalar, err));
        compute->scalar_step = compute->env->step;
    }
    *value = compute->scalar;
    return HS_OK;
}

hs_status hs_compute_vector(hs_compute *compute, int i, double *value, hs_error *err)
{
    if (compute->style->vector == NULL)
        return hs_fail(err, HS_ERROR_INPUT, "compute '%s' (%s) has no vector; its value is c_%s", compute->id,
                       compute->style->about.name, compute->id);
    if (i < 0 || i >= compute->n_vector)
        return hs_fail(err, HS_ERROR_INPUT, "c_%s[%d]: the vector of compute '%s' (%s) has the elements 1 to %d",
                       compute->id, i + 1, compute->id, compute->style->about.name, compute->n_vector);
    HS_TRY(check_energy(compute, err));
    if (compute->vector_step != compute->env->step) {
        HS_TRY(compute->style->vector(compute, err));
        compute->vector_step = compute->env->step;
    }
    *value = compute->vector[i];
    return HS_OK;
}

void hs_compute_invalidate(hs_compute *compute)
{
    compute->scalar_step = -1;
    compute->vector_step = -1;
}
