#include "style/balance_weight.h"

#include <math.h>

#include "base/memory.h"
#include "style/custom_atom.h"

void hs_balance_weight_fini(hs_balance_weight *weight)
{
    for (int k = 0; k < weight->n_parts; ++k) HS_FREE(weight->part[k].name);
    HS_FREE(weight->part);
    weight->n_parts = 0;
}

static hs_status add(hs_balance_weight *weight, hs_weight_kind kind, const char *name, double factor, hs_error *err)
{
    HS_TRY(HS_GROW(weight->part, (size_t)weight->n_parts, (size_t)weight->n_parts + 1, err));
    hs_weight_part *part = &weight->part[weight->n_parts++];
    *part = (hs_weight_part){.kind = kind, .factor = factor};
    return name != NULL ? hs_memory_strdup(&part->name, name, err) : HS_OK;
}

hs_status hs_balance_weight_read(hs_balance_weight *weight, const hs_args *args, int *i, hs_error *err)
{
    static const char *const kinds[] = {"group", "var", "time", "neigh", "store", NULL};
    static const char *const needed[] = {"the number of groups", "a variable", "a factor", "a factor",
                                         "the name of a value of atoms"};
    int kind;
    int64_t n;
    double factor = 1.0;
    HS_TRY(hs_arg_need(args, *i, "the kind of weight: group, var, time, neigh or store", err));
    HS_TRY(hs_arg_choice(args, *i, kinds, &kind, err));
    HS_TRY(hs_arg_need(args, ++*i, needed[kind], err));
    if (kind == HS_WEIGHT_VARIABLE || kind == HS_WEIGHT_STORE)
        return add(weight, (hs_weight_kind)kind, args->word[*i], 1.0, err);
    if (kind != HS_WEIGHT_GROUP) {
        HS_TRY(hs_arg_positive(args, *i, &factor, err));
        return add(weight, (hs_weight_kind)kind, NULL, factor, err);
    }
    HS_TRY(hs_arg_int(args, *i, 1, HS_GROUPS_MAX, &n, err));
    for (; n > 0; --n, *i += 2) {
        HS_TRY(hs_arg_need(args, *i + 2, "a group and its factor", err));
        HS_TRY(hs_arg_positive(args, *i + 2, &factor, err));
        HS_TRY(add(weight, HS_WEIGHT_GROUP, args->word[*i + 1], factor, err));
    }
    return HS_OK;
}

/** What an atom of this rank has its share in (time, pairs), relative to the rank where that is least, stretched by the
 *  factor. */
static double cost_by_share(const hs_env *env, double spent, double factor)
{
    const int n = env->atoms->n_local;
    const bool is_measured = n > 0 && spent > 0.0;
    const double mine = is_measured ? spent / n : 0.0;
    double extremes[2] = {mine, is_measured ? -mine : -INFINITY}; /* the largest, minus the smallest */
    hs_parallel_max_double(env->parallel, extremes, 2);
    const double least = -extremes[1], ratio = extremes[0] / least;
    if (!is_measured || !(ratio > 1.0) || isinf(least)) return 1.0;
    return 1.0 + (mine / least - 1.0) * (fmax(ratio * factor, 1.0) - 1.0) / (ratio - 1.0);
}

static double cost_by_neighbors(hs_balance_weight *weight, const hs_env *env, double factor, const char *command)
{
    int64_t n_pairs = *env->n_listed_pairs;
    hs_parallel_sum_int64(env->parallel, &n_pairs, 1);
    if (n_pairs > 0) return cost_by_share(env, (double)*env->n_listed_pairs, factor);
    if (!weight->has_warned)
        hs_warn(env->out,
                "%s: there are no neighbor lists yet, or the neighbor method keeps none: the weight neigh is 1",
                command);
    weight->has_warned = true;
    return 1.0;
}

