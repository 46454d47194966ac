/** Coefficients that the styles of the Lennard-Jones family share: epsilon and sigma, and a cutoff. */
#ifndef HS_PAIR_LJ_COEFFS_H
#define HS_PAIR_LJ_COEFFS_H

#include <math.h>

#include "style/pair_coeffs.h"

/** Indices into hs_pair_coeff.c: energy, distance. */
enum { HS_LJ_EPSILON, HS_LJ_SIGMA, HS_LJ_N_COEFFS };

/** Names for fix adapt. */
#define HS_LJ_ADAPTABLE ((const hs_pair_adaptable[]){{"epsilon", HS_LJ_EPSILON}, {"sigma", HS_LJ_SIGMA}, {NULL, 0}})

static inline HS_MUST_USE hs_status hs_lj_coeff(hs_pair *pair, int i, int j, const hs_args *args, hs_error *err)
{
    return hs_pair_coeffs_set(pair, i, j, "n0", args, err);
}

/** Coefficients of (i, j) from the like pairs by the chosen rule; the cutoff mixes as a distance. */
static inline HS_MUST_USE hs_status hs_lj_mix(hs_pair *pair, int i, int j, hs_error *err)
{
    const hs_pair_coeff a = *hs_pair_coeffs_at(pair, i, i), b = *hs_pair_coeffs_at(pair, j, j);
    (void)err;
    *hs_pair_coeffs_at(pair, i, j) = (hs_pair_coeff){
        .c = {hs_pair_mix_energy(pair->mix, a.c[HS_LJ_EPSILON], b.c[HS_LJ_EPSILON], a.c[HS_LJ_SIGMA], b.c[HS_LJ_SIGMA]),
              hs_pair_mix_distance(pair->mix, a.c[HS_LJ_SIGMA], b.c[HS_LJ_SIGMA])},
        .cutoff = hs_pair_mix_distance(pair->mix, a.cutoff, b.cutoff)};
    return HS_OK;
}

/** Parameters of the lj_cut evaluator, in its order. */
static inline void hs_lj_params(const hs_pair_coeff *c, bool shift, double *p)
{
    const double epsilon = c->c[HS_LJ_EPSILON], sigma = c->c[HS_LJ_SIGMA];
    const double sigma6 = pow(sigma, 6.0), sigma12 = pow(sigma, 12.0);
    p[0] = 48.0 * epsilon * sigma12;
    p[1] = -24.0 * epsilon * sigma6;
    p[2] = 4.0 * epsilon * sigma12;
    p[3] = -4.0 * epsilon * sigma6;
    const double ratio = shift && c->cutoff > 0.0 ? sigma / c->cutoff : 0.0;
    p[4] = 4.0 * epsilon * (pow(ratio, 12.0) - pow(ratio, 6.0));
}

#endif
