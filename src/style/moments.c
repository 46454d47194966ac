#include "style/moments.h"

#include "core/atom_style.h"
#include "style/atom_sum.h"

typedef struct moment_context {
    const hs_env *env;
    uint32_t mask;
} moment_context;

static void add_moments(const hs_atoms *atoms, const void *context, int begin, int end, hs_exact_sum *sums)
{
    const moment_context *c = context;
    for (int i = begin; i < end; ++i) {
        if (!(atoms->mask[i] & c->mask)) continue;
        const double mass = hs_atom_mass(atoms, i);
        hs_exact_add(&sums[0], mass);
        for (int axis = 0; axis < 3; ++axis) {
            hs_exact_add(&sums[1 + axis], mass * hs_unwrapped(c->env, axis, i));
            hs_exact_add(&sums[4 + axis], mass * atoms->v[axis][i]);
        }
    }
}

double hs_center_of_mass(const hs_env *env, uint32_t mask, double x[3], double v[3])
{
    const moment_context context = {env, mask};
    double sums[7];
    hs_atom_sum(env->atoms, env->parallel, add_moments, &context, 7, sums);
    for (int axis = 0; axis < 3; ++axis) {
        if (x != NULL) x[axis] = sums[0] > 0.0 ? sums[1 + axis] / sums[0] : 0.0;
        if (v != NULL) v[axis] = sums[0] > 0.0 ? sums[4 + axis] / sums[0] : 0.0;
    }
    return sums[0];
}