static hs_status check_part(const hs_weight_part *part, const hs_env *env, const char *command, hs_error *err)
{
    int bit;
    if (part->kind == HS_WEIGHT_GROUP) return hs_groups_get(env->groups, part->name, &bit, err);
    if (part->kind == HS_WEIGHT_VARIABLE && hs_env_variable_kind(env, part->name) != HS_ATOM_VARIABLE)
        return hs_fail(err, HS_ERROR_INPUT, "%s: there is no atom-style variable '%s'", command, part->name);
    if (part->kind == HS_WEIGHT_STORE && hs_custom_atom_find(env->atoms, 'd', part->name) == NULL)
        return hs_fail(err, HS_ERROR_INPUT,
                       "%s: 'weight store %s' needs a value of atoms: 'fix <ID> all property/atom d_%s' adds it",
                       command, part->name, part->name);
    return HS_OK;
}

hs_status hs_balance_weight_check(const hs_balance_weight *weight, const hs_env *env, const char *command,
                                  hs_error *err)
{
    for (int k = 0; k < weight->n_parts; ++k) HS_TRY(check_part(&weight->part[k], env, command, err));
    return HS_OK;
}

/** costs[n_local] times the values of an atom-style variable; room for these is values[n_local]. */
static hs_status multiply_variable(const char *name, const hs_env *env, const char *command, double *costs,
                                   double *values, hs_error *err)
{
    const hs_atoms *atoms = env->atoms;
    HS_TRY(env->variable_atoms(env->deck, name, values, err));
    for (int i = 0; i < atoms->n_local; ++i) {
        if (!(values[i] > 0.0) || isinf(values[i]))
            return hs_fail(err, HS_ERROR_INPUT, "%s: the weight of atom %lld is %g; it must be above 0", command,
                           (long long)atoms->id[i], values[i]);
        costs[i] *= values[i];
    }
    return HS_OK;
}

static hs_status apply(hs_balance_weight *weight, int k, const hs_env *env, double spent_s, const char *command,
                       double *costs, double *values, hs_error *err)
{
    const hs_weight_part *part = &weight->part[k];
    const hs_atoms *atoms = env->atoms;
    double cost = part->factor;
    int bit = 0;
    switch (part->kind) {
    case HS_WEIGHT_VARIABLE:
        return multiply_variable(part->name, env, command, costs, values, err);
    case HS_WEIGHT_STORE:
        return hs_custom_atom_write(atoms, hs_custom_atom_find(atoms, 'd', part->name), NULL, costs, command, err);
    case HS_WEIGHT_GROUP:
        HS_TRY(hs_groups_get(env->groups, part->name, &bit, err));
        break;
    case HS_WEIGHT_TIME:
        cost = cost_by_share(env, spent_s, part->factor);
        break;
    case HS_WEIGHT_NEIGHBORS:
        cost = cost_by_neighbors(weight, env, part->factor, command);
        break;
    }
    for (int i = 0; i < atoms->n_local; ++i)
        if (part->kind != HS_WEIGHT_GROUP || atoms->mask[i] & hs_group_mask(bit)) costs[i] *= cost;
    return HS_OK;
}

hs_status hs_balance_weight_eval(hs_balance_weight *weight, const hs_env *env, double spent_s, const char *command,
                                 double **costs, hs_error *err)
{
    const int n = env->atoms->n_local;
    double *values = NULL;
    *costs = NULL;
    if (weight->n_parts == 0) return HS_OK;
    HS_TRY(hs_balance_weight_check(weight, env, command, err));
    hs_status status = HS_ALLOC(*costs, (size_t)n + 1, err);
    if (status == HS_OK) status = HS_ALLOC(values, (size_t)n + 1, err);
    if (hs_parallel_agree(env->parallel, err) != HS_OK) status = err->status;
    for (int i = 0; i < n && status == HS_OK; ++i) (*costs)[i] = 1.0;
    for (int k = 0; k < weight->n_parts && status == HS_OK; ++k) {
        status = apply(weight, k, env, spent_s, command, *costs, values, err);
        if (hs_parallel_agree(env->parallel, err) != HS_OK) status = err->status;
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
