/** Coefficients that the styles of the Lennard-Jones family share (lj/cut and wca differ in the cutoff and the shift). */
#ifndef HS_PAIR_LJ_STATE_H
#define HS_PAIR_LJ_STATE_H

#include <math.h>

#include "base/memory.h"
#include "style/pair.h"

typedef struct lj_coeff {
    double epsilon; /**< energy */
    double sigma;   /**< distance */
    double cutoff;  /**< distance */
} lj_coeff;

typedef struct lj_state {
    double cutoff_global;
    lj_coeff *coeff; /**< owned [n_coeffs], by hs_pair_index */
    int n_coeffs;
} lj_state;

static inline HS_MUST_USE hs_status hs_lj_allocate(hs_pair *pair, hs_error *err)
{
    lj_state *lj = pair->state;
    lj->n_coeffs = (pair->n_types + 1) * (pair->n_types + 1);
    return HS_ALLOC(lj->coeff, (size_t)lj->n_coeffs, err);
}

static inline void hs_lj_destroy(hs_pair *pair)
{
    lj_state *lj = pair->state;
    HS_FREE(lj->coeff);
}

/** Coefficients of (i, j) from the like pairs; the cutoff mixes as a distance. */
static inline void hs_lj_mix(hs_pair *pair, int i, int j)
{
    lj_state *lj = pair->state;
    const lj_coeff a = lj->coeff[hs_pair_index(pair, i, i)], b = lj->coeff[hs_pair_index(pair, j, j)];
    lj->coeff[hs_pair_index(pair, i, j)] =
        (lj_coeff){.epsilon = hs_pair_mix_energy(pair->mix, a.epsilon, b.epsilon, a.sigma, b.sigma),
                   .sigma = hs_pair_mix_distance(pair->mix, a.sigma, b.sigma),
                   .cutoff = hs_pair_mix_distance(pair->mix, a.cutoff, b.cutoff)};
}

/** Parameters of the lj_cut evaluator, in its order. */
static inline void hs_lj_params(lj_coeff c, bool shift, double *p)
{
    const double sigma6 = pow(c.sigma, 6.0), sigma12 = pow(c.sigma, 12.0);
    p[0] = 48.0 * c.epsilon * sigma12;
    p[1] = -24.0 * c.epsilon * sigma6;
    p[2] = 4.0 * c.epsilon * sigma12;
    p[3] = -4.0 * c.epsilon * sigma6;
    const double ratio = shift && c.cutoff > 0.0 ? c.sigma / c.cutoff : 0.0;
    p[4] = 4.0 * c.epsilon * (pow(ratio, 12.0) - pow(ratio, 6.0));
}

#endif
