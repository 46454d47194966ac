/* How single atoms move: functions of the time since an origin, averaged over atoms and over many origins. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "io/correlation.h"
#include "style/atom_sum.h"
#include "style/atom_vector.h"
#include "style/moments.h"
#include "style/places.h"

typedef enum { OF_MSD, OF_VACF, OF_ALPHA2, OF_ISF } self_kind;

typedef struct self_quantity {
    self_kind kind;
    double q; /**< OF_ISF: wave number, 1/distance */
    int term; /**< first of its sums over atoms */
} self_quantity;

/** A time that others are counted from. */
typedef struct self_origin {
    int64_t begun;       /**< number of the sample; -1: none */
    double center[3];    /**< center of mass then, with keyword com; else 0 */
    hs_atom_vector x, v; /**< of the atoms: unwrapped places, velocities (only if needed) */
    double *curve;       /**< owned [n_lags][n] so far */
} self_origin;

typedef struct self_state {
    hs_correlation table; /**< first, as io/correlation.h wants it */
    int n_lags;
    self_quantity *quantity; /**< owned [n] */
    int n, n_terms;
    bool has_com, needs_velocities, is_running;
    self_origin *origin; /**< owned [n_origins] */
    int n_origins;
    int64_t n_samples;
    double *sum; /**< owned [n_lags][n]: of complete curves */
    int64_t n_complete;
    hs_series_set curves; /**< the same with keyword error */
    double center[3];     /**< now */
} self_state;

static const char *const words[] = {"msd", "vacf", "alpha2", "isf", NULL};

static const hs_keyword keywords[] = {
    {"ave", 1, "one|running", "after each output forget the curves so far, or go on (default: running)"},
    {"origins", 1, "<number>", "so many origins at a time, equally apart; divides Nlags (default: 1)"},
    {"com", 1, "yes|no", "places relative to the group's center of mass (default: no)"},
    {"error", 1, "yes|no", "standard errors and inefficiencies, too (default: no)"},
    {"start", 1, "<step>", "no sample before this step (default: 0)"},
    {"file", 1, "<output-file>", "write the functions to this file, which holds the last output"},
    {"title1", 1, "<text>", "first line of the file"},
    {"title2", 1, "<text>", "second line"},
    {"title3", 1, "<text>", "third line"},
    {NULL, 0, NULL, NULL},
};

static hs_status read_quantities(hs_fix *fix, const hs_args *args, int first, hs_error *err)
{
    self_state *state = fix->state;
    HS_TRY(HS_ALLOC(state->quantity, (size_t)first, err));
    for (int i = 3; i < first; ++i) {
        self_quantity *quantity = &state->quantity[state->n++];
        int kind;
        HS_TRY(hs_arg_choice(args, i, words, &kind, err));
        *quantity = (self_quantity){.kind = (self_kind)kind, .term = state->n_terms};
        state->n_terms += quantity->kind == OF_ALPHA2 ? 2 : 1;
        state->needs_velocities |= quantity->kind == OF_VACF;
        if (quantity->kind != OF_ISF) continue;
        if (i + 1 >= first)
            return hs_fail(err, HS_ERROR_INPUT, "%s: a wave number must follow 'isf', for example: isf 7.2",
                           args->command);
        HS_TRY(hs_arg_positive(args, ++i, &quantity->q, err));
    }
    state->table.n_pairs = state->n;
    return HS_OK;
}

