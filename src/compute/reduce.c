/* One number from the values of all atoms: sum, mean, extreme. */
#include <float.h>
#include <string.h>

#include "base/memory.h"
#include "style/atom_sum.h"
#include "style/attribute.h"
#include "style/value.h"

typedef enum { MODE_SUM, MODE_MIN, MODE_MAX, MODE_AVE, MODE_SUMSQ, MODE_AVESQ } reduce_mode;
static const char *const modes[] = {"sum", "min", "max", "ave", "sumsq", "avesq", NULL};

/** What is reduced: an attribute of atoms, or a value per atom. */
typedef struct input {
    int attribute; /**< -1: a reference */
    hs_value value;
    int replaced_by; /**< -1, or the input at whose extreme atom this one is taken */
} input;

typedef struct reduce_state {
    int mode;
    input *inputs; /**< owned [n] */
    int n;
    double *values; /**< owned [n_local] scratch */
    int capacity;
} reduce_state;

static const char *const allowed[] = {"x", "y", "z", "vx", "vy", "vz", "fx", "fy", "fz", NULL};

static const hs_keyword keywords[] = {
    {"replace", 2, "<input 1> <input 2>",
     "with min or max: input 1 (by number) is given at the atom where input 2 has its extreme"},
    {NULL, 0, NULL, NULL},
};

static hs_status add_input(hs_compute *compute, const hs_args *args, int i, hs_error *err)
{
    reduce_state *state = compute->state;
    int attribute = -1, n = 1;
    hs_value *values = NULL;
    if (hs_value_is_reference(args->word[i])) {
        HS_TRY(hs_values_create(&values, &n, compute->env, args, i, 1, HS_VALUE_ATOMS, err));
    } else {
        int which;
        HS_TRY(hs_arg_choice(args, i, allowed, &which, err));
        attribute = hs_attribute_find(args->word[i]);
    }
    hs_status status = HS_GROW(state->inputs, (size_t)state->n, (size_t)(state->n + n), err);
    if (status != HS_OK) {
        hs_values_destroy(&values, n);
        return status;
    }
    for (int k = 0; k < n; ++k) {
        input *new = &state->inputs[state->n++];
        *new = (input){.attribute = attribute, .replaced_by = -1};
        if (values != NULL) new->value = values[k];
    }
    HS_FREE(values);
    return HS_OK;
}

static hs_status add_replacement(reduce_state *state, const hs_args *args, int i, hs_error *err)
{
    int64_t which, at;
    if (state->mode != MODE_MIN && state->mode != MODE_MAX)
        return hs_fail(err, HS_ERROR_INPUT, "%s: replace needs the mode min or max, where one atom has the extreme",
                       args->command);
    HS_TRY(hs_arg_int(args, i + 1, 1, state->n, &which, err));
    HS_TRY(hs_arg_int(args, i + 2, 1, state->n, &at, err));
    if (which == at || state->inputs[at - 1].replaced_by >= 0)
        return hs_arg_refuse(args, i + 2, "another input, one that is not replaced itself", NULL, err);
    state->inputs[which - 1].replaced_by = (int)at - 1;
    return HS_OK;
}

static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    reduce_state *state = compute->state;
    HS_TRY(hs_arg_choice(args, 0, modes, &state->mode, err));
    int i = 1;
    for (; i < args->n && strcmp(args->word[i], "replace") != 0; ++i) HS_TRY(add_input(compute, args, i, err));
    for (; i < args->n; i += 3) HS_TRY(add_replacement(state, args, i, err));
    compute->n_vector = state->n > 1 ? state->n : 0;
    compute->has_vector = state->n > 1;
    compute->has_scalar = !compute->has_vector;
    for (int k = 0; k < state->n; ++k)
        compute->may_need_energy |=
            state->inputs[k].attribute < 0 && hs_value_needs_energy(compute->env, &state->inputs[k].value);
    compute->is_extensive = compute->is_vector_extensive = state->mode == MODE_SUM || state->mode == MODE_SUMSQ;
    return HS_ALLOC(compute->vector, (size_t)state->n, err);
}

static void destroy(hs_compute *compute)
{
    reduce_state *state = compute->state;
    for (int k = 0; k < state->n; ++k) hs_value_fini(&state->inputs[k].value);
    HS_FREE(state->inputs);
    HS_FREE(state->values);
    HS_FREE(compute->vector);
}

static hs_status init(hs_compute *compute, hs_error *err)
{
    const reduce_state *state = compute->state;
    char command[128];
    snprintf(command, sizeof command, "compute '%.80s' (reduce)", compute->id);
    for (int k = 0; k < state->n; ++k)
        if (state->inputs[k].attribute < 0)
            HS_TRY(hs_value_check(compute->env, &state->inputs[k].value, HS_VALUE_ATOMS, command, err));
    return HS_OK;
}

