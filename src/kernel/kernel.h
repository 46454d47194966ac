/** Pair kernels: what they read and write, and how one is chosen for the machine. */
#ifndef HS_KERNEL_KERNEL_H
#define HS_KERNEL_KERNEL_H

#include "base/error.h"
#include "neighbor/clusters.h"
#include "neighbor/near_places.h"
#include "neighbor/settle.h"

/** Instruction sets kernels are compiled for, from plain to wide. */
typedef enum { HS_ISA_PORTABLE, HS_ISA_SSE2, HS_ISA_AVX2, HS_ISA_AVX512, HS_N_ISAS } hs_isa;

extern const char *const hs_isa_names[]; /**< ended by NULL */

/** Precision of pair forces. Positions, velocities and all sums are double in both. */
typedef enum {
    HS_PRECISION_DOUBLE,
    HS_PRECISION_MIXED, /**< pairs in float, relative to the i-cluster; sums of forces and energies in double */
    HS_PRECISION_FIXED, /**< pairs in double, sums in 64-bit fixed point: reproducible in any order (kernel/fixed.h) */
    HS_N_PRECISIONS
} hs_precision;

extern const char *const hs_precision_names[]; /**< those a user may name: double, mixed; ended by NULL */
/** By name; an error naming the nearest when there is none of that name. */
HS_MUST_USE hs_status hs_precision_get(const char *name, hs_precision *precision, hs_error *err);
/** Widest instruction set of this machine that kernels exist for. */
hs_isa hs_isa_best(void);
/** By name ("avx2"); an error when there is none of that name or the machine lacks it. "auto" or "" is the best. */
HS_MUST_USE hs_status hs_isa_get(const char *name, hs_isa *isa, hs_error *err);

/** The pass over positions compiled for it. */
hs_settle hs_isa_settle(hs_isa isa);
hs_near_find hs_isa_near(hs_isa isa);

/** Parameters of all type pairs as kernels read them. Row (i, j), both from 0 (0 is unused by types from 1 on), starts
 *  at values[(i * n_types + j) * stride]: two squared distances (0: the pair does not interact), then the evaluator's. */
enum {
    HS_TABLE_CUT_R2,    /**< cutoff^2 */
    HS_TABLE_LISTED_R2, /**< (cutoff + skin)^2, the next larger number: listed pairs are closer than this */
    HS_TABLE_PARAMS     /**< first of the evaluator's parameters */
};
typedef struct hs_pair_table {
    int n_types;          /**< kernel types: atom types times exclusion classes, plus 1 */
    int stride;           /**< HS_TABLE_PARAMS + n_params */
    double *values;       /**< owned */
    bool is_uniform;      /**< all rows that can occur are the same, namely row (1, 1) */
    const double *shared; /**< borrowed: numbers that the evaluator looks up, of all pairs of types; NULL: none */
} hs_pair_table;

/** Fixed point: bits that a pair's force and energy may have on their grid: few enough that sums over the neighbors of an atom, 8,192 of
 *  the largest and any number of usual ones, fit 64-bit integers. */
enum { HS_FIXED_BITS = 50 };

/** What all kernels of one force evaluation read. Everything is borrowed and const. */
typedef struct hs_kernel_input {
    const double *x[3];        /**< positions, local and halo, in cluster order */
    const double *x_listed[3]; /**< positions when LAMMPS would have built its list; NULL unless `listed_only` */
    bool is_flat;        /**< all z are 0: kernels may leave them alone, and forces along z are the caller's to clear */
    bool listed_only;    /**< count only pairs that were within their listed distance then */
    const int32_t *type; /**< kernel types, local and halo */
    const double *radius;  /**< distance, local and halo; NULL unless an evaluator of the pair style needs it */
    bool listed_by_radius; /**< listed pairs are within radius_i + radius_j + skin, too */
    double skin;           /**< distance; read only when listed_by_radius or listed_only */
    const int32_t *site,
        *site_listed; /**< mixed precision, methods with clusters: packed positions (kernel/packed.h) */
    double unit;      /**< distance: their unit */
    bool gathers;     /**< the machine's gather instructions are fast (hs_isa_gathers_fast) */
    bool looks_far;   /**< its cores find independent operations far ahead (hs_machine_looks_far) */
    const hs_pair_table *table;
    double magic_force, magic_energy; /**< fixed point only: see kernel/accumulate.h */
} hs_kernel_input;

/** (radius_i + radius_j + skin)^2 of a pair, the same number wherever it is computed. */
static inline double hs_listed_by_radius_r2(const hs_kernel_input *in, int i, int j)
{
    const double reach = in->radius[i] + in->radius[j] + in->skin;
    return reach * reach;
}

struct hs_histogram;
/** What a kernel adds to; private to one thread. */
typedef struct hs_kernel_output {
    double *f[3];    /**< forces on local and halo atoms; in fixed point the doubles hold 64-bit integers */
    float *packed_f; /**< mixed precision, methods with clusters: forces of packed clusters */
    double energy;
    double virial[6]; /**< sum of r_a F_b over pairs: xx yy zz xy xz yz */
    /* fixed point only: the same as multiples of the grid, and the largest force/r and energy of a pair */
    __int128 energy_fixed, virial_fixed[6];
    double peak_force, peak_energy;
    struct hs_histogram *histogram; /**< borrowed: of the thread; read by the kernel that counts distances only */
} hs_kernel_output;

