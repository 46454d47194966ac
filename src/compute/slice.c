/* Some elements of vectors. */
#include "base/memory.h"
#include "style/compute.h"
#include "style/value.h"

typedef struct slice_state {
    int64_t first, skip; /**< elements, from 1 */
    int n_elements;
    hs_value *values; /**< owned [n]: vectors */
    int n;
    double *vector; /**< owned [capacity] */
    size_t capacity;
} slice_state;

static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    slice_state *state = compute->state;
    int64_t stop;
    HS_TRY(hs_arg_int(args, 0, 1, INT32_MAX, &state->first, err));
    HS_TRY(hs_arg_int(args, 1, state->first + 1, INT32_MAX, &stop, err));
    HS_TRY(hs_arg_int(args, 2, 1, stop - state->first, &state->skip, err));
    HS_TRY(hs_values_create(&state->values, &state->n, compute->env, args, 3, args->n - 3, HS_VALUE_VECTOR, err));
    const int n_elements = state->n_elements = (int)((stop - state->first) / state->skip);
    compute->may_need_energy = hs_values_need_energy(compute->env, state->values, state->n);
    compute->has_vector = state->n == 1;
    compute->has_array = state->n > 1;
    if (compute->has_vector) {
        hs_value element = state->values[0];
        element.index[element.n_indices++] = 1;
        compute->is_vector_extensive = hs_value_is_extensive(compute->env, &element);
        compute->n_vector = n_elements;
        return HS_ALLOC(compute->vector, (size_t)n_elements, err);
    }
    compute->n_rows = n_elements;
    compute->n_columns = state->n;
    return HS_ALLOC(compute->array, (size_t)n_elements * (size_t)state->n, err);
}

static void destroy(hs_compute *compute)
{
    slice_state *state = compute->state;
    hs_values_destroy(&state->values, state->n);
    HS_FREE(state->vector);
    HS_FREE(compute->vector);
    HS_FREE(compute->array);
}

static hs_status init(hs_compute *compute, hs_error *err)
{
    const slice_state *state = compute->state;
    return hs_values_check(compute->env, state->values, state->n, HS_VALUE_VECTOR, hs_compute_who(compute).text, err);
}

/** Elements of vectors whose length varies are 0 beyond their end; others must be there. */
static hs_status evaluate(hs_compute *compute, hs_error *err)
{
    slice_state *state = compute->state;
    const int n_rows = state->n_elements;
    double *out = compute->has_vector ? compute->vector : compute->array;
    const int64_t last = state->first + (n_rows - 1) * state->skip;
    for (int k = 0; k < state->n; ++k) {
        const hs_value *value = &state->values[k];
        HS_TRY(hs_value_refresh(compute->env, value, err));
        const int length = hs_value_length(compute->env, value);
        if (last > length && !hs_value_is_variable(compute->env, value))
            return hs_fail(err, HS_ERROR_INPUT, "%s: elements up to %lld are asked for, and %s has %d",
                           hs_compute_who(compute).text, (long long)last, value->word, length);
        HS_TRY(HS_RESERVE(state->vector, state->capacity, (size_t)length, err));
        HS_TRY(hs_value_vector(compute->env, value, state->vector, err));
        for (int row = 0; row < n_rows; ++row) {
            const int64_t at = state->first - 1 + row * state->skip;
            out[(size_t)row * (size_t)state->n + (size_t)k] = at < length ? state->vector[at] : 0.0;
        }
    }
    return HS_OK;
}

const hs_compute_style hs_compute_style_slice = {
    .about = {.name = "slice",
              .syntax = {.usage = "<first> <stop> <skip> <vector> ...", .n_min = 4, .n_max = -1},
              .summary = "some elements of vectors",
              .details =
                  "(stop - first)/skip elements, the numbers first, first + skip and so on, of a vector `c_ID` or "
                  "`f_ID`, of a column `c_ID[j]` or `f_ID[j]` of an array (`c_ID[*]`: all of them), or of a "
                  "vector-style variable `v_name`. One vector makes the vector `c_ID`, several the columns of the "
                  "array `c_ID`. Elements beyond the end are errors, but 0 where the length varies (fix vector, "
                  "chunks). The group has no meaning.",
              .example = "fix m all vector 10 c_msd[4]\ncompute some all slice 1 101 20 f_m"},
    .state_size = sizeof(slice_state),
    .create = create,
    .destroy = destroy,
    .init = init,
    .vector = evaluate,
    .array = evaluate,
};
