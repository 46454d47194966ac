#include "core/exact_sum.h"

#include <math.h>

#include "base/wide.h"

void hs_exact_carry(hs_exact_sum *sum)
{
    hs_exact_settle(sum);
    hs_exact_pass_carries(sum);
}

void hs_exact_settle(hs_exact_sum *sum)
{
    const int n = sum->n_waiting;
    sum->n_waiting = 0;
    hs_exact_add_array(sum, sum->waiting, n);
}

void hs_exact_pass_carries(hs_exact_sum *sum)
{
    for (int k = 0; k < HS_EXACT_DIGITS - 1; ++k) {
        const int64_t carry = sum->digit[k] >> 32; /* rounds down, so that what stays is not negative */
        sum->digit[k] -= carry * (INT64_C(1) << 32);
        sum->digit[k + 1] += carry;
    }
    sum->n_added = 0;
}

void hs_exact_add_scaled(hs_exact_sum *sum, __int128 n, int exponent)
{
    const int place = exponent - HS_EXACT_LOWEST;
    const int64_t sign = n < 0 ? -1 : 1;
    const unsigned __int128 size = n < 0 ? -(unsigned __int128)n : (unsigned __int128)n;
    int64_t *digit = sum->digit + (place >> 5);
    const int shift = place & 31;
    /* 32 bits at a time, so that a shift never loses any */
    for (int part = 0; part < 4; ++part) {
        const uint64_t piece = (uint64_t)(uint32_t)(size >> 32 * part) << shift;
        digit[part] += sign * (int64_t)(uint32_t)piece;
        digit[part + 1] += sign * (int64_t)(piece >> 32);
    }
    sum->n_added += 2;
    if (sum->n_added >= INT64_C(1) << 30) hs_exact_pass_carries(sum);
}

enum { STREAMS = 8 }; /* sums side by side */

/** Eight doubles, in as many registers as the machine needs: compilers make poor code of loops over arrays here. */
typedef double streams __attribute__((vector_size(STREAMS * sizeof(double))));
typedef int64_t stream_bits __attribute__((vector_size(STREAMS * sizeof(double))));
typedef uint64_t stream_sums __attribute__((vector_size(STREAMS * sizeof(double)))); /**< wrap around */

/** Sizes: the signs go. No function, for such a value is returned in one way with AVX-512 and in another without. */
#define SIZES(x) ((streams)((stream_bits)(x)&INT64_MAX))

/** Up to HS_EXACT_ARRAY_MAX terms below 2^(place + 51), cut at 2^place and at 2^(place - 51): whole numbers of both,
 *  and what is left. */
typedef struct cut_sums {
    int64_t high, low;
    bool is_within; /**< all terms were that small: else nothing holds */
    bool is_all;    /**< nothing is left */
} cut_sums;

/** The number that, added to a smaller one, makes a double of which the last bit stands for 2^place. The bits of such
 *  doubles, as integers, can be added: of the upper cut, 2^10 of them stay below 2^61 after the multiples of this
 *  number are taken off. */
static double cutter(int place) { return ldexp(1.5, place + 52); }

HS_WIDE static cut_sums cut(const double *x, int n, int place)
{
    const double first = cutter(place), second = cutter(place - 51);
    /* of terms that are too large the sums mean nothing, but they must be let wrap around */
    stream_sums high = {0}, low = {0}, beyond = {0}, rest = {0};
    uint64_t first_bits, second_bits, rest_bits = 0, beyond_bits = 0, high_sum = 0, low_sum = 0;
    memcpy(&first_bits, &first, sizeof first);
    memcpy(&second_bits, &second, sizeof second);
    for (int i = 0; i < n; i += STREAMS) {
        streams term = {0.0};
        if (i + STREAMS <= n)
            memcpy(&term, x + i, sizeof term);
        else
            memcpy(&term, x + i, (size_t)(n - i) * sizeof *x);
        const streams a = term + first, b = term - (a - first), c = b + second;
        high += (stream_sums)a - first_bits;
        low += (stream_sums)c - second_bits;
        beyond |= (stream_sums)a ^ first_bits;
        rest |= (stream_sums)(b - (c - second));
    }
    for (int k = 0; k < STREAMS; ++k) {
        high_sum += high[k];
        low_sum += low[k];
        beyond_bits |= beyond[k];
        rest_bits |= rest[k];
    }
    return (cut_sums){.high = (int64_t)high_sum,
                      .low = (int64_t)low_sum,
                      .is_within = beyond_bits >> 52 == 0,     /* no exponent is another one */
                      .is_all = (rest_bits & INT64_MAX) == 0}; /* +0 or -0 */
}

/** What lies beyond the second cut. */
static void add_rest(hs_exact_sum *sum, const double *x, int n, int place)
{
    const double first = cutter(place), second = cutter(place - 51);
    for (int i = 0; i < n; ++i) {
        const double a = (x[i] + first) - first, b = x[i] - a, c = (b + second) - second;
        if (b - c != 0.0) hs_exact_add_now(sum, b - c);
    }
}

