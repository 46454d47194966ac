/* Static structure factor S(q) = |rho(q)|^2 / N of the wave vectors of the periodic box, by a non-uniform fast Fourier
 * transform (core/fourier.h), averaged over shells of |q| or vector by vector.
 * Source: J.-P. Hansen, I. R. McDonald, Theory of Simple Liquids, 4th ed. (2013), section 4.1. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "core/fourier.h"
#include "style/compute.h"

typedef struct sq_state {
    double q_max;
    int n_shells;    /**< 0: one row for each wave vector */
    int n_max[3];    /**< of the present modes */
    hs_modes *modes; /**< owned */
    double *sum;     /**< owned [n_shells][3]: of S, of |q|, and vectors */
} sq_state;

static const hs_keyword keywords[] = {
    {"vectors", 1, "yes|no", "a row for each wave vector, not for each shell (default: no)"},
    {NULL, 0, NULL, NULL},
};

static hs_status check_box(const hs_compute *compute, hs_error *err)
{
    const hs_box *box = compute->env->box;
    for (int axis = 0; axis < box->dimension; ++axis)
        if (!box->periodic[axis])
            return hs_fail(
                err, HS_ERROR_INPUT,
                "compute '%s' (sq): the box must be periodic along %c: only then it has wave vectors of its own",
                compute->id, "xyz"[axis]);
    return HS_OK;
}

/** Modes along an axis with |q| up to q_max. */
static int modes_along(const hs_compute *compute, int axis, hs_error *err, hs_status *status)
{
    const sq_state *state = compute->state;
    const double n = floor(state->q_max * hs_box_length(compute->env->box, axis) / (2.0 * M_PI) * (1.0 + 1e-12));
    if (compute->env->box->dimension == 2 && axis == 2) return 0;
    if (n < 1e6) return (int)n;
    *status = hs_fail(err, HS_ERROR_INPUT, "compute '%s' (sq): %g wave vectors along %c up to q = %g are too many",
                      compute->id, n, "xyz"[axis], state -> q_max);
    return 0;
}

/** Modes for the present box. */
static hs_status prepare(hs_compute *compute, hs_error *err)
{
    sq_state *state = compute->state;
    hs_status status = HS_OK;
    int n_max[3];
    for (int axis = 0; axis < 3; ++axis) n_max[axis] = modes_along(compute, axis, err, &status);
    HS_TRY(status);
    if (state->modes != NULL && memcmp(n_max, state->n_max, sizeof n_max) == 0) return HS_OK;
    hs_modes_destroy(&state->modes);
    memcpy(state->n_max, n_max, sizeof n_max);
    return hs_modes_create(&state->modes, n_max, err);
}

/** The wave vector of a mode and its length; false outside of the half that counts, or beyond q_max. */
static bool wave_vector(const hs_compute *compute, const int n[3], double q[3], double *length)
{
    const sq_state *state = compute->state;
    const int first = n[0] != 0 ? n[0] : n[1] != 0 ? n[1] : n[2];
    if (first <= 0) return false; /* -q has the same S; q = 0 has none */
    double q2 = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        q[axis] = n[axis] == 0 ? 0.0 : 2.0 * M_PI * n[axis] / hs_box_length(compute->env->box, axis);
        q2 += q[axis] * q[axis];
    }
    *length = sqrt(q2);
    return *length <= state->q_max * (1.0 + 1e-12);
}

/** Call what for every mode of the half space up to q_max; returns how many there are. */
typedef void (*mode_visit)(hs_compute *compute, int k, const int n[3], const double q[3], double length, void *context);
static int visit_modes(hs_compute *compute, mode_visit visit, void *context)
{
    const int *n_max = ((const sq_state *)compute->state)->n_max;
    int n[3], count = 0;
    double q[3], length;
    for (n[0] = 0; n[0] <= n_max[0]; ++n[0])
        for (n[1] = -n_max[1]; n[1] <= n_max[1]; ++n[1])
            for (n[2] = -n_max[2]; n[2] <= n_max[2]; ++n[2]) {
                if (!wave_vector(compute, n, q, &length)) continue;
                if (visit != NULL) visit(compute, count, n, q, length, context);
                ++count;
            }
    return count;
}

