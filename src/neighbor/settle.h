/** The pass over all positions of a step; compiled for every instruction set, like the kernels. */
#ifndef HS_NEIGHBOR_SETTLE_H
#define HS_NEIGHBOR_SETTLE_H

#include <stdbool.h>
#include <stdint.h>

/** What to look at. */
typedef struct hs_settle_input {
    double *x[3];            /**< positions, distance */
    const double *listed[3]; /**< those of the last scheduled list build */
    double magic;            /**< rounds positions to their grid, see hs_env; 0: they stay */
    bool is_flat;            /**< all z were 0 at that build: listed[2] is not read */
    bool is_planar;          /**< and are now: x[2] is not read */
} hs_settle_input;

/** Bits of the largest of numbers that are not negative, and of infinity or nan if there is one: unsigned integers order such doubles,
 *  with nan above all. */
typedef struct hs_settle_result {
    uint64_t displacement2; /**< squared distance from the listed position */
    uint64_t z;             /**< |z|; only when is_flat; 0 when is_planar */
} hs_settle_result;

/** Round the positions of atoms begin .. end - 1 and bring *result up to date with them. */
typedef void (*hs_settle)(const hs_settle_input *in, int begin, int end, hs_settle_result *result);
extern const hs_settle hs_settle_portable, hs_settle_sse2, hs_settle_avx2, hs_settle_avx512;

#endif
