#include "core/lattice.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/memory.h"

const char *const hs_lattice_styles[] = {"none", "sc",  "bcc", "fcc",    "hcp", "diamond",
                                         "sq",   "sq2", "hex", "custom", NULL};

/** What a style's name stands for. Basis atoms are in the order in which LAMMPS numbers its atoms. */
typedef struct style_data {
    const char *name;
    int dimension; /**< 0: both */
    int n_basis;
    double basis[8][3];
} style_data;

static const style_data styles[] = {
    {"none", 0, 0, {{0.0}}},
    {"custom", 0, 0, {{0.0}}},
    {"sc", 3, 1, {{0.0, 0.0, 0.0}}},
    {"bcc", 3, 2, {{0.0, 0.0, 0.0}, {0.5, 0.5, 0.5}}},
    {"fcc", 3, 4, {{0.0, 0.0, 0.0}, {0.5, 0.5, 0.0}, {0.5, 0.0, 0.5}, {0.0, 0.5, 0.5}}},
    {"hcp", 3, 4, {{0.0, 0.0, 0.0}, {0.5, 0.5, 0.0}, {0.5, 5.0 / 6.0, 0.5}, {0.0, 1.0 / 3.0, 0.5}}},
    {"diamond",
     3,
     8,
     {{0.0, 0.0, 0.0},
      {0.0, 0.5, 0.5},
      {0.5, 0.0, 0.5},
      {0.5, 0.5, 0.0},
      {0.25, 0.25, 0.25},
      {0.25, 0.75, 0.75},
      {0.75, 0.25, 0.75},
      {0.75, 0.75, 0.25}}},
    {"sq", 2, 1, {{0.0, 0.0, 0.0}}},
    {"sq2", 2, 2, {{0.0, 0.0, 0.0}, {0.5, 0.5, 0.0}}},
    {"hex", 2, 2, {{0.0, 0.0, 0.0}, {0.5, 0.5, 0.0}}},
};

static const style_data *find_style(const char *name)
{
    for (size_t s = 0; s < sizeof styles / sizeof styles[0]; ++s)
        if (strcmp(styles[s].name, name) == 0) return &styles[s];
    return NULL;
}

bool hs_lattice_fits_dimension(const char *style, int dimension)
{
    const style_data *data = find_style(style);
    return data != NULL && (data->dimension == 0 || data->dimension == dimension);
}

void hs_lattice_init(hs_lattice *lattice)
{
    memset(lattice, 0, sizeof *lattice);
    lattice->scale = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
        lattice->a[axis][axis] = lattice->rotation[axis][axis] = lattice->spacing[axis] = 1.0;
        lattice->orient[axis][axis] = 1;
    }
}

void hs_lattice_fini(hs_lattice *lattice)
{
    HS_FREE(lattice->basis);
    lattice->n_basis = 0;
    lattice->is_set = false;
}

hs_status hs_lattice_begin(hs_lattice *lattice, const char *style, hs_error *err)
{
    hs_lattice_init(lattice);
    const style_data *data = find_style(style);
    if (data == NULL) return hs_fail(err, HS_ERROR_INPUT, "lattice: unknown style '%s'", style);
    lattice->is_set = strcmp(style, "none") != 0;
    if (strcmp(style, "hex") == 0 || strcmp(style, "hcp") == 0) lattice->a[1][1] = sqrt(3.0);
    if (strcmp(style, "hcp") == 0) lattice->a[2][2] = sqrt(8.0 / 3.0);
    for (int b = 0; b < data->n_basis; ++b) HS_TRY(hs_lattice_add_basis(lattice, data->basis[b], err));
    return HS_OK;
}

hs_status hs_lattice_add_basis(hs_lattice *lattice, const double fraction[3], hs_error *err)
{
    const size_t n = (size_t)lattice->n_basis;
    HS_TRY(HS_GROW(lattice->basis, n, n + 1, err));
    memcpy(lattice->basis[n], fraction, sizeof lattice->basis[n]);
    ++lattice->n_basis;
    return HS_OK;
}

/** a1 . (a2 x a3), lattice units cubed. */
static double cell_volume(const hs_lattice *lattice)
{
    const double *u = lattice->a[0], *v = lattice->a[1], *w = lattice->a[2];
    const double cross[3] = {v[1] * w[2] - v[2] * w[1], v[2] * w[0] - v[0] * w[2], v[0] * w[1] - v[1] * w[0]};
    return u[0] * cross[0] + u[1] * cross[1] + u[2] * cross[2];
}

