#include "style/pair_hybrid.h"

#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "base/text.h"

enum { PARTS_MAX = 256 };

/** Sub-style that word i must name. */
static hs_status read_style(const hs_args *args, int i, const hs_pair_style **style, hs_error *err)
{
    const char *names[PARTS_MAX + 1] = {NULL};
    for (size_t k = 0; k < PARTS_MAX && hs_pair_styles[k] != NULL; ++k) names[k] = hs_pair_styles[k]->about.name;
    *style = hs_pair_style_find(args->word[i]);
    if (*style == NULL) return hs_arg_refuse(args, i, "a pair style", names, err);
    if ((*style)->is_hybrid) return hs_arg_refuse(args, i, "a pair style that can be part of a hybrid one", NULL, err);
    if ((*style)->allows_none)
        return hs_fail(err, HS_ERROR_INPUT,
                       "%s: 'none' needs no place among the sub-styles; 'pair_coeff I J none' says that a pair of "
                       "types does not interact",
                       args->command);
    return HS_OK;
}

/** Index of the first word after the sub-style at word i and its own words: where the next sub-style is, or the end. */
static int end_of_style(const hs_args *args, int i)
{
    for (++i; i < args->n; ++i)
        if (hs_pair_style_find(args->word[i]) != NULL) break;
    return i;
}

/** Whether the words name the parts that there are, in their order. */
static bool has_same_parts(const hs_pair *pair, const hs_args *args)
{
    int k = 0;
    for (int i = 0; i < args->n; i = end_of_style(args, i), ++k)
        if (k >= pair->n_parts || !hs_text_is_style(args->word[i], pair->part[k]->style->about.name)) return false;
    return k == pair->n_parts;
}

static void forget_parts(hs_pair *pair)
{
    for (int k = 0; k < pair->n_parts; ++k) hs_pair_destroy(&pair->part[k]);
    HS_FREE(pair->part);
    pair->n_parts = 0;
    memset(pair->is_set, 0, (size_t)(pair->n_types + 1) * (size_t)(pair->n_types + 1));
}

static hs_status add_part(hs_pair *pair, const hs_pair_style *style, hs_error *err)
{
    if (pair->n_parts == PARTS_MAX)
        return hs_fail(err, HS_ERROR_INPUT, "pair_style %s: more than %d sub-styles", pair->style->about.name,
                       PARTS_MAX);
    HS_TRY(HS_GROW(pair->part, (size_t)pair->n_parts, (size_t)pair->n_parts + 1, err));
    hs_pair **part = &pair->part[pair->n_parts++];
    return hs_pair_create(part, style, pair->env, pair->n_types, err);
}

hs_status hs_pair_hybrid_settings(hs_pair *pair, const hs_args *args, hs_error *err)
{
    const bool keeps = pair->n_parts > 0 && has_same_parts(pair, args);
    if (!keeps) forget_parts(pair);
    for (int i = 0, next, k = 0; i < args->n; i = next, ++k) {
        const hs_pair_style *style;
        char command[128];
        HS_TRY(read_style(args, i, &style, err));
        next = end_of_style(args, i);
        snprintf(command, sizeof command, "%s ... %s", args->command, style->about.name);
        const hs_args words = {.command = command, .n = next - i - 1, .word = args->word + i + 1};
        HS_TRY(hs_syntax_check(&style->about.syntax, &words, false, err));
        if (!keeps) HS_TRY(add_part(pair, style, err));
        HS_TRY(style->settings(pair->part[k], &words, err));
    }
    return HS_OK;
}

hs_status hs_pair_hybrid_find(const hs_pair *pair, const hs_args *args, int first, hs_pair **part, int *n_words,
                              hs_error *err)
{
    const char *names[PARTS_MAX + 1] = {NULL};
    int n = 0, found[PARTS_MAX];
    HS_TRY(hs_arg_need(args, first, "a sub-style of the hybrid pair style", err));
    for (int k = 0; k < pair->n_parts; ++k) {
        names[k] = pair->part[k]->style->about.name;
        if (strcmp(names[k], args->word[first]) == 0) found[n++] = k;
    }
    if (n == 0) {
        hs_text list = {0};
        hs_status status = HS_OK;
        for (int k = 0; k < pair->n_parts && status == HS_OK; ++k)
            status = hs_text_printf(&list, err, "%s%s", k > 0 ? ", " : "one of the sub-styles ", names[k]);
        if (status == HS_OK) status = hs_arg_refuse(args, first, hs_text_get(&list), NULL, err);
        hs_text_fini(&list);
        return status;
    }
    int64_t number = 1;
    if (n > 1) {
        if (first + 1 >= args->n)
            return hs_fail(err, HS_ERROR_INPUT,
                           "%s: '%s' occurs %d times in pair_style %s; its number (1 to %d) must follow it",
                           args->command, args->word[first], n, pair->style->about.name, n);
        HS_TRY(hs_arg_int(args, first + 1, 1, n, &number, err));
    }
    *part = pair->part[found[number - 1]];
    *n_words = n > 1 ? 2 : 1;
    return HS_OK;
}

hs_status hs_pair_hybrid_coeff(hs_pair *pair, int i, int j, const hs_args *args, bool is_added, hs_error *err)
{
    const int ij = hs_pair_index(pair, i, j);
    const bool is_none = strcmp(args->word[0], "none") == 0;
    hs_pair *part = NULL;
    int n_words = 0;
    if (is_none && args->n > 1) return hs_arg_refuse(args, 1, "expected: 'none' has no coefficients", NULL, err);
    if (!is_none) {
        char command[160];
        HS_TRY(hs_pair_hybrid_find(pair, args, 0, &part, &n_words, err));
        snprintf(command, sizeof command, "%s %s", args->command, part->style->about.name);
        const hs_args words = hs_args_from(args, n_words, command);
        HS_TRY(hs_syntax_check(&part->style->coeff_syntax, &words, false, err));
        HS_TRY(part->style->coeff(part, i, j, &words, err));
    }
    for (int k = 0; k < pair->n_parts && (is_none || !is_added); ++k) pair->part[k]->is_set[ij] = 0;
    if (!is_none) part->is_set[ij] = 1;
    return HS_OK;
}
