/* Vectors of 4 doubles: AVX2 and FMA. One cluster fills one vector. */
#include <immintrin.h>

typedef double hs_real;
typedef __m256d hs_vec;
typedef __m256d hs_msk;
#define HS_LANES 4
#define HS_ROWS_IN_TURN

static inline hs_vec hs_set1(double a) { return _mm256_set1_pd(a); }
static inline hs_vec hs_fma(hs_vec a, hs_vec b, hs_vec c) { return _mm256_fmadd_pd(a, b, c); }
static inline hs_vec hs_sqrt(hs_vec a) { return _mm256_sqrt_pd(a); }
static inline hs_real hs_local(double x, double origin)
{
    (void)origin;
    return x;
}

/* Of four bits the lanes they stand for: cheaper to read than to make, which takes four instructions of a vector unit. */
#define HS_LANES_OF(bits)                                                                                              \
    {                                                                                                                  \
        -((bits)&1), -((bits) >> 1 & 1), -((bits) >> 2 & 1), -((bits) >> 3 & 1)                                        \
    }
static const int64_t hs_lanes_of[16][4] __attribute__((aligned(32))) = {
    HS_LANES_OF(0),  HS_LANES_OF(1),  HS_LANES_OF(2),  HS_LANES_OF(3), HS_LANES_OF(4),  HS_LANES_OF(5),
    HS_LANES_OF(6),  HS_LANES_OF(7),  HS_LANES_OF(8),  HS_LANES_OF(9), HS_LANES_OF(10), HS_LANES_OF(11),
    HS_LANES_OF(12), HS_LANES_OF(13), HS_LANES_OF(14), HS_LANES_OF(15)};
#undef HS_LANES_OF

/* Masks of an entry: its bits. */
typedef uint32_t hs_masks;
static inline hs_masks hs_masks_of(const hs_cluster_entry *entry, int sub)
{
    (void)sub;
    return entry->mask;
}
static inline hs_msk hs_masks_row(hs_masks masks, int row)
{
    return _mm256_load_pd((const double *)hs_lanes_of[masks >> 4 * row & 0xf]);
}
static inline uint32_t hs_mask_to_bits(hs_msk m) { return (uint32_t)_mm256_movemask_pd(m); }
static inline hs_msk hs_mask_and(hs_msk m, hs_msk n) { return _mm256_and_pd(m, n); }
static inline hs_msk hs_less(hs_vec a, hs_vec b) { return _mm256_cmp_pd(a, b, _CMP_LT_OQ); }
static inline hs_vec hs_keep(hs_msk m, hs_vec a) { return _mm256_and_pd(m, a); }
static inline hs_vec hs_select(hs_msk m, hs_vec a, hs_vec b) { return _mm256_blendv_pd(b, a, m); }

static inline hs_vec hs_max_abs(hs_vec a, hs_vec b)
{
    return _mm256_max_pd(_mm256_andnot_pd(_mm256_set1_pd(-0.0), b), a);
}

static inline double hs_sum(hs_vec a)
{
    const __m128d pair = _mm_add_pd(_mm256_castpd256_pd128(a), _mm256_extractf128_pd(a, 1));
    return _mm_cvtsd_f64(_mm_add_sd(pair, _mm_unpackhi_pd(pair, pair)));
}

static inline hs_vec hs_load_clusters(const double *x, double origin, const hs_cluster_entry *entry, int sub)
{
    (void)sub, (void)origin;
    return _mm256_loadu_pd(x + entry->first);
}

static inline void hs_add_clusters(double *f, const hs_cluster_entry *entry, int sub, hs_vec a)
{
    (void)sub;
    double *at = f + entry->first;
    _mm256_storeu_pd(at, _mm256_add_pd(_mm256_loadu_pd(at), a));
}

static inline hs_vec hs_lookup(const double *table, const int32_t *type, int stride, const hs_cluster_entry *entry,
                               int sub)
{
    (void)sub;
    const __m128i types = _mm_loadu_si128((const __m128i *)(type + entry->first));
    return _mm256_i32gather_pd(table, _mm_mullo_epi32(types, _mm_set1_epi32(stride)), 8);
}
