/* Energy of rotation of spheres: E = sum I omega^2 / 2, I = (2/5) m R^2. */
#include "style/atom_sum.h"
#include "style/compute.h"
#include "style/spheres.h"

static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    HS_TRY(hs_syntax_check(&compute->style->about.syntax, args, false, err));
    if (compute->env->atoms->omega[0] != NULL) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "%s: the atoms are no spheres: use 'atom_style sphere'", args->command);
}

static void add_energy(const hs_atoms *atoms, const void *context, int begin, int end, hs_exact_sum *sums)
{
    const hs_compute *compute = context;
    for (int i = begin; i < end; ++i) {
        if (!(atoms->mask[i] & compute->mask)) continue;
        const double w[3] = {atoms->omega[0][i], atoms->omega[1][i], atoms->omega[2][i]};
        hs_exact_add(&sums[0], (w[0] * w[0] + w[1] * w[1] + w[2] * w[2]) * hs_sphere_inertia(atoms, i));
    }
}

static hs_status scalar(hs_compute *compute, double *value, hs_error *err)
{
    const hs_env *env = compute->env;
    double sum;
    (void)err;
    hs_atom_sum(env->atoms, env->parallel, add_energy, compute, 1, &sum);
    *value = 0.5 * env->units->mvv2e * sum;
    return HS_OK;
}

const hs_compute_style hs_compute_style_erotate_sphere = {
    .about = {.name = "erotate/sphere",
              .syntax = {.usage = "", .n_min = 0, .n_max = 0},
              .summary = "energy of rotation of spheres",
              .details =
                  "The scalar `c_ID` is the sum of I omega^2 / 2 over the atoms of the group, with the moment of "
                  "inertia I = (2/5) m R^2 (energy; under `thermo_modify norm yes` divided by the number of atoms). "
                  "Points have none.",
              .example = "compute r all erotate/sphere\nthermo_style custom step temp c_r"},
    .create = create,
    .scalar = scalar,
    .is_extensive = true,
};
