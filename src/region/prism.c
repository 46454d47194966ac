#include <math.h>

#include "style/region.h"

typedef struct prism {
    double lo[3], hi[3];  /**< distance; of the untilted box */
    double xy, xz, yz;    /**< tilts, distance */
    double inverse[3][3]; /**< upper triangle: distance from lo to fractions of the edges */
} prism;

/** An unbounded axis must not be tilted. */
static hs_status check_tilt(const prism *p, const hs_args *args, hs_error *err)
{
    const struct {
        double tilt;
        int axis[2], word;
    } checks[3] = {{p->xy, {0, 1}, 6}, {p->xz, {0, 2}, 7}, {p->yz, {1, 2}, 8}};
    for (int k = 0; k < 3; ++k)
        for (int m = 0; m < 2; ++m) {
            const int axis = checks[k].axis[m];
            if (checks[k].tilt != 0.0 && (p->lo[axis] == -HS_REGION_FAR || p->hi[axis] == HS_REGION_FAR))
                return hs_fail(err, HS_ERROR_INPUT, "%s: the tilt %s needs bounds of %c other than INF", args->command,
                               args->word[checks[k].word], "xyz"[axis]);
        }
    return HS_OK;
}

static void set_geometry(hs_region *region, prism *p)
{
    const double lx = p->hi[0] - p->lo[0], ly = p->hi[1] - p->lo[1], lz = p->hi[2] - p->lo[2];
    p->inverse[0][0] = 1.0 / lx;
    p->inverse[0][1] = -p->xy / (lx * ly);
    p->inverse[0][2] = (p->xy * p->yz - ly * p->xz) / (lx * ly * lz);
    p->inverse[1][1] = 1.0 / ly;
    p->inverse[1][2] = -p->yz / (ly * lz);
    p->inverse[2][2] = 1.0 / lz;
    region->extent[0][0] = p->lo[0] + fmin(0.0, p->xy) + fmin(0.0, p->xz);
    region->extent[0][1] = p->hi[0] + fmax(0.0, p->xy) + fmax(0.0, p->xz);
    region->extent[1][0] = p->lo[1] + fmin(0.0, p->yz);
    region->extent[1][1] = p->hi[1] + fmax(0.0, p->yz);
    region->extent[2][0] = p->lo[2];
    region->extent[2][1] = p->hi[2];
    region->has_extent = true;
}

static hs_status create(hs_region *region, const hs_args *args, hs_error *err)
{
    prism *p = region->state;
    for (int axis = 0; axis < 3; ++axis) {
        HS_TRY(hs_region_bound(region, args, 2 * axis, axis, 0, &p->lo[axis], err));
        HS_TRY(hs_region_bound(region, args, 2 * axis + 1, axis, 1, &p->hi[axis], err));
        if (p->lo[axis] >= p->hi[axis])
            return hs_fail(err, HS_ERROR_INPUT, "%s: the lower bound of %c, %s, must be below the upper one, %s",
                           args->command, "xyz"[axis], args -> word[2 * axis], args -> word[2 * axis + 1]);
    }
    HS_TRY(hs_region_length(region, args, 6, 0, &p->xy, err));
    HS_TRY(hs_region_length(region, args, 7, 0, &p->xz, err));
    HS_TRY(hs_region_length(region, args, 8, 1, &p->yz, err));
    HS_TRY(check_tilt(p, args, err));
    set_geometry(region, p);
    region->is_prism = true;
    for (int axis = 0; axis < 3; ++axis) {
        region->prism_lo[axis] = p->lo[axis];
        region->prism_hi[axis] = p->hi[axis];
        region->prism_tilt[axis] = (const double[3]){p->xy, p->xz, p->yz}[axis];
    }
    return HS_OK;
}

static bool inside(const hs_region *region, const double x[3])
{
    const prism *p = region->state;
    const double d[3] = {x[0] - p->lo[0], x[1] - p->lo[1], x[2] - p->lo[2]};
    const double a = p->inverse[0][0] * d[0] + p->inverse[0][1] * d[1] + p->inverse[0][2] * d[2];
    const double b = p->inverse[1][1] * d[1] + p->inverse[1][2] * d[2];
    const double c = p->inverse[2][2] * d[2];
    return a >= 0.0 && a <= 1.0 && b >= 0.0 && b <= 1.0 && c >= 0.0 && c <= 1.0;
}

const hs_region_style hs_region_style_prism = {
    .about =
        {
            .name = "prism",
            .syntax = {"<xlo> <xhi> <ylo> <yhi> <zlo> <zhi> <xy> <xz> <yz> [keyword value ...]", 9, 9, NULL},
            .summary = "Parallelepiped: a block with tilted edges",
            .details =
                "A block with the bounds `xlo ... zhi` (lengths, `INF` or `EDGE`), whose second edge is tilted by `xy` "
                "along x, and\n"
                "whose third edge is tilted by `xz` along x and `yz` along y. Bounds are in lattice spacings of their "
                "axis, `xy`\n"
                "and `xz` in that of x, `yz` in that of y; all in distance units after `units box`. An axis that takes "
                "part in a\n"
                "tilt cannot be bounded by `INF`. `create_box` makes a tilted (triclinic) box of a prism.\n",
            .example = "region slab prism 0 10 0 10 0 10 2 0 0",
        },
    .state_size = sizeof(prism),
    .create = create,
    .inside = inside,
};
