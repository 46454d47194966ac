/** How kernels add up: in floating point, or (HS_FIXED) in fixed point, whose sums do not depend on the order of the terms.
 *
 *  Fixed point: a term is rounded to a multiple of a power of two, 2^e, by adding magic = 1.5 * 2^52 * 2^e, which leaves the
 *  multiple in the low bits of the double's pattern. Patterns are added as 64-bit integers; the known number of magics is
 *  taken off at the end. Additions wrap around (unsigned), so only the final sums have to fit. Terms must be smaller than
 *  2^51 * 2^e: kernels report the largest force and energy they met, and the caller starts again with a coarser grid when one
 *  was too large. Rounding is symmetric (ties to even), so the terms of (i, j) and (j, i) are exact opposites.
 *
 *  Included by the kernel loops after kernel/simd.h. */
#ifndef HS_KERNEL_ACCUMULATE_H
#define HS_KERNEL_ACCUMULATE_H

#include "kernel/kernel.h"
#include "kernel/simd.h"

#define HS_INLINE static inline __attribute__((always_inline))

#ifdef HS_FIXED

/** As many 64-bit integers as a vector has lanes: patterns of rounded terms, or their sums. */
typedef uint64_t hs_acc __attribute__((vector_size(8 * HS_LANES)));
_Static_assert(sizeof(hs_vec) == sizeof(hs_acc), "fixed point needs kernels in double precision");

/** The magic of a sum, kept by the loop: values in memory would have to be read again after every store. */
typedef struct hs_magic {
    hs_vec value;
    uint64_t bits;
} hs_magic;
HS_INLINE hs_magic hs_magic_of(double value)
{
    hs_magic magic = {.value = hs_set1(value)};
    memcpy(&magic.bits, &value, sizeof value);
    return magic;
}

HS_INLINE hs_acc hs_acc_zero(void) { return (hs_acc){0}; }
HS_INLINE hs_acc hs_acc_bits(hs_vec a)
{
    hs_acc bits;
    memcpy(&bits, &a, sizeof bits);
    return bits;
}
/** The term a * b of a sum. */
HS_INLINE hs_acc hs_acc_term(hs_vec a, hs_vec b, hs_magic magic) { return hs_acc_bits(hs_fma(a, b, magic.value)); }
/** sum += a * b. */
HS_INLINE void hs_acc_add_product(hs_acc *sum, hs_vec a, hs_vec b, hs_magic magic) { *sum += hs_acc_term(a, b, magic); }
HS_INLINE void hs_acc_add(hs_acc *sum, hs_vec a, hs_magic magic) { *sum += hs_acc_bits(a + magic.value); }
/** Take the magics of n terms off. */
HS_INLINE void hs_acc_settle(hs_acc *sum, int64_t n, hs_magic magic) { *sum -= (uint64_t)n * magic.bits; }
HS_INLINE void hs_acc_note_peak(hs_vec *peak, hs_vec a) { *peak = hs_max_abs(*peak, a); }

HS_INLINE uint64_t hs_acc_lanes(hs_acc sum)
{
    uint64_t all = 0;
    for (int k = 0; k < HS_LANES; ++k) all += sum[k];
    return all;
}
/** f[i] -= the sum over lanes; f holds integers. */
HS_INLINE void hs_acc_subtract_from(double *f, int i, hs_acc sum)
{
    uint64_t value;
    memcpy(&value, f + i, sizeof value);
    value -= hs_acc_lanes(sum);
    memcpy(f + i, &value, sizeof value);
}
/** As many integers as lie together in memory: the lanes of a vector that belong to one cluster. */
enum { HS_PART_LANES = HS_LANES < HS_CLUSTER ? HS_LANES : HS_CLUSTER };
typedef uint64_t hs_acc_part __attribute__((vector_size(8 * HS_PART_LANES)));

