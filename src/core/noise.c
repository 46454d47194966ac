#include "core/noise.h"

#include <Random123/philox.h>

#include "core/noise_formulas.h"

hs_noise hs_noise_open(int64_t seed, const char *name)
{
    uint32_t hash = 2166136261u;
    for (const char *c = name; *c != '\0'; ++c) hash = (hash ^ (unsigned char)*c) * 16777619u;
    return (hs_noise){.seed = (uint32_t)seed, .stream = hash ^ (uint32_t)((uint64_t)seed >> 32)};
}

void hs_noise_words(hs_noise noise, int64_t step, int draw, int64_t id, uint32_t word[HS_NOISE_NUMBERS])
{
    const philox4x32_ctr_t counter = {
        {(uint32_t)id, (uint32_t)((uint64_t)id >> 32), (uint32_t)step, hs_noise_step_high(step, draw)}};
    const philox4x32_key_t key = {{noise.seed, noise.stream}};
    const philox4x32_ctr_t bits = philox4x32(counter, key);
    for (int k = 0; k < HS_NOISE_NUMBERS; ++k) word[k] = bits.v[k];
}

void hs_noise_numbers(hs_noise noise, hs_noise_kind kind, int64_t step, int draw, int64_t id,
                      double number[HS_NOISE_NUMBERS])
{
    uint32_t word[HS_NOISE_NUMBERS];
    hs_noise_words(noise, step, draw, id, word);
    if (kind == HS_NOISE_UNIFORM) {
        for (int k = 0; k < HS_NOISE_NUMBERS; ++k) number[k] = hs_noise_uniform(word[k]);
    } else {
        hs_noise_gaussians(word[0], word[1], &number[0], &number[1]);
        hs_noise_gaussians(word[2], word[3], &number[2], &number[3]);
    }
}
