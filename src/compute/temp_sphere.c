/* Temperature of spheres that move and turn: T = (sum m v^2 + sum I omega^2) / (n_dof k), I = (2/5) m R^2. */
#include <string.h>

#include "style/atom_sum.h"
#include "style/spheres.h"
#include "style/temperature.h"

typedef struct temp_sphere_state {
    hs_temperature temperature; /**< must be first */
    bool is_rotation;           /**< dof rotate: nothing but the rotation */
} temp_sphere_state;

static const hs_keyword keywords[] = {
    {"dof", 1, "all|rotate", "all degrees of freedom (default), or those of rotation alone"},
    {NULL, 0, NULL, NULL},
};

static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    temp_sphere_state *state = compute->state;
    HS_TRY(hs_syntax_check(&compute->style->about.syntax, args, false, err));
    if (compute->env->atoms->omega[0] == NULL)
        return hs_fail(err, HS_ERROR_INPUT, "%s: the atoms are no spheres: use 'atom_style sphere'", args->command);
    HS_TRY(hs_temperature_create(compute, HS_ALL_AXES, err));
    for (int i = 0; i < args->n; i += 2) state->is_rotation = strcmp(args->word[i + 1], "rotate") == 0;
    /* momentum is conserved, angular velocities are not */
    state->temperature.has_n_fixed = state->is_rotation;
    return HS_OK;
}

/** Spheres have 3 degrees of freedom of rotation in space and 1 in the plane, points none. */
static hs_status init(hs_compute *compute, hs_error *err)
{
    const temp_sphere_state *state = compute->state;
    const hs_env *env = compute->env;
    const hs_atoms *atoms = env->atoms;
    const int dimension = env->box->dimension;
    int64_t n[2] = {0, 0};
    for (int i = 0; i < atoms->n_local; ++i) {
        if (!(atoms->mask[i] & compute->mask)) continue;
        ++n[0];
        n[1] += atoms->radius[i] > 0.0;
    }
    hs_parallel_sum_int64(env->parallel, n, 2);
    const double n_fixed = state->temperature.has_n_fixed ? state->temperature.n_fixed : dimension;
    compute->n_dof = (double)n[1] * (dimension == 3 ? 3.0 : 1.0) - n_fixed;
    if (!state->is_rotation) compute->n_dof += (double)n[0] * dimension;
    return hs_temperature_check_freedom(compute, n[0], err);
}

/** m v_a v_b + I omega_a omega_b of atom i, xx yy zz xy xz yz. */
static void terms_of(const hs_compute *compute, const hs_atoms *atoms, int i, double term[6])
{
    static const int pair[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};
    const temp_sphere_state *state = compute->state;
    const double m = state->is_rotation ? 0.0 : atoms->rmass[i], inertia = hs_sphere_inertia(atoms, i);
    for (int k = 0; k < 6; ++k) {
        const int a = pair[k][0], b = pair[k][1];
        term[k] = m * atoms->v[a][i] * atoms->v[b][i] + inertia * atoms->omega[a][i] * atoms->omega[b][i];
    }
}

static void add_trace(const hs_atoms *atoms, const void *context, int begin, int end, hs_exact_sum *sums)
{
    const hs_compute *compute = context;
    for (int i = begin; i < end; ++i) {
        double term[6];
        if (!(atoms->mask[i] & compute->mask)) continue;
        terms_of(compute, atoms, i, term);
        hs_exact_add(&sums[0], term[0] + term[1] + term[2]);
    }
}

static void add_tensor(const hs_atoms *atoms, const void *context, int begin, int end, hs_exact_sum *sums)
{
    const hs_compute *compute = context;
    for (int i = begin; i < end; ++i) {
        double term[6];
        if (!(atoms->mask[i] & compute->mask)) continue;
        terms_of(compute, atoms, i, term);
        for (int k = 0; k < 6; ++k) hs_exact_add(&sums[k], term[k]);
    }
}

static hs_status scalar(hs_compute *compute, double *value, hs_error *err)
{
    const hs_env *env = compute->env;
    double sum;
    if (compute->n_dof < 0.0 || hs_temperature_is_recounted(compute)) HS_TRY(init(compute, err));
    hs_atom_sum(env->atoms, env->parallel, add_trace, compute, 1, &sum);
    *value = compute->n_dof > 0.0 ? sum * (env->units->mvv2e / (compute->n_dof * env->units->boltz)) : 0.0;
    return HS_OK;
}

static hs_status vector(hs_compute *compute, hs_error *err)
{
    const hs_env *env = compute->env;
    (void)err;
    hs_atom_sum(env->atoms, env->parallel, add_tensor, compute, 6, compute->vector);
    for (int k = 0; k < 6; ++k) compute->vector[k] *= env->units->mvv2e;
    return HS_OK;
}

const hs_compute_style hs_compute_style_temp_sphere = {
    .about =
        {.name = "temp/sphere",
         .syntax = {.usage = "[keyword value]", .n_min = 0, .n_max = 0, .keywords = keywords},
         .summary = "temperature of spheres that move and turn",
         .details =
             "The scalar `c_ID` is (sum(m v^2) + sum(I omega^2)) / (n_dof k), with I = (2/5) m R^2. Spheres have 6 "
             "degrees of freedom (3 in two dimensions), points 3 (2), less those of the center of mass; with `dof "
             "rotate` the rotation alone counts, with 3 (1) of each sphere. The vector is the tensor sum(m v_a v_b + I "
             "omega_a omega_b) in the order xx, yy, zz, xy, xz, yz (energy). As in LAMMPS a pressure that takes its "
             "temperature from here, as that of `fix npt/sphere` does, counts the rotation as if it pushed the walls.",
         .example = "compute t all temp/sphere\ncompute r all temp/sphere dof rotate"},
    .state_size = sizeof(temp_sphere_state),
    .create = create,
    .destroy = hs_temperature_destroy,
    .init = init,
    .scalar = scalar,
    .vector = vector,
    .modify = hs_temperature_modify,
    .is_vector_extensive = true,
    .is_temperature = true,
};
