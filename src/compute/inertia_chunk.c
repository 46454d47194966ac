/* Moments of inertia of each chunk about its center of mass. */
#include "core/atom_style.h"
#include "style/per_chunk.h"

/** Terms of the diagonal, m (d^2 - d_a d_a), and beside it, -m d_a d_b. */
static double component(const hs_compute *compute, int i, int64_t c, const void *context)
{
    static const int axes[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}};
    const int *ab = axes[*(const int *)context];
    double d[3];
    hs_per_chunk_arm(compute, i, c, d);
    const double d2 = ab[0] == ab[1] ? d[0] * d[0] + d[1] * d[1] + d[2] * d[2] : 0.0;
    return hs_atom_mass(compute->env->atoms, i) * (d2 - d[ab[0]] * d[ab[1]]);
}

static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    return hs_per_chunk_create(compute, args, 6, true, err);
}

static hs_status array(hs_compute *compute, hs_error *err) { return hs_per_chunk_sum_moments(compute, component, err); }

const hs_compute_style hs_compute_style_inertia_chunk = {
    .about = {.name = "inertia/chunk",
              .syntax = {.usage = "<chunk-ID>", .n_min = 1, .n_max = 1},
              .summary = "moments of inertia of each chunk",
              .details = "The array `c_ID` has a row for each chunk of the compute chunk/atom: the six moments of "
                         "inertia xx, yy, zz, xy, yz, xz (mass distance^2) of those of its atoms that are in the "
                         "group, from their unwrapped places relative to the chunk's center of mass; 0 without any.",
              .example = "compute c all cluster/atom 1.5\ncompute drops all chunk/atom c_c compress yes\n"
                         "compute moments all inertia/chunk drops"},
    .state_size = sizeof(hs_per_chunk),
    .create = create,
    .destroy = hs_per_chunk_destroy,
    .init = hs_per_chunk_init,
    .array = array,
};
