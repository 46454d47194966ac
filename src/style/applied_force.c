#include "style/applied_force.h"

#include <string.h>

#include "base/memory.h"
#include "style/varying.h"

hs_status hs_applied_force_create(hs_applied_force *force, const hs_args *args, bool may_be_free, hs_error *err)
{
    for (int axis = 0; axis < 3; ++axis) {
        const char *word = args->word[axis];
        force->is_free[axis] = may_be_free && strcmp(word, "NULL") == 0;
        if (force->is_free[axis]) continue;
        if (strncmp(word, "v_", 2) == 0)
            HS_TRY(hs_memory_strdup(&force->variable[axis], word + 2, err));
        else
            HS_TRY(hs_arg_double(args, axis, &force->value[axis], err));
    }
    return HS_OK;
}

static hs_status find_region(hs_applied_force *force, const hs_fix *fix, hs_error *err)
{
    return hs_where_find(&force->where, fix->env, hs_fix_who(fix).text, err);
}

hs_status hs_applied_force_region(hs_applied_force *force, const hs_fix *fix, const hs_args *args, int i, hs_error *err)
{
    HS_TRY(hs_where_set(&force->where, args->word[i], err));
    return find_region(force, fix, err);
}

hs_status hs_applied_force_init(hs_applied_force *force, const hs_fix *fix, bool may_be_per_atom, hs_error *err)
{
    const hs_env *env = fix->env;
    for (int axis = 0; axis < 3; ++axis) {
        const char *name = force->variable[axis];
        if (name == NULL) continue;
        const bool is_per_atom = may_be_per_atom && hs_env_variable_kind(env, name) == HS_ATOM_VARIABLE;
        if (!is_per_atom) {
            HS_TRY(hs_fix_need_equal_style(fix, name, err));
            HS_FREE(force->of_atom[axis]);
            force->capacity[axis] = 0;
        } else if (force->of_atom[axis] == NULL) {
            force->capacity[axis] = (size_t)env->atoms->n_local + 1;
            HS_TRY(HS_ALLOC(force->of_atom[axis], force->capacity[axis], err));
        }
    }
    return find_region(force, fix, err);
}

hs_status hs_applied_force_update(hs_applied_force *force, const hs_fix *fix, hs_error *err)
{
    const hs_env *env = fix->env;
    const size_t n = (size_t)env->atoms->n_local;
    HS_TRY(hs_where_update(&force->where, err));
    for (int axis = 0; axis < 3; ++axis) {
        if (force->variable[axis] == NULL) continue;
        if (force->of_atom[axis] == NULL) {
            HS_TRY(env->variable_value(env->deck, force->variable[axis], &force->value[axis], err));
            continue;
        }
        HS_TRY(HS_RESERVE(force->of_atom[axis], force->capacity[axis], n, err));
        HS_TRY(env->variable_atoms(env->deck, force->variable[axis], force->of_atom[axis], err));
    }
    return HS_OK;
}

void hs_applied_force_fini(hs_applied_force *force)
{
    for (int axis = 0; axis < 3; ++axis) {
        HS_FREE(force->variable[axis]);
        HS_FREE(force->of_atom[axis]);
    }
    hs_where_fini(&force->where);
}

const hs_keyword hs_replaced_force_keywords[] = {
    {"region", 1, "<region-ID>", "only atoms that are in this region at the step"},
    {NULL, 0, NULL, NULL},
};

hs_status hs_replaced_force_create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    hs_replaced_force *state = fix->state;
    HS_TRY(hs_syntax_check(&fix->style->about.syntax, args, false, err));
    HS_TRY(hs_applied_force_create(&state->force, args, true, err));
    for (int i = 3; i < args->n; i += 2) HS_TRY(hs_applied_force_region(&state->force, fix, args, i + 1, err));
    return HS_OK;
}

void hs_replaced_force_destroy(hs_fix *fix) { hs_applied_force_fini(&((hs_replaced_force *)fix->state)->force); }

int hs_applied_force_find(const hs_applied_force *force, const hs_fix *fix, int begin, int end, int32_t *found)
{
    const uint32_t *group = fix->env->atoms->mask, mask = fix->mask;
    int n = 0;
    for (int i = begin; i < end; ++i) { /* without branches: groups may be anywhere */
        found[n] = i;
        n += (group[i] & mask) != 0;
    }
    if (force->where.region == NULL) return n;
    const int n_in_group = n;
    n = 0;
    for (int k = 0; k < n_in_group; ++k)
        if (hs_applied_force_acts(force, fix, found[k])) found[n++] = found[k];
    return n;
}

void hs_replaced_force_add(const hs_atoms *atoms, const int32_t *found, int n, hs_exact_sum *sums)
{
    double before[HS_EXACT_ARRAY_MAX];
    for (int axis = 0; axis < 3; ++axis) {
        for (int k = 0; k < n; ++k) before[k] = atoms->f[axis][found[k]];
        hs_exact_add_array(&sums[axis], before, n);
    }
    hs_exact_add(&sums[3], n);
}
