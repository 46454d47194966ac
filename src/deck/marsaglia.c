#include "deck/marsaglia.h"

#include <math.h>

static const double c_step = 7654321.0 / 16777216.0, c_modulus = 16777213.0 / 16777216.0;

void hs_marsaglia_init(hs_marsaglia *generator, int seed)
{
    const int ij = (seed - 1) / 30082, kl = (seed - 1) - 30082 * ij;
    int i = (ij / 177) % 177 + 2, j = ij % 177 + 2, k = (kl / 169) % 178 + 1, l = kl % 169;
    for (int n = 0; n < 97; ++n) {
        double value = 0.0, bit = 0.5;
        for (int b = 0; b < 24; ++b, bit *= 0.5) {
            const int m = (i * j) % 179 * k % 179;
            i = j, j = k, k = m;
            l = (53 * l + 1) % 169;
            if (l * m % 64 >= 32) value += bit;
        }
        generator->u[n] = value;
    }
    generator->c = 362436.0 / 16777216.0;
    generator->i = 96;
    generator->j = 32;
    generator->is_seeded = true;
    generator->have_second = false;
    generator->second = 0.0;
    (void)hs_marsaglia_uniform(generator);
}

double hs_marsaglia_uniform(hs_marsaglia *generator)
{
    double value = generator->u[generator->i] - generator->u[generator->j];
    if (value < 0.0) value += 1.0;
    generator->u[generator->i] = value;
    generator->i = generator->i > 0 ? generator->i - 1 : 96;
    generator->j = generator->j > 0 ? generator->j - 1 : 96;
    generator->c -= c_step;
    if (generator->c < 0.0) generator->c += c_modulus;
    value -= generator->c;
    return value < 0.0 ? value + 1.0 : value;
}

double hs_marsaglia_gaussian(hs_marsaglia *generator)
{
    if (generator->have_second) {
        generator->have_second = false;
        return generator->second;
    }
    double v1, v2, r2;
    do {
        v1 = 2.0 * hs_marsaglia_uniform(generator) - 1.0;
        v2 = 2.0 * hs_marsaglia_uniform(generator) - 1.0;
        r2 = v1 * v1 + v2 * v2;
    } while (r2 >= 1.0 || r2 == 0.0);
    const double scale = sqrt(-2.0 * log(r2) / r2);
    generator->second = v1 * scale;
    generator->have_second = true;
    return v2 * scale;
}

/** Mixing step of SplitMix64: G. L. Steele, D. Lea, C. H. Flood, OOPSLA 2014, doi:10.1145/2660193.2660195. */
static uint64_t mix(uint64_t z)
{
    z += UINT64_C(0x9e3779b97f4a7c15);
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return z ^ (z >> 31);
}

double hs_hashed_uniform(uint64_t seed, uint64_t atom, uint64_t draw, uint64_t stream)
{
    const uint64_t bits = mix(mix(mix(mix(seed) ^ atom) ^ draw) ^ stream);
    return ((double)(bits >> 12) + 0.5) * 0x1p-52;
}
