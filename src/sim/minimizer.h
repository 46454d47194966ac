/** What the ways to a minimum share. Included by the files of sim/ that minimise. */
#ifndef HS_SIM_MINIMIZER_H
#define HS_SIM_MINIMIZER_H

#include "sim/minimize.h"
#include "sim/sim.h"

/** The box as a part of what is minimised. */
typedef struct hs_min_box {
    hs_fix *fix; /**< whose coordinates they are; NULL: the box stays as it is */
    double energy, force[HS_BOX_COORDINATES];
    double direction[HS_BOX_COORDINATES], before[HS_BOX_COORDINATES]; /**< as of the atoms */
    /** Where the line begins: the box, and positions and image flags as fields of the atoms. */
    hs_box start;
    double *x[3];
    int32_t *image[3];
} hs_min_box;

/** A minimisation in progress. */
typedef struct hs_minimizer {
    hs_sim *sim;
    const hs_min_settings *settings;
    hs_min_plan *plan;
    int64_t n_iterations, n_evaluations;
    double energy, energy_before; /**< now, and at the end of the iteration before */
    double alpha;                 /**< of the line search: distance moved = alpha times direction */
    double
        energy_scale; /**< of energies as thresholds see them: 1/N under `thermo_modify norm yes`, as in LAMMPS, else 1 */
    double alpha_tried; /**< last distance of the line search that was not guessed from a parabola, for the log */
    /** Search direction and forces of the iteration before; fields of the atoms, only when the style wants them. */
    double *direction[3], *before[3];
    hs_min_box box;
    double squared; /**< cg: square of those forces */
    /* fire */
    double dt, dt_min, dt_max, mixing;
    int64_t n_downhill, n_uphill, n_since_begin;
    int64_t last_uphill;            /**< iteration */
    hs_min_settings first_settings; /**< fire/old: the deck's with those of the first form of FIRE */
} hs_minimizer;

/** Sums over all atoms and axes, exact (collective). */
typedef struct hs_min_sums {
    double force_force, force_before, force_direction;
} hs_min_sums;
void hs_min_add_up(const hs_minimizer *min, hs_min_sums *sums);
/** Largest |value| of all components of a vector of the atoms (collective). */
double hs_min_largest(const hs_minimizer *min, double *const vector[3]);
/** Forces and energy of the present places (collective); counts as one evaluation. */
HS_MUST_USE hs_status hs_min_evaluate(hs_minimizer *min, hs_error *err);
/** Whether a tolerance is met, or too many evaluations were made (collective). */
hs_min_reason hs_min_check(const hs_minimizer *min, bool with_energy);

/** Energy of the latest evaluation: pairs, fixes, box. */
double hs_min_energy(const hs_minimizer *min);

/* The part of the box (sim/minimize_box.c); without a fix that relaxes it these do nothing, and sums and counts are
 * 0. */
/** The fix that relaxes the box, or NULL; an error where there are two, or the style does not search along lines. */
HS_MUST_USE hs_status hs_min_find_box(hs_sim *sim, hs_fix **fix, hs_error *err);
/** Its energy and forces, from the latest forces of the atoms (collective). */
HS_MUST_USE hs_status hs_min_measure_box(hs_minimizer *min, hs_error *err);
/** Add and remove its fields of the atoms. */
HS_MUST_USE hs_status hs_min_add_box(hs_minimizer *min, hs_error *err);
void hs_min_remove_box(hs_minimizer *min);
void hs_min_add_box_products(const hs_minimizer *min, hs_min_sums *sums);
/** Largest |value| of a vector of its coordinates. */
double hs_min_largest_of_box(const hs_minimizer *min, const double value[HS_BOX_COORDINATES]);
/** direction = force + beta direction, before = force. */
void hs_min_turn_box(hs_minimizer *min, double beta);
int hs_min_count_box(const hs_minimizer *min);
/** Largest alpha that the box allows. */
double hs_min_limit_of_box(const hs_minimizer *min);
void hs_min_begin_line_of_box(hs_minimizer *min);
/** Box and atoms go to a place of the line. There is a fix. */
void hs_min_go_with_box(hs_minimizer *min, double alpha);
/** After a line: energy and forces where the fix takes another reference (collective). */
HS_MUST_USE hs_status hs_min_renew_box(hs_minimizer *min, hs_error *err);

/** Move along the direction to a lower energy (collective). *reason is HS_MIN_ALPHA or HS_MIN_FLAT when there was none to be found;
 *  atoms are where they were then. */
HS_MUST_USE hs_status hs_min_search_line(hs_minimizer *min, hs_min_reason *reason, hs_error *err);

extern const hs_min_style hs_min_style_cg, hs_min_style_sd, hs_min_style_fire, hs_min_style_fire_old,
    hs_min_style_quickmin;

#endif
