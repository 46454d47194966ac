/** The simulation object: owns everything of one run. Any number can live in one process; nothing here is global. */
#ifndef HS_SIM_SIM_H
#define HS_SIM_SIM_H

#include <signal.h>

#include "base/timer.h"
#include "comm/halo.h"
#include "core/lattice.h"
#include "kernel/cluster_list.h"
#include "kernel/verlet_list.h"
#include "neighbor/neighbor.h"
#include "sim/minimize.h"
#include "sim/tuner.h"
#include "style/compute.h"
#include "style/dump.h"
#include "style/env.h"
#include "style/fix.h"
#include "style/pair.h"
#include "style/pair_shares.h"
#include "style/places.h"
#include "style/region.h"

struct hs_thermo;

/** `reproducible on|off`; by default it is on in double precision. */
typedef enum { HS_REPRODUCIBLE_DEFAULT, HS_REPRODUCIBLE_ON, HS_REPRODUCIBLE_OFF } hs_reproducible;

/** Settings of the command line and of commands that can be given before there is a box. */
typedef struct hs_options {
    int n_threads;                /**< 0: OMP_NUM_THREADS, else 1 */
    char neighbor_method[32];     /**< -neigh, wins over the deck; "" = the deck's or the default */
    char precision[16];           /**< -precision, wins over the deck; "" = the deck's or double */
    hs_reproducible reproducible; /**< -reproducible, wins over the deck */
    char isa[16];                 /**< instruction set of the kernels; "" or "auto": the best of this machine */
    bool dry_run;                 /**< halfshell check: no step is run, no file is written; `run` reports instead */
} hs_options;

/** Places of the latest forces, where fixes move atoms or box at the end of steps: sim/force_places.c. */
typedef struct hs_force_places {
    double *x[3]; /**< atom fields; NULL: no fix does that */
    hs_box box;
    bool is_kept;     /**< x and box are those of the present step's forces */
    hs_places places; /**< of these; env.force_places points here */
} hs_force_places;

typedef struct hs_sim {
    hs_env env; /**< what styles see; env.atoms etc. point to the members below */
    hs_pair_shares pair_shares;
    hs_options options;
    hs_parallel parallel;
    hs_box box;
    bool may_be_skewed; /**< box tilt large: tilts may be more than half of an edge */
    hs_atoms atoms;
    hs_groups groups;
    hs_lattice lattice;

    hs_pair *pair;      /**< owned; NULL until pair_style */
    hs_text pair_words; /**< the words after pair_style, each with its zero, to make the style anew; owned */
    hs_region **region; /**< owned [n_regions] */
    int n_regions;
    hs_fix **fix; /**< owned [n_fixes], in the deck's order */
    int n_fixes;
    hs_compute **compute; /**< owned [n_computes]; the first three are thermo_temp, thermo_press, thermo_pe */
    int n_computes;
    hs_dump **dump; /**< owned [n_dumps] */
    int n_dumps;
    struct hs_thermo *thermo; /**< owned; sim/thermo.h */

    hs_neighbor neighbor; /**< settings, cells, lists */
    hs_domain domain;     /**< the ranks' bricks */
    hs_halo halo;
    /** Owned [n_pair_tables]: for each part of the pair style, parameters of all pairs of kernel types; by hs_sim_setup. */
    hs_pair_table *pair_table;
    int n_pair_tables;
    int32_t *kernel_type; /**< atom field: type and exclusion class; NULL while no groups are excluded */
    /** Owned [n_kernel_types^2]: pairs of kernel types that do not interact; NULL: none are excluded. */
    bool *excluded;
    int n_kernel_types;
    hs_force_space forces; /**< buffers of the pair kernels */
    /** In flat_generation of the atoms the forces along z of the first n_flat were cleared; kernels leave them alone, so while
     *  env.is_planar they are 0. */
    uint64_t flat_generation;
    int64_t n_flat;
    hs_cluster_list list;  /**< method cluster: pairs of the last scheduled build */
    hs_verlet_list verlet; /**< method verlet: the same */
    hs_tuner tuner;        /**< method auto */
    hs_force_places force_places;
    bool has_moved; /**< since the latest forces, of whose places the halo still is */
    hs_isa isa;
    int n_threads;          /**< as asked for, by the options or the environment */
    hs_precision precision; /**< as asked for: double or mixed */
    hs_reproducible reproducible;
    hs_precision kernel_precision; /**< of the present run's kernels: fixed point when reproducible */
    int force_exponent;            /**< fixed point: grid of the next forces; part of the state of a run */
    hs_fixed_grid grid;            /**< fixed point: grids of the latest forces and energies */
    hs_timer timer;
    hs_min_settings minimize; /**< of min_style and min_modify */
    bool is_minimizing;       /**< within hs_sim_minimize: only fixes that act in it are heard */
    /** Iterations since the last run: numbered as steps, but the next run does not count their time. */
    int64_t n_minimized;

    int64_t listed_step; /**< of the last scheduled list build */
    bool is_initialized; /**< a run has been set up since the last change of the system (run pre no is allowed) */
    int64_t *n_of_type;  /**< owned [n_types + 1]: atoms of each type on all ranks, counted at set-up */
    volatile sig_atomic_t *stop_requested; /**< borrowed: set by a signal handler; NULL without one */
    struct hs_saving *saving;              /**< owned; checkpoints and when they are due: sim/saving.h */
    struct hs_restored *restored;          /**< owned; states for fixes to come: sim/restored.h; NULL: none */
    bool is_stopping;                      /**< some rank was asked to stop; agreed once a step */
    hs_fix *unfinished;                    /**< borrowed: its final_integrate waits; NULL: the step is whole */
    bool is_output_due;                    /**< the output of the present step failed: a resumed run begins with it */
    bool is_rerunning;                     /**< atoms come from a file: no fix needs to move them */
} hs_sim;