/** Values of an input for the local atoms into state->values. */
static hs_status fetch(hs_compute *compute, const input *from, hs_error *err)
{
    reduce_state *state = compute->state;
    const hs_atoms *atoms = compute->env->atoms;
    if (state->capacity < atoms->n_local || state->values == NULL) {
        HS_TRY(HS_GROW(state->values, 0, (size_t)atoms->n_local, err));
        state->capacity = atoms->n_local;
    }
    if (from->attribute < 0) return hs_value_atoms(compute->env, &from->value, state->values, err);
    for (int i = 0; i < atoms->n_local; ++i)
        state->values[i] = hs_attribute_value(compute->env, (hs_attribute)from->attribute, false, i);
    return HS_OK;
}

static void add_terms(const hs_atoms *atoms, const void *context, int begin, int end, hs_exact_sum *sums)
{
    const hs_compute *compute = context;
    const reduce_state *state = compute->state;
    const bool is_squared = state->mode == MODE_SUMSQ || state->mode == MODE_AVESQ;
    for (int i = begin; i < end; ++i)
        if (atoms->mask[i] & compute->mask)
            hs_exact_add(&sums[0], is_squared ? state->values[i] * state->values[i] : state->values[i]);
}

/** Extreme of state->values over all atoms of the group, and the least id of an atom that has it (0: no atoms). */
static void find_extreme(const hs_compute *compute, double *extreme, int64_t *id)
{
    const reduce_state *state = compute->state;
    const hs_atoms *atoms = compute->env->atoms;
    const double sign = state->mode == MODE_MAX ? 1.0 : -1.0;
    double best = -DBL_MAX;
    for (int i = 0; i < atoms->n_local; ++i)
        if (atoms->mask[i] & compute->mask && sign * state->values[i] > best) best = sign * state->values[i];
    hs_parallel_max_double(compute->env->parallel, &best, 1);
    int64_t minus_id = -INT64_MAX;
    for (int i = 0; i < atoms->n_local; ++i)
        if (atoms->mask[i] & compute->mask && sign * state->values[i] == best && -atoms->id[i] > minus_id)
            minus_id = -atoms->id[i];
    hs_parallel_max_int64(compute->env->parallel, &minus_id, 1);
    *id = minus_id == -INT64_MAX ? 0 : -minus_id;
    *extreme = *id == 0 ? 0.0 : sign * best;
}

static hs_status reduce_one(hs_compute *compute, const input *from, double *value, hs_error *err)
{
    const reduce_state *state = compute->state;
    const hs_env *env = compute->env;
    int64_t id;
    if (from->replaced_by >= 0) {
        HS_TRY(fetch(compute, &state->inputs[from->replaced_by], err));
        find_extreme(compute, value, &id);
        HS_TRY(fetch(compute, from, err));
        *value = 0.0;
        for (int i = 0; i < env->atoms->n_local; ++i)
            if (env->atoms->id[i] == id) *value = state->values[i];
        hs_parallel_sum_double(env->parallel, value, 1);
        return HS_OK;
    }
    HS_TRY(fetch(compute, from, err));
    if (state->mode == MODE_MIN || state->mode == MODE_MAX) {
        find_extreme(compute, value, &id);
        return HS_OK;
    }
    hs_atom_sum(env->atoms, env->parallel, add_terms, compute, 1, value);
    if (state->mode == MODE_AVE || state->mode == MODE_AVESQ) {
        const int64_t n = hs_atom_count(env->atoms, env->parallel, compute->mask);
        *value = n > 0 ? *value / (double)n : 0.0;
    }
    return HS_OK;
}

static hs_status scalar(hs_compute *compute, double *value, hs_error *err)
{
    const reduce_state *state = compute->state;
    return reduce_one(compute, &state->inputs[0], value, err);
}

static hs_status vector(hs_compute *compute, hs_error *err)
{
    const reduce_state *state = compute->state;
    for (int k = 0; k < state->n; ++k) HS_TRY(reduce_one(compute, &state->inputs[k], &compute->vector[k], err));
    return HS_OK;
}

const hs_compute_style hs_compute_style_reduce = {
    .about =
        {.name = "reduce",
         .syntax = {.usage = "<sum | min | max | ave | sumsq | avesq> <input> ... [replace <i> <j>]",
                    .n_min = 2,
                    .n_max = -1,
                    .keywords = keywords},
         .summary = "sum, mean or extreme of values over the atoms of a group",
         .details =
             "An input is an attribute (`x y z vx vy vz fx fy fz`), a value per atom of a compute or fix (`c_ID`, "
             "`c_ID[i]`, `f_ID`, `f_ID[i]`, ranges as in `c_ID[*]`) or an atom-style variable (`v_name`). `sum` and "
             "`sumsq` (of squares) grow with the number of atoms: under `thermo_modify norm yes` thermo output "
             "divides them by it; `ave` and `avesq` divide by the atoms of the group themselves. With one input the "
             "result is the scalar `c_ID`, with several the vector `c_ID[1]`, ... . Without atoms in the group the "
             "result is 0.",
         .example = "compute fmax all reduce max fx fy fz\ncompute q all reduce max c_k x replace 2 1"},
    .state_size = sizeof(reduce_state),
    .create = create,
    .destroy = destroy,
    .init = init,
    .scalar = scalar,
    .vector = vector,
};
