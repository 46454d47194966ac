#include "comm/deliver.h"

#include "base/memory.h"
#include "parallel/messages.h"

/** A message each way with every rank, this one included, unless it is empty: the words of one rank stand behind those of the rank
 *  before. */
static hs_status add_messages(hs_messages *messages, int n_ranks, const char *out, const int64_t *n_out, char *in,
                              const int64_t *n_in, size_t size, hs_error *err)
{
    for (int rank = 0; rank < n_ranks; ++rank) {
        if (n_in[rank] > 0) HS_TRY(hs_messages_receive(messages, rank, in, n_in[rank], size, err));
        if (n_out[rank] > 0) HS_TRY(hs_messages_send(messages, rank, out, n_out[rank], size, err));
        in += (size_t)n_in[rank] * size;
        out += (size_t)n_out[rank] * size;
    }
    return HS_OK;
}

/** n_from[n_ranks]: how many records each rank has for this one (collective). */
static hs_status exchange_counts(hs_messages *messages, const hs_parallel *parallel, const int64_t *n_for,
                                 int64_t *n_from, hs_error *err)
{
    int64_t *one = NULL;
    HS_UNLESS_FAILED(err, HS_ALLOC(one, (size_t)parallel->n_ranks, err));
    for (int rank = 0; rank < parallel->n_ranks && one != NULL; ++rank) one[rank] = 1;
    HS_UNLESS_FAILED(err, add_messages(messages, parallel->n_ranks, (const char *)n_for, one, (char *)n_from, one,
                                       sizeof *n_for, err));
    const hs_status status = hs_messages_transfer(messages, parallel, err);
    HS_FREE(one);
    return status;
}

hs_status hs_deliver(const hs_parallel *parallel, const void *records, size_t size, const int64_t *n_for,
                     void **received, int64_t *n_received, hs_error *err)
{
    hs_messages messages = {0};
    int64_t *n_from = NULL;
    *received = NULL;
    *n_received = 0;
    HS_UNLESS_FAILED(err, HS_ALLOC(n_from, (size_t)parallel->n_ranks, err));
    hs_status status = exchange_counts(&messages, parallel, n_for, n_from, err);
    if (status == HS_OK) {
        for (int rank = 0; rank < parallel->n_ranks; ++rank) *n_received += n_from[rank];
        HS_UNLESS_FAILED(err, hs_memory_alloc(received, (size_t)*n_received, size, err));
        HS_UNLESS_FAILED(err, add_messages(&messages, parallel->n_ranks, records, n_for, *received, n_from, size, err));
        status = hs_messages_transfer(&messages, parallel, err);
    }
    if (status != HS_OK) HS_FREE(*received);
    hs_messages_fini(&messages);
    HS_FREE(n_from);
    return status;
}
