/* The command group. */
#include <string.h>

#include "base/memory.h"
#include "base/text.h"
#include "deck/command.h"

typedef enum {
    GROUP_DELETE,
    GROUP_CLEAR,
    GROUP_EMPTY,
    GROUP_REGION,
    GROUP_TYPE,
    GROUP_ID,
    GROUP_VARIABLE,
    GROUP_SUBTRACT,
    GROUP_UNION,
    GROUP_INTERSECT,
    GROUP_DYNAMIC,
    GROUP_STATIC
} group_style;

static const char *const group_styles[] = {"delete",   "clear", "empty",     "region",  "type",   "id", "variable",
                                           "subtract", "union", "intersect", "dynamic", "static", NULL};
/** Least number of words after the style, and most (-1: any number). */
static const int group_words[][2] = {{0, 0}, {0, 0},  {0, 0},  {1, 1},  {1, -1}, {1, -1},
                                     {1, 1}, {2, -1}, {1, -1}, {2, -1}, {3, 7},  {0, 0}};

static const char *const comparisons[] = {"<", ">", "<=", ">=", "==", "!=", "<>", NULL};

/** Range of numbers a:b:c. */
typedef struct range {
    int64_t first, last, stride;
} range;

static hs_status refuse_other(const hs_args *args, const char *style, hs_error *err)
{
    static const char *const reasons[][2] = {
        {"molecule", "atoms belong to no molecules"},
        {"include", "it completes molecules, which there are none of"},
    };
    for (size_t k = 0; k < sizeof reasons / sizeof reasons[0]; ++k)
        if (strcmp(style, reasons[k][0]) == 0)
            return hs_fail(err, HS_ERROR_INPUT, "%s: the style '%s' is not supported: %s", args->command, style,
                           reasons[k][1]);
    return HS_OK;
}

static hs_status group_check(const hs_args *args, bool has_variables, hs_error *err)
{
    int style;
    if (strchr(args->word[1], '$') != NULL) return HS_OK;
    HS_TRY(refuse_other(args, args->word[1], err));
    HS_TRY(hs_arg_choice(args, 1, group_styles, &style, err));
    if (has_variables) return HS_OK;
    const int n = args->n - 2, *allowed = group_words[style];
    if (n < allowed[0])
        return hs_fail(err, HS_ERROR_INPUT, "group: the style %s needs %s%d more word%s", args->word[1],
                       allowed[1] != allowed[0] ? "at least " : "", allowed[0], allowed[0] == 1 ? "" : "s");
    if (allowed[1] >= 0 && n > allowed[1])
        return hs_fail(err, HS_ERROR_INPUT, "group: unexpected word '%s' after the style %s",
                       args->word[2 + allowed[1]], args->word[1]);
    return HS_OK;
}

/* ---- type and id ---- */

/** n, a:b or a:b:c. */
static hs_status read_range(const hs_args *args, int i, range *r, hs_error *err)
{
    static const char expected[] = "a number, a range first:last, or first:last:stride";
    char word[96];
    int64_t part[3];
    int n = 0;
    if (strlen(args->word[i]) >= sizeof word) return hs_arg_refuse(args, i, expected, NULL, err);
    strcpy(word, args->word[i]);
    for (char *at = word, *next; at != NULL && n < 4; at = next, ++n) {
        next = strchr(at, ':');
        if (next != NULL) *next++ = '\0';
        if (n == 3 || !hs_text_to_int64(at, &part[n])) return hs_arg_refuse(args, i, expected, NULL, err);
    }
    *r = (range){part[0], n > 1 ? part[1] : part[0], n > 2 ? part[2] : 1};
    return r->stride > 0 ? HS_OK : hs_arg_refuse(args, i, "a range with a stride greater than 0", NULL, err);
}

static bool compares(int comparison, int64_t value, int64_t a, int64_t b)
{
    switch (comparison) {
    case 0:
        return value < a;
    case 1:
        return value > a;
    case 2:
        return value <= a;
    case 3:
        return value >= a;
    case 4:
        return value == a;
    case 5:
        return value != a;
    default:
        return value >= a && value <= b;
    }
}

static inline int64_t number_of(const hs_atoms *atoms, group_style style, int i)
{
    return style == GROUP_TYPE ? atoms->type[i] : atoms->id[i];
}

