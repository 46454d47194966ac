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
     "with min or max: input 1 (by number) is given at the atom, or in the row, where input 2 has its extreme"},
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
    if (state->inputs[which - 1].shape != state->inputs[at - 1].shape)
        return hs_arg_refuse(args, i + 2, "an input of the same kind: values of atoms, or local ones", NULL, err);
    state->replaced_by[which - 1] = (int)at - 1;
    return HS_OK;
}

/** The region as it is now. */
static hs_status find_region(hs_compute *compute, hs_error *err)
{
    hs_where *where = &((hs_reduction *)compute->state)->where;
    return hs_where_find(where, compute->env, hs_compute_who(compute).text, err);
}

/** Rows of local values are in no region. */
static hs_status check_region(const hs_reduction *state, const char *command, hs_error *err)
{
    for (int k = 0; k < state->n && state->where.id != NULL; ++k)
        if (state->inputs[k].shape == HS_VALUE_LOCAL)
            return hs_fail(err, HS_ERROR_INPUT,
                           "%s: %s has local values, whose rows are in no region; compute reduce takes them all",
                           command, state->inputs[k].value.word);
    return HS_OK;
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
    HS_TRY(hs_atom_sources_read_any(&state->inputs, &state->n, compute->env, args, i, end - i, hs_atom_source_motion,
                                    err));
    HS_TRY(check_region(state, args->command, err));
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

/** Values of an input become state->present. */
static hs_status fetch(hs_compute *compute, int input, hs_error *err)
{
    hs_reduction *state = compute->state;
    const hs_atom_source *source = &state->inputs[input];
    hs_reduced *present = &state->present;
    if (source->shape == HS_VALUE_LOCAL)
        return hs_value_local(compute->env, &source->value, &present->rows, &present->value, err);
    HS_TRY(hs_where_update(&state->where, err));
    HS_TRY(HS_RESERVE(state->values, state->capacity, (size_t)compute->env->atoms->n_local, err));
    *present = (hs_reduced){.value = state->values};
    return hs_atom_source_values(compute->env, source, compute->mask, state->values, err);
}

/** Values of this rank. */
static int count_here(const hs_compute *compute)
{
    const hs_reduction *state = compute->state;
    return state->present.rows != NULL ? state->present.rows->n : compute->env->atoms->n_local;
}

/** Whether local atom i is one of those that are reduced; all rows are. */
static inline bool is_in(const hs_compute *compute, int i)
{
    const hs_reduction *state = compute->state;
    const hs_atoms *atoms = compute->env->atoms;
    if (state->present.rows != NULL) return true;
    if (!(atoms->mask[i] & compute->mask)) return false;
    return hs_where_has(&state->where, atoms, i);
}

/** By what value i, of an atom or a row, is known on all ranks: from 1. */
static inline int64_t number_of(const hs_compute *compute, int i)
{
    const hs_local_rows *rows = ((const hs_reduction *)compute->state)->present.rows;
    return rows != NULL ? rows->first + i + 1 : compute->env->atoms->id[i];
}

/** Values on all ranks. */
static int64_t count(const hs_compute *compute)
{
    const hs_reduction *state = compute->state;
    int64_t n = 0;
    if (state->present.rows != NULL) return state->present.rows->n_all;
    if (state->where.region == NULL) return hs_atom_count(compute->env->atoms, compute->env->parallel, compute->mask);
    for (int i = 0; i < compute->env->atoms->n_local; ++i) n += is_in(compute, i);
    hs_parallel_sum_int64(compute->env->parallel, &n, 1);
    return n;
}

static void add_terms(const hs_atoms *atoms, const void *context, int begin, int end, hs_exact_sum *sums)
{
    const hs_compute *compute = context;
    const hs_reduction *state = compute->state;
    const double *value = state->present.value;
    (void)atoms;
    const bool is_squared = state->mode == MODE_SUMSQ || state->mode == MODE_AVESQ;
    for (int i = begin; i < end; ++i)
        if (is_in(compute, i)) hs_exact_add(&sums[0], is_squared ? value[i] * value[i] : value[i]);
}

/** Extreme of the present values, and the least number of those that have it. Without values: LAMMPS's 1e20 for a minimum, -1e20 for a
 *  maximum, and 0. */
static void find_extreme(const hs_compute *compute, double *extreme, int64_t *number)
{
    const hs_reduction *state = compute->state;
    const double *value = state->present.value, sign = state->mode == MODE_MAX ? 1.0 : -1.0;
    const int n = count_here(compute);
    double best = -DBL_MAX;
    for (int i = 0; i < n; ++i)
        if (is_in(compute, i) && sign * value[i] > best) best = sign * value[i];
    hs_parallel_max_double(compute->env->parallel, &best, 1);
    int64_t highest = -INT64_MAX; /* of the numbers with the other sign */
    for (int i = 0; i < n; ++i)
        if (is_in(compute, i) && sign * value[i] == best && -number_of(compute, i) > highest)
            highest = -number_of(compute, i);
    hs_parallel_max_int64(compute->env->parallel, &highest, 1);
    *number = highest == -INT64_MAX ? 0 : -highest;
    *extreme = hs_plain_zero(sign * (*number == 0 ? -1e20 : best));
}

/** The present value of that number, from the rank that has it. */
static double value_at(const hs_compute *compute, int64_t number)
{
    const hs_reduction *state = compute->state;
    double value = 0.0;
    for (int i = 0; i < count_here(compute); ++i)
        if (number_of(compute, i) == number) value = state->present.value[i];
    hs_parallel_sum_double(compute->env->parallel, &value, 1);
    return hs_plain_zero(value);
}

/** The value of an input where another one has its extreme. */
static hs_status reduce_replaced(hs_compute *compute, int input, double *value, hs_error *err)
{
    const hs_reduction *state = compute->state;
    const hs_atom_source *replaced = &state->inputs[input], *by = &state->inputs[state->replaced_by[input]];
    int64_t number;
    if (by->shape == HS_VALUE_LOCAL)
        HS_TRY(hs_values_check_rows(compute->env, &replaced->value, &by->value, hs_compute_who(compute).text, err));
    HS_TRY(fetch(compute, state->replaced_by[input], err));
    find_extreme(compute, value, &number);
    if (number == 0) return HS_OK; /* nothing has it: as in LAMMPS the extreme of none */
    HS_TRY(fetch(compute, input, err));
    *value = value_at(compute, number);
    return HS_OK;
}

/** Sum over all present values. */
static double sum_values(const hs_compute *compute)
{
    const hs_env *env = compute->env;
    double sum;
    if (((const hs_reduction *)compute->state)->present.rows != NULL)
        hs_item_sum(count_here(compute), env->parallel, add_terms, compute, 1, &sum);
    else
        hs_atom_sum(env->atoms, env->parallel, add_terms, compute, 1, &sum);
    return sum;
}

static hs_status reduce_one(hs_compute *compute, int input, double *value, hs_error *err)
{
    const hs_reduction *state = compute->state;
    int64_t unused;
    if (state->replaced_by[input] >= 0) return reduce_replaced(compute, input, value, err);
    HS_TRY(fetch(compute, input, err));
    if (state->mode == MODE_MIN || state->mode == MODE_MAX) {
        find_extreme(compute, value, &unused);
        return HS_OK;
    }
    *value = sum_values(compute);
    if (state->mode == MODE_AVE || state->mode == MODE_AVESQ) {
        const int64_t n = count(compute);
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