/** New, empty simulation. @p out is borrowed for its life. The caller destroys it. */
HS_MUST_USE hs_status hs_sim_create(hs_sim **sim, const hs_options *options, hs_sink *out, hs_error *err);
/** Free everything; clears the pointer; NULL is fine. */
void hs_sim_destroy(hs_sim **sim);

/** Free all styles; part of hs_sim_destroy.  sim/styles.c */
void hs_sim_destroy_styles(hs_sim *sim);

/* Making and removing styles (sim/styles.c). `args` are the words after the style's name. IDs must be unique (a fix of the same ID and
 * style is replaced in place, as in LAMMPS). */
HS_MUST_USE hs_status hs_sim_set_pair(hs_sim *sim, const char *style, const hs_args *args, hs_error *err);
HS_MUST_USE hs_status hs_sim_pair_coeff(hs_sim *sim, const hs_args *args, hs_error *err); /**< I J words... */
HS_MUST_USE hs_status hs_sim_add_fix(hs_sim *sim, const char *id, const char *group, const char *style,
                                     const hs_args *args, hs_error *err);
HS_MUST_USE hs_status hs_sim_remove_fix(hs_sim *sim, const char *id, hs_error *err);
HS_MUST_USE hs_status hs_sim_add_compute(hs_sim *sim, const char *id, const char *group, const char *style,
                                         const hs_args *args, hs_error *err);
HS_MUST_USE hs_status hs_sim_remove_compute(hs_sim *sim, const char *id, hs_error *err);
HS_MUST_USE hs_status hs_sim_add_region(hs_sim *sim, const char *id, const char *style, const hs_args *args,
                                        hs_error *err);
HS_MUST_USE hs_status hs_sim_remove_region(hs_sim *sim, const char *id, hs_error *err);
HS_MUST_USE hs_status hs_sim_add_dump(hs_sim *sim, const char *id, const char *group, const char *style, int64_t every,
                                      const char *file, const hs_args *args, hs_error *err);
HS_MUST_USE hs_status hs_sim_remove_dump(hs_sim *sim, const char *id, hs_error *err);
/** Look-ups; NULL when there is none. */
hs_fix *hs_sim_find_fix(hs_sim *sim, const char *id);
hs_compute *hs_sim_find_compute(hs_sim *sim, const char *id);
/** Number k, from 0, of the computes of temperatures, those of fixes included; NULL: there are no more. Borrowed. */
hs_compute *hs_sim_temperature(hs_sim *sim, int k);
hs_region *hs_sim_find_region(hs_sim *sim, const char *id);
hs_dump *hs_sim_find_dump(hs_sim *sim, const char *id);
/** The region of that ID, brought to the present step (collective); an error that begins with @p command when there is none. */
HS_MUST_USE hs_status hs_sim_need_region(hs_sim *sim, const char *command, const char *id, const hs_region **region,
                                         hs_error *err);

/** Whether this rank was asked to stop (by a signal that other ranks may not have seen yet), or its time is over. */
bool hs_sim_is_asked_to_stop(const hs_sim *sim);

/** Let shrink-wrapped faces follow the outermost atoms (collective).  sim/exchange.c */
void hs_sim_shrink_box(hs_sim *sim);
/** A pair style that was given before the box: make it anew for the number of types there are now.  sim/styles.c */
HS_MUST_USE hs_status hs_sim_fit_pair(hs_sim *sim, hs_error *err);
/** Fail unless there is a pair style. */
HS_MUST_USE hs_status hs_sim_need_pair(const hs_sim *sim, const char *command, hs_error *err);

