/** Sums of floating-point numbers that do not depend on the order of the terms: the exact sum, rounded once.
 *
 *  The sum is kept as one long fixed-point number that spans the whole range of a double, in digits of 32 bits held in
 *  64-bit integers, so that about 2^30 terms can be added before carries must be passed on. Method: U. Kulisch, V.
 *  Snyder, Computing 91, 307 (2011), doi:10.1007/s00607-010-0127-7. Zero-initialised it is the empty sum.
 *
 *  Terms wait until there are some, and are then added together, for about a nanosecond each. */
#ifndef HS_CORE_EXACT_SUM_H
#define HS_CORE_EXACT_SUM_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "parallel/parallel.h"

enum {
    HS_EXACT_DIGITS = 70,   /**< 2098 bits from 2^-1074 to 2^1024, and room above for sums and scaled integers */
    HS_EXACT_LOWEST = -1074 /**< digit k stands for multiples of 2^(HS_EXACT_LOWEST + 32 k) */
};

enum { HS_EXACT_WAITING = 128 };

typedef struct hs_exact_sum {
    int64_t digit[HS_EXACT_DIGITS];
    int64_t n_added;   /**< since carries were last passed on */
    double not_finite; /**< sum of the terms that are infinite or not numbers; 0 without any */
    int n_waiting;
    int place;                        /**< where the last array was cut (exact_sum.c): most likely right for the next */
    double waiting[HS_EXACT_WAITING]; /**< terms not added yet; last, for there is no need to clear them */
} hs_exact_sum;

/** Make it the empty sum, which takes less time than to clear all of it. */
static inline void hs_exact_clear(hs_exact_sum *sum) { memset(sum, 0, offsetof(hs_exact_sum, waiting)); }

/** Add the terms that wait, and bring every digit but the highest into [0, 2^32). The value stays the same. */
void hs_exact_carry(hs_exact_sum *sum);
/** Its two parts. */
void hs_exact_settle(hs_exact_sum *sum);
void hs_exact_pass_carries(hs_exact_sum *sum);

/** sum += x, exactly. */
static inline void hs_exact_add(hs_exact_sum *sum, double x)
{
    sum->waiting[sum->n_waiting] = x;
    if (++sum->n_waiting == HS_EXACT_WAITING) hs_exact_settle(sum);
}

/** The same at once, for a few nanoseconds. */
static inline void hs_exact_add_now(hs_exact_sum *sum, double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    const int exponent = (int)(bits >> 52 & 0x7ff);
    if (exponent == 0x7ff) {
        sum->not_finite += x;
        return;
    }
    const uint64_t mantissa = (bits & 0xfffffffffffffu) | (uint64_t)(exponent != 0) << 52;
    const int place = exponent != 0 ? exponent - 1 : 0;
    const unsigned __int128 wide = (unsigned __int128)mantissa << (place & 31);
    const int64_t sign = bits >> 63 != 0 ? -1 : 1;
    int64_t *digit = sum->digit + (place >> 5);
    digit[0] += sign * (int64_t)(uint32_t)wide;
    digit[1] += sign * (int64_t)(uint32_t)(wide >> 32);
    digit[2] += sign * (int64_t)(uint64_t)(wide >> 64);
    if (++sum->n_added == INT64_C(1) << 30) hs_exact_pass_carries(sum);
}

enum { HS_EXACT_ARRAY_MAX = 1024 };
/** sum += x[0] + ... + x[n - 1], exactly; up to HS_EXACT_ARRAY_MAX terms at a fraction of the cost of adding each.
 *  Terms are cut at common places (as in J. Demmel, H. D. Nguyen, IEEE Trans. Comput. 64, 2060 (2015),
 *  doi:10.1109/TC.2014.2345391) into parts that are added as integers. */
void hs_exact_add_array(hs_exact_sum *sum, const double *x, int n);
/** sum += n 2^exponent, exactly; exponent from HS_EXACT_LOWEST to 900. */
void hs_exact_add_scaled(hs_exact_sum *sum, __int128 n, int exponent);
/** sum += other. */
void hs_exact_merge(hs_exact_sum *sum, const hs_exact_sum *other);
/** The sum, rounded to the nearest double (to even when in the middle). */
double hs_exact_value(const hs_exact_sum *sum);
/** values[n] of sums over all ranks (collective). The sums are used up. */
void hs_exact_total(hs_exact_sum *sums, int n, const hs_parallel *parallel, double *values);

/** A number with 0 in the place of -0. Of atoms with both, an extreme is that of whichever comes first; and -0 of one rank and 0 of
 *  the others add up to 0. */
static inline double hs_plain_zero(double x) { return x + 0.0; }

#endif
