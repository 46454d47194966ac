/* Values stored every few steps: one growing vector, or an array with a column for each value. */
#include "base/memory.h"
#include "style/value.h"

typedef struct vector_state {
    int64_t every, next; /**< next: step of the next row, -1 before the first run */
    hs_value *values;    /**< owned [n] */
    int n;
    double *row; /**< owned [n_rows][n] */
    int64_t capacity;
} vector_state;

/** The first sample at or after a step. */
static void renew(vector_state *state, int64_t step)
{
    state->next = (step + state->every - 1) / state->every * state->every;
}

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    vector_state *state = fix->state;
    HS_TRY(hs_arg_int(args, 0, 1, INT32_MAX, &state->every, err));
    HS_TRY(hs_values_create(&state->values, &state->n, fix->env, args, 1, args->n - 1, HS_VALUE_NUMBER, err));
    renew(state, fix->env->step);
    fix->has_vector = state->n == 1;
    fix->has_array = state->n > 1;
    fix->n_columns = fix->has_array ? state->n : 0;
    fix->is_vector_extensive = hs_value_is_extensive(fix->env, &state->values[0]);
    return HS_OK;
}

static void destroy(hs_fix *fix)
{
    vector_state *state = fix->state;
    hs_values_destroy(&state->values, state->n);
    HS_FREE(state->row);
}

static hs_status init(hs_fix *fix, hs_error *err)
{
    vector_state *state = fix->state;
    if (state->next < fix->env->step) renew(state, fix->env->step);
    return hs_values_check(fix->env, state->values, state->n, HS_VALUE_NUMBER, hs_fix_who(fix).text, err);
}

static bool needs_energy(const hs_fix *fix, int64_t step)
{
    const vector_state *state = fix->state;
    return step == state->next && hs_values_need_energy(fix->env, state->values, state->n);
}

static hs_status end_of_step(hs_fix *fix, hs_error *err)
{
    vector_state *state = fix->state;
    HS_TRY(hs_fix_need_sample(fix, state->next, err));
    if (fix->env->step != state->next) return HS_OK;
    const int64_t n_rows = fix->has_array ? fix->n_rows : fix->n_vector;
    if (n_rows == INT32_MAX)
        return hs_fail(err, HS_ERROR_RUN, "%s: more rows than %d cannot be counted", hs_fix_who(fix).text, INT32_MAX);
    if (n_rows == state->capacity) {
        const int64_t capacity = state->capacity < 512 ? 1024 : 2 * state->capacity;
        HS_TRY(HS_GROW(state->row, (size_t)(n_rows * state->n), (size_t)(capacity * state->n), err));
        state->capacity = capacity;
    }
    for (int k = 0; k < state->n; ++k)
        HS_TRY(hs_value_number(fix->env, &state->values[k], &state->row[n_rows * state->n + k], err));
    state->next += state->every;
    *(fix->has_array ? &fix->n_rows : &fix->n_vector) = (int)n_rows + 1;
    return HS_OK;
}

static hs_status vector(hs_fix *fix, int i, double *value, hs_error *err)
{
    const vector_state *state = fix->state;
    (void)err;
    *value = state->row[i];
    return HS_OK;
}

static hs_status array(hs_fix *fix, int i, int j, double *value, hs_error *err)
{
    const vector_state *state = fix->state;
    (void)err;
    *value = state->row[(int64_t)i * state->n + j];
    return HS_OK;
}

static hs_status keep_state(hs_fix *fix, hs_state *kept, hs_error *err)
{
    vector_state *state = fix->state;
    int *const n_rows = fix->has_array ? &fix->n_rows : &fix->n_vector;
    int64_t n_numbers = (int64_t)*n_rows * state->n;
    HS_TRY(hs_state_int64(kept, "next", &state->next, 1, err));
    HS_TRY(hs_state_doubles(kept, "rows", &state->row, &n_numbers, err));
    if (!kept->is_reading) return HS_OK;
    *n_rows = (int)(n_numbers / state->n);
    state->capacity = *n_rows;
    return HS_OK;
}

const hs_fix_style hs_fix_style_vector = {
    .about =
        {.name = "vector",
         .syntax = {.usage = "<Nevery> <value> ...", .n_min = 2, .n_max = -1},
         .summary = "store values every few steps",
         .details =
             "Values are numbers: `c_ID`, `c_ID[i]`, `f_ID`, `f_ID[i]`, `v_name`, ranges as in `c_ID[*]`. They are "
             "stored at steps that are multiples of Nevery, from the first step of the run on. With one value `f_ID` "
             "is a vector, which grows, with several an array whose columns they are. `slope(f_ID)`, `trap(f_ID)` and "
             "the like in formulas take such a vector, or a column `f_ID[j]`. The group has no meaning. 8 bytes are "
             "kept for each number.",
         .example = "compute msd all msd com yes\nfix 9 all vector 10 c_msd[4]\nvariable D equal "
                    "slope(f_9)/6/(10*dt)"},
    .state_size = sizeof(vector_state),
    .create = create,
    .destroy = destroy,
    .init = init,
    .measure_at_setup = end_of_step,
    .end_of_step = end_of_step,
    .vector = vector,
    .array = array,
    .needs_energy = needs_energy,
    .keep_state = keep_state,
    .is_time_dependent = true,
    .allows_dynamic_group = true,
    .keeps_plane = true,
};
