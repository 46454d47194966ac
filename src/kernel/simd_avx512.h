/* Vectors of 8 doubles: AVX-512 F and DQ. Two clusters fill one vector. */
#include <immintrin.h>

typedef double hs_real;
typedef __m512d hs_vec;
typedef __mmask8 hs_msk;
#define HS_LANES 8

static inline hs_vec hs_set1(double a) { return _mm512_set1_pd(a); }
static inline hs_vec hs_fma(hs_vec a, hs_vec b, hs_vec c) { return _mm512_fmadd_pd(a, b, c); }
static inline hs_vec hs_sqrt(hs_vec a) { return _mm512_sqrt_pd(a); }
static inline hs_real hs_local(double x, double origin)
{
    (void)origin;
    return x;
}

/* Masks of a group: for row i the byte i, whose bits are the lanes. */
typedef uint32_t hs_masks;
static inline hs_masks hs_masks_of(const hs_cluster_entry *entry, int sub)
{
    (void)sub;
    return _pdep_u32(entry[0].mask, 0x0f0f0f0fu) | _pdep_u32(entry[1].mask, 0xf0f0f0f0u);
}
static inline hs_msk hs_masks_row(hs_masks masks, int row) { return (hs_msk)(masks >> 8 * row); }

static inline uint32_t hs_mask_to_bits(hs_msk m) { return m; }
#define HS_COMPRESSES
static inline int hs_append(hs_real *to, hs_msk m, hs_vec a)
{
    _mm512_storeu_pd(to, _mm512_maskz_compress_pd(m, a));
    return __builtin_popcount(m);
}
static inline void hs_append_indices(int32_t *to, hs_msk m, const int32_t *from)
{
    const __m256i all = _mm256_loadu_si256((const __m256i *)(const void *)from);
    _mm256_storeu_si256((__m256i *)(void *)to, _mm256_maskz_compress_epi32(m, all));
}

#define HS_GATHERS
static inline hs_vec hs_machine_gather(const double *x, const int32_t *j)
{
    /* into zeros: what is undefined would have to wait for whatever the register had before */
    const __m256i index = _mm256_loadu_si256((const __m256i *)(const void *)j);
    return _mm512_mask_i32gather_pd(_mm512_setzero_pd(), 0xff, index, x, sizeof *x);
}

static inline hs_msk hs_mask_and(hs_msk m, hs_msk n) { return m & n; }
static inline hs_msk hs_less(hs_vec a, hs_vec b) { return _mm512_cmp_pd_mask(a, b, _CMP_LT_OQ); }
static inline hs_vec hs_keep(hs_msk m, hs_vec a) { return _mm512_maskz_mov_pd(m, a); }
static inline hs_vec hs_select(hs_msk m, hs_vec a, hs_vec b) { return _mm512_mask_mov_pd(b, m, a); }
static inline hs_vec hs_max_abs(hs_vec a, hs_vec b)
{
    return _mm512_range_pd(a, b, 11);
} /* larger size, without sign */
static inline double hs_sum(hs_vec a) { return _mm512_reduce_add_pd(a); }

static inline hs_vec hs_load_clusters(const double *x, double origin, const hs_cluster_entry *entry, int sub)
{
    (void)sub, (void)origin;
    const __m512d low = _mm512_castpd256_pd512(_mm256_loadu_pd(x + entry[0].first));
    return _mm512_insertf64x4(low, _mm256_loadu_pd(x + entry[1].first), 1);
}

/* One half after the other: the lanes behind a short cluster's last atom are those of the next, which may be the other half. */
static inline void hs_add_clusters(double *f, const hs_cluster_entry *entry, int sub, hs_vec a)
{
    (void)sub;
    double *f0 = f + entry[0].first, *f1 = f + entry[1].first;
    _mm256_storeu_pd(f0, _mm256_add_pd(_mm256_loadu_pd(f0), _mm512_castpd512_pd256(a)));
    _mm256_storeu_pd(f1, _mm256_add_pd(_mm256_loadu_pd(f1), _mm512_extractf64x4_pd(a, 1)));
}

static inline hs_vec hs_lookup(const double *table, const int32_t *type, int stride, const hs_cluster_entry *entry,
                               int sub)
{
    (void)sub;
    const __m128i low = _mm_loadu_si128((const __m128i *)(type + entry[0].first));
    const __m128i high = _mm_loadu_si128((const __m128i *)(type + entry[1].first));
    const __m256i types = _mm256_inserti128_si256(_mm256_castsi128_si256(low), high, 1);
    return _mm512_i32gather_pd(_mm256_mullo_epi32(types, _mm256_set1_epi32(stride)), table, 8);
}
