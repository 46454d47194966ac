/** Fourier transforms for measuring, through FFTW: time correlations and density modes. */
#ifndef HS_CORE_FOURIER_H
#define HS_CORE_FOURIER_H

#include <complex.h>
#include <stdint.h>

#include "base/error.h"

/** Sums of products of two series at all lags below a window, block by block: as the direct sum, in O(log n) a
 *  value. */
typedef struct hs_correlator hs_correlator;

/** For lags 0 .. n_lags - 1. The caller destroys it. Not collective. */
HS_MUST_USE hs_status hs_correlator_create(hs_correlator **correlator, int n_lags, hs_error *err);
void hs_correlator_destroy(hs_correlator **correlator);
/** sums[lag] += sum over s in [n_lags, 2 n_lags) of a[s - lag] b[s]; a and b have 2 n_lags values, of which those
 *  before the start of the series or after its end must be 0. */
void hs_correlator_add(hs_correlator *correlator, const double *a, const double *b, double *sums);

/** Squares of the transform of n samples, the periodogram: its sum over the n/2 + 1 frequencies k/n is the mean square
 *  of the samples (of those less their mean, with @p subtract_mean); exactly so without a window, on average with
 *  one. */
typedef struct hs_periodogram hs_periodogram;

/** @p n even; @p has_window: samples are weighted by sin^2(pi (i + 1/2) / n) (Hann). The caller destroys it. Not
 *  collective. */
HS_MUST_USE hs_status hs_periodogram_create(hs_periodogram **periodogram, int n, bool has_window, bool subtract_mean,
                                            hs_error *err);
void hs_periodogram_destroy(hs_periodogram **periodogram);
/** power[k * stride] for k from 0 to n/2: n times what the frequency k/n gives to the mean square, the density for
 *  samples one unit of time apart. */
void hs_periodogram_eval(hs_periodogram *periodogram, const double *samples, double *power, int stride);

/** Density modes rho(n) = sum over points of exp(-2 pi i n x), x in box lengths, for all |n_a| <= n_max[a]: a
 *  non-uniform fast Fourier transform. Points are spread over a grid of twice the needed fineness with a kernel 14 grid
 *  cells wide, exp(beta (sqrt(1 - z^2) - 1)), which is divided out after the transform; the error is below 1e-11 of the
 *  number of points.
 *  Source: A. H. Barnett, J. Magland, L. af Klinteberg, SIAM J. Sci. Comput. 41, C479 (2019),
 *  doi:10.1137/18M120885X. */
typedef struct hs_modes hs_modes;

/** @p n_max may be 0 along axes of which no modes are wanted. The caller destroys it. Not collective. */
HS_MUST_USE hs_status hs_modes_create(hs_modes **modes, const int n_max[3], hs_error *err);
void hs_modes_destroy(hs_modes **modes);
/** Clear the grid and spread n points over it, of n_all on all ranks. x[axis][i] in box lengths, any number (it is
 *  wrapped); only points with (mask[i] & wanted) count. Threaded; the same bits for any threads and order of points:
 *  the grid is in fixed point. */
void hs_modes_spread(hs_modes *modes, int n, const double *const x[3], const uint32_t *mask, uint32_t wanted,
                     int64_t n_all);
/** The grid, to be summed over ranks between hs_modes_spread and hs_modes_transform: values[*n]. */
int64_t *hs_modes_grid(hs_modes *modes, int64_t *n);
void hs_modes_transform(hs_modes *modes);
/** rho(n) after the transform. */
double complex hs_modes_get(const hs_modes *modes, int n0, int n1, int n2);

#endif
