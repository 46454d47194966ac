#include "style/reduction.h"

#include <float.h>
#include <string.h>

#include "base/memory.h"
#include "style/atom_sum.h"
#include "style/region.h"

typedef enum { MODE_SUM, MODE_MIN, MODE_MAX, MODE_AVE, MODE_SUMSQ, MODE_AVESQ } reduce_mode;
static const char *const modes[] = {"sum", "min", "max", "ave", "sumsq", "avesq", NULL};

const hs_keyword hs_reduction_keywords[] = {
    {"replace", 2, "<input 1> <input 2>",
     "with min or max: input 1 (by number) is given at the atom where input 2 has its extreme"},
    {NULL, 0, NULL, NULL},
};

static hs_status add_replacement(hs_reduction *state, const hs_args *args, int i, hs_error *err)
{
    int64_t which, at;
    if (state->mode != MODE_MIN && state->mode != MODE_MAX)
        return hs_fail(err, HS_ERROR_INPUT, "%s: replace needs the mode min or max, where one atom has the extreme",
                       args->command);
    HS_TRY(hs_arg_int(args, i + 1, 1, state->n, &which, err));
    HS_TRY(hs_arg_int(args, i + 2, 1, state->n, &at, err));
    if (which == at || state->replaced_by[at - 1] >= 0)
        return hs_arg_refuse(args, i + 2, "another input, one that is not replaced itself", NULL, err);
    state->replaced_by[which - 1] = (int)at - 1;
    return HS_OK;
}

/** The region as it is now. */
static hs_status find_region(hs_compute *compute, hs_error *err)
{
    hs_where *where = &((hs_reduction *)compute->state)->where;
    return hs_where_find(where, compute->env, "compute", compute->id, compute->style->about.name, err);
}

hs_status hs_reduction_create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    hs_reduction *state = compute->state;
    int i = 0;
    if (strcmp(compute->style->about.name, "reduce/region") == 0)
        HS_TRY(hs_where_set(&state->where, args->word[i++], err));
    HS_TRY(hs_arg_choice(args, i++, modes, &state->mode, err));
    if (i == args->n) return hs_arg_need(args, i, "an input", err);
    HS_TRY(find_region(compute, err));
    int end = i;
    while (end < args->n && strcmp(args->word[end], "replace") != 0) ++end;
    HS_TRY(hs_atom_sources_read(&state->inputs, &state->n, compute->env, args, i, end - i, hs_atom_source_motion, err));
    HS_TRY(HS_ALLOC(state->replaced_by, (size_t)state->n, err));
    for (int k = 0; k < state->n; ++k) state->replaced_by[k] = -1;
    for (i = end; i < args->n; i += 3) HS_TRY(add_replacement(state, args, i, err));
    compute->n_vector = state->n > 1 ? state->n : 0;
    compute->has_vector = state->n > 1;
    compute->has_scalar = !compute->has_vector;
    compute->may_need_energy = hs_atom_sources_need_energy(compute->env, state->inputs, state->n);
    compute->is_extensive = compute->is_vector_extensive = state->mode == MODE_SUM || state->mode == MODE_SUMSQ;
    return HS_ALLOC(compute->vector, (size_t)state->n, err);
}

void hs_reduction_destroy(hs_compute *compute)
{
    hs_reduction *state = compute->state;
    hs_atom_sources_destroy(&state->inputs, state->n);
    HS_FREE(state->replaced_by);
    hs_where_fini(&state->where);
    HS_FREE(state->values);
    HS_FREE(compute->vector);
}

hs_status hs_reduction_init(hs_compute *compute, hs_error *err)
{
    const hs_reduction *state = compute->state;
    HS_TRY(hs_atom_sources_check(compute->env, state->inputs, state->n, hs_compute_who(compute).text, err));
    return find_region(compute, err);
}

/** Values of an input for the local atoms into state->values. */
static hs_status fetch(hs_compute *compute, int input, hs_error *err)
{
    hs_reduction *state = compute->state;
    HS_TRY(hs_where_update(&state->where, err));
    HS_TRY(HS_RESERVE(state->values, state->capacity, (size_t)compute->env->atoms->n_local, err));
    return hs_atom_source_values(compute->env, &state->inputs[input], compute->mask, state->values, err);
}

