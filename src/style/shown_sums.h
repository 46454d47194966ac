/** Hooks of fixes that add forces to atoms and show what these sum to: three components f_ID[1] ... f_ID[3], and an
 *  energy f_ID. The fix's state begins with the hs_late_sums of these four, in this order. */
#ifndef HS_STYLE_SHOWN_SUMS_H
#define HS_STYLE_SHOWN_SUMS_H

#include "style/atom_sum.h"
#include "style/fix.h"

enum { HS_SHOWN_ENERGY = 3, HS_N_SHOWN };

static inline hs_status hs_shown_vector(hs_fix *fix, int i, double *value, hs_error *err)
{
    (void)err;
    *value = hs_late_sums_read(fix->state, fix->env->parallel)[i];
    return HS_OK;
}

static inline hs_status hs_shown_energy(hs_fix *fix, double *value, hs_error *err)
{
    return hs_shown_vector(fix, HS_SHOWN_ENERGY, value, err);
}

static inline hs_status hs_shown_keep_state(hs_fix *fix, hs_state *kept, hs_error *err)
{
    hs_late_sums *sums = fix->state;
    (void)hs_late_sums_read(sums, fix->env->parallel);
    return hs_state_double(kept, "sums", sums->value, HS_N_SHOWN, err);
}

/** All of them. */
#define HS_SHOWN_HOOKS                                                                                                 \
    .keep_state = hs_shown_keep_state, .scalar = hs_shown_energy, .vector = hs_shown_vector, .n_vector = 3,            \
    .is_extensive = true, .is_vector_extensive = true, .has_energy = true

#endif
