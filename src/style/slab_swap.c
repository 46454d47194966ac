#include "style/slab_swap.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "core/atom_style.h"

static const char *const axes[] = {"x", "y", "z", NULL};

hs_status hs_slab_swap_read(hs_slab_swap *swap, const hs_fix *fix, const hs_args *args, int i, hs_error *err)
{
    int64_t n;
    HS_TRY(hs_arg_choice(args, i, axes, &swap->axis, err));
    HS_TRY(hs_arg_int(args, i + 1, 2, 1000000000, &n, err));
    if (n % 2 != 0) return hs_arg_refuse(args, i + 1, "an even number of layers", NULL, err);
    if (swap->axis == 2 && fix->env->box->dimension == 2)
        return hs_arg_refuse(args, i, "an axis of the plane", NULL, err);
    swap->n_bins = (int)n;
    return HS_OK;
}

/** A local atom that may exchange its velocity. */
typedef struct candidate {
    double rank;
    int64_t id;
    int index;
} candidate;

/** The best local candidates of both layers, in order. */
typedef struct candidates {
    candidate *of[2]; /**< owned [n_swaps] */
    int n[2];
    int next[2]; /**< place of the best one not yet taken */
} candidates;

static bool is_better(const candidate *a, const candidate *b)
{
    return a->rank < b->rank || (a->rank == b->rank && a->id < b->id);
}

static void offer(candidates *c, int slab, int n_max, const candidate *new)
{
    candidate *list = c->of[slab];
    int place = c->n[slab];
    if (place == n_max && !is_better(new, &list[--place])) return;
    for (; place > 0 && is_better(new, &list[place - 1]); --place) list[place] = list[place - 1];
    list[place] = *new;
    if (c->n[slab] < n_max) ++c->n[slab];
}

/** HS_SLAB_LOWEST, HS_SLAB_MIDDLE, or -1 for an atom in neither. Layers are parallel to the faces of the box. */
static int slab_of(const hs_slab_swap *swap, const hs_box *box, const hs_atoms *atoms, int i)
{
    const double place[3] = {atoms->x[0][i], atoms->x[1][i], atoms->x[2][i]};
    double x = hs_box_upright(box, place, swap->axis);
    const double lo = box->lo[swap->axis], length = hs_box_length(box, swap->axis), width = length / swap->n_bins;
    const int half = swap->n_bins / 2;
    if (box->periodic[swap->axis] && x < lo) x += length;
    if (box->periodic[swap->axis] && x >= box->hi[swap->axis]) x -= length;
    if (x >= lo && x < lo + width) return HS_SLAB_LOWEST;
    return x >= lo + half * width && x < lo + (half + 1) * width ? HS_SLAB_MIDDLE : -1;
}

static void find_candidates(const hs_slab_swap *swap, const hs_fix *fix, hs_slab_rank rank, candidates *c)
{
    const hs_atoms *atoms = fix->env->atoms;
    for (int i = 0; i < atoms->n_local; ++i) {
        if (!(atoms->mask[i] & fix->mask)) continue;
        const int slab = slab_of(swap, fix->env->box, atoms, i);
        if (slab < 0) continue;
        const candidate new = {rank(fix, i, slab), atoms->id[i], i};
        if (new.rank < INFINITY) offer(c, slab, swap->n_swaps, &new);
    }
}

/** The next pair of all ranks: mine[slab] is the local index of a partner that is here, else -1. False: a layer has
 *  none left. */
static bool next_pair(const hs_fix *fix, candidates *c, int mine[2])
{
    const hs_parallel *parallel = fix->env->parallel;
    double best[2];
    int64_t minus_id[2];
    for (int slab = 0; slab < 2; ++slab)
        best[slab] = c->next[slab] < c->n[slab] ? c->of[slab][c->next[slab]].rank : INFINITY;
    double own[2] = {best[0], best[1]};
    hs_parallel_min_double(parallel, best, 2);
    if (!(best[0] < INFINITY && best[1] < INFINITY)) return false;
    for (int slab = 0; slab < 2; ++slab)
        minus_id[slab] = own[slab] == best[slab] ? -c->of[slab][c->next[slab]].id : INT64_MIN;
    hs_parallel_max_int64(parallel, minus_id, 2);
    for (int slab = 0; slab < 2; ++slab) {
        mine[slab] = -1;
        if (own[slab] != best[slab] || c->of[slab][c->next[slab]].id != -minus_id[slab]) continue;
        mine[slab] = c->of[slab][c->next[slab]++].index;
    }
    return true;
}

/** Mass and velocity of both partners. */
enum { MASS, VELOCITY, N_VALUES = VELOCITY + 3 };

static void collide(const hs_fix *fix, const int mine[2], int first, int end, double value[2][N_VALUES],
                    double after[2][3])
{
    const hs_atoms *atoms = fix->env->atoms;
    memset(value, 0, 2 * sizeof value[0]);
    for (int slab = 0; slab < 2; ++slab) {
        if (mine[slab] < 0) continue;
        value[slab][MASS] = hs_atom_mass(atoms, mine[slab]);
        for (int axis = 0; axis < 3; ++axis) value[slab][VELOCITY + axis] = atoms->v[axis][mine[slab]];
    }
    hs_parallel_sum_double(fix->env->parallel, &value[0][0], 2 * N_VALUES); /* one rank's number and zeros: exact */
    const double *a = value[0], *b = value[1];
    for (int slab = 0; slab < 2; ++slab)
        for (int axis = 0; axis < 3; ++axis) {
            const double *own = &value[slab][VELOCITY + axis];
            const double center = (a[MASS] * a[VELOCITY + axis] + b[MASS] * b[VELOCITY + axis]) / (a[MASS] + b[MASS]);
            after[slab][axis] = axis >= first && axis < end ? 2.0 * center - *own : *own;
            if (mine[slab] >= 0) atoms->v[axis][mine[slab]] = after[slab][axis];
        }
}

hs_status hs_slab_swap_make(const hs_slab_swap *swap, hs_fix *fix, int first, int end, hs_slab_rank rank,
                            hs_slab_exchanged exchanged, hs_error *err)
{
    candidates c = {0};
    int mine[2];
    for (int slab = 0; slab < 2; ++slab) HS_UNLESS_FAILED(err, HS_ALLOC(c.of[slab], (size_t)swap->n_swaps, err));
    hs_status status = hs_parallel_agree(fix->env->parallel, err);
    if (status == HS_OK) find_candidates(swap, fix, rank, &c);
    for (int k = 0; status == HS_OK && k < swap->n_swaps && next_pair(fix, &c, mine); ++k) {
        double value[2][N_VALUES], after[2][3];
        collide(fix, mine, first, end, value, after);
        exchanged(fix, value[HS_SLAB_LOWEST][MASS], &value[HS_SLAB_LOWEST][VELOCITY], after[HS_SLAB_LOWEST]);
    }
    for (int slab = 0; slab < 2; ++slab) HS_FREE(c.of[slab]);
    hs_env_changed(fix->env);
    return status;
}
