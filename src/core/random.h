/** Random numbers that agree with LAMMPS's: the Park-Miller minimal standard generator.
 *  Source: S. K. Park, K. W. Miller, Comm. ACM 31, 1192 (1988), doi:10.1145/63039.63042. */
#ifndef HS_CORE_RANDOM_H
#define HS_CORE_RANDOM_H

#include <stdbool.h>

typedef struct hs_park {
    int seed;         /**< 1 .. 2^31 - 2 */
    bool have_second; /**< the polar method's second number waits */
    double second;
} hs_park;

void hs_park_init(hs_park *park, int seed);
/** Uniform in (0, 1). */
double hs_park_uniform(hs_park *park);
/** Normal, mean 0, variance 1 (polar method of Marsaglia). */
double hs_park_gaussian(hs_park *park);
/** Reseed from a seed and an atom's place: the same place gives the same numbers on any machine and decomposition. */
void hs_park_reset_at(hs_park *park, int seed, const double x[3]);

#endif
