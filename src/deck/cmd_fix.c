/* Commands that make and remove fixes and computes. */
#include <string.h>

#include "base/text.h"
#include "deck/command.h"

static const hs_keyword modify_keywords[] = {
    {"energy", 1, "yes|no", "whether the fix's energy is part of the potential energy"},
    {"virial", 1, "yes|no", "whether the fix's virial is part of the pressure"},
    {"temp", 1, "<compute-ID>", "the temperature that the fix uses"},
    {"press", 1, "<compute-ID>", "the pressure that the fix uses"},
    {NULL, 0, NULL, NULL},
};

static const hs_keyword compute_modify_keywords[] = {
    {"extra/dof", 1, "<N>", "degrees of freedom that are not thermal"},
    {"extra", 1, "<N>", "the same"},
    {"dynamic/dof", 1, "yes|no", "count the atoms at each evaluation"},
    {"dynamic", 1, "yes|no", "the same"},
    {NULL, 0, NULL, NULL},
};

static hs_status run_fix(hs_deck *deck, const hs_args *args, hs_error *err)
{
    const hs_args words = hs_args_from(args, 3, NULL);
    return hs_sim_add_fix(deck->sim, args->word[0], args->word[1], args->word[2], &words, err);
}

static hs_status run_unfix(hs_deck *deck, const hs_args *args, hs_error *err)
{
    return hs_sim_remove_fix(deck->sim, args->word[0], err);
}

static hs_status run_fix_modify(hs_deck *deck, const hs_args *args, hs_error *err)
{
    return hs_sim_modify_fix(deck->sim, args->word[0], args, err);
}

/** Keywords of compute_modify belong to the styles; the whole line is read word by word. */
static hs_status run_compute_modify(hs_deck *deck, const hs_args *args, hs_error *err)
{
    hs_compute *compute = hs_sim_find_compute(deck->sim, args->word[0]);
    if (compute == NULL)
        return hs_fail(err, HS_ERROR_INPUT, "compute_modify: there is no compute with the ID '%s'", args->word[0]);
    for (int i = 1, n_used; i < args->n; i += n_used) {
        const hs_args rest = hs_args_from(args, i, NULL);
        HS_TRY(hs_arg_need(args, i + 1, "a value for the keyword", err));
        n_used = 0;
        if (compute->style->modify != NULL) HS_TRY(compute->style->modify(compute, &rest, &n_used, err));
        if (n_used == 0)
            return hs_fail(err, HS_ERROR_INPUT, "compute_modify: %s has no keyword '%s'", hs_compute_who(compute).text,
                           args->word[i]);
    }
    hs_compute_invalidate(compute);
    return HS_OK;
}

static hs_status run_compute(hs_deck *deck, const hs_args *args, hs_error *err)
{
    const hs_args words = hs_args_from(args, 3, NULL);
    return hs_sim_add_compute(deck->sim, args->word[0], args->word[1], args->word[2], &words, err);
}

static hs_status run_uncompute(hs_deck *deck, const hs_args *args, hs_error *err)
{
    return hs_sim_remove_compute(deck->sim, args->word[0], err);
}

/** Style name and words of `fix ID group style ...` or `compute ...`, before anything runs. */
static hs_status check_style(const char *kind, const hs_description *const *abouts, size_t n, const hs_args *args,
                             bool has_variables, hs_error *err)
{
    const char *names[256] = {NULL};
    size_t n_names = 0;
    if (args->n < 3 || strchr(args->word[2], '$') != NULL) return HS_OK;
    for (size_t k = 0; k < n; ++k) {
        if (n_names < 256) names[n_names++] = abouts[k]->name;
        if (!hs_text_is_style(args->word[2], abouts[k]->name)) continue;
        hs_text command = {0};
        hs_status status = hs_text_printf(&command, err, "%s %s", kind, abouts[k]->name);
        const hs_args words = hs_args_from(args, 3, hs_text_get(&command));
        if (status == HS_OK) status = hs_syntax_check(&abouts[k]->syntax, &words, has_variables, err);
        hs_text_fini(&command);
        return status;
    }
    for (size_t k = 0; k < n; ++k)
        if (strcmp(abouts[k]->name, args->word[1]) == 0)
            return hs_fail(err, HS_ERROR_INPUT,
                           "%s: '%s' is a style, and the group-ID before it is missing; expected: %s <ID> <group-ID> "
                           "<style> <words> ...",
                           kind, args->word[1], kind);
    const char *nearest = hs_text_nearest(args->word[2], names, n_names);
    return hs_fail(err, HS_ERROR_INPUT, "%s: unknown style '%s'; %s%s%s", kind, args->word[2],
                   nearest != NULL ? "did you mean '" : "'halfshell help' lists those there are",
                   nearest != NULL ? nearest : "", nearest != NULL ? "'?" : "");
}

