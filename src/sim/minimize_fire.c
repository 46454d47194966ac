/* Minimisation by damped dynamics: FIRE, the fast inertial relaxation engine.
 *
 * Atoms move by Newton's equations while they go downhill, f.v > 0, their velocities being turned towards the forces,
 * v = (1 - alpha) v + alpha f |v|/|f|; after delaystep such steps the timestep grows and alpha shrinks. Uphill they stop, go half a step
 * back, and the timestep shrinks.
 * Source: J. Guenole et al., Comput. Mater. Sci. 175, 109584 (2020), doi:10.1016/j.commatsci.2020.109584, algorithm 2;
 * E. Bitzek et al., Phys. Rev. Lett. 97, 170201 (2006), doi:10.1103/PhysRevLett.97.170201. */
#include <math.h>

#include "core/atom_style.h"
#include "sim/minimizer.h"
#include "style/atom_sum.h"

enum { FORCE_VELOCITY, VELOCITY_VELOCITY, FORCE_FORCE, N_SUMS };

static void add_products(const hs_atoms *atoms, const void *context, int begin, int end, hs_exact_sum *sums)
{
    (void)context;
    for (int axis = 0; axis < 3; ++axis)
        for (int i = begin; i < end; ++i) {
            const double f = atoms->f[axis][i], v = atoms->v[axis][i];
            hs_exact_add(&sums[FORCE_VELOCITY], f * v);
            hs_exact_add(&sums[VELOCITY_VELOCITY], v * v);
            hs_exact_add(&sums[FORCE_FORCE], f * f);
        }
}

static void set_velocities_of_share(const hs_atoms *atoms, double keep, double push, double turn)
{
#pragma omp for schedule(static) nowait
    for (int i = 0; i < atoms->n_local; ++i) {
        const double factor = push / hs_atom_mass(atoms, i) + turn;
        for (int axis = 0; axis < 3; ++axis) atoms->v[axis][i] = keep * atoms->v[axis][i] + factor * atoms->f[axis][i];
    }
}

/** v = keep v + push f/m + turn f for all atoms. */
static void set_velocities(hs_minimizer *min, double keep, double push, double turn)
{
    HS_ON_THREADS(set_velocities_of_share(&min->sim->atoms, keep, push, turn));
}

static void move_share(const hs_atoms *atoms, double magic, double dt)
{
    for (int axis = 0; axis < 3; ++axis) {
        double *restrict x = atoms->x[axis];
        const double *restrict v = atoms->v[axis];
#pragma omp for schedule(static) nowait
        for (int i = 0; i < atoms->n_local; ++i) x[i] = hs_moved(x[i], dt * v[i], magic);
    }
}

static void move(hs_minimizer *min, double dt)
{
    HS_ON_THREADS(move_share(&min->sim->atoms, min->sim->env.position_magic, dt));
}

static void begin(hs_minimizer *min)
{
    const hs_min_settings *settings = min->settings;
    const double dt = min->sim->env.dt;
    min->dt = dt;
    min->dt_max = settings->tmax * dt;
    min->dt_min = settings->tmin * dt;
    min->mixing = settings->alpha0;
    min->n_downhill = min->n_uphill = min->n_since_begin = 0;
    min->last_uphill = min->n_iterations;
    set_velocities(min, 0.0, 0.0, 0.0);
    if (settings->integrator == HS_FIRE_LEAPFROG) set_velocities(min, 0.0, -0.5 * dt * min->sim->env.units->ftm2v, 0.0);
}

/** The timestep after one more step downhill or uphill. False when it has gone uphill too often. */
static bool adapt(hs_minimizer *min, bool is_downhill)
{
    const hs_min_settings *settings = min->settings;
    if (is_downhill) {
        ++min->n_downhill;
        min->n_uphill = 0;
        if (min->n_downhill > settings->delaystep) {
            min->dt = fmin(min->dt * settings->dtgrow, min->dt_max);
            min->mixing *= settings->alphashrink;
        }
        return true;
    }
    min->n_downhill = 0;
    min->last_uphill = min->n_iterations;
    if (++min->n_uphill > settings->vdfmax) return false;
    if (!(settings->initialdelay && min->n_since_begin < settings->delaystep)) {
        min->mixing = settings->alpha0;
        if (min->dt * settings->dtshrink >= min->dt_min) min->dt *= settings->dtshrink;
    }
    if (settings->halfstepback) move(min, -0.5 * min->dt);
    set_velocities(min, 0.0, 0.0, 0.0);
    return true;
}

/** Kick (if @p push is not 0) and turn the part @p mixing of the velocities to the forces. */
static void accelerate(hs_minimizer *min, double push, double mixing, const double sums[N_SUMS])
{
    const double ratio = sums[FORCE_FORCE] > 0.0 ? sqrt(sums[VELOCITY_VELOCITY] / sums[FORCE_FORCE]) : 0.0;
    if (push != 0.0) set_velocities(min, 1.0, push * min->sim->env.units->ftm2v, 0.0);
    if (mixing > 0.0) set_velocities(min, 1.0 - mixing, 0.0, mixing * ratio);
}

/** The timestep, or a shorter one with which no atom moves farther than dmax along an axis, at the speed that it has; where all are at
 *  rest, at the one that the forces give them in a timestep. */
