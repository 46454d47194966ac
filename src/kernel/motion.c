/* Motion of atoms without inertia, and forces out of fixed point; compiled for every instruction set. */
#include "kernel/motion.h"

#include "core/noise_formulas.h"

static inline __attribute__((always_inline)) void move(const hs_overdamped *motion, int n,
                                                       const uint32_t *restrict group, uint32_t mask,
                                                       const double *restrict f, const double *restrict noise,
                                                       double *restrict x, double *restrict v, const bool is_all)
{
    const double drift = motion->drift, kick = motion->kick, dt = motion->dt, magic = motion->magic;
    for (int i = 0; i < n; ++i) {
        const bool is_moved = is_all || (group[i] & mask) != 0;
        const double v_old = v[i], v_new = drift * f[i] + kick * noise[i];
        const double x_old = x[i], x_new = x_old + ((dt * v_new + magic) - magic); /* as hs_moved */
        /* after all loads: arrays that begin at the same place of a page would make them wait */
        v[i] = is_moved ? v_new : v_old;
        x[i] = is_moved ? x_new : x_old;
    }
}

static void translate(const hs_overdamped *motion, int n, const uint32_t *group, uint32_t mask, const double *f,
                      const double *noise, double *x, double *v)
{
    if (group == NULL)
        move(motion, n, group, mask, f, noise, x, v, true);
    else
        move(motion, n, group, mask, f, noise, x, v, false);
}

static inline __attribute__((always_inline)) void turn_by(double turn, int n, const uint32_t *restrict group,
                                                          uint32_t mask, const double *restrict noise,
                                                          double *restrict x, double *restrict y, const bool is_all,
                                                          const bool is_small)
{
    for (int i = 0; i < n; ++i) {
        const bool is_turned = is_all || (group[i] & mask) != 0;
        const double a = x[i], b = y[i];
        double sine, cosine;
        if (is_small)
            hs_sincos_small(turn * noise[i], &sine, &cosine);
        else
            hs_sincos(turn * noise[i], &sine, &cosine);
        x[i] = is_turned ? cosine * a - sine * b : a;
        y[i] = is_turned ? sine * a + cosine * b : b;
    }
}

static void rotate(const hs_turning *turning, int n, const uint32_t *group, uint32_t mask, const double *noise,
                   double *x, double *y)
{
    const double turn = turning->turn;
    if (group == NULL && turning->is_small)
        turn_by(turn, n, group, mask, noise, x, y, true, true);
    else if (group == NULL)
        turn_by(turn, n, group, mask, noise, x, y, true, false);
    else if (turning->is_small)
        turn_by(turn, n, group, mask, noise, x, y, false, true);
    else
        turn_by(turn, n, group, mask, noise, x, y, false, false);
}

/** Not every set can convert 64-bit integers: two halves, each exact, are added with one rounding, as a conversion would. */
static inline double multiple_of(double unit, double integer)
{
    const uint64_t shifted = hs_bits_of(integer) ^ UINT64_C(1) << 63; /* the integer plus 2^63 */
    const double high = (hs_whole_number(shifted >> 32) - 0x1p31) * 0x1p32;
    return (high + hs_whole_number(shifted & UINT64_C(0xffffffff))) * unit;
}

static void settle_in_place(double *f, int64_t n, double unit)
{
    for (int64_t i = 0; i < n; ++i) f[i] = multiple_of(unit, f[i]);
}

static void settle_from(double *restrict f, const double *restrict from, int64_t n, double unit)
{
    for (int64_t i = 0; i < n; ++i) f[i] = multiple_of(unit, from[i]);
}

static void settle(double *f, const double *from, int64_t n, double unit)
{
    if (f == from)
        settle_in_place(f, n, unit);
    else
        settle_from(f, from, n, unit);
}

#define PASTE_(a, b) a##b
#define PASTE(a, b)  PASTE_(a, b)
const hs_motion_set PASTE(hs_motion_set_, HS_KERNEL_ISA) = {
    .translate = translate,
    .rotate = rotate,
    .settle = settle,
};
