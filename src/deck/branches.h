/** The words of `if`: condition then command ... [elif condition command ...] ... [else command ...]. */
#ifndef HS_DECK_BRANCHES_H
#define HS_DECK_BRANCHES_H

#include "style/args.h"

typedef struct hs_branch {
    const char *condition; /**< NULL for else */
    int first, end;        /**< its commands are the words [first, end) */
} hs_branch;

/** The branch that begins at word *at (0 for the first); *at moves behind it. *found = false at the end. Errors
 *  name what is missing. */
HS_MUST_USE hs_status hs_branches_next(const hs_args *args, int *at, hs_branch *branch, bool *found, hs_error *err);

#endif
