#include "style/box_change.h"

#include <math.h>

/** New bounds of one axis. */
typedef struct stretch {
    double lo, length;    /**< before */
    double shift, strain; /**< an atom at x moves by shift + strain (x - lo), ... */
    double new_length;
    bool is_periodic;
} stretch;

static double stretched(const stretch *s, double x, double magic)
{
    /* An atom that has left the box, and not been wrapped yet, moves with its image in the box: the bits are then the same
       however often a neighbor method wraps. */
    double images = 0.0;
    if (s->is_periodic && !(x >= s->lo && x < s->lo + s->length)) images = floor((x - s->lo) / s->length);
    const double within = x - images * s->length;
    return hs_moved(within, s->shift + s->strain * (within - s->lo), magic) + images * s->new_length;
}

void hs_box_change(hs_env *env, const double lo[3], const double hi[3], uint32_t mask)
{
    hs_box *box = env->box;
    hs_atoms *atoms = env->atoms;
    const double magic = env->position_magic;
    for (int axis = 0; axis < 3; ++axis) {
        const double new_lo = (lo[axis] + magic) - magic, new_hi = (hi[axis] + magic) - magic;
        if (new_lo == box->lo[axis] && new_hi == box->hi[axis]) continue;
        stretch s = {.lo = box->lo[axis], .length = hs_box_length(box, axis), .is_periodic = box->periodic[axis]};
        s.new_length = new_hi - new_lo;
        s.shift = new_lo - s.lo;
        s.strain = (s.new_length - s.length) / s.length;
        double *x = atoms->x[axis];
#pragma omp parallel for schedule(static)
        for (int i = 0; i < atoms->n_local; ++i)
            if (atoms->mask[i] & mask) x[i] = stretched(&s, x[i], magic);
        box->lo[axis] = new_lo;
        box->hi[axis] = new_hi;
    }
    hs_env_changed(env);
}