static hs_status check_orient(const hs_lattice *lattice, hs_error *err)
{
    const int(*o)[3] = lattice->orient;
    for (int p = 0; p < 3; ++p) {
        const int q = (p + 1) % 3;
        if (o[p][0] == 0 && o[p][1] == 0 && o[p][2] == 0)
            return hs_fail(err, HS_ERROR_INPUT, "lattice: the orientation of %c is 0 0 0", "xyz"[p]);
        if ((int64_t)o[p][0] * o[q][0] + (int64_t)o[p][1] * o[q][1] + (int64_t)o[p][2] * o[q][2] != 0)
            return hs_fail(err, HS_ERROR_INPUT,
                           "lattice: the orientations of %c (%d %d %d) and %c (%d %d %d) are not orthogonal", "xyz"[p],
                           o[p][0], o[p][1], o[p][2], "xyz"[q], o[q][0], o[q][1], o[q][2]);
    }
    const int64_t handed = ((int64_t)o[0][1] * o[1][2] - (int64_t)o[0][2] * o[1][1]) * o[2][0] +
                           ((int64_t)o[0][2] * o[1][0] - (int64_t)o[0][0] * o[1][2]) * o[2][1] +
                           ((int64_t)o[0][0] * o[1][1] - (int64_t)o[0][1] * o[1][0]) * o[2][2];
    if (handed <= 0)
        return hs_fail(err, HS_ERROR_INPUT, "lattice: the orientations of x, y and z are not a right-handed set");
    return HS_OK;
}

static hs_status check_2d(const hs_lattice *lattice, hs_error *err)
{
    if (lattice->origin[2] != 0.0)
        return hs_fail(err, HS_ERROR_INPUT, "lattice: the origin's z must be 0 in two dimensions");
    const int(*orient)[3] = lattice->orient;
    if (orient[0][2] != 0 || orient[1][2] != 0 || orient[2][0] != 0 || orient[2][1] != 0)
        return hs_fail(err, HS_ERROR_INPUT,
                       "lattice: in two dimensions x and y must be oriented within the plane, z along z");
    if (lattice->a[0][2] != 0.0 || lattice->a[1][2] != 0.0 || lattice->a[2][0] != 0.0 || lattice->a[2][1] != 0.0)
        return hs_fail(err, HS_ERROR_INPUT, "lattice: in two dimensions a1 and a2 must lie in the plane, a3 along z");
    return HS_OK;
}

/** Cell coordinates to distance: the cell's vectors, the scale, the rotation, the shift, in this order. */
static void to_box(const hs_lattice *lattice, const double u[3], const double shift[3], double x[3])
{
    double p[3];
    for (int c = 0; c < 3; ++c) {
        p[c] = lattice->a[0][c] * u[0] + lattice->a[1][c] * u[1] + lattice->a[2][c] * u[2];
        p[c] *= lattice->scale;
    }
    for (int c = 0; c < 3; ++c) {
        const double *row = lattice->rotation[c];
        x[c] = (row[0] * p[0] + row[1] * p[1] + row[2] * p[2]) + shift[c];
    }
}

/** Spacing: the extent of the scaled and rotated cell. */
static void set_spacing(hs_lattice *lattice)
{
    static const double no_shift[3] = {0.0, 0.0, 0.0};
    double lo[3] = {DBL_MAX, DBL_MAX, DBL_MAX}, hi[3] = {-DBL_MAX, -DBL_MAX, -DBL_MAX};
    for (int corner = 0; corner < 8; ++corner) {
        const double u[3] = {corner & 1, corner >> 1 & 1, corner >> 2 & 1};
        double x[3];
        to_box(lattice, u, no_shift, x);
        for (int axis = 0; axis < 3; ++axis) {
            lo[axis] = fmin(lo[axis], x[axis]);
            hi[axis] = fmax(hi[axis], x[axis]);
        }
    }
    for (int axis = 0; axis < 3; ++axis) lattice->spacing[axis] = hi[axis] - lo[axis];
}

static hs_status check_cell(const hs_lattice *lattice, const hs_lattice_size *size, hs_error *err)
{
    if (lattice->n_basis == 0)
        return hs_fail(err, HS_ERROR_INPUT, "lattice: a custom lattice needs at least one 'basis x y z'");
    for (int axis = 0; axis < 3; ++axis)
        if (!(lattice->origin[axis] >= 0.0 && lattice->origin[axis] < 1.0))
            return hs_fail(err, HS_ERROR_INPUT, "lattice: the origin's %c, %g, must be from 0 to less than 1",
                           "xyz"[axis], lattice -> origin[axis]);
    HS_TRY(check_orient(lattice, err));
    if (size->dimension == 2) HS_TRY(check_2d(lattice, err));
    const double volume = cell_volume(lattice);
    if (!(volume > 0.0) || !isfinite(volume))
        return hs_fail(
            err, HS_ERROR_INPUT,
            "lattice: a1, a2, a3 span the volume %g; it must be greater than 0 (a right-handed set, not in one plane)",
            volume);
    return HS_OK;
}

