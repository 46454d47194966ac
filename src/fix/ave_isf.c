/* Coherent intermediate scattering function F(q,t) = <rho(q,s)* rho(q,s+t)> / N, averaged over shells of |q|.
 * Source: J.-P. Hansen, I. R. McDonald, Theory of Simple Liquids, 4th ed. (2013), section 7.4. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "io/correlation.h"
#include "style/atom_sum.h"
#include "style/density.h"

/** Wave vectors of about one length: a column of the result. */
typedef struct isf_shell {
    double q; /**< mean length, 1/distance */
    int n;    /**< vectors, of q and -q one */
} isf_shell;

typedef struct isf_state {
    hs_correlation table; /**< first, as io/correlation.h wants it */
    hs_density density;
    double length[3], tilt[3]; /**< of the box that the wave vectors belong to */
    int n_bins, n_vectors;
    int *shell_of;           /**< owned [n_vectors] */
    isf_shell *shell;        /**< owned [n_bins], of which table.n_pairs have vectors and come first */
    hs_correlation_tau sums; /**< of real and imaginary parts [n_vectors][2], whose products are added up by shell */
    double inv_sqrt_n;       /**< of the present sample */
} isf_state;

static const hs_keyword keywords[] = {
    HS_CORRELATION_LEVELS,
    {"error", 1, "yes|no", "standard errors and inefficiencies, too (default: no)"},
    {"start", 1, "<step>", "no sample before this step (default: 0)"},
    {"file", 1, "<output-file>", "write the function to this file, which holds the last output"},
    {"title1", 1, "<text>", "first line of the file"},
    {"title2", 1, "<text>", "second line"},
    {"title3", 1, "<text>", "third line"},
    {NULL, 0, NULL, NULL},
};

static void count_vector(void *context, int k, const int n[3], const double q[3], double length)
{
    isf_state *state = ((hs_fix *)context)->state;
    int bin = (int)(length / state->density.q_max * state->n_bins);
    (void)n, (void)q;
    if (bin >= state->n_bins) bin = state->n_bins - 1;
    state->shell_of[k] = bin;
    state->shell[bin].q += length;
    ++state->shell[bin].n;
}

/** Shells without vectors are left out. */
static void number_shells(isf_state *state)
{
    int n = 0;
    for (int bin = 0; bin < state->n_bins; ++bin) {
        const isf_shell shell = state->shell[bin];
        if (shell.n == 0) continue;
        for (int k = 0; k < state->n_vectors; ++k)
            if (state->shell_of[k] == bin) state->shell_of[k] = n;
        state->shell[n++] = (isf_shell){shell.q / shell.n, shell.n};
    }
    state->table.n_pairs = n;
}

static hs_status find_vectors(hs_fix *fix, const hs_args *args, hs_error *err)
{
    isf_state *state = fix->state;
    HS_TRY(hs_density_check_box(fix->env, args->command, err));
    HS_TRY(hs_density_prepare(&state->density, fix->env, args->command, err));
    for (int axis = 0; axis < 3; ++axis) state->length[axis] = hs_box_length(fix->env->box, axis);
    memcpy(state->tilt, fix->env->box->tilt, sizeof state->tilt);
    state->n_vectors = hs_density_each(&state->density, fix->env, NULL, NULL);
    if (state->n_vectors == 0)
        return hs_fail(err, HS_ERROR_INPUT,
                       "%s: the box has no wave vector up to q = %g: the shortest is 2 pi / L = %g", args->command,
                       state->density.q_max, 2.0 * M_PI / fmax(state->length[0], state->length[1]));
    HS_TRY(HS_ALLOC(state->shell_of, (size_t)state->n_vectors, err));
    HS_TRY(HS_ALLOC(state->shell, (size_t)state->n_bins, err));
    hs_density_each(&state->density, fix->env, count_vector, fix);
    number_shells(state);
    return HS_OK;
}

/** F(1.57) */
static hs_status put_name(hs_text *head, const hs_fix *fix, int k, hs_error *err)
{
    return hs_text_printf(head, err, "F(%.4g)", ((const isf_state *)fix->state)->shell[k].q);
}

