/* Vectors of 8 floats: AVX2 and FMA. Two clusters fill one vector. */
#include <immintrin.h>

typedef float hs_real;
typedef __m256 hs_vec;
typedef __m256 hs_msk;
#define HS_LANES 8
#define HS_ROWS_IN_TURN

static inline hs_vec hs_set1(double a) { return _mm256_set1_ps((float)a); }
static inline hs_vec hs_fma(hs_vec a, hs_vec b, hs_vec c) { return _mm256_fmadd_ps(a, b, c); }
static inline hs_vec hs_sqrt(hs_vec a) { return _mm256_sqrt_ps(a); }
static inline hs_real hs_local(double x, double origin) { return (float)(x - origin); }

/* Of four bits the lanes they stand for: cheaper to read than to make, which takes four instructions of a vector unit. */
#define HS_LANES_OF(bits)                                                                                              \
    {                                                                                                                  \
        -((bits)&1), -((bits) >> 1 & 1), -((bits) >> 2 & 1), -((bits) >> 3 & 1)                                        \
    }
static const int32_t hs_lanes_of[16][4] __attribute__((aligned(16))) = {
    HS_LANES_OF(0),  HS_LANES_OF(1),  HS_LANES_OF(2),  HS_LANES_OF(3), HS_LANES_OF(4),  HS_LANES_OF(5),
    HS_LANES_OF(6),  HS_LANES_OF(7),  HS_LANES_OF(8),  HS_LANES_OF(9), HS_LANES_OF(10), HS_LANES_OF(11),
    HS_LANES_OF(12), HS_LANES_OF(13), HS_LANES_OF(14), HS_LANES_OF(15)};
#undef HS_LANES_OF

/* Masks of a group: the second entry's in the upper half. */
typedef uint64_t hs_masks;
static inline hs_masks hs_masks_of(const hs_cluster_entry *entry, int sub)
{
    (void)sub;
    return (uint64_t)entry[1].mask << 32 | entry[0].mask;
}
static inline hs_msk hs_masks_row(hs_masks masks, int row)
{
    const __m128 low = _mm_load_ps((const float *)hs_lanes_of[masks >> 4 * row & 0xf]),
                 high = _mm_load_ps((const float *)hs_lanes_of[masks >> (32 + 4 * row) & 0xf]);
    return _mm256_insertf128_ps(_mm256_castps128_ps256(low), high, 1);
}

static inline hs_msk hs_mask_and(hs_msk m, hs_msk n) { return _mm256_and_ps(m, n); }
static inline hs_msk hs_less(hs_vec a, hs_vec b) { return _mm256_cmp_ps(a, b, _CMP_LT_OQ); }
static inline hs_vec hs_keep(hs_msk m, hs_vec a) { return _mm256_and_ps(m, a); }
static inline hs_vec hs_select(hs_msk m, hs_vec a, hs_vec b) { return _mm256_blendv_ps(b, a, m); }

static inline double hs_sum(hs_vec a)
{
    const __m128 four = _mm_add_ps(_mm256_castps256_ps128(a), _mm256_extractf128_ps(a, 1));
    const __m128 two = _mm_add_ps(four, _mm_movehl_ps(four, four));
    return _mm_cvtss_f32(_mm_add_ss(two, _mm_shuffle_ps(two, two, 1)));
}

static inline hs_vec hs_load_clusters(const double *x, double origin, const hs_cluster_entry *entry, int sub)
{
    (void)sub;
    const __m256d from = _mm256_set1_pd(origin);
    const __m128 low = _mm256_cvtpd_ps(_mm256_sub_pd(_mm256_loadu_pd(x + entry[0].first), from));
    const __m128 high = _mm256_cvtpd_ps(_mm256_sub_pd(_mm256_loadu_pd(x + entry[1].first), from));
    return _mm256_insertf128_ps(_mm256_castps128_ps256(low), high, 1);
}

static inline void hs_add_clusters(double *f, const hs_cluster_entry *entry, int sub, hs_vec a)
{
    (void)sub;
    double *f0 = f + entry[0].first, *f1 = f + entry[1].first;
    _mm256_storeu_pd(f0, _mm256_add_pd(_mm256_loadu_pd(f0), _mm256_cvtps_pd(_mm256_castps256_ps128(a))));
    _mm256_storeu_pd(f1, _mm256_add_pd(_mm256_loadu_pd(f1), _mm256_cvtps_pd(_mm256_extractf128_ps(a, 1))));
}

static inline hs_vec hs_lookup(const double *table, const int32_t *type, int stride, const hs_cluster_entry *entry,
                               int sub)
{
    (void)sub;
    __m128 half[2];
    for (int k = 0; k < 2; ++k) {
        const __m128i types = _mm_loadu_si128((const __m128i *)(type + entry[k].first));
        half[k] = _mm256_cvtpd_ps(_mm256_i32gather_pd(table, _mm_mullo_epi32(types, _mm_set1_epi32(stride)), 8));
    }
    return _mm256_insertf128_ps(_mm256_castps128_ps256(half[0]), half[1], 1);
}
