/* Radius of gyration of each chunk. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "core/atom_style.h"
#include "style/moments.h"
#include "style/per_chunk.h"

static const hs_keyword keywords[] = {
    {"tensor", 0, "", "the tensor, not the radius"},
    {NULL, 0, NULL, NULL},
};

typedef struct gyration_state {
    hs_per_chunk base; /**< first */
    bool is_tensor;
    double *center; /**< owned [n][4]: center of mass and mass of each chunk, during an evaluation */
    size_t capacity;
} gyration_state;

static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    gyration_state *state = compute->state;
    state->is_tensor = args->n > 1;
    return hs_per_chunk_create(compute, args, state->is_tensor ? 6 : 1, state->is_tensor, err);
}

static void destroy(hs_compute *compute)
{
    HS_FREE(((gyration_state *)compute->state)->center);
    hs_per_chunk_destroy(compute);
}

/** Mass of an atom, times its place along the axis when that is less than 3. */
static double moment(const hs_compute *compute, int i, int64_t c, const void *context)
{
    const int axis = *(const int *)context;
    (void)c;
    return hs_atom_mass(compute->env->atoms, i) * (axis < 3 ? hs_unwrapped(compute->env, axis, i) : 1.0);
}

/** m d_a d_b, or m d^2 without axes, d being relative to the chunk's center of mass. */
static double square(const hs_compute *compute, int i, int64_t c, const void *context)
{
    const gyration_state *state = compute->state;
    const double *center = state->center + 4 * c;
    const int *axes = context;
    double d[3];
    for (int axis = 0; axis < 3; ++axis) d[axis] = hs_unwrapped(compute->env, axis, i) - center[axis];
    return hs_atom_mass(compute->env->atoms, i) *
           (axes != NULL ? d[axes[0]] * d[axes[1]] : d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
}

static hs_status find_centers(hs_compute *compute, hs_error *err)
{
    gyration_state *state = compute->state;
    const size_t n = (size_t)state->base.n;
    if (4 * n > state->capacity || state->center == NULL) {
        state->capacity = 4 * n + 4;
        HS_TRY(HS_GROW(state->center, 0, state->capacity, err));
    }
    for (int k = 3; k >= 0; --k) {
        HS_TRY(hs_per_chunk_sum(compute, 0, moment, &k, err));
        for (size_t c = 0; c < n; ++c) {
            const double sum = *hs_per_chunk_at(compute, (int64_t)c, 0), mass = state->center[4 * c + 3];
            state->center[4 * c + (size_t)k] = k == 3 ? sum : mass > 0.0 ? sum / mass : 0.0;
        }
    }
    return HS_OK;
}

static hs_status evaluate(hs_compute *compute, hs_error *err)
{
    static const int axes[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};
    const gyration_state *state = compute->state;
    HS_TRY(hs_per_chunk_begin(compute, err));
    HS_TRY(find_centers(compute, err));
    for (int k = 0; k < (state->is_tensor ? 6 : 1); ++k) {
        HS_TRY(hs_per_chunk_sum(compute, k, square, state->is_tensor ? axes[k] : NULL, err));
        for (int64_t c = 0; c < state->base.n; ++c) {
            const double mass = state->center[4 * c + 3];
            double *value = hs_per_chunk_at(compute, c, k);
            *value = mass > 0.0 ? *value / mass : 0.0;
            if (!state->is_tensor) *value = sqrt(*value);
        }
    }
    return HS_OK;
}

const hs_compute_style hs_compute_style_gyration_chunk = {
    .about = {.name = "gyration/chunk",
              .syntax = {.usage = "<chunk-ID> [tensor]", .n_min = 1, .n_max = 1, .keywords = keywords},
              .summary = "radius of gyration of each chunk",
              .details =
                  "The vector `c_ID` has for each chunk of the compute chunk/atom the root of sum(m (r - r_cm)^2) / M "
                  "over those of its atoms that are in the group, at their unwrapped places (distance). With `tensor` "
                  "the array `c_ID[*]` has the six means of products, xx, yy, zz, xy, xz, yz (distance^2).",
              .example = "compute c all cluster/atom 1.5\ncompute drops all chunk/atom c_c compress yes\n"
                         "compute rg all gyration/chunk drops"},
    .state_size = sizeof(gyration_state),
    .create = create,
    .destroy = destroy,
    .init = hs_per_chunk_init,
    .vector = evaluate,
    .array = evaluate,
};
