/* Vectors of 8 floats with the instructions of AVX-512 (F, DQ, VL): mask registers, broadcasts within arithmetic, and
 * twice the registers of AVX2. Two clusters fill one vector. Sixteen floats, that is four clusters, measured no faster: with
 * four clusters together there are few rows left that can be skipped. */
#include <immintrin.h>

typedef float hs_real;
typedef __m256 hs_vec;
typedef __mmask8 hs_msk;
#define HS_LANES 8

static inline hs_vec hs_set1(double a) { return _mm256_set1_ps((float)a); }
static inline hs_vec hs_fma(hs_vec a, hs_vec b, hs_vec c) { return _mm256_fmadd_ps(a, b, c); }
static inline hs_vec hs_sqrt(hs_vec a) { return _mm256_sqrt_ps(a); }
static inline hs_real hs_local(double x, double origin) { return (float)(x - origin); }

/* Masks of a group: for row i the byte i, whose bits are the lanes. */
typedef uint32_t hs_masks;
static inline hs_masks hs_masks_of(const hs_cluster_entry *entry, int sub)
{
    (void)sub;
    return _pdep_u32(entry[0].mask, 0x0f0f0f0fu) | _pdep_u32(entry[1].mask, 0xf0f0f0f0u);
}
static inline hs_msk hs_masks_row(hs_masks masks, int row) { return (hs_msk)(masks >> 8 * row); }

#define HS_COMPRESSES
static inline int hs_append(hs_real *to, hs_msk m, hs_vec a)
{
    _mm256_storeu_ps(to, _mm256_maskz_compress_ps(m, a));
    return __builtin_popcount(m);
}
static inline void hs_append_indices(int32_t *to, hs_msk m, const int32_t *from)
{
    const __m256i all = _mm256_loadu_si256((const __m256i *)(const void *)from);
    _mm256_storeu_si256((__m256i *)(void *)to, _mm256_maskz_compress_epi32(m, all));
}

static inline hs_msk hs_mask_and(hs_msk m, hs_msk n) { return m & n; }
static inline hs_msk hs_less(hs_vec a, hs_vec b) { return _mm256_cmp_ps_mask(a, b, _CMP_LT_OQ); }
static inline hs_vec hs_keep(hs_msk m, hs_vec a) { return _mm256_maskz_mov_ps(m, a); }
static inline hs_vec hs_select(hs_msk m, hs_vec a, hs_vec b) { return _mm256_mask_mov_ps(b, m, a); }

static inline double hs_sum(hs_vec a)
{
    const __m128 four = _mm_add_ps(_mm256_castps256_ps128(a), _mm256_extractf128_ps(a, 1));
    const __m128 two = _mm_add_ps(four, _mm_movehl_ps(four, four));
    return _mm_cvtss_f32(_mm_add_ss(two, _mm_shuffle_ps(two, two, 1)));
}

static inline hs_vec hs_load_clusters(const double *x, double origin, const hs_cluster_entry *entry, int sub)
{
    (void)sub;
    const __m512d low = _mm512_castpd256_pd512(_mm256_loadu_pd(x + entry[0].first));
    return _mm512_cvtpd_ps(
        _mm512_sub_pd(_mm512_insertf64x4(low, _mm256_loadu_pd(x + entry[1].first), 1), _mm512_set1_pd(origin)));
}

static inline void hs_add_clusters(double *f, const hs_cluster_entry *entry, int sub, hs_vec a)
{
    (void)sub;
    const __m512d both = _mm512_cvtps_pd(a);
    double *f0 = f + entry[0].first, *f1 = f + entry[1].first;
    _mm256_storeu_pd(f0, _mm256_add_pd(_mm256_loadu_pd(f0), _mm512_castpd512_pd256(both)));
    _mm256_storeu_pd(f1, _mm256_add_pd(_mm256_loadu_pd(f1), _mm512_extractf64x4_pd(both, 1)));
}

static inline hs_vec hs_lookup(const double *table, const int32_t *type, int stride, const hs_cluster_entry *entry,
                               int sub)
{
    (void)sub;
    const __m128i low = _mm_loadu_si128((const __m128i *)(type + entry[0].first));
    const __m128i high = _mm_loadu_si128((const __m128i *)(type + entry[1].first));
    const __m256i types = _mm256_inserti128_si256(_mm256_castsi128_si256(low), high, 1);
    return _mm512_cvtpd_ps(_mm512_i32gather_pd(_mm256_mullo_epi32(types, _mm256_set1_epi32(stride)), table, 8));
}
