/** Numbers of a fix that may change from step to step: an equal-style variable, v_name, in the place of a number. */
#ifndef HS_STYLE_VARYING_H
#define HS_STYLE_VARYING_H

#include "style/fix.h"

/** Zero-initialised: the constant 0. hs_varying_fini frees it. */
typedef struct hs_varying {
    double value;   /**< the constant; of a variable: its value when it was evaluated last */
    char *variable; /**< owned; NULL: a constant */
} hs_varying;

/** Word i: a number, or v_name. What was read before is replaced. */
HS_MUST_USE hs_status hs_varying_read(hs_varying *number, const hs_args *args, int i, hs_error *err);
void hs_varying_fini(hs_varying *number);
/** Before a run: the variable must be there, with one value; an error names the fix. */
HS_MUST_USE hs_status hs_varying_check(const hs_varying *number, const hs_fix *fix, hs_error *err);
/** Bring value to the present step (collective). */
HS_MUST_USE hs_status hs_varying_update(hs_varying *number, const hs_env *env, hs_error *err);

/** The same check for a variable that a fix has by name. */
HS_MUST_USE hs_status hs_fix_need_equal_style(const hs_fix *fix, const char *variable, hs_error *err);

/** The step of the next output as a variable gives it: greater than the present one, INT64_MAX for never. @p who ("dump 'd'") and
 *  @p what ("snapshot") are for the message (collective). */
HS_MUST_USE hs_status hs_next_step(const hs_env *env, const char *variable, const char *who, const char *what,
                                   int64_t *next, hs_error *err);

#endif
