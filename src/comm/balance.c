#include "comm/balance.h"

#include <math.h>

#include "base/memory.h"

/* Places tried between the bounds of a plane in one iteration. */
enum { N_TRIES = 15 };

hs_status hs_balance_read_axes(hs_balance *balance, const char *word, int dimension, const char *command, hs_error *err)
{
    balance->n_axes = 0;
    for (const char *c = word; *c != '\0'; ++c) {
        bool is_good = *c >= 'x' && *c <= 'z' && balance->n_axes < HS_BALANCE_AXES_MAX;
        for (int k = 0; is_good && k < balance->n_axes; ++k) is_good = balance->axis[k] != *c - 'x';
        if (!is_good)
            return hs_fail(err, HS_ERROR_INPUT, "%s: '%s' must be the letters x, y, z, each at most once", command,
                           word);
        if (*c == 'z' && dimension == 2)
            return hs_fail(err, HS_ERROR_INPUT, "%s: '%s': in two dimensions there is nothing to balance along z",
                           command, word);
        balance->axis[balance->n_axes++] = *c - 'x';
    }
    if (balance->n_axes > 0) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "%s: the axes whose planes are to be moved are missing", command);
}

void hs_balance_take_rcb(hs_balance *balance, int dimension)
{
    balance->n_axes = dimension;
    for (int axis = 0; axis < dimension; ++axis) balance->axis[axis] = axis;
    balance->n_iterations = 10;
    balance->stop_factor = 1.05;
}

void hs_balance_measure(const hs_parallel *parallel, double load, double *largest, double *factor)
{
    double mean = load;
    *largest = load;
    hs_parallel_max_double(parallel, largest, 1);
    hs_parallel_sum_double(parallel, &mean, 1);
    mean /= parallel->n_ranks > 1 ? parallel->n_ranks : 1;
    *factor = mean > 0.0 ? *largest / mean : 1.0;
}

/** Place of an atom along an axis as a fraction of the box, wrapped into it. */
static double fraction_of(const hs_balance_work *of, int axis, int i)
{
    const hs_box *box = of->box;
    const hs_atoms *atoms = of->atoms;
    const double x = hs_box_upright(box, (const double[3]){atoms->x[0][i], atoms->x[1][i], atoms->x[2][i]}, axis);
    const double fraction = (x - box->lo[axis]) / hs_box_length(box, axis);
    if (box->periodic[axis]) return fraction - floor(fraction);
    return fraction < 0.0 ? 0.0 : fraction > 1.0 ? 1.0 : fraction;
}

static int owner_of(const hs_domain *domain, int axis, double fraction)
{
    int k = 0;
    while (k + 1 < domain->n[axis] && fraction >= domain->cut[axis][k + 1]) ++k;
    return k;
}

static double cost_of(const hs_balance_work *work, int i) { return work->cost != NULL ? work->cost[i] : 1.0; }

hs_status hs_balance_predict(const hs_domain *domain, const hs_balance_work *work, double *load, hs_error *err)
{
    double *loads = NULL;
    HS_UNLESS_FAILED(err, HS_ALLOC(loads, (size_t)domain->n_ranks, err));
    HS_TRY(hs_parallel_agree(work->parallel, err));
    for (int i = 0; i < work->atoms->n_local; ++i) {
        int at[3];
        for (int axis = 0; axis < 3; ++axis) at[axis] = owner_of(domain, axis, fraction_of(work, axis, i));
        loads[hs_domain_rank(domain, at)] += cost_of(work, i);
    }
    hs_parallel_sum_double(work->parallel, loads, domain->n_ranks);
    *load = loads[domain->rank];
    HS_FREE(loads);
    return HS_OK;
}

/** An atom's place, from 0 to 1, and its cost. */
typedef struct placed {
    double place, weight;
} placed;

/** Atoms sorted by their places into so many drawers of equal width, in any order within. */
typedef struct drawers {
    placed *item;   /**< owned [n] */
    int64_t *start; /**< owned [n_drawers + 1]: first item of each */
    double *below;  /**< owned [n_drawers + 1]: weight in the drawers before each */
    int64_t n, n_drawers;
} drawers;

static int64_t drawer_of(const drawers *d, double value)
{
    const int64_t drawer = (int64_t)(value * (double)d->n_drawers);
    return drawer < d->n_drawers ? drawer : d->n_drawers - 1;
}

static void fini_drawers(drawers *d)
{
    HS_FREE(d->item);
    HS_FREE(d->start);
    HS_FREE(d->below);
}

/** The local atoms by their places along an axis, as fractions of the box. */
static hs_status fill_drawers(drawers *d, const hs_balance_work *work, int axis, hs_error *err)
{
    enum { VALUES_A_DRAWER = 16 };
    d->n = work->atoms->n_local;
    d->n_drawers = d->n / VALUES_A_DRAWER + 1;
    HS_TRY(HS_ALLOC(d->item, (size_t)d->n, err));
    HS_TRY(HS_ALLOC(d->below, (size_t)d->n_drawers + 1, err));
    HS_TRY(HS_ALLOC(d->start, (size_t)d->n_drawers + 2, err)); /* zeroed; one place on while they are filled */
    int64_t *next = d->start + 1;
    for (int i = 0; i < d->n; ++i) ++next[drawer_of(d, fraction_of(work, axis, i)) + 1];
    for (int64_t k = 0; k < d->n_drawers; ++k) next[k + 1] += next[k];
    for (int i = 0; i < d->n; ++i) {
        const double place = fraction_of(work, axis, i);
        const int64_t drawer = drawer_of(d, place);
        d->item[next[drawer]++] = (placed){.place = place, .weight = cost_of(work, i)};
        d->below[drawer + 1] += cost_of(work, i);
    }
    for (int64_t k = 0; k < d->n_drawers; ++k) d->below[k + 1] += d->below[k];
    return HS_OK;
}

