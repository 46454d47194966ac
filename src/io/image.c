#include "io/image.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"

/* Samples: 39 bits of depth above 24 bits of colour; 0 in the upper part is the background. */
static const double depth_origin = 0x1p20; /* samples: nothing is drawn further away than this */
static const double depth_steps = 0x1p17;  /* to a sample */
enum { COLOR_BITS = 24, COLOR_MASK = 0xffffff, BAND_ROWS = 16 };

static int64_t make_sample(double z, hs_color color)
{
    double depth = (z + depth_origin) * depth_steps;
    const double most = 0x1p38;
    depth = depth < 1.0 ? 1.0 : depth > most ? most : depth;
    return (int64_t)depth << COLOR_BITS | (int64_t)color;
}

hs_status hs_image_init(hs_image *image, int width, int height, int sampling, hs_color background, hs_error *err)
{
    *image = (hs_image){.width = width, .height = height, .sampling = sampling, .shine = 1.0};
    const size_t n = (size_t)width * (size_t)height * (size_t)sampling * (size_t)sampling;
    const double needed = (double)n * sizeof *image->sample, there = (double)hs_memory_physical();
    if (there > 0.0 && needed > 0.5 * there)
        return hs_fail(err, HS_ERROR_MEMORY, "a picture of %d x %d pixels needs %.3g GB, more than half of the memory",
                       width, height, needed * 1e-9);
    HS_TRY(HS_ALLOC(image->sample, n, err));
    for (size_t k = 0; k < n; ++k) image->sample[k] = (int64_t)background;
    return HS_OK;
}

void hs_image_fini(hs_image *image) { HS_FREE(image->sample); }

