#include "deck/branches.h"

#include <string.h>

static bool is_divider(const char *word) { return strcmp(word, "elif") == 0 || strcmp(word, "else") == 0; }

static hs_status fail(const char *what, hs_error *err)
{
    return hs_fail(err, HS_ERROR_INPUT,
                   "if: %s; expected: if <condition> then \"command\" ... [elif <condition> \"command\" ...] "
                   "[else \"command\" ...]",
                   what);
}

hs_status hs_branches_next(const hs_args *args, int *at, hs_branch *branch, bool *found, hs_error *err)
{
    *found = *at < args->n;
    if (!*found) return *at > 0 ? HS_OK : fail("the condition is missing", err);
    const bool is_first = *at == 0;
    const bool is_else = !is_first && strcmp(args->word[*at], "else") == 0;
    if (!is_first) ++*at;
    branch->condition = NULL;
    if (!is_else) {
        if (*at >= args->n) return fail("the condition after 'elif' is missing", err);
        branch->condition = args->word[(*at)++];
    }
    if (is_first) {
        if (*at >= args->n || strcmp(args->word[*at], "then") != 0)
            return fail("'then' must follow the condition (quote a condition that holds blanks)", err);
        ++*at;
    }
    branch->first = *at;
    while (*at < args->n && !is_divider(args->word[*at])) ++*at;
    branch->end = *at;
    if (branch->first == branch->end) return fail("a command is missing", err);
    if (is_else && *at < args->n) return fail("'else' must be the last branch", err);
    return HS_OK;
}
