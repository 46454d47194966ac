/* Atoms that stay in the plane. */
#include <math.h>

#include "sim/sim.h"

static bool fixes_keep_plane(const hs_sim *sim)
{
    for (int k = 0; k < sim->n_fixes; ++k)
        if (!sim->fix[k]->style->keeps_plane) return false;
    return true;
}

/** Whether all are +0. A -0 would not stay, for -0 + 0 is +0, and output shows the sign. */
static bool are_zero(const double *values, int n)
{
    for (int i = 0; i < n; ++i)
        if (values[i] != 0.0 || signbit(values[i])) return false;
    return true;
}

bool hs_sim_is_planar(const hs_sim *sim)
{
    const hs_atoms *atoms = &sim->atoms;
    if (sim->box.dimension != 2 || !fixes_keep_plane(sim)) return false;
    int64_t has_z = !are_zero(atoms->x[2], atoms->n_local) || !are_zero(atoms->v[2], atoms->n_local) ||
                    !are_zero(atoms->f[2], atoms->n_local);
    hs_parallel_max_int64(&sim->parallel, &has_z, 1);
    return has_z == 0;
}
