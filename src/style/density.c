#include "style/density.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "style/atom_sum.h"

hs_status hs_density_check_box(const hs_env *env, const char *command, hs_error *err)
{
    for (int axis = 0; axis < env->box->dimension; ++axis)
        if (!env->box->periodic[axis])
            return hs_fail(err, HS_ERROR_INPUT,
                           "%s: the box must be periodic along %c: only then it has wave vectors of its own", command,
                           "xyz"[axis]);
    return HS_OK;
}

static double edge_length(const hs_box *box, int axis)
{
    double edge[3];
    if (!box->is_tilted) return hs_box_length(box, axis);
    hs_box_shift(box, (const int32_t[3]){axis == 0, axis == 1, axis == 2}, edge);
    return sqrt(edge[0] * edge[0] + edge[1] * edge[1] + edge[2] * edge[2]);
}

hs_status hs_density_prepare(hs_density *density, const hs_env *env, const char *command, hs_error *err)
{
    int n_max[3] = {0};
    for (int axis = 0; axis < env->box->dimension; ++axis) {
        const double n = floor(density->q_max * edge_length(env->box, axis) / (2.0 * M_PI) * (1.0 + 1e-12));
        if (!(n < 1e6))
            return hs_fail(err, HS_ERROR_INPUT, "%s: %g wave vectors along %c up to q = %g are too many", command, n,
                           "xyz"[axis], density -> q_max);
        n_max[axis] = (int)n;
    }
    if (density->modes != NULL && memcmp(n_max, density->n_max, sizeof n_max) == 0) return HS_OK;
    hs_modes_destroy(&density->modes);
    memcpy(density->n_max, n_max, sizeof n_max);
    return hs_modes_create(&density->modes, n_max, err);
}

void hs_density_fini(hs_density *density) { hs_modes_destroy(&density->modes); }

/** The wave vector of a mode and its length; false outside of the half that counts, or beyond q_max. */
static bool wave_vector(const hs_density *density, const hs_env *env, const int n[3], double q[3], double *length)
{
    const int first = n[0] != 0 ? n[0] : n[1] != 0 ? n[1] : n[2];
    if (first <= 0) return false; /* -q has the conjugate; q = 0 counts atoms */
    double q2 = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        /* the products with the edges before, whose components along this axis are 0, are right already */
        double phase = 2.0 * M_PI * n[axis];
        for (int before = 0; before < axis && env->box->is_tilted; ++before)
            phase -= q[before] * env->box->tilt[before + axis - 1];
        q[axis] = phase == 0.0 ? 0.0 : phase / hs_box_length(env->box, axis);
        q2 += q[axis] * q[axis];
    }
    *length = sqrt(q2);
    return *length <= density->q_max * (1.0 + 1e-12);
}

int hs_density_each(const hs_density *density, const hs_env *env, hs_density_visit visit, void *context)
{
    const int *n_max = density->n_max;
    int n[3], count = 0;
    double q[3], length;
    for (n[0] = 0; n[0] <= n_max[0]; ++n[0])
        for (n[1] = -n_max[1]; n[1] <= n_max[1]; ++n[1])
            for (n[2] = -n_max[2]; n[2] <= n_max[2]; ++n[2]) {
                if (!wave_vector(density, env, n, q, &length)) continue;
                if (visit != NULL) visit(context, count, n, q, length);
                ++count;
            }
    return count;
}

/** Places in a tilted box as fractions of its edges. What rounding leaves outside is on a face. */
static void make_fractions_tilted(const hs_env *env, double *const x[3])
{
    const hs_atoms *atoms = env->atoms;
    for (int i = 0; i < atoms->n_local; ++i) {
        double place[3] = {atoms->x[0][i], atoms->x[1][i], atoms->x[2][i]}, fraction[3];
        int32_t image[3] = {0, 0, 0};
        hs_box_wrap(env->box, place, image);
        hs_box_fractions(env->box, place, fraction);
        for (int axis = 0; axis < 3; ++axis)
            x[axis][i] = fraction[axis] >= 0.0 && fraction[axis] < 1.0 ? fraction[axis] : 0.0;
    }
}

/** Places in box lengths. Images are taken off before the division, so that all of them give the same bits. */
static hs_status make_fractions(const hs_env *env, double *x[3], hs_error *err)
{
    const hs_atoms *atoms = env->atoms;
    for (int axis = 0; axis < 3; ++axis) {
        const double lo = env->box->lo[axis], length = hs_box_length(env->box, axis);
        HS_TRY(HS_ALLOC(x[axis], (size_t)atoms->n_local + 1, err));
        for (int i = 0; i < atoms->n_local; ++i) {
            const double d = atoms->x[axis][i] - lo;
            x[axis][i] = (d - length * floor(d / length)) / length;
        }
    }
    if (env->box->is_tilted) make_fractions_tilted(env, x);
    return HS_OK;
}

hs_status hs_density_eval(hs_density *density, const hs_env *env, uint32_t mask, hs_error *err)
{
    double *x[3] = {NULL, NULL, NULL};
    const int64_t n_all = hs_atom_count(env->atoms, env->parallel, mask);
    const hs_status status = make_fractions(env, x, err);
    if (status == HS_OK)
        hs_modes_spread(density->modes, env->atoms->n_local, (const double *const[3]){x[0], x[1], x[2]},
                        env->atoms->mask, mask, n_all);
    for (int axis = 0; axis < 3; ++axis) HS_FREE(x[axis]);
    if (hs_parallel_agree(env->parallel, err) != HS_OK) return status != HS_OK ? status : err->status;
    int64_t n_grid;
    int64_t *grid = hs_modes_grid(density->modes, &n_grid);
    hs_parallel_sum_int64(env->parallel, grid, (int)n_grid);
    hs_modes_transform(density->modes);
    return HS_OK;
}
