/** Pairs of atoms within any range, at the present positions or those of the latest forces: for what is measured from pairs.
 *
 *  Independent of the neighbor method, its lists and their range: a scan copies the positions, makes a halo of its own as
 *  wide as asked for, sorts all into cells and visits each pair once. It costs some timesteps' time and about 100 bytes an
 *  atom while it lasts. On several ranks each pair is visited on one of them. As in LAMMPS, whose computes see its lists, pairs that
 *  `neigh_modify exclude` leaves out are not visited. */
#ifndef HS_STYLE_PAIR_SCAN_H
#define HS_STYLE_PAIR_SCAN_H

#include "comm/halo.h"
#include "style/pair.h"

enum { HS_PAIR_BATCH = 256, HS_PAIR_VALUES_MAX = 7 };

/** The potential as it acts now, for computes that need more of it than its sums. Borrowed; valid until the next step. */
typedef struct hs_pair_view {
    const hs_pair *pair;        /**< NULL: atoms do not interact */
    const hs_pair_table *table; /**< [pair->n_parts], of those parts that have an evaluator */
    bool is_uniform;            /**< all pairs of atoms are listed up to the same distance */
    const int32_t *type;        /**< kernel types of the local atoms */
    const bool *excluded; /**< [n_kernel_types^2]: whether `neigh_modify exclude` leaves such pairs out; NULL: none */
    int n_kernel_types;
    double cutoff_max; /**< distance; 0 before the first run, or without a pair style */
    /* What follows is set where there are cutoffs. */
    const double *x_listed[3]; /**< [n_local]: where atoms were when the lists were made */
    hs_box box_listed;         /**< the box at that time */
    bool listed_only;      /**< lists come late: of the pairs within their cutoff only those that were listed count */
    bool listed_by_radius; /**< listed pairs are within the sum of their radii and the skin, too */
    double skin;           /**< distance */
    const hs_clusters *clusters;
    /** Pairs whose forces count, of the last scheduled build; NULL: not kept, or atoms have moved since these forces, and with
     *  them not those of the halo. */
    const struct hs_cluster_list *list;
} hs_pair_view;

/** Some pairs: atom i is local, j local or of the scan's halo (j >= n_local). */
typedef struct hs_pair_batch {
    int n;
    int32_t i[HS_PAIR_BATCH], j[HS_PAIR_BATCH];
    double dx[3][HS_PAIR_BATCH]; /**< r_j - r_i, distance */
    double r2[HS_PAIR_BATCH];    /**< distance^2 */
} hs_pair_batch;

/** Called by several threads at once, each with a number below hs_threads_get(). */
typedef void (*hs_pair_visit)(void *context, int thread, const hs_pair_batch *batch);

typedef struct hs_pair_scan {
    double range; /**< pairs closer than this */
    hs_isa isa;   /**< instruction set of the search */
    /** Owned: copies of local atoms (same indices), and the scan's own halo: x, id, mask, and kernel types in type. */
    hs_atoms atoms;
    hs_halo halo; /**< owned */
    int n_all;    /**< local and halo atoms */
    double lo[3], inv_edge[3];
    int n_cells[3];
    int axis[3];          /**< x, y, z in the order in which cells follow one another, the last one fastest */
    int32_t *source_of;   /**< owned [n_halo]: local index of the original of a halo atom, -1: on another rank */
    int32_t *start;       /**< owned [cells + 1] */
    int32_t *index;       /**< owned [n_all]: atoms in the order of cells */
    double *x[3];         /**< owned [n_all]: their positions in that order */
    uint32_t *mask;       /**< atom field of the copies with room for the halo */
    int64_t *id;          /**< the same */
    double *radius;       /**< the same; NULL: no radii */
    double *x_listed[3];  /**< the same: places of the lists, of scans that ask for them; NULL: all pairs count */
    const bool *excluded; /**< borrowed, as in hs_pair_view */
    int n_kernel_types;
} hs_pair_scan;

/** Get ready to visit pairs (collective). Zero the scan before; always followed by hs_pair_scan_end, also after an error. */
HS_MUST_USE hs_status hs_pair_scan_begin(hs_pair_scan *scan, hs_env *env, double range, hs_error *err);
/** The same at the places of the latest forces, for what is part of their energy or virial: hs_pair_scan_eval leaves out
 *  pairs that forces leave out, where lists come late. */
