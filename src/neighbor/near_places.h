/** Search among atoms in the order of cells; compiled for every instruction set, like the kernels. */
#ifndef HS_NEIGHBOR_NEAR_PLACES_H
#define HS_NEIGHBOR_NEAR_PLACES_H

#include <stdint.h>

/** Elements of `near` beyond those found that may be written. */
enum { HS_NEAR_PAD = 8 };

/** Of the places begin to end - 1 those closer to @p at than the range: near[] holds them in order; returns how many they are. All
 *  instruction sets find the same. */
typedef int (*hs_near_find)(const double *const x[3], const double at[3], double range2, int begin, int end,
                            int32_t *near);

extern const hs_near_find hs_near_find_portable, hs_near_find_sse2, hs_near_find_avx2, hs_near_find_avx512;

#endif