/** Fail unless the box exists ("<command>: the box must exist first: ...") */
HS_MUST_USE hs_status hs_sim_need_box(const hs_sim *sim, const char *command, hs_error *err);
/** Fail unless every type has a mass. */
HS_MUST_USE hs_status hs_sim_need_masses(const hs_sim *sim, const char *command, hs_error *err);
/** Atoms were added, removed, moved or changed outside a run: count them (collective), forget halo, lists, and
 *  remembered compute values. Every command that touches atoms calls this last. */
void hs_sim_atoms_changed(hs_sim *sim);
/** The same for commands that gave atoms other positions or velocities and changed nothing else: a run without set-up goes on
 *  with the lists and forces there are, and makes new lists when the schedule and the displacements say so. */
void hs_sim_atoms_moved(hs_sim *sim);

/** Number the present step anew, or change the length of steps: the simulated time goes on from where it is, and energies of the
 *  present positions stay known. */
void hs_sim_set_clock(hs_sim *sim, int64_t step, double dt);
/** Fail when a fix counts steps, so that they cannot be numbered anew. */
HS_MUST_USE hs_status hs_sim_need_no_counters(const hs_sim *sim, const char *command, hs_error *err);

/** Words of the command `run`. */
typedef struct hs_run_plan {
    int64_t n_steps;
    bool pre, post;      /**< full set-up before; timing table after */
    int64_t start, stop; /**< steps that ramps in fixes and thermo's time left refer to */
    bool is_resumed;     /**< go on within a run: env.first_step and last_step say where; needs hs_sim_setup_resumed */
} hs_run_plan;

/** Run the simulation (collective): set-up, steps, output, timing table.  sim/run.c. */
HS_MUST_USE hs_status hs_sim_run(hs_sim *sim, const hs_run_plan *plan, hs_error *err);
/** Lists are due: bring atoms, the shrink-wrapped box, halo, cells, and the listed positions up to date
 *  (collective).  sim/exchange.c */
HS_MUST_USE hs_status hs_sim_exchange(hs_sim *sim, hs_error *err);
/** Atoms have kernel types when pairs within groups are excluded, from the command on that says so, for a checkpoint
 *  that is read after it has them.  sim/pair_setup.c */
HS_MUST_USE hs_status hs_sim_fit_kernel_types(hs_sim *sim, hs_error *err);
/** Tables of pair parameters, exclusions and cutoffs for the next run.  sim/pair_setup.c */
HS_MUST_USE hs_status hs_sim_setup_pair(hs_sim *sim, hs_error *err);
/** The same within a run, after coefficients or radii were changed. *needs_lists: lists and halo of the present reach do not serve
 *  any more (collective).  sim/pair_setup.c */
HS_MUST_USE hs_status hs_sim_renew_pair(hs_sim *sim, bool *needs_lists, hs_error *err);
/** Kernel types of the local atoms from their types and groups; only when groups are excluded from each other. */
void hs_sim_set_kernel_types(hs_sim *sim);
/** What a force evaluation (or the making of a list) reads, for the first part of the pair style that exerts forces; there must be
 *  one.  sim/pair_forces.c */
hs_force_job hs_sim_make_job(hs_sim *sim, bool with_energy);
/** Sort the local atoms into Morton cells, make the halo to `reach`, sort it too, and cut both into clusters; kernel types
 *  for all.  sim/exchange.c */
HS_MUST_USE hs_status hs_sim_sort_and_cluster(hs_sim *sim, double reach, hs_error *err);
/** The same for atoms that have moved since, with the halo there is.  sim/exchange.c */
HS_MUST_USE hs_status hs_sim_sort_again(hs_sim *sim, hs_error *err);
/** The halo alone, to `reach`, with its kernel types.  sim/exchange.c */
HS_MUST_USE hs_status hs_sim_make_halo(hs_sim *sim, double reach, hs_error *err);
/** Listed positions of the halo, in the box of that time (collective).  sim/exchange.c */
void hs_sim_forward_listed(hs_sim *sim);
/* Reproducible runs (sim/reproducible.c). */
/** Choose the kernels' precision, and round box and positions to the grid; part of every set-up. */
HS_MUST_USE hs_status hs_sim_setup_reproducible(hs_sim *sim, hs_error *err);
/** The box has changed: choose the position grid anew, and round to it when it is another. */
void hs_sim_settle_positions(hs_sim *sim);
/** Round bounds and tilts of a box to a grid (env.position_magic). */
void hs_sim_round_box(hs_box *box, double magic);
/** Round the positions of local atoms to the present grid. */
void hs_sim_round_positions(hs_sim *sim);
/** Grids for the forces of this step. */
void hs_sim_begin_grid(hs_sim *sim);
/** Whether all pairs fitted the grid (collective); if not, coarsen it for another try. After a list build, take the finest grid that
 *  the present forces allow. An error when a force is infinite. */
