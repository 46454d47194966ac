/* Vector functions of all instruction sets and precisions against libm in long double, in units in the last place. */
#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>

#include "kernel/kernel.h"
#include "kernel/vector_math_isa.h"
#include "support/harness.h"

extern const vector_math vector_math_portable, vector_math_portable_mixed;
#if defined(__x86_64__) && !defined(HS_PORTABLE_ONLY)
extern const vector_math vector_math_sse2, vector_math_sse2_mixed, vector_math_avx2, vector_math_avx2_mixed,
    vector_math_avx512, vector_math_avx512_mixed;
#endif

/* double and float; fixed point has the functions of double */
enum { N_WIDTHS = HS_PRECISION_MIXED + 1 };

static const vector_math *const sets[HS_N_ISAS][N_WIDTHS] = {
    [HS_ISA_PORTABLE] = {&vector_math_portable, &vector_math_portable_mixed},
#if defined(__x86_64__) && !defined(HS_PORTABLE_ONLY)
    [HS_ISA_SSE2] = {&vector_math_sse2, &vector_math_sse2_mixed},
    [HS_ISA_AVX2] = {&vector_math_avx2, &vector_math_avx2_mixed},
    [HS_ISA_AVX512] = {&vector_math_avx512, &vector_math_avx512_mixed},
#endif
};

enum { N = 16000 };
static double x[N], y[N];

/** Distance of y from the exact value, in last places of a number of that size (of the smallest normal number below
 *  it). */
static double ulps(double value, long double exact, bool is_float)
{
    if (is_float ? (float)exact == (float)value : (double)exact == value) return 0.0;
    const int least = is_float ? FLT_MIN_EXP : DBL_MIN_EXP, digits = is_float ? FLT_MANT_DIG : DBL_MANT_DIG;
    int exponent;
    (void)frexpl(exact, &exponent);
    if (exponent < least) exponent = least;
    return (double)fabsl((value - exact) / ldexpl(1.0L, exponent - digits));
}

typedef long double exact_function(long double x);

/* arguments are reduced without error first */
static long double exact_sinpi(long double a)
{
    a -= 2.0L * roundl(a / 2.0L);
    if (fabsl(a) > 0.5L) a = copysignl(1.0L, a) - a;
    return sinl(3.14159265358979323846264338327950288L * a);
}
static long double exact_cospi(long double a)
{
    a = fabsl(a - 2.0L * roundl(a / 2.0L));
    return exact_sinpi(0.5L - a);
}
/** Largest error over x[0 .. N) on every instruction set. */
static void check(const char *name, size_t offset, exact_function *exact, const double largest[N_WIDTHS],
                  hs_precision precision)
{
    const bool is_float = precision == HS_PRECISION_MIXED;
    for (int isa = 0; isa <= (int)hs_isa_best(); ++isa) {
        vector_function *const function = *(vector_function *const *)((const char *)sets[isa][precision] + offset);
        double worst = 0.0, at = 0.0;
        function(x, y, N);
        for (int k = 0; k < N; ++k) {
            const double argument = is_float ? (float)x[k] : x[k], error = ulps(y[k], exact(argument), is_float);
            if (!(error <= worst)) worst = error, at = argument;
        }
        printf("%-10s %-8s %-6s: %.2f ulp\n", name, hs_isa_names[isa], hs_precision_names[precision], worst);
        ck_assert_msg(worst <= largest[precision], "%s, %s, %s: %g ulp at %.17g", name, hs_isa_names[isa],
                      hs_precision_names[precision], worst, at);
    }
}

#define CHECK(name, exact, largest, precision) check(#name, offsetof(vector_math, name), exact, largest, precision)

/** N numbers from lo to hi, not evenly spaced in binary. */
static void fill(double lo, double hi)
{
    for (int k = 0; k < N; ++k) x[k] = lo + (hi - lo) * ((k + 0.5) / N);
}

