/** Shares of work that threads can take pieces of from each other. Each thread has a range of pieces of its own, which
 *  keeps its memory near it; one that is done helps the others. So a core that is slower for a while (other programs, a
 *  host that takes the core away, cores of different kinds) holds up a region by a piece of its work, not by its whole
 *  share.
 *
 *  Which thread does which piece differs from run to run: results must not depend on it. */
#ifndef HS_PARALLEL_SHARE_H
#define HS_PARALLEL_SHARE_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>

/** The pieces of one thread that nobody has taken yet. A line of the cache of its own: all threads write to it. */
typedef struct hs_share {
    _Alignas(64) _Atomic uint64_t left; /**< number of the first, shifted by 32 bits, and of the one after the last */
} hs_share;

/** Give pieces [begin, end) to a thread, outside of parallel regions or before a barrier. */
static inline void hs_share_set(hs_share *share, int begin, int end)
{
    atomic_store_explicit(&share->left, (uint64_t)(uint32_t)begin << 32 | (uint32_t)end, memory_order_relaxed);
}

/** Take the first or the last piece; -1: there is none left. */
static inline int hs_share_take(hs_share *share, bool is_last)
{
    uint64_t left = atomic_load_explicit(&share->left, memory_order_relaxed), next;
    int piece;
    do {
        const int begin = (int)(left >> 32), end = (int)(left & UINT32_MAX);
        if (begin >= end) return -1;
        piece = is_last ? end - 1 : begin;
        next = is_last ? left - 1 : left + (UINT64_C(1) << 32);
    } while (
        !atomic_compare_exchange_weak_explicit(&share->left, &left, next, memory_order_relaxed, memory_order_relaxed));
    return piece;
}

/** Take a piece of a thread's own share or, when that is empty, of another's; -1: all are empty. @p owner: whose it
 *  was.
 *
 *  Even threads begin at the front of their shares, odd ones at the back, and who helps takes from the other end.
 *  Threads 0 and 1, 2 and 3, ... help each other first, so they come to meet where their shares do. */
static inline int hs_share_take_any(hs_share *share, int n_threads, int thread, int *owner)
{
    for (int k = 0, n_seen = 0; n_seen < n_threads; ++k) {
        *owner = thread ^ k;
        if (*owner >= n_threads) continue;
        const bool begins_at_back = *owner & 1, is_own = k == 0;
        const int piece = hs_share_take(&share[*owner], begins_at_back == is_own);
        if (piece >= 0) return piece;
        ++n_seen;
    }
    return -1;
}

#endif
