/** Functions with loops over arrays outside of the kernels. */
#ifndef HS_BASE_WIDE_H
#define HS_BASE_WIDE_H

/** Compile the function for wider vectors too, and take those where the machine has them. Compilers may not contract
 *  products and sums to one operation (-ffp-contract=off), so the bits are the same. */
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(HS_SANITIZE)
#define HS_WIDE __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define HS_WIDE
#endif

#endif
