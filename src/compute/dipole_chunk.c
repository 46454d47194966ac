/* Dipole moment of each chunk. */
#include <math.h>

#include "compute/dipole_words.h"
#include "style/per_chunk.h"

static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    HS_TRY(dipole_words(compute, args, 1, err));
    return hs_per_chunk_create(compute, args, 4, true, err);
}

static double moment(const hs_compute *compute, int i, int64_t c, const void *axis)
{
    (void)c;
    return compute->env->atoms->mu[*(const int *)axis][i];
}

static hs_status array(hs_compute *compute, hs_error *err)
{
    HS_TRY(hs_per_chunk_begin(compute, err));
    for (int axis = 0; axis < 3; ++axis) HS_TRY(hs_per_chunk_sum(compute, axis, moment, &axis, err));
    for (int64_t c = 0; c < ((const hs_per_chunk *)compute->state)->n; ++c) {
        double *mu = hs_per_chunk_at(compute, c, 0);
        mu[3] = sqrt(mu[0] * mu[0] + mu[1] * mu[1] + mu[2] * mu[2]);
    }
    return HS_OK;
}

const hs_compute_style hs_compute_style_dipole_chunk = {
    .about =
        {.name = "dipole/chunk",
         .syntax = {.usage = "<chunk-ID> [mass|geometry]", .n_min = 1, .n_max = 2},
         .summary = "dipole moment of each chunk",
         .details =
             "The array `c_ID` has a row for each chunk of the compute chunk/atom: the three components of the sum "
             "of the dipole moments of those of its atoms that are in the group, and its length. For active "
             "particles it says how far clusters or layers point into one direction. The place it refers to, "
             "`mass` or `geometry`, matters in LAMMPS for charges only, of which there are none. It needs "
             "`atom_style dipole`.",
         .example =
             "compute near all cluster/atom 1.2\ncompute flocks all chunk/atom c_near compress yes\n"
             "compute p all dipole/chunk flocks\nfix 1 all ave/time 100 1 100 c_p[*] mode vector file flocks.txt"},
    .state_size = sizeof(hs_per_chunk),
    .create = create,
    .destroy = hs_per_chunk_destroy,
    .init = hs_per_chunk_init,
    .array = array,
};
