/** Computes that give each atom the elements of vectors which a number of the atom points to. */
#ifndef HS_COMPUTE_SPREAD_H
#define HS_COMPUTE_SPREAD_H

#include <string.h>

#include "base/memory.h"
#include "style/compute.h"
#include "style/value.h"

typedef struct spread_state {
    hs_value index;   /**< a number for each atom, from 1; others point to nothing */
    hs_value *values; /**< owned [n]: vectors */
    int n;
    double *at;     /**< owned [capacity_at]: index, of the local atoms */
    double *vector; /**< owned [capacity] */
    size_t capacity_at, capacity;
} spread_state;

/** Values from word 1 on; @p index names the number of atoms. */
static inline hs_status spread_create(hs_compute *compute, const hs_args *args, const char *index, hs_error *err)
{
    spread_state *state = compute->state;
    const hs_args one = {.command = args->command, .n = 1, .word = &index};
    HS_TRY(hs_value_init(&state->index, compute->env, &one, 0, HS_VALUE_ATOMS, err));
    HS_TRY(hs_values_create(&state->values, &state->n, compute->env, args, 1, args->n - 1, HS_VALUE_VECTOR, err));
    compute->n_atom_columns = state->n > 1 ? state->n : 0;
    compute->may_need_energy = hs_value_needs_energy(compute->env, &state->index) ||
                               hs_values_need_energy(compute->env, state->values, state->n);
    return HS_OK;
}

static inline void spread_destroy(hs_compute *compute)
{
    spread_state *state = compute->state;
    hs_value_fini(&state->index);
    hs_values_destroy(&state->values, state->n);
    HS_FREE(state->at);
    HS_FREE(state->vector);
}

static inline hs_status spread_init(hs_compute *compute, hs_error *err)
{
    const spread_state *state = compute->state;
    const hs_who who = hs_compute_who(compute);
    HS_TRY(hs_value_check(compute->env, &state->index, HS_VALUE_ATOMS, who.text, err));
    return hs_values_check(compute->env, state->values, state->n, HS_VALUE_VECTOR, who.text, err);
}

static inline hs_status spread_per_atom(hs_compute *compute, hs_error *err)
{
    spread_state *state = compute->state;
    const hs_atoms *atoms = compute->env->atoms;
    const size_t n_local = (size_t)atoms->n_local;
    HS_TRY(HS_RESERVE(state->at, state->capacity_at, n_local, err));
    HS_TRY(hs_value_atoms(compute->env, &state->index, state->at, err));
    for (int k = 0; k < state->n; ++k) {
        const hs_value *value = &state->values[k];
        double *out = compute->atoms + (size_t)k * n_local;
        HS_TRY(hs_value_refresh(compute->env, value, err));
        const int length = hs_value_length(compute->env, value);
        HS_TRY(HS_RESERVE(state->vector, state->capacity, (size_t)length, err));
        HS_TRY(hs_value_vector(compute->env, value, state->vector, err));
#pragma omp parallel for schedule(static)
        for (int i = 0; i < atoms->n_local; ++i) {
            const double at = state->at[i];
            const bool points = atoms->mask[i] & compute->mask && at >= 1.0 && at < (double)length + 1.0;
            out[i] = points ? state->vector[(int)at - 1] : 0.0;
        }
    }
    return HS_OK;
}

#define SPREAD_HOOKS                                                                                                   \
    .state_size = sizeof(spread_state), .create = create, .destroy = spread_destroy, .init = spread_init,              \
    .per_atom = spread_per_atom

#endif
