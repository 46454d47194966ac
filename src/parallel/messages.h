/** Messages between ranks that are described once and then sent again and again from and to the same places.
 *
 *  Messages to one rank arrive in the order in which both sides have added them. A build without MPI has no other
 *  ranks, and its lists stay empty. */
#ifndef HS_PARALLEL_MESSAGES_H
#define HS_PARALLEL_MESSAGES_H

#include "parallel/parallel.h"

/** Zero it before first use. */
typedef struct hs_messages {
    void *request; /**< owned [capacity] */
    int n;
    size_t capacity;
} hs_messages;

/** Forget all messages; none may be under way. */
void hs_messages_clear(hs_messages *messages);
void hs_messages_fini(hs_messages *messages);
/** Add a message to or from a rank: @p n words of @p size bytes at a place that must stay. Not collective. */
HS_MUST_USE hs_status hs_messages_send(hs_messages *messages, int to, const void *words, int64_t n, size_t size,
                                       hs_error *err);
HS_MUST_USE hs_status hs_messages_receive(hs_messages *messages, int from, void *words, int64_t n, size_t size,
                                          hs_error *err);
/** Start all messages; their memory belongs to them until hs_messages_wait returns. */
void hs_messages_start(const hs_messages *messages);
void hs_messages_wait(const hs_messages *messages);
/** Send and receive all messages once and forget them (collective, errors agreed): none starts if a rank could not describe its own,
 *  and holds the error in @p err. */
HS_MUST_USE hs_status hs_messages_transfer(hs_messages *messages, const hs_parallel *parallel, hs_error *err);

#endif