/** Weight below a place. */
static double weight_below(const drawers *d, double place)
{
    const int64_t drawer = drawer_of(d, place);
    double weight = d->below[drawer];
    for (int64_t k = d->start[drawer]; k < d->start[drawer + 1]; ++k)
        if (d->item[k].place < place) weight += d->item[k].weight;
    return weight;
}

/** One plane on its way: it is between lo and hi, with so much work below lo. */
typedef struct bracket {
    double lo, hi, work_lo;
} bracket;

/** The planes of one axis on their way. */
typedef struct search {
    drawers place; /**< of the local atoms */
    double total;
    bracket *plane; /**< owned [n_planes]: those within the box */
    double *work;   /**< owned [n_planes * N_TRIES] */
    int n_planes;
} search;

/** Find out how much work of all ranks is below each tried place, and narrow the brackets (collective). */
static void narrow(search *s, const hs_parallel *parallel)
{
    for (int k = 0; k < s->n_planes; ++k)
        for (int t = 0; t < N_TRIES; ++t) {
            const bracket *b = &s->plane[k];
            const double place = b->lo + (b->hi - b->lo) * (t + 1) / (N_TRIES + 1);
            s->work[k * N_TRIES + t] = weight_below(&s->place, place);
        }
    hs_parallel_sum_double(parallel, s->work, s->n_planes * N_TRIES);
    for (int k = 0; k < s->n_planes; ++k) {
        bracket *b = &s->plane[k];
        const bracket before = *b;
        const double wanted = s->total * (k + 1) / (s->n_planes + 1);
        for (int t = 0; t < N_TRIES; ++t) {
            const double place = before.lo + (before.hi - before.lo) * (t + 1) / (N_TRIES + 1);
            const double work = s->work[k * N_TRIES + t];
            if (work <= wanted && place > b->lo) b->lo = place, b->work_lo = work;
            if (work > wanted && place < b->hi) b->hi = place;
        }
    }
}

/** Largest work of a slab relative to the mean, planes being at the lower ends of their brackets. */
static double factor_of(const search *s)
{
    double below = 0.0, largest = 0.0;
    for (int k = 0; k <= s->n_planes; ++k) {
        const double work = k < s->n_planes ? s->plane[k].work_lo : s->total;
        if (work - below > largest) largest = work - below;
        below = work;
    }
    return s->total > 0.0 ? largest * (s->n_planes + 1) / s->total : 1.0;
}

/** Put the planes where they were found, no closer to each other than bricks may be thin. */
static void place_planes(const search *s, double *cut, double least)
{
    const int n = s->n_planes + 1;
    if (!(least * n < 1.0)) least = 0.5 / n;
    for (int k = 1; k < n; ++k) cut[k] = fmax(s->plane[k - 1].lo, cut[k - 1] + least);
    for (int k = n - 1; k > 0; --k) cut[k] = fmin(cut[k], cut[k + 1] - least);
}

static hs_status begin_search(search *s, const hs_balance_work *work, int axis, hs_error *err)
{
    HS_TRY(fill_drawers(&s->place, work, axis, err));
    HS_TRY(HS_ALLOC(s->plane, (size_t)s->n_planes, err));
    return HS_ALLOC(s->work, (size_t)s->n_planes * N_TRIES, err);
}

static hs_status shift_axis(const hs_balance *balance, hs_domain *domain, const hs_balance_work *work, int axis,
                            int *n_iterations, hs_error *err)
{
    search s = {.n_planes = domain->n[axis] - 1};
    HS_UNLESS_FAILED(err, begin_search(&s, work, axis, err));
    if (hs_parallel_agree(work->parallel, err) == HS_OK) {
        s.total = s.place.below[s.place.n_drawers];
        hs_parallel_sum_double(work->parallel, &s.total, 1);
        for (int k = 0; k < s.n_planes; ++k) s.plane[k] = (bracket){.hi = 1.0};
        for (int iteration = 0; iteration < balance->n_iterations; ++iteration) {
            narrow(&s, work->parallel);
            ++*n_iterations;
            if (factor_of(&s) <= balance->stop_factor) break;
        }
        if (s.total > 0.0)
            place_planes(&s, domain->cut[axis], balance->least_width / hs_box_thickness(work->box, axis));
    }
    fini_drawers(&s.place);
    HS_FREE(s.plane);
    HS_FREE(s.work);
    return err->status;
}

hs_status hs_balance_shift(const hs_balance *balance, hs_domain *domain, const hs_balance_work *work, int *n_iterations,
                           hs_error *err)
{
    *n_iterations = 0;
    for (int k = 0; k < balance->n_axes; ++k) {
        const int axis = balance->axis[k];
        if (domain->n[axis] > 1) HS_TRY(shift_axis(balance, domain, work, axis, n_iterations, err));
    }
    return err->status;
}