static hs_status make_correlator(isf_state *state, int n_lags, hs_error *err)
{
    const int n = 2 * state->n_vectors;
    int(*pair)[2] = NULL, *column = NULL;
    hs_status status = HS_ALLOC(pair, (size_t)n, err);
    if (status == HS_OK) status = HS_ALLOC(column, (size_t)n, err);
    for (int v = 0; v < n && status == HS_OK; ++v) {
        pair[v][0] = pair[v][1] = v;
        column[v] = state->shell_of[v / 2];
    }
    const hs_multi_tau_plan plan = {.n_values = n,
                                    .n_pairs = n,
                                    .pair = pair,
                                    .column = column,
                                    .n_lags = n_lags,
                                    .n_levels = (int)state->sums.n_levels,
                                    .has_errors = state->table.has_errors};
    if (status == HS_OK) status = hs_multi_tau_init(&state->sums.tau, &plan, err);
    HS_FREE(pair);
    HS_FREE(column);
    return status;
}

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    isf_state *state = fix->state;
    const int first = hs_syntax_first_keyword(&fix->style->about.syntax, args);
    int64_t n_lags, n_bins = 20;
    HS_TRY(hs_correlation_numbers(fix, args, 2, 1 << 28, &n_lags, err));
    HS_TRY(hs_arg_positive(args, 3, &state->density.q_max, err));
    if (first > 4) HS_TRY(hs_arg_int(args, 4, 1, 1000000, &n_bins, err));
    state->n_bins = (int)n_bins;
    HS_TRY(hs_correlation_tau_keywords(fix, &state->sums, args, n_lags, err));
    HS_TRY(find_vectors(fix, args, err));
    HS_TRY(make_correlator(state, (int)n_lags, err));
    return hs_correlation_tau_create(fix, &state->sums, put_name, err);
}

static void destroy(hs_fix *fix)
{
    isf_state *state = fix->state;
    hs_density_fini(&state->density);
    hs_correlation_tau_fini(&state->sums);
    HS_FREE(state->shell_of);
    HS_FREE(state->shell);
    hs_correlation_fini(&state->table);
}

/** Correlations need the same wave vectors all the time. */
static hs_status check_box(const hs_fix *fix, hs_error *err)
{
    const isf_state *state = fix->state;
    for (int k = 0; k < 3; ++k)
        if (fabs(fix->env->box->tilt[k] - state->tilt[k]) > 1e-9 * state->length[0])
            return hs_fail(err, HS_ERROR_INPUT,
                           "%s: the tilt %s of the box was %g and is %g now: its wave vectors have changed, and modes "
                           "of different ones cannot be correlated",
                           hs_fix_who(fix).text, (const char *const[]){"xy", "xz", "yz"}[k], state->tilt[k],
                           fix->env->box->tilt[k]);
    for (int axis = 0; axis < fix->env->box->dimension; ++axis)
        /* reproducible runs round the box at their start, by 1e-14 */
        if (fabs(hs_box_length(fix->env->box, axis) / state->length[axis] - 1.0) > 1e-9)
            return hs_fail(err, HS_ERROR_INPUT,
                           "%s: the box was %g long along %c and is %g now: its wave vectors have changed, and modes "
                           "of different ones cannot be correlated",
                           hs_fix_who(fix).text, state->length[axis], "xyz"[axis], hs_box_length(fix->env->box, axis));
    return HS_OK;
}

static hs_status init(hs_fix *fix, hs_error *err)
{
    HS_TRY(hs_density_check_box(fix->env, hs_fix_who(fix).text, err));
    HS_TRY(check_box(fix, err));
    return hs_correlation_init(fix, "Intermediate scattering function", "time-windows", err);
}