static hs_status read_keywords(hs_fix *fix, const hs_args *args, int first, hs_error *err)
{
    static const char *const modes[] = {"one", "running", NULL};
    self_state *state = fix->state;
    int64_t n_origins = 1;
    int mode = 1;
    state->table.file.overwrite = true;
    for (int i = first, n_used; i < args->n; i += n_used) {
        HS_TRY(hs_correlation_keyword(fix, args, i, &n_used, err));
        if (n_used > 0) continue;
        n_used = 2;
        if (strcmp(args->word[i], "com") == 0)
            HS_TRY(hs_arg_bool(args, i + 1, &state->has_com, err));
        else if (strcmp(args->word[i], "ave") == 0)
            HS_TRY(hs_arg_choice(args, i + 1, modes, &mode, err));
        else
            HS_TRY(hs_arg_int(args, i + 1, 1, state->n_lags, &n_origins, err));
    }
    state->n_origins = (int)n_origins;
    state->is_running = mode == 1;
    if (!state->is_running && state->table.freq < state->n_lags * state->table.every)
        return hs_fail(err, HS_ERROR_INPUT,
                       "%s: with ave one, %d lags of %lld steps do not fit into the %lld steps (Nfreq) between "
                       "outputs; 'ave running' goes on over them",
                       args->command, state->n_lags, (long long)state->table.every, (long long)state->table.freq);
    if (state->n_lags % state->n_origins == 0) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT,
                   "%s: %d origins cannot be equally apart: their number must divide that of the lags (Nlags), %d",
                   args->command, state->n_origins, state->n_lags);
}

static hs_status put_name(hs_text *head, const hs_fix *fix, int k, hs_error *err)
{
    const self_quantity *quantity = &((const self_state *)fix->state)->quantity[k];
    if (quantity->kind == OF_ISF) return hs_text_printf(head, err, "Fs(%.4g)", quantity->q);
    return hs_text_printf(head, err, "%s", words[quantity->kind]);
}

static hs_status make_origins(hs_fix *fix, hs_error *err)
{
    self_state *state = fix->state;
    HS_TRY(HS_ALLOC(state->origin, (size_t)state->n_origins, err));
    for (int k = 0; k < state->n_origins; ++k) {
        self_origin *origin = &state->origin[k];
        char x[32], v[32];
        snprintf(x, sizeof x, "origin %d", k);
        snprintf(v, sizeof v, "velocity %d", k);
        origin->begun = -1;
        HS_TRY(HS_ALLOC(origin->curve, (size_t)state->n_lags * (size_t)state->n, err));
        HS_TRY(hs_atom_vector_add(fix->env->atoms, &origin->x, "fix", fix->id, x, err));
        if (state->needs_velocities) HS_TRY(hs_atom_vector_add(fix->env->atoms, &origin->v, "fix", fix->id, v, err));
    }
    return HS_OK;
}

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    self_state *state = fix->state;
    hs_correlation *table = &state->table;
    const int first = hs_syntax_first_keyword(&fix->style->about.syntax, args);
    int64_t n_lags;
    HS_TRY(hs_correlation_numbers(fix, args, 2, 1 << 24, &n_lags, err));
    state->n_lags = (int)n_lags;
    HS_TRY(read_quantities(fix, args, first, err));
    HS_TRY(read_keywords(fix, args, first, err));
    HS_TRY(hs_correlation_table(fix, state->n_lags, "TimeDelta", put_name, err));
    for (int lag = 0; lag < state->n_lags; ++lag) table->x[lag] = (double)(lag * table->every);
    const size_t n_all = (size_t)n_lags * (size_t)state->n;
    state->curves.n_series = table->has_errors ? (int)n_all : 0;
    HS_TRY(HS_ALLOC(state->sum, n_all, err));
    return make_origins(fix, err);
}

static void destroy(hs_fix *fix)
{
    self_state *state = fix->state;
    for (int k = 0; k < state->n_origins && state->origin != NULL; ++k) {
        hs_atom_vector_remove(fix->env->atoms, &state->origin[k].x);
        hs_atom_vector_remove(fix->env->atoms, &state->origin[k].v);
        HS_FREE(state->origin[k].curve);
    }
    HS_FREE(state->origin);
    HS_FREE(state->quantity);
    HS_FREE(state->sum);
    hs_series_set_fini(&state->curves);
    hs_correlation_fini(&state->table);
}