START_TEST(exponential)
{
    static const double largest[] = {1.0, 1.0};
    fill(-1.0, 1.0);
    CHECK(exp, expl, largest, HS_PRECISION_DOUBLE);
    CHECK(exp, expl, largest, HS_PRECISION_MIXED);
    fill(-746.5, 710.5);
    CHECK(exp, expl, largest, HS_PRECISION_DOUBLE);
    fill(-104.5, 89.2);
    CHECK(exp, expl, largest, HS_PRECISION_MIXED);
    for (int k = 0; k < N; ++k) x[k] = ldexp(k % 2 ? 1.3 : -1.3, -k % 1070);
    CHECK(exp, expl, largest, HS_PRECISION_DOUBLE);
    CHECK(exp, expl, largest, HS_PRECISION_MIXED);
}
END_TEST

START_TEST(logarithm)
{
    static const double largest[] = {2.0, 2.0};
    static const double range[][2] = {{0.01, 0.5}, {0.5, 1.0}, {0.9, 1.1}, {1.0, 2.0}, {1.0, 1000.0}};
    for (int p = 0; p < N_WIDTHS; ++p)
        for (size_t k = 0; k < sizeof range / sizeof range[0]; ++k) {
            fill(range[k][0], range[k][1]);
            CHECK(log, logl, largest, (hs_precision)p);
        }
    for (int p = 0; p < N_WIDTHS; ++p) { /* all normal numbers */
        for (int k = 0; k < N; ++k) x[k] = ldexp(1.0 + (k % 97) / 97.0, k % (p ? 250 : 2000) - (p ? 125 : 1000));
        CHECK(log, logl, largest, (hs_precision)p);
    }
}
END_TEST

START_TEST(sine_and_cosine)
{
    static const double largest[] = {2.0, 2.0};
    static const double limit[N_WIDTHS] = {0x1p50, 0x1p21};
    for (int p = 0; p < N_WIDTHS; ++p)
        for (double range = 0.5; range <= limit[p]; range *= range < 4.0 ? 2.0 : 977.0) {
            fill(-range, range);
            CHECK(sinpi, exact_sinpi, largest, (hs_precision)p);
            CHECK(cospi, exact_cospi, largest, (hs_precision)p);
        }
    for (int p = 0; p < N_WIDTHS; ++p) {
        for (int k = 0; k < N; ++k) x[k] = ldexp(k % 2 ? 1.7 : -1.7, -k % (p ? 120 : 1000)); /* the smallest, too */
        CHECK(sinpi, exact_sinpi, largest, (hs_precision)p);
        for (int k = 0; k < N; ++k)
            x[k] = 0.5 + ldexp(k % 2 ? 0.7 : -0.7, -k % (p ? 24 : 52)); /* close to the zero of cosine */
        CHECK(cospi, exact_cospi, largest, (hs_precision)p);
    }
}
END_TEST

START_TEST(no_numbers_and_infinities)
{
    const double inputs[8] = {NAN, INFINITY, -INFINITY, 1e300, -1e300, 0.0, -0.0, 1.0};
    for (int k = 0; k < 16; ++k) x[k] = inputs[k % 8];
    for (int isa = 0; isa <= (int)hs_isa_best(); ++isa)
        for (int p = 0; p < N_WIDTHS; ++p) {
            const vector_math *set = sets[isa][p];
            set->exp(x, y, 16);
            ck_assert(isnan(y[0]) && isinf(y[1]) && y[1] > 0.0 && y[2] == 0.0 && isinf(y[3]) && y[4] == 0.0);
            ck_assert(y[5] == 1.0 && y[6] == 1.0);
            set->sinpi(x, y, 16);
            ck_assert(isnan(y[0]) && y[5] == 0.0 && y[7] == 0.0 && y[6] == 0.0);
            set->cospi(x, y, 16);
            ck_assert(isnan(y[0]) && y[5] == 1.0 && y[7] == -1.0);
            set->min_one(x, y, 16);
            ck_assert(isnan(y[0]) && y[1] == 1.0 && isinf(y[2]) && y[5] == 0.0);
            set->max_one(x, y, 16);
            ck_assert(isnan(y[0]) && isinf(y[1]) && y[2] == 1.0 && y[5] == 1.0);
        }
}
END_TEST

HS_TEST_MAIN("vector math", exponential, logarithm, sine_and_cosine, no_numbers_and_infinities)
