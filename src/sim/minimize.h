/** Energy minimisation: atoms move to a minimum of the potential energy near where they are. */
#ifndef HS_SIM_MINIMIZE_H
#define HS_SIM_MINIMIZE_H

#include <stdbool.h>
#include <stdint.h>

#include "base/error.h"

struct hs_sim;
struct hs_minimizer;

/** Line searches of the styles that search along lines. */
typedef enum { HS_LINE_BACKTRACK, HS_LINE_QUADRATIC } hs_line_search;
/** How long a force vector of all atoms is: two-norm of all, largest of an atom, largest component. */
typedef enum { HS_NORM_TWO, HS_NORM_MAX, HS_NORM_INF } hs_force_norm;
/** Integrators of style fire. */
typedef enum { HS_FIRE_EULER_IMPLICIT, HS_FIRE_VERLET, HS_FIRE_LEAPFROG, HS_FIRE_EULER_EXPLICIT } hs_fire_integrator;

/** Settings of `min_style` and `min_modify`; the names are those of the keywords. */
typedef struct hs_min_settings {
    const struct hs_min_style *style;
    double dmax; /**< farthest that an atom may move along one axis in one iteration, distance */
    hs_line_search line;
    hs_force_norm norm;
    /* style fire */
    hs_fire_integrator integrator;
    double tmax, tmin; /**< limits of the timestep, in units of the one at the start */
    int64_t delaystep; /**< steps downhill before the timestep grows */
    double dtgrow, dtshrink, alpha0, alphashrink;
    int64_t vdfmax; /**< steps uphill in a row after which it ends */
    bool halfstepback, initialdelay;
} hs_min_settings;

/** The defaults of LAMMPS. */
void hs_min_settings_init(hs_min_settings *settings);

/** Why a minimisation ended; see hs_min_reasons. */
typedef enum {
    HS_MIN_GOES_ON,
    HS_MIN_MAX_ITERATIONS,
    HS_MIN_MAX_EVALUATIONS,
    HS_MIN_ENERGY,
    HS_MIN_FORCE,
    HS_MIN_UPHILL,
    HS_MIN_ALPHA,
    HS_MIN_FLAT,
    HS_MIN_NO_FORCES,
    HS_MIN_NEGATIVE_POWER,
    HS_MIN_HALTED, /**< by a fix */
    HS_N_MIN_REASONS
} hs_min_reason;

/** A way to the minimum. One is one entry of hs_min_styles. */
typedef struct hs_min_style {
    const char *name, *summary;
    bool is_from_rest;  /**< velocities are part of the way: they are zero before the first forces */
    bool has_direction; /**< the search direction and the forces before are kept for each atom */
    /** Begin, or begin again, from the present forces. */
    void (*begin)(struct hs_minimizer *min);
    /** One iteration (collective): atoms have moved, and forces and energy are those of their places. */
    HS_MUST_USE hs_status (*iterate)(struct hs_minimizer *min, hs_min_reason *reason, hs_error *err);
} hs_min_style;
extern const hs_min_style *const hs_min_styles[]; /**< ended by NULL */

/** Words of the command `minimize`. */
typedef struct hs_min_plan {
    double energy_tolerance, force_tolerance;    /**< relative; force */
    int64_t *iterations_left, *evaluations_left; /**< borrowed; counted down, so that a checkpoint knows them */
    bool is_resumed;                             /**< go on where a checkpoint was written */
} hs_min_plan;

/** Whether the style and the fixes there are can minimise the energy. */
HS_MUST_USE hs_status hs_sim_check_minimize(struct hs_sim *sim, hs_error *err);
/** Minimise the energy (collective): set-up, iterations with output, statistics. */
HS_MUST_USE hs_status hs_sim_minimize(struct hs_sim *sim, hs_min_plan *plan, hs_error *err);

#endif
