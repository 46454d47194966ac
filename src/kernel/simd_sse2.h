/* Vectors of 2 doubles: the baseline of x86-64. Two vectors cover one cluster. */
#include <emmintrin.h>

typedef double hs_real;
typedef __m128d hs_vec;
typedef __m128d hs_msk;
#define HS_LANES 2

static inline hs_vec hs_set1(double a) { return _mm_set1_pd(a); }
static inline hs_vec hs_fma(hs_vec a, hs_vec b, hs_vec c) { return _mm_add_pd(_mm_mul_pd(a, b), c); }
static inline hs_vec hs_sqrt(hs_vec a) { return _mm_sqrt_pd(a); }
static inline hs_real hs_local(double x, double origin)
{
    (void)origin;
    return x;
}

/* Masks of an entry: its bits in every lane; a row picks one bit in each (in both halves of the lane: SSE2 compares only
   32 bits). */
typedef __m128i hs_masks;
static inline hs_masks hs_masks_of(const hs_cluster_entry *entry, int sub)
{
    return _mm_set1_epi32((int)(entry->mask >> 2 * sub));
}
static inline hs_msk hs_masks_row(hs_masks masks, int row)
{
    const __m128i lane = _mm_set_epi32(2 << 4 * row, 2 << 4 * row, 1 << 4 * row, 1 << 4 * row);
    return _mm_castsi128_pd(_mm_cmpeq_epi32(_mm_and_si128(masks, lane), lane));
}

static inline uint32_t hs_mask_to_bits(hs_msk m) { return (uint32_t)_mm_movemask_pd(m); }
static inline hs_msk hs_mask_and(hs_msk m, hs_msk n) { return _mm_and_pd(m, n); }
static inline hs_msk hs_less(hs_vec a, hs_vec b) { return _mm_cmplt_pd(a, b); }
static inline hs_vec hs_keep(hs_msk m, hs_vec a) { return _mm_and_pd(m, a); }
static inline hs_vec hs_select(hs_msk m, hs_vec a, hs_vec b)
{
    return _mm_or_pd(_mm_and_pd(m, a), _mm_andnot_pd(m, b));
}
static inline hs_vec hs_max_abs(hs_vec a, hs_vec b) { return _mm_max_pd(_mm_andnot_pd(_mm_set1_pd(-0.0), b), a); }
static inline double hs_sum(hs_vec a) { return _mm_cvtsd_f64(_mm_add_sd(a, _mm_unpackhi_pd(a, a))); }

static inline hs_vec hs_load_clusters(const double *x, double origin, const hs_cluster_entry *entry, int sub)
{
    (void)origin;
    return _mm_loadu_pd(x + entry->first + 2 * sub);
}

static inline void hs_add_clusters(double *f, const hs_cluster_entry *entry, int sub, hs_vec a)
{
    double *at = f + entry->first + 2 * sub;
    _mm_storeu_pd(at, _mm_add_pd(_mm_loadu_pd(at), a));
}

static inline hs_vec hs_lookup(const double *table, const int32_t *type, int stride, const hs_cluster_entry *entry,
                               int sub)
{
    const int32_t *at = type + entry->first + 2 * sub;
    return _mm_set_pd(table[stride * at[1]], table[stride * at[0]]);
}
