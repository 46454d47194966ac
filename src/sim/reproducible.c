/* Reproducible runs: positions on a power-of-two grid, forces and energies in fixed point. docs/architecture.md,
 * Numbers. */
#include <math.h>

#include "sim/violation.h"

/* A pair's force may grow by this factor before a run must go over to a coarser grid. */
static const double headroom = 8.0;
/* By this power of two a run's grid may be coarser than its forces need, before it goes over to a finer one at any step. */
enum { COARSE_BITS = 10 };
/* Forces and energies from here on have no grid (and are none that a run could go on with). */
static const double too_large = 1e250;
/* Where the search for the grid starts: good for energies and lengths of order one. */
enum { FIRST_FORCE_EXPONENT = -40 };

/** Positions and their differences are exact while coordinates are below 2^51 grid units. */
enum { POSITION_BITS = 51 };

static double rounded(double x, double magic) { return (x + magic) - magic; }

/** The same for a tilted box: places that are a box, or the reach of a halo, away from it along its edges. */
static int tilted_exponent(const hs_box *box, double reach)
{
    double farthest = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        double fraction[3], x[3];
        for (int axis = 0; axis < 3; ++axis) {
            const double beyond = fmax(1.0, reach / hs_box_thickness(box, axis));
            fraction[axis] = corner >> axis & 1 ? 1.0 + beyond : -beyond;
        }
        hs_box_place(box, fraction, x);
        for (int axis = 0; axis < 3; ++axis) farthest = fmax(farthest, fabs(x[axis]));
    }
    return hs_fixed_exponent(farthest, POSITION_BITS);
}

/** Exponent of the position grid: the finest on which every place that an atom or a halo atom can have is exact. */
static int position_exponent(const hs_sim *sim)
{
    const double reach = sim->pair->cutoff_max + sim->neighbor.settings.skin;
    double farthest = 0.0;
    if (sim->box.is_tilted) return tilted_exponent(&sim->box, reach);
    for (int axis = 0; axis < 3; ++axis) {
        const double edge = fmax(fabs(sim->box.lo[axis]), fabs(sim->box.hi[axis]));
        farthest = fmax(farthest, edge + fmax(hs_box_length(&sim->box, axis), reach));
    }
    return hs_fixed_exponent(farthest, POSITION_BITS);
}

void hs_sim_round_box(hs_box *box, double magic)
{
    for (int axis = 0; axis < 3; ++axis) {
        if (!box->periodic[axis]) continue;
        box->lo[axis] = rounded(box->lo[axis], magic);
        box->hi[axis] = rounded(box->hi[axis], magic);
    }
    for (int k = 0; k < 3; ++k) box->tilt[k] = rounded(box->tilt[k], magic);
}

void hs_sim_round_positions(hs_sim *sim)
{
    const double magic = sim->env.position_magic;
    hs_atoms *atoms = &sim->atoms;
    if (magic == 0.0) return;
    for (int axis = 0; axis < 3; ++axis) {
        double *x = atoms->x[axis];
#pragma omp parallel for schedule(static)
        for (int i = 0; i < atoms->n_local; ++i) x[i] = rounded(x[i], magic);
    }
}

hs_status hs_sim_setup_reproducible(hs_sim *sim, hs_error *err)
{
    const bool is_mixed = sim->precision == HS_PRECISION_MIXED;
    if (is_mixed && sim->reproducible == HS_REPRODUCIBLE_ON)
        return hs_fail(err, HS_ERROR_INPUT,
                       "run: reproducible runs need double precision; choose 'precision double' or 'reproducible off'");
    if (is_mixed && sim->env.units->is_extreme)
        return hs_fail(
            err, HS_ERROR_INPUT,
            "run: in %s units powers of distances do not fit into mixed precision; choose 'precision double'",
            sim->env.units->name);
    const bool is_on = !is_mixed && sim->reproducible != HS_REPRODUCIBLE_OFF;
    sim->kernel_precision = is_on ? HS_PRECISION_FIXED : sim->precision;
    sim->force_exponent = FIRST_FORCE_EXPONENT;
    sim->env.position_magic = 0.0;
    hs_sim_settle_positions(sim);
    return HS_OK;
}

void hs_sim_settle_positions(hs_sim *sim)
{
    if (sim->kernel_precision != HS_PRECISION_FIXED) return;
    const double magic = ldexp(1.5, 52 + position_exponent(sim));
    if (magic == sim->env.position_magic) return;
    sim->env.position_magic = magic;
    hs_sim_round_box(&sim->box, magic);
    hs_sim_round_positions(sim);
}

/** Energies and virials of pairs whose forces fit their grid, |F| < 2^(force + HS_FIXED_BITS), are below r_c times
 *  that: the least coarse grid they fit. */
static int energy_exponent(int force_exponent, double cutoff) { return hs_fixed_exponent(cutoff, 0) + force_exponent; }

void hs_sim_begin_grid(hs_sim *sim)
{
    sim->grid.force = sim->force_exponent;
    sim->grid.energy = energy_exponent(sim->grid.force, sim->pair->cutoff_max);
}

hs_status hs_sim_fit_grid(hs_sim *sim, const hs_force_result *result, bool *fits, hs_error *err)
{
    double peak[2] = {result->peak_force * sim->pair->cutoff_max, result->peak_energy};
    if (sim->parallel.n_ranks > 1) {
        hs_timer_add(&sim->timer, HS_PHASE_PAIR);
        hs_parallel_max_double(&sim->parallel, peak, 2);
        hs_timer_add_comm(&sim->timer, HS_COMM_AGREE);
    }
    *fits = true;
    sim->env.peak_force = peak[0];
    sim->env.peak_energy = peak[1];
    if (!(peak[0] < too_large) || !(peak[1] < too_large)) return hs_sim_report_overlap(sim, err);
    const int needed = peak[0] > 0.0 ? hs_fixed_exponent(peak[0] * headroom, HS_FIXED_BITS) : sim->grid.force;
    if (peak[0] >= ldexp(1.0, sim->grid.force + HS_FIXED_BITS)) {
        sim->force_exponent = needed;
        hs_sim_begin_grid(sim);
        *fits = false;
    }
    if (peak[1] >= ldexp(1.0, sim->grid.energy + HS_FIXED_BITS)) {
        sim->grid.energy = hs_fixed_exponent(peak[1] * headroom, HS_FIXED_BITS);
        *fits = false;
    }
    /* On a grid that a collision has left behind the forces after it would be rounded away. */
    if (*fits && sim->grid.force - needed > COARSE_BITS) {
        sim->force_exponent = needed;
        hs_sim_begin_grid(sim);
        *fits = false;
    }
    /* Else a run goes over to a finer grid at scheduled list builds only, which do not depend on ranks, threads or method. The
       first forces of all start on it. */
    if (*fits && sim->neighbor.ago == 0) {
        const bool is_first = !sim->is_initialized && needed < sim->grid.force;
        sim->force_exponent = needed;
        if (is_first) hs_sim_begin_grid(sim);
        *fits = !is_first;
    }
    return HS_OK;
}
