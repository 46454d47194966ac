/* The build without MPI: one rank. */
#include <stdlib.h>

#include "parallel/messages.h"

bool hs_parallel_is_launched(void) { return false; }
const char *hs_parallel_launched_rank(void) { return "?"; }

hs_status hs_parallel_init(hs_parallel *parallel, hs_error *err)
{
    *parallel = (hs_parallel){.rank = 0, .n_ranks = 1};
    for (const char *const *name = (const char *const[]){"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", NULL}; *name != NULL;
         ++name)
        if (getenv(*name) != NULL && atoi(getenv(*name)) > 1)
            return hs_fail(err, HS_ERROR_INPUT,
                           "this halfshell was built without MPI and cannot run on several ranks; build it with the "
                           "preset 'release', or start it without mpirun");
    return HS_OK;
}

void hs_parallel_world(hs_parallel *parallel) { *parallel = (hs_parallel){.rank = 0, .n_ranks = 1}; }

void hs_parallel_fini(hs_parallel *parallel) { (void)parallel; }

hs_status hs_parallel_agree(const hs_parallel *parallel, hs_error *err)
{
    (void)parallel;
    return err->status;
}

hs_status hs_parallel_settle(const hs_parallel *parallel, bool *stop, hs_error *err)
{
    (void)parallel, (void)stop;
    return err->status;
}

void hs_parallel_sum_double(const hs_parallel *p, double *values, int n) { (void)p, (void)values, (void)n; }
void hs_parallel_sum_int64(const hs_parallel *p, int64_t *values, int n) { (void)p, (void)values, (void)n; }
void hs_parallel_max_double(const hs_parallel *p, double *values, int n) { (void)p, (void)values, (void)n; }
void hs_parallel_min_double(const hs_parallel *p, double *values, int n) { (void)p, (void)values, (void)n; }
void hs_parallel_max_int64(const hs_parallel *p, int64_t *values, int n) { (void)p, (void)values, (void)n; }

void hs_parallel_broadcast(const hs_parallel *p, int root, void *bytes, size_t n)
{
    (void)p, (void)root, (void)bytes, (void)n;
}

void hs_parallel_gather_int64(const hs_parallel *p, int64_t value, int64_t *values)
{
    (void)p;
    values[0] = value;
}

/* There is no other rank to send to: nobody calls these. */

void hs_parallel_send(const hs_parallel *p, int to, const void *bytes, size_t n)
{
    (void)p, (void)to, (void)bytes, (void)n;
}

void hs_parallel_receive(const hs_parallel *p, int from, void *bytes, size_t n)
{
    (void)p, (void)from, (void)bytes, (void)n;
}

static hs_status refuse(hs_error *err)
{
    return hs_fail(err, HS_ERROR_RUN, "a message to another rank in a build that has one rank only");
}

hs_status hs_messages_send(hs_messages *messages, int to, const void *words, int64_t n, size_t size, hs_error *err)
{
    (void)messages, (void)to, (void)words, (void)n, (void)size;
    return refuse(err);
}

hs_status hs_messages_receive(hs_messages *messages, int from, void *words, int64_t n, size_t size, hs_error *err)
{
    (void)messages, (void)from, (void)words, (void)n, (void)size;
    return refuse(err);
}

void hs_messages_clear(hs_messages *messages) { (void)messages; }
void hs_messages_fini(hs_messages *messages) { (void)messages; }
void hs_messages_start(const hs_messages *messages) { (void)messages; }
void hs_messages_wait(const hs_messages *messages) { (void)messages; }
