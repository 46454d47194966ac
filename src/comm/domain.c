#include "comm/domain.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"

void hs_domain_init(hs_domain *domain, const hs_parallel *parallel)
{
    memset(domain, 0, sizeof *domain);
    domain->rank = parallel->rank;
    domain->n_ranks = parallel->n_ranks > 1 ? parallel->n_ranks : 1;
}

void hs_domain_fini(hs_domain *domain)
{
    for (int axis = 0; axis < 3; ++axis) HS_FREE(domain->cut[axis]);
}

/** Area (in 2D length) of the faces between bricks, per brick: what halos are proportional to. */
static double surface(const hs_box *box, const int n[3])
{
    if (box->is_tilted) {
        const double volume = hs_box_volume(box) / ((double)n[0] * n[1] * n[2]);
        double area = 0.0;
        for (int axis = 0; axis < box->dimension; ++axis) area += volume / (hs_box_thickness(box, axis) / n[axis]);
        return area;
    }
    const double x = hs_box_length(box, 0) / n[0], y = hs_box_length(box, 1) / n[1], z = hs_box_length(box, 2) / n[2];
    return box->dimension == 2 ? x + y : x * y + y * z + x * z;
}

static bool is_allowed(const hs_domain *domain, const hs_box *box, const int n[3])
{
    for (int axis = 0; axis < 3; ++axis)
        if (domain->wanted[axis] > 0 && n[axis] != domain->wanted[axis]) return false;
    return box->dimension == 3 || n[2] == 1;
}

/** The allowed grid of least surface. When several are equal, the one with the fewest cuts across z, then y: columns of cells,
 *  which stand along z, stay long. */
static bool choose_grid(hs_domain *domain, const hs_box *box)
{
    double least = INFINITY;
    for (int nz = 1; nz <= domain->n_ranks; ++nz) {
        if (domain->n_ranks % nz != 0) continue;
        const int rest = domain->n_ranks / nz;
        for (int ny = 1; ny <= rest; ++ny) {
            const int n[3] = {rest / ny, ny, nz};
            if (rest % ny != 0 || !is_allowed(domain, box, n)) continue;
            const double area = surface(box, n);
            if (area >= least * (1.0 - 1e-12)) continue;
            least = area;
            memcpy(domain->n, n, sizeof n);
        }
    }
    return least < INFINITY;
}

hs_status hs_domain_divide(hs_domain *domain, const hs_box *box, hs_error *err)
{
    if (!choose_grid(domain, box))
        return hs_fail(err, HS_ERROR_INPUT, "processors: no grid of bricks that was asked for has %d ranks",
                       domain->n_ranks);
    domain->at[2] = domain->rank % domain->n[2];
    domain->at[1] = domain->rank / domain->n[2] % domain->n[1];
    domain->at[0] = domain->rank / domain->n[2] / domain->n[1];
    for (int axis = 0; axis < 3; ++axis) {
        const int n = domain->n[axis];
        HS_TRY(HS_GROW(domain->cut[axis], 0, (size_t)n + 1, err));
        for (int k = 0; k <= n; ++k) domain->cut[axis][k] = (double)k / n;
    }
    return HS_OK;
}

/** How many boxes away brick k is, and its number within its box. */
static int boxes_away(int k, int n, int *within)
{
    const int away = k >= 0 ? k / n : -((n - 1 - k) / n);
    *within = k - away * n;
    return away;
}

double hs_domain_plane(const hs_domain *domain, const hs_box *box, int axis, int k)
{
    const int n = domain->n[axis];
    int within;
    if (k == n) return box->hi[axis];
    const double length = hs_box_length(box, axis), away = boxes_away(k, n, &within);
    return box->lo[axis] + domain->cut[axis][within] * length + away * length;
}

void hs_domain_brick(const hs_domain *domain, const hs_box *box, double lo[3], double hi[3])
{
    for (int axis = 0; axis < 3; ++axis) {
        lo[axis] = hs_domain_plane(domain, box, axis, domain->at[axis]);
        hi[axis] = hs_domain_plane(domain, box, axis, domain->at[axis] + 1);
    }
    if (!box->is_tilted) return;
    /* the brick is a small box of the same shape: its edges are those of the box, times its part of them */
    hs_box brick = *box;
    double corner[3], size[3];
    for (int axis = 0; axis < 3; ++axis) {
        corner[axis] = (lo[axis] - box->lo[axis]) / hs_box_length(box, axis);
        size[axis] = (hi[axis] - lo[axis]) / hs_box_length(box, axis);
    }
    hs_box_place(box, corner, brick.lo);
    for (int axis = 0; axis < 3; ++axis) brick.hi[axis] = brick.lo[axis] + (hi[axis] - lo[axis]);
    brick.tilt[0] *= size[1];
    brick.tilt[1] *= size[2];
    brick.tilt[2] *= size[2];
    hs_box_bounds(&brick, lo, hi);
}

double hs_domain_volume(const hs_domain *domain, const hs_box *box)
{
    double part = 1.0;
    for (int axis = 0; axis < box->dimension; ++axis) {
        const double *cut = domain->cut[axis] + domain->at[axis];
        part *= cut[1] - cut[0];
    }
    return part * hs_box_volume(box);
}

int hs_domain_owner(const hs_domain *domain, const hs_box *box, int axis, double x)
{
    int lo = 0, hi = domain->n[axis];
    while (hi - lo > 1) {
        const int middle = lo + (hi - lo) / 2;
        if (x >= hs_domain_plane(domain, box, axis, middle))
            lo = middle;
        else
            hi = middle;
    }
    return lo;
}

bool hs_domain_owns(const hs_domain *domain, const hs_box *box, const double x[3])
{
    for (int axis = 0; axis < 3; ++axis)
        if (domain->n[axis] > 1 && hs_domain_owner(domain, box, axis, hs_box_upright(box, x, axis)) != domain->at[axis])
            return false;
    return true;
}

int hs_domain_rank(const hs_domain *domain, const int at[3])
{
    int within[3];
    for (int axis = 0; axis < 3; ++axis) (void)boxes_away(at[axis], domain->n[axis], &within[axis]);
    return (within[0] * domain->n[1] + within[1]) * domain->n[2] + within[2];
}
