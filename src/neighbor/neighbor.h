/** Neighbor search: settings of the deck, when lists are due, and what the methods keep.
 *
 *  LAMMPS builds its lists on a schedule (neigh_modify every, delay, check) and takes only pairs that were within
 *  cutoff + skin at the last build. With a lax schedule (`check no`, or a long delay) pairs can come within the cutoff
 *  unseen, and LAMMPS's published thermo tables contain that. To give the same digits Halfshell keeps the same schedule:
 *  hs_neighbor_is_due says when LAMMPS would build, x_listed remembers the positions of that moment, and while an atom is
 *  more than half the skin away from there, forces count only pairs that LAMMPS's list would hold ("scheduled" pairs).
 *  With `neighbor_method ... pairs exact` every pair within the cutoff counts at every step. */
#ifndef HS_NEIGHBOR_NEIGHBOR_H
#define HS_NEIGHBOR_NEIGHBOR_H

#include "core/atoms.h"
#include "core/box.h"
#include "neighbor/chains.h"
#include "neighbor/clusters.h"
#include "neighbor/settle.h"
#include "parallel/parallel.h"

/** `neigh_modify exclude`: pairs that do not interact. */
typedef struct hs_exclusion {
    enum { HS_EXCLUDE_TYPE, HS_EXCLUDE_GROUP } kind;
    int a, b; /**< two types, or two group bits */
} hs_exclusion;

/** How pairs are found. */
typedef enum {
    HS_METHOD_NSQ,
    HS_METHOD_LINKED,
    HS_METHOD_INCREMENTAL,
    HS_METHOD_HASH,
    HS_METHOD_CELL,
    HS_METHOD_VERLET,
    HS_METHOD_CLUSTER,
    HS_METHOD_AUTO, /**< one of those with lists, chosen by sim/tuner.h */
    HS_N_METHODS
} hs_neighbor_method;

/** Names of all methods, ended by NULL. What they do is in the table of sim/methods.h. */
extern const char *const hs_neighbor_methods[];

/** Settings of `neighbor`, `neigh_modify` and `neighbor_method`. */
typedef struct hs_neighbor_settings {
    double skin;             /**< distance */
    int64_t every, delay;    /**< steps */
    bool check;              /**< build only when an atom has moved half the skin */
    bool once;               /**< build at the start of a run only */
    bool exact;              /**< count every pair within the cutoff, whatever the schedule says */
    hs_exclusion *exclusion; /**< owned [n_exclusions] */
    int n_exclusions;
    hs_neighbor_method method;
    double cell;         /**< edge of the cells as a fraction of the cutoff; 0: as the method likes it */
    hs_cell_order order; /**< of cells, and of atoms in memory */
    bool is_cube;        /**< the stencil is the whole cube of cells (linked, incremental, hash) */
} hs_neighbor_settings;

/** Counters of the present run, for the log. */
typedef struct hs_neighbor_counters {
    int64_t n_builds; /**< scheduled list builds, without the one of the set-up (as LAMMPS counts them) */
    /** Builds with check yes at which an atom had moved half the skin as soon as one was allowed. */
    int64_t n_dangerous;
    int64_t n_late_steps;    /**< steps on which an atom was more than half the skin from its listed place */
    int64_t first_late_step; /**< the first of them, -1 for none */
    int64_t n_pairs;         /**< pairs in this rank's lists of the last build; 0 for methods without lists */
} hs_neighbor_counters;

typedef struct hs_neighbor {
    hs_neighbor_settings settings;
    hs_neighbor_counters counters;
    int64_t ago;         /**< steps since the last scheduled build */
    double *x_listed[3]; /**< atom field: positions at the last scheduled build, in the images of x; with halo */
    double lo_listed[3], hi_listed[3], tilt_listed[3]; /**< the box at the last scheduled build */
    bool was_flat;                                     /**< all z of this rank were 0 at the last scheduled build */
    bool is_flat; /**< in two dimensions: they were, and are, on all ranks, so that z may be left alone */
    bool is_late; /**< an atom is more than half the skin from x_listed: pairs may be missing from the list */
    hs_cells cells;
    hs_clusters clusters;
    hs_chains chains;       /**< methods linked, incremental, hash: of all atoms, or of the small ones */
    hs_chains coarse;       /**< of the large ones, when has_levels */
    bool has_levels;        /**< small and large atoms are in cells of their own: see neighbor/chains.h */
    int64_t last_sort_step; /**< when atoms were last sorted for them; -1: not in this run */
} hs_neighbor;

/** Defaults of LAMMPS: delay 10, every 1, check yes; the skin comes with the units. Adds a field to the atoms. */
HS_MUST_USE hs_status hs_neighbor_init(hs_neighbor *neighbor, hs_atoms *atoms, double skin, hs_error *err);
void hs_neighbor_fini(hs_neighbor *neighbor);

/** Choose the method by name; an error naming the nearest when there is none of that name. */
HS_MUST_USE hs_status hs_neighbor_set_method(hs_neighbor *neighbor, const char *name, hs_error *err);
/** Start of a run: zero the counters. */
void hs_neighbor_start(hs_neighbor *neighbor);
/** Start of a run without set-up: schedule, lists and counters of builds go on, as in LAMMPS; late steps are counted anew. */
void hs_neighbor_continue(hs_neighbor *neighbor);
/** How far this rank's atoms have moved from their listed positions. */
typedef struct hs_displacements {
    double largest2; /**< the largest squared distance; infinite when a coordinate is not a number */
    bool has_z;      /**< some z is not 0, or is not known to have been when lists were made */
} hs_displacements;

/** Once per step after the drift: round the positions to their grid, if there is one (@p magic, see hs_env), and measure how far atoms have
 *  moved, with the pass made for the machine's instruction set. @p is_planar: z are known to be 0. Not collective. */
hs_displacements hs_neighbor_settle(const hs_neighbor *neighbor, hs_atoms *atoms, double magic, bool is_2d,
                                    bool is_planar, hs_settle settle);
/** Then (collective), with what this rank has measured: bring is_late and is_flat up to date (in a box that changes, the displacements
 *  of its corners count, too), and tell whether lists are due: by LAMMPS's
 *  schedule, or with `pairs exact` when an atom has moved more than half the skin. An error when a position is not a number, or
 *  when a rank holds one in @p err already. Also agrees on *stop: whether this rank was asked to stop becomes whether any was. */
HS_MUST_USE hs_status hs_neighbor_is_due(hs_neighbor *neighbor, const hs_atoms *atoms, const hs_box *box,
                                         const hs_displacements *moved, const hs_parallel *parallel, int64_t step,
                                         bool *is_due, bool *stop, hs_error *err);
/** A scheduled build happens now: remember the positions. */
void hs_neighbor_list_now(hs_neighbor *neighbor, const hs_atoms *atoms);

#endif
