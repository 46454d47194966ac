/* Squared displacement of the center of mass of each chunk since the compute was defined. */
#include <string.h>

#include "base/memory.h"
#include "style/per_chunk.h"

typedef struct msd_chunk_state {
    hs_per_chunk base; /**< first */
    double *origin;    /**< owned [3 n_origins]: centers of mass at the start, unwrapped */
    int64_t n_origins;
} msd_chunk_state;

static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    msd_chunk_state *state = compute->state;
    HS_TRY(hs_per_chunk_create(compute, args, 4, true, err));
    HS_TRY(hs_per_chunk_begin(compute, err));
    HS_TRY(hs_per_chunk_find_centers(compute, err));
    state->n_origins = state->base.n;
    HS_TRY(HS_ALLOC(state->origin, 3 * (size_t)state->n_origins + 1, err));
    for (int64_t c = 0; c < state->n_origins; ++c)
        memcpy(state->origin + 3 * c, state->base.center + 4 * c, 3 * sizeof(double));
    return HS_OK;
}

static void destroy(hs_compute *compute)
{
    HS_FREE(((msd_chunk_state *)compute->state)->origin);
    hs_per_chunk_destroy(compute);
}

static hs_status keep_state(hs_compute *compute, hs_state *kept, hs_error *err)
{
    msd_chunk_state *state = compute->state;
    int64_t n = 3 * state->n_origins;
    HS_TRY(hs_state_doubles(kept, "origin", &state->origin, &n, err));
    state->n_origins = n / 3;
    return HS_OK;
}

static hs_status array(hs_compute *compute, hs_error *err)
{
    const msd_chunk_state *state = compute->state;
    HS_TRY(hs_per_chunk_begin(compute, err));
    if (state->base.n != state->n_origins)
        return hs_fail(err, HS_ERROR_RUN,
                       "%s: chunks must stay the same, but their number was %lld when it was defined and is %lld now; "
                       "'nchunk once' and 'ids once' of compute chunk/atom keep them",
                       hs_compute_who(compute).text, (long long)state->n_origins, (long long)state->base.n);
    HS_TRY(hs_per_chunk_find_centers(compute, err));
    for (int64_t c = 0; c < state->base.n; ++c) {
        double *row = hs_per_chunk_at(compute, c, 0);
        row[3] = 0.0;
        for (int axis = 0; axis < 3; ++axis) {
            const double d = state->base.center[4 * c + axis] - state->origin[3 * c + axis];
            row[axis] = d * d;
            row[3] += row[axis];
        }
    }
    return HS_OK;
}

const hs_compute_style hs_compute_style_msd_chunk = {
    .about =
        {.name = "msd/chunk",
         .syntax = {.usage = "<chunk-ID>", .n_min = 1, .n_max = 1},
         .summary = "squared displacement of each chunk",
         .details =
             "The array `c_ID` has a row for each chunk of the compute chunk/atom: dx^2, dy^2, dz^2 and their sum "
             "(distance^2), with d the displacement of the center of mass of those of its atoms that are in the group "
             "from where it was when this compute was defined, crossings of periodic faces included. Chunks must stay "
             "the same: as many and, to mean anything, of the same atoms. Starting places are part of checkpoints.",
         .example = "compute drops all chunk/atom type\ncompute msd all msd/chunk drops\n"
                    "fix m all ave/time 100 1 100 c_msd[*] mode vector file msd.txt"},
    .state_size = sizeof(msd_chunk_state),
    .create = create,
    .destroy = destroy,
    .init = hs_per_chunk_init,
    .keep_state = keep_state,
    .array = array,
    .needs_fixed_group = true,
};