/** Whether local atom i is one of those that are reduced. */
static inline bool is_in(const hs_compute *compute, int i)
{
    const hs_reduction *state = compute->state;
    const hs_atoms *atoms = compute->env->atoms;
    if (!(atoms->mask[i] & compute->mask)) return false;
    return hs_where_has(&state->where, atoms, i);
}

static int64_t count_atoms(const hs_compute *compute)
{
    const hs_reduction *state = compute->state;
    int64_t n = 0;
    if (state->where.region == NULL) return hs_atom_count(compute->env->atoms, compute->env->parallel, compute->mask);
    for (int i = 0; i < compute->env->atoms->n_local; ++i) n += is_in(compute, i);
    hs_parallel_sum_int64(compute->env->parallel, &n, 1);
    return n;
}

static void add_terms(const hs_atoms *atoms, const void *context, int begin, int end, hs_exact_sum *sums)
{
    const hs_compute *compute = context;
    const hs_reduction *state = compute->state;
    (void)atoms;
    const bool is_squared = state->mode == MODE_SUMSQ || state->mode == MODE_AVESQ;
    for (int i = begin; i < end; ++i)
        if (is_in(compute, i))
            hs_exact_add(&sums[0], is_squared ? state->values[i] * state->values[i] : state->values[i]);
}

/** Extreme of state->values over all atoms of the group, and the least id of an atom that has it. Without atoms: LAMMPS's 1e20 for a
 *  minimum, -1e20 for a maximum, and 0. */
static void find_extreme(const hs_compute *compute, double *extreme, int64_t *id)
{
    const hs_reduction *state = compute->state;
    const hs_atoms *atoms = compute->env->atoms;
    const double sign = state->mode == MODE_MAX ? 1.0 : -1.0;
    double best = -DBL_MAX;
    for (int i = 0; i < atoms->n_local; ++i)
        if (is_in(compute, i) && sign * state->values[i] > best) best = sign * state->values[i];
    hs_parallel_max_double(compute->env->parallel, &best, 1);
    int64_t minus_id = -INT64_MAX;
    for (int i = 0; i < atoms->n_local; ++i)
        if (is_in(compute, i) && sign * state->values[i] == best && -atoms->id[i] > minus_id) minus_id = -atoms->id[i];
    hs_parallel_max_int64(compute->env->parallel, &minus_id, 1);
    *id = minus_id == -INT64_MAX ? 0 : -minus_id;
    *extreme = sign * (*id == 0 ? -1e20 : best);
}

static hs_status reduce_one(hs_compute *compute, int input, double *value, hs_error *err)
{
    const hs_reduction *state = compute->state;
    const hs_env *env = compute->env;
    int64_t id;
    if (state->replaced_by[input] >= 0) {
        HS_TRY(fetch(compute, state->replaced_by[input], err));
        find_extreme(compute, value, &id);
        if (id == 0) return HS_OK; /* no atom has it: as in LAMMPS the extreme of none */
        HS_TRY(fetch(compute, input, err));
        *value = 0.0;
        for (int i = 0; i < env->atoms->n_local; ++i)
            if (env->atoms->id[i] == id) *value = state->values[i];
        hs_parallel_sum_double(env->parallel, value, 1);
        return HS_OK;
    }
    HS_TRY(fetch(compute, input, err));
    if (state->mode == MODE_MIN || state->mode == MODE_MAX) {
        find_extreme(compute, value, &id);
        return HS_OK;
    }
    hs_atom_sum(env->atoms, env->parallel, add_terms, compute, 1, value);
    if (state->mode == MODE_AVE || state->mode == MODE_AVESQ) {
        const int64_t n = count_atoms(compute);
        *value = n > 0 ? *value / (double)n : 0.0;
    }
    return HS_OK;
}

hs_status hs_reduction_scalar(hs_compute *compute, double *value, hs_error *err)
{
    HS_TRY(find_region(compute, err));
    return reduce_one(compute, 0, value, err);
}

hs_status hs_reduction_vector(hs_compute *compute, hs_error *err)
{
    const hs_reduction *state = compute->state;
    HS_TRY(find_region(compute, err));
    for (int k = 0; k < state->n; ++k) HS_TRY(reduce_one(compute, k, &compute->vector[k], err));
    return HS_OK;
}
