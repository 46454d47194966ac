/** The SIMD contract: what a pair kernel may ask of an instruction set.
 *
 *  A kernel handles rows of one i-atom against a vector of j-atoms that comes from one or more clusters of four. Every
 *  instruction set defines, in kernel/simd_NAME.h (double) and kernel/simd_NAME_mixed.h (float pairs, double sums), for its
 *  vector of HS_LANES reals:
 *
 *      hs_real                            double or float
 *      hs_vec, hs_msk                     a vector and a mask of its lanes (+ - * / work on vectors)
 *      HS_LANES                           lanes of a vector
 *      hs_set1(a)                         a in all lanes
 *      hs_fma(a, b, c)                    a * b + c, fused where the machine can
 *      hs_sqrt(a)
 *      hs_masks_of(entry, sub)            the masks of all rows of this vector, of type hs_masks
 *      hs_masks_row(masks, row)           and the mask of one row (i-atom)
 *      hs_mask_to_bits(m)                 bits of a mask, lane 0 lowest
 *      hs_mask_and(m, n)
 *      hs_less(a, b)                      mask of a < b
 *      hs_keep(m, a)                      a where m is set, else 0 (also where a is not a number)
 *      hs_select(m, a, b)                 a where m is set, else b
 *      hs_sum(a)                          sum of the lanes
 *      hs_max_abs(a, b)                   in each lane the larger of a and |b| (double only)
 *      hs_local(x, origin)                a coordinate as kernels use it: x itself in double; in float x - origin, rounded
 *                                         after the subtraction, so that large boxes lose no digits
 *      hs_load_clusters(x, origin, entry, sub)  hs_local of the j-atoms of this vector
 *      hs_add_clusters(f, entry, sub, a)  f of the j-atoms += a
 *      hs_lookup(table, type, stride, entry, sub)   table[stride * type of the j-atom]
 *
 *  and, defined below for all of them, for j-atoms that are listed one by one:
 *
 *      hs_gather(x, origin, j, by_machine)   hs_local of x[j[0]], x[j[1]], ...; with the machine's own instruction if that is wanted and
 *                                         there (HS_GATHERS is defined, with hs_machine_gather(x, j))
 *      hs_scatter_add(f, j, a)            f[j[0]] += lane 0 of a, ...; an atom that occurs twice gets both
 *      hs_scatter_subtract(f, j, a)       the same with -=
 *      hs_gather_between(x, i, j, by_machine)   x[j[0]] - x[i[0]], ..., rounded after the subtraction
 *      hs_first_lanes(n)                  mask of the lanes below n
 *      hs_to_indices(a, j)                j[k] = lane k of a without its fraction; lanes fit 32-bit integers
 *      hs_from_indices(j)                 and back
 *
 *  where vectors can be compressed (HS_COMPRESSES is defined):
 *
 *      hs_append(to, m, a)                the lanes of a in which m is set, one after the other at to, where there is room for all;
 *                                         their number is returned
 *      hs_append_indices(to, m, from)     the same of HS_LANES 32-bit integers
 *
 *  where 16 registers have to do for wide vectors, HS_ROWS_IN_TURN is defined: kernel/cluster_loop.h has one more form then.
 *
 *  in mixed precision, where packed clusters (kernel/packed.h) are read and written better than one axis after the other
 *  (HS_TAKES_PACKED is defined; kernel/cluster_memory.h has them for the others):
 *
 *      hs_places                          as many packed coordinates as a vector has lanes
 *      hs_load_packed(site, entry, sub, x)   the three of the j-atoms
 *      hs_add_packed(f, entry, sub, sum)  packed forces of the j-atoms += sum, for the three axes
 *
 *  and of general use:
 *
 *      hs_min(a, b), hs_max(a, b)         b where either is not a number
 *
 *  A vector covers HS_GROUP entries of a cluster list (vectors of 4 and more lanes), or HS_SUBS vectors cover one entry
 *  (narrower ones); `sub` numbers the latter. Everything is static inline, so that code for a wide instruction set cannot
 *  leak into objects of another. */
