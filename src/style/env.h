/** What a style may see of the simulation it belongs to. Styles never include sim/: this is their view of it. */
#ifndef HS_STYLE_ENV_H
#define HS_STYLE_ENV_H

#include "base/message.h"
#include "base/text.h"
#include "base/timer.h"
#include "core/atoms.h"
#include "core/box.h"
#include "core/group.h"
#include "core/units.h"
#include "kernel/kernel.h"
#include "parallel/parallel.h"

struct hs_compute;
struct hs_pair;
struct hs_pair_counter;
struct hs_pair_view;
struct hs_fix;
struct hs_region;
struct hs_lattice;
struct hs_domain;
struct hs_box_flow;
struct hs_places;

/** What a variable of the deck has. */
typedef enum {
    HS_NO_VARIABLE, /**< there is none of that name */
    HS_NUMBER_VARIABLE,
    HS_ATOM_VARIABLE,  /**< a number for each atom */
    HS_VECTOR_VARIABLE /**< a vector */
} hs_variable_kind;

/** Owned by hs_sim, one per simulation; everything in it is borrowed by styles for as long as they live. */
typedef struct hs_env {
    const hs_parallel *parallel;
    hs_sink *out;
    const hs_units *units;
    hs_box *box;
    struct hs_domain *domain; /**< the box cut into the ranks' bricks */
    /** How fast the box changes: fix deform's, for as long as that lives; NULL: nothing does. See style/box_flow.h. */
    const struct hs_box_flow *box_flow;
    hs_atoms *atoms;
    hs_groups *groups;
    struct hs_lattice *lattice; /**< never NULL; `none` until the deck sets one */

    /** Torques on the local atoms, [n_local], energy: 0 at the beginning of every evaluation of forces; NULL unless something
     *  exerts any. See style/spheres.h. */
    double *torque[3];
    int n_torque_users;
    /** Of each local atom, [n_local], what fix_virial is the sum of, energy; NULL unless a compute wants it. See style/fix.h. */
    double *virial_of_fixes[6];
    int n_virial_users;
    /** Borrowed from hs_sim; never NULL. See style/pair_shares.h. */
    struct hs_pair_shares *pair_shares;

    hs_isa isa; /**< instruction set of kernels */

    const hs_timer *timer; /**< what this rank has spent its time on since the run began */
    /** Pairs in this rank's neighbor lists; 0 before the first run, and with methods that keep none. */
    const int64_t *n_listed_pairs;
    double reach; /**< largest cutoff and skin, distance; 0 without forces */

    /** Commands are repeated to make styles anew before their state comes from a checkpoint: files that were written
     *  before are to be added to, not emptied, and nothing is to be written. */
    bool is_resuming;
    bool dry_run; /**< halfshell check: nothing may open, write or remove a file */

    int64_t step;        /**< number of the present timestep */
    bool has_new_lists;  /**< neighbor lists were due, and made, at this step: the same with any method */
    int64_t first_step;  /**< step at which the present (or next) run began */
    int64_t last_step;   /**< step at which it ends */
    int64_t ramp_start;  /**< step at which a series of runs began (run start); else first_step */
    int64_t ramp_stop;   /**< step at which the series ends (run stop); else last_step */
    int64_t clock_ahead; /**< step + clock_ahead counts all steps ever made: what reset_timestep took off the step */
    double dt;           /**< timestep, time */
    /** Two dimensions, and for the rest of the run all z, v_z and f_z are +0, on all ranks: who would only carry the zeros on leaves them
     *  alone, for reading and writing them takes as long as x and y do. Set by hs_sim. */
    bool is_planar;
    /** A fix has ended the run before its last step, which has no row of thermo output then unless one is due. */
    bool is_cut_short;
    bool is_halted; /**< fix halt: there shall be no more runs and minimisations */
    /** Raised whenever positions, velocities, forces or the order of atoms change: results of computes are remembered
     *  for one revision. Who changes atoms outside of the hooks before end_of_step raises it (hs_env_changed). */
    uint64_t revision;
    /** Reproducible runs keep positions on a grid: (d + position_magic) - position_magic rounds to it. Else 0. See
     *  hs_moved. */
    double position_magic;
    double time_origin; /**< simulated time at step time_origin_step: set when dt changes, so that time goes on */
    int64_t time_origin_step;

    /* Results of the latest force evaluation, summed over threads and ranks */
    double pair_energy;    /**< energy of all pairs, valid when energy_step == step */
    double pair_virial[6]; /**< sum over pairs of r_a F_b: xx yy zz xy xz yz; energy */
    /** Of the latest forces, of all ranks: no pair's F/r was larger than peak_force over the largest cutoff, and, valid like
     *  pair_energy, no pair's energy than peak_energy. 0: not known (runs that are not reproducible). */
    double peak_force, peak_energy;
    int64_t energy_step;  /**< step for which energy and virial were last computed, -1 for never */
    bool with_energy;     /**< energy and virial of the present step are wanted: fixes that have some add them up */
    double fix_energy;    /**< of fixes with `fix_modify energy yes`; energy, valid like pair_energy */
    double fix_virial[6]; /**< of fixes with `fix_modify virial yes` */
    double tail_energy;   /**< long-range corrections of pair_modify tail: energy, to be divided by nothing */
    double tail_pressure; /**< and pressure (already in pressure units); both 0 without tail */

    /** Where atoms were when the latest forces were computed, if a fix has changed the box since; NULL: where they are. See
     *  style/places.h. */
    const struct hs_places *force_places;

    /** Another length of steps from the next one on: all fixes hear of it. */
    hs_status (*set_timestep)(struct hs_env *env, double dt, hs_error *err);
    /** Borrowed from the compute that announced it: the distances of this step's pairs are wanted, and may be counted
     *  while their forces are computed. NULL: not wanted. */
    struct hs_pair_counter *pair_counter;

    /** How pairs of atoms interact now: see style/pair_scan.h. */
    void (*view_pairs)(struct hs_env *env, struct hs_pair_view *view);
    /** Coefficients of the pair style, or radii, were changed: make the tables of pair parameters anew (collective).
     *  *needs_lists: pairs reach farther or less far, or by other radii, than before, so that the present step needs
     *  new lists. */
    hs_status (*pairs_changed)(struct hs_env *env, bool *needs_lists, hs_error *err);
    /** The pair style; NULL without one. */
    struct hs_pair *(*pair)(struct hs_env *env);
    /* Look-ups; NULL when there is none of that ID */
    struct hs_compute *(*find_compute)(struct hs_env *env, const char *id);
    struct hs_fix *(*find_fix)(struct hs_env *env, const char *id);
    struct hs_region *(*find_region)(struct hs_env *env, const char *id);
    /** Value of an equal-style (or other number-like) variable; set by the deck, NULL without one. */
    hs_status (*variable_value)(void *deck, const char *name, double *value, hs_error *err);
    /** Values of an atom-style variable for the local atoms: values[n_local]. */
    hs_status (*variable_atoms)(void *deck, const char *name, double *values, hs_error *err);
    /** Give an internal-style variable a value; an error when it is of another style. */
    hs_status (*set_variable)(void *deck, const char *name, double value, hs_error *err);
    /** Length of a vector-style variable's vector, and whether it varies; 0 for others. With @p refresh what it is made
     *  of is brought up to date before (collective). */
    hs_status (*variable_length)(void *deck, const char *name, bool refresh, int *length, bool *varies, hs_error *err);
    /** Its elements: values[length], the length being that of now (collective). */
    hs_status (*variable_vector)(void *deck, const char *name, int length, double *values, hs_error *err);
    /** Ask through hs_env_variable_kind, which needs no deck. */
    hs_variable_kind (*variable_kind)(void *deck, const char *name);
    /** Replace $x, ${name} and $(formula) in a text, as in a line of the deck (collective). */
    hs_status (*substitute)(void *deck, hs_text *text, hs_error *err);
    /** Text of the deck's first file, for files that tell what made them; NULL without one. Borrowed. */
    const char *(*deck_text)(void *deck);
    void *deck;
} hs_env;

/** Atoms were changed: remembered results of computes are void. */
static inline void hs_env_changed(hs_env *env) { ++env->revision; }

/** What the deck's variable of that name has; without a deck there are no variables. */
static inline hs_variable_kind hs_env_variable_kind(const hs_env *env, const char *name)
{
    return env->variable_kind != NULL ? env->variable_kind(env->deck, name) : HS_NO_VARIABLE;
}

/** Axes along which atoms can move. */
static inline int hs_env_n_axes(const hs_env *env) { return env->is_planar ? 2 : 3; }

/** How far ramps (from a start to a stop value) have gone at the present step: 0 at ramp_start, 1 at ramp_stop. */
static inline double hs_env_ramp(const hs_env *env)
{
    return env->ramp_stop > env->ramp_start
               ? (double)(env->step - env->ramp_start) / (double)(env->ramp_stop - env->ramp_start)
               : 0.0;
}

/** The coordinate x moved by d; @p magic is env->position_magic. Every fix moves atoms by this: in reproducible runs
 *  the step, not the sum, is rounded to the position grid, so that an atom moves alike in all its periodic images. */
static inline double hs_moved(double x, double d, double magic) { return x + ((d + magic) - magic); }

#endif
