/* Ranks over MPI: start and end, agreement on errors, collective operations. */
#include <mpi.h>
#include <stdlib.h>
#include <time.h>

#include "base/timer.h"
#include "parallel/parallel.h"

/** MPI itself is one per process. Errors are settled over a communicator of their own, so that ranks that come to
 *  different places of the program never take each other's messages for something else. */
static struct {
    MPI_Comm settle;
    bool has_settle, may_abort; /**< may_abort: MPI was started by this program, not by a library's caller */
} process;

/* Open MPI takes a tenth of a second to start and opens sockets even for one rank: a program that was not started by a
   launcher does without it. */
bool hs_parallel_is_launched(void)
{
    static const char *const signs[] = {"OMPI_COMM_WORLD_SIZE", "PMI_RANK", "PMIX_RANK", "PMI_SIZE", "MPI_LOCALNRANKS"};
    for (size_t i = 0; i < sizeof signs / sizeof signs[0]; ++i)
        if (getenv(signs[i]) != NULL) return true;
    return false;
}

const char *hs_parallel_launched_rank(void)
{
    static const char *const names[] = {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; ++i)
        if (getenv(names[i]) != NULL) return getenv(names[i]);
    return "?";
}

static bool is_running(void)
{
    int initialized = 0, finalized = 0;
    MPI_Initialized(&initialized);
    MPI_Finalized(&finalized);
    return initialized && !finalized;
}

void hs_parallel_world(hs_parallel *parallel)
{
    *parallel = (hs_parallel){.rank = 0, .n_ranks = 1};
    if (!is_running()) return;
    MPI_Comm_rank(MPI_COMM_WORLD, &parallel->rank);
    MPI_Comm_size(MPI_COMM_WORLD, &parallel->n_ranks);
}

hs_status hs_parallel_init(hs_parallel *parallel, hs_error *err)
{
    *parallel = (hs_parallel){.rank = 0, .n_ranks = 1};
    if (!hs_parallel_is_launched()) return HS_OK;
    int provided;
    if (MPI_Init_thread(NULL, NULL, MPI_THREAD_FUNNELED, &provided) != MPI_SUCCESS)
        return hs_fail(err, HS_ERROR_RUN, "MPI could not be started");
    hs_parallel_world(parallel);
    parallel->is_launched = true;
    process.has_settle = parallel->n_ranks > 1 && MPI_Comm_dup(MPI_COMM_WORLD, &process.settle) == MPI_SUCCESS;
    process.may_abort = true;
    return HS_OK;
}

void hs_parallel_fini(hs_parallel *parallel)
{
    (void)parallel;
    if (!is_running()) return;
    if (process.has_settle) MPI_Comm_free(&process.settle);
    process.has_settle = false;
    MPI_Finalize();
}

/** Stop all ranks at once. Does not return when there is more than one rank. */
static void stop_all(const hs_parallel *parallel, int exit_code)
{
    if (parallel->n_ranks > 1 && is_running()) MPI_Abort(MPI_COMM_WORLD, exit_code);
}

static hs_status share_error(const hs_parallel *parallel, MPI_Comm ranks, int first, hs_error *err)
{
    if (first >= parallel->n_ranks) return HS_OK;
    MPI_Bcast(err, sizeof *err, MPI_BYTE, first, ranks);
    return err->status;
}

/** This rank, if it holds an error; else a number beyond all ranks. */
static int place_of_error(const hs_parallel *parallel, hs_error *err)
{
    err->rank = parallel->rank;
    return err->status != HS_OK ? parallel->rank : parallel->n_ranks;
}

hs_status hs_parallel_agree(const hs_parallel *parallel, hs_error *err)
{
    if (parallel->n_ranks <= 1) return err->status;
    int first = place_of_error(parallel, err);
    MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
    return share_error(parallel, MPI_COMM_WORLD, first, err);
}

/** Wait for the others; a rank with an error only so long as they may just be late. Lower ranks lose patience first, so
 *  that one of several with errors tells its own and stops the others before they do the same. */
