/* Philox and what follows for blocks of atoms; compiled for every instruction set.
 *
 * Compilers do not find the vector form of Random123's code (6.6 ns a draw, SSE2 and AVX2), so the ten rounds are written
 * here for vectors of 64-bit lanes whose lower halves count: 1.8 ns with AVX-512. The portable set calls Random123. */
#include "kernel/noise_fill.h"

#include "core/noise_formulas.h"

enum { N_ROUNDS = 10 };

#if defined(HS_SIMD_AVX512) || defined(HS_SIMD_AVX2) || defined(HS_SIMD_SSE2)
#include <immintrin.h>

#if defined(HS_SIMD_AVX512)
typedef uint64_t lanes __attribute__((vector_size(64)));
static inline lanes multiply(lanes a, lanes b) { return (lanes)_mm512_mul_epu32((__m512i)a, (__m512i)b); }
static inline lanes high(lanes a) { return (lanes)_mm512_shuffle_epi32((__m512i)a, (_MM_PERM_ENUM)0xf5); }
#elif defined(HS_SIMD_AVX2)
typedef uint64_t lanes __attribute__((vector_size(32)));
static inline lanes multiply(lanes a, lanes b) { return (lanes)_mm256_mul_epu32((__m256i)a, (__m256i)b); }
static inline lanes high(lanes a) { return (lanes)_mm256_shuffle_epi32((__m256i)a, 0xf5); }
#else
typedef uint64_t lanes __attribute__((vector_size(16)));
static inline lanes multiply(lanes a, lanes b) { return (lanes)_mm_mul_epu32((__m128i)a, (__m128i)b); }
static inline lanes high(lanes a) { return (lanes)_mm_shuffle_epi32((__m128i)a, 0xf5); }
#endif

enum { N_LANES = (int)(sizeof(lanes) / sizeof(uint64_t)) };

/** The words of a draw, each in the lower half of a lane. The upper halves of the lanes hold what the rounds leave there:
 *  products read lower halves only. */
static inline void make_words(hs_noise noise, int64_t step, int draw, const int64_t *id, int n,
                              uint64_t word[HS_NOISE_NUMBERS][HS_NOISE_BLOCK])
{
    const lanes zero = {0}, low = zero + UINT64_C(0xffffffff);
    const lanes factor_0 = zero + UINT64_C(0xD2511F53), factor_1 = zero + UINT64_C(0xCD9E8D57);
    for (int i = 0; i < n; i += N_LANES) {
        lanes x0;
        memcpy(&x0, id + i, sizeof x0);
        lanes x1 = x0 >> 32, x2 = zero + (uint64_t)(uint32_t)step, x3 = zero + hs_noise_step_high(step, draw);
        uint32_t key_0 = noise.seed, key_1 = noise.stream;
        for (int round = 0; round < N_ROUNDS; ++round) {
            const lanes product_0 = multiply(x0, factor_0), product_1 = multiply(x2, factor_1);
            x0 = high(product_1) ^ x1 ^ key_0;
            x2 = high(product_0) ^ x3 ^ key_1;
            x1 = product_1;
            x3 = product_0;
            key_0 += 0x9E3779B9u;
            key_1 += 0xBB67AE85u;
        }
        const lanes words[HS_NOISE_NUMBERS] = {x0 & low, x1 & low, x2 & low, x3 & low};
        for (int k = 0; k < HS_NOISE_NUMBERS; ++k) memcpy(&word[k][i], &words[k], sizeof(lanes));
    }
}
#else
static inline void make_words(hs_noise noise, int64_t step, int draw, const int64_t *id, int n,
                              uint64_t word[HS_NOISE_NUMBERS][HS_NOISE_BLOCK])
{
    for (int i = 0; i < n; ++i) {
        uint32_t words[HS_NOISE_NUMBERS];
        hs_noise_words(noise, step, draw, id[i], words);
        for (int k = 0; k < HS_NOISE_NUMBERS; ++k) word[k][i] = words[k];
    }
}
#endif

static void fill(hs_noise noise, hs_noise_kind kind, int64_t step, int draw, int n_numbers, const int64_t *id, int n,
                 hs_noise_block *block)
{
    _Alignas(64) uint64_t word[HS_NOISE_NUMBERS][HS_NOISE_BLOCK];
    make_words(noise, step, draw, id, n, word);
    if (kind == HS_NOISE_UNIFORM) {
        for (int k = 0; k < n_numbers; ++k)
            for (int i = 0; i < n; ++i) block->number[k][i] = hs_noise_uniform(word[k][i]);
    } else {
        for (int k = 0; k < n_numbers; k += 2)
            for (int i = 0; i < n; ++i)
                hs_noise_gaussians(word[k][i], word[k + 1][i], &block->number[k][i], &block->number[k + 1][i]);
    }
}

static void sincos_fill(const double *restrict angle, int n, double *restrict sine, double *restrict cosine)
{
    for (int i = 0; i < n; ++i) hs_sincos(angle[i], &sine[i], &cosine[i]);
}

#define PASTE_(a, b) a##b
#define PASTE(a, b)  PASTE_(a, b)
const hs_noise_set PASTE(hs_noise_set_, HS_KERNEL_ISA) = {.fill = fill, .sincos = sincos_fill};
