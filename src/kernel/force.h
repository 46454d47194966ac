/** Pair forces of all atoms: kernels over threads into private buffers, and their reduction. */
#ifndef HS_KERNEL_FORCE_H
#define HS_KERNEL_FORCE_H

#include <string.h>

#include "core/atoms.h"
#include "kernel/kernel.h"
#include "kernel/packed.h"
#include "neighbor/chains.h"
#include "neighbor/cluster_search.h"
#include "parallel/share.h"

enum {
    HS_FORCE_BLOCK_BITS = 7, /**< forces are cleared and reduced in blocks of this many atoms */
    HS_FORCE_BLOCK = 1 << HS_FORCE_BLOCK_BITS,
    HS_FORCE_CHUNKS = 64 /**< parts of the clusters that are weighed to balance the threads */
};

/** Atoms that may be neighbors of those of a cell, and where they are. Zero it before use. */
typedef struct hs_candidates {
    int32_t *index; /**< owned [n] */
    double *x[3];   /**< owned [n] */
    double *r2;     /**< owned scratch [n]: distances^2 from the atom at hand */
    int32_t *near;  /**< owned scratch [n + HS_VERLET_PAD]: its neighbors */
    int n, capacity;
} hs_candidates;

/** Stages of an evaluation. Where there are messages, some inner work, which needs no other rank's atoms, is done while they
 *  travel: a part while positions come; then all outer work, and most of the rest; a part while forces go. */
typedef enum { HS_STAGE_ALL, HS_STAGE_BEFORE, HS_STAGE_MAIN, HS_STAGE_AFTER, HS_N_STAGES } hs_force_stage;

/** Buffers of one thread. Thread 0 adds to the atoms' own force arrays. */
typedef struct hs_force_buffer {
    double *f[3];           /**< owned (borrowed from atoms for thread 0): [n_local + n_halo + pad] */
    int n_axes;             /**< of f that are cleared, added to and reduced: 2 where all is flat */
    float *packed_f;        /**< owned: forces of packed clusters; only where there are such */
    unsigned char *touched; /**< owned: block b of HS_FORCE_BLOCK atoms was written to (and cleared before), or of
                                 HS_PACKED_BLOCK packed numbers */
    hs_entry_list entries;  /**< owned: list of the i-cluster at hand (method cell), or all of the thread's (cluster) */
    hs_search search;
    hs_candidates candidates;        /**< methods linked, incremental, hash, and nsq in fixed point */
    hs_error error;                  /**< what went wrong on this thread */
    hs_kernel_output out;            /**< its f are those above */
    int64_t weight[HS_FORCE_CHUNKS]; /**< methods without lists: pairs met in each chunk of the clusters or cells */
    int uncut_begin, uncut_end; /**< stored lists: chunks of the thread's share that are not cut, see hs_list_take */
} hs_force_buffer;

/** The search for cluster pairs compiled for that instruction set. */
hs_cluster_find hs_isa_find(hs_isa isa);

/** Work space of force evaluations; one per simulation. Zero it before use. */
typedef struct hs_force_space {
    hs_force_buffer *buffer; /**< owned [n_threads] */
    hs_share *share;         /**< owned [HS_N_STAGES * n_threads]: stored lists, chunks that no thread has taken yet */
    int n_threads;
    int64_t capacity_atoms;          /**< room of each buffer */
    int64_t capacity_packed;         /**< room of each packed_f */
    hs_packed packed;                /**< mixed precision, methods with clusters */
    int64_t weight[HS_FORCE_CHUNKS]; /**< methods without lists: pairs of each chunk at the evaluation before */
    unsigned char *is_open;          /**< owned [capacity_open]: see hs_force_find_open */
    int64_t capacity_open;
    uint64_t open_version; /**< of the halo that is_open was found for; 0: none */
} hs_force_space;

struct hs_cluster_list;
struct hs_verlet_list;
struct hs_force_job;
struct hs_pair_counter;

