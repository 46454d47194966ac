/* One number for each chunk from the values of its atoms. */
#include <float.h>

#include "base/memory.h"
#include "core/exact_sum.h"
#include "style/per_chunk.h"
#include "style/value.h"

typedef enum { MODE_SUM, MODE_MIN, MODE_MAX } reduce_mode;
static const char *const modes[] = {"sum", "min", "max", NULL};

typedef struct reduce_state {
    hs_per_chunk base; /**< first */
    int mode;
    hs_value *values; /**< owned [n] */
    int n;
    double *input; /**< owned [n_local]: values of the atoms, during an evaluation */
    size_t capacity;
} reduce_state;

static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    reduce_state *state = compute->state;
    HS_TRY(hs_arg_choice(args, 1, modes, &state->mode, err));
    HS_TRY(hs_values_create(&state->values, &state->n, compute->env, args, 2, args->n - 2, HS_VALUE_ATOMS, err));
    compute->may_need_energy = hs_values_need_energy(compute->env, state->values, state->n);
    return hs_per_chunk_create(compute, args, state->n, state->n > 1, err);
}

static void destroy(hs_compute *compute)
{
    reduce_state *state = compute->state;
    hs_values_destroy(&state->values, state->n);
    HS_FREE(state->input);
    hs_per_chunk_destroy(compute);
}

static hs_status init(hs_compute *compute, hs_error *err)
{
    const reduce_state *state = compute->state;
    HS_TRY(hs_values_check(compute->env, state->values, state->n, HS_VALUE_ATOMS, "compute reduce/chunk", err));
    return hs_per_chunk_init(compute, err);
}

static double input_of(const hs_compute *compute, int i, int64_t c, const void *context)
{
    (void)c, (void)context;
    return ((const reduce_state *)compute->state)->input[i];
}

/** Column k = the extremes over the atoms of each chunk; 0 where there are none. */
static void find_extremes(hs_compute *compute, int k)
{
    reduce_state *state = compute->state;
    const double sign = state->mode == MODE_MAX ? 1.0 : -1.0;
    double *extreme = state->base.sum;
    for (int64_t c = 0; c < state->base.n; ++c) extreme[c] = -DBL_MAX;
    for (int i = 0; i < compute->env->atoms->n_local; ++i) {
        const int64_t c = hs_per_chunk_of(compute, i);
        if (c >= 0 && sign * state->input[i] > extreme[c]) extreme[c] = sign * state->input[i];
    }
    hs_parallel_max_double(compute->env->parallel, extreme, (int)state->base.n);
    for (int64_t c = 0; c < state->base.n; ++c)
        *hs_per_chunk_at(compute, c, k) = extreme[c] == -DBL_MAX ? 0.0 : hs_plain_zero(sign * extreme[c]);
}

static hs_status evaluate(hs_compute *compute, hs_error *err)
{
    reduce_state *state = compute->state;
    const size_t n_local = (size_t)compute->env->atoms->n_local;
    HS_TRY(hs_per_chunk_begin(compute, err));
    HS_TRY(HS_RESERVE(state->input, state->capacity, n_local, err));
    for (int k = 0; k < state->n; ++k) {
        HS_TRY(hs_value_atoms(compute->env, &state->values[k], state->input, err));
        if (state->mode == MODE_SUM)
            HS_TRY(hs_per_chunk_sum(compute, k, input_of, NULL, err));
        else
            find_extremes(compute, k);
    }
    return HS_OK;
}

const hs_compute_style hs_compute_style_reduce_chunk = {
    .about = {.name = "reduce/chunk",
              .syntax = {.usage = "<chunk-ID> <sum | min | max> <value> ...", .n_min = 3, .n_max = -1},
              .summary = "sum or extreme of values over the atoms of each chunk",
              .details =
                  "A value is one per atom of a compute or fix (`c_ID`, `c_ID[i]`, `f_ID`, `f_ID[i]`, ranges as in "
                  "`c_ID[*]`) or an atom-style variable (`v_name`); it is reduced over those atoms of each chunk of "
                  "the compute chunk/atom that are in the group. One value makes the vector `c_ID`, several the "
                  "columns of the array `c_ID[*]`; rows are chunks. Without atoms in a chunk the result is 0.",
              .example = "compute k all ke/atom\ncompute layers all chunk/atom bin/1d z lower 0.5\n"
                         "compute hot all reduce/chunk layers max c_k"},
    .state_size = sizeof(reduce_state),
    .create = create,
    .destroy = destroy,
    .init = init,
    .vector = evaluate,
    .array = evaluate,
};
