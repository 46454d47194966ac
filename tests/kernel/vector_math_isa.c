/* Compiled once for every instruction set and precision, with the flags of the kernels: see tests/CMakeLists.txt. */
#include "kernel/vector_math_isa.h"

#include "kernel/vector_log.h"

static hs_vec sinpi(hs_vec x)
{
    hs_vec s, c;
    hs_sincospi(x, &s, &c);
    return s;
}
static hs_vec cospi(hs_vec x)
{
    hs_vec s, c;
    hs_sincospi(x, &s, &c);
    return c;
}
static hs_vec min_one(hs_vec x) { return hs_min(hs_set1(1.0), x); }
static hs_vec max_one(hs_vec x) { return hs_max(hs_set1(1.0), x); }

#define OVER_ARRAY(name, function)                                                                                     \
    static void name(const double *x, double *y, int n)                                                                \
    {                                                                                                                  \
        hs_real lane[HS_LANES];                                                                                        \
        for (int at = 0; at < n; at += HS_LANES) {                                                                     \
            hs_vec a;                                                                                                  \
            for (int k = 0; k < HS_LANES; ++k) lane[k] = (hs_real)x[at + k];                                           \
            memcpy(&a, lane, sizeof a);                                                                                \
            a = function(a);                                                                                           \
            memcpy(lane, &a, sizeof a);                                                                                \
            for (int k = 0; k < HS_LANES; ++k) y[at + k] = lane[k];                                                    \
        }                                                                                                              \
    }
OVER_ARRAY(exp_array, hs_exp)
OVER_ARRAY(log_array, hs_log)
OVER_ARRAY(sinpi_array, sinpi)
OVER_ARRAY(cospi_array, cospi)
OVER_ARRAY(min_array, min_one)
OVER_ARRAY(max_array, max_one)

#define PASTE_(a, b) a##b
#define PASTE(a, b)  PASTE_(a, b)
extern const vector_math PASTE(vector_math_, HS_KERNEL_ISA);
const vector_math PASTE(vector_math_, HS_KERNEL_ISA) = {exp_array,   log_array, sinpi_array,
                                                        cospi_array, min_array, max_array};
