#define _GNU_SOURCE /* sched_setaffinity */
#include "parallel/parallel.h"

#include <omp.h>
#include <pthread.h>
#include <sched.h>
#include <stdlib.h>

/** Cores are the process's, not a simulation's: those it may run on are looked up once, before any thread is bound to
 *  one. */
static struct {
    pthread_once_t once;
    cpu_set_t allowed;
    int n;
    bool is_bound;
} cores = {.once = PTHREAD_ONCE_INIT};

static void find_cores(void)
{
    cores.n = sched_getaffinity(0, sizeof cores.allowed, &cores.allowed) == 0 ? CPU_COUNT(&cores.allowed) : 0;
}

/** What the environment asks for, which is lost to later calls once a number of threads has been set. */
static struct {
    pthread_once_t once;
    int n_threads;
} environment = {.once = PTHREAD_ONCE_INIT};

static void read_environment(void)
{
    environment.n_threads = getenv("OMP_NUM_THREADS") != NULL ? omp_get_max_threads() : 1;
}

static int team_size(void)
{
    int n = 1;
#pragma omp parallel
#pragma omp single
    n = omp_get_num_threads();
    return n;
}

void hs_threads_set(int n_threads)
{
    pthread_once(&environment.once, read_environment);
    if (n_threads <= 0) n_threads = environment.n_threads;
    omp_set_dynamic(0);
    omp_set_num_threads(n_threads);
    if (n_threads > 1) omp_set_num_threads(team_size());
}

hs_threads hs_threads_save(void) { return (hs_threads){.n = omp_get_max_threads(), .is_dynamic = omp_get_dynamic()}; }

void hs_threads_restore(hs_threads threads)
{
    omp_set_dynamic(threads.is_dynamic);
    omp_set_num_threads(threads.n);
}

int hs_threads_get(void) { return omp_get_max_threads(); }

bool hs_threads_need_region(void) { return omp_get_max_threads() > 1 || omp_in_parallel(); }

int hs_threads_available(void)
{
    pthread_once(&cores.once, find_cores);
    return cores.n > 0 ? cores.n : omp_get_num_procs();
}

/** Bind the calling thread to the k-th allowed core from core `first` on. */
static void bind_to(int first, int k)
{
    int core = first;
    while (!CPU_ISSET(core, &cores.allowed) || k-- > 0) core = (core + 1) % CPU_SETSIZE;
    cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(core, &one);
    sched_setaffinity(0, sizeof one, &one);
}

void hs_threads_bind(void)
{
    const int n_cores = hs_threads_available(), first = sched_getcpu();
    const bool is_users =
        getenv("OMP_PROC_BIND") != NULL || getenv("OMP_PLACES") != NULL || getenv("GOMP_CPU_AFFINITY") != NULL;
    const bool bind = n_cores > 1 && cores.n == n_cores && hs_threads_get() == n_cores && first >= 0;
    if (is_users || (!bind && !cores.is_bound)) return;
    cores.is_bound = bind;
#pragma omp parallel
    if (bind)
        bind_to(first, hs_thread_number());
    else
        sched_setaffinity(0, sizeof cores.allowed, &cores.allowed);
}

void hs_threads_unbind(void)
{
    cpu_set_t all;
    CPU_ZERO(&all);
    for (int place = 0; place < omp_get_num_places(); ++place) {
        int processor[CPU_SETSIZE];
        const int n = omp_get_place_num_procs(place);
        if (n > CPU_SETSIZE) return;
        omp_get_place_proc_ids(place, processor);
        for (int i = 0; i < n; ++i) CPU_SET((size_t)processor[i], &all);
    }
    if (CPU_COUNT(&all) > 0) sched_setaffinity(0, sizeof all, &all);
}

int hs_thread_number(void) { return omp_get_thread_num(); }

int hs_thread_count(void) { return omp_get_num_threads(); }

void hs_thread_range(int64_t n, int chunk, int thread, int n_threads, int64_t *begin, int64_t *end)
{
    if (n_threads == 1) { /* the usual case of small systems, without divisions */
        *begin = 0;
        *end = n;
        return;
    }
    const int64_t n_chunks = (n + chunk - 1) / chunk;
    *begin = n_chunks * thread / n_threads * chunk;
    *end = n_chunks * (thread + 1) / n_threads * chunk;
    if (*begin > n) *begin = n;
    if (*end > n) *end = n;
}
