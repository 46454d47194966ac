/* Density modes by a non-uniform fast Fourier transform: see core/fourier.h. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "core/fft_plan.h"
#include "core/fourier.h"
#include "parallel/parallel.h"

enum { WIDTH = 14, FINENESS = 2, QUADRATURE = 2000 };
static const double beta = 2.30 * WIDTH; /* for a grid twice as fine as needed */

/** A point of the grid: a multiple of 2^-bits while points are spread, then a number for the transform. */
typedef union grid_value {
    int64_t fixed;
    double real;
} grid_value;

struct hs_modes {
    int n_max[3], size[3]; /**< modes wanted; grid points, 1 along axes without modes */
    grid_value *grid;      /**< owned [size0 size1 size2] */
    double scale;          /**< of fixed values: 2^bits */
    fftw_complex *out;     /**< owned [size0 size1 (size2 / 2 + 1)] */
    fftw_plan plan;
    double *inverse[3]; /**< owned [n_max + 1]: 1 / transform of the kernel */
};

static double kernel(double z)
{
    const double s = 1.0 - z * z;
    return s > 0.0 ? exp(beta * (sqrt(s) - 1.0)) : 0.0;
}

/** Next number that has the factors 2, 3 and 5 only, and is even. */
static int next_smooth(int n)
{
    for (n += n & 1;; n += 2) {
        int rest = n;
        for (int p = 2; p <= 5; p += p == 2 ? 1 : 2)
            while (rest % p == 0) rest /= p;
        if (rest == 1) return n;
    }
}

/** Transform of the kernel, by the trapezoidal rule: at its ends the kernel is as good as 0. */
static hs_status invert_kernel(hs_modes *m, int axis, hs_error *err)
{
    HS_TRY(HS_ALLOC(m->inverse[axis], (size_t)m->n_max[axis] + 1, err));
    for (int n = 0; n <= m->n_max[axis]; ++n) {
        double sum = 0.0;
        for (int q = -QUADRATURE + 1; q < QUADRATURE; ++q) {
            const double z = (double)q / QUADRATURE;
            sum += kernel(z) * cos(M_PI * n * WIDTH * z / m->size[axis]);
        }
        m->inverse[axis][n] = m->size[axis] == 1 ? 1.0 : 1.0 / (0.5 * WIDTH * sum / QUADRATURE);
    }
    return HS_OK;
}

static hs_status allocate(hs_modes *m, hs_error *err)
{
    double n_points = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
        const int least = FINENESS * (2 * m->n_max[axis] + 1);
        m->size[axis] = m->n_max[axis] == 0 ? 1 : next_smooth(least > 2 * WIDTH ? least : 2 * WIDTH);
        n_points *= m->size[axis];
        HS_TRY(invert_kernel(m, axis, err));
    }
    if (n_points > 2e9 || n_points * 16.0 > (double)hs_memory_physical())
        return hs_fail(
            err, HS_ERROR_INPUT,
            "density modes up to (%d %d %d) need a grid of %d x %d x %d points, more than this machine can hold: "
            "choose a lower wave number",
            m->n_max[0], m->n_max[1], m->n_max[2], m->size[0], m->size[1], m->size[2]);
    const size_t rows = (size_t)m->size[0] * (size_t)m->size[1];
    HS_TRY(HS_ALLOC(m->grid, rows * (size_t)m->size[2], err));
    HS_TRY(hs_memory_alloc((void **)&m->out, rows * ((size_t)m->size[2] / 2 + 1), sizeof(fftw_complex), err));
    m->plan = hs_fft_plan_forward(3, m->size, &m->grid->real, m->out);
    if (m->plan != NULL) return HS_OK;
    return hs_fail(err, HS_ERROR_MEMORY, "FFTW could not plan a transform of %d x %d x %d numbers", m->size[0],
                   m->size[1], m->size[2]);
}

hs_status hs_modes_create(hs_modes **modes, const int n_max[3], hs_error *err)
{
    HS_TRY(HS_ALLOC(*modes, 1, err));
    memcpy((*modes)->n_max, n_max, sizeof(*modes)->n_max);
    const hs_status status = allocate(*modes, err);
    if (status != HS_OK) hs_modes_destroy(modes);
    return status;
}

void hs_modes_destroy(hs_modes **modes)
{
    hs_modes *m = *modes;
    if (m == NULL) return;
    hs_fft_plan_destroy(&m->plan);
    HS_FREE(m->grid);
    HS_FREE(m->out);
    for (int axis = 0; axis < 3; ++axis) HS_FREE(m->inverse[axis]);
    HS_FREE(*modes);
}

