/* What messages are with MPI and without. */
#include "parallel/messages.h"

hs_status hs_messages_transfer(hs_messages *messages, const hs_parallel *parallel, hs_error *err)
{
    if (hs_parallel_agree(parallel, err) == HS_OK) {
        hs_messages_start(messages);
        hs_messages_wait(messages);
    }
    hs_messages_clear(messages);
    return err->status;
}
