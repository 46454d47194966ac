/* Momentum of a group: sum(m v). */
#include "base/memory.h"
#include "core/atom_style.h"
#include "style/atom_sum.h"
#include "style/compute.h"

static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    HS_TRY(hs_syntax_check(&compute->style->about.syntax, args, false, err));
    compute->n_vector = 3;
    return HS_ALLOC(compute->vector, 3, err);
}

static void destroy(hs_compute *compute) { HS_FREE(compute->vector); }

static void add_terms(const hs_atoms *atoms, const void *context, int begin, int end, hs_exact_sum *sums)
{
    const hs_compute *compute = context;
    for (int i = begin; i < end; ++i) {
        if (!(atoms->mask[i] & compute->mask)) continue;
        const double mass = hs_atom_mass(atoms, i);
        for (int axis = 0; axis < 3; ++axis) hs_exact_add(&sums[axis], mass * atoms->v[axis][i]);
    }
}

static hs_status vector(hs_compute *compute, hs_error *err)
{
    (void)err;
    hs_atom_sum(compute->env->atoms, compute->env->parallel, add_terms, compute, 3, compute->vector);
    return HS_OK;
}

const hs_compute_style hs_compute_style_momentum = {
    .about = {.name = "momentum",
              .syntax = {.usage = "", .n_min = 0, .n_max = 0},
              .summary = "momentum of a group",
              .details = "The vector `c_ID[1]` ... `c_ID[3]` is the sum of m v over the group's atoms (mass times "
                         "velocity units). It grows with the number of atoms: under `thermo_modify norm yes`, the "
                         "default in lj units, thermo output divides it by the number of atoms.",
              .example = "compute drift liquid momentum"},
    .create = create,
    .destroy = destroy,
    .vector = vector,
    .is_vector_extensive = true,
};