/** Grid points and weights of one point along an axis; returns how many. */
static int weigh(const hs_modes *m, int axis, double x, int *point, double *weight)
{
    const int size = m->size[axis];
    if (size == 1) {
        point[0] = 0;
        weight[0] = 1.0;
        return 1;
    }
    double at = (x - floor(x)) * size;
    if (at >= size) at = 0.0; /* a hair below 0 rounds to the upper end */
    const int first = (int)ceil(at - 0.5 * WIDTH);
    for (int k = 0; k < WIDTH; ++k) {
        point[k] = (first + k + size) % size;
        weight[k] = kernel((first + k - at) * (2.0 / WIDTH));
    }
    return WIDTH;
}

/** The nearest whole number, for |x| up to 2^51: the sum's last bit stands for 1. */
static inline int64_t to_fixed(double x)
{
    const grid_value magic = {.real = 0x1.8p52}, sum = {.real = x + magic.real};
    return sum.fixed - magic.fixed;
}

/** Spread a point over the planes [begin, end) of the first axis. */
static void spread_point(hs_modes *m, const double x[3], int begin, int end)
{
    int point[3][WIDTH], n[3];
    double weight[3][WIDTH];
    n[0] = weigh(m, 0, x[0], point[0], weight[0]);
    bool is_near = false;
    for (int a = 0; a < n[0]; ++a) is_near |= point[0][a] >= begin && point[0][a] < end;
    if (!is_near) return;
    n[1] = weigh(m, 1, x[1], point[1], weight[1]);
    n[2] = weigh(m, 2, x[2], point[2], weight[2]);
    for (int a = 0; a < n[0]; ++a) {
        if (point[0][a] < begin || point[0][a] >= end) continue;
        for (int b = 0; b < n[1]; ++b) {
            grid_value *row =
                m->grid + ((size_t)point[0][a] * (size_t)m->size[1] + (size_t)point[1][b]) * (size_t)m->size[2];
            const double w = weight[0][a] * weight[1][b] * m->scale;
            for (int c = 0; c < n[2]; ++c) row[point[2][c]].fixed += to_fixed(w * weight[2][c]);
        }
    }
}

void hs_modes_spread(hs_modes *m, int n, const double *const x[3], const uint32_t *mask, uint32_t wanted, int64_t n_all)
{
    /* no weight is above 1: the sum of all points' stays below 2^62, one weight below 2^51 */
    const int bits = 61 - ilogb((double)n_all + 1.0);
    m->scale = ldexp(1.0, bits < 50 ? bits : 50);
    memset(m->grid, 0, (size_t)m->size[0] * (size_t)m->size[1] * (size_t)m->size[2] * sizeof *m->grid);
#pragma omp parallel
    {
        /* each thread its own planes, points in their order: no grid point has two writers */
        int64_t begin, end;
        hs_thread_range(m->size[0], 1, hs_thread_number(), hs_thread_count(), &begin, &end);
        for (int i = 0; i < n && begin < end; ++i) {
            const double at[3] = {x[0][i], x[1][i], x[2][i]};
            if (mask[i] & wanted) spread_point(m, at, (int)begin, (int)end);
        }
    }
}

int64_t *hs_modes_grid(hs_modes *m, int64_t *n)
{
    *n = (int64_t)m->size[0] * m->size[1] * m->size[2];
    return &m->grid->fixed;
}

void hs_modes_transform(hs_modes *m)
{
    const int64_t n = (int64_t)m->size[0] * m->size[1] * m->size[2];
    const double unit = 1.0 / m->scale;
#pragma omp parallel for schedule(static)
    for (int64_t k = 0; k < n; ++k) m->grid[k].real = unit * (double)m->grid[k].fixed;
    fftw_execute(m->plan);
}

double complex hs_modes_get(const hs_modes *m, int n0, int n1, int n2)
{
    /* the grid is real: the half with negative n2 is the conjugate of the other */
    const bool is_conjugate = n2 < 0;
    if (is_conjugate) n0 = -n0, n1 = -n1, n2 = -n2;
    const double scale = m->inverse[0][n0 < 0 ? -n0 : n0] * m->inverse[1][n1 < 0 ? -n1 : n1] * m->inverse[2][n2];
    const size_t p0 = (size_t)((n0 + m->size[0]) % m->size[0]), p1 = (size_t)((n1 + m->size[1]) % m->size[1]);
    const fftw_complex *value = &m->out[(p0 * (size_t)m->size[1] + p1) * ((size_t)m->size[2] / 2 + 1) + (size_t)n2];
    return scale * ((*value)[0] + (is_conjugate ? -1.0 : 1.0) * (*value)[1] * I);
}
