/** Noise for blocks of atoms, compiled for every instruction set: the same bits as core/noise.h, many at a time. */
#ifndef HS_KERNEL_NOISE_FILL_H
#define HS_KERNEL_NOISE_FILL_H

#include "core/noise.h"
#include "kernel/kernel.h"

/** Atoms of one block: its numbers stay in the first-level cache. */
enum { HS_NOISE_BLOCK = 256 };

/** Numbers of one draw for a block of atoms, by number, then by atom. */
typedef struct hs_noise_block {
    _Alignas(64) double number[HS_NOISE_NUMBERS][HS_NOISE_BLOCK];
} hs_noise_block;

/** Fill block->number[0 .. n_numbers - 1][0 .. n - 1] with the draw of the atoms id[n], n <= HS_NOISE_BLOCK. Up to HS_ATOMS_PAD
 *  elements of id beyond n are read (arrays of atoms have them); the rest of the block is scratch. */
typedef void (*hs_noise_fill)(hs_noise noise, hs_noise_kind kind, int64_t step, int draw, int n_numbers,
                              const int64_t *id, int n, hs_noise_block *block);
/** Sine and cosine of n angles (radians, below 2^30). */
typedef void (*hs_sincos_fill)(const double *restrict angle, int n, double *restrict sine, double *restrict cosine);

/** The functions for one instruction set. All give the same bits. */
typedef struct hs_noise_set {
    hs_noise_fill fill;
    hs_sincos_fill sincos;
} hs_noise_set;
extern const hs_noise_set hs_noise_set_portable, hs_noise_set_sse2, hs_noise_set_avx2, hs_noise_set_avx512;
const hs_noise_set *hs_isa_noise(hs_isa isa);

#endif
