/** From random words to numbers, and the functions that needs, in plain arithmetic: compilers turn loops over them into
 *  vector code, and the bits are the same on every machine and instruction set (no library's log or sin, no fused
 *  multiply-add). */
#ifndef HS_CORE_NOISE_FORMULAS_H
#define HS_CORE_NOISE_FORMULAS_H

#include <math.h>
#include <stdint.h>
#include <string.h>

static inline uint64_t hs_bits_of(double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

static inline double hs_double_of(uint64_t bits)
{
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

/** A whole number below 2^52, by its place in the digits of 2^52: instruction sets without a conversion have this
 *  one. */
static inline double hs_whole_number(uint64_t n) { return hs_double_of(n | UINT64_C(0x4330000000000000)) - 0x1p52; }

/** Sine and cosine of quarter * pi/2 + r for |r| <= pi/4 (a little more does no harm), to the last digit or two: Taylor
 *  series, whose next terms are below 1e-17. */
static inline void hs_sincos_quarter(double r, uint64_t quarter, double *sine, double *cosine)
{
    const double z = r * r;
    double s = -1.0 / 1307674368000.0, c = 1.0 / 20922789888000.0;
    s = s * z + 1.0 / 6227020800.0;
    c = c * z - 1.0 / 87178291200.0;
    s = s * z - 1.0 / 39916800.0;
    c = c * z + 1.0 / 479001600.0;
    s = s * z + 1.0 / 362880.0;
    c = c * z - 1.0 / 3628800.0;
    s = s * z - 1.0 / 5040.0;
    c = c * z + 1.0 / 40320.0;
    s = s * z + 1.0 / 120.0;
    c = c * z - 1.0 / 720.0;
    s = s * z - 1.0 / 6.0;
    c = c * z + 1.0 / 24.0;
    s = s * z * r + r;
    c = (c * z - 0.5) * z + 1.0;
    const uint64_t sine_bits = hs_bits_of(s), cosine_bits = hs_bits_of(c), swap = -(quarter & 1u);
    const uint64_t both = (sine_bits ^ cosine_bits) & swap;
    *sine = hs_double_of(sine_bits ^ both ^ (quarter >> 1 & 1u) << 63);
    *cosine = hs_double_of(cosine_bits ^ both ^ ((quarter + 1) >> 1 & 1u) << 63);
}

/** Sine and cosine of an angle of less than 2^30, in radians. */
static inline void hs_sincos(double angle, double *sine, double *cosine)
{
    const double magic = 0x1.8p52; /* a sum with it is rounded to a whole number, which stands in its lowest bits */
    const double shifted = angle * (2.0 / M_PI) + magic, n = shifted - magic;
    /* pi/2 in two parts, the first short enough for exact products */
    const double r = (angle - n * 0x1.921fb544p0) - n * 0x1.0b4611a626331p-34;
    hs_sincos_quarter(r, hs_bits_of(shifted), sine, cosine);
}

/** Angles, in radians, for which hs_sincos_small serves. */
#define HS_SMALL_ANGLE 0x1p-4

/** Sine and cosine of an angle of at most HS_SMALL_ANGLE either way: half of the instructions of hs_sincos. Taylor series, whose next
 *  terms are below 2^-65 and 2^-61 of the results. */
static inline void hs_sincos_small(double angle, double *sine, double *cosine)
{
    const double z = angle * angle;
    double s = 1.0 / 362880.0, c = 1.0 / 40320.0;
    s = s * z - 1.0 / 5040.0;
    c = c * z - 1.0 / 720.0;
    s = s * z + 1.0 / 120.0;
    c = c * z + 1.0 / 24.0;
    s = s * z - 1.0 / 6.0;
    c = c * z - 0.5;
    *sine = s * z * angle + angle;
    *cosine = c * z + 1.0;
}

/** Natural logarithm of a positive, normal number over 2^32: exponent and mantissa, 2 artanh((m - 1) / (m + 1)) by its
 *  series; |s| <= 0.172, so the terms left out are below 1e-17. */
static inline double hs_log_of_fraction(double x)
{
    const uint64_t bits = hs_bits_of(x);
    double m = hs_double_of((bits & UINT64_C(0x000fffffffffffff)) | UINT64_C(0x3ff0000000000000));
    double e = hs_whole_number(bits >> 52) - (1023.0 + 32.0);
    const double e_next = e + 1.0, m_half = 0.5 * m;
    const uint64_t is_large = -(uint64_t)(m > M_SQRT2);
    e = hs_double_of((hs_bits_of(e) & ~is_large) | (hs_bits_of(e_next) & is_large));
    m = hs_double_of((hs_bits_of(m) & ~is_large) | (hs_bits_of(m_half) & is_large));
    const double s = (m - 1.0) / (m + 1.0), z = s * s;
    double sum = 1.0 / 21.0;
    sum = sum * z + 1.0 / 19.0;
    sum = sum * z + 1.0 / 17.0;
    sum = sum * z + 1.0 / 15.0;
    sum = sum * z + 1.0 / 13.0;
    sum = sum * z + 1.0 / 11.0;
    sum = sum * z + 1.0 / 9.0;
    sum = sum * z + 1.0 / 7.0;
    sum = sum * z + 1.0 / 5.0;
    sum = sum * z + 1.0 / 3.0;
    return e * M_LN2 + (2.0 * s * (sum * z) + 2.0 * s);
}

/** Mean 0, variance 1, evenly spread: the middles of 2^32 equal parts of (-sqrt(3), sqrt(3)). */
static inline double hs_noise_uniform(uint64_t word)
{
    return (hs_whole_number(word) - (0x1p31 - 0.5)) * (3.4641016151377545871 * 0x1p-32);
}

/** Two independent normal numbers from two words. Source: G. E. P. Box, M. E. Muller, Ann. Math. Stat. 29, 610 (1958),
 *  doi:10.1214/aoms/1177706645. */
static inline void hs_noise_gaussians(uint64_t word_a, uint64_t word_b, double *a, double *b)
{
    const double radius = sqrt(-2.0 * hs_log_of_fraction(hs_whole_number(word_a) + 0.5));
    const uint64_t turn = (word_b + (UINT64_C(1) << 29)) & UINT64_C(0xffffffff); /* an eighth of a turn ahead */
    const double r = (hs_whole_number(turn & ((UINT64_C(1) << 30) - 1)) - (0x1p29 - 0.5)) * (2.0 * M_PI * 0x1p-32);
    double sine, cosine;
    hs_sincos_quarter(r, turn >> 30, &sine, &cosine);
    *a = radius * cosine;
    *b = radius * sine;
}

#endif