static hs_status init(hs_fix *fix, hs_error *err)
{
    return hs_correlation_init(fix, "Motion of single atoms", "time-windows", err);
}

static void begin_origin(hs_fix *fix, self_origin *origin, int64_t sample)
{
    const self_state *state = fix->state;
    const hs_atoms *atoms = fix->env->atoms;
    origin->begun = sample;
    memcpy(origin->center, state->center, sizeof state->center);
    hs_atom_vector_set_places(&origin->x, fix->env, state->center);
    for (int axis = 0; axis < 3 && state->needs_velocities; ++axis)
        memcpy(origin->v.of[axis], atoms->v[axis], sizeof(double) * (size_t)atoms->n_local);
}

/** Mean of exp(-i q d) over all directions of q. */
static double isf_term(double q, double d2, int dimension)
{
    const double x = q * sqrt(d2);
    if (dimension == 2) return j0(x);
    return x < 1e-4 ? 1.0 - x * x / 6.0 : sin(x) / x;
}

/** Some of the sums over atoms: of the quantities [begin, end). */
typedef struct term_context {
    const hs_fix *fix;
    const self_origin *origin;
    int begin, end;
} term_context;

/** Squares of displacements and products of velocities of some atoms; 0 outside of the group. */
static void find_motion(const term_context *c, int begin, int n, double *d2, double *vv)
{
    const self_state *state = c->fix->state;
    const hs_env *env = c->fix->env;
    const hs_atoms *atoms = env->atoms;
    for (int axis = 0; axis < 3; ++axis) {
        const double *v = atoms->v[axis] + begin;
        for (int i = 0; i < n; ++i) {
            const double d =
                hs_unwrapped(env, axis, begin + i) - state->center[axis] - c->origin->x.of[axis][begin + i];
            d2[i] += d * d;
            if (state->needs_velocities) vv[i] += v[i] * c->origin->v.of[axis][begin + i];
        }
    }
    for (int i = 0; i < n; ++i)
        if (!(atoms->mask[begin + i] & c->fix->mask)) d2[i] = vv[i] = 0.0;
}

static void add_terms(const hs_atoms *atoms, const void *context, int begin, int end, hs_exact_sum *sums)
{
    const term_context *c = context;
    const self_state *state = c->fix->state;
    const int n = end - begin, first_term = state->quantity[c->begin].term;
    const int dimension = c->fix->env->box->dimension;
    double d2[HS_EXACT_ARRAY_MAX] = {0.0}, vv[HS_EXACT_ARRAY_MAX] = {0.0}, term[HS_EXACT_ARRAY_MAX];
    find_motion(c, begin, n, d2, vv);
    for (int k = c->begin; k < c->end; ++k) {
        const self_quantity *quantity = &state->quantity[k];
        hs_exact_sum *sum = &sums[quantity->term - first_term];
        if (quantity->kind == OF_MSD || quantity->kind == OF_ALPHA2) hs_exact_add_array(sum, d2, n);
        if (quantity->kind == OF_VACF) hs_exact_add_array(sum, vv, n);
        if (quantity->kind == OF_MSD || quantity->kind == OF_VACF) continue;
        for (int i = 0; i < n; ++i) {
            term[i] = d2[i] * d2[i];
            if (quantity->kind == OF_ISF)
                term[i] = atoms->mask[begin + i] & c->fix->mask ? isf_term(quantity->q, d2[i], dimension) : 0.0;
        }
        hs_exact_add_array(quantity->kind == OF_ALPHA2 ? &sum[1] : sum, term, n);
    }
}

