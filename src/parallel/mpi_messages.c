/* Messages as persistent requests of MPI. */
#include <limits.h>
#include <mpi.h>
#include <string.h>

#include "base/memory.h"
#include "parallel/messages.h"

enum { TAG_MESSAGES = 0 };

void hs_messages_clear(hs_messages *messages)
{
    MPI_Request *request = messages->request;
    for (int k = 0; k < messages->n; ++k) MPI_Request_free(&request[k]);
    messages->n = 0;
}

void hs_messages_fini(hs_messages *messages)
{
    /* a library's caller may have ended MPI, and all requests with it */
    int finalized = 0;
    MPI_Finalized(&finalized);
    if (!finalized) hs_messages_clear(messages);
    HS_FREE(messages->request);
    memset(messages, 0, sizeof *messages);
}

/** A free request, and the type of a word: counts of MPI are of 31 bits, so words are sent whole. */
static hs_status add(hs_messages *messages, int64_t n, size_t size, MPI_Request **request, MPI_Datatype *type,
                     hs_error *err)
{
    if (n > INT_MAX)
        return hs_fail(err, HS_ERROR_RUN, "a message of %lld words to another rank is too long: use more ranks",
                       (long long)n);
    HS_TRY(hs_memory_extend(&messages->request, (size_t)messages->n, &messages->capacity, sizeof(MPI_Request), err));
    *request = (MPI_Request *)messages->request + messages->n++;
    MPI_Type_contiguous((int)size, MPI_BYTE, type);
    MPI_Type_commit(type);
    return HS_OK;
}

hs_status hs_messages_send(hs_messages *messages, int to, const void *words, int64_t n, size_t size, hs_error *err)
{
    MPI_Request *request;
    MPI_Datatype type;
    HS_TRY(add(messages, n, size, &request, &type, err));
    MPI_Send_init(words, (int)n, type, to, TAG_MESSAGES, MPI_COMM_WORLD, request);
    MPI_Type_free(&type); /* lives as long as the request */
    return HS_OK;
}

hs_status hs_messages_receive(hs_messages *messages, int from, void *words, int64_t n, size_t size, hs_error *err)
{
    MPI_Request *request;
    MPI_Datatype type;
    HS_TRY(add(messages, n, size, &request, &type, err));
    MPI_Recv_init(words, (int)n, type, from, TAG_MESSAGES, MPI_COMM_WORLD, request);
    MPI_Type_free(&type);
    return HS_OK;
}

void hs_messages_start(const hs_messages *messages)
{
    if (messages->n > 0) MPI_Startall(messages->n, messages->request);
}

void hs_messages_wait(const hs_messages *messages)
{
    if (messages->n > 0) MPI_Waitall(messages->n, messages->request, MPI_STATUSES_IGNORE);
}
