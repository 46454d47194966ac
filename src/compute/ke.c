/* Kinetic energy of a group: sum(m v^2) / 2. */
#include "core/atom_style.h"
#include "style/atom_sum.h"
#include "style/compute.h"

static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    return hs_syntax_check(&compute->style->about.syntax, args, false, err);
}

static void add_mv2(const hs_atoms *atoms, const void *context, int begin, int end, hs_exact_sum *sums)
{
    const uint32_t mask = *(const uint32_t *)context;
    for (int i = begin; i < end; ++i) {
        if (!(atoms->mask[i] & mask)) continue;
        const double vx = atoms->v[0][i], vy = atoms->v[1][i], vz = atoms->v[2][i];
        hs_exact_add(&sums[0], (vx * vx + vy * vy + vz * vz) * hs_atom_mass(atoms, i));
    }
}

static hs_status scalar(hs_compute *compute, double *value, hs_error *err)
{
    const hs_env *env = compute->env;
    (void)err;
    hs_atom_sum(env->atoms, env->parallel, add_mv2, &compute->mask, 1, value);
    *value *= 0.5 * env->units->mvv2e;
    return HS_OK;
}

const hs_compute_style hs_compute_style_ke = {
    .about = {.name = "ke",
              .syntax = {.usage = "", .n_min = 0, .n_max = 0},
              .summary = "kinetic energy of a group",
              .details =
                  "The scalar `c_ID` is sum(m v^2) / 2 of the group's atoms (energy units). It grows with the number "
                  "of atoms: under `thermo_modify norm yes` thermo output divides it by the number of all atoms.",
              .example = "compute k all ke"},
    .create = create,
    .scalar = scalar,
    .is_extensive = true,
};
