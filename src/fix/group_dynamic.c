/* Members of a group that changes: atoms of a parent group that are in a region now, or for which a variable is not 0.
 * The command `group ID dynamic` makes this fix. */
#include <string.h>

#include "base/memory.h"
#include "core/group.h"
#include "style/fix.h"
#include "style/region.h"

typedef struct dynamic_state {
    int group;      /**< bit number of the group whose members are chosen */
    char *variable; /**< owned; atom-style; NULL: all */
    hs_where where;
    int64_t every;
} dynamic_state;

static const hs_keyword keywords[] = {
    {"region", 1, "<ID>", "members are in this region"},
    {"var", 1, "<name>", "members have another value of this atom-style variable than 0"},
    {"every", 1, "<N>", "members are chosen anew at steps that are multiples of N (default 1)"},
    {NULL, 0, NULL, NULL},
};

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    dynamic_state *state = fix->state;
    hs_groups *groups = fix->env->groups;
    state->every = 1;
    HS_TRY(hs_groups_get(groups, args->word[0], &state->group, err));
    if (state->group == 0 || state->group == fix->group)
        return hs_fail(err, HS_ERROR_INPUT, "%s: the group '%s' cannot choose its members from itself", args->command,
                       args->word[0]);
    if (groups->dynamic & fix->mask)
        return hs_fail(err, HS_ERROR_INPUT,
                       "%s: the group '%s', from which members are to be chosen, is itself dynamic; name a group whose "
                       "members stay",
                       args->command, groups->name[fix->group]);
    for (int i = 1; i + 1 < args->n; i += 2) {
        if (strcmp(args->word[i], "region") == 0)
            HS_TRY(hs_where_set(&state->where, args->word[i + 1], err));
        else if (strcmp(args->word[i], "var") == 0)
            HS_TRY(hs_memory_replace(&state->variable, args->word[i + 1], err));
        else
            HS_TRY(hs_arg_int(args, i + 1, 1, INT64_MAX, &state->every, err));
    }
    groups->dynamic |= hs_group_mask(state->group);
    return HS_OK;
}

static void destroy(hs_fix *fix)
{
    dynamic_state *state = fix->state;
    fix->env->groups->dynamic &= ~hs_group_mask(state->group);
    hs_where_fini(&state->where);
    HS_FREE(state->variable);
}

static hs_status init(hs_fix *fix, hs_error *err)
{
    dynamic_state *state = fix->state;
    const hs_env *env = fix->env;
    const char *const name = env->groups->name[state->group];
    hs_who who;
    snprintf(who.text, sizeof who.text, "group '%.80s' (dynamic)", name);
    HS_TRY(hs_where_find(&state->where, fix->env, who.text, err));
    if (state->variable == NULL) return HS_OK;
    const hs_variable_kind kind = hs_env_variable_kind(env, state->variable);
    if (kind == HS_NUMBER_VARIABLE || kind == HS_ATOM_VARIABLE) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "%s: there is no variable '%s' that has a value, or one for each atom",
                   who.text, state->variable);
}

static hs_status choose(hs_fix *fix, hs_error *err)
{
    const dynamic_state *state = fix->state;
    hs_atoms *atoms = fix->env->atoms;
    const uint32_t bit = hs_group_mask(state->group);
    double *values = NULL;
    hs_env_changed(fix->env); /* atoms have moved since computes were asked */
    HS_TRY(hs_where_update(&state->where, err));
    if (state->variable != NULL) {
        HS_TRY(HS_ALLOC(values, (size_t)atoms->n_local + 1, err));
        const hs_status status = fix->env->variable_atoms(fix->env->deck, state->variable, values, err);
        if (status != HS_OK) {
            HS_FREE(values);
            return status;
        }
    }
#pragma omp parallel for schedule(static)
    for (int i = 0; i < atoms->n_local; ++i) {
        const bool is_member = (atoms->mask[i] & fix->mask) && hs_where_has(&state->where, atoms, i) &&
                               (values == NULL || values[i] != 0.0);
        atoms->mask[i] = is_member ? atoms->mask[i] | bit : atoms->mask[i] & ~bit;
    }
    HS_FREE(values);
    hs_env_changed(fix->env);
    return HS_OK;
}

static hs_status post_integrate(hs_fix *fix, hs_error *err)
{
    return fix->env->step % ((const dynamic_state *)fix->state)->every == 0 ? choose(fix, err) : HS_OK;
}

const hs_fix_style hs_fix_style_group_dynamic = {
    .about =
        {.name = "group/dynamic",
         .syntax = {.usage = "<group-ID> [keyword value ...]", .n_min = 1, .n_max = 1, .keywords = keywords},
         .summary = "choose the members of a group anew every few steps",
         .details =
             "`group ID dynamic parent ...` makes the fix `GROUP_ID parent group/dynamic ID ...`: at the start of a "
             "run or minimisation and after the atoms have moved, those atoms of the parent group become members that "
             "are where, "
             "and for which, the keywords say; the others leave the group.",
         .example = "region hot block INF INF INF INF 0 2\ngroup heated dynamic all region hot every 10\n"
                    "fix bath heated langevin 1.5 1.5 0.5 4711"},
    .state_size = sizeof(dynamic_state),
    .create = create,
    .destroy = destroy,
    .init = init,
    .setup = choose,
    .post_integrate = post_integrate,
    .keeps_plane = true,
    .acts_in_minimize = true,
};
