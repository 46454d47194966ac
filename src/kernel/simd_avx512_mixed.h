/* Vectors of 16 floats: AVX-512 F and DQ. Four clusters fill one vector. With half as wide ones, of two clusters, fewer lanes are
 * computed, and yet the kernel was 4 % slower, 10 when packed clusters are taken as whole lines. */
#include <immintrin.h>

typedef float hs_real;
typedef __m512 hs_vec;
typedef __mmask16 hs_msk;
#define HS_LANES 16

static inline hs_vec hs_set1(double a) { return _mm512_set1_ps((float)a); }
static inline hs_vec hs_fma(hs_vec a, hs_vec b, hs_vec c) { return _mm512_fmadd_ps(a, b, c); }
static inline hs_vec hs_sqrt(hs_vec a) { return _mm512_sqrt_ps(a); }
static inline hs_real hs_local(double x, double origin) { return (float)(x - origin); }

/* Masks of a group: for row i the 16 bits from 16 i on, whose bits are the lanes. */
typedef uint64_t hs_masks;
static inline hs_masks hs_masks_of(const hs_cluster_entry *entry, int sub)
{
    (void)sub;
    return _pdep_u64(entry[0].mask, 0x000f000f000f000fu) | _pdep_u64(entry[1].mask, 0x00f000f000f000f0u) |
           _pdep_u64(entry[2].mask, 0x0f000f000f000f00u) | _pdep_u64(entry[3].mask, 0xf000f000f000f000u);
}
static inline hs_msk hs_masks_row(hs_masks masks, int row) { return (hs_msk)(masks >> 16 * row); }

#define HS_COMPRESSES
static inline int hs_append(hs_real *to, hs_msk m, hs_vec a)
{
    _mm512_storeu_ps(to, _mm512_maskz_compress_ps(m, a));
    return __builtin_popcount(m);
}
static inline void hs_append_indices(int32_t *to, hs_msk m, const int32_t *from)
{
    const __m512i all = _mm512_loadu_si512((const void *)from);
    _mm512_storeu_si512((void *)to, _mm512_maskz_compress_epi32(m, all));
}

static inline hs_msk hs_mask_and(hs_msk m, hs_msk n) { return m & n; }
static inline hs_msk hs_less(hs_vec a, hs_vec b) { return _mm512_cmp_ps_mask(a, b, _CMP_LT_OQ); }
static inline hs_vec hs_keep(hs_msk m, hs_vec a) { return _mm512_maskz_mov_ps(m, a); }
static inline hs_vec hs_select(hs_msk m, hs_vec a, hs_vec b) { return _mm512_mask_mov_ps(b, m, a); }
static inline double hs_sum(hs_vec a) { return _mm512_reduce_add_ps(a); }

/* Floats of two clusters of doubles. */
static inline __m256 hs_two_clusters(const double *x, double origin, const hs_cluster_entry *entry)
{
    const __m512d low = _mm512_castpd256_pd512(_mm256_loadu_pd(x + entry[0].first));
    return _mm512_cvtpd_ps(
        _mm512_sub_pd(_mm512_insertf64x4(low, _mm256_loadu_pd(x + entry[1].first), 1), _mm512_set1_pd(origin)));
}
static inline hs_vec hs_load_clusters(const double *x, double origin, const hs_cluster_entry *entry, int sub)
{
    (void)sub;
    return _mm512_insertf32x8(_mm512_castps256_ps512(hs_two_clusters(x, origin, entry)),
                              hs_two_clusters(x, origin, entry + 2), 1);
}

static inline void hs_add_two_clusters(double *f, const hs_cluster_entry *entry, __m256 a)
{
    const __m512d both = _mm512_cvtps_pd(a);
    double *f0 = f + entry[0].first, *f1 = f + entry[1].first;
    _mm256_storeu_pd(f0, _mm256_add_pd(_mm256_loadu_pd(f0), _mm512_castpd512_pd256(both)));
    _mm256_storeu_pd(f1, _mm256_add_pd(_mm256_loadu_pd(f1), _mm512_extractf64x4_pd(both, 1)));
}
static inline void hs_add_clusters(double *f, const hs_cluster_entry *entry, int sub, hs_vec a)
{
    (void)sub;
    hs_add_two_clusters(f, entry, _mm512_castps512_ps256(a));
    hs_add_two_clusters(f, entry + 2, _mm512_extractf32x8_ps(a, 1));
}

static inline __m256 hs_lookup_two(const double *table, const int32_t *type, int stride, const hs_cluster_entry *entry)
{
    const __m128i low = _mm_loadu_si128((const __m128i *)(type + entry[0].first));
    const __m128i high = _mm_loadu_si128((const __m128i *)(type + entry[1].first));
    const __m256i types = _mm256_inserti128_si256(_mm256_castsi128_si256(low), high, 1);
    return _mm512_cvtpd_ps(_mm512_i32gather_pd(_mm256_mullo_epi32(types, _mm256_set1_epi32(stride)), table, 8));
}
static inline hs_vec hs_lookup(const double *table, const int32_t *type, int stride, const hs_cluster_entry *entry,
                               int sub)
{
    (void)sub;
    return _mm512_insertf32x8(_mm512_castps256_ps512(hs_lookup_two(table, type, stride, entry)),
                              hs_lookup_two(table, type, stride, entry + 2), 1);
}

/* Packed clusters are taken as whole lines of the cache, four at once, and transposed in blocks of four numbers. */
#define HS_TAKES_PACKED
typedef __m512i hs_places;
static inline void hs_load_packed(const int32_t *site, const hs_cluster_entry *entry, int sub, hs_places x[3])
{
    (void)sub;
    __m512i line[4];
    for (int k = 0; k < 4; ++k) line[k] = _mm512_load_si512((const void *)(site + entry[k].first));
    const __m512i low = _mm512_shuffle_i32x4(line[0], line[1], 0x44), /* x x y y */
        high = _mm512_shuffle_i32x4(line[2], line[3], 0x44);
    x[0] = _mm512_shuffle_i32x4(low, high, 0x88);
    x[1] = _mm512_shuffle_i32x4(low, high, 0xdd);
    x[2] = _mm512_shuffle_i32x4(_mm512_shuffle_i32x4(line[0], line[1], 0xee),
                                _mm512_shuffle_i32x4(line[2], line[3], 0xee), 0x88);
}
static inline void hs_add_packed(float *f, const hs_cluster_entry *entry, int sub, const hs_vec sum[3])
{
    (void)sub;
    const hs_vec low = _mm512_shuffle_f32x4(sum[0], sum[1], 0x44), /* x x y y */
        high = _mm512_shuffle_f32x4(sum[0], sum[1], 0xee);
    const __mmask16 xyz = 0x0fff;
    const hs_vec line[4] = {
        _mm512_maskz_shuffle_f32x4(xyz, low, sum[2], 0x08), _mm512_maskz_shuffle_f32x4(xyz, low, sum[2], 0x1d),
        _mm512_maskz_shuffle_f32x4(xyz, high, sum[2], 0x28), _mm512_maskz_shuffle_f32x4(xyz, high, sum[2], 0x3d)};
    for (int k = 0; k < 4; ++k) {
        float *to = f + entry[k].first;
        _mm512_store_ps(to, _mm512_load_ps(to) + line[k]);
    }
}