static hs_status select_by_comparison(const hs_atoms *atoms, group_style style, const hs_args *args, uint32_t bit,
                                      hs_error *err)
{
    int comparison;
    int64_t a = 0, b = 0;
    HS_TRY(hs_arg_choice(args, 2, comparisons, &comparison, err));
    const int n_words = strcmp(comparisons[comparison], "<>") == 0 ? 5 : 4;
    if (args->n != n_words)
        return hs_fail(err, HS_ERROR_INPUT, "group: after '%s' there must be %s", args->word[2],
                       n_words == 5 ? "two numbers, the least and the greatest" : "one number");
    if (!hs_text_to_int64(args->word[3], &a)) return hs_arg_refuse(args, 3, "a whole number", NULL, err);
    if (n_words == 5 && !hs_text_to_int64(args->word[4], &b))
        return hs_arg_refuse(args, 4, "a whole number", NULL, err);
    for (int i = 0; i < atoms->n_local; ++i)
        if (compares(comparison, number_of(atoms, style, i), a, b)) atoms->mask[i] |= bit;
    return HS_OK;
}

static bool is_comparison(const char *word)
{
    for (int k = 0; comparisons[k] != NULL; ++k)
        if (strcmp(word, comparisons[k]) == 0) return true;
    return false;
}

static hs_status select_by_number(const hs_atoms *atoms, group_style style, const hs_args *args, uint32_t bit,
                                  hs_error *err)
{
    if (is_comparison(args->word[2])) return select_by_comparison(atoms, style, args, bit, err);
    for (int k = 2; k < args->n; ++k) {
        range r = {0, 0, 1};
        HS_TRY(read_range(args, k, &r, err));
        for (int i = 0; i < atoms->n_local; ++i) {
            const int64_t number = number_of(atoms, style, i);
            /* unsigned, because the difference of two hostile numbers may not fit */
            if (number < r.first || number > r.last) continue;
            if (((uint64_t)number - (uint64_t)r.first) % (uint64_t)r.stride == 0) atoms->mask[i] |= bit;
        }
    }
    return HS_OK;
}

/* ---- region, variable, other groups ---- */

static hs_status select_by_region(hs_sim *sim, const hs_args *args, uint32_t bit, hs_error *err)
{
    const hs_region *region;
    hs_atoms *atoms = &sim->atoms;
    HS_TRY(hs_sim_need_region(sim, "group", args->word[2], &region, err));
    for (int i = 0; i < atoms->n_local; ++i)
        if (hs_region_has(region, atoms, i)) atoms->mask[i] |= bit;
    return HS_OK;
}

static hs_status select_by_variable(hs_deck *deck, const hs_args *args, uint32_t bit, hs_error *err)
{
    hs_atoms *atoms = &deck->sim->atoms;
    double *values = NULL;
    HS_TRY(HS_ALLOC(values, (size_t)atoms->n_local, err));
    hs_status status = deck->sim->env.variable_atoms(deck, args->word[2], values, err);
    for (int i = 0; status == HS_OK && i < atoms->n_local; ++i)
        if (values[i] != 0.0) atoms->mask[i] |= bit;
    HS_FREE(values);
    return status;
}

static hs_status select_by_groups(hs_sim *sim, group_style style, const hs_args *args, uint32_t bit, hs_error *err)
{
    hs_atoms *atoms = &sim->atoms;
    uint32_t first = 0, others = 0;
    for (int k = 2; k < args->n; ++k) {
        int other;
        HS_TRY(hs_groups_get(&sim->groups, args->word[k], &other, err));
        if (sim->groups.dynamic & hs_group_mask(other))
            return hs_fail(err, HS_ERROR_INPUT,
                           "group: '%s' is dynamic: its members are known only during a run ('group %s static' keeps "
                           "those that it has)",
                           args->word[k], args->word[k]);
        *(k == 2 ? &first : &others) |= hs_group_mask(other);
    }
    for (int i = 0; i < atoms->n_local; ++i) {
        const uint32_t mask = atoms->mask[i];
        bool is_member;
        if (style == GROUP_SUBTRACT)
            is_member = (mask & first) != 0 && (mask & others) == 0;
        else if (style == GROUP_UNION)
            is_member = (mask & (first | others)) != 0;
        else
            is_member = (mask & (first | others)) == (first | others);
        if (is_member) atoms->mask[i] |= bit;
    }
    return HS_OK;
}

/* ---- clear and delete ---- */

static void clear_bit(hs_atoms *atoms, uint32_t bit)
{
    for (int i = 0; i < atoms->n_local; ++i) atoms->mask[i] &= ~bit;
}

