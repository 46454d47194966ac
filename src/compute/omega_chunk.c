/* Angular velocity of each chunk about its center of mass: I omega = L. */
#include "base/memory.h"
#include "core/atom_style.h"
#include "core/rotation.h"
#include "style/per_chunk.h"

enum { N_TERMS = 9 }; /* Lx Ly Lz Ixx Iyy Izz Ixy Iyz Ixz */

typedef struct omega_state {
    hs_per_chunk base; /**< first */
    double *sum;       /**< owned [n][N_TERMS] */
    size_t capacity;
} omega_state;

static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    return hs_per_chunk_create(compute, args, 3, true, err);
}

static void destroy(hs_compute *compute)
{
    HS_FREE(((omega_state *)compute->state)->sum);
    hs_per_chunk_destroy(compute);
}

static double term(const hs_compute *compute, int i, int64_t c, const void *context)
{
    const hs_atoms *atoms = compute->env->atoms;
    const int k = *(const int *)context, a = k % 3, b = (k + 1) % 3, far = (k + 2) % 3;
    const double mass = hs_atom_mass(atoms, i);
    double d[3];
    hs_per_chunk_arm(compute, i, c, d);
    if (k < 3) return mass * (d[b] * atoms->v[far][i] - d[far] * atoms->v[b][i]);
    if (k < 6) return mass * (d[b] * d[b] + d[far] * d[far]);
    return -mass * d[a] * d[b];
}

static void solve(const double *sum, double *omega)
{
    const double *moment = sum + 3;
    const double inertia[3][3] = {
        {moment[0], moment[3], moment[5]}, {moment[3], moment[1], moment[4]}, {moment[5], moment[4], moment[2]}};
    hs_rotation_velocity(inertia, sum, omega);
}

static hs_status array(hs_compute *compute, hs_error *err)
{
    omega_state *state = compute->state;
    HS_TRY(hs_per_chunk_begin(compute, err));
    HS_TRY(hs_per_chunk_find_centers(compute, err));
    HS_TRY(HS_RESERVE(state->sum, state->capacity, N_TERMS * (size_t)state->base.n, err));
    for (int k = 0; k < N_TERMS; ++k) HS_TRY(hs_per_chunk_add_up(compute, term, &k, state->sum + k, N_TERMS, err));
    for (int64_t c = 0; c < state->base.n; ++c) solve(state->sum + N_TERMS * c, hs_per_chunk_at(compute, c, 0));
    return HS_OK;
}

const hs_compute_style hs_compute_style_omega_chunk = {
    .about = {.name = "omega/chunk",
              .syntax = {.usage = "<chunk-ID>", .n_min = 1, .n_max = 1},
              .summary = "angular velocity of each chunk",
              .details = "The array `c_ID` has a row for each chunk of the compute chunk/atom: the angular velocity "
                         "along x, y and z (1/time) with which those of its atoms that are in the group would turn as "
                         "a rigid body of their angular momentum, about the chunk's center of mass and from unwrapped "
                         "places. Atoms on one line have none along it; a chunk without atoms has 0.",
              .example = "compute c all cluster/atom 1.5\ncompute drops all chunk/atom c_c compress yes\n"
                         "compute spin all omega/chunk drops"},
    .state_size = sizeof(omega_state),
    .create = create,
    .destroy = destroy,
    .init = hs_per_chunk_init,
    .array = array,
};
