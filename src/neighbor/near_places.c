#include "neighbor/near_places.h"

#if defined(HS_SIMD_AVX512) || defined(HS_SIMD_AVX2)
#include <immintrin.h>
#endif

static inline double distance2(const double *const x[3], const double at[3], int k)
{
    const double dx = x[0][k] - at[0], dy = x[1][k] - at[1], dz = x[2][k] - at[2];
    return dx * dx + dy * dy + dz * dz;
}

/** What is left when all whole vectors are done, or everything. */
static inline int find_rest(const double *const x[3], const double at[3], double range2, int begin, int end,
                            int32_t *near, int n)
{
    for (int k = begin; k < end; ++k) {
        near[n] = k;
        n += distance2(x, at, k) < range2;
    }
    return n;
}

#if defined(HS_SIMD_AVX512)

static int find(const double *const x[3], const double at[3], double range2, int begin, int end, int32_t *near)
{
    const __m512d x0 = _mm512_set1_pd(at[0]), y0 = _mm512_set1_pd(at[1]), z0 = _mm512_set1_pd(at[2]);
    __m256i place = _mm256_add_epi32(_mm256_set1_epi32(begin), _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7));
    int n = 0;
    for (int k = begin; k < end; k += 8) {
        const __mmask8 lanes = (__mmask8)(end - k < 8 ? (1u << (end - k)) - 1u : 0xffu);
        const __m512d dx = _mm512_sub_pd(_mm512_maskz_loadu_pd(lanes, x[0] + k), x0),
                      dy = _mm512_sub_pd(_mm512_maskz_loadu_pd(lanes, x[1] + k), y0),
                      dz = _mm512_sub_pd(_mm512_maskz_loadu_pd(lanes, x[2] + k), z0);
        /* products and sums rounded one by one, as everywhere where places are compared */
        const __m512d r2 =
            _mm512_add_pd(_mm512_add_pd(_mm512_mul_pd(dx, dx), _mm512_mul_pd(dy, dy)), _mm512_mul_pd(dz, dz));
        const __mmask8 is_near = _mm512_mask_cmp_pd_mask(lanes, r2, _mm512_set1_pd(range2), _CMP_LT_OQ);
        _mm256_storeu_si256((__m256i *)(void *)(near + n), _mm256_maskz_compress_epi32(is_near, place));
        n += __builtin_popcount(is_near);
        place = _mm256_add_epi32(place, _mm256_set1_epi32(8));
    }
    return n;
}

#elif defined(HS_SIMD_AVX2)

/* For each set of lanes the bytes that bring them to the front. */
#define LANE(k) 4 * (k), 4 * (k) + 1, 4 * (k) + 2, 4 * (k) + 3
static const signed char front[16][16] = {
    {LANE(0)},
    {LANE(0)},
    {LANE(1)},
    {LANE(0), LANE(1)},
    {LANE(2)},
    {LANE(0), LANE(2)},
    {LANE(1), LANE(2)},
    {LANE(0), LANE(1), LANE(2)},
    {LANE(3)},
    {LANE(0), LANE(3)},
    {LANE(1), LANE(3)},
    {LANE(0), LANE(1), LANE(3)},
    {LANE(2), LANE(3)},
    {LANE(0), LANE(2), LANE(3)},
    {LANE(1), LANE(2), LANE(3)},
    {LANE(0), LANE(1), LANE(2), LANE(3)},
};
#undef LANE

static int find(const double *const x[3], const double at[3], double range2, int begin, int end, int32_t *near)
{
    const __m256d x0 = _mm256_set1_pd(at[0]), y0 = _mm256_set1_pd(at[1]), z0 = _mm256_set1_pd(at[2]);
    int n = 0, k = begin;
    for (; k + 4 <= end; k += 4) {
        const __m256d dx = _mm256_sub_pd(_mm256_loadu_pd(x[0] + k), x0),
                      dy = _mm256_sub_pd(_mm256_loadu_pd(x[1] + k), y0),
                      dz = _mm256_sub_pd(_mm256_loadu_pd(x[2] + k), z0);
        const __m256d r2 =
            _mm256_add_pd(_mm256_add_pd(_mm256_mul_pd(dx, dx), _mm256_mul_pd(dy, dy)), _mm256_mul_pd(dz, dz));
        const int is_near = _mm256_movemask_pd(_mm256_cmp_pd(r2, _mm256_set1_pd(range2), _CMP_LT_OQ));
        const __m128i place = _mm_add_epi32(_mm_set1_epi32(k), _mm_setr_epi32(0, 1, 2, 3)),
                      order = _mm_loadu_si128((const __m128i *)(const void *)front[is_near]);
        _mm_storeu_si128((__m128i *)(void *)(near + n), _mm_shuffle_epi8(place, order));
        n += __builtin_popcount((unsigned)is_near);
    }
    return find_rest(x, at, range2, k, end, near, n);
}

#else

static int find(const double *const x[3], const double at[3], double range2, int begin, int end, int32_t *near)
{
    return find_rest(x, at, range2, begin, end, near, 0);
}

#endif

#define PASTE_(a, b) a##b
#define PASTE(a, b)  PASTE_(a, b)
const hs_near_find PASTE(hs_near_find_, HS_KERNEL_ISA) = find;
