#include "core/fft_plan.h"

#include <pthread.h>

static pthread_mutex_t planner = PTHREAD_MUTEX_INITIALIZER;

fftw_plan hs_fft_plan_forward(int rank, const int *n, double *in, fftw_complex *out)
{
    pthread_mutex_lock(&planner);
    const fftw_plan plan = fftw_plan_dft_r2c(rank, n, in, out, FFTW_ESTIMATE);
    pthread_mutex_unlock(&planner);
    return plan;
}

fftw_plan hs_fft_plan_backward(int rank, const int *n, fftw_complex *in, double *out)
{
    pthread_mutex_lock(&planner);
    const fftw_plan plan = fftw_plan_dft_c2r(rank, n, in, out, FFTW_ESTIMATE);
    pthread_mutex_unlock(&planner);
    return plan;
}

void hs_fft_plan_destroy(fftw_plan *plan)
{
    if (*plan == NULL) return;
    pthread_mutex_lock(&planner);
    fftw_destroy_plan(*plan);
    pthread_mutex_unlock(&planner);
    *plan = NULL;
}
