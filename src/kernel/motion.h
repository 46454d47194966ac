/** Loops over atoms that overdamped motion and fixed-point forces need at every step, compiled for every instruction set. All sets give
 *  the same bits. */
#ifndef HS_KERNEL_MOTION_H
#define HS_KERNEL_MOTION_H

#include "kernel/kernel.h"

/** How forces and noise move atoms along one axis. */
typedef struct hs_overdamped {
    double drift; /**< velocity of a unit force */
    double kick;  /**< velocity of a unit of noise */
    double dt;    /**< time */
    double magic; /**< rounds displacements to the position grid: hs_env.position_magic */
} hs_overdamped;

/** v = drift f + kick noise, x += dt v for n atoms; with @p group only for those that have a bit of @p mask, without (NULL) for all. */
typedef void (*hs_motion_translate)(const hs_overdamped *motion, int n, const uint32_t *group, uint32_t mask,
                                    const double *f, const double *noise, double *x, double *v);
/** By how much vectors turn. */
typedef struct hs_turning {
    double turn;   /**< radians of a unit of noise; all angles are below 2^30 */
    bool is_small; /**< all are at most HS_SMALL_ANGLE (core/noise_formulas.h) */
} hs_turning;

/** Turn the vectors (x, y) of n atoms by turn * noise[n]; which atoms: as above. */
typedef void (*hs_motion_rotate)(const hs_turning *turning, int n, const uint32_t *group, uint32_t mask,
                                 const double *noise, double *x, double *y);
/** n 64-bit integers in the memory of doubles, @p from, become multiples of @p unit, a power of two: f, which may be the same. */
typedef void (*hs_motion_settle)(double *f, const double *from, int64_t n, double unit);

typedef struct hs_motion_set {
    hs_motion_translate translate;
    hs_motion_rotate rotate;
    hs_motion_settle settle;
} hs_motion_set;
extern const hs_motion_set hs_motion_set_portable, hs_motion_set_sse2, hs_motion_set_avx2, hs_motion_set_avx512;
const hs_motion_set *hs_isa_motion(hs_isa isa);

#endif
