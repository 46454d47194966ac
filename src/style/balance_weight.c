#include "style/balance_weight.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"

void hs_balance_weight_fini(hs_balance_weight *weight)
{
    for (int k = 0; k < weight->n_parts; ++k) HS_FREE(weight->part[k].name);
    HS_FREE(weight->part);
    weight->n_parts = 0;
}

static hs_status add(hs_balance_weight *weight, const char *name, bool is_group, double factor, hs_error *err)
{
    HS_TRY(HS_GROW(weight->part, (size_t)weight->n_parts, (size_t)weight->n_parts + 1, err));
    hs_weight_part *part = &weight->part[weight->n_parts++];
    *part = (hs_weight_part){.is_group = is_group, .factor = factor};
    return name != NULL ? hs_memory_strdup(&part->name, name, err) : HS_OK;
}

hs_status hs_balance_weight_read(hs_balance_weight *weight, const hs_args *args, int *i, hs_error *err)
{
    static const char *const kinds[] = {"group", "var", "time", NULL};
    int kind;
    int64_t n;
    double factor = 1.0;
    HS_TRY(hs_arg_need(args, *i, "the kind of weight: group, var or time", err));
    if (strcmp(args->word[*i], "neigh") == 0 || strcmp(args->word[*i], "store") == 0)
        return hs_fail(
            err, HS_ERROR_INPUT,
            "%s: the weight '%s' is not supported; 'time' measures what neighbors cost, 'group' and 'var' say "
            "it",
            args->command, args->word[*i]);
    HS_TRY(hs_arg_choice(args, *i, kinds, &kind, err));
    HS_TRY(hs_arg_need(args, ++*i, kind == 0 ? "the number of groups" : kind == 1 ? "a variable" : "a factor", err));
    if (kind == 1) return add(weight, args->word[*i], false, 1.0, err);
    if (kind == 2) {
        HS_TRY(hs_arg_positive(args, *i, &factor, err));
        return add(weight, NULL, false, factor, err);
    }
    HS_TRY(hs_arg_int(args, *i, 1, HS_GROUPS_MAX, &n, err));
    for (; n > 0; --n, *i += 2) {
        HS_TRY(hs_arg_need(args, *i + 2, "a group and its factor", err));
        HS_TRY(hs_arg_positive(args, *i + 2, &factor, err));
        HS_TRY(add(weight, args->word[*i + 1], true, factor, err));
    }
    return HS_OK;
}

/** What an atom of this rank has taken, relative to the rank where it was least, stretched by the factor. */
static double cost_by_time(const hs_env *env, double spent_s, double factor)
{
    const int n = env->atoms->n_local;
    const bool is_measured = n > 0 && spent_s > 0.0;
    const double mine = is_measured ? spent_s / n : 0.0;
    double extremes[2] = {mine, is_measured ? -mine : -INFINITY}; /* the largest, minus the smallest */
    hs_parallel_max_double(env->parallel, extremes, 2);
    const double least = -extremes[1], ratio = extremes[0] / least;
    if (!is_measured || !(ratio > 1.0) || isinf(least)) return 1.0;
    return 1.0 + (mine / least - 1.0) * (fmax(ratio * factor, 1.0) - 1.0) / (ratio - 1.0);
}

static hs_status multiply(const hs_weight_part *part, const hs_env *env, const char *command, double *costs,
                          double *values, hs_error *err)
{
    const hs_atoms *atoms = env->atoms;
    int bit;
    if (part->is_group) {
        HS_TRY(hs_groups_get(env->groups, part->name, &bit, err));
        for (int i = 0; i < atoms->n_local; ++i)
            if (atoms->mask[i] & hs_group_mask(bit)) costs[i] *= part->factor;
        return HS_OK;
    }
    if (env->variable_kind == NULL || env->variable_kind(env->deck, part->name) != 2)
        return hs_fail(err, HS_ERROR_INPUT, "%s: there is no atom-style variable '%s'", command, part->name);
    HS_TRY(env->variable_atoms(env->deck, part->name, values, err));
    for (int i = 0; i < atoms->n_local; ++i) {
        if (!(values[i] > 0.0) || isinf(values[i]))
            return hs_fail(err, HS_ERROR_INPUT, "%s: the weight of atom %lld is %g; it must be above 0", command,
                           (long long)atoms->id[i], values[i]);
        costs[i] *= values[i];
    }
    return HS_OK;
}

hs_status hs_balance_weight_eval(const hs_balance_weight *weight, const hs_env *env, double spent_s,
                                 const char *command, double **costs, hs_error *err)
{
    const int n = env->atoms->n_local;
    double *values = NULL;
    *costs = NULL;
    if (weight->n_parts == 0) return HS_OK;
    hs_status status = HS_ALLOC(*costs, (size_t)n + 1, err);
    if (status == HS_OK) status = HS_ALLOC(values, (size_t)n + 1, err);
    if (hs_parallel_agree(env->parallel, err) != HS_OK) status = err->status;
    for (int i = 0; i < n && status == HS_OK; ++i) (*costs)[i] = 1.0;
    for (int k = 0; k < weight->n_parts && status == HS_OK; ++k) {
        const hs_weight_part *part = &weight->part[k];
        const double cost = part->name == NULL ? cost_by_time(env, spent_s, part->factor) : 1.0;
        if (part->name != NULL) status = multiply(part, env, command, *costs, values, err);
        if (hs_parallel_agree(env->parallel, err) != HS_OK) status = err->status;
        for (int i = 0; i < n && status == HS_OK && cost != 1.0; ++i) (*costs)[i] *= cost;
    }
    HS_FREE(values);
    if (status != HS_OK) HS_FREE(*costs);
    return status;
}

double hs_balance_weight_load(const hs_env *env, const double *costs)
{
    double load = 0.0;
    if (costs == NULL) return env->atoms->n_local;
    for (int i = 0; i < env->atoms->n_local; ++i) load += costs[i];
    return load;
}
