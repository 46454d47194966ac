/* Kinetic energy of each atom: m v^2 / 2. */
#include "core/atom_style.h"
#include "style/compute.h"

static hs_status per_atom(hs_compute *compute, hs_error *err)
{
    const hs_atoms *atoms = compute->env->atoms;
    const double half_mvv2e = 0.5 * compute->env->units->mvv2e;
    double *energy = compute->atoms;
    (void)err;
#pragma omp parallel for schedule(static)
    for (int i = 0; i < atoms->n_local; ++i) {
        const double vx = atoms->v[0][i], vy = atoms->v[1][i], vz = atoms->v[2][i];
        const double mass = atoms->mask[i] & compute->mask ? hs_atom_mass(atoms, i) : 0.0;
        energy[i] = half_mvv2e * mass * (vx * vx + vy * vy + vz * vz);
    }
    return HS_OK;
}

const hs_compute_style hs_compute_style_ke_atom = {
    .about = {.name = "ke/atom",
              .syntax = {.usage = "", .n_min = 0, .n_max = 0},
              .summary = "kinetic energy of each atom",
              .details = "The value per atom `c_ID` is m v^2 / 2 (energy units); atoms outside the group have 0.",
              .example = "compute k all ke/atom\ncompute kmax all reduce max c_k"},
    .per_atom = per_atom,
};
