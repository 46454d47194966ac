/* Total dipole moment of a group. */
#include <math.h>

#include "compute/dipole_words.h"
#include "style/atom_sum.h"

static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    HS_TRY(dipole_words(compute, args, 0, err));
    compute->n_vector = 3;
    return HS_ALLOC(compute->vector, 3, err);
}

static void destroy(hs_compute *compute) { HS_FREE(compute->vector); }

static void add_terms(const hs_atoms *atoms, const void *context, int begin, int end, hs_exact_sum *sums)
{
    const hs_compute *compute = context;
    for (int i = begin; i < end; ++i)
        for (int axis = 0; axis < 3 && atoms->mask[i] & compute->mask; ++axis)
            hs_exact_add(&sums[axis], atoms->mu[axis][i]);
}

static hs_status vector(hs_compute *compute, hs_error *err)
{
    (void)err;
    hs_atom_sum(compute->env->atoms, compute->env->parallel, add_terms, compute, 3, compute->vector);
    return HS_OK;
}

static hs_status scalar(hs_compute *compute, double *value, hs_error *err)
{
    HS_TRY(hs_compute_eval_vector(compute, err));
    const double *mu = compute->vector;
    *value = sqrt(mu[0] * mu[0] + mu[1] * mu[1] + mu[2] * mu[2]);
    return HS_OK;
}

const hs_compute_style hs_compute_style_dipole = {
    .about =
        {.name = "dipole",
         .syntax = {.usage = "[mass|geometry]", .n_min = 0, .n_max = 1},
         .summary = "total dipole moment of a group",
         .details =
             "The vector `c_ID[1]` ... `c_ID[3]` is the sum of the dipole moments of the group's atoms, the scalar "
             "`c_ID` its length. For active particles, whose dipoles are their directions, it is the polarisation "
             "times the number of particles. The place it refers to, `mass` or `geometry`, matters in LAMMPS for "
             "charges only, of which there are none. It needs `atom_style dipole`.",
         .example = "compute p all dipole\nvariable order equal c_p/count(all)"},
    .create = create,
    .destroy = destroy,
    .scalar = scalar,
    .vector = vector,
};