/** Fail when something still refers to the group. */
static hs_status check_unused(const hs_sim *sim, int group, hs_error *err)
{
    const char *kind = NULL, *id = "";
    const uint32_t bit = hs_group_mask(group);
    for (int k = 0; k < sim->n_fixes; ++k)
        if ((sim->fix[k]->mask | sim->fix[k]->other_groups) & bit) kind = "fix", id = sim->fix[k]->id;
    for (int k = 0; k < sim->n_computes; ++k)
        if ((sim->compute[k]->mask | sim->compute[k]->other_groups) & bit) kind = "compute", id = sim->compute[k]->id;
    for (int k = 0; k < sim->n_dumps; ++k)
        if (sim->dump[k]->group == group) kind = "dump", id = sim->dump[k]->id;
    const hs_neighbor_settings *settings = &sim->neighbor.settings;
    for (int k = 0; k < settings->n_exclusions; ++k)
        if (settings->exclusion[k].kind == HS_EXCLUDE_GROUP &&
            (settings->exclusion[k].a == group || settings->exclusion[k].b == group))
            kind = "command", id = "neigh_modify exclude";
    if (kind == NULL) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "group: '%s' is used by the %s %s and cannot be deleted before it",
                   sim->groups.name[group], kind, id);
}

/* ---- dynamic and static ---- */

/** The fix that chooses the members of a dynamic group: its name is LAMMPS's. */
static hs_status fix_name(const char *group, hs_text *name, hs_error *err)
{
    return hs_text_printf(name, err, "GROUP_%s", group);
}

/** No more changes; the members stay. */
static hs_status end_dynamic(hs_sim *sim, int group, hs_error *err)
{
    hs_text name = {0};
    if (!(sim->groups.dynamic & hs_group_mask(group))) return HS_OK;
    hs_status status = fix_name(sim->groups.name[group], &name, err);
    if (status == HS_OK) status = hs_sim_remove_fix(sim, hs_text_get(&name), err);
    hs_text_fini(&name);
    return status;
}

/** group ID dynamic <parent> keyword value ...: made by a fix. */
static hs_status start_dynamic(hs_deck *deck, const hs_args *args, int group, hs_error *err)
{
    hs_sim *sim = deck->sim;
    hs_text name = {0};
    const char *words[8] = {args->word[0]};
    const hs_neighbor_settings *settings = &sim->neighbor.settings;
    for (int k = 0; k < settings->n_exclusions; ++k)
        if (settings->exclusion[k].kind == HS_EXCLUDE_GROUP &&
            (settings->exclusion[k].a == group || settings->exclusion[k].b == group))
            return hs_fail(err, HS_ERROR_INPUT, "group: neigh_modify exclude needs the members of '%s' to stay",
                           args->word[0]);
    HS_TRY(end_dynamic(sim, group, err));
    for (int i = 3; i < args->n; ++i) words[i - 2] = args->word[i];
    const hs_args fix = {.command = args->command, .n = args->n - 2, .word = words};
    hs_status status = fix_name(args->word[0], &name, err);
    if (status == HS_OK) status = hs_sim_add_fix(sim, hs_text_get(&name), args->word[2], "group/dynamic", &fix, err);
    hs_text_fini(&name);
    HS_TRY(status);
    hs_say(deck->out, "dynamic group %s defined\n", args->word[0]);
    return HS_OK;
}

static hs_status clear_or_delete(hs_sim *sim, const hs_args *args, bool is_delete, hs_error *err)
{
    int group;
    HS_TRY(hs_groups_get(&sim->groups, args->word[0], &group, err));
    if (group == 0)
        return hs_fail(err, HS_ERROR_INPUT, "group: the group all cannot be %s", is_delete ? "deleted" : "cleared");
    if (is_delete) HS_TRY(end_dynamic(sim, group, err));
    if (is_delete) HS_TRY(check_unused(sim, group, err));
    if (!sim->env.is_resuming) clear_bit(&sim->atoms, hs_group_mask(group));
    if (is_delete) hs_groups_remove(&sim->groups, group);
    hs_sim_atoms_changed(sim);
    return HS_OK;
}

/* ---- the command ---- */

static hs_status select_atoms(hs_deck *deck, group_style style, const hs_args *args, uint32_t bit, hs_error *err)
{
    hs_sim *sim = deck->sim;
    switch (style) {
    case GROUP_EMPTY:
        return HS_OK;
    case GROUP_REGION:
        return select_by_region(sim, args, bit, err);
    case GROUP_TYPE:
    case GROUP_ID:
        return select_by_number(&sim->atoms, style, args, bit, err);
    case GROUP_VARIABLE:
        return select_by_variable(deck, args, bit, err);
    default:
        return select_by_groups(sim, style, args, bit, err);
    }
}

