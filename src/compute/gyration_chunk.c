/* Radius of gyration of each chunk. */
#include <math.h>

#include "core/atom_style.h"
#include "style/per_chunk.h"

static const hs_keyword keywords[] = {
    {"tensor", 0, "", "the tensor, not the radius"},
    {NULL, 0, NULL, NULL},
};

typedef struct gyration_state {
    hs_per_chunk base; /**< first */
    bool is_tensor;
} gyration_state;

static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    gyration_state *state = compute->state;
    state->is_tensor = args->n > 1;
    return hs_per_chunk_create(compute, args, state->is_tensor ? 6 : 1, state->is_tensor, err);
}

/** m d_a d_b, or m d^2 without axes, d being relative to the chunk's center of mass. */
static double square(const hs_compute *compute, int i, int64_t c, const void *context)
{
    const int *axes = context;
    double d[3];
    hs_per_chunk_arm(compute, i, c, d);
    return hs_atom_mass(compute->env->atoms, i) *
           (axes != NULL ? d[axes[0]] * d[axes[1]] : d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
}

static hs_status evaluate(hs_compute *compute, hs_error *err)
{
    static const int axes[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};
    const gyration_state *state = compute->state;
    HS_TRY(hs_per_chunk_begin(compute, err));
    HS_TRY(hs_per_chunk_find_centers(compute, err));
    for (int k = 0; k < (state->is_tensor ? 6 : 1); ++k) {
        HS_TRY(hs_per_chunk_sum(compute, k, square, state->is_tensor ? axes[k] : NULL, err));
        for (int64_t c = 0; c < state->base.n; ++c) {
            const double mass = state->base.center[4 * c + 3];
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
    .destroy = hs_per_chunk_destroy,
    .init = hs_per_chunk_init,
    .vector = evaluate,
    .array = evaluate,
};