/** The quantities now, counted from an origin: values[n] (collective). */
static void measure(const hs_fix *fix, const self_origin *origin, double n_atoms, double *values)
{
    const self_state *state = fix->state;
    const double dimension = fix->env->box->dimension;
    for (int begin = 0, end; begin < state->n; begin = end) {
        double sums[HS_ATOM_SUM_MAX];
        const int first_term = state->quantity[begin].term;
        for (end = begin; end < state->n && state->quantity[end].term - first_term + 2 <= HS_ATOM_SUM_MAX;) ++end;
        const term_context context = {fix, origin, begin, end};
        const int n_terms = (end < state->n ? state->quantity[end].term : state->n_terms) - first_term;
        hs_atom_sum(fix->env->atoms, fix->env->parallel, add_terms, &context, n_terms, sums);
        for (int k = begin; k < end; ++k) {
            const double *sum = &sums[state->quantity[k].term - first_term];
            values[k] = n_atoms > 0.0 ? sum[0] / n_atoms : 0.0;
            if (state->quantity[k].kind == OF_ALPHA2) /* d <r^4> / ((d + 2) <r^2>^2) - 1 */
                values[k] =
                    sum[0] > 0.0 ? dimension * n_atoms * sum[1] / ((dimension + 2.0) * sum[0] * sum[0]) - 1.0 : 0.0;
        }
    }
}

static hs_status end_curve(self_state *state, self_origin *origin, hs_error *err)
{
    for (size_t k = 0; k < (size_t)state->n_lags * (size_t)state->n; ++k) state->sum[k] += origin->curve[k];
    ++state->n_complete;
    origin->begun = -1;
    return hs_series_set_add(&state->curves, origin->curve, NULL, err);
}

static hs_status take_sample(hs_fix *fix, hs_error *err)
{
    self_state *state = fix->state;
    const int64_t sample = state->n_samples++, spacing = state->n_lags / state->n_origins;
    const double n_atoms = (double)hs_atom_count(fix->env->atoms, fix->env->parallel, fix->mask);
    if (state->has_com) hs_center_of_mass(fix->env, fix->mask, state->center, NULL);
    if (sample % spacing == 0) begin_origin(fix, &state->origin[sample / spacing % state->n_origins], sample);
    for (int k = 0; k < state->n_origins; ++k) {
        self_origin *origin = &state->origin[k];
        if (origin->begun < 0) continue;
        const int64_t lag = sample - origin->begun;
        measure(fix, origin, n_atoms, origin->curve + (size_t)lag * (size_t)state->n);
        if (lag == state->n_lags - 1) HS_TRY(end_curve(state, origin, err));
    }
    return HS_OK;
}

static hs_status finish(hs_fix *fix, hs_error *err)
{
    self_state *state = fix->state;
    hs_correlation *table = &state->table;
    for (int lag = 0; lag < state->n_lags; ++lag) {
        double *row = table->result + (size_t)lag * (size_t)table->n_columns;
        table->count[lag] = (double)state->n_complete;
        for (int k = 0; k < state->n && state->n_complete > 0; ++k) {
            row[k] = state->sum[lag * state->n + k] / (double)state->n_complete;
            if (!table->has_errors) continue;
            const hs_estimate e = hs_series_set_estimate(&state->curves, lag * state->n + k);
            row[state->n + k] = e.n > 1 ? e.error : NAN;
            row[2 * state->n + k] = e.n > 1 ? e.inefficiency : NAN;
        }
    }
    if (!state->is_running) {
        memset(state->sum, 0, (size_t)state->n_lags * (size_t)state->n * sizeof *state->sum);
        state->n_complete = 0;
        hs_series_set_clear(&state->curves);
    }
    return hs_correlation_finish(fix, err);
}

static hs_status end_of_step(hs_fix *fix, hs_error *err)
{
    bool is_due;
    HS_TRY(hs_correlation_sample(fix, NULL, &is_due, err));
    if (!is_due) return HS_OK;
    HS_TRY(take_sample(fix, err));
    return hs_correlation_is_output_due(fix) ? finish(fix, err) : HS_OK;
}

