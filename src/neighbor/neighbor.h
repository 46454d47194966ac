/** Neighbor search: settings of the deck, and (below) the cells and lists of the methods. */
#ifndef HS_NEIGHBOR_NEIGHBOR_H
#define HS_NEIGHBOR_NEIGHBOR_H

#include "core/atoms.h"
#include "core/box.h"

/** `neigh_modify exclude`: pairs that do not interact. */
typedef struct hs_exclusion {
    enum { HS_EXCLUDE_TYPE, HS_EXCLUDE_GROUP } kind;
    int a, b;   /**< two types, or two group bits */
} hs_exclusion;

/** Settings of `neighbor` and `neigh_modify`; set by deck commands. */
typedef struct hs_neighbor_settings {
    double skin;              /**< distance */
    int64_t every, delay;     /**< steps */
    bool check;               /**< rebuild only when an atom has moved half the skin */
    bool once;                /**< build at the start of a run only */
    hs_exclusion *exclusion;  /**< owned [n_exclusions] */
    int n_exclusions;
    char method[32];          /**< name of the neighbor method */
} hs_neighbor_settings;

/** Counters of the present run, for the log. */
typedef struct hs_neighbor_counters {
    int64_t n_builds;        /**< list builds as LAMMPS counts them: without the one of the set-up */
    int64_t n_dangerous;     /**< builds at which an atom had already moved more than half the skin */
    int64_t n_pairs;         /**< pairs in the lists of the last build, all ranks; 0 for methods without lists */
} hs_neighbor_counters;

typedef struct hs_neighbor {
    hs_neighbor_settings settings;
    hs_neighbor_counters counters;
} hs_neighbor;

/** Names of all methods, ended by NULL, and one line of help for each. */
extern const char *const hs_neighbor_methods[];
extern const char *const hs_neighbor_method_help[];

#endif