hs_status hs_lattice_finish(hs_lattice *lattice, const hs_lattice_size *size, hs_error *err)
{
    if (!(size->value > 0.0))
        return hs_fail(err, HS_ERROR_INPUT, "lattice: the %s %g must be greater than 0",
                       size->is_density ? "density" : "scale", size->value);
    if (!lattice->is_set) {
        lattice->scale = size->value;
        for (int axis = 0; axis < 3; ++axis) lattice->spacing[axis] = size->value;
        return HS_OK;
    }
    HS_TRY(check_cell(lattice, size, err));
    lattice->scale = size->value;
    if (size->is_density)
        lattice->scale = pow(lattice->n_basis / cell_volume(lattice) / size->value, 1.0 / size->dimension);
    for (int c = 0; c < 3; ++c) {
        const double *o = (const double[3]){lattice->orient[c][0], lattice->orient[c][1], lattice->orient[c][2]};
        const double length = sqrt(o[0] * o[0] + o[1] * o[1] + o[2] * o[2]);
        for (int axis = 0; axis < 3; ++axis) lattice->rotation[c][axis] = o[axis] / length;
    }
    if (size->spacing != NULL)
        for (int axis = 0; axis < 3; ++axis) lattice->spacing[axis] = size->spacing[axis] * lattice->scale;
    else
        set_spacing(lattice);
    for (int axis = 0; axis < 3; ++axis)
        if (!isfinite(lattice->spacing[axis]) || !(lattice->spacing[axis] > 0.0))
            return hs_fail(err, HS_ERROR_INPUT,
                           "lattice: the spacing along %c would be %g; the scale or density is out of range",
                           "xyz"[axis], lattice -> spacing[axis]);
    return HS_OK;
}

void hs_lattice_site(const hs_lattice *lattice, int i, int j, int k, int b, double x[3])
{
    const double *fraction = lattice->basis[b];
    const double u[3] = {i + fraction[0], j + fraction[1], k + fraction[2]};
    double shift[3];
    for (int axis = 0; axis < 3; ++axis) shift[axis] = lattice->spacing[axis] * lattice->origin[axis];
    to_box(lattice, u, shift, x);
}

/** Distance to cell coordinates; only good to rounding, which the margins of hs_lattice_range allow for. */
static void to_lattice(const hs_lattice *lattice, const double x[3], double u[3])
{
    const double volume = cell_volume(lattice);
    double p[3] = {0.0, 0.0, 0.0};
    for (int c = 0; c < 3; ++c)
        for (int axis = 0; axis < 3; ++axis)
            p[axis] += lattice->rotation[c][axis] * (x[c] - lattice->spacing[c] * lattice->origin[c]) / lattice->scale;
    for (int q = 0; q < 3; ++q) {
        const double *v = lattice->a[(q + 1) % 3], *w = lattice->a[(q + 2) % 3];
        u[q] = (p[0] * (v[1] * w[2] - v[2] * w[1]) + p[1] * (v[2] * w[0] - v[0] * w[2]) +
                p[2] * (v[0] * w[1] - v[1] * w[0])) /
               volume;
    }
}

double hs_lattice_density(const hs_lattice *lattice, int dimension)
{
    return lattice->n_basis / (cell_volume(lattice) * pow(lattice->scale, dimension));
}

hs_status hs_lattice_range(const hs_lattice *lattice, const double box_lo[3], const double box_hi[3], int lo[3],
                           int hi[3], hs_error *err)
{
    double least[3] = {DBL_MAX, DBL_MAX, DBL_MAX}, most[3] = {-DBL_MAX, -DBL_MAX, -DBL_MAX};
    for (int corner = 0; corner < 8; ++corner) {
        double x[3], u[3];
        for (int axis = 0; axis < 3; ++axis) x[axis] = corner >> axis & 1 ? box_hi[axis] : box_lo[axis];
        to_lattice(lattice, x, u);
        for (int axis = 0; axis < 3; ++axis) {
            least[axis] = fmin(least[axis], u[axis]);
            most[axis] = fmax(most[axis], u[axis]);
        }
    }
    for (int axis = 0; axis < 3; ++axis) {
        const double limit = 1.0e9;
        if (!(least[axis] > -limit && most[axis] < limit))
            return hs_fail(err, HS_ERROR_INPUT,
                           "the box spans more than %g cells of the lattice; is it in the right units?", limit);
        /* basis atoms lie up to one cell above their cell's corner; one more for rounding */
        lo[axis] = (int)floor(least[axis]) - 2;
        hi[axis] = (int)ceil(most[axis]) + 1;
    }
    return HS_OK;
}
