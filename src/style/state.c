#include "style/state.h"

#include <string.h>

#include "base/memory.h"

void hs_state_fini(hs_state *state)
{
    for (int k = 0; k < state->n_values; ++k) {
        HS_FREE(state->value[k].name);
        HS_FREE(state->value[k].data);
    }
    HS_FREE(state->value);
    state->n_values = 0;
}

hs_status hs_state_add(hs_state *state, const char *name, int kind, const void *data, int64_t n, hs_error *err)
{
    const size_t size = kind == HS_STATE_TEXT ? 1 : sizeof(int64_t);
    hs_state_value value = {.kind = kind, .n = n};
    HS_TRY(HS_GROW(state->value, (size_t)state->n_values, (size_t)state->n_values + 1, err));
    hs_status status = hs_memory_strdup(&value.name, name, err);
    if (status == HS_OK) status = hs_memory_alloc(&value.data, (size_t)n + 1, size, err);
    if (status != HS_OK) {
        HS_FREE(value.name);
        return status;
    }
    if (n > 0) memcpy(value.data, data, (size_t)n * size);
    state->value[state->n_values++] = value;
    return HS_OK;
}

const hs_state_value *hs_state_find(const hs_state *state, const char *name)
{
    for (int k = 0; k < state->n_values; ++k)
        if (strcmp(state->value[k].name, name) == 0) return &state->value[k];
    return NULL;
}

static hs_status find(const hs_state *state, const char *name, int kind, const hs_state_value **value, hs_error *err)
{
    static const char *const kinds[] = {"floating point", "integer", "text"};
    *value = hs_state_find(state, name);
    if (*value == NULL) return hs_fail(err, HS_ERROR_INPUT, "the value '%s' is missing", name);
    if ((int)(*value)->kind != kind)
        return hs_fail(err, HS_ERROR_INPUT, "the value '%s' should be %s", name, kinds[kind]);
    return HS_OK;
}

static hs_status move(hs_state *state, const char *name, int kind, void *data, int64_t n, hs_error *err)
{
    const hs_state_value *value;
    if (!state->is_reading) return hs_state_add(state, name, kind, data, n, err);
    HS_TRY(find(state, name, kind, &value, err));
    if (value->n != n)
        return hs_fail(err, HS_ERROR_INPUT, "the value '%s' has %lld elements; there should be %lld", name,
                       (long long)value->n, (long long)n);
    if (n > 0) memcpy(data, value->data, (size_t)n * sizeof(int64_t));
    return HS_OK;
}

static hs_status move_array(hs_state *state, const char *name, int kind, void **data, int64_t *n, hs_error *err)
{
    const hs_state_value *value;
    void *copy;
    if (!state->is_reading) return hs_state_add(state, name, kind, *data, *n, err);
    HS_TRY(find(state, name, kind, &value, err));
    HS_TRY(hs_memory_alloc(&copy, (size_t)value->n, sizeof(int64_t), err));
    if (value->n > 0) memcpy(copy, value->data, (size_t)value->n * sizeof(int64_t));
    hs_memory_free(*data);
    *data = copy;
    *n = value->n;
    return HS_OK;
}

hs_status hs_state_double(hs_state *state, const char *name, double *values, int64_t n, hs_error *err)
{
    return move(state, name, HS_STATE_REAL, values, n, err);
}

hs_status hs_state_int64(hs_state *state, const char *name, int64_t *values, int64_t n, hs_error *err)
{
    return move(state, name, HS_STATE_INTEGER, values, n, err);
}

hs_status hs_state_int(hs_state *state, const char *name, int *value, hs_error *err)
{
    int64_t wide = *value;
    HS_TRY(move(state, name, HS_STATE_INTEGER, &wide, 1, err));
    if (wide < INT32_MIN || wide > INT32_MAX)
        return hs_fail(err, HS_ERROR_INPUT, "the value '%s' is out of range", name);
    *value = (int)wide;
    return HS_OK;
}

hs_status hs_state_bool(hs_state *state, const char *name, bool *value, hs_error *err)
{
    int64_t wide = *value;
    HS_TRY(move(state, name, HS_STATE_INTEGER, &wide, 1, err));
    *value = wide != 0;
    return HS_OK;
}

hs_status hs_state_doubles(hs_state *state, const char *name, double **values, int64_t *n, hs_error *err)
{
    return move_array(state, name, HS_STATE_REAL, (void **)values, n, err);
}

hs_status hs_state_int64s(hs_state *state, const char *name, int64_t **values, int64_t *n, hs_error *err)
{
    return move_array(state, name, HS_STATE_INTEGER, (void **)values, n, err);
}

hs_status hs_state_text(hs_state *state, const char *name, char **text, hs_error *err)
{
    const hs_state_value *value = hs_state_find(state, name);
    if (!state->is_reading) {
        if (*text == NULL) return HS_OK;
        return hs_state_add(state, name, HS_STATE_TEXT, *text, (int64_t)strlen(*text), err);
    }
    HS_FREE(*text);
    if (value == NULL) return HS_OK;
    HS_TRY(find(state, name, HS_STATE_TEXT, &value, err));
    return hs_memory_strdup(text, value->data, err);
}