static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    sq_state *state = compute->state;
    const int end = hs_syntax_first_keyword(&compute->style->about.syntax, args);
    bool has_vectors = false;
    int64_t n = 100;
    HS_TRY(hs_arg_positive(args, 0, &state->q_max, err));
    if (end > 1) HS_TRY(hs_arg_int(args, 1, 1, 1000000, &n, err));
    if (end < args->n) HS_TRY(hs_arg_bool(args, end + 1, &has_vectors, err));
    state->n_shells = has_vectors ? 0 : (int)n;
    HS_TRY(check_box(compute, err));
    HS_TRY(prepare(compute, err));
    const int n_vectors = visit_modes(compute, NULL, NULL);
    if (n_vectors == 0)
        return hs_fail(err, HS_ERROR_INPUT,
                       "%s: the box has no wave vector up to q = %g: the shortest is 2 pi / L = %g", args->command,
                       state->q_max,
                       2.0 * M_PI / fmax(hs_box_length(compute->env->box, 0), hs_box_length(compute->env->box, 1)));
    compute->n_rows = has_vectors ? n_vectors : (int)n;
    compute->n_columns = has_vectors ? 6 : 3;
    HS_TRY(HS_ALLOC(state->sum, 3 * (size_t)n, err));
    return HS_ALLOC(compute->array, (size_t)compute->n_rows * (size_t)compute->n_columns, err);
}

static void destroy(hs_compute *compute)
{
    sq_state *state = compute->state;
    hs_modes_destroy(&state->modes);
    HS_FREE(state->sum);
    HS_FREE(compute->array);
}

static hs_status init(hs_compute *compute, hs_error *err) { return check_box(compute, err); }

/** rho(q) of the group's atoms (collective). */
static hs_status transform(hs_compute *compute, hs_error *err)
{
    const sq_state *state = compute->state;
    const hs_env *env = compute->env;
    const hs_atoms *atoms = env->atoms;
    const size_t n = (size_t)atoms->n_local;
    double *x[3] = {NULL, NULL, NULL};
    hs_status status = HS_OK;
    for (int axis = 0; axis < 3 && status == HS_OK; ++axis) {
        const double lo = env->box->lo[axis], inv = 1.0 / hs_box_length(env->box, axis);
        status = HS_ALLOC(x[axis], n, err);
        for (size_t i = 0; status == HS_OK && i < n; ++i) x[axis][i] = (atoms->x[axis][i] - lo) * inv;
    }
    if (status == HS_OK)
        hs_modes_spread(state->modes, atoms->n_local, (const double *const[3]){x[0], x[1], x[2]}, atoms->mask,
                        compute->mask);
    for (int axis = 0; axis < 3; ++axis) HS_FREE(x[axis]);
    if (hs_parallel_agree(env->parallel, err) != HS_OK) return status != HS_OK ? status : err->status;
    int64_t n_grid;
    double *grid = hs_modes_grid(state->modes, &n_grid);
    hs_parallel_sum_double(env->parallel, grid, (int)n_grid);
    hs_modes_transform(state->modes);
    return HS_OK;
}

static void add_to_shell(hs_compute *compute, int k, const int n[3], const double q[3], double length, void *context)
{
    const sq_state *state = compute->state;
    const double complex rho = hs_modes_get(state->modes, n[0], n[1], n[2]);
    int shell = (int)(length / state->q_max * state->n_shells);
    if (shell >= state->n_shells) shell = state->n_shells - 1;
    double *sum = &state->sum[3 * (size_t)shell];
    (void)k, (void)q;
    sum[0] += (creal(rho) * creal(rho) + cimag(rho) * cimag(rho)) * *(const double *)context;
    sum[1] += length;
    sum[2] += 1.0;
}

