/** Functions on the vectors of kernel/simd.h, for evaluators: exponential, sine and cosine to the last few bits.
 *
 *  They are written over the SIMD contract alone: one source, the same operations in the same order for every instruction
 *  set, in double and in float. No tables, no branches, no libm. Errors over the whole range of arguments, in units in the
 *  last place (tests/kernel/test_vector_math.c measures them against libm's long double functions):
 *
 *      hs_exp(x)                   1 (1.5 of the smallest normal number's last place below it); 0 and infinity where e^x
 *                                  leaves the range
 *      hs_sincospi(x, &s, &c)      sin(pi x) and cos(pi x), 2; |x| up to 2^50 (float: 2^21)
 *
 *  The series are Taylor's: their truncation errors are below a tenth of a unit in the reduced ranges. */
#ifndef HS_KERNEL_VECTOR_MATH_H
#define HS_KERNEL_VECTOR_MATH_H

#include "kernel/simd.h"

#ifdef HS_MIXED
typedef uint32_t hs_word; /**< holds the bits of a hs_real */
enum { HS_MANTISSA_BITS = 23, HS_EXPONENT_BIAS = 127, HS_EXP_TERMS = 6, HS_SIN_TERMS = 4, HS_COS_TERMS = 5 };
#else
typedef uint64_t hs_word;
enum { HS_MANTISSA_BITS = 52, HS_EXPONENT_BIAS = 1023, HS_EXP_TERMS = 12, HS_SIN_TERMS = 8, HS_COS_TERMS = 8 };
#endif
#if defined(HS_SIMD_AVX512) || defined(HS_SIMD_AVX2) || defined(HS_SIMD_SSE2)
typedef hs_word hs_words __attribute__((vector_size(sizeof(hs_vec)))); /**< the bits of a hs_vec */
#else
typedef hs_word hs_words;
#endif

static inline hs_words hs_bits_of(hs_vec a)
{
    hs_words bits;
    memcpy(&bits, &a, sizeof bits);
    return bits;
}

static inline hs_vec hs_vec_of(hs_words bits)
{
    hs_vec a;
    memcpy(&a, &bits, sizeof a);
    return a;
}

/** 1.5 times the number whose last place is 1: adding it to x rounds x to an integer, which stands in the lowest bits. */
static inline hs_vec hs_rounder(void) { return hs_set1(1.5 * (double)((int64_t)1 << HS_MANTISSA_BITS)); }

/** 2^k, where k is an integer of the range of exponents of normal numbers. */
static inline hs_vec hs_two_to(hs_vec k)
{
    return hs_vec_of((hs_bits_of(k + hs_rounder()) + (hs_word)HS_EXPONENT_BIAS) << HS_MANTISSA_BITS);
}

/** x with its sign changed where the second-lowest bit of `rounded` is set: see hs_rounder. */
static inline hs_vec hs_negate_second(hs_vec x, hs_vec rounded)
{
    const hs_words second = hs_bits_of(rounded) >> 1;
    return hs_vec_of(hs_bits_of(x) ^ second << (8 * (int)sizeof(hs_real) - 1));
}

/** Sum of c[k] x^k for k = 0 .. n. */
static inline __attribute__((always_inline)) hs_vec hs_polynomial(const double *c, int n, hs_vec x)
{
    hs_vec sum = hs_set1(c[n]);
#pragma GCC unroll 16
    for (int k = n - 1; k >= 0; --k) sum = hs_fma(sum, x, hs_set1(c[k]));
    return sum;
}

/** e^x = 2^k e^r, k the integer next to x / ln 2, |r| <= ln 2 / 2. */
static inline hs_vec hs_exp(hs_vec x)
{
    /* 1/2!, 1/3!, ...: with the two first terms of the series apart, the rounding errors of all others hardly count */
    static const double c[] = {1.0 / 2,       1.0 / 6,        1.0 / 24,        1.0 / 120,
                               1.0 / 720,     1.0 / 5040,     1.0 / 40320,     1.0 / 362880,
                               1.0 / 3628800, 1.0 / 39916800, 1.0 / 479001600, 1.0 / 6227020800};
    const bool is_float = sizeof(hs_real) == sizeof(float);
    /* ln 2 in two parts: k times the first is exact, because its last bits are zero */
    const double ln2_high = is_float ? 0x1.62e4p-1 : 0x1.62e42fefap-1;
    const double ln2_low = is_float ? 0x1.7f7d1cf79abcap-20 : 0x1.cf79abc9e3b3ap-40;
    /* beyond these the result is infinite or zero; what is not a number stays so */
    x = hs_min(hs_set1(is_float ? 89.0 : 710.0), hs_max(hs_set1(is_float ? -104.0 : -746.0), x));
    const hs_vec k = hs_fma(x, hs_set1(0x1.71547652b82fep0), hs_rounder()) - hs_rounder();
    const hs_vec r = hs_fma(k, hs_set1(-ln2_low), hs_fma(k, hs_set1(-ln2_high), x));
    const hs_vec exp_r = hs_set1(1.0) + hs_fma(r * r, hs_polynomial(c, HS_EXP_TERMS - 1, r), r);
    /* in two steps, so that neither power of two leaves the range before the result does */
    const hs_vec half = hs_fma(k, hs_set1(0.5), hs_rounder()) - hs_rounder();
    return exp_r * hs_two_to(half) * hs_two_to(k - half);
}

/** sin(pi x) and cos(pi x): x = k/2 + r, |r| <= 1/4; k says which of sin(pi r) and cos(pi r) is which, and its sign. */
static inline void hs_sincospi(hs_vec x, hs_vec *sine, hs_vec *cosine)
{
    /* (-1)^k pi^(2k+1) / (2k+1)! and (-1)^k pi^(2k) / (2k)! without the first terms */
    static const double s[] = {-0x1.4abbce625be53p+2,  0x1.466bc6775aae2p+1,  -0x1.32d2cce62bd86p-1,
                               0x1.50783487ee782p-4,   -0x1.e3074fde8871fp-8, 0x1.e8f434d018d63p-12,
                               -0x1.6fadb9f155744p-16, 0x1.aaec32af93359p-21};
    static const double c[] = {-0x1.3bd3cc9be45dep+2,  0x1.03c1f081b5ac4p+2,  -0x1.55d3c7e3cbffap+0,
                               0x1.e1f506891babbp-3,   -0x1.a6d1f2a204a8cp-6, 0x1.f9d38a3763cc3p-10,
                               -0x1.b6e24f44b128fp-14, 0x1.20c62c2f2d7f5p-18};
    const hs_vec rounded = x + x + hs_rounder(), k = rounded - hs_rounder();
    const hs_vec r = hs_fma(k, hs_set1(-0.5), x), r2 = r * r;
    const hs_vec sin_r = hs_fma(r * r2, hs_polynomial(s, HS_SIN_TERMS - 1, r2), r * hs_set1(0x1.921fb54442d18p+1));
    const hs_vec cos_r = hs_fma(r2, hs_polynomial(c, HS_COS_TERMS - 1, r2), hs_set1(1.0));
    const hs_vec half = hs_fma(k, hs_set1(0.5), hs_rounder()) - hs_rounder(),
                 odd = hs_fma(k, hs_set1(0.5), hs_set1(0.0) - half);
    const hs_msk is_odd = hs_less(hs_set1(0.1), odd * odd);
    *sine = hs_negate_second(hs_select(is_odd, cos_r, sin_r), rounded);
    *cosine = hs_negate_second(hs_select(is_odd, sin_r, cos_r), rounded + hs_set1(1.0));
}

#endif
