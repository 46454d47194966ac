#include "style/per_chunk.h"

#include "base/memory.h"
#include "core/atom_style.h"

static hs_status find(hs_compute *compute, hs_error *err)
{
    hs_per_chunk *state = compute->state;
    return hs_chunks_find(compute->env, state->chunk_id, hs_compute_who(compute).text, &state->chunk_atom, err);
}

/** Room for n rows. */
static hs_status set_rows(hs_compute *compute, int64_t n, hs_error *err)
{
    hs_per_chunk *state = compute->state;
    const size_t n_columns = compute->has_array ? (size_t)compute->n_columns : 1;
    if ((size_t)n > state->capacity || state->sum == NULL) {
        const size_t capacity = (size_t)n + 1;
        HS_TRY(HS_GROW(state->sum, 0, capacity, err));
        if (compute->has_array) HS_TRY(HS_GROW(compute->array, 0, capacity * n_columns, err));
        if (!compute->has_array) HS_TRY(HS_GROW(compute->vector, 0, capacity, err));
        state->capacity = capacity;
    }
    state->n = n;
    if (compute->has_array) compute->n_rows = (int)n;
    if (!compute->has_array) compute->n_vector = (int)n;
    return HS_OK;
}

hs_status hs_per_chunk_create(hs_compute *compute, const hs_args *args, int n_columns, bool is_array, hs_error *err)
{
    hs_per_chunk *state = compute->state;
    HS_TRY(hs_memory_strdup(&state->chunk_id, args->word[0], err));
    HS_TRY(hs_chunks_find(compute->env, state->chunk_id, args->command, &state->chunk_atom, err));
    compute->has_array = is_array || n_columns > 1;
    compute->has_vector = !compute->has_array;
    compute->n_columns = compute->has_array ? n_columns : 0;
    compute->has_variable_length = true;
    compute->chunk_id = state->chunk_id;
    return set_rows(compute, hs_chunks_of(state->chunk_atom)->n, err);
}

void hs_per_chunk_destroy(hs_compute *compute)
{
    hs_per_chunk *state = compute->state;
    HS_FREE(state->chunk_id);
    HS_FREE(state->value);
    HS_FREE(state->sum);
    HS_FREE(state->center);
    HS_FREE(compute->vector);
    HS_FREE(compute->array);
}

hs_status hs_per_chunk_init(hs_compute *compute, hs_error *err) { return find(compute, err); }

hs_status hs_per_chunk_begin(hs_compute *compute, hs_error *err)
{
    hs_per_chunk *state = compute->state;
    const size_t n_local = (size_t)compute->env->atoms->n_local;
    HS_TRY(find(compute, err));
    HS_TRY(hs_compute_eval_atoms(state->chunk_atom, err));
    hs_status status = HS_RESERVE(state->value, state->capacity_atoms, n_local, err);
    if (status == HS_OK) status = set_rows(compute, hs_chunks_of(state->chunk_atom)->n, err);
    if (hs_parallel_agree(compute->env->parallel, err) != HS_OK) return status != HS_OK ? status : err->status;
    return HS_OK;
}

hs_status hs_per_chunk_add_up(hs_compute *compute, hs_per_chunk_value value, const void *context, double *out,
                              int stride, hs_error *err)
{
    hs_per_chunk *state = compute->state;
#pragma omp parallel for schedule(static)
    for (int i = 0; i < compute->env->atoms->n_local; ++i) {
        const int64_t c = hs_per_chunk_of(compute, i);
        state->value[i] = c >= 0 ? value(compute, i, c, context) : 0.0;
    }
    HS_TRY(hs_chunks_sum(state->chunk_atom, compute->mask, state->value, state->sum, err));
    for (int64_t c = 0; c < state->n; ++c) out[c * stride] = state->sum[c];
    return HS_OK;
}

hs_status hs_per_chunk_sum(hs_compute *compute, int k, hs_per_chunk_value value, const void *context, hs_error *err)
{
    return hs_per_chunk_add_up(compute, value, context, hs_per_chunk_at(compute, 0, k),
                               compute->has_array ? compute->n_columns : 1, err);
}

/** Mass of an atom, times its place along the axis when that is less than 3. */
static double mass_moment(const hs_compute *compute, int i, int64_t c, const void *context)
{
    const int axis = *(const int *)context;
    (void)c;
    return hs_atom_mass(compute->env->atoms, i) * (axis < 3 ? hs_unwrapped(compute->env, axis, i) : 1.0);
}

hs_status hs_per_chunk_find_centers(hs_compute *compute, hs_error *err)
{
    hs_per_chunk *state = compute->state;
    const size_t n = (size_t)state->n;
    HS_TRY(HS_RESERVE(state->center, state->capacity_center, 4 * n, err));
    for (int k = 0; k < 4; ++k) HS_TRY(hs_per_chunk_add_up(compute, mass_moment, &k, state->center + k, 4, err));
    for (size_t c = 0; c < n; ++c) {
        double *center = state->center + 4 * c;
        for (int axis = 0; axis < 3; ++axis) center[axis] = center[3] > 0.0 ? center[axis] / center[3] : 0.0;
    }
    return HS_OK;
}

hs_status hs_per_chunk_sum_moments(hs_compute *compute, hs_per_chunk_value value, hs_error *err)
{
    HS_TRY(hs_per_chunk_begin(compute, err));
    HS_TRY(hs_per_chunk_find_centers(compute, err));
    for (int k = 0; k < compute->n_columns; ++k) HS_TRY(hs_per_chunk_sum(compute, k, value, &k, err));
    return HS_OK;
}

static double mass(const hs_compute *compute, int i, int64_t c, const void *context)
{
    (void)c, (void)context;
    return hs_atom_mass(compute->env->atoms, i);
}

/** A value times the mass. */
typedef struct weighted {
    hs_per_chunk_value value;
    int axis;
} weighted;

static double moment(const hs_compute *compute, int i, int64_t c, const void *context)
{
    const weighted *w = context;
    return hs_atom_mass(compute->env->atoms, i) * w->value(compute, i, c, &w->axis);
}

hs_status hs_per_chunk_mean(hs_compute *compute, hs_per_chunk_value value, hs_error *err)
{
    const hs_per_chunk *state = compute->state;
    for (int axis = 0; axis < 3; ++axis)
        HS_TRY(hs_per_chunk_sum(compute, axis, moment, &(weighted){.value = value, .axis = axis}, err));
    double *moments; /* column 0, while its place holds the masses */
    HS_TRY(HS_ALLOC(moments, (size_t)state->n + 1, err));
    for (int64_t c = 0; c < state->n; ++c) moments[c] = *hs_per_chunk_at(compute, c, 0);
    const hs_status status = hs_per_chunk_sum(compute, 0, mass, NULL, err);
    for (int64_t c = 0; c < state->n && status == HS_OK; ++c) {
        const double total = *hs_per_chunk_at(compute, c, 0);
        *hs_per_chunk_at(compute, c, 0) = moments[c];
        for (int axis = 0; axis < 3; ++axis) {
            double *mean = hs_per_chunk_at(compute, c, axis);
            *mean = total > 0.0 ? *mean / total : 0.0;
        }
    }
    HS_FREE(moments);
    return status;
}
