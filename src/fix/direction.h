/** What fix lineforce and planeforce share: a direction, and forces that are cut into their parts along it and
 *  across. */
#ifndef HS_FIX_DIRECTION_H
#define HS_FIX_DIRECTION_H

#include "style/fix.h"
#include "style/unit_vector.h"

typedef struct direction_state {
    double direction[3]; /**< of length 1 */
} direction_state;

static inline hs_status direction_create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    direction_state *state = fix->state;
    HS_TRY(hs_syntax_check(&fix->style->about.syntax, args, false, err));
    return hs_arg_direction(args, 0, state->direction, err);
}

/** f = along (f.d) d + across (f - (f.d) d) for this thread's share of the group. */
static inline void direction_scale(const hs_fix *fix, double along, double across)
{
    const hs_atoms *atoms = fix->env->atoms;
    const double *d = ((const direction_state *)fix->state)->direction;
#pragma omp for schedule(static) nowait
    for (int i = 0; i < atoms->n_local; ++i) {
        if (!(atoms->mask[i] & fix->mask)) continue;
        const double part = atoms->f[0][i] * d[0] + atoms->f[1][i] * d[1] + atoms->f[2][i] * d[2];
        for (int axis = 0; axis < 3; ++axis)
            atoms->f[axis][i] = across * atoms->f[axis][i] + (along - across) * part * d[axis];
    }
}

#endif
