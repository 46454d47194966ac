/* Distances of the listed pairs of one i-cluster into fine bins; compiled for every instruction set. */
#include "kernel/pair_histogram.h"
#include "kernel/simd.h"

/* put(queue, bin, mask): append the whole-number parts of the lanes in mask; may write HS_LANES numbers; returns how many
 * count. Without branches: which lanes are within reach cannot be predicted. */
#if defined(HS_SIMD_AVX512)

static inline int put(uint32_t *queue, hs_vec bin, hs_msk mask)
{
    /* half a vector: a whole one stored anywhere would cross a cache line every time */
    const __m256i whole = _mm512_cvttpd_epi32(bin);
    _mm256_storeu_si256((__m256i *)queue, _mm256_maskz_compress_epi32(mask, whole));
    return __builtin_popcount(mask);
}

#else

static inline int put(uint32_t *queue, hs_vec bin, hs_msk mask)
{
    hs_real lane[HS_LANES];
    const uint32_t bits = hs_mask_to_bits(mask);
    int n = 0;
    __builtin_memcpy(lane, &bin, sizeof lane);
    for (int k = 0; k < HS_LANES; ++k) {
        queue[n] = (uint32_t)(int32_t)lane[k];
        n += bits >> k & 1u;
    }
    return n;
}

#endif

enum { PIECE = 256, QUEUE = 1024, QUEUE_ROOM = HS_CLUSTER * 16 }; /* room for all lanes of one step of the loop */

/** 16-bit counters stay in the first-level cache, 32-bit ones would not: these go to the totals before one can overflow. */
static void flush(const uint32_t *queue, int n, hs_histogram *histogram)
{
    if (histogram->n_pending + n > UINT16_MAX) hs_histogram_settle(histogram);
    histogram->n_pending += n;
    uint16_t *restrict counts = histogram->recent;
    int k = 0;
    for (; k + 4 <= n; k += 4) {
        ++counts[queue[k]];
        ++counts[queue[k + 1]];
        ++counts[queue[k + 2]];
        ++counts[queue[k + 3]];
    }
    for (; k < n; ++k) ++counts[queue[k]];
}

/** The pairs of one i-cluster: puts their bins at the end of the queue of n, which is emptied when full; returns its length. */
static inline int count_cluster(const double *const x[3], int first, const hs_cluster_entry *entry, int n_entries,
                                hs_vec width, hs_vec limit, uint32_t *queue, int n, hs_histogram *histogram)
{
    for (int e = 0; e < n_entries; e += HS_GROUP) {
        /* rows with any pair; what is noted in the entries is for the kernels' own groups */
        uint32_t pairs = entry[e].mask;
        if (HS_GROUP > 1) pairs |= entry[e + 1].mask;
        for (int sub = 0; sub < HS_SUBS; ++sub) {
            const hs_masks masks = hs_masks_of(entry + e, sub);
            const hs_vec x_j[3] = {hs_load_clusters(x[0], 0.0, entry + e, sub),
                                   hs_load_clusters(x[1], 0.0, entry + e, sub),
                                   hs_load_clusters(x[2], 0.0, entry + e, sub)};
            for (int row = 0; row < HS_CLUSTER; ++row) {
                if (!(pairs >> 4 * row & 0xfu)) continue;
                const hs_vec dx = x_j[0] - hs_set1(x[0][first + row]), dy = x_j[1] - hs_set1(x[1][first + row]),
                             dz = x_j[2] - hs_set1(x[2][first + row]);
                const hs_vec bin = (dx * dx + dy * dy + dz * dz) * width;
                n += put(queue + n, bin, hs_mask_and(hs_masks_row(masks, row), hs_less(bin, limit)));
            }
        }
        if (n > QUEUE) {
            flush(queue, n, histogram);
            n = 0;
        }
    }
    return n;
}

/** Entries that name packed clusters (kernel/packed.h) as entries that name atoms. */
static inline void name_atoms(const hs_clusters *clusters, const hs_cluster_entry *entry, int n, hs_cluster_entry *to)
{
    for (int e = 0; e < n; ++e) to[e] = (hs_cluster_entry){hs_packed_atom(clusters, entry[e].first), entry[e].mask};
}

/* One queue for all clusters: emptying it after each would end a short loop at an unforeseeable place every time. */
static void count_pairs(const double *const x[3], const hs_clusters *clusters, const hs_list_chunk *chunk,
                        bool is_packed, hs_histogram *histogram)
{
    uint32_t queue[QUEUE + QUEUE_ROOM];
    hs_cluster_entry piece[PIECE];
    int n = 0;
    const hs_vec limit = hs_set1((double)histogram->n_fine), width = hs_set1(histogram->scale);
    for (int ci = chunk->begin; ci < chunk->end; ++ci) {
        const int end = chunk->start[ci - chunk->begin + 1], first = clusters->local.entry[ci].first;
        for (int begin = chunk->start[ci - chunk->begin]; begin < end; begin += PIECE) {
            const int n_entries = end - begin < PIECE ? end - begin : PIECE;
            const hs_cluster_entry *entry = chunk->entries.entry + begin;
            if (is_packed) {
                name_atoms(clusters, entry, n_entries, piece);
                entry = piece;
            }
            n = count_cluster(x, first, entry, n_entries, width, limit, queue, n, histogram);
        }
    }
    flush(queue, n, histogram);
}

#define PASTE_(a, b) a##b
#define PASTE(a, b)  PASTE_(a, b)
const hs_histogram_kernel PASTE(hs_histogram_kernel_, HS_KERNEL_ISA) = count_pairs;