/** Forces (and energy and virial) between the atoms of one i-cluster and the entries of its list. */
typedef void (*hs_cluster_kernel)(const hs_kernel_input *in, hs_kernel_output *out, int first,
                                  const hs_cluster_entry *entry, int n_entries);

/** Elements behind the last of a list of neighbors that vector code may read: the widest vector has so many lanes. */
enum { HS_VERLET_PAD = 16 };
/** The same between the atoms begin to end - 1 and the neighbors of each: those of atom i stand from neighbor[start[i - begin]]
 *  up to, without, neighbor[start[i - begin + 1]]. Up to HS_VERLET_PAD neighbors beyond the last are read, and zero is added to
 *  their forces: they must be atoms that the thread may write to. */
typedef void (*hs_verlet_kernel)(const hs_kernel_input *in, hs_kernel_output *out, int begin, int end,
                                 const int64_t *start, const int32_t *neighbor);

/** The same for n pairs (i[k], j[k]) of any atoms that the thread may write to. Up to HS_VERLET_PAD pairs beyond the last are read, and
 *  zero is added to their forces. */
typedef void (*hs_pairs_kernel)(const hs_kernel_input *in, hs_kernel_output *out, int64_t n, const int32_t *i,
                                const int32_t *j);

/** Of n candidate entries of the i-cluster at `first`, write to @p to the pairs within their listed distance at in->x: without entries
 *  that have none, the rest ordered so that consecutive ones use the same rows, and padded to a multiple of the kernel's
 *  group. @p entry is scratch afterwards and must be readable up to such a multiple (padded with valid entries); @p to has
 *  room for as many. Returns the number written, and adds the number of their pairs to *n_pairs. */
typedef int (*hs_list_refine)(const hs_kernel_input *in, int first, hs_cluster_entry *entry, int n, int group,
                              hs_cluster_entry *to, int64_t *n_pairs);
extern const hs_list_refine hs_list_refine_portable, hs_list_refine_sse2, hs_list_refine_avx2, hs_list_refine_avx512;
hs_list_refine hs_isa_refine(hs_isa isa);

/** Whether this machine's instructions that gather are faster than loads one by one. */
bool hs_isa_gathers_fast(hs_isa isa);
/** Whether this machine's cores look so far ahead for operations that wait for nothing that kernels can take rows in turn
 *  (hs_kernel_set.in_turn). */
bool hs_machine_looks_far(void);

/** n rounds of multiplications and additions of vectors of doubles that do not wait for one another; how many operations on
 *  numbers these are. Returns their result, so that none can be left out. */
typedef double (*hs_peak_loop)(int64_t n, double *operations);
extern const hs_peak_loop hs_peak_loop_portable, hs_peak_loop_sse2, hs_peak_loop_avx2, hs_peak_loop_avx512;
hs_peak_loop hs_isa_peak(hs_isa isa);

/** The kernels of one evaluator for one instruction set. Indices: [with energy and virial][by type][listed pairs only].
 *  Lists must be padded to a multiple of `group` entries, with masks 0. */
typedef struct hs_kernel_set {
    int group;
    int lanes; /**< pairs of one vector */
    hs_cluster_kernel cluster[2][2][2];
    /** [by type]: forces as above, but each row of pairs is measured and added before the next. That takes fewer registers, and on cores
     *  that look far ahead less time. NULL: it does not pay with these vectors. */
    hs_cluster_kernel in_turn[2];
    hs_cluster_kernel
        counting; /**< forces of one type pair, and its distances (kernel/tally.h); NULL in mixed precision */
    hs_verlet_kernel verlet[2][2]; /**< lists hold the listed pairs only: no third index */
    hs_pairs_kernel pairs[2][2];
} hs_kernel_set;

/** The kernel of a set for lists of clusters with that input, on this machine. */
hs_cluster_kernel hs_kernel_for_clusters(const hs_kernel_set *set, const hs_kernel_input *in, bool with_energy,
                                         bool listed_only);

/** A potential compiled for every instruction set; made by kernel/instantiate.h from the file of a pair style. */
typedef struct hs_evaluator {
    int n_params; /**< doubles per type pair */
    /** One more parameter follows those of the type pair: radius_i + radius_j, which is the cutoff of the pair, too. */
    bool has_radii;
    /** The potential of one pair: force/r and energy from r^2, the pair's parameters and hs_pair_table.shared. The oracle of
     *  all kernels. */
    void (*single)(const double *params, const double *shared, double r2, double *force_over_r, double *energy);
    const hs_kernel_set *set[HS_N_ISAS][HS_N_PRECISIONS]; /**< NULL where not compiled */
} hs_evaluator;

/** Parameters that an evaluator may have for a pair of types, without the sum of radii. */
enum { HS_EVALUATOR_PARAMS_MAX = 63 };
/** The potential of one pair of kernel types i and j, and of the sum of the two radii where the evaluator has those;
 *  false, and nothing is written, beyond the cutoff. */
bool hs_evaluator_pair(const hs_evaluator *evaluator, const hs_pair_table *table, int i, int j, double sum_of_radii,
                       double r2, double *force_over_r, double *energy);

/** Fill hs_pair_table.is_uniform: whether every pair of the given kernel types (1 ..) has the same row. */
bool hs_pair_table_is_uniform(const hs_pair_table *table);

#endif
