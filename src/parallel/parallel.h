/** Ranks and threads: the only interface to MPI (with comm/) and to the number of OpenMP threads.
 *
 *  Functions marked "collective" must be called by all ranks in the same order. A build without MPI has one rank. */
#ifndef HS_PARALLEL_PARALLEL_H
#define HS_PARALLEL_PARALLEL_H

#include <stddef.h>
#include <stdint.h>

#include "base/error.h"

/** The ranks of one run. Zero-initialised it is one rank of one. */
typedef struct hs_parallel {
    int rank;
    int n_ranks;
    bool is_launched; /**< by mpirun or the like, which passes the screen on: a terminal may be a file in truth */
} hs_parallel;

/** Whether mpirun or the like has started this program. */
bool hs_parallel_is_launched(void);
/** The number of this rank as its launcher says it, before MPI is started; "?": it does not. */
const char *hs_parallel_launched_rank(void);
/** Start MPI, if the program was launched with it (collective). A program started without mpirun stays without. */
HS_MUST_USE hs_status hs_parallel_init(hs_parallel *parallel, hs_error *err);
/** The ranks of the MPI that is running, or one rank when none is (a library's caller may not use MPI). */
void hs_parallel_world(hs_parallel *parallel);
/** Collective. */
void hs_parallel_fini(hs_parallel *parallel);

/** Agree on an error: when any rank holds one, every rank ends up with that of the lowest such rank (collective). */
HS_MUST_USE hs_status hs_parallel_agree(const hs_parallel *parallel, hs_error *err);
/** The same where ranks may come from different places of the program: after a command, and at the end. A rank whose error
 *  the others do not come to hear of within some seconds, because they wait for it elsewhere, tells it and stops all ranks.
 *  Also agrees on *stop (a signal that some ranks have seen, some not yet). Collective. */
HS_MUST_USE hs_status hs_parallel_settle(const hs_parallel *parallel, bool *stop, hs_error *err);

/** Sums, maxima, minima over ranks, in place (collective). */
void hs_parallel_sum_double(const hs_parallel *parallel, double *values, int n);
void hs_parallel_sum_int64(const hs_parallel *parallel, int64_t *values, int n);
void hs_parallel_max_double(const hs_parallel *parallel, double *values, int n);
void hs_parallel_min_double(const hs_parallel *parallel, double *values, int n);
void hs_parallel_max_int64(const hs_parallel *parallel, int64_t *values, int n);
/** Bytes of the rank @p root to all (collective). */
void hs_parallel_broadcast(const hs_parallel *parallel, int root, void *bytes, size_t n);
/** values[rank] = the value of each rank (collective). */
void hs_parallel_gather_int64(const hs_parallel *parallel, int64_t value, int64_t *values);
/** Bytes from one rank to another; both calls wait for the other. Not for halos: see messages.h. */
void hs_parallel_send(const hs_parallel *parallel, int to, const void *bytes, size_t n);
void hs_parallel_receive(const hs_parallel *parallel, int from, void *bytes, size_t n);

/** Threads of this rank's parallel regions. 0 asks for the default: OMP_NUM_THREADS if set, else 1 as LAMMPS does. Regions
 *  have as many threads as hs_threads_get then says, not more nor fewer: buffers are theirs. That is fewer than asked for where OpenMP
 *  gives no more (OMP_THREAD_LIMIT, a caller's parallel region around this one), and OMP_DYNAMIC is switched off. */
void hs_threads_set(int n_threads);
int hs_threads_get(void);
/** What a library's caller has set for regions of its own, before hs_threads_set, to be put back after. */
typedef struct hs_threads {
    int n;
    bool is_dynamic;
} hs_threads;
hs_threads hs_threads_save(void);
void hs_threads_restore(hs_threads threads);
/** Cores this process may run on. */
int hs_threads_available(void);
/** Give each thread a core of its own when there are as many threads as cores, and take that back when there are not. Without it systems
 *  put two threads on one core as soon as another program uses the other: a thread that wakes goes where it is woken from, and threads
 *  that wait for each other sleep too often to be moved apart (two threads then took twice as long as one; bound ones two thirds).
 *  Not for a library, whose caller's threads these are, nor with several ranks, which mpirun places. What the user has set
 *  (OMP_PROC_BIND, OMP_PLACES, GOMP_CPU_AFFINITY) is left alone. */
void hs_threads_bind(void);
/** Let this thread run on all cores that the OpenMP library could choose from, before the program starts itself anew: with OMP_PROC_BIND
 *  and the like the library has bound it to the first of its places by now, a program started by it would inherit that, and all its
 *  threads would share one core. */
void hs_threads_unbind(void);
/** Number of the calling thread in its parallel region, and the region's threads. */
int hs_thread_number(void);
int hs_thread_count(void);
/** Whether loops and barriers need a region of their own: with several threads, and with one within the parallel region of a
 *  library's caller, whose other threads they would else wait for. */
bool hs_threads_need_region(void);
/** Make a call on every thread of a parallel region; where it needs none make it as it is, for a region of one costs GNU OpenMP system
 *  calls. Loops in what is called are shared by `omp for`. */
#define HS_ON_THREADS(call)                                                                                            \
    do {                                                                                                               \
        if (hs_threads_need_region()) {                                                                                \
            _Pragma("omp parallel") call;                                                                              \
        } else {                                                                                                       \
            call;                                                                                                      \
        }                                                                                                              \
    } while (0)
/** Contiguous share [*begin, *end) of n items for thread t of n_threads; multiples of @p chunk except the last. */
void hs_thread_range(int64_t n, int chunk, int thread, int n_threads, int64_t *begin, int64_t *end);

#endif