HS_INLINE void hs_acc_add_part(double *f, hs_acc_part added)
{
    hs_acc_part value;
    memcpy(&value, f, sizeof value);
    value += added;
    memcpy(f, &value, sizeof value);
}
/** f of the j-atoms of this vector += sum. */
HS_INLINE void hs_acc_add_clusters(double *f, const hs_cluster_entry *entry, int sub, hs_acc sum)
{
#if HS_LANES == 8
    (void)sub;
    hs_acc_add_part(f + entry[0].first, __builtin_shufflevector(sum, sum, 0, 1, 2, 3));
    hs_acc_add_part(f + entry[1].first, __builtin_shufflevector(sum, sum, 4, 5, 6, 7));
#else
    hs_acc_add_part(f + entry->first + HS_LANES * sub, sum);
#endif
}
HS_INLINE void hs_acc_scatter_add(double *f, const int32_t *j, hs_acc sum)
{
    for (int k = 0; k < HS_LANES; ++k) {
        uint64_t value;
        memcpy(&value, f + j[k], sizeof value);
        value += sum[k];
        memcpy(f + j[k], &value, sizeof value);
    }
}
HS_INLINE void hs_acc_scatter_subtract(double *f, const int32_t *j, hs_acc sum)
{
    for (int k = 0; k < HS_LANES; ++k) {
        uint64_t value;
        memcpy(&value, f + j[k], sizeof value);
        value -= sum[k];
        memcpy(f + j[k], &value, sizeof value);
    }
}
/** Energy and virial of one call, in the wide integers of the result. */
HS_INLINE void hs_acc_report(hs_kernel_output *out, hs_acc energy, const hs_acc virial[6])
{
    out->energy_fixed += (int64_t)hs_acc_lanes(energy);
    for (int k = 0; k < 6; ++k) out->virial_fixed[k] += (int64_t)hs_acc_lanes(virial[k]);
}
HS_INLINE void hs_acc_report_peak(double *largest, hs_vec peak)
{
    double lane[HS_LANES];
    memcpy(lane, &peak, sizeof lane);
    for (int k = 0; k < HS_LANES; ++k) *largest = lane[k] > *largest ? lane[k] : *largest;
}

#else

typedef hs_vec hs_acc;
typedef struct hs_magic {
    char unused;
} hs_magic;
HS_INLINE hs_magic hs_magic_of(double value)
{
    (void)value;
    return (hs_magic){0};
}
HS_INLINE hs_acc hs_acc_zero(void) { return hs_set1(0.0); }
HS_INLINE hs_acc hs_acc_term(hs_vec a, hs_vec b, hs_magic magic)
{
    (void)magic;
    return a * b;
}
HS_INLINE void hs_acc_add_product(hs_acc *sum, hs_vec a, hs_vec b, hs_magic magic)
{
    (void)magic;
    *sum = hs_fma(a, b, *sum);
}
HS_INLINE void hs_acc_add(hs_acc *sum, hs_vec a, hs_magic magic)
{
    (void)magic;
    *sum += a;
}
HS_INLINE void hs_acc_settle(hs_acc *sum, int64_t n, hs_magic magic) { (void)sum, (void)n, (void)magic; }
HS_INLINE void hs_acc_note_peak(hs_vec *peak, hs_vec a) { (void)peak, (void)a; }
HS_INLINE void hs_acc_subtract_from(double *f, int i, hs_acc sum) { f[i] -= hs_sum(sum); }
HS_INLINE void hs_acc_add_clusters(double *f, const hs_cluster_entry *entry, int sub, hs_acc sum)
{
    hs_add_clusters(f, entry, sub, sum);
}
HS_INLINE void hs_acc_scatter_add(double *f, const int32_t *j, hs_acc sum) { hs_scatter_add(f, j, sum); }
HS_INLINE void hs_acc_scatter_subtract(double *f, const int32_t *j, hs_acc sum) { hs_scatter_subtract(f, j, sum); }
/** Energy and virial of one call. */
HS_INLINE void hs_acc_report(hs_kernel_output *out, hs_acc energy, const hs_acc virial[6])
{
    out->energy += hs_sum(energy);
    for (int k = 0; k < 6; ++k) out->virial[k] += hs_sum(virial[k]);
}
HS_INLINE void hs_acc_report_peak(double *largest, hs_vec peak) { (void)largest, (void)peak; }

#endif

/** One number for each of the four i-atoms, and their type. */
#ifdef HS_FIXED
typedef uint64_t hs_acc_real;
#else
typedef hs_real hs_acc_real;
#endif
typedef hs_acc_real hs_rows_acc __attribute__((vector_size(HS_CLUSTER * sizeof(hs_acc_real))));
typedef hs_acc_real hs_two_rows __attribute__((vector_size(2 * HS_CLUSTER * sizeof(hs_acc_real))));

