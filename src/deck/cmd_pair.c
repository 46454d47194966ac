/* Commands of pair forces: pair_style, pair_coeff, pair_modify. */
#include <stdio.h>
#include <string.h>

#include "base/text.h"
#include "deck/command.h"
#include "style/pair_hybrid.h"

static hs_status run_pair_style(hs_deck *deck, const hs_args *args, hs_error *err)
{
    const hs_args words = hs_args_from(args, 1, NULL);
    return hs_sim_set_pair(deck->sim, args->word[0], &words, err);
}

static hs_status check_pair_style(const hs_args *args, bool has_variables, hs_error *err)
{
    const char *names[256] = {NULL};
    size_t n = 0;
    if (args->n == 0 || strchr(args->word[0], '$') != NULL) return HS_OK;
    for (size_t k = 0; hs_pair_styles[k] != NULL; ++k) {
        const hs_description *about = &hs_pair_styles[k]->about;
        if (n < 256) names[n++] = about->name;
        if (!hs_text_is_style(args->word[0], about->name)) continue;
        char command[128];
        snprintf(command, sizeof command, "pair_style %s", about->name);
        const hs_args words = hs_args_from(args, 1, command);
        return hs_syntax_check(&about->syntax, &words, has_variables, err);
    }
    const char *nearest = hs_text_nearest(args->word[0], names, n);
    return hs_fail(err, HS_ERROR_INPUT, "pair_style: unknown style '%s'; %s%s%s", args->word[0],
                   nearest != NULL ? "did you mean '" : "'halfshell help' lists those there are",
                   nearest != NULL ? nearest : "", nearest != NULL ? "'?" : "");
}

static hs_status run_pair_coeff(hs_deck *deck, const hs_args *args, hs_error *err)
{
    return hs_sim_pair_coeff(deck->sim, args, err);
}

static const hs_keyword modify_keywords[] = {
    {"pair", -1, "<sub-style> [<number>]", "hybrid styles: what follows is for this sub-style only (default all)"},
    {"shift", 1, "yes|no", "subtract the energy at the cutoff, so that it is continuous (default no)"},
    {"mix", 1, "geometric|arithmetic|sixthpower", "how unlike pairs that were not given are mixed (default geometric)"},
    {"tail", 1, "yes|no", "add the long-range part beyond the cutoff to energy and pressure (default no)"},
    {"table", 1, "<n>", "accepted: Halfshell computes potentials without tables"},
    {"tabinner", 1, "<r>", "accepted: Halfshell computes potentials without tables"},
    {0},
};

/** Carry out the keyword at word i on a pair style that is no hybrid one. */
static hs_status modify_word(hs_pair *pair, const hs_args *args, int i, hs_error *err)
{
    static const char *const rules[] = {"geometric", "arithmetic", "sixthpower", NULL};
    const char *keyword = args->word[i];
    int rule;
    if (strcmp(keyword, "shift") == 0) return hs_arg_bool(args, i + 1, &pair->shift, err);
    if (strcmp(keyword, "tail") == 0) {
        HS_TRY(hs_arg_bool(args, i + 1, &pair->tail, err));
        if (pair->tail && pair->style->tail == NULL)
            return hs_fail(err, HS_ERROR_INPUT, "pair_modify: pair_style %s has no long-range part for 'tail yes'",
                           pair->style->about.name);
        return HS_OK;
    }
    if (strcmp(keyword, "mix") == 0) {
        HS_TRY(hs_arg_choice(args, i + 1, rules, &rule, err));
        pair->mix = (hs_mix_rule)rule;
        return HS_OK;
    }
    double ignored;
    return hs_arg_not_negative(args, i + 1, &ignored, err);
}

static hs_status run_pair_modify(hs_deck *deck, const hs_args *args, hs_error *err)
{
    HS_TRY(hs_sim_need_pair(deck->sim, "pair_modify", err));
    hs_pair *pair = deck->sim->pair, *only = NULL;
    for (int i = 0; i < args->n;) {
        if (strcmp(args->word[i], "pair") == 0) {
            int n_words;
            if (!pair->style->is_hybrid)
                return hs_fail(
                    err, HS_ERROR_INPUT,
                    "pair_modify: 'pair' chooses a sub-style of a hybrid pair style, and pair_style %s is none",
                    pair->style->about.name);
            HS_TRY(hs_pair_hybrid_find(pair, args, i + 1, &only, &n_words, err));
            i += 1 + n_words;
            continue;
        }
        if (only != NULL) {
            HS_TRY(modify_word(only, args, i, err));
        } else {
            for (int k = 0; k < pair->n_parts; ++k) HS_TRY(modify_word(pair->part[k], args, i, err));
        }
        i += 2;
    }
    deck->sim->is_initialized = false;
    return HS_OK;
}

const hs_command hs_commands_pair[] = {
    {.about =
         {.name = "pair_style",
          .syntax = {.usage = "<style> [words of the style]", .n_min = 1, .n_max = -1},
          .summary = "choose the potential between pairs of atoms",
          .details =
              "The styles and their words are listed under pair styles. Giving the present style again changes its "
              "global settings; another style forgets all coefficients.",
          .example = "pair_style lj/cut 2.5"},
     .run = run_pair_style,
     .check = check_pair_style},
    {.about = {.name = "pair_coeff",
               .syntax = {.usage = "<I> <J> [coefficients of the style]", .n_min = 2, .n_max = -1},
               .summary = "set the coefficients of pairs of atom types",
               .details =
                   "I and J are atom types or ranges of them: `3`, `*`, `2*4`, `2*`, `*3`. Pairs with I <= J are set.",
               .example = "pair_coeff * * 1.0 1.0\npair_coeff 1 2 0.5 1.2 3.0"},
     .run = run_pair_coeff},
    {.about = {.name = "pair_modify",
               .syntax = {.usage = "<keyword> <value> ...", .n_min = 0, .n_max = 0, .keywords = modify_keywords},
               .summary = "shift, mixing rule and long-range corrections of the pair style",
               .details = "The tail corrections assume g(r) = 1 beyond the cutoff and are for homogeneous systems.",
               .example = "pair_modify shift yes mix arithmetic\npair_modify pair lj/cut tail yes"},
     .run = run_pair_modify},
    {.run = NULL},
};
