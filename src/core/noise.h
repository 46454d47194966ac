/** Random numbers that are pure functions of (seed, stream, step, atom id): counter-based noise.
 *
 *  The numbers of an atom at a step do not depend on who asks, in which order, on which thread or rank, so that
 *  stochastic runs are as reproducible as deterministic ones and a restart needs no generator's state. The bits are
 *  those of Philox 4x32-10 as the library Random123 makes them: key = (seed, stream), counter = (id, step, draw).
 *  Source: J. K. Salmon et al., Proc. SC'11, 16 (2011), doi:10.1145/2063384.2063405. */
#ifndef HS_CORE_NOISE_H
#define HS_CORE_NOISE_H

#include <stdint.h>

/** One stream of noise. */
typedef struct hs_noise {
    uint32_t seed, stream;
} hs_noise;

/** Distribution of the numbers; all have mean 0 and variance 1. */
typedef enum {
    HS_NOISE_UNIFORM, /**< evenly between -sqrt(3) and sqrt(3) */
    HS_NOISE_GAUSSIAN /**< normal; from 32-bit words, so at most 6.8 standard deviations away */
} hs_noise_kind;

/** What no number of that kind exceeds, either way. */
static inline double hs_noise_largest(hs_noise_kind kind)
{
    return kind == HS_NOISE_UNIFORM ? 1.7320508075688773 : 6.8;
}

enum {
    HS_NOISE_NUMBERS = 4, /**< numbers of one draw */
    HS_NOISE_DRAWS = 256  /**< draws that an atom has at one step */
};

/** Stream of that name under a seed: different names give independent numbers (names are hashed to 32 bits, FNV-1a). */
hs_noise hs_noise_open(int64_t seed, const char *name);

/** The four 32-bit words of a draw. @p step is below 2^56, @p draw below HS_NOISE_DRAWS. */
void hs_noise_words(hs_noise noise, int64_t step, int draw, int64_t id, uint32_t word[HS_NOISE_NUMBERS]);

/** The four numbers of a draw for one atom; for many atoms kernel/noise_fill.h gives the same bits faster. */
void hs_noise_numbers(hs_noise noise, hs_noise_kind kind, int64_t step, int draw, int64_t id,
                      double number[HS_NOISE_NUMBERS]);

/** Counter of a draw: the two words of the id, the two of the step with the draw in the highest byte. */
static inline uint32_t hs_noise_step_high(int64_t step, int draw)
{
    return (uint32_t)((uint64_t)step >> 32) | (uint32_t)draw << 24;
}

#endif
