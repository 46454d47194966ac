#include "style/chunks.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"

hs_status hs_chunks_find(hs_env *env, const char *id, const char *command, hs_compute **compute, hs_error *err)
{
    *compute = env->find_compute(env, id);
    if (*compute == NULL)
        return hs_fail(err, HS_ERROR_INPUT, "%s: there is no compute '%s'; 'compute %s all chunk/atom ...' makes one",
                       command, id, id);
    if (strcmp((*compute)->style->about.name, "chunk/atom") == 0) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "%s: %s makes no chunks; chunk/atom does", command,
                   hs_compute_who(*compute).text);
}

void hs_chunks_hold(hs_env *env, const char *id, bool hold, bool *is_holding)
{
    hs_compute *compute;
    hs_error ignored = {0};
    if (*is_holding == hold || id == NULL) return;
    *is_holding = hold;
    if (hs_chunks_find(env, id, "", &compute, &ignored) != HS_OK) return;
    hs_chunks *chunks = hs_chunks_of(compute);
    if (hold || chunks->n_locks > 0) chunks->n_locks += hold ? 1 : -1; /* perhaps another in its place */
}

hs_status hs_bins_sum(const hs_env *env, uint32_t mask, const double *bin, size_t n_bins, const double *values,
                      double *sums, hs_error *err)
{
    const hs_atoms *atoms = env->atoms;
    int64_t *words = NULL; /* each sum is high + low / 2^30, in units of the largest value / 2^30 */
    double largest = 0.0;
    int exponent;
    hs_status status = HS_ALLOC(words, 2 * n_bins + 1, err);
    if (hs_parallel_agree(env->parallel, err) != HS_OK) {
        HS_FREE(words);
        return status != HS_OK ? status : err->status;
    }
    for (int i = 0; i < atoms->n_local; ++i)
        if (atoms->mask[i] & mask && bin[i] > 0.0) largest = fmax(largest, fabs(values[i]));
    hs_parallel_max_double(env->parallel, &largest, 1);
    (void)frexp(largest, &exponent);
#pragma omp parallel for schedule(static)
    for (int i = 0; i < atoms->n_local; ++i) {
        if (!(atoms->mask[i] & mask) || !(bin[i] > 0.0)) continue;
        int64_t *word = words + 2 * ((size_t)bin[i] - 1);
        const double q = ldexp(values[i], 30 - exponent), high = rint(q), low = rint(ldexp(q - high, 30));
#pragma omp atomic
        word[0] += (int64_t)high;
#pragma omp atomic
        word[1] += (int64_t)low;
    }
    for (size_t begin = 0; begin < 2 * n_bins; begin += 1 << 20) {
        const size_t rest = 2 * n_bins - begin;
        hs_parallel_sum_int64(env->parallel, words + begin, rest < 1 << 20 ? (int)rest : 1 << 20);
    }
    for (size_t k = 0; k < n_bins; ++k)
        sums[k] = ldexp((double)words[2 * k] + ldexp((double)words[2 * k + 1], -30), exponent - 30);
    HS_FREE(words);
    return HS_OK;
}

hs_status hs_chunks_sum(const hs_compute *compute, uint32_t mask, const double *values, double *sums, hs_error *err)
{
    return hs_bins_sum(compute->env, mask, compute->atoms, (size_t)hs_chunks_of(compute)->n, values, sums, err);
}
