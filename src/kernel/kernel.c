#include "kernel/kernel.h"

#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "kernel/force.h"
#include "kernel/motion.h"
#include "kernel/noise_fill.h"
#include "kernel/pair_histogram.h"

const char *const hs_isa_names[] = {"portable", "sse2", "avx2", "avx512", NULL};

const char *const hs_precision_names[] = {"double", "mixed", NULL};

hs_status hs_precision_get(const char *name, hs_precision *precision, hs_error *err)
{
    size_t n = 0;
    for (; hs_precision_names[n] != NULL; ++n)
        if (strcmp(name, hs_precision_names[n]) == 0) {
            *precision = (hs_precision)n;
            return HS_OK;
        }
    const char *nearest = hs_text_nearest(name, hs_precision_names, n);
    return hs_fail(err, HS_ERROR_INPUT, "there is no precision '%s'; %s%s%s", name,
                   nearest != NULL ? "did you mean '" : "expected double or mixed", nearest != NULL ? nearest : "",
                   nearest != NULL ? "'?" : "");
}

static bool has_isa(hs_isa isa)
{
#if defined(__x86_64__) && !defined(HS_PORTABLE_ONLY)
    switch (isa) {
    case HS_ISA_AVX512:
        return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("bmi2") &&
               __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
    case HS_ISA_AVX2:
        return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    default:
        return true;
    }
#else
    return isa == HS_ISA_PORTABLE;
#endif
}

hs_isa hs_isa_best(void)
{
    int isa = HS_N_ISAS - 1;
    while (!has_isa((hs_isa)isa)) --isa;
    return (hs_isa)isa;
}

bool hs_isa_gathers_fast(hs_isa isa)
{
#if defined(__x86_64__) && !defined(HS_PORTABLE_ONLY)
    return isa == HS_ISA_AVX512 && __builtin_cpu_is("intel"); /* kernel/simd.h has the measurements */
#else
    (void)isa;
    return false;
#endif
}

bool hs_machine_looks_far(void)
{
#if defined(__x86_64__) && !defined(HS_PORTABLE_ONLY)
    /* AVX2 kernels of lj/cut with rows in turn, on a core of Intel's of 2024: steps take 10 to 13 % less time in double, 9 with reproducible sums, 8 in
       mixed precision. AVX-512, with twice the registers: the same in double and fixed point, 6 % more in mixed; SSE2 the same; plain C a sixth more.
       On a Zen 4 (AVX-512) measuring one vector ahead takes 9 to 14 % off the kernels. */
    return __builtin_cpu_is("intel");
#else
    return false;
#endif
}

hs_cluster_kernel hs_kernel_for_clusters(const hs_kernel_set *set, const hs_kernel_input *in, bool with_energy,
                                         bool listed_only)
{
    const bool by_type = !in->table->is_uniform;
    const hs_cluster_kernel in_turn = in->looks_far && !with_energy && !listed_only ? set->in_turn[by_type] : NULL;
    return in_turn != NULL ? in_turn : set->cluster[with_energy][by_type][listed_only];
}

hs_status hs_isa_get(const char *name, hs_isa *isa, hs_error *err)
{
    *isa = hs_isa_best();
    if (name[0] == '\0' || strcmp(name, "auto") == 0) {
        name = getenv("HALFSHELL_ISA"); /* so that all tests can be run with each set */
        if (name == NULL || name[0] == '\0' || strcmp(name, "auto") == 0) return HS_OK;
    }
    for (int i = 0; i < HS_N_ISAS; ++i) {
        if (strcmp(name, hs_isa_names[i]) != 0) continue;
        *isa = (hs_isa)i;
        if (has_isa(*isa)) return HS_OK;
        return hs_fail(err, HS_ERROR_INPUT,
                       "the instruction set '%s' is not one of this machine; the best it has is '%s'", name,
                       hs_isa_names[hs_isa_best()]);
    }
    const char *nearest = hs_text_nearest(name, hs_isa_names, HS_N_ISAS);
    return hs_fail(err, HS_ERROR_INPUT, "there is no instruction set '%s'; %s'%s'%s", name,
                   nearest != NULL ? "did you mean " : "expected auto, portable, sse2, avx2 or avx512, for instance ",
                   nearest != NULL ? nearest : "auto", nearest != NULL ? "?" : "");
}

#if defined(__x86_64__) && !defined(HS_PORTABLE_ONLY)
#define FOR_ISA(isa, name)                                                                                             \
    ((isa) == HS_ISA_AVX512 ? name##avx512                                                                             \
     : (isa) == HS_ISA_AVX2 ? name##avx2                                                                               \
     : (isa) == HS_ISA_SSE2 ? name##sse2                                                                               \
                            : name##portable)
#else
#define FOR_ISA(isa, name) ((void)(isa), name##portable)
#endif

hs_cluster_find hs_isa_find(hs_isa isa) { return FOR_ISA(isa, hs_cluster_find_); }

hs_near_find hs_isa_near(hs_isa isa) { return FOR_ISA(isa, hs_near_find_); }

const hs_noise_set *hs_isa_noise(hs_isa isa) { return FOR_ISA(isa, &hs_noise_set_); }

const hs_motion_set *hs_isa_motion(hs_isa isa) { return FOR_ISA(isa, &hs_motion_set_); }

hs_settle hs_isa_settle(hs_isa isa) { return FOR_ISA(isa, hs_settle_); }

hs_histogram_kernel hs_isa_histogram(hs_isa isa) { return FOR_ISA(isa, hs_histogram_kernel_); }

hs_list_refine hs_isa_refine(hs_isa isa) { return FOR_ISA(isa, hs_list_refine_); }

hs_peak_loop hs_isa_peak(hs_isa isa) { return FOR_ISA(isa, hs_peak_loop_); }

bool hs_pair_table_is_uniform(const hs_pair_table *table)
{
    const size_t row_size = (size_t)table->stride * sizeof(double);
    for (int i = 1; i < table->n_types; ++i)
        for (int j = 1; j < table->n_types; ++j)
            if (memcmp(table->values + (size_t)(i * table->n_types + j) * (size_t)table->stride,
                       table->values + (size_t)(table->n_types + 1) * (size_t)table->stride, row_size) != 0)
                return false;
    return true;
}

bool hs_evaluator_pair(const hs_evaluator *evaluator, const hs_pair_table *table, int i, int j, double sum_of_radii,
                       double r2, double *force_over_r, double *energy)
{
    const double *row = table->values + ((size_t)i * (size_t)table->n_types + (size_t)j) * (size_t)table->stride;
    if (!(r2 < row[HS_TABLE_CUT_R2])) return false;
    if (!evaluator->has_radii) {
        evaluator->single(row + HS_TABLE_PARAMS, table->shared, r2, force_over_r, energy);
        return true;
    }
    if (!(r2 < sum_of_radii * sum_of_radii)) return false;
    double params[HS_EVALUATOR_PARAMS_MAX + 1];
    memcpy(params, row + HS_TABLE_PARAMS, (size_t)evaluator->n_params * sizeof *params);
    params[evaluator->n_params] = sum_of_radii;
    evaluator->single(params, table->shared, r2, force_over_r, energy);
    return true;
}