static hs_status keep_state(hs_fix *fix, hs_state *kept, hs_error *err)
{
    self_state *state = fix->state;
    const int64_t n_all = (int64_t)state->n_lags * state->n;
    HS_TRY(hs_state_int64(kept, "samples", &state->n_samples, 1, err));
    HS_TRY(hs_state_int64(kept, "curves", &state->n_complete, 1, err));
    HS_TRY(hs_state_double(kept, "sums", state->sum, n_all, err));
    HS_TRY(hs_series_set_keep(&state->curves, kept, "errors", err));
    for (int k = 0; k < state->n_origins; ++k) {
        self_origin *origin = &state->origin[k];
        char name[48];
        snprintf(name, sizeof name, "origin %d", k);
        HS_TRY(hs_state_int64(kept, name, &origin->begun, 1, err));
        snprintf(name, sizeof name, "center %d", k);
        HS_TRY(hs_state_double(kept, name, origin->center, 3, err));
        snprintf(name, sizeof name, "curve %d", k);
        HS_TRY(hs_state_double(kept, name, origin->curve, n_all, err));
    }
    return hs_correlation_keep(fix, kept, err);
}

const hs_fix_style hs_fix_style_ave_self = {
    .about =
        {.name = "ave/self",
         .syntax = {.usage = "<Nevery> <Nlags> <Nfreq> <quantity> ... [keyword value ...]",
                    .n_min = 4,
                    .n_max = -1,
                    .keywords = keywords},
         .summary = "motion of single atoms: mean squared displacement, velocity correlation, self scattering function",
         .details =
             "Functions of the time t since an origin, averaged over the group's atoms and over many origins:\n\n"
             "- `msd`: <d^2> with d the displacement (distance^2), crossings of periodic faces included. Its slope is "
             "2 dim D at late times.\n"
             "- `vacf`: <v(0) v(t)> (velocity^2). Its integral is dim D.\n"
             "- `alpha2`: the non-Gaussian parameter, dim <d^4> / ((dim + 2) <d^2>^2) - 1; 0 for Gaussian "
             "displacements.\n"
             "- `isf <q>`: the self part of the intermediate scattering function at the wave number q (1/distance), "
             "<exp(-i q d)> averaged over all directions of q: sin(q d)/(q d), in two dimensions the Bessel function "
             "J_0(q d). May be given for several q.\n\n"
             "Atoms are looked at every Nevery steps, up to Nlags - 1 samples from an origin; a new origin begins "
             "every Nlags/origins samples. More of them use a run better, at the cost of their time, and 24 bytes an "
             "atom each (48 with vacf), which travel with the atoms and are part of checkpoints. Only origins count "
             "whose Nlags samples are complete. With `com yes` displacements are relative to the group's center of "
             "mass.\n\n"
             "Results come every Nfreq steps; the file holds the last ones. With `ave one` each is of the curves that "
             "were completed since the one before, so that quantities derived from them (D from the slope of msd) can "
             "be averaged, with their error, by `fix ave/time ... error yes`. The array `f_ID[i][j]` has the columns "
             "time in steps, number of origins, and one for each quantity. With `error yes` a column of standard "
             "errors for each quantity follows, by blocking over the origins, and then one of inefficiencies (origins "
             "that count as one); `nan` for one origin alone. Results are the same on any number of threads and ranks.",
         .reference = "M. P. Allen, D. J. Tildesley, Computer Simulation of Liquids, 2nd ed. (2017), section 8.5; A. "
                      "Rahman, Phys. Rev. 136, A405 (1964), doi:10.1103/PhysRev.136.A405 (alpha2)",
         .example = "fix m all ave/self 10 200 2000 msd vacf isf 7.2 origins 4 com yes error yes file motion.dat\n"
                    "variable D equal (f_m[200][3]-f_m[100][3])/(6*100*10*dt)"},
    .state_size = sizeof(self_state),
    HS_CORRELATION_HOOKS,
};