static void fill_row(hs_compute *compute, int k, const int n[3], const double q[3], double length, void *context)
{
    const sq_state *state = compute->state;
    const double complex rho = hs_modes_get(state->modes, n[0], n[1], n[2]);
    (void)length;
    if (k >= compute->n_rows) return;
    double *row = compute->array + 6 * (size_t)k;
    memcpy(row, q, 3 * sizeof *q);
    row[3] = (creal(rho) * creal(rho) + cimag(rho) * cimag(rho)) * *(const double *)context;
    row[4] = creal(rho);
    row[5] = cimag(rho);
}

static hs_status array(hs_compute *compute, hs_error *err)
{
    const sq_state *state = compute->state;
    const hs_env *env = compute->env;
    int64_t n = 0;
    for (int i = 0; i < env->atoms->n_local; ++i) n += (env->atoms->mask[i] & compute->mask) != 0;
    hs_parallel_sum_int64(env->parallel, &n, 1);
    double inv_n = n > 0 ? 1.0 / (double)n : 0.0;
    HS_TRY(prepare(compute, err));
    HS_TRY(transform(compute, err));
    memset(compute->array, 0, (size_t)compute->n_rows * (size_t)compute->n_columns * sizeof *compute->array);
    if (state->n_shells == 0) {
        const int n_vectors = visit_modes(compute, fill_row, &inv_n);
        if (n_vectors == compute->n_rows) return HS_OK;
        return hs_fail(
            err, HS_ERROR_RUN,
            "compute '%s' (sq): the box has changed and has %d wave vectors now, not %d; shells ('vectors no') follow "
            "a box that changes",
            compute->id, n_vectors, compute->n_rows);
    }
    memset(state->sum, 0, 3 * (size_t)state->n_shells * sizeof *state->sum);
    visit_modes(compute, add_to_shell, &inv_n);
    for (int k = 0; k < state->n_shells; ++k) {
        const double *sum = &state->sum[3 * (size_t)k];
        double *row = compute->array + 3 * (size_t)k;
        row[0] = sum[2] > 0.0 ? sum[1] / sum[2] : (k + 0.5) * state->q_max / state->n_shells;
        row[1] = sum[2] > 0.0 ? sum[0] / sum[2] : 0.0;
        row[2] = 2.0 * sum[2];
    }
    return HS_OK;
}

const hs_compute_style hs_compute_style_sq = {
    .about =
        {.name = "sq",
         .syntax = {.usage = "<q_max> [<Nbin>] [vectors yes|no]", .n_min = 1, .n_max = 2, .keywords = keywords},
         .summary = "static structure factor",
         .details =
             "S(q) = |sum over atoms of exp(-i q r)|^2 / N for the wave vectors q = 2 pi (n_x/L_x, n_y/L_y, n_z/L_z) "
             "of the "
             "periodic box with 0 < |q| <= q_max (1/distance), of the group's atoms. The array has one row for each of "
             "Nbin "
             "shells of equal width (default: 100): the mean |q| of its vectors, the mean S, and the number of "
             "vectors, 0 "
             "for a shell without any.\n\n"
             "With `vectors yes` there is one row for each wave vector, of q and -q one: q_x, q_y, q_z, S(q), and the "
             "real "
             "and imaginary part of the sum; correlations of these in time (`fix ave/correlate`) give the intermediate "
             "scattering function F(q,t) N.\n\n"
             "A non-uniform fast Fourier transform computes all of them at once, exact to 1e-10, at a cost of a few "
             "microseconds an atom. All directions (in two dimensions x and y) must be periodic.",
         .reference =
             "J.-P. Hansen, I. R. McDonald, Theory of Simple Liquids, 4th ed. (2013), section 4.1; A. H. Barnett, J. "
             "Magland, L. af Klinteberg, SIAM J. Sci. Comput. 41, C479 (2019), doi:10.1137/18M120885X",
         .example = "compute S all sq 25.0 200\nfix s all ave/time 100 10 1000 c_S[*] file tmp.sq mode vector"},
    .state_size = sizeof(sq_state),
    .create = create,
    .destroy = destroy,
    .init = init,
    .array = array,
};
