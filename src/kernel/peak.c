/* Multiplications and additions as fast as the machine makes them: what the speed of kernels is compared with. Compiled for
 * every instruction set. */
#include "kernel/kernel.h"
#include "kernel/simd.h"

/* Independent ones, for units that take some cycles; with one constant more they fill the 16 registers that there are before
 * AVX-512. */
enum { CHAINS = 7 };

static double run(int64_t n, double *operations)
{
    hs_vec product[CHAINS], sum[CHAINS];
    for (int k = 0; k < CHAINS; ++k) product[k] = sum[k] = hs_set1(1.0 + k);
    const hs_vec nearly_one = hs_set1(1.0 - 1e-9);
    for (int64_t i = 0; i < n; ++i)
#pragma GCC unroll 8
        for (int k = 0; k < CHAINS; ++k) {
            product[k] = product[k] * nearly_one;
            sum[k] = sum[k] + nearly_one;
        }
    hs_vec all = hs_set1(0.0);
    for (int k = 0; k < CHAINS; ++k) all = all + product[k] + sum[k];
    *operations = 2.0 * CHAINS * HS_LANES * (double)n;
    return hs_sum(all);
}

#define PASTE_(a, b) a##b
#define PASTE(a, b)  PASTE_(a, b)
const hs_peak_loop PASTE(hs_peak_loop_, HS_KERNEL_ISA) = run;