static void take_mode(void *context, int k, const int n[3], const double q[3], double length)
{
    isf_state *state = ((hs_fix *)context)->state;
    const double complex rho = hs_modes_get(state->density.modes, n[0], n[1], n[2]);
    (void)q, (void)length;
    state->sums.sample[2 * k] = creal(rho) * state->inv_sqrt_n;
    state->sums.sample[2 * k + 1] = cimag(rho) * state->inv_sqrt_n;
}

/** Sums over the vectors of a shell as their means. */
static hs_status finish(hs_fix *fix, hs_error *err)
{
    isf_state *state = fix->state;
    const hs_correlation *table = &state->table;
    hs_correlation_tau_take(fix, &state->sums);
    for (int row = 0; row < table->n_rows; ++row)
        for (int k = 0; k < table->n_columns && k < 2 * table->n_pairs; ++k)
            table->result[(size_t)row * (size_t)table->n_columns + (size_t)k] /= state->shell[k % table->n_pairs].n;
    return hs_correlation_finish(fix, err);
}

static hs_status end_of_step(hs_fix *fix, hs_error *err)
{
    isf_state *state = fix->state;
    bool is_due;
    HS_TRY(hs_correlation_sample(fix, NULL, &is_due, err));
    if (!is_due) return HS_OK;
    HS_TRY(check_box(fix, err));
    HS_TRY(hs_density_eval(&state->density, fix->env, fix->mask, err));
    const int64_t n = hs_atom_count(fix->env->atoms, fix->env->parallel, fix->mask);
    state->inv_sqrt_n = n > 0 ? 1.0 / sqrt((double)n) : 0.0;
    hs_density_each(&state->density, fix->env, take_mode, fix);
    HS_TRY(hs_multi_tau_add(&state->sums.tau, state->sums.sample, err));
    return hs_correlation_is_output_due(fix) ? finish(fix, err) : HS_OK;
}

static hs_status keep_state(hs_fix *fix, hs_state *kept, hs_error *err)
{
    return hs_correlation_tau_keep(fix, &((isf_state *)fix->state)->sums, kept, err);
}

const hs_fix_style hs_fix_style_ave_isf = {
    .about =
        {.name = "ave/isf",
         .syntax = {.usage = "<Nevery> <Nlags> <Nfreq> <q_max> [<Nbin>] [keyword value ...]",
                    .n_min = 4,
                    .n_max = 5,
                    .keywords = keywords},
         .summary = "intermediate scattering function",
         .details =
             "The coherent intermediate scattering function F(q,t) = <rho(q,s)* rho(q,s+t)> / N of the group's atoms, "
             "rho(q) = sum of exp(-i q r), for the wave vectors of the periodic box with 0 < |q| <= q_max "
             "(1/distance), averaged over shells of equal width in |q| (Nbin, default 20; shells without vectors are "
             "left out). F(q,0) is the static structure factor. Its self part is a quantity of `fix ave/self`.\n\n"
             "Modes are taken every Nevery steps by a non-uniform fast Fourier transform, as in compute sq, and "
             "correlated up to Nlags - 1 samples apart over the whole run, as in fix ave/correlate/fft; `levels` goes "
             "on beyond that in the same way. Memory: 32 Nlags bytes for each wave vector and level. Results come "
             "every Nfreq steps; the file holds the last ones.\n\n"
             "The array `f_ID[i][j]` has the columns time in steps, number of samples, and F for each shell, whose "
             "mean |q| is in the name of the column in the file, F(|q|). With `error yes` a column of standard errors "
             "for each shell follows, from the scatter of blocks of Nlags samples, and then one of inefficiencies "
             "(blocks that count as one); `nan` before two blocks are complete. The box must be periodic and keep its "
             "size. Results are the same on any number of threads and ranks.",
         .reference = "J.-P. Hansen, I. R. McDonald, Theory of Simple Liquids, 4th ed. (2013), section 7.4",
         .example = "fix F all ave/isf 10 200 20000 8.0 40 file isf.dat\n"
                    "fix G all ave/isf 5 128 100000 8.0 levels 8 error yes file isf.long"},
    .state_size = sizeof(isf_state),
    HS_CORRELATION_HOOKS,
};
