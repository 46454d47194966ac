/** Lennard-Jones up to a distance, and from there a force that is a cubic polynomial: what lj/smooth and lj/cubic
 *  share. Its evaluator is in lj_smooth.c. */
#ifndef HS_PAIR_LJ_CUBIC_END_H
#define HS_PAIR_LJ_CUBIC_END_H

/** Parameters of the evaluator. */
enum { F12, MINUS_F6, U12, MINUS_U6, SHIFT, INNER, INNER_R2, U_INNER, C0, C1, C2, C3, N_PARAMS };

#ifndef HS_KERNEL_ISA

#include <math.h>

/** The parameters of the inner part; the polynomial and the shift are zero. */
static inline void hs_lj_cubic_end_params(double epsilon, double sigma, double inner, double *p)
{
    const double sigma6 = pow(sigma, 6.0), ratio6 = pow(sigma / inner, 6.0);
    p[F12] = 48.0 * epsilon * sigma6 * sigma6;
    p[MINUS_F6] = -24.0 * epsilon * sigma6;
    p[U12] = 4.0 * epsilon * sigma6 * sigma6;
    p[MINUS_U6] = -4.0 * epsilon * sigma6;
    p[INNER] = inner;
    p[INNER_R2] = inner * inner;
    p[U_INNER] = 4.0 * epsilon * ratio6 * (ratio6 - 1.0);
    p[C0] = p[C1] = p[C2] = p[C3] = p[SHIFT] = 0.0;
}

#endif
#endif
