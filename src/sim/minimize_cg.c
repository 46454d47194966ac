/* Minimisation along lines: conjugate gradients and steepest descent.
 *
 * cg takes each new direction from the forces and the direction before, d = f + beta d, beta = max(0, f.(f - f_before) / f_before^2):
 * the form of Polak and Ribiere, which begins anew, with the forces, where beta would be negative, and after as many iterations as there
 * are coordinates. sd takes the forces.
 * Source: E. Polak, G. Ribiere, Rev. Fr. Inform. Rech. Oper. 3, 35 (1969); J. Nocedal, S. J. Wright, Numerical Optimization (2006),
 * chapter 5, doi:10.1007/978-0-387-40065-5. */
#include <math.h>

#include "sim/minimizer.h"

static void turn_share(hs_minimizer *min, double beta)
{
    const hs_atoms *atoms = &min->sim->atoms;
    for (int axis = 0; axis < 3; ++axis) {
        const double *restrict f = atoms->f[axis];
        double *restrict direction = min->direction[axis], *restrict before = min->before[axis];
#pragma omp for schedule(static) nowait
        for (int i = 0; i < atoms->n_local; ++i) {
            direction[i] = f[i] + beta * direction[i];
            before[i] = f[i];
        }
    }
}

/** direction = forces + beta direction, before = forces. */
static void turn(hs_minimizer *min, double beta)
{
    HS_ON_THREADS(turn_share(min, beta));
    hs_min_turn_box(min, beta);
}

static void begin(hs_minimizer *min)
{
    hs_min_sums sums;
    turn(min, 0.0);
    hs_min_add_up(min, &sums);
    min->squared = sums.force_force;
    min->n_since_begin = 0;
}

static hs_status move(hs_minimizer *min, hs_min_reason *reason, hs_error *err)
{
    HS_TRY(hs_min_search_line(min, reason, err));
    HS_TRY(hs_min_renew_box(min, err));
    if (*reason == HS_MIN_GOES_ON) *reason = hs_min_check(min, true);
    return HS_OK;
}

static hs_status iterate_cg(hs_minimizer *min, hs_min_reason *reason, hs_error *err)
{
    HS_TRY(move(min, reason, err));
    if (*reason != HS_MIN_GOES_ON) return HS_OK;
    hs_min_sums sums;
    hs_min_add_up(min, &sums);
    if (min->squared == 0.0) {
        *reason = HS_MIN_NO_FORCES;
        return HS_OK;
    }
    double beta = fmax(0.0, (sums.force_force - sums.force_before) / min->squared);
    if (++min->n_since_begin % (3 * min->sim->atoms.n_all + hs_min_count_box(min)) == 0) beta = 0.0;
    min->squared = sums.force_force;
    turn(min, beta);
    hs_min_add_up(min, &sums);
    if (sums.force_direction <= 0.0) turn(min, 0.0);
    return HS_OK;
}

static hs_status iterate_sd(hs_minimizer *min, hs_min_reason *reason, hs_error *err)
{
    HS_TRY(move(min, reason, err));
    if (*reason == HS_MIN_GOES_ON) turn(min, 0.0);
    return HS_OK;
}

const hs_min_style hs_min_style_cg = {.name = "cg",
                                      .summary = "conjugate gradients (Polak-Ribiere)",
                                      .has_direction = true,
                                      .begin = begin,
                                      .iterate = iterate_cg};
const hs_min_style hs_min_style_sd = {.name = "sd",
                                      .summary = "steepest descent: robust, slow",
                                      .has_direction = true,
                                      .begin = begin,
                                      .iterate = iterate_sd};