#ifndef HS_KERNEL_SIMD_H
#define HS_KERNEL_SIMD_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#include "neighbor/clusters.h"

#if defined(HS_SIMD_AVX512)
#ifdef HS_MIXED
#include "kernel/simd_avx512_mixed.h"
#else
#include "kernel/simd_avx512.h"
#endif
#elif defined(HS_SIMD_AVX2)
#ifdef HS_MIXED
#include "kernel/simd_avx2_mixed.h"
#else
#include "kernel/simd_avx2.h"
#endif
#elif defined(HS_SIMD_SSE2)
#ifdef HS_MIXED
#include "kernel/simd_sse2_mixed.h"
#else
#include "kernel/simd_sse2.h"
#endif
#elif defined(HS_MIXED)
#include "kernel/simd_portable_mixed.h"
#else
#include "kernel/simd_portable.h"
#endif

#define HS_GROUP (HS_LANES >= HS_CLUSTER ? HS_LANES / HS_CLUSTER : 1)
#define HS_SUBS  (HS_LANES >= HS_CLUSTER ? 1 : HS_CLUSTER / HS_LANES)

static inline hs_vec hs_min(hs_vec a, hs_vec b) { return hs_select(hs_less(a, b), a, b); }
static inline hs_vec hs_max(hs_vec a, hs_vec b) { return hs_select(hs_less(b, a), a, b); }

/* Compilers make loads and inserts of the loop. The machine's gather instructions measured slower on a Zen 4: 4.6 instead of 5.5 (AVX-512)
   and 6.3 (AVX2) million atom-steps/s; those of AVX-512 faster on an Intel processor, by a tenth of the steps of a WCA fluid, those of AVX2
   slower by a tenth there, too. So hs_isa_gathers_fast() asks for the vendor, and AVX2 has none. */
static inline hs_vec hs_gather(const double *x, double origin, const int32_t *j, bool by_machine)
{
#ifdef HS_GATHERS
    if (by_machine) return hs_machine_gather(x, j);
#endif
    (void)by_machine;
    hs_real lane[HS_LANES];
    hs_vec a;
    for (int k = 0; k < HS_LANES; ++k) lane[k] = hs_local(x[j[k]], origin);
    memcpy(&a, lane, sizeof a);
    return a;
}

static inline void hs_to_indices(hs_vec a, int32_t *j)
{
    hs_real lane[HS_LANES];
    memcpy(lane, &a, sizeof a);
    for (int k = 0; k < HS_LANES; ++k) j[k] = (int32_t)lane[k];
}

static inline hs_vec hs_from_indices(const int32_t *j)
{
    hs_real lane[HS_LANES];
    hs_vec a;
    for (int k = 0; k < HS_LANES; ++k) lane[k] = (hs_real)j[k];
    memcpy(&a, lane, sizeof a);
    return a;
}

static inline hs_vec hs_gather_between(const double *x, const int32_t *i, const int32_t *j, bool by_machine)
{
#ifdef HS_MIXED
    (void)by_machine;
    hs_real lane[HS_LANES];
    hs_vec a;
    for (int k = 0; k < HS_LANES; ++k) lane[k] = hs_local(x[j[k]], x[i[k]]);
    memcpy(&a, lane, sizeof a);
    return a;
#else
    return hs_gather(x, 0.0, j, by_machine) - hs_gather(x, 0.0, i, by_machine);
#endif
}

static inline void hs_scatter_add(double *f, const int32_t *j, hs_vec a)
{
    hs_real lane[HS_LANES];
    memcpy(lane, &a, sizeof a);
    for (int k = 0; k < HS_LANES; ++k) f[j[k]] += lane[k];
}

static inline void hs_scatter_subtract(double *f, const int32_t *j, hs_vec a)
{
    hs_real lane[HS_LANES];
    memcpy(lane, &a, sizeof a);
    for (int k = 0; k < HS_LANES; ++k) f[j[k]] -= lane[k];
}

static inline hs_msk hs_first_lanes(int n)
{
    static const hs_real number[16] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
    hs_vec a;
    memcpy(&a, number, sizeof a);
    return hs_less(a, hs_set1(n));
}

#endif
