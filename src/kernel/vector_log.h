/** Natural logarithm on the vectors of kernel/simd.h, for evaluators with powers of any exponent; written as the functions of
 *  kernel/vector_math.h are.
 *
 *      hs_log(x)    2 units in the last place; x must be positive, normal and finite */
#ifndef HS_KERNEL_VECTOR_LOG_H
#define HS_KERNEL_VECTOR_LOG_H

#include "kernel/vector_math.h"

enum { HS_LOG_TERMS = sizeof(hs_real) == sizeof(float) ? 4 : 10 };

/** log x = k ln 2 + log m, sqrt(1/2) <= m < sqrt(2), and log m = 2 artanh(s) with s = (m - 1)/(m + 1), |s| < 0.172. */
static inline hs_vec hs_log(hs_vec x)
{
    static const double c[] = {1.0 / 3,  1.0 / 5,  1.0 / 7,  1.0 / 9,  1.0 / 11,
                               1.0 / 13, 1.0 / 15, 1.0 / 17, 1.0 / 19, 1.0 / 21};
    const bool is_float = sizeof(hs_real) == sizeof(float);
    /* as in hs_exp: k times the first part of ln 2 is exact */
    const double ln2_high = is_float ? 0x1.62e4p-1 : 0x1.62e42fefap-1;
    const double ln2_low = is_float ? 0x1.7f7d1cf79abcap-20 : 0x1.cf79abc9e3b3ap-40;
    const hs_words bits = hs_bits_of(x);
    const hs_word fraction = ((hs_word)1 << HS_MANTISSA_BITS) - 1;
    /* 2^52 (float: 2^23) has a last place of 1: its lowest bits are an integer */
    const double whole = (double)((int64_t)1 << HS_MANTISSA_BITS);
    const hs_vec exponent = hs_vec_of((bits >> HS_MANTISSA_BITS) | hs_bits_of(hs_set1(whole))) - hs_set1(whole);
    const hs_vec mantissa = hs_vec_of((bits & fraction) | hs_bits_of(hs_set1(1.0)));
    const hs_msk is_large = hs_less(hs_set1(0x1.6a09e667f3bcdp0), mantissa);
    const hs_vec m = hs_select(is_large, mantissa * hs_set1(0.5), mantissa);
    const hs_vec k = exponent - hs_select(is_large, hs_set1(HS_EXPONENT_BIAS - 1.0), hs_set1(HS_EXPONENT_BIAS));
    const hs_vec s = (m - hs_set1(1.0)) / (m + hs_set1(1.0)), s2 = s * s, twice = s + s;
    const hs_vec rest = hs_fma(k, hs_set1(ln2_low), twice * s2 * hs_polynomial(c, HS_LOG_TERMS - 1, s2));
    return hs_fma(k, hs_set1(ln2_high), twice + rest);
}

#endif
