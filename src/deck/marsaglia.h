/** Random numbers of the formula functions random() and normal(): the universal generator RANMAR, so that formulas
 *  draw the numbers that LAMMPS's formulas draw. Source: G. Marsaglia, A. Zaman, W. W. Tsang, Stat. Prob. Lett. 9,
 *  35 (1990), doi:10.1016/0167-7152(90)90092-L; seeding by one number as in F. James, Comput. Phys. Commun. 60, 329
 *  (1990), doi:10.1016/0010-4655(90)90032-V. */
#ifndef HS_DECK_MARSAGLIA_H
#define HS_DECK_MARSAGLIA_H

#include <stdbool.h>
#include <stdint.h>

enum { HS_MARSAGLIA_SEED_MAX = 900000000 };

typedef struct hs_marsaglia {
    double u[97]; /**< lagged Fibonacci state */
    double c;     /**< arithmetic sequence */
    int i, j;     /**< the two lags' places in u */
    bool is_seeded;
    bool have_second; /**< the polar method's second number waits */
    double second;
} hs_marsaglia;

/** Seed it: 1 .. HS_MARSAGLIA_SEED_MAX. */
void hs_marsaglia_init(hs_marsaglia *generator, int seed);
/** Uniform in [0, 1). */
double hs_marsaglia_uniform(hs_marsaglia *generator);
/** Normal, mean 0, variance 1. */
double hs_marsaglia_gaussian(hs_marsaglia *generator);

/** Uniform number in (0, 1) that belongs to a seed, an atom and a draw: the same on any rank and in any order of
 *  atoms. */
double hs_hashed_uniform(uint64_t seed, uint64_t atom, uint64_t draw, uint64_t stream);

#endif