/** The largest size of the terms; *none is 0, or not a number when a term is not finite. */
HS_WIDE static double find_bound(const double *x, int n, double *none)
{
    streams largest = {0.0}, odd = {0.0};
    double bound = 0.0;
    for (int i = 0; i < n; i += STREAMS) {
        streams term = {0.0};
        if (i + STREAMS <= n)
            memcpy(&term, x + i, sizeof term);
        else
            memcpy(&term, x + i, (size_t)(n - i) * sizeof *x);
        const streams size = SIZES(term);
        const stream_bits is_larger = size > largest;
        largest = (streams)(((stream_bits)size & is_larger) | ((stream_bits)largest & ~is_larger));
        odd += size - size; /* 0, or not a number */
    }
    *none = 0.0;
    for (int k = 0; k < STREAMS; ++k) {
        bound = largest[k] > bound ? largest[k] : bound;
        *none += odd[k];
    }
    return bound;
}

/** Where to cut terms of which the largest is `bound`: a factor of 8 above it is left, for the place serves the next
 *  array, too. */
static int place_of(double bound) { return ilogb(bound) + 4 - 51; }

void hs_exact_add_array(hs_exact_sum *sum, const double *x, int n)
{
    enum { FEW = 8 }; /* not worth the trouble */
    for (int i = 0; i < n && n <= FEW; ++i) hs_exact_add_now(sum, x[i]);
    if (n <= FEW) return;
    cut_sums sums = {0};
    if (n <= HS_EXACT_ARRAY_MAX) sums = cut(x, n, sum->place);
    if (!sums.is_within || !sums.is_all) {
        double none;
        const double bound = find_bound(x, n, &none);
        const bool is_plain = n <= HS_EXACT_ARRAY_MAX && none == 0.0;
        if (bound == 0.0 && is_plain) return;
        if (!is_plain || bound < 0x1p-800 || bound > 0x1p800) {
            for (int i = 0; i < n; ++i) hs_exact_add_now(sum, x[i]);
            return;
        }
        if (sum->place != place_of(bound)) {
            sum->place = place_of(bound);
            sums = cut(x, n, sum->place);
        }
    }
    hs_exact_add_scaled(sum, sums.high, sum->place);
    hs_exact_add_scaled(sum, sums.low, sum->place - 51);
    if (!sums.is_all) add_rest(sum, x, n, sum->place);
}

void hs_exact_merge(hs_exact_sum *sum, const hs_exact_sum *other)
{
    hs_exact_carry(sum);
    hs_exact_sum added = *other;
    hs_exact_carry(&added);
    for (int k = 0; k < HS_EXACT_DIGITS; ++k) sum->digit[k] += added.digit[k];
    sum->not_finite += other->not_finite;
    hs_exact_carry(sum);
}

/** The value of a sum without terms that wait. */
static double value_of(const hs_exact_sum *sum)
{
    if (sum->not_finite != 0.0) return sum->not_finite; /* also when it is not a number */
    int low = 0, top = HS_EXACT_DIGITS - 1;
    while (low < top && sum->digit[low] == 0) ++low;
    while (top > low && sum->digit[top] == 0) --top;
    /* Carries from the lowest digit that is set to the highest, and what goes beyond as two digits more. Terms of similar size
       set few of them. */
    int64_t digit[HS_EXACT_DIGITS + 2], carry = 0;
    const int n = top - low + 1;
    for (int k = 0; k < n + 2; ++k) {
        const int64_t all = (k < n ? sum->digit[low + k] : 0) + carry;
        carry = all >> 32; /* rounds down, so that what stays is not negative */
        digit[k] = all - carry * (INT64_C(1) << 32);
    }
    const bool is_negative = carry < 0;
    if (is_negative) { /* the size is the complement, and one */
        carry = 1;
        for (int k = 0; k < n + 2; ++k) {
            const int64_t all = (digit[k] ^ UINT32_MAX) + carry;
            carry = all >> 32;
            digit[k] = all & UINT32_MAX;
        }
    }
    top = n + 1;
    while (top > 0 && digit[top] == 0) --top;
    /* The highest three digits hold at least 65 bits from the first that is set: enough to round by, if the last of them tells whether
       anything follows. */
    unsigned __int128 leading = 0;
    for (int k = 0; k < 3; ++k) leading = leading << 32 | (uint64_t)(top - k >= 0 ? digit[top - k] : 0);
    bool has_more = false;
    for (int k = top - 3; k >= 0; --k) has_more = has_more || digit[k] != 0;
    leading |= has_more;
    const double value = ldexp((double)leading, 32 * (low + top - 2) + HS_EXACT_LOWEST);
    return is_negative ? -value : value;
}

double hs_exact_value(const hs_exact_sum *sum)
{
    if (sum->n_waiting == 0) return value_of(sum);
    hs_exact_sum settled = *sum;
    hs_exact_settle(&settled);
    return value_of(&settled);
}

void hs_exact_total(hs_exact_sum *sums, int n, const hs_parallel *parallel, double *values)
{
    for (int k = 0; k < n; ++k) {
        hs_exact_settle(&sums[k]);
        if (parallel->n_ranks > 1) {
            hs_exact_pass_carries(&sums[k]);
            hs_parallel_sum_int64(parallel, sums[k].digit, HS_EXACT_DIGITS);
            hs_parallel_sum_double(parallel, &sums[k].not_finite, 1);
        }
        values[k] = value_of(&sums[k]);
    }
}
