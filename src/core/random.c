#include "core/random.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

enum { MULTIPLIER = 16807, MODULUS = 2147483647, SCHRAGE_Q = 127773, SCHRAGE_R = 2836 };

void hs_park_init(hs_park *park, int seed)
{
    park->seed = seed;
    park->have_second = false;
    park->second = 0.0;
}

double hs_park_uniform(hs_park *park)
{
    int k = park->seed / SCHRAGE_Q;
    park->seed = MULTIPLIER * (park->seed - k * SCHRAGE_Q) - SCHRAGE_R * k;
    if (park->seed < 0) park->seed += MODULUS;
    /* LAMMPS multiplies by the rounded reciprocal; dividing would differ in the last bit. */
    return (1.0 / MODULUS) * park->seed;
}

double hs_park_gaussian(hs_park *park)
{
    if (park->have_second) {
        park->have_second = false;
        return park->second;
    }
    double v1, v2, r2;
    do {
        v1 = 2.0 * hs_park_uniform(park) - 1.0;
        v2 = 2.0 * hs_park_uniform(park) - 1.0;
        r2 = v1 * v1 + v2 * v2;
    } while (r2 >= 1.0 || r2 == 0.0);
    double scale = sqrt(-2.0 * log(r2) / r2);
    park->second = v1 * scale;
    park->have_second = true;
    return v2 * scale;
}

void hs_park_reset_at(hs_park *park, int seed, const double x[3])
{
    /* Jenkins's one-at-a-time hash over the bytes of seed and place, with signed bytes as LAMMPS has them. */
    signed char bytes[sizeof(int) + 3 * sizeof(double)];
    memcpy(bytes, &seed, sizeof seed);
    memcpy(bytes + sizeof seed, x, 3 * sizeof(double));
    uint32_t hash = 0;
    for (size_t i = 0; i < sizeof bytes; ++i) {
        hash += (uint32_t)(int32_t)bytes[i];
        hash += hash << 10;
        hash ^= hash >> 6;
    }
    hash += hash << 3;
    hash ^= hash >> 11;
    hash += hash << 15;
    hs_park_init(park, (int)(hash & 0x7ffffff));
    if (park->seed == 0) park->seed = 1;
    for (int i = 0; i < 5; ++i) (void)hs_park_uniform(park);
}
