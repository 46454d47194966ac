/** One point of `halfshell bench scaling`: a run of its own on so many ranks and threads. */
#ifndef HS_CLI_BENCH_SCALING_H
#define HS_CLI_BENCH_SCALING_H

#include <limits.h>
#include <stdint.h>

#include "base/error.h"
#include "base/timer.h"

enum { HS_SCALING_COUNTS_MAX = 16 };

typedef struct hs_scaling_request {
    const char *out;             /**< folder of decks, logs and tables */
    int64_t size, steps, repeat; /**< edge of a cube of liquid, lattice constants; steps and number of measured runs */
    int ranks[HS_SCALING_COUNTS_MAX], threads[HS_SCALING_COUNTS_MAX];
    int n_ranks, n_threads;
    const char *precision, *reproducible, *isa; /**< NULL: the default */
    char program[PATH_MAX];
    bool has_mpirun, can_bind; /**< found by hs_scaling_prepare, as is program */
} hs_scaling_request;

/** One run, and what its log tells of the fastest repetition. */
typedef struct hs_scaling_point {
    bool is_droplet, is_weak;
    int ranks, threads;
    double n_atoms, seconds, phase_s[HS_N_PHASES], comm_s[HS_N_COMM_PARTS];
    double imbalance;                                         /**< most atoms of a rank / mean */
    double halo_atoms, bytes_forward, bytes_back, n_messages; /**< mean of the ranks, in a step */
    double efficiency;                                        /**< 1: as fast as one rank and thread by workers */
} hs_scaling_point;

/** "droplet" or "uniform"; "weak" or "strong". */
const char *hs_scaling_system_of(const hs_scaling_point *p);
const char *hs_scaling_kind_of(const hs_scaling_point *p);

/** Make the folder, find this program, and find out whether and how mpirun starts it. */
HS_MUST_USE hs_status hs_scaling_prepare(hs_scaling_request *r, hs_error *err);
/** Write the deck of a point, whose series, ranks and threads are set, run it, and take the fastest repetition from its
 *  log. */
HS_MUST_USE hs_status hs_scaling_measure(const hs_scaling_request *r, hs_scaling_point *p, hs_error *err);

#endif
