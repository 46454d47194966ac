/** Distances of the pairs of a cluster list, counted where they are computed: by the force kernels of one type pair
 *  (kernel/cluster_loop.h) and by the pass over a list that is made for counting alone (kernel/histogram_kernel.c). Both
 *  round r^2 alike, so a pair is in the same bin in both.
 *
 *  Mixed precision does not count: its distances are rounded. */
#ifndef HS_KERNEL_TALLY_H
#define HS_KERNEL_TALLY_H

#include "kernel/pair_histogram.h"
#include "kernel/simd.h"

#ifdef HS_MIXED

typedef struct hs_tally {
    char unused;
} hs_tally;
static inline hs_tally hs_tally_begin(const hs_histogram *histogram)
{
    (void)histogram;
    return (hs_tally){0};
}
static inline void hs_tally_end(const hs_tally *tally, hs_histogram *histogram) { (void)tally, (void)histogram; }
static inline void hs_tally_settle(hs_tally *tally, hs_histogram *histogram) { (void)tally, (void)histogram; }
static inline void hs_tally_add(hs_tally *tally, hs_vec r2, hs_msk mask) { (void)tally, (void)r2, (void)mask; }

#else

/** What a loop keeps in registers of its thread's hs_histogram. */
typedef struct hs_tally {
    uint32_t *queue; /**< borrowed */
    int n;           /**< bins in it */
    hs_vec scale;    /**< from r^2 to bins */
} hs_tally;

static inline hs_tally hs_tally_begin(const hs_histogram *histogram)
{
    return (hs_tally){.queue = histogram->queue, .n = histogram->n_queued, .scale = hs_set1(histogram->scale)};
}

static inline void hs_tally_end(const hs_tally *tally, hs_histogram *histogram) { histogram->n_queued = tally->n; }

/** To be called after each group of entries: empties the queue now and then. Doing so after each cluster would end a short
 *  loop at an unforeseeable place every time. */
static inline void hs_tally_settle(hs_tally *tally, hs_histogram *histogram)
{
    if (tally->n <= HS_QUEUE) return;
    hs_histogram_empty_queue(histogram, tally->n);
    tally->n = 0;
}

/** Put the bins of the lanes in @p mask, n_fine at most, at the end of the queue. Without branches: which lanes these are cannot
 *  be predicted. */
static inline void hs_tally_add(hs_tally *tally, hs_vec r2, hs_msk mask)
{
    const hs_vec bin = r2 * tally->scale;
    uint32_t *queue = tally->queue + tally->n;
#if defined(HS_SIMD_AVX512)
    /* half a vector: a whole one stored anywhere would cross a cache line every time */
    _mm256_storeu_si256((__m256i *)queue, _mm256_maskz_compress_epi32(mask, _mm512_cvttpd_epi32(bin)));
    tally->n += __builtin_popcount(mask);
#else
    hs_real lane[HS_LANES];
    const uint32_t bits = hs_mask_to_bits(mask);
    int n = 0;
    memcpy(lane, &bin, sizeof lane);
    for (int k = 0; k < HS_LANES; ++k) {
        queue[n] = (uint32_t)(int32_t)lane[k];
        n += bits >> k & 1u;
    }
    tally->n += n;
#endif
}

#endif

#endif
