/* Power spectra of short series. */
#include <math.h>

#include "base/memory.h"
#include "core/fft_plan.h"
#include "core/fourier.h"

struct hs_periodogram {
    int n;
    bool subtracts_mean;
    double *weight;   /**< owned [n] */
    double norm;      /**< sum of the squared weights */
    double *a;        /**< owned [n] */
    fftw_complex *at; /**< owned [n/2 + 1] */
    fftw_plan forward;
};

static hs_status allocate(hs_periodogram *p, bool has_window, hs_error *err)
{
    HS_TRY(HS_ALLOC(p->weight, (size_t)p->n, err));
    HS_TRY(HS_ALLOC(p->a, (size_t)p->n, err));
    HS_TRY(hs_memory_alloc((void **)&p->at, (size_t)p->n / 2 + 1, sizeof(fftw_complex), err));
    for (int i = 0; i < p->n; ++i) {
        const double s = sin(M_PI * (i + 0.5) / p->n);
        p->weight[i] = has_window ? s * s : 1.0;
        p->norm += p->weight[i] * p->weight[i];
    }
    p->forward = hs_fft_plan_forward(1, &p->n, p->a, p->at);
    if (p->forward != NULL) return HS_OK;
    return hs_fail(err, HS_ERROR_MEMORY, "FFTW could not plan a transform of %d numbers", p->n);
}

hs_status hs_periodogram_create(hs_periodogram **periodogram, int n, bool has_window, bool subtract_mean, hs_error *err)
{
    HS_TRY(HS_ALLOC(*periodogram, 1, err));
    (*periodogram)->n = n;
    (*periodogram)->subtracts_mean = subtract_mean;
    const hs_status status = allocate(*periodogram, has_window, err);
    if (status != HS_OK) hs_periodogram_destroy(periodogram);
    return status;
}

void hs_periodogram_destroy(hs_periodogram **periodogram)
{
    hs_periodogram *p = *periodogram;
    if (p == NULL) return;
    hs_fft_plan_destroy(&p->forward);
    HS_FREE(p->weight);
    HS_FREE(p->a);
    HS_FREE(p->at);
    HS_FREE(*periodogram);
}

void hs_periodogram_eval(hs_periodogram *p, const double *samples, double *power, int stride)
{
    double mean = 0.0;
    for (int i = 0; i < p->n && p->subtracts_mean; ++i) mean += samples[i] / p->n;
    for (int i = 0; i < p->n; ++i) p->a[i] = p->weight[i] * (samples[i] - mean);
    fftw_execute(p->forward);
    for (int k = 0; k <= p->n / 2; ++k) {
        /* of the frequencies k and -k one is listed */
        const double both = k == 0 || 2 * k == p->n ? 1.0 : 2.0;
        power[(size_t)k * (size_t)stride] = both / p->norm * (p->at[k][0] * p->at[k][0] + p->at[k][1] * p->at[k][1]);
    }
}
