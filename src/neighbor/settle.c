/* One pass over the positions after the drift: rounding, displacements, flatness. Maxima are taken of bit patterns, which compilers turn
 * into vector code; for doubles they would have to heed nan. */
#include "neighbor/settle.h"

#include <string.h>

static inline uint64_t bits_of(double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

static inline __attribute__((always_inline)) void pass(const hs_settle_input *in, int begin, int end,
                                                       hs_settle_result *result, const bool is_rounded,
                                                       const bool is_flat, const bool is_planar)
{
    double *restrict x = in->x[0], *restrict y = in->x[1], *restrict z = in->x[2];
    const double *restrict x0 = in->listed[0], *restrict y0 = in->listed[1], *restrict z0 = in->listed[2];
    const double magic = in->magic;
    uint64_t largest = result->displacement2, highest = result->z;
    for (int i = begin; i < end; ++i) {
        /* all loads before the first store: arrays that begin at the same place of a page would make loads wait for it */
        const double z_old = is_planar ? 0.0 : z[i];
        const double x_now = is_rounded ? (x[i] + magic) - magic : x[i],
                     y_now = is_rounded ? (y[i] + magic) - magic : y[i],
                     z_now = is_rounded && !is_flat ? (z_old + magic) - magic : z_old;
        const double dx = x_now - x0[i], dy = y_now - y0[i], dz = is_flat ? z_now : z_now - z0[i];
        if (is_rounded) {
            x[i] = x_now;
            y[i] = y_now;
            if (!is_flat) z[i] = z_now;
        }
        const uint64_t d2 = bits_of(dx * dx + dy * dy + dz * dz);
        largest = d2 > largest ? d2 : largest;
        if (is_flat && !is_planar) highest |= bits_of(z_now) & INT64_MAX;
    }
    result->displacement2 = largest;
    result->z = highest;
}

static inline __attribute__((always_inline)) void pass_rounding(const hs_settle_input *in, int begin, int end,
                                                                hs_settle_result *result, const bool is_flat,
                                                                const bool is_planar)
{
    if (in->magic != 0.0)
        pass(in, begin, end, result, true, is_flat, is_planar);
    else
        pass(in, begin, end, result, false, is_flat, is_planar);
}

static void settle(const hs_settle_input *in, int begin, int end, hs_settle_result *result)
{
    if (in->is_flat && in->is_planar)
        pass_rounding(in, begin, end, result, true, true);
    else if (in->is_flat)
        pass_rounding(in, begin, end, result, true, false);
    else
        pass_rounding(in, begin, end, result, false, false);
}

#define PASTE_(a, b) a##b
#define PASTE(a, b)  PASTE_(a, b)
const hs_settle PASTE(hs_settle_, HS_KERNEL_ISA) = settle;