/** The four numbers at f -= the sums over the lanes of sum[row]. With wide vectors by folding rows together, in a third of the
 *  instructions of four sums: first halves and then quarters of rows are added, until one vector has a few numbers of each row,
 *  one row after the other. */
HS_INLINE void hs_acc_subtract_rows(void *f, const hs_acc sum[HS_CLUSTER])
{
#if HS_LANES >= 4
    hs_rows_acc value;
    memcpy(&value, f, sizeof value);
#if HS_LANES == 16
#define LOW(a, b)  __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7, 16, 17, 18, 19, 20, 21, 22, 23)
#define HIGH(a, b) __builtin_shufflevector(a, b, 8, 9, 10, 11, 12, 13, 14, 15, 24, 25, 26, 27, 28, 29, 30, 31)
    const hs_acc first = LOW(sum[0], sum[1]) + HIGH(sum[0], sum[1]), last = LOW(sum[2], sum[3]) + HIGH(sum[2], sum[3]);
#undef LOW
#undef HIGH
#define EVEN(a, b) __builtin_shufflevector(a, b, 0, 1, 2, 3, 8, 9, 10, 11, 16, 17, 18, 19, 24, 25, 26, 27)
#define ODD(a, b)  __builtin_shufflevector(a, b, 4, 5, 6, 7, 12, 13, 14, 15, 20, 21, 22, 23, 28, 29, 30, 31)
    const hs_acc four = EVEN(first, last) + ODD(first, last); /* four numbers of each row */
#undef EVEN
#undef ODD
    const hs_two_rows two = (hs_two_rows)__builtin_shufflevector(four, four, 0, 1, 4, 5, 8, 9, 12, 13) +
                            (hs_two_rows)__builtin_shufflevector(four, four, 2, 3, 6, 7, 10, 11, 14, 15);
#elif HS_LANES == 8
    const hs_acc first = __builtin_shufflevector(sum[0], sum[1], 0, 1, 2, 3, 8, 9, 10, 11) +
                         __builtin_shufflevector(sum[0], sum[1], 4, 5, 6, 7, 12, 13, 14, 15),
                 last = __builtin_shufflevector(sum[2], sum[3], 0, 1, 2, 3, 8, 9, 10, 11) +
                        __builtin_shufflevector(sum[2], sum[3], 4, 5, 6, 7, 12, 13, 14, 15);
    const hs_two_rows two = (hs_two_rows)__builtin_shufflevector(first, last, 0, 1, 4, 5, 8, 9, 12, 13) +
                            (hs_two_rows)__builtin_shufflevector(first, last, 2, 3, 6, 7, 10, 11, 14, 15);
#else
    const hs_acc first = __builtin_shufflevector(sum[0], sum[1], 0, 1, 4, 5) +
                         __builtin_shufflevector(sum[0], sum[1], 2, 3, 6, 7),
                 last = __builtin_shufflevector(sum[2], sum[3], 0, 1, 4, 5) +
                        __builtin_shufflevector(sum[2], sum[3], 2, 3, 6, 7);
#endif
#if HS_LANES == 4
    value -= (hs_rows_acc)(__builtin_shufflevector(first, last, 0, 2, 4, 6) +
                           __builtin_shufflevector(first, last, 1, 3, 5, 7));
#else
    value -= (hs_rows_acc)__builtin_shufflevector(two, two, 0, 2, 4, 6) +
             (hs_rows_acc)__builtin_shufflevector(two, two, 1, 3, 5, 7);
#endif
    memcpy(f, &value, sizeof value);
#else
    hs_acc_real total[HS_CLUSTER];
    memcpy(total, f, sizeof total);
    for (int k = 0; k < HS_CLUSTER; ++k) {
        hs_acc_real lane[HS_LANES], all = 0;
        memcpy(lane, &sum[k], sizeof lane);
        for (int l = 0; l < HS_LANES; ++l) all += lane[l];
        total[k] -= all;
    }
    memcpy(f, total, sizeof total);
#endif
}

#endif
