/* Temperature of a group from its kinetic energy: T = sum(m v^2) / (n_dof k), n_dof = dim N - dim. */
#include "base/memory.h"
#include "style/atom_sum.h"
#include "style/compute.h"

static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    HS_TRY(hs_syntax_check(&compute->style->about.syntax, args, false, err));
    compute->n_vector = 6;
    compute->n_dof = -1.0;
    return HS_ALLOC(compute->vector, 6, err);
}

static void destroy(hs_compute *compute) { HS_FREE(compute->vector); }

/** Momentum is conserved, so dim degrees of freedom are not thermal. */
static hs_status init(hs_compute *compute, hs_error *err)
{
    const hs_env *env = compute->env;
    const int dim = env->box->dimension;
    const int64_t n = hs_atom_count(env->atoms, env->parallel, compute->mask);
    compute->n_dof = (double)dim * (double)n - (double)dim;
    if (compute->n_dof < 0.0 && n > 0)
        return hs_fail(err, HS_ERROR_INPUT, "compute '%s' (temp): %lld atoms have fewer than 0 degrees of freedom",
                       compute->id, (long long)n);
    return HS_OK;
}

static void add_mv2(const hs_atoms *atoms, const void *context, int begin, int end, hs_exact_sum *sums)
{
    const uint32_t mask = *(const uint32_t *)context;
    for (int i = begin; i < end; ++i) {
        if (!(atoms->mask[i] & mask)) continue;
        const double vx = atoms->v[0][i], vy = atoms->v[1][i], vz = atoms->v[2][i];
        hs_exact_add(&sums[0], (vx * vx + vy * vy + vz * vz) * atoms->mass[atoms->type[i]]);
    }
}

static void add_tensor(const hs_atoms *atoms, const void *context, int begin, int end, hs_exact_sum *sums)
{
    const uint32_t mask = *(const uint32_t *)context;
    for (int i = begin; i < end; ++i) {
        if (!(atoms->mask[i] & mask)) continue;
        const double m = atoms->mass[atoms->type[i]], vx = atoms->v[0][i], vy = atoms->v[1][i], vz = atoms->v[2][i];
        const double term[6] = {m * vx * vx, m * vy * vy, m * vz * vz, m * vx * vy, m * vx * vz, m * vy * vz};
        for (int k = 0; k < 6; ++k) hs_exact_add(&sums[k], term[k]);
    }
}

static hs_status scalar(hs_compute *compute, double *value, hs_error *err)
{
    const hs_env *env = compute->env;
    double sum;
    if (compute->n_dof < 0.0) HS_TRY(init(compute, err));
    hs_atom_sum(env->atoms, env->parallel, add_mv2, &compute->mask, 1, &sum);
    *value = compute->n_dof > 0.0 ? sum * (env->units->mvv2e / (compute->n_dof * env->units->boltz)) : 0.0;
    return HS_OK;
}

static hs_status vector(hs_compute *compute, hs_error *err)
{
    (void)err;
    const hs_env *env = compute->env;
    hs_atom_sum(env->atoms, env->parallel, add_tensor, &compute->mask, 6, compute->vector);
    for (int k = 0; k < 6; ++k) compute->vector[k] *= env->units->mvv2e;
    return HS_OK;
}

const hs_compute_style hs_compute_style_temp = {
    .about = {.name = "temp",
              .syntax = {.usage = "", .n_min = 0, .n_max = 0},
              .summary = "temperature of a group",
              .details =
                  "The scalar `c_ID` is the temperature, sum(m v^2) / (n_dof k), with n_dof = dim N - dim degrees of "
                  "freedom (temperature units). The vector `c_ID[1]` ... `c_ID[6]` is the kinetic-energy tensor "
                  "sum(m v_a v_b) in the order xx, yy, zz, xy, xz, yz (energy units); under `thermo_modify norm yes` "
                  "thermo output divides it by the number of atoms. The degrees of freedom are counted at the start "
                  "of each run. Every simulation has one of these, `thermo_temp`, for group all.",
              .example = "compute slow lower temp"},
    .create = create,
    .destroy = destroy,
    .init = init,
    .scalar = scalar,
    .vector = vector,
    .is_vector_extensive = true,
    .is_temperature = true,
};
