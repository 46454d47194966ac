/* Static structure factor S(q) = |rho(q)|^2 / N of the wave vectors of the periodic box, by a non-uniform fast Fourier
 * transform (core/fourier.h), averaged over shells of |q| or vector by vector.
 * Source: J.-P. Hansen, I. R. McDonald, Theory of Simple Liquids, 4th ed. (2013), section 4.1. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "style/atom_sum.h"
#include "style/compute.h"
#include "style/density.h"

typedef struct sq_state {
    hs_density density;
    int n_shells; /**< 0: one row for each wave vector */
    double *sum;  /**< owned [n_shells][3]: of S, of |q|, and vectors */
    double inv_n; /**< 1 / number of atoms */
} sq_state;

static const hs_keyword keywords[] = {
    {"vectors", 1, "yes|no", "a row for each wave vector, not for each shell (default: no)"},
    {NULL, 0, NULL, NULL},
};

static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    sq_state *state = compute->state;
    const int end = hs_syntax_first_keyword(&compute->style->about.syntax, args);
    bool has_vectors = false;
    int64_t n = 100;
    HS_TRY(hs_arg_positive(args, 0, &state->density.q_max, err));
    if (end > 1) HS_TRY(hs_arg_int(args, 1, 1, 1000000, &n, err));
    if (end < args->n) HS_TRY(hs_arg_bool(args, end + 1, &has_vectors, err));
    state->n_shells = has_vectors ? 0 : (int)n;
    HS_TRY(hs_density_check_box(compute->env, args->command, err));
    HS_TRY(hs_density_prepare(&state->density, compute->env, args->command, err));
    const int n_vectors = hs_density_each(&state->density, compute->env, NULL, NULL);
    if (n_vectors == 0)
        return hs_fail(err, HS_ERROR_INPUT,
                       "%s: the box has no wave vector up to q = %g: the shortest is 2 pi / L = %g", args->command,
                       state->density.q_max,
                       2.0 * M_PI / fmax(hs_box_length(compute->env->box, 0), hs_box_length(compute->env->box, 1)));
    compute->n_rows = has_vectors ? n_vectors : (int)n;
    compute->n_columns = has_vectors ? 6 : 3;
    HS_TRY(HS_ALLOC(state->sum, 3 * (size_t)n, err));
    return HS_ALLOC(compute->array, (size_t)compute->n_rows * (size_t)compute->n_columns, err);
}

static void destroy(hs_compute *compute)
{
    sq_state *state = compute->state;
    hs_density_fini(&state->density);
    HS_FREE(state->sum);
    HS_FREE(compute->array);
}

static hs_status init(hs_compute *compute, hs_error *err)
{
    return hs_density_check_box(compute->env, hs_compute_who(compute).text, err);
}

static void add_to_shell(void *context, int k, const int n[3], const double q[3], double length)
{
    const hs_compute *compute = context;
    const sq_state *state = compute->state;
    const double complex rho = hs_modes_get(state->density.modes, n[0], n[1], n[2]);
    int shell = (int)(length / state->density.q_max * state->n_shells);
    if (shell >= state->n_shells) shell = state->n_shells - 1;
    double *sum = &state->sum[3 * (size_t)shell];
    (void)k, (void)q;
    sum[0] += (creal(rho) * creal(rho) + cimag(rho) * cimag(rho)) * state->inv_n;
    sum[1] += length;
    sum[2] += 1.0;
}

static void fill_row(void *context, int k, const int n[3], const double q[3], double length)
{
    const hs_compute *compute = context;
    const sq_state *state = compute->state;
    const double complex rho = hs_modes_get(state->density.modes, n[0], n[1], n[2]);
    (void)length;
    if (k >= compute->n_rows) return;
    double *row = compute->array + 6 * (size_t)k;
    memcpy(row, q, 3 * sizeof *q);
    row[3] = (creal(rho) * creal(rho) + cimag(rho) * cimag(rho)) * state->inv_n;
    row[4] = creal(rho);
    row[5] = cimag(rho);
}

static hs_status array(hs_compute *compute, hs_error *err)
{
    sq_state *state = compute->state;
    const hs_env *env = compute->env;
    const int64_t n = hs_atom_count(env->atoms, env->parallel, compute->mask);
    state->inv_n = n > 0 ? 1.0 / (double)n : 0.0;
    HS_TRY(hs_density_prepare(&state->density, env, "compute sq", err));
    HS_TRY(hs_density_eval(&state->density, env, compute->mask, err));
    memset(compute->array, 0, (size_t)compute->n_rows * (size_t)compute->n_columns * sizeof *compute->array);
    if (state->n_shells == 0) {
        const int n_vectors = hs_density_each(&state->density, env, fill_row, compute);
        if (n_vectors == compute->n_rows) return HS_OK;
        return hs_fail(err, HS_ERROR_RUN,
                       "%s: the box has changed and has %d wave vectors now, not %d; shells ('vectors no') follow a "
                       "box that changes",
                       hs_compute_who(compute).text, n_vectors, compute->n_rows);
    }
    memset(state->sum, 0, 3 * (size_t)state->n_shells * sizeof *state->sum);
    hs_density_each(&state->density, env, add_to_shell, compute);
    for (int k = 0; k < state->n_shells; ++k) {
        const double *sum = &state->sum[3 * (size_t)k];
        double *row = compute->array + 3 * (size_t)k;
        row[0] = sum[2] > 0.0 ? sum[1] / sum[2] : (k + 0.5) * state->density.q_max / state->n_shells;
        row[1] = sum[2] > 0.0 ? sum[0] / sum[2] : 0.0;
        row[2] = 2.0 * sum[2];
    }
    return HS_OK;
}

const hs_compute_style hs_compute_style_sq = {
    .about = {.name = "sq",
              .syntax = {.usage = "<q_max> [<Nbin>] [vectors yes|no]", .n_min = 1, .n_max = 2, .keywords = keywords},
              .summary = "static structure factor",
              .details = "S(q) = |sum over atoms of exp(-i q r)|^2 / N for the wave vectors q = 2 pi (n_x/L_x, "
                         "n_y/L_y, n_z/L_z) of the periodic box with 0 < |q| <= q_max (1/distance), of the group's "
                         "atoms; a tilted box has those whose products with its edges are multiples of 2 pi. The array "
                         "has one row for each of Nbin shells of equal width (default: 100): the mean |q| of its "
                         "vectors, the mean S, and the number of vectors, 0 for a shell without any.\n\n"
                         "With `vectors yes` there is one row for each wave vector, of q and -q one: q_x, q_y, q_z, "
                         "S(q), and the real and imaginary part of the sum; correlations of these in time (`fix "
                         "ave/correlate`) give the intermediate scattering function F(q,t) N.\n\n"
                         "A non-uniform fast Fourier transform computes all of them at once, exact to 1e-10, at a cost "
                         "of a few microseconds an atom. All directions (in two dimensions x and y) must be periodic.",
              .reference =
                  "J.-P. Hansen, I. R. McDonald, Theory of Simple Liquids, 4th ed. (2013), section 4.1; A. H. Barnett, "
                  "J. Magland, L. af Klinteberg, SIAM J. Sci. Comput. 41, C479 (2019), doi:10.1137/18M120885X",
              .example = "compute S all sq 25.0 200\nfix s all ave/time 100 10 1000 c_S[*] file tmp.sq mode vector"},
    .state_size = sizeof(sq_state),
    .create = create,
    .destroy = destroy,
    .init = init,
    .array = array,
};