/** Exchange with other ranks during an evaluation. Called outside of parallel regions. */
typedef struct hs_force_halo {
    void (*await)(void *context); /**< halo atoms must have their positions when this returns; may be called again */
    void (*send)(void *context);  /**< forces on halo atoms are complete now; NULL: not yet, they are added to */
    void *context;                /**< borrowed */
    bool is_remote;               /**< there are messages, and work may be done while they travel */
} hs_force_halo;

/** What to compute with. In fixed point (precision HS_PRECISION_FIXED) see hs_force_job_set_grid. */
typedef struct hs_force_job {
    hs_atoms *atoms;
    const hs_cells *cells;
    const hs_clusters *clusters;
    const hs_chains *chains; /**< methods linked, incremental and hash only */
    /** The same: chains of large atoms, whose radii make the cutoffs; NULL: `chains` hold all atoms. */
    const hs_chains *coarse;
    const hs_evaluator *evaluator;
    hs_isa isa;
    hs_precision precision;
    const struct hs_cluster_list *list;  /**< method cluster only */
    const struct hs_verlet_list *verlet; /**< method verlet only */
    hs_kernel_input input;               /**< x, type and table must be set; see hs_kernel_input */
    double cutoff_max;
    bool with_energy;
    bool is_added; /**< add to the forces that the atoms have, not overwrite them */
    /** Fixed point: blocks of forces that are not open are settled, to multiples of this, as they are reduced; 0: none are,
     *  more will be added. */
    double settling_unit;
    const hs_force_halo *halo;      /**< borrowed; NULL: the halo is there, and the caller sends its forces */
    const unsigned char *is_remote; /**< borrowed [n_halo]: halo atoms of other ranks; NULL: there are none */
    /** Borrowed: counts the distances of the pairs; see hs_force_can_count. NULL: no. */
    struct hs_pair_counter *counter;
} hs_force_job;

/** Energy and virial of this rank's pairs. In fixed point they, and the atoms' forces, are integers: multiples of the grid
 *  of the job, for hs_force_settle and hs_exact_add_scaled; the double fields are 0. */
typedef struct hs_force_result {
    double energy, virial[6];
    __int128 energy_fixed, virial_fixed[6];
    double peak_force;  /**< fixed point: largest |force|/r of a pair */
    double peak_energy; /**< fixed point, with_energy: largest |energy| of a pair */
} hs_force_result;

/** sum += added; peaks become the larger ones. */
void hs_force_result_add(hs_force_result *sum, const hs_force_result *added);

/** Grid of fixed-point sums: forces are multiples of 2^force, energies and virials of 2^energy, in their units. */
typedef struct hs_fixed_grid {
    int force, energy;
} hs_fixed_grid;

/** The finest grid on which a value has fewer than that many bits (HS_FIXED_BITS for forces and energies). */
int hs_fixed_exponent(double value, int bits);
/** Set the job up for fixed point on that grid. */
void hs_force_job_set_grid(struct hs_force_job *job, hs_fixed_grid grid);
/** Find the blocks of forces of local atoms that are open after an evaluation: those to which forces come home from the halo, for it has
 *  copies of source[n_sources], and the last one, which may have halo atoms in it. @p version: of that halo, not 0; it is
 *  done once for each. */
HS_MUST_USE hs_status hs_force_find_open(hs_force_space *space, int n_local, const int32_t *source, int n_sources,
                                         uint64_t version, hs_error *err);
/** Settle the open blocks, after hs_halo_reverse: forces on local atoms, multiples of 2^exponent, become numbers; is_flat: those along z
 *  are 0. The other blocks were settled in the evaluation (job.settling_unit). Threaded. */
void hs_force_settle(const hs_force_space *space, hs_atoms *atoms, hs_isa isa, int exponent, bool is_flat);

/** Make the block of atom i ready to be added to. The last block may reach into the arrays' padding. */
static inline void hs_force_touch(hs_force_buffer *buffer, int64_t i, int64_t n_room)
{
    const int64_t block = i >> HS_FORCE_BLOCK_BITS;
    if (buffer->touched[block]) return;
    buffer->touched[block] = 1;
    const int64_t begin = block << HS_FORCE_BLOCK_BITS;
    const int64_t end = begin + HS_FORCE_BLOCK < n_room ? begin + HS_FORCE_BLOCK : n_room;
    for (int axis = 0; axis < buffer->n_axes; ++axis)
        memset(buffer->f[axis] + begin, 0, (size_t)(end - begin) * sizeof(double));
}