static bool wait_for_all(MPI_Request *request, int rank, bool has_error)
{
    const double patience_s = 1.5 + 0.25 * (rank < 4 ? rank : 4), start_s = hs_time_now_s();
    const struct timespec nap = {.tv_nsec = 1000000};
    int is_done = 0;
    if (!has_error || !process.may_abort) {
        MPI_Wait(request, MPI_STATUS_IGNORE);
        return true;
    }
    for (;;) {
        MPI_Test(request, &is_done, MPI_STATUS_IGNORE);
        if (is_done) return true;
        if (hs_time_now_s() - start_s > patience_s) return false;
        nanosleep(&nap, NULL);
    }
}

hs_status hs_parallel_settle(const hs_parallel *parallel, bool *stop, hs_error *err)
{
    if (parallel->n_ranks <= 1 || !process.has_settle) return hs_parallel_agree(parallel, err);
    MPI_Request request;
    /* the largest of: minus the lowest rank that holds an error; whether to stop */
    int mine[2] = {-place_of_error(parallel, err), *stop}, all[2];
    MPI_Iallreduce(mine, all, 2, MPI_INT, MPI_MAX, process.settle, &request);
    if (!wait_for_all(&request, parallel->rank, err->status != HS_OK)) {
        hs_error_print(err, stderr);
        fflush(NULL);
        stop_all(parallel, hs_exit_code(err->status));
    }
    *stop = all[1] != 0;
    return share_error(parallel, process.settle, -all[0], err);
}

static void allreduce(const hs_parallel *parallel, void *values, int n, MPI_Datatype type, MPI_Op operation)
{
    if (parallel->n_ranks > 1) MPI_Allreduce(MPI_IN_PLACE, values, n, type, operation, MPI_COMM_WORLD);
}

void hs_parallel_sum_double(const hs_parallel *p, double *values, int n)
{
    allreduce(p, values, n, MPI_DOUBLE, MPI_SUM);
}
void hs_parallel_sum_int64(const hs_parallel *p, int64_t *values, int n)
{
    allreduce(p, values, n, MPI_INT64_T, MPI_SUM);
}
void hs_parallel_max_double(const hs_parallel *p, double *values, int n)
{
    allreduce(p, values, n, MPI_DOUBLE, MPI_MAX);
}
void hs_parallel_min_double(const hs_parallel *p, double *values, int n)
{
    allreduce(p, values, n, MPI_DOUBLE, MPI_MIN);
}
void hs_parallel_max_int64(const hs_parallel *p, int64_t *values, int n)
{
    allreduce(p, values, n, MPI_INT64_T, MPI_MAX);
}

/* Counts of MPI are of 31 bits: longer messages go in pieces. */
enum { PIECE_BYTES = 1 << 30 };
#define FOR_PIECES(n, at, length)                                                                                      \
    for (size_t at = 0, length; at < (n); at += length)                                                                \
        if ((length = (n)-at < PIECE_BYTES ? (n)-at : PIECE_BYTES) > 0)

void hs_parallel_broadcast(const hs_parallel *parallel, int root, void *bytes, size_t n)
{
    if (parallel->n_ranks <= 1) return;
    FOR_PIECES(n, at, length) MPI_Bcast((char *)bytes + at, (int)length, MPI_BYTE, root, MPI_COMM_WORLD);
}

void hs_parallel_gather_int64(const hs_parallel *parallel, int64_t value, int64_t *values)
{
    if (parallel->n_ranks <= 1)
        values[0] = value;
    else
        MPI_Allgather(&value, 1, MPI_INT64_T, values, 1, MPI_INT64_T, MPI_COMM_WORLD);
}

/* Messages of the halo have the tag 0 (messages.c). */
enum { TAG_BYTES = 1 };

void hs_parallel_send(const hs_parallel *parallel, int to, const void *bytes, size_t n)
{
    (void)parallel;
    FOR_PIECES(n, at, length)
    MPI_Send((const char *)bytes + at, (int)length, MPI_BYTE, to, TAG_BYTES, MPI_COMM_WORLD);
}

void hs_parallel_receive(const hs_parallel *parallel, int from, void *bytes, size_t n)
{
    (void)parallel;
    FOR_PIECES(n, at, length)
    MPI_Recv((char *)bytes + at, (int)length, MPI_BYTE, from, TAG_BYTES, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
}