HS_MUST_USE hs_status hs_sim_fit_grid(hs_sim *sim, const hs_force_result *result, bool *fits, hs_error *err);

/* Places of the latest forces (sim/force_places.c). */
/** Room for them while there is a fix that needs it. */
HS_MUST_USE hs_status hs_sim_fit_force_places(hs_sim *sim, hs_error *err);
/** Remember those of now, at steps with energy and where a fix will move atoms or box. */
void hs_sim_keep_force_places(hs_sim *sim);
/** Atoms are moved: from now on forces belong to where atoms are. */
void hs_sim_forget_force_places(hs_sim *sim);
/** After a checkpoint was read: let styles see those it had. */
void hs_sim_show_force_places(hs_sim *sim);

/** Whether lists come so late that pairs within the cutoff may be missing from them; these have no forces then, as in LAMMPS. */
static inline bool hs_sim_misses_pairs(const hs_sim *sim)
{
    return sim->neighbor.is_late && !sim->neighbor.settings.exact;
}
/** Take the positions of halo atoms that are under way, if they are.  sim/pair_forces.c */
void hs_sim_await_halo(hs_sim *sim);
/** Energy and pressure of the long-range corrections in the present box (pair_modify tail).  sim/pair_forces.c */
void hs_sim_find_tail(hs_sim *sim);
/** Pair forces on all local atoms, and with_energy also env.pair_energy and pair_virial (collective).  sim/pair_forces.c */
HS_MUST_USE hs_status hs_sim_pair_forces(hs_sim *sim, bool with_energy, hs_error *err);
/** What fixes change that lists and forces depend on; @p is_setup: before the first forces of a run (collective).
 *  sim/fix_forces.c */
HS_MUST_USE hs_status hs_sim_pre_force(hs_sim *sim, bool is_setup, hs_error *err);
/** What fixes add to, or change about, the forces; with env.with_energy also env.fix_energy and fix_virial (collective).
 *  sim/fix_forces.c */
HS_MUST_USE hs_status hs_sim_post_force(hs_sim *sim, hs_error *err);
/** fix_modify <ID> keyword value ...  sim/fix_forces.c */
HS_MUST_USE hs_status hs_sim_modify_fix(hs_sim *sim, const char *id, const hs_args *args, hs_error *err);
/** Atoms were moved by other means than a step: lists and halo as they need it, forces and energy of their places, with what fixes
 *  add that act in minimisations (collective).  sim/step.c */
HS_MUST_USE hs_status hs_sim_move_forces(hs_sim *sim, hs_error *err);
/** The first snapshots and the first row of a run (collective).  sim/run.c */
HS_MUST_USE hs_status hs_sim_begin_output(hs_sim *sim, hs_error *err);
/** Snapshots and the row that are due at the present step, or all of the last one (collective).  sim/run.c */
HS_MUST_USE hs_status hs_sim_output_if_due(hs_sim *sim, bool is_last, hs_error *err);
/** A snapshot of every dump that has none of this step yet, due or not (collective). */
HS_MUST_USE hs_status hs_sim_write_all_dumps(hs_sim *sim, hs_error *err);
/** Whether the atoms will stay in the plane until commands change something: two dimensions, z, v_z and f_z of all atoms +0, and no fix
 *  that could make them anything else (collective).  sim/planar.c */
bool hs_sim_is_planar(const hs_sim *sim);
/** One timestep, without output (collective). If it is not @p is_seen, final_integrate may wait for the next step, which does both
 *  halves at once, or for hs_sim_finish_step: until then velocities are those of its middle.  sim/step.c */
HS_MUST_USE hs_status hs_sim_step(hs_sim *sim, bool with_energy, bool is_seen, hs_error *err);
/** Let the last step come to its end before somebody looks (collective).  sim/step.c */
HS_MUST_USE hs_status hs_sim_finish_step(hs_sim *sim, hs_error *err);
/** Cells, lists, forces, energy and virial of atoms that were placed anew, when all else is set up. */
HS_MUST_USE hs_status hs_sim_setup_forces(hs_sim *sim, hs_error *err);
/** Dumps, and the row of the table, that are due at the present step (collective). */
HS_MUST_USE hs_status hs_sim_write_due(hs_sim *sim, bool is_first, hs_error *err);
/** Set-up only, with forces, energy and virial of the present positions (no step).  Used by run, by the API and by tests. */
HS_MUST_USE hs_status hs_sim_setup(hs_sim *sim, hs_error *err);

#endif
