/* Shares of work between threads: every piece is done once, whoever is slow; and threads have cores of their own. */
#define _GNU_SOURCE
#include <check.h>
#include <sched.h>
#include <stdlib.h>

#include "parallel/parallel.h"
#include "parallel/share.h"
#include "support/harness.h"

enum { PIECES = 1000, THREADS_MAX = 5 };

/** Begin and end of the pieces of a thread; threads have unlike shares, one has none. */
static void range_of(int thread, int n_threads, int *begin, int *end)
{
    *begin = thread == 0 ? 0 : PIECES * thread * thread / (n_threads * n_threads);
    *end = PIECES * (thread + 1) * (thread + 1) / (n_threads * n_threads);
    if (thread == 2) *begin = *end;
}

/** All pieces of all threads, taken by `helpers` of them only. */
static void check_pieces(int n_threads, int helpers)
{
    hs_share share[THREADS_MAX];
    int count[PIECES] = {0}, wanted[PIECES] = {0}, n_wrong_owner = 0;
    for (int t = 0; t < n_threads; ++t) {
        int begin, end;
        range_of(t, n_threads, &begin, &end);
        hs_share_set(&share[t], begin, end);
        for (int k = begin; k < end; ++k) wanted[k] = 1;
    }
#pragma omp parallel num_threads(n_threads) reduction(+ : n_wrong_owner)
    {
        int owner, begin, end;
        for (int k; hs_thread_number() < helpers &&
                    (k = hs_share_take_any(share, n_threads, hs_thread_number(), &owner)) >= 0;) {
#pragma omp atomic
            ++count[k];
            range_of(owner, n_threads, &begin, &end);
            n_wrong_owner += k < begin || k >= end;
        }
    }
    for (int k = 0; k < PIECES; ++k) ck_assert_msg(count[k] == wanted[k], "piece %d was done %d times", k, count[k]);
    ck_assert_int_eq(n_wrong_owner, 0);
}

START_TEST(every_piece_once)
{
    for (int n_threads = 1; n_threads <= THREADS_MAX; ++n_threads)
        for (int helpers = 1; helpers <= n_threads; ++helpers) check_pieces(n_threads, helpers);
}
END_TEST

START_TEST(partners_meet)
{
    hs_share share[2];
    int owner;
    hs_share_set(&share[0], 0, 2);
    hs_share_set(&share[1], 2, 6);
    ck_assert_int_eq(hs_share_take_any(share, 2, 0, &owner), 0);
    ck_assert_int_eq(hs_share_take_any(share, 2, 1, &owner), 5);
    ck_assert_int_eq(hs_share_take_any(share, 2, 0, &owner), 1);
    /* thread 0 is done, and goes on where its share ends */
    ck_assert_int_eq(hs_share_take_any(share, 2, 0, &owner), 2);
    ck_assert_int_eq(owner, 1);
    ck_assert_int_eq(hs_share_take_any(share, 2, 1, &owner), 4);
    ck_assert_int_eq(hs_share_take_any(share, 2, 0, &owner), 3);
    ck_assert_int_eq(hs_share_take_any(share, 2, 0, &owner), -1);
    ck_assert_int_eq(hs_share_take_any(share, 2, 1, &owner), -1);
}
END_TEST

/** Cores that each thread may use: their number, and for one thread alone which one. */
static int cores_of_threads(int n_threads, int core[])
{
    int most = 0;
#pragma omp parallel num_threads(n_threads) reduction(max : most)
    {
        cpu_set_t set;
        sched_getaffinity(0, sizeof set, &set);
        most = CPU_COUNT(&set);
        core[hs_thread_number()] = 0;
        while (!CPU_ISSET(core[hs_thread_number()], &set)) ++core[hs_thread_number()];
    }
    return most;
}

START_TEST(as_many_threads_as_cores_are_bound)
{
    const int n_cores = hs_threads_available();
    int core[CPU_SETSIZE];
    bool is_used[CPU_SETSIZE] = {false};
    if (n_cores == 1) return;
    unsetenv("OMP_PROC_BIND");
    unsetenv("OMP_PLACES");
    unsetenv("GOMP_CPU_AFFINITY");
    hs_threads_set(n_cores);
    hs_threads_bind();
    ck_assert_int_eq(cores_of_threads(n_cores, core), 1);
    for (int t = 0; t < n_cores; ++t) {
        ck_assert_msg(!is_used[core[t]], "two threads on core %d", core[t]);
        is_used[core[t]] = true;
    }
    ck_assert_int_eq(hs_threads_available(), n_cores);
    hs_threads_set(n_cores - 1);
    hs_threads_bind();
    ck_assert_int_eq(cores_of_threads(n_cores - 1, core), n_cores);
    setenv("OMP_PROC_BIND", "false", 1);
    hs_threads_set(n_cores);
    hs_threads_bind();
    ck_assert_int_eq(cores_of_threads(n_cores, core), n_cores);
}
END_TEST

HS_TEST_MAIN("share", every_piece_once, partners_meet, as_many_threads_as_cores_are_bound)
