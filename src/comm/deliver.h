/** Records that every rank may have for every other one: rows that are to stand on other ranks than where they were found. */
#ifndef HS_COMM_DELIVER_H
#define HS_COMM_DELIVER_H

#include "parallel/parallel.h"

/** Bring records to the ranks that they are for (collective, errors agreed: one that a rank holds in @p err already stops all).
 *  @param[in]  records    those for rank 0, then those for rank 1, and so on: @p size bytes each
 *  @param[in]  n_for      [n_ranks] how many are for each rank
 *  @param[out] received   of rank 0, then of rank 1, and so on; the caller's to HS_FREE; NULL after an error
 *  @param[out] n_received of all ranks together */
HS_MUST_USE hs_status hs_deliver(const hs_parallel *parallel, const void *records, size_t size, const int64_t *n_for,
                                 void **received, int64_t *n_received, hs_error *err);

#endif
