/* Radius of gyration: R_g^2 = sum(m (r - r_cm)^2) / M, and the tensor of its parts. */
#include <math.h>

#include "base/memory.h"
#include "core/atom_style.h"
#include "style/atom_sum.h"
#include "style/compute.h"
#include "style/moments.h"
#include "style/places.h"

typedef struct gyration_context {
    const hs_compute *compute;
    double center[3];
} gyration_context;

static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    HS_TRY(hs_syntax_check(&compute->style->about.syntax, args, false, err));
    compute->n_vector = 6;
    return HS_ALLOC(compute->vector, 6, err);
}

static void destroy(hs_compute *compute) { HS_FREE(compute->vector); }

static void add_terms(const hs_atoms *atoms, const void *context, int begin, int end, hs_exact_sum *sums)
{
    static const int a[6] = {0, 1, 2, 0, 0, 1}, b[6] = {0, 1, 2, 1, 2, 2};
    const gyration_context *c = context;
    for (int i = begin; i < end; ++i) {
        if (!(atoms->mask[i] & c->compute->mask)) continue;
        const double mass = hs_atom_mass(atoms, i);
        double d[3];
        for (int axis = 0; axis < 3; ++axis) d[axis] = hs_unwrapped(c->compute->env, axis, i) - c->center[axis];
        for (int k = 0; k < 6; ++k) hs_exact_add(&sums[k], d[a[k]] * d[b[k]] * mass);
    }
}

static hs_status vector(hs_compute *compute, hs_error *err)
{
    const hs_env *env = compute->env;
    gyration_context context = {.compute = compute};
    (void)err;
    const double mass = hs_center_of_mass(env, compute->mask, context.center, NULL);
    hs_atom_sum(env->atoms, env->parallel, add_terms, &context, 6, compute->vector);
    for (int k = 0; k < 6; ++k) compute->vector[k] = mass > 0.0 ? compute->vector[k] / mass : 0.0;
    return HS_OK;
}

static hs_status scalar(hs_compute *compute, double *value, hs_error *err)
{
    HS_TRY(hs_compute_eval_vector(compute, err));
    *value = sqrt(compute->vector[0] + compute->vector[1] + compute->vector[2]);
    return HS_OK;
}

const hs_compute_style hs_compute_style_gyration = {
    .about = {.name = "gyration",
              .syntax = {.usage = "", .n_min = 0, .n_max = 0},
              .summary = "radius of gyration of a group",
              .details =
                  "The scalar `c_ID` is the root of sum(m (r - r_cm)^2) / M at the unwrapped places of the atoms "
                  "(distance); the vector `c_ID[1]` ... `c_ID[6]` the tensor of its parts, sum(m (r - r_cm)_a (r - "
                  "r_cm)_b) / M, in the order xx, yy, zz, xy, xz, yz (distance^2).",
              .example = "compute rg chain gyration"},
    .create = create,
    .destroy = destroy,
    .scalar = scalar,
    .vector = vector,
};