static hs_status group_run(hs_deck *deck, const hs_args *args, hs_error *err)
{
    hs_sim *sim = deck->sim;
    int style, group;
    HS_TRY(hs_sim_need_box(sim, args->command, err));
    HS_TRY(group_check(args, false, err));
    HS_TRY(hs_arg_choice(args, 1, group_styles, &style, err));
    if (style == GROUP_DELETE || style == GROUP_CLEAR) return clear_or_delete(sim, args, style == GROUP_DELETE, err);
    const bool is_new = hs_groups_find(&sim->groups, args->word[0]) < 0;
    if (style == GROUP_STATIC) HS_TRY(hs_groups_get(&sim->groups, args->word[0], &group, err));
    HS_TRY(hs_groups_add(&sim->groups, args->word[0], &group, err));
    const uint32_t bit = hs_group_mask(group);
    hs_status status = HS_OK;
    if (style == GROUP_STATIC)
        status = end_dynamic(sim, group, err);
    else if (style != GROUP_DYNAMIC && sim->groups.dynamic & bit)
        status =
            hs_fail(err, HS_ERROR_INPUT, "group: '%s' is dynamic: it takes no other members ('group %s static' first)",
                    args->word[0], args->word[0]);
    HS_TRY(status);
    if (!sim->env.is_resuming) { /* else atoms brought their groups; what chose them (regions, variables) may be gone */
        if (is_new) clear_bit(&sim->atoms, bit);
        status = style == GROUP_DYNAMIC || style == GROUP_STATIC
                     ? HS_OK
                     : select_atoms(deck, (group_style)style, args, bit, err);
    }
    if (status == HS_OK && style == GROUP_DYNAMIC) status = start_dynamic(deck, args, group, err);
    if (status != HS_OK) {
        if (is_new) hs_groups_remove(&sim->groups, group);
        return status;
    }
    if (style == GROUP_DYNAMIC) return HS_OK;
    int64_t n = 0;
    for (int i = 0; i < sim->atoms.n_local; ++i) n += (sim->atoms.mask[i] & bit) != 0;
    hs_parallel_sum_int64(&sim->parallel, &n, 1);
    hs_sim_atoms_changed(sim);
    hs_say(deck->out, "%lld atoms in group %s\n", (long long)n, args->word[0]);
    return HS_OK;
}

const hs_command hs_commands_group[] = {
    {
        .about =
            {
                .name = "group",
                .syntax = {"<ID> <style> <words> ...", 2, -1, NULL},
                .summary = "Name a set of atoms",
                .details =
                    "Atoms are added to the group `ID`, which is made if it is new; group `all` holds every atom. "
                    "There can be 32 groups.\n\n"
                    "| style | atoms |\n|---|---|\n"
                    "| `type` or `id`, then numbers and ranges | of these types or IDs; ranges are `first:last` or "
                    "`first:last:stride` |\n"
                    "| `type` or `id`, then `<`, `>`, `<=`, `>=`, `==` or `!=` and a number | that compare so |\n"
                    "| `type` or `id`, then `<>` and two numbers | from the first to the second, both included |\n"
                    "| `region <ID>` | in the region now |\n"
                    "| `variable <name>` | for which the atom-style variable is not 0 now |\n"
                    "| `union <ID> ...` | in any of the groups |\n"
                    "| `intersect <ID> <ID> ...` | in all of the groups |\n"
                    "| `subtract <ID> <ID> ...` | in the first group and in none of the others |\n"
                    "| `empty` | none |\n"
                    "| `dynamic <group-ID> [region <ID>] [var <name>] [every <N>]` | those of that group that are in "
                    "the region, and for which the atom-style variable is not 0, chosen anew during runs at steps that "
                    "are multiples of N; after `read_restart` they stay |\n"
                    "| `static` | those that a dynamic group has now: they stay |\n\n"
                    "`clear` takes all atoms out of the group; `delete` removes it, unless a fix, compute, dump or "
                    "exclusion uses it.\n"
                    "Atoms stay in their groups wherever they move, but in dynamic ones: what acts on such a group, or "
                    "measures it, does so with its members of the step; what remembers something of each member (msd, "
                    "vacf, spring/self, ...) refuses it. The styles `molecule` and `include` are refused.\n",
                .example =
                    "group wall type 2 3\ngroup odd id 1:999:2\ngroup upper region top\ngroup mobile subtract all wall",
            },
        .run = group_run,
        .check = group_check,
    },
    {.about = {.name = NULL}},
};
