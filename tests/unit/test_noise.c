/* Counter-based noise: Philox's published answers, the same bits from every instruction set, and the distribution. */
#include <math.h>
#include <stdlib.h>

#include "core/noise_formulas.h"
#include "kernel/noise_fill.h"
#include "support/harness.h"

/** Known answers for philox4x32-10, as shipped with Random123 (file kat_vectors). */
START_TEST(test_known_answers)
{
    static const struct {
        uint32_t counter[4], key[2], word[4];
    } known[] = {
        {{0, 0, 0, 0}, {0, 0}, {0x6627e8d5u, 0xe169c58du, 0xbc57ac4cu, 0x9b00dbd8u}},
        {{0xffffffffu, 0xffffffffu, 0xffffffffu, 0xffffffffu},
         {0xffffffffu, 0xffffffffu},
         {0x408f276du, 0x41c83b0eu, 0xa20bc7c6u, 0x6d5451fdu}},
        {{0x243f6a88u, 0x85a308d3u, 0x13198a2eu, 0x03707344u},
         {0xa4093822u, 0x299f31d0u},
         {0xd16cfe09u, 0x94fdccebu, 0x5001e420u, 0x24126ea1u}},
    };
    for (size_t k = 0; k < sizeof known / sizeof *known; ++k) {
        const uint32_t *c = known[k].counter;
        const int64_t id = (int64_t)((uint64_t)c[1] << 32 | c[0]), step = (int64_t)(c[3] & 0xffffffu) << 32 | c[2];
        uint32_t word[HS_NOISE_NUMBERS];
        hs_noise_words((hs_noise){known[k].key[0], known[k].key[1]}, step, (int)(c[3] >> 24), id, word);
        for (int i = 0; i < HS_NOISE_NUMBERS; ++i) ck_assert_uint_eq(word[i], known[k].word[i]);
    }
}
END_TEST

/** Blocks of every length from every instruction set of this machine equal the numbers made one by one, bit for bit. */
START_TEST(test_blocks_equal_single_numbers)
{
    static hs_noise_block block;
    int64_t id[HS_NOISE_BLOCK + 16];
    const hs_noise noise = hs_noise_open(20240229, "fix test 1");
    const int64_t step = (INT64_C(1) << 40) + 12345;
    for (int i = 0; i < HS_NOISE_BLOCK + 16; ++i) id[i] = i % 3 == 0 ? (INT64_C(1) << 33) + i : 7 * i + 1;
    for (hs_isa isa = 0; isa < HS_N_ISAS; ++isa) {
        hs_error err = {0};
        if (hs_isa_get(hs_isa_names[isa], &isa, &err) != HS_OK) continue;
        for (int kind = 0; kind < 2; ++kind)
            for (int n = 1; n <= HS_NOISE_BLOCK; n += n < 20 ? 1 : 59) {
                const int n_numbers = 1 + n % HS_NOISE_NUMBERS;
                hs_isa_noise(isa)->fill(noise, (hs_noise_kind)kind, step, n % 5, n_numbers, id, n, &block);
                for (int i = 0; i < n; ++i) {
                    double single[HS_NOISE_NUMBERS];
                    hs_noise_numbers(noise, (hs_noise_kind)kind, step, n % 5, id[i], single);
                    for (int k = 0; k < n_numbers; ++k)
                        ck_assert_msg(single[k] == block.number[k][i], "%s, kind %d, n %d, atom %d, number %d",
                                      hs_isa_names[isa], kind, n, i, k);
                }
            }
    }
}
END_TEST

/** Logarithm, sine and cosine against the C library: a few units of the last digit. */
START_TEST(test_functions)
{
    for (int k = 0; k < 100000; ++k) {
        uint32_t word[HS_NOISE_NUMBERS];
        double sine, cosine;
        hs_noise_words((hs_noise){1, 2}, k, 0, 1, word);
        const double x = (double)word[0] + 0.5, angle = ((double)word[1] - 0x1p31) * (k % 2 ? 1e-9 : 1e-4);
        ck_assert_double_eq_tol(hs_log_of_fraction(x), log(x * 0x1p-32), 4e-16 * fmax(0.5, fabs(log(x * 0x1p-32))));
        hs_sincos(angle, &sine, &cosine);
        /* the argument's reduction loses 2^-86 of the number of turns, the series two units of the last digit */
        ck_assert_double_eq_tol(sine, sin(angle), 4e-16);
        ck_assert_double_eq_tol(cosine, cos(angle), 4e-16);
        ck_assert_double_eq_tol(sine * sine + cosine * cosine, 1.0, 8e-16);
    }
    for (int k = -999; k <= 999; k += 2) {
        const double angle = HS_SMALL_ANGLE * k / 999;
        double sine, cosine;
        hs_sincos_small(angle, &sine, &cosine);
        ck_assert_double_eq_tol(sine, sin(angle), 2.3e-16 * fabs(angle)); /* two units of its last digit, at most */
        ck_assert_double_eq_tol(cosine, cos(angle), 2.3e-16);
    }
    ck_assert_double_eq_tol(hs_log_of_fraction(0x1p32 - 0.5), log1p(-0x1p-33), 1e-26);
}
END_TEST

