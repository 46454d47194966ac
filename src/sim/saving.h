/** When checkpoints are due, under which names they are kept, and what of the simulation goes into them. */
#ifndef HS_SIM_SAVING_H
#define HS_SIM_SAVING_H

#include "sim/sim.h"

/** What `restart N file [file2]` asks for. */
typedef struct hs_restarts {
    int64_t every; /**< steps; 0: none */
    char *file[2]; /**< owned; a name with *, or two that take turns */
    int turn;      /**< of two names: the next one */
} hs_restarts;

/** Settings of `restart` and `checkpoint`, of the options of the command line, and what was written. Zero is: no
 *  files. */
typedef struct hs_saving {
    hs_restarts restart[2]; /**< with one name, with two: LAMMPS's decks may ask for both */
    /* checkpoint every N steps|minutes keep K file NAME */
    int64_t every_steps; /**< 0: not by steps */
    double every_s;      /**< wall time, 0: not by time */
    char *pattern;       /**< owned; NULL: the default */
    int64_t keep;        /**< files, 0: all */
    char **recent;       /**< owned [n_recent] names of those written, oldest first */
    int n_recent;
    double last_s;   /**< when the last one was written, or the run began */
    double cost_s;   /**< what the last one took */
    char *last_path; /**< owned; NULL: none yet */
    int64_t last_step;

    bool is_writing_kept; /**< the file that is being written is to be one of `recent` */

    bool is_rescued;   /**< the last one was written because output failed */
    bool is_automatic; /**< nobody asked for these: see hs_saving_be_automatic */
    bool on_stop;      /**< write one when the run is stopped by a signal or by its time limit */
    double deadline_s; /**< time of hs_time_now_s at which the run must be over; 0: no limit */
    /** Writes a checkpoint; set by the deck. */
    hs_status (*write)(void *deck, const char *path, hs_error *err);
} hs_saving;

void hs_saving_fini(hs_saving *saving);
/** For runs whose deck says nothing of checkpoints: one each so many seconds, autosave.STEP.h5, each in place of the
 *  one before; when it cannot be written, the run goes on without. 0 or less: none. */
void hs_saving_be_automatic(hs_saving *saving, double every_s);
/** The deck says how it wants checkpoints. */
void hs_saving_be_asked(hs_saving *saving);
/** The deck has come to its end: automatic checkpoints have served (collective). */
void hs_sim_remove_automatic(hs_sim *sim);
/** The names of the files that are kept, for the checkpoint @p path among them; and taken from the checkpoint @p path
 *  that a run goes on from, so that it deletes what the run before it would have deleted. Names that do not follow the
 *  present pattern are not taken, and none if the file is not where it was written. */
HS_MUST_USE hs_status hs_saving_put_kept(const hs_saving *saving, const char *path, hs_state *state, hs_error *err);
HS_MUST_USE hs_status hs_saving_get_kept(hs_saving *saving, const char *path, hs_state *state, hs_error *err);
/** Settings of the program, kept over `clear`. */
void hs_saving_inherit(hs_saving *saving, hs_saving *from);
/** Whether something is due that the deck asks for (collective). */
bool hs_sim_is_save_due(hs_sim *sim);
/** After a step (collective): write what is due. */
HS_MUST_USE hs_status hs_sim_save_if_due(hs_sim *sim, hs_error *err);
/** A checkpoint under the default name, for a run that stops now; *path is the caller's (collective). */
HS_MUST_USE hs_status hs_sim_save_now(hs_sim *sim, char **path, hs_error *err);
/** HS_INTERRUPTED, after a checkpoint was written if that is wanted and there is something to save; @p where ends the
 *  sentence "stopped by a signal ..." (collective). */
HS_MUST_USE hs_status hs_sim_stop(hs_sim *sim, const char *where, hs_error *err);

/** All of the simulation but atoms and styles' words: moved into @p state or back. */
HS_MUST_USE hs_status hs_sim_keep_box(hs_sim *sim, hs_state *state, hs_error *err);
HS_MUST_USE hs_status hs_sim_keep_box_of_forces(hs_sim *sim, hs_state *state, hs_error *err);
HS_MUST_USE hs_status hs_sim_keep_run(hs_sim *sim, hs_state *state, hs_error *err);
/** What only the same run goes on with: the state of its rows, and what was counted when it began, since when atoms may have come
 *  and gone (degrees of freedom of all temperatures, atoms of each type for long-range corrections). */
HS_MUST_USE hs_status hs_sim_keep_under_way(hs_sim *sim, hs_state *state, hs_error *err);
/** Tables and styles as at the start of a run; before values are read back (collective).  sim/run.c */
HS_MUST_USE hs_status hs_sim_init_resumed(hs_sim *sim, hs_error *err);
/** After atoms and values were read: halo, cells and lists as they were, without computing forces anew (collective). */
HS_MUST_USE hs_status hs_sim_setup_resumed(hs_sim *sim, hs_error *err);

#endif
