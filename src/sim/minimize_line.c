/* Line searches: how far to go along the search direction.
 *
 * The first try is the whole direction, or as far as dmax and the box allow. A place is taken when the energy has
 * fallen by at least 0.4 of what the slope at the start promises (the condition of Armijo); else half the distance is
 * tried. `quadratic` tries the place where the slope, a straight line through its two last values, would vanish, if
 * energy and slopes so far agree with such a parabola, and takes it where the energy has not risen by more than
 * rounding may. As in LAMMPS a place whose parabola was tried in vain is not taken itself.
 * Source: J. Nocedal, S. J. Wright, Numerical Optimization (2006), chapter 3, doi:10.1007/978-0-387-40065-5. */
#include <math.h>

#include "sim/minimizer.h"

static const double alpha_max = 1.0;
static const double wanted_part = 0.4; /* of the decrease that the slope promises */
static const double shrink = 0.5;
static const double negligible = 1e-8; /* change of the energy that means nothing, by min->energy_scale */
static const double parabola_error = 0.1;
static const double flat = 1e-28; /* slopes that differ by less tell nothing, by min->energy_scale */

/** A try: how far, its energy, and the force along the direction. */
typedef struct place {
    double alpha, energy, slope;
} place;

/** Move from what alpha is now to @p alpha. Displacements are rounded apart, so that alpha 0 is where the atoms
 *  began, bit by bit. */
static void move_share(hs_minimizer *min, double alpha)
{
    const hs_atoms *atoms = &min->sim->atoms;
    const double magic = min->sim->env.position_magic, before = min->alpha;
    for (int axis = 0; axis < 3; ++axis) {
        double *restrict x = atoms->x[axis];
        const double *restrict direction = min->direction[axis];
#pragma omp for schedule(static) nowait
        for (int i = 0; i < atoms->n_local; ++i) {
            const double from = hs_moved(0.0, before * direction[i], magic);
            x[i] += hs_moved(0.0, alpha * direction[i], magic) - from;
        }
    }
}

static hs_status go_to(hs_minimizer *min, double alpha, place *there, hs_error *err)
{
    if (min->box.fix != NULL)
        hs_min_go_with_box(min, alpha);
    else
        HS_ON_THREADS(move_share(min, alpha));
    min->alpha = alpha;
    HS_TRY(hs_min_evaluate(min, err));
    hs_min_sums sums;
    hs_min_add_up(min, &sums);
    *there = (place){alpha, min->energy, sums.force_direction};
    return HS_OK;
}

/** Whether the slopes tell of no parabola: they do not differ, or there are no forces any more (spheres that have come apart). As in
 *  LAMMPS the search then ends where it began. */
static bool is_flat(const hs_minimizer *min, const place *last, const place *now)
{
    const double least = flat / min->energy_scale;
    return fabs(now->slope) < least || fabs(last->slope - now->slope) < least;
}

/** Where the slope would vanish; 0 when the last two places are no part of a parabola that says so. */
static double parabola_minimum(const place *last, const place *now, double limit)
{
    const double change = last->slope - now->slope;
    const double step = now->alpha - last->alpha;
    /* energy that the slopes would lead from the place before to this one */
    const double error = fabs(1.0 - (0.5 * step * (now->slope + last->slope) + now->energy) / last->energy);
    const double alpha = now->alpha + step * now->slope / change;
    return error <= parabola_error && alpha > 0.0 && alpha < limit ? alpha : 0.0;
}

hs_status hs_min_search_line(hs_minimizer *min, hs_min_reason *reason, hs_error *err)
{
    hs_min_sums sums;
    hs_min_add_up(min, &sums);
    const place start = {0.0, min->energy, sums.force_direction};
    const double largest = hs_min_largest(min, min->direction);
    hs_min_begin_line_of_box(min);
    min->alpha = 0.0;
    *reason = HS_MIN_GOES_ON;
    if (start.slope <= 0.0) {
        *reason = HS_MIN_UPHILL;
        return HS_OK;
    }
    if (largest == 0.0 && hs_min_largest_of_box(min, min->box.direction) == 0.0) {
        *reason = HS_MIN_NO_FORCES;
        return HS_OK;
    }
    const double limit =
        fmin(fmin(alpha_max, hs_min_limit_of_box(min)), largest > 0.0 ? min->settings->dmax / largest : alpha_max);
    const bool is_quadratic = min->settings->line == HS_LINE_QUADRATIC;
    const double too_little = negligible / min->energy_scale;
    place last = start, now, tried;
    for (double alpha = limit;; alpha *= shrink) {
        min->alpha_tried = alpha;
        HS_TRY(go_to(min, alpha, &now, err));
        if (is_quadratic && is_flat(min, &last, &now)) {
            *reason = HS_MIN_FLAT;
            return go_to(min, 0.0, &tried, err);
        }
        const double best = is_quadratic ? parabola_minimum(&last, &now, limit) : 0.0;
        if (best > 0.0 && best != alpha) {
            HS_TRY(go_to(min, best, &tried, err));
            if (tried.energy - start.energy < too_little) return HS_OK;
            now.energy = tried.energy; /* the next parabola is judged by it, as in LAMMPS */
        } else if (now.energy <= start.energy - wanted_part * now.alpha * start.slope) {
            return HS_OK;
        }
        if (wanted_part * alpha * start.slope <= too_little) break;
        last = now;
    }
    min->alpha_tried *= shrink;
    *reason = HS_MIN_ALPHA;
    return go_to(min, 0.0, &tried, err);
}