/** Make a block of packed forces ready to be added to. */
static inline void hs_force_touch_packed(hs_force_buffer *buffer, int64_t block)
{
    if (buffer->touched[block]) return;
    buffer->touched[block] = 1;
    memset(buffer->packed_f + (block << HS_PACKED_BLOCK_BITS), 0, HS_PACKED_BLOCK * sizeof *buffer->packed_f);
}

/** Whether this evaluation reads packed clusters. */
static inline bool hs_force_is_packed(const hs_force_job *job) { return job->input.site != NULL; }
/** Where the cluster that begins with atom `first` is for the kernels. */
static inline int hs_force_place(const hs_force_space *space, const hs_force_job *job, int first)
{
    return hs_force_is_packed(job) ? space->packed.place_of[first] : first;
}
/** Have the job read packed clusters if its precision is mixed; hs_force_run_threads fills them. @p is_new: clusters are others
 *  than at the call before. */
HS_MUST_USE hs_status hs_force_pack(hs_force_space *space, hs_force_job *job, bool is_new, hs_error *err);

/** Work of one thread in a stage: fill its buffer. */
typedef hs_status (*hs_force_work)(hs_force_space *space, const hs_force_job *job, hs_force_stage stage, int thread);
/** Run `work` on all threads and reduce their buffers to the atoms' forces, touched blocks only. Work that knows no inner and
 *  outer part (@p is_staged false) has the one stage HS_STAGE_ALL. */
HS_MUST_USE hs_status hs_force_run_threads(hs_force_space *space, const hs_force_job *job, hs_force_work work,
                                           bool is_staged, hs_force_result *result, hs_error *err);
/** Room for the atoms in the buffers of all threads. */
HS_MUST_USE hs_status hs_force_space_reserve(hs_force_space *space, const hs_atoms *atoms, hs_error *err);
/** Share [*begin, *end) of a thread in n clusters or cells: of equal weight, where a chunk of them weighs as many pairs as
 *  it had at the evaluation before (near upper faces, where halo atoms are searched too, there are more). */
void hs_force_share(const hs_force_space *space, int64_t n, int thread, int64_t *begin, int64_t *end);
/** Note that item k of n has so many pairs. */
static inline void hs_force_weigh(hs_force_buffer *buffer, int64_t k, int64_t n, int64_t n_pairs)
{
    buffer->weight[k * HS_FORCE_CHUNKS / n] += n_pairs;
}
/** After an evaluation: keep the weights for the next. */
void hs_force_keep_weights(hs_force_space *space);

/** Method `nsq`: every local atom against every later local atom and every halo atom, with the scalar potential. The
 *  oracle: slow, and right at a glance. Overwrites forces of local and halo atoms; needs hs_halo_reverse after. */
HS_MUST_USE hs_status hs_force_nsq(hs_force_space *space, const hs_force_job *job, hs_force_result *result,
                                   hs_error *err);
/** Method `cell`: searches the cells around each cluster and applies the kernel at once; no list is kept. */
HS_MUST_USE hs_status hs_force_cell(hs_force_space *space, const hs_force_job *job, hs_force_result *result,
                                    hs_error *err);
/** Methods `linked`, `incremental` and `hash`: each cell with itself and with the cells of the stencil, as the chains have
 *  them; a list of the neighbors of one atom at a time goes to the kernel of method `verlet`. */
HS_MUST_USE hs_status hs_force_chains(hs_force_space *space, const hs_force_job *job, hs_force_result *result,
                                      hs_error *err);
void hs_candidates_fini(hs_candidates *candidates);
/** Room for n candidates; keeps those there are. */
HS_MUST_USE hs_status hs_candidates_reserve(hs_candidates *candidates, int n, hs_error *err);
void hs_force_space_fini(hs_force_space *space);

#endif