static int by_value(const void *a, const void *b)
{
    const double p = *(const double *)a, q = *(const double *)b;
    return (p > q) - (p < q);
}

/** Distribution function. */
static double fraction_below(hs_noise_kind kind, double x)
{
    if (kind == HS_NOISE_GAUSSIAN) return 0.5 * erfc(-x / sqrt(2.0));
    return fmin(1.0, fmax(0.0, 0.5 + x / (2.0 * sqrt(3.0))));
}

/** Fill n numbers of atoms 1 .. n / 4. */
static double *draw_numbers(hs_noise_kind kind, int n, int64_t step, const char *stream)
{
    double *number = calloc((size_t)n, sizeof *number);
    for (int i = 0; i < n / HS_NOISE_NUMBERS; ++i)
        hs_noise_numbers(hs_noise_open(4711, stream), kind, step, 0, i + 1, number + HS_NOISE_NUMBERS * i);
    return number;
}

static double mean_product(const double *a, const double *b, int n)
{
    double sum = 0.0;
    for (int i = 0; i < n; ++i) sum += a[i] * b[i];
    return sum / n;
}

/** Moments within 4 standard errors (1 in 16000 by chance, and the numbers are always the same), and the
 *  Kolmogorov-Smirnov distance below its 0.1 % limit 1.95/sqrt(n). */
START_TEST(test_distribution)
{
    enum { N = 400000 };
    for (int kind = 0; kind < 2; ++kind) {
        double *a = draw_numbers((hs_noise_kind)kind, N, 10, "one"), sum[5] = {0};
        for (int i = 0; i < N; ++i)
            for (int p = 1; p < 5; ++p) sum[p] += pow(a[i], p) / N;
        /* variances of x, x^2, x^3, x^4: from the moments 1, 9/5, 27/7, 9 of the uniform, 1, 3, 15, 105 of the normal
         * one */
        const double fourth = kind == HS_NOISE_UNIFORM ? 1.8 : 3.0,
                     sixth = kind == HS_NOISE_UNIFORM ? 27.0 / 7.0 : 15.0,
                     eighth = kind == HS_NOISE_UNIFORM ? 9.0 : 105.0;
        ck_assert_double_eq_tol(sum[1], 0.0, 4.0 * sqrt(1.0 / N));
        ck_assert_double_eq_tol(sum[2], 1.0, 4.0 * sqrt((fourth - 1.0) / N));
        ck_assert_double_eq_tol(sum[3], 0.0, 4.0 * sqrt(sixth / N));
        ck_assert_double_eq_tol(sum[4], fourth, 4.0 * sqrt((eighth - fourth * fourth) / N));
        qsort(a, N, sizeof *a, by_value);
        double distance = 0.0;
        for (int i = 0; i < N; ++i)
            distance = fmax(distance, fabs(fraction_below((hs_noise_kind)kind, a[i]) - (i + 0.5) / N));
        ck_assert_double_lt(distance, 1.95 / sqrt(N));
        free(a);
    }
}
END_TEST

/** Neighboring atoms, steps, streams, and numbers of one draw do not know of each other. */
START_TEST(test_independence)
{
    enum { N = 400000 };
    double *a = draw_numbers(HS_NOISE_GAUSSIAN, N, 10, "one"), *next = draw_numbers(HS_NOISE_GAUSSIAN, N, 11, "one"),
           *other = draw_numbers(HS_NOISE_GAUSSIAN, N, 10, "two");
    const double limit = 4.0 / sqrt(N);
    ck_assert_double_eq_tol(mean_product(a, next, N), 0.0, limit);
    ck_assert_double_eq_tol(mean_product(a, other, N), 0.0, limit);
    for (int lag = 1; lag <= 8; ++lag) ck_assert_double_eq_tol(mean_product(a, a + lag, N - lag), 0.0, limit);
    free(a), free(next), free(other);
}
END_TEST

HS_TEST_MAIN("noise", test_known_answers, test_blocks_equal_single_numbers, test_functions, test_distribution,
             test_independence)
