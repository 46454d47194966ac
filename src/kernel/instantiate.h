/** Makes, from evaluate() of the including pair style, the kernels of one instruction set and precision (HS_KERNEL_ISA defined) or the
 *  hs_evaluator that collects them (plain compilation). See kernel/evaluator.h. */

#define HS_PASTE3_(a, b, c) a##b##_##c
#define HS_PASTE3(a, b, c)  HS_PASTE3_(a, b, c)
#define HS_PASTE2_(a, b)    a##b
#define HS_PASTE2(a, b)     HS_PASTE2_(a, b)

#ifdef HS_EVALUATOR_RADII
enum { HS_HAS_RADII = 1 };
#else
enum { HS_HAS_RADII = 0 };
#endif

/** evaluate(), whichever of its two forms the potential has. */
static inline __attribute__((always_inline)) void evaluate_pairs(const hs_vec *p, const double *shared, hs_vec r2,
                                                                 hs_vec *force_over_r, hs_vec *energy, bool with_energy)
{
#ifdef HS_EVALUATOR_SHARED
    evaluate(p, shared, r2, force_over_r, energy, with_energy);
#else
    (void)shared;
    evaluate(p, r2, force_over_r, energy, with_energy);
#endif
}

#ifdef HS_KERNEL_ISA

#include "kernel/cluster_loop.h"
#include "kernel/verlet_loop.h"

#define HS_CLUSTER_KERNEL(name, ...)                                                                                   \
    static void name(const hs_kernel_input *in, hs_kernel_output *out, int first, const hs_cluster_entry *entry,       \
                     int n_entries)                                                                                    \
    {                                                                                                                  \
        cluster_loop(in, out, first, entry, n_entries, (cluster_form){__VA_ARGS__});                                   \
    }
/* Where energies are wanted now and then only, the form for many types serves one type, too: each form costs a twentieth of the build. */
HS_CLUSTER_KERNEL(force, .by_type = false)
HS_CLUSTER_KERNEL(force_listed, .listed_only = true)
HS_CLUSTER_KERNEL(force_by_type, .by_type = true)
HS_CLUSTER_KERNEL(force_by_type_listed, .by_type = true, .listed_only = true)
HS_CLUSTER_KERNEL(energy_, .with_energy = true)
HS_CLUSTER_KERNEL(energy_by_type, .with_energy = true, .by_type = true)
HS_CLUSTER_KERNEL(energy_by_type_listed, .with_energy = true, .by_type = true, .listed_only = true)
#ifdef HS_MIXED
#define force_counting NULL
#else
HS_CLUSTER_KERNEL(force_counting, .counting = true)
#endif
#ifdef HS_ROWS_IN_TURN
HS_CLUSTER_KERNEL(force_in_turn, .in_turn = true)
HS_CLUSTER_KERNEL(force_by_type_in_turn, .by_type = true, .in_turn = true)
#else
#define force_in_turn         NULL
#define force_by_type_in_turn NULL
#endif

#define HS_VERLET_KERNEL(name, with_energy, by_type)                                                                   \
    static void name(const hs_kernel_input *in, hs_kernel_output *out, int begin, int end, const int64_t *start,       \
                     const int32_t *neighbor)                                                                          \
    {                                                                                                                  \
        verlet_loop(in, out, begin, end, start, neighbor, with_energy, by_type);                                       \
    }
HS_VERLET_KERNEL(verlet_force, false, false)
HS_VERLET_KERNEL(verlet_force_by_type, false, true)
HS_VERLET_KERNEL(verlet_energy_by_type, true, true)

#define HS_PAIRS_KERNEL(name, with_energy, by_type)                                                                    \
    static void name(const hs_kernel_input *in, hs_kernel_output *out, int64_t n, const int32_t *i, const int32_t *j)  \
    {                                                                                                                  \
        pairs_loop(in, out, n, i, j, with_energy, by_type);                                                            \
    }
HS_PAIRS_KERNEL(pairs_force, false, false)
HS_PAIRS_KERNEL(pairs_force_by_type, false, true)
HS_PAIRS_KERNEL(pairs_energy_by_type, true, true)

extern const hs_kernel_set HS_PASTE3(hs_kernels_, HS_EVALUATOR, HS_KERNEL_ISA);
const hs_kernel_set HS_PASTE3(hs_kernels_, HS_EVALUATOR, HS_KERNEL_ISA) = {
    .group = HS_GROUP,
    .lanes = HS_LANES,
    .cluster = {{{force, force_listed}, {force_by_type, force_by_type_listed}},
                {{energy_, energy_by_type_listed}, {energy_by_type, energy_by_type_listed}}},
    .in_turn = {force_in_turn, force_by_type_in_turn},
    .counting = force_counting,
    .verlet = {{verlet_force, verlet_force_by_type}, {verlet_energy_by_type, verlet_energy_by_type}},
    .pairs = {{pairs_force, pairs_force_by_type}, {pairs_energy_by_type, pairs_energy_by_type}},
};

#else

static void single(const double *params, const double *shared, double r2, double *force_over_r, double *energy)
{
    evaluate_pairs(params, shared, r2, force_over_r, energy, true);
}

#define HS_KERNELS(isa) HS_PASTE3(hs_kernels_, HS_EVALUATOR, isa)
extern const hs_kernel_set HS_KERNELS(portable), HS_KERNELS(portable_mixed), HS_KERNELS(portable_fixed);
#if defined(__x86_64__) && !defined(HS_PORTABLE_ONLY)
extern const hs_kernel_set HS_KERNELS(sse2), HS_KERNELS(sse2_mixed), HS_KERNELS(sse2_fixed);
extern const hs_kernel_set HS_KERNELS(avx2), HS_KERNELS(avx2_mixed), HS_KERNELS(avx2_fixed);
extern const hs_kernel_set HS_KERNELS(avx512), HS_KERNELS(avx512_mixed), HS_KERNELS(avx512_fixed);
#endif
extern const hs_evaluator HS_PASTE2(hs_evaluator_, HS_EVALUATOR);
const hs_evaluator HS_PASTE2(hs_evaluator_, HS_EVALUATOR) = {
    .n_params = N_PARAMS,
    .has_radii = HS_HAS_RADII,
    .single = single,
    .set =
        {
            [HS_ISA_PORTABLE] = {&HS_KERNELS(portable), &HS_KERNELS(portable_mixed), &HS_KERNELS(portable_fixed)},
#if defined(__x86_64__) && !defined(HS_PORTABLE_ONLY)
            [HS_ISA_SSE2] = {&HS_KERNELS(sse2), &HS_KERNELS(sse2_mixed), &HS_KERNELS(sse2_fixed)},
            [HS_ISA_AVX2] = {&HS_KERNELS(avx2), &HS_KERNELS(avx2_mixed), &HS_KERNELS(avx2_fixed)},
            [HS_ISA_AVX512] = {&HS_KERNELS(avx512), &HS_KERNELS(avx512_mixed), &HS_KERNELS(avx512_fixed)},
#endif
        },
};

#endif
