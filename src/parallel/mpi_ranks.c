/* Ranks over MPI. */
#include <mpi.h>
#include <stdlib.h>

#include "parallel/parallel.h"

/* Open MPI takes a tenth of a second to start and opens sockets even for one rank: a program that was not started by a
   launcher does without it. */
static bool launched_by_mpi(void)
{
    static const char *const signs[] = {"OMPI_COMM_WORLD_SIZE", "PMI_RANK", "PMIX_RANK", "PMI_SIZE", "MPI_LOCALNRANKS"};
    for (size_t i = 0; i < sizeof signs / sizeof signs[0]; ++i)
        if (getenv(signs[i]) != NULL) return true;
    return false;
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
    if (!launched_by_mpi()) return HS_OK;
    int provided;
    if (MPI_Init_thread(NULL, NULL, MPI_THREAD_FUNNELED, &provided) != MPI_SUCCESS)
        return hs_fail(err, HS_ERROR_RUN, "MPI could not be started");
    hs_parallel_world(parallel);
    return HS_OK;
}

void hs_parallel_fini(hs_parallel *parallel)
{
    (void)parallel;
    if (is_running()) MPI_Finalize();
}

void hs_parallel_abort(const hs_parallel *parallel, int exit_code)
{
    if (parallel->n_ranks > 1 && is_running()) MPI_Abort(MPI_COMM_WORLD, exit_code);
}

hs_status hs_parallel_agree(const hs_parallel *parallel, hs_error *err)
{
    if (parallel->n_ranks <= 1) return err->status;
    err->rank = parallel->rank;
    int first = err->status != HS_OK ? parallel->rank : parallel->n_ranks;
    MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
    if (first == parallel->n_ranks) return HS_OK;
    MPI_Bcast(err, sizeof *err, MPI_BYTE, first, MPI_COMM_WORLD);
    return err->status;
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
