#include "core/cubic_spline.h"

#include "base/memory.h"

/* At each inner knot the slopes of both pieces agree, which couples the second derivatives b of three neighbors:
 *     h_- b_- + 2 (h_- + h_+) b + h_+ b_+ = 6 (s_+ - s_-),   h: widths, s: slopes of the chords;
 * at an end the missing chord's slope is the given one, and its width is 0. Gaussian elimination goes down and up once. */
hs_status hs_spline_fit(hs_spline *spline, int n, const double *x, const double *y, double slope_first,
                        double slope_last, hs_error *err)
{
    double *above = NULL; /* of a knot's row after elimination: b = bend - above * b_+ */
    *spline = (hs_spline){.n = n, .x = x, .y = y};
    HS_TRY(HS_ALLOC(spline->bend, (size_t)n, err));
    hs_status status = HS_ALLOC(above, (size_t)n, err);
    if (status != HS_OK) {
        hs_spline_fini(spline);
        return status;
    }
    double *b = spline->bend, width = 0.0, chord = slope_first;
    for (int k = 0; k < n; ++k) {
        const double next_width = k < n - 1 ? x[k + 1] - x[k] : 0.0,
                     next_chord = k < n - 1 ? (y[k + 1] - y[k]) / next_width : slope_last;
        const double pivot = 2.0 * (width + next_width) - (k > 0 ? width * above[k - 1] : 0.0);
        b[k] = (6.0 * (next_chord - chord) - (k > 0 ? width * b[k - 1] : 0.0)) / pivot;
        above[k] = next_width / pivot;
        width = next_width;
        chord = next_chord;
    }
    for (int k = n - 2; k >= 0; --k) b[k] -= above[k] * b[k + 1];
    HS_FREE(above);
    return HS_OK;
}

void hs_spline_piece(const hs_spline *spline, int k, double c[4])
{
    const double *y = spline->y, *b = spline->bend, width = spline->x[k + 1] - spline->x[k], w2 = width * width / 6.0;
    c[0] = y[k];
    c[1] = y[k + 1] - y[k] - w2 * (2.0 * b[k] + b[k + 1]);
    c[2] = 3.0 * w2 * b[k];
    c[3] = w2 * (b[k + 1] - b[k]);
}

double hs_spline_at(const hs_spline *spline, double x)
{
    int low = 0, high = spline->n - 1;
    while (high - low > 1) {
        const int middle = low + (high - low) / 2;
        if (spline->x[middle] > x)
            high = middle;
        else
            low = middle;
    }
    double c[4];
    hs_spline_piece(spline, low, c);
    const double t = (x - spline->x[low]) / (spline->x[low + 1] - spline->x[low]);
    return c[0] + t * (c[1] + t * (c[2] + t * c[3]));
}

void hs_spline_fini(hs_spline *spline)
{
    HS_FREE(spline->bend);
    *spline = (hs_spline){.n = 0};
}
