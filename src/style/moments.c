#include "style/moments.h"
#include "style/places.h"

#include "base/wide.h"
#include "core/atom_style.h"
#include "style/atom_sum.h"

typedef struct moment_context {
    const hs_env *env;
    uint32_t mask;
    bool with_x, with_v;
} moment_context;

HS_WIDE static void add_moments(const hs_atoms *atoms, const void *context, int begin, int end, hs_exact_sum *sums)
{
    const moment_context *c = context;
    const int n = end - begin;
    double mass[HS_EXACT_ARRAY_MAX], term[HS_EXACT_ARRAY_MAX];
    for (int i = 0; i < n; ++i) mass[i] = atoms->mask[begin + i] & c->mask ? hs_atom_mass(atoms, begin + i) : 0.0;
    hs_exact_add_array(&sums[0], mass, n);
    for (int axis = 0; axis < 3; ++axis) {
        if (c->with_x) {
            hs_unwrapped_run(c->env, axis, begin, end, term);
            for (int i = 0; i < n; ++i) term[i] *= mass[i];
            hs_exact_add_array(&sums[1 + axis], term, n);
        }
        if (c->with_v) {
            const double *v = atoms->v[axis] + begin;
            for (int i = 0; i < n; ++i) term[i] = mass[i] * v[i];
            hs_exact_add_array(&sums[4 + axis], term, n);
        }
    }
}

double hs_center_of_mass(const hs_env *env, uint32_t mask, double x[3], double v[3])
{
    const moment_context context = {env, mask, x != NULL, v != NULL};
    double sums[7];
    hs_atom_sum(env->atoms, env->parallel, add_moments, &context, 7, sums);
    for (int axis = 0; axis < 3; ++axis) {
        if (x != NULL) x[axis] = sums[0] > 0.0 ? sums[1 + axis] / sums[0] : 0.0;
        if (v != NULL) v[axis] = sums[0] > 0.0 ? sums[4 + axis] / sums[0] : 0.0;
    }
    return sums[0];
}