HS_MUST_USE hs_status hs_pair_scan_begin_at_forces(hs_pair_scan *scan, hs_env *env, double range, hs_error *err);
/** The same at the present places, with those of the lists (x_listed) where lists come late. */
HS_MUST_USE hs_status hs_pair_scan_begin_with_lists(hs_pair_scan *scan, hs_env *env, double range, hs_error *err);
/** The same at the places of the latest scheduled lists, where there are cutoffs (hs_pair_view). */
HS_MUST_USE hs_status hs_pair_scan_begin_at_lists(hs_pair_scan *scan, hs_env *env, double range, hs_error *err);
/** Squared distance of a pair of the scan's atoms when the lists were made, where scan->x_listed is there. */
static inline double hs_pair_scan_listed_r2(const hs_pair_scan *scan, int i, int j)
{
    double r2 = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        const double d = scan->x_listed[axis][j] - scan->x_listed[axis][i];
        r2 += d * d;
    }
    return r2;
}

/** Whether a pair of the scan's atoms was near enough when the lists were made. */
static inline bool hs_pair_scan_is_listed(const hs_pair_scan *scan, const hs_pair_view *view,
                                          const hs_pair_table *table, double sum_of_radii, int i, int j)
{
    if (scan->x_listed[0] == NULL) return true;
    const int type_i = scan->atoms.type[i], type_j = scan->atoms.type[j];
    const double *row = table->values + (size_t)(type_i * table->n_types + type_j) * (size_t)table->stride;
    const double r2 = hs_pair_scan_listed_r2(scan, i, j);
    const double reach = sum_of_radii + view->skin;
    return r2 < row[HS_TABLE_LISTED_R2] && (!view->listed_by_radius || r2 < reach * reach);
}

/** Force over distance and energy of a pair of the scan's atoms in one part of the pair style; false: it has none. */
static inline bool hs_pair_scan_eval_part(const hs_pair_scan *scan, const hs_pair_view *view, int part, int i, int j,
                                          double r2, double *force_over_r, double *energy)
{
    const hs_evaluator *evaluator = view->pair->part[part]->style->evaluator;
    const double sum_of_radii = scan->radius != NULL ? scan->radius[i] + scan->radius[j] : 0.0;
    return evaluator != NULL &&
           hs_evaluator_pair(evaluator, &view->table[part], scan->atoms.type[i], scan->atoms.type[j], sum_of_radii, r2,
                             force_over_r, energy) &&
           hs_pair_scan_is_listed(scan, view, &view->table[part], sum_of_radii, i, j);
}

/** The same over all parts. */
static inline void hs_pair_scan_eval(const hs_pair_scan *scan, const hs_pair_view *view, int i, int j, double r2,
                                     double *force_over_r, double *energy)
{
    *force_over_r = *energy = 0.0;
    for (int k = 0; k < view->pair->n_parts; ++k) {
        double f, e;
        if (!hs_pair_scan_eval_part(scan, view, k, i, j, r2, &f, &e)) continue;
        *force_over_r += f;
        *energy += e;
    }
}

/** Type of a local or halo atom. */
static inline int hs_pair_scan_type(const hs_pair_scan *scan, int i)
{
    return scan->atoms.type[i] % (scan->atoms.n_types + 1);
}
/** Visit every pair once. Pairs that threads visit at the same time have no atom in common, so that a visitor may add to values of its
 *  atoms; a thread meets the same pairs in the same order each time. Not collective. */
void hs_pair_scan_visit(const hs_pair_scan *scan, hs_pair_visit visit, void *context);
/** Values per atom, summed over pairs by the threads: scan->atoms.f of the local and halo atoms is three such values. Add
 *  those of halo atoms to their owners' (collective). */
void hs_pair_scan_reverse(hs_pair_scan *scan);
/** What each pair of a batch gives to each of its two atoms: values[k][p] of pair p. */
typedef void (*hs_pair_share)(void *context, const hs_pair_batch *batch, double (*values)[HS_PAIR_BATCH]);
typedef struct hs_pair_sharing {
    int n;       /**< values of a pair, at most HS_PAIR_VALUES_MAX */
    bool is_odd; /**< atom j of a pair gets the value with the other sign */
    hs_pair_share share;
    void *context;
    /** No value should be larger; if one is, all is done once more. 0: not known, which takes a pass over the pairs to find. The same
     *  on all ranks. */
    double expected;
} hs_pair_sharing;
/** Sums of such values over the pairs of each local atom: sums[k * n_local + i], the same bits for any threads and ranks, to about
 *  1e-14 of the largest value of a pair, or of the expected one (collective). */
HS_MUST_USE hs_status hs_pair_scan_share(hs_pair_scan *scan, const hs_env *env, const hs_pair_sharing *sharing,
                                         double *sums, hs_error *err);
/** Local index of a halo atom whose original is on this rank; -1 when it is another's. */
int hs_pair_scan_source(const hs_pair_scan *scan, int j);
void hs_pair_scan_end(hs_pair_scan *scan);

#endif
