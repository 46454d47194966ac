/** What the file of a pair style includes before its evaluator.
 *
 *  The file is compiled once plainly, for its descriptor and the scalar potential, and once for every instruction set
 *  with HS_KERNEL_ISA and HS_SIMD_... defined, for the kernels. It looks like this:
 *
 *      #include "kernel/evaluator.h"
 *      enum { A, B, N_PARAMS };                        // parameters of a type pair, as pair style ->params() writes them
 *      HS_EVALUATE(const hs_vec *p, hs_vec r2, hs_vec *force_over_r, hs_vec *energy, bool with_energy)
 *      { ... p[A] ... }                                // -(dU/dr)/r and U; energy only when with_energy
 *      #define HS_EVALUATOR name
 *      #include "kernel/instantiate.h"
 *      #ifndef HS_KERNEL_ISA
 *      ... descriptor, with .evaluator = &hs_evaluator_name ...
 *      #endif
 *
 *  A potential of atoms that have radii says `#define HS_EVALUATOR_RADII` before instantiate.h. Its parameter p[N_PARAMS] is
 *  then the sum of the two atoms' radii, beyond which it must be zero; the cutoff of the type pair is the largest such sum.
 *
 *  A potential that looks numbers up says `#define HS_EVALUATOR_SHARED` before instantiate.h, and its evaluate() has one more
 *  argument after p, `const double *shared`: what the pair style's ->shared() returns, for all pairs of types. p says where
 *  those of a pair of types begin; hs_to_indices() and hs_gather() of kernel/simd.h look up.
 *
 *  Where r is beyond the cutoff the results are not used, so r2 may be anything; no branches, no libm calls on vectors:
 *  kernel/vector_math.h has exponential, sine and cosine. */
#ifndef HS_KERNEL_EVALUATOR_H
#define HS_KERNEL_EVALUATOR_H

#include "kernel/kernel.h"
#include "kernel/simd.h"

/** A squared distance that counts as none, in float too: potentials that are finite at r = 0 divide by at least its root,
 *  so that the force of atoms at one place is zero, not undefined. */
#define HS_TINY_R2       1e-30

#define HS_EVALUATE(...) static inline __attribute__((always_inline)) void evaluate(__VA_ARGS__)

#endif
