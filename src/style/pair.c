#include "style/pair.h"

#include <math.h>

double hs_pair_mix_energy(hs_mix_rule rule, double eps_i, double eps_j, double sigma_i, double sigma_j)
{
    if (rule != HS_MIX_SIXTHPOWER) return sqrt(eps_i * eps_j);
    return 2.0 * sqrt(eps_i * eps_j) * pow(sigma_i, 3.0) * pow(sigma_j, 3.0) / (pow(sigma_i, 6.0) + pow(sigma_j, 6.0));
}

double hs_pair_mix_distance(hs_mix_rule rule, double sigma_i, double sigma_j)
{
    switch (rule) {
    case HS_MIX_ARITHMETIC:
        return 0.5 * (sigma_i + sigma_j);
    case HS_MIX_SIXTHPOWER:
        return pow(0.5 * (pow(sigma_i, 6.0) + pow(sigma_j, 6.0)), 1.0 / 6.0);
    default:
        return sqrt(sigma_i * sigma_j);
    }
}
