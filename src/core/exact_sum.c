#include "core/exact_sum.h"

#include <math.h>

void hs_exact_carry(hs_exact_sum *sum)
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
    if (sum->n_added >= INT64_C(1) << 30) hs_exact_carry(sum);
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

double hs_exact_value(const hs_exact_sum *sum)
{
    if (sum->not_finite != 0.0) return sum->not_finite; /* also when it is not a number */
    hs_exact_sum size = *sum;
    hs_exact_carry(&size);
    const bool is_negative = size.digit[HS_EXACT_DIGITS - 1] < 0;
    if (is_negative) {
        for (int k = 0; k < HS_EXACT_DIGITS; ++k) size.digit[k] = -size.digit[k];
        hs_exact_carry(&size);
    }
    int top = HS_EXACT_DIGITS - 1;
    while (top > 0 && size.digit[top] == 0) --top;
    /* The highest three digits hold at least 65 bits from the first that is set: enough to round by, if the last of them tells whether
       anything follows. */
    unsigned __int128 leading = 0;
    for (int k = 0; k < 3; ++k) leading = leading << 32 | (uint64_t)(top - k >= 0 ? size.digit[top - k] : 0);
    bool has_more = false;
    for (int k = top - 3; k >= 0; --k) has_more = has_more || size.digit[k] != 0;
    leading |= has_more;
    const double value = ldexp((double)leading, 32 * (top - 2) + HS_EXACT_LOWEST);
    return is_negative ? -value : value;
}

void hs_exact_total(hs_exact_sum *sums, int n, const hs_parallel *parallel, double *values)
{
    for (int k = 0; k < n; ++k) {
        hs_exact_carry(&sums[k]);
        if (parallel->n_ranks > 1) {
            hs_parallel_sum_int64(parallel, sums[k].digit, HS_EXACT_DIGITS);
            hs_parallel_sum_double(parallel, &sums[k].not_finite, 1);
        }
        values[k] = hs_exact_value(&sums[k]);
    }
}
