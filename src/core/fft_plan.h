/** Plans of FFTW, which keeps one store of plans for the whole process and does not guard it: simulations of several threads take
 *  turns here. Transforms themselves need no lock. */
#ifndef HS_CORE_FFT_PLAN_H
#define HS_CORE_FFT_PLAN_H

#include <fftw3.h>

/** A transform of n[0] x ... x n[rank - 1] real numbers to their complex half, or back. The arrays are borrowed for as long as the plan
 *  is used; NULL: there is no memory. The caller gives the plan back. Not collective; threads may call these at the same time. */
fftw_plan hs_fft_plan_forward(int rank, const int *n, double *in, fftw_complex *out);
fftw_plan hs_fft_plan_backward(int rank, const int *n, fftw_complex *in, double *out);
/** NULL is fine; clears the plan. */
void hs_fft_plan_destroy(fftw_plan *plan);

#endif