static double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static void cross(const double a[3], const double b[3], double c[3])
{
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

static void normalize(double a[3])
{
    const double length = sqrt(dot(a, a));
    for (int k = 0; k < 3; ++k) a[k] /= length;
}

/** Half of the box's extent along a direction. */
static double half_extent(const hs_box *box, const double direction[3])
{
    double sum = 0.0;
    for (int axis = 0; axis < box->dimension; ++axis) {
        double edge[3];
        hs_box_shift(box, (const int32_t[3]){axis == 0, axis == 1, axis == 2}, edge);
        sum += 0.5 * fabs(dot(edge, direction));
    }
    return sum;
}

hs_image_view hs_image_look(const hs_image *image, const hs_box *box, double theta, double phi, const double up[3],
                            const double center[3], double zoom)
{
    const double degree = M_PI / 180.0, margin = 0.95; /* of the picture's edge; atoms stand out of the box a little */
    const double nearly_parallel = 1e-6;
    hs_image_view view;
    double *right = view.axis[0], *upward = view.axis[1], *toward = view.axis[2];
    toward[0] = sin(theta * degree) * cos(phi * degree);
    toward[1] = sin(theta * degree) * sin(phi * degree);
    toward[2] = cos(theta * degree);
    memcpy(upward, up, 3 * sizeof *up);
    normalize(upward);
    cross(upward, toward, right);
    if (dot(right, right) < nearly_parallel) { /* looking along "up": y is upwards then */
        const double y[3] = {0.0, 1.0, 0.0}, x[3] = {1.0, 0.0, 0.0};
        cross(fabs(toward[1]) < 0.9 ? y : x, toward, right);
    }
    normalize(right);
    cross(toward, right, upward);
    const double width = image->width * image->sampling, height = image->height * image->sampling;
    const double x = width / (2.0 * half_extent(box, right)), y = height / (2.0 * half_extent(box, upward));
    view.scale = zoom * margin * (x < y ? x : y);
    hs_box_place(box, center, view.center);
    view.middle[0] = 0.5 * width;
    view.middle[1] = 0.5 * height;
    return view;
}

void hs_image_project(const hs_image_view *view, const double x[3], double sample[3])
{
    const double d[3] = {x[0] - view->center[0], x[1] - view->center[1], x[2] - view->center[2]};
    sample[0] = view->middle[0] + view->scale * dot(view->axis[0], d);
    sample[1] = view->middle[1] - view->scale * dot(view->axis[1], d);
    sample[2] = view->scale * dot(view->axis[2], d);
}

/** Colour of a surface whose normal is n (y down, z to the viewer): a lamp at the upper left in front, a weak one from
 *  the right, some light from everywhere, and a highlight (Blinn 1977, doi:10.1145/965141.563893). */
static hs_color shade(const hs_image *image, hs_color color, const double n[3])
{
    static const double lamp[3] = {-0.408, -0.556, 0.724}, fill[3] = {0.766, 0.0, 0.643},
                        half[3] = {-0.22, -0.3, 0.928};
    const double ambient = 0.35, strength = 0.62, fill_strength = 0.12, highlight = 0.45;
    const double a = dot(n, lamp), b = dot(n, fill);
    double light = ambient + (a > 0.0 ? strength * a : 0.0) + (b > 0.0 ? fill_strength * b : 0.0);
    double gloss = dot(n, half);
    gloss = gloss > 0.0 ? gloss * gloss : 0.0;
    gloss *= gloss;
    gloss *= gloss;
    gloss *= gloss;
    gloss *= gloss; /* the 32nd power */
    light = light < 1.0 ? light : 1.0;
    const hs_color lit = hs_color_mix(0x000000, color, light);
    return hs_color_mix(lit, 0xffffff, highlight * image->shine * gloss);
}

/** Discs have a darker rim, so that neighbors of one colour stay apart; it is left out where discs are small. */
static hs_color flat_color(hs_color color, double distance, double radius)
{
    const double rim = 0.12, least_radius = 8.0, darkness = 0.35;
    if (radius < least_radius || distance < (1.0 - rim) * radius) return color;
    return hs_color_mix(color, 0x000000, darkness);
}

static void put(hs_image *image, int64_t *sample, double dx, double dy, double dz, double z, double radius,
                hs_color color)
{
    const double n[3] = {dx / radius, dy / radius, dz / radius};
    const hs_color seen = image->is_flat ? flat_color(color, sqrt(dx * dx + dy * dy), radius) : shade(image, color, n);
    const int64_t fresh = make_sample(z + dz, seen);
    if (fresh > *sample) *sample = fresh;
}

/** First and one after the last sample whose middle is within [lo, hi], cut to [begin, end). */
static void covered(double lo, double hi, int begin, int end, int *first, int *stop)
{
    const double from = ceil(lo - 0.5), to = floor(hi - 0.5);
    *first = from > begin ? (from < end ? (int)from : end) : begin;
    *stop = to < end - 1 ? (to >= begin ? (int)to + 1 : begin) : end;
}

/** The part of a ball that lies in the rows [begin, end). */
static void draw_ball(hs_image *image, const hs_image_ball *ball, int begin, int end)
{
    const int columns = image->width * image->sampling;
    const double r2 = ball->radius * ball->radius;
    int row, last_row;
    covered(ball->y - ball->radius, ball->y + ball->radius, begin, end, &row, &last_row);
    for (; row < last_row; ++row) {
        const double dy = row + 0.5 - ball->y, rest = r2 - dy * dy;
        if (rest <= 0.0) continue;
        int column, last_column;
        covered(ball->x - sqrt(rest), ball->x + sqrt(rest), 0, columns, &column, &last_column);
        int64_t *sample = image->sample + (size_t)row * (size_t)columns;
        for (; column < last_column; ++column) {
            const double dx = column + 0.5 - ball->x, dz2 = rest - dx * dx;
            if (dz2 >= 0.0) put(image, &sample[column], dx, dy, sqrt(dz2), ball->z, ball->radius, ball->color);
        }
    }
}

void hs_image_draw_balls(hs_image *image, const hs_image_ball *ball, int n)
{
    const int rows = image->height * image->sampling, n_bands = (rows + BAND_ROWS - 1) / BAND_ROWS;
#pragma omp parallel for schedule(static, 1)
    for (int band = 0; band < n_bands; ++band) {
        const int begin = band * BAND_ROWS, end = begin + BAND_ROWS < rows ? begin + BAND_ROWS : rows;
        for (int k = 0; k < n; ++k)
            if (ball[k].y + ball[k].radius >= begin && ball[k].y - ball[k].radius <= end)
                draw_ball(image, &ball[k], begin, end);
    }
}

/** The point of the stick's axis whose ball stands out furthest towards the viewer at a sample, as a part of the axis
 *  from 0 to 1: the maximum of from_z + t d_z + sqrt(R^2 - |w - t d|^2) over t, where w is the sample's place from the
 *  beginning and d the axis as seen. */
static double nearest_part(const double d[3], const double w[2], double radius)
{
    const double length2 = d[0] * d[0] + d[1] * d[1];
    if (length2 < 1e-12) return d[2] > 0.0 ? 1.0 : 0.0;
    const double along = w[0] * d[0] + w[1] * d[1];
    const double free2 = radius * radius - (w[0] * w[0] + w[1] * w[1] - along * along / length2);
    if (free2 < 0.0) return -1.0;
    const double t = (along + copysign(sqrt(d[2] * d[2] * free2 / (1.0 + d[2] * d[2] / length2)), d[2])) / length2;
    return t < 0.0 ? 0.0 : t > 1.0 ? 1.0 : t;
}

void hs_image_draw_stick(hs_image *image, const double from[3], const double to[3], double radius, hs_color color)
{
    const int rows = image->height * image->sampling, columns = image->width * image->sampling;
    const double d[3] = {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
    int row, last_row, first_column, last_column;
    covered(fmin(from[1], to[1]) - radius, fmax(from[1], to[1]) + radius, 0, rows, &row, &last_row);
    covered(fmin(from[0], to[0]) - radius, fmax(from[0], to[0]) + radius, 0, columns, &first_column, &last_column);
    for (; row < last_row; ++row)
        for (int column = first_column; column < last_column; ++column) {
            const double w[2] = {column + 0.5 - from[0], row + 0.5 - from[1]};
            const double t = nearest_part(d, w, radius);
            if (t < 0.0) continue;
            const double dx = w[0] - t * d[0], dy = w[1] - t * d[1], dz2 = radius * radius - dx * dx - dy * dy;
            if (dz2 >= 0.0)
                put(image, image->sample + (size_t)row * (size_t)columns + column, dx, dy, sqrt(dz2),
                    from[2] + t * d[2], radius, color);
        }
}

void hs_image_merge(hs_image *image, const hs_parallel *parallel)
{
    const size_t n_columns = (size_t)image->width * (size_t)image->sampling;
    for (int row = 0; row < image->height * image->sampling; ++row)
        hs_parallel_max_int64(parallel, image->sample + (size_t)row * n_columns, (int)n_columns);
}

hs_color hs_image_pixel(const hs_image *image, int column, int row)
{
    const int n = image->sampling, columns = image->width * n;
    int sum[3] = {0, 0, 0};
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const int64_t sample = image->sample[(size_t)(row * n + j) * (size_t)columns + (size_t)(column * n + i)];
            const hs_color color = (hs_color)(sample & COLOR_MASK);
            for (int k = 0; k < 3; ++k) sum[k] += (int)(color >> (16 - 8 * k) & 255);
        }
    hs_color mean = 0;
    for (int k = 0; k < 3; ++k) mean = mean << 8 | (hs_color)((sum[k] + n * n / 2) / (n * n));
    return mean;
}
