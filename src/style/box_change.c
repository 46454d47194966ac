#include "style/box_change.h"

#include <math.h>

static inline double rounded(double length, double magic) { return (length + magic) - magic; }

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

static void change_bounds(hs_env *env, const double lo[3], const double hi[3], uint32_t mask)
{
    hs_box *box = env->box;
    hs_atoms *atoms = env->atoms;
    const double magic = env->position_magic;
    for (int axis = 0; axis < 3; ++axis) {
        const double new_lo = rounded(lo[axis], magic), new_hi = rounded(hi[axis], magic);
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
}

hs_box_map hs_box_map_make(const hs_box *from, const hs_box *to)
{
    hs_box_map r = {.from = *from, .to = *to};
    for (int axis = 0; axis < 3; ++axis) {
        r.inv_length[axis] = 1.0 / hs_box_length(from, axis);
        r.corner[axis] = to->lo[axis] - from->lo[axis];
        r.length[axis] = hs_box_length(to, axis) - hs_box_length(from, axis);
        r.tilt[axis] = to->tilt[axis] - from->tilt[axis];
    }
    return r;
}

static inline void find_fractions(const hs_box_map *r, const double x[3], double fraction[3])
{
    const double *lo = r->from.lo, *tilt = r->from.tilt;
    fraction[2] = (x[2] - lo[2]) * r->inv_length[2];
    fraction[1] = (x[1] - lo[1] - tilt[2] * fraction[2]) * r->inv_length[1];
    fraction[0] = (x[0] - lo[0] - tilt[0] * fraction[1] - tilt[1] * fraction[2]) * r->inv_length[0];
}

static inline bool is_part(double fraction) { return fraction >= 0.0 && fraction < 1.0; }

/** The edges between a place and its image in the box: taken off. */
static void take_off_images(const hs_box_map *r, double x[3], double fraction[3], int32_t n[3])
{
    double shift[3];
    for (int axis = 0; axis < 3; ++axis)
        if (r->from.periodic[axis] && fabs(fraction[axis]) < HS_BOX_FARTHEST) n[axis] = (int32_t)floor(fraction[axis]);
    hs_box_shift(&r->from, n, shift);
    for (int axis = 0; axis < 3; ++axis) x[axis] -= shift[axis];
    find_fractions(r, x, fraction);
}

static inline void follow(const hs_box_map *r, double magic, double x[3])
{
    double fraction[3], shift[3] = {0.0, 0.0, 0.0};
    find_fractions(r, x, fraction);
    if (!(is_part(fraction[0]) && is_part(fraction[1]) && is_part(fraction[2]))) {
        int32_t n[3] = {0, 0, 0};
        take_off_images(r, x, fraction, n);
        hs_box_shift(&r->to, n, shift);
    }
    const double moved[3] = {r->corner[0] + fraction[0] * r->length[0] + fraction[1] * r->tilt[0] +
                                 fraction[2] * r->tilt[1],
                             r->corner[1] + fraction[1] * r->length[1] + fraction[2] * r->tilt[2],
                             r->corner[2] + fraction[2] * r->length[2]};
    for (int axis = 0; axis < 3; ++axis) x[axis] = hs_moved(x[axis], moved[axis], magic) + shift[axis];
}

void hs_box_map_move(const hs_box_map *map, double magic, double x[3]) { follow(map, magic, x); }

static void change_tilted(hs_env *env, const double lo[3], const double hi[3], const double tilt[3], uint32_t mask)
{
    hs_atoms *atoms = env->atoms;
    const hs_box from = *env->box;
    hs_box to = from;
    for (int axis = 0; axis < 3; ++axis) {
        to.lo[axis] = rounded(lo[axis], env->position_magic);
        to.hi[axis] = rounded(hi[axis], env->position_magic);
        if (tilt != NULL) to.tilt[axis] = rounded(tilt[axis], env->position_magic);
    }
    const hs_box_map change = hs_box_map_make(&from, &to);
#pragma omp parallel for schedule(static)
    for (int i = 0; i < atoms->n_local; ++i) {
        double x[3] = {atoms->x[0][i], atoms->x[1][i], atoms->x[2][i]};
        if (!(atoms->mask[i] & mask)) continue;
        follow(&change, env->position_magic, x);
        for (int axis = 0; axis < 3; ++axis) atoms->x[axis][i] = x[axis];
    }
    *env->box = to;
}

void hs_box_change(hs_env *env, const double lo[3], const double hi[3], const double tilt[3], uint32_t mask)
{
    if (env->box->is_tilted)
        change_tilted(env, lo, hi, tilt, mask);
    else
        change_bounds(env, lo, hi, mask);
    hs_env_changed(env);
}

void hs_box_flip(hs_env *env, const int32_t n[3])
{
    hs_box *box = env->box;
    hs_atoms *atoms = env->atoms;
    box->tilt[1] += n[1] * hs_box_length(box, 0) + n[2] * box->tilt[0];
    box->tilt[0] += n[0] * hs_box_length(box, 0);
    box->tilt[2] += n[2] * hs_box_length(box, 1);
    /* i a + j b + k c is the same vector: the new b and c hold n[0] a, and n[1] a + n[2] b with the old b */
#pragma omp parallel for schedule(static)
    for (int i = 0; i < atoms->n_local; ++i) {
        const int32_t k = atoms->image[2][i], j = atoms->image[1][i] - n[2] * k;
        atoms->image[0][i] -= n[1] * k + n[0] * j;
        atoms->image[1][i] = j;
    }
    hs_env_changed(env);
}

void hs_box_wrap_flowing(hs_env *env, const double rate[3][3], uint32_t mask)
{
    hs_atoms *atoms = env->atoms;
#pragma omp parallel for schedule(static)
    for (int i = 0; i < atoms->n_local; ++i) {
        double x[3] = {atoms->x[0][i], atoms->x[1][i], atoms->x[2][i]};
        int32_t n[3] = {0, 0, 0};
        hs_box_wrap(env->box, x, n);
        for (int axis = 0; axis < 3; ++axis) {
            atoms->x[axis][i] = x[axis];
            atoms->image[axis][i] += n[axis];
            for (int edge = axis; edge < 3 && (atoms->mask[i] & mask); ++edge)
                atoms->v[axis][i] -= n[edge] * rate[edge][axis];
        }
    }
    hs_env_changed(env);
}
