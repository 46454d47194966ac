/* Vectors of 4 floats: the baseline of x86-64. One cluster fills one vector. */
#include <emmintrin.h>

typedef float hs_real;
typedef __m128 hs_vec;
typedef __m128 hs_msk;
#define HS_LANES 4

static inline hs_vec hs_set1(double a) { return _mm_set1_ps((float)a); }
static inline hs_vec hs_fma(hs_vec a, hs_vec b, hs_vec c) { return _mm_add_ps(_mm_mul_ps(a, b), c); }
static inline hs_vec hs_sqrt(hs_vec a) { return _mm_sqrt_ps(a); }
static inline hs_real hs_local(double x, double origin) { return (float)(x - origin); }

typedef uint32_t hs_masks;
static inline hs_masks hs_masks_of(const hs_cluster_entry *entry, int sub)
{
    (void)sub;
    return entry->mask;
}
static inline hs_msk hs_masks_row(hs_masks masks, int row)
{
    const __m128i lane = _mm_set_epi32(8, 4, 2, 1);
    return _mm_castsi128_ps(_mm_cmpeq_epi32(_mm_and_si128(_mm_set1_epi32((int)(masks >> 4 * row)), lane), lane));
}

static inline hs_msk hs_mask_and(hs_msk m, hs_msk n) { return _mm_and_ps(m, n); }
static inline hs_msk hs_less(hs_vec a, hs_vec b) { return _mm_cmplt_ps(a, b); }
static inline hs_vec hs_keep(hs_msk m, hs_vec a) { return _mm_and_ps(m, a); }
static inline hs_vec hs_select(hs_msk m, hs_vec a, hs_vec b)
{
    return _mm_or_ps(_mm_and_ps(m, a), _mm_andnot_ps(m, b));
}

static inline double hs_sum(hs_vec a)
{
    const __m128 two = _mm_add_ps(a, _mm_movehl_ps(a, a));
    return _mm_cvtss_f32(_mm_add_ss(two, _mm_shuffle_ps(two, two, 1)));
}

static inline hs_vec hs_load_clusters(const double *x, double origin, const hs_cluster_entry *entry, int sub)
{
    (void)sub;
    const double *at = x + entry->first;
    const __m128d from = _mm_set1_pd(origin);
    return _mm_movelh_ps(_mm_cvtpd_ps(_mm_sub_pd(_mm_loadu_pd(at), from)),
                         _mm_cvtpd_ps(_mm_sub_pd(_mm_loadu_pd(at + 2), from)));
}

static inline void hs_add_clusters(double *f, const hs_cluster_entry *entry, int sub, hs_vec a)
{
    (void)sub;
    double *at = f + entry->first;
    _mm_storeu_pd(at, _mm_add_pd(_mm_loadu_pd(at), _mm_cvtps_pd(a)));
    _mm_storeu_pd(at + 2, _mm_add_pd(_mm_loadu_pd(at + 2), _mm_cvtps_pd(_mm_movehl_ps(a, a))));
}

static inline hs_vec hs_lookup(const double *table, const int32_t *type, int stride, const hs_cluster_entry *entry,
                               int sub)
{
    (void)sub;
    const int32_t *at = type + entry->first;
    return _mm_set_ps((float)table[stride * at[3]], (float)table[stride * at[2]], (float)table[stride * at[1]],
                      (float)table[stride * at[0]]);
}