static double safe_step(hs_minimizer *min, bool is_at_rest)
{
    const double push = min->dt * min->sim->env.units->ftm2v;
    if (is_at_rest) set_velocities(min, 0.0, push, 0.0);
    const double fastest = hs_min_largest(min, min->sim->atoms.v);
    if (is_at_rest) set_velocities(min, 0.0, 0.0, 0.0);
    return min->dt * fastest > min->settings->dmax ? min->settings->dmax / fastest : min->dt;
}

/** FIRE as first published, begin_old: it finds the length of its steps after velocities were turned, and does nothing uphill but stop. */
static bool is_first_form(const hs_minimizer *min) { return min->settings == &min->first_settings; }

static hs_status iterate(hs_minimizer *min, hs_min_reason *reason, hs_error *err)
{
    double sums[N_SUMS];
    hs_atom_sum(&min->sim->atoms, &min->sim->parallel, add_products, NULL, N_SUMS, sums);
    const bool is_downhill = sums[FORCE_VELOCITY] > 0.0;
    const double mixing = is_downhill ? min->mixing : 0.0; /* what adapt makes of it counts from the next step on */
    ++min->n_since_begin;
    *reason = HS_MIN_NEGATIVE_POWER;
    if (!adapt(min, is_downhill)) return HS_OK;
    if (!is_downhill && !is_first_form(min))
        HS_TRY(hs_min_evaluate(min, err)); /* as in LAMMPS, even if nothing has moved */
    const double ftm2v = min->sim->env.units->ftm2v;
    double dt = safe_step(min, !is_downhill);
    switch (min->settings->integrator) {
    case HS_FIRE_VERLET:
        accelerate(min, 0.5 * dt, mixing, sums);
        move(min, dt);
        HS_TRY(hs_min_evaluate(min, err));
        set_velocities(min, 1.0, 0.5 * dt * ftm2v, 0.0);
        break;
    case HS_FIRE_EULER_EXPLICIT:
        accelerate(min, 0.0, mixing, sums);
        if (is_first_form(min)) dt = safe_step(min, false);
        move(min, dt);
        set_velocities(min, 1.0, dt * ftm2v, 0.0);
        HS_TRY(hs_min_evaluate(min, err));
        break;
    default: /* implicit Euler; leapfrog is the same, begun half a step earlier */
        accelerate(min, dt, mixing, sums);
        move(min, dt);
        HS_TRY(hs_min_evaluate(min, err));
    }
    /* the energy may stand still where it has just turned uphill */
    *reason = hs_min_check(min, min->n_iterations - min->last_uphill > min->settings->delaystep);
    return HS_OK;
}

const hs_min_style hs_min_style_fire = {.name = "fire",
                                        .summary = "damped dynamics (FIRE 2.0); takes the timestep of `timestep`",
                                        .is_from_rest = true,
                                        .begin = begin,
                                        .iterate = iterate};

/** The first form of FIRE: explicit Euler steps of any shortness. */
static void begin_old(hs_minimizer *min)
{
    hs_min_settings *settings = &min->first_settings;
    if (min->settings != settings) *settings = *min->settings;
    settings->integrator = HS_FIRE_EULER_EXPLICIT;
    settings->tmax = 10.0;
    settings->tmin = 0.0;
    settings->delaystep = 5;
    settings->dtgrow = 1.1;
    settings->dtshrink = 0.5;
    settings->alpha0 = 0.1;
    settings->alphashrink = 0.99;
    settings->vdfmax = INT64_MAX;
    settings->halfstepback = settings->initialdelay = false;
    min->settings = settings;
    begin(min);
}

const hs_min_style hs_min_style_fire_old = {.name = "fire/old",
                                            .summary =
                                                "damped dynamics as first published; only dmax of min_modify matters",
                                            .is_from_rest = true,
                                            .begin = begin_old,
                                            .iterate = iterate};

/** Steps in the direction of the forces alone, with the speed that the velocities have along it, or from rest where that is none. */
static hs_status iterate_quickmin(hs_minimizer *min, hs_min_reason *reason, hs_error *err)
{
    enum { STEPS_DOWNHILL = 5 }; /* the energy may stand still where it has just turned uphill */
    double sums[N_SUMS];
    hs_atom_sum(&min->sim->atoms, &min->sim->parallel, add_products, NULL, N_SUMS, sums);
    const bool is_downhill = sums[FORCE_VELOCITY] >= 0.0;
    if (!is_downhill) min->last_uphill = min->n_iterations;
    set_velocities(min, 0.0, 0.0,
                   is_downhill && sums[FORCE_FORCE] > 0.0 ? sums[FORCE_VELOCITY] / sums[FORCE_FORCE] : 0.0);
    const double dt = safe_step(min, false);
    move(min, dt);
    set_velocities(min, 1.0, dt * min->sim->env.units->ftm2v, 0.0);
    HS_TRY(hs_min_evaluate(min, err));
    *reason = hs_min_check(min, min->n_iterations - min->last_uphill > STEPS_DOWNHILL);
    return HS_OK;
}

const hs_min_style hs_min_style_quickmin = {.name = "quickmin",
                                            .summary = "damped dynamics (QuickMin); only dmax of min_modify matters",
                                            .is_from_rest = true,
                                            .begin = begin_old,
                                            .iterate = iterate_quickmin};
