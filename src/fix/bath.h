/** The temperature that a thermostat aims at: a ramp over the run, or a variable. */
#ifndef HS_FIX_BATH_H
#define HS_FIX_BATH_H

#include "style/varying.h"

typedef struct bath_ramp {
    hs_varying start; /**< of the ramp; a variable is the temperature at every step */
    double stop;
} bath_ramp;

/** Words i (Tstart or v_name) and i + 1 (Tstop). */
static inline hs_status bath_read(bath_ramp *bath, const hs_args *args, int i, hs_error *err)
{
    HS_TRY(hs_varying_read(&bath->start, args, i, err));
    if (bath->start.variable == NULL) HS_TRY(hs_arg_not_negative(args, i, &bath->start.value, err));
    return hs_arg_not_negative(args, i + 1, &bath->stop, err);
}

/** The temperature at the present step (collective). */
static inline hs_status bath_now(const hs_fix *fix, bath_ramp *bath, double *t, hs_error *err)
{
    HS_TRY(hs_varying_update(&bath->start, fix->env, err));
    *t = bath->start.value;
    if (bath->start.variable == NULL) *t += hs_env_ramp(fix->env) * (bath->stop - bath->start.value);
    if (*t >= 0.0) return HS_OK;
    return hs_fail(err, HS_ERROR_RUN, "%s: the temperature %g is below 0", hs_fix_who(fix).text, *t);
}

#endif
