#include "style/varying.h"

#include <string.h>

#include "base/memory.h"

hs_status hs_varying_read(hs_varying *number, const hs_args *args, int i, hs_error *err)
{
    if (strncmp(args->word[i], "v_", 2) == 0) return hs_memory_replace(&number->variable, args->word[i] + 2, err);
    HS_FREE(number->variable);
    return hs_arg_double(args, i, &number->value, err);
}

void hs_varying_fini(hs_varying *number) { HS_FREE(number->variable); }

hs_status hs_fix_need_equal_style(const hs_fix *fix, const char *variable, hs_error *err)
{
    const hs_variable_kind kind = hs_env_variable_kind(fix->env, variable);
    if (kind == HS_NUMBER_VARIABLE) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT,
                   kind == HS_NO_VARIABLE     ? "%s: there is no variable '%s' that has a value"
                   : kind == HS_ATOM_VARIABLE ? "%s: the variable '%s' must be of style equal, not atom"
                                              : "%s: the variable '%s' must be of style equal, not vector",
                   hs_fix_who(fix).text, variable);
}

hs_status hs_varying_check(const hs_varying *number, const hs_fix *fix, hs_error *err)
{
    return number->variable == NULL ? HS_OK : hs_fix_need_equal_style(fix, number->variable, err);
}

hs_status hs_varying_update(hs_varying *number, const hs_env *env, hs_error *err)
{
    return number->variable == NULL ? HS_OK : env->variable_value(env->deck, number->variable, &number->value, err);
}

hs_status hs_next_step(const hs_env *env, const char *variable, const char *who, const char *what, int64_t *next,
                       hs_error *err)
{
    double value;
    if (env->variable_value == NULL)
        return hs_fail(err, HS_ERROR_INPUT, "%s: there is no variable '%s'", who, variable);
    HS_TRY(env->variable_value(env->deck, variable, &value, err));
    if (!(value > (double)env->step))
        return hs_fail(err, HS_ERROR_INPUT,
                       "%s: the variable '%s' gave %g as the step of the next %s, which must be greater than the "
                       "present step, %lld",
                       who, variable, value, what, (long long)env->step);
    *next = value < 9e18 ? (int64_t)value : INT64_MAX; /* stride() and the like say "never" with 2^63 */
    return HS_OK;
}
