/** The conditions of the command `if`. */
#ifndef HS_DECK_BOOLEAN_H
#define HS_DECK_BOOLEAN_H

#include "base/error.h"

/** Whether a condition holds: numbers and words compared with == != < <= > >= (words only with == and !=), joined with
 *  && || |^ ! and parentheses, of the same strength as in formulas. There is no arithmetic here: $(...) has it. */
HS_MUST_USE hs_status hs_boolean_eval(const char *text, bool *holds, hs_error *err);

#endif
