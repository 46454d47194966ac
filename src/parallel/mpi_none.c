/* The build without MPI: one rank. */
#include <stdlib.h>

#include "parallel/parallel.h"

hs_status hs_parallel_init(hs_parallel *parallel, hs_error *err)
{
    *parallel = (hs_parallel){.rank = 0, .n_ranks = 1};
    for (const char *const *name = (const char *const[]){"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", NULL}; *name != NULL;
         ++name)
        if (getenv(*name) != NULL && atoi(getenv(*name)) > 1)
            return hs_fail(err, HS_ERROR_INPUT,
                           "this halfshell was built without MPI and cannot run on several ranks; "
                           "build it with the preset 'release', or start it without mpirun");
    return HS_OK;
}

void hs_parallel_world(hs_parallel *parallel) { *parallel = (hs_parallel){.rank = 0, .n_ranks = 1}; }

void hs_parallel_fini(hs_parallel *parallel) { (void)parallel; }

void hs_parallel_abort(const hs_parallel *parallel, int exit_code) { (void)parallel, (void)exit_code; }

hs_status hs_parallel_agree(const hs_parallel *parallel, hs_error *err)
{
    (void)parallel;
    return err->status;
}

void hs_parallel_sum_double(const hs_parallel *p, double *values, int n) { (void)p, (void)values, (void)n; }
void hs_parallel_sum_int64(const hs_parallel *p, int64_t *values, int n) { (void)p, (void)values, (void)n; }
void hs_parallel_max_double(const hs_parallel *p, double *values, int n) { (void)p, (void)values, (void)n; }
void hs_parallel_min_double(const hs_parallel *p, double *values, int n) { (void)p, (void)values, (void)n; }
void hs_parallel_max_int64(const hs_parallel *p, int64_t *values, int n) { (void)p, (void)values, (void)n; }