#define CHECK_STYLE(name, kind, table)                                                                                 \
    static hs_status name(const hs_args *args, bool has_variables, hs_error *err)                                      \
    {                                                                                                                  \
        const hs_description *abouts[256] = {NULL};                                                                    \
        size_t n = 0;                                                                                                  \
        for (size_t k = 0; (table)[k] != NULL && n < 256; ++k) abouts[n++] = &(table)[k]->about;                       \
        return check_style(kind, abouts, n, args, has_variables, err);                                                 \
    }
CHECK_STYLE(check_fix, "fix", hs_fix_styles)
CHECK_STYLE(check_compute, "compute", hs_compute_styles)

const hs_command hs_commands_fix[] = {
    {.about = {.name = "fix",
               .syntax = {.usage = "<ID> <group-ID> <style> [words of the style]", .n_min = 3, .n_max = -1},
               .summary = "make something act on a group of atoms at every step",
               .details = "The styles and their words are listed under fixes. A fix of the same ID and style is "
                          "replaced and keeps its place in the order.",
               .example = "fix 1 all nve"},
     .run = run_fix,
     .check = check_fix},
    {.about = {.name = "unfix",
               .syntax = {.usage = "<ID>", .n_min = 1, .n_max = 1},
               .summary = "remove a fix",
               .details = "The fix stops acting; the ID is free again.",
               .example = "unfix 1"},
     .run = run_unfix},
    {.about = {.name = "fix_modify",
               .syntax = {.usage = "<ID> <keyword> <value> ...", .n_min = 1, .n_max = 1, .keywords = modify_keywords},
               .summary = "change how a fix counts",
               .details = "`energy yes` adds the fix's energy to the potential energy (compute pe, thermo output); "
                          "`virial yes` adds its virial to the pressure. Both are off until asked for. A fix that has "
                          "no energy or no virial refuses the word.",
               .example = "fix walls all wall/lj126 zlo 0.0 1.0 1.0 1.12\nfix_modify walls energy yes virial yes"},
     .run = run_fix_modify},
    {.about = {.name = "compute",
               .syntax = {.usage = "<ID> <group-ID> <style> [words of the style]", .n_min = 3, .n_max = -1},
               .summary = "define a quantity to be measured",
               .details = "The styles are listed under computes. Values are used as `c_ID` or `c_ID[i]` in formulas "
                          "and thermo output. `thermo_temp`, `thermo_press` and `thermo_pe` always exist.",
               .example = "compute hot mobile temp"},
     .run = run_compute,
     .check = check_compute},
    {.about = {.name = "compute_modify",
               .syntax =
                   {.usage = "<ID> <keyword> <value> ...", .n_min = 1, .n_max = 1, .keywords = compute_modify_keywords},
               .summary = "change settings of a temperature compute",
               .details = "A temperature has n_dof = dim N - dim degrees of freedom; `extra/dof` says how many are "
                          "taken off instead of dim. They are counted at the start of each run, with `dynamic/dof yes` "
                          "at each evaluation, as is needed where atoms come, go or change groups.",
               .example = "compute_modify thermo_temp extra/dof 0\ncompute_modify hot dynamic/dof yes"},
     .run = run_compute_modify},
    {.about = {.name = "uncompute",
               .syntax = {.usage = "<ID>", .n_min = 1, .n_max = 1},
               .summary = "remove a compute",
               .details = "The ID is free again.",
               .example = "uncompute hot"},
     .run = run_uncompute},
    {.run = NULL},
};
