/* Correlations by zero-padded transforms: W. H. Press et al., Numerical Recipes, 3rd ed. (2007), section 13.2. */
#include <string.h>

#include "base/memory.h"
#include "core/fft_plan.h"
#include "core/fourier.h"

struct hs_correlator {
    int n_lags;
    double *a, *b;               /**< owned [2 n_lags] */
    fftw_complex *at, *bt;       /**< owned [n_lags + 1] */
    fftw_plan forward, backward; /**< of a; b uses the same plan on its own arrays */
};

static hs_status allocate(hs_correlator *c, hs_error *err)
{
    const int n = 2 * c->n_lags;
    HS_TRY(HS_ALLOC(c->a, (size_t)n, err));
    HS_TRY(HS_ALLOC(c->b, (size_t)n, err));
    HS_TRY(hs_memory_alloc((void **)&c->at, (size_t)c->n_lags + 1, sizeof(fftw_complex), err));
    HS_TRY(hs_memory_alloc((void **)&c->bt, (size_t)c->n_lags + 1, sizeof(fftw_complex), err));
    c->forward = hs_fft_plan_forward(1, &n, c->a, c->at);
    c->backward = hs_fft_plan_backward(1, &n, c->at, c->a);
    if (c->forward != NULL && c->backward != NULL) return HS_OK;
    return hs_fail(err, HS_ERROR_MEMORY, "FFTW could not plan a transform of %d numbers", n);
}

hs_status hs_correlator_create(hs_correlator **correlator, int n_lags, hs_error *err)
{
    HS_TRY(HS_ALLOC(*correlator, 1, err));
    (*correlator)->n_lags = n_lags;
    const hs_status status = allocate(*correlator, err);
    if (status != HS_OK) hs_correlator_destroy(correlator);
    return status;
}

void hs_correlator_destroy(hs_correlator **correlator)
{
    hs_correlator *c = *correlator;
    if (c == NULL) return;
    hs_fft_plan_destroy(&c->forward);
    hs_fft_plan_destroy(&c->backward);
    HS_FREE(c->a);
    HS_FREE(c->b);
    HS_FREE(c->at);
    HS_FREE(c->bt);
    HS_FREE(*correlator);
}

void hs_correlator_add(hs_correlator *c, const double *a, const double *b, double *sums)
{
    const size_t n_lags = (size_t)c->n_lags;
    memcpy(c->a, a, 2 * n_lags * sizeof *a);
    memset(c->b, 0, n_lags * sizeof *b);
    memcpy(c->b + n_lags, b + n_lags, n_lags * sizeof *b);
    fftw_execute_dft_r2c(c->forward, c->a, c->at);
    fftw_execute_dft_r2c(c->forward, c->b, c->bt);
    /* conj(A) B is the transform of sum_s a[s - lag] b[s]; no lag below n_lags reaches around the end, for b is 0
     * before n_lags */
    for (size_t k = 0; k <= n_lags; ++k) {
        const double ar = c->at[k][0], ai = c->at[k][1], br = c->bt[k][0], bi = c->bt[k][1];
        c->at[k][0] = ar * br + ai * bi;
        c->at[k][1] = ar * bi - ai * br;
    }
    fftw_execute_dft_c2r(c->backward, c->at, c->a);
    const double scale = 0.5 / (double)n_lags;
    for (size_t lag = 0; lag < n_lags; ++lag) sums[lag] += scale * c->a[lag];
}
