/* Tabulated potential: energy and force are read from a file, and looked up in N points equally spaced in r^2.
 *
 * Between two points, U and F/r are polynomials in t, which goes from 0 to 1: constants (lookup), straight lines (linear)
 * or cubics (spline). All have the same kernel: one interval is eight numbers, which fill one line of a cache.
 * Units: distance, energy, force of the deck. */
#include "kernel/evaluator.h"

enum { INNER_R2, PER_R2, LAST, FIRST, N_PARAMS };
/** In an interval: coefficients of F/r, then of U. */
enum { FORCE = 0, ENERGY = 4, PER_INTERVAL = 8 };

static inline __attribute__((always_inline)) hs_vec cubic(const double *c, const int32_t *at, hs_vec t)
{
    const hs_vec c3 = hs_gather(c + 3, 0.0, at, false), c2 = hs_gather(c + 2, 0.0, at, false),
                 c1 = hs_gather(c + 1, 0.0, at, false);
    return hs_fma(hs_fma(hs_fma(c3, t, c2), t, c1), t, hs_gather(c, 0.0, at, false));
}

HS_EVALUATE(const hs_vec *p, const double *shared, hs_vec r2, hs_vec *force_over_r, hs_vec *energy, bool with_energy)
{
    const hs_vec place = (r2 - p[INNER_R2]) * p[PER_R2];
    int32_t at[HS_LANES];
    /* an interval of the table also where r is beyond the cutoff, or not a number */
    hs_to_indices(hs_max(hs_min(place, p[LAST]), hs_set1(0.0)), at);
    const hs_vec interval = hs_from_indices(at), t = place - interval;
    hs_to_indices(interval + p[FIRST], at);
    for (int k = 0; k < HS_LANES; ++k) at[k] *= PER_INTERVAL;
    /* the table says nothing of closer pairs: that ends the run, as atoms at one place do */
    *force_over_r = hs_select(hs_less(place, hs_set1(0.0)), hs_set1((double)INFINITY), cubic(shared + FORCE, at, t));
    if (with_energy) *energy = cubic(shared + ENERGY, at, t);
}

#define HS_EVALUATOR table
#define HS_EVALUATOR_SHARED
#include "kernel/instantiate.h"

#ifndef HS_KERNEL_ISA

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "core/cubic_spline.h"
#include "io/files.h"
#include "io/potential_file.h"
#include "style/pair.h"

/** Intervals of all pairs of types together: their numbers must be exact in single precision. */
enum { INTERVALS_MAX = 1 << 24 };

typedef enum { LOOKUP, LINEAR, SPLINE } interpolation;

/** Of one pair of types. */
typedef struct intervals {
    double inner, cutoff; /**< distance; cutoff 0: not given */
    double *c;            /**< owned: [n_intervals * PER_INTERVAL] */
    int first;            /**< its first interval among all, by init */
} intervals;

typedef struct table_state {
    interpolation kind;
    int n_intervals; /**< of each pair of types */
    intervals *of;   /**< owned, by hs_pair_index */
    double *all;     /**< owned: the intervals of all pairs of types that have different ones */
} table_state;

static size_t n_pairs(const hs_pair *pair) { return (size_t)(pair->n_types + 1) * (size_t)(pair->n_types + 1); }

static void forget(hs_pair *pair)
{
    table_state *state = pair->state;
    for (size_t k = 0; k < n_pairs(pair) && state->of != NULL; ++k) HS_FREE(state->of[k].c);
    HS_FREE(state->of);
    HS_FREE(state->all);
}

static hs_status settings(hs_pair *pair, const hs_args *args, hs_error *err)
{
    static const char *const kinds[] = {"lookup", "linear", "spline", NULL};
    table_state *state = pair->state;
    int kind;
    int64_t n;
    HS_TRY(hs_arg_choice(args, 0, kinds, &kind, err));
    HS_TRY(hs_arg_int(args, 1, 2, INTERVALS_MAX, &n, err));
    forget(pair);
    memset(pair->is_set, 0, n_pairs(pair) * sizeof *pair->is_set);
    state->kind = (interpolation)kind;
    state->n_intervals = (int)n - 1;
    return HS_ALLOC(state->of, n_pairs(pair), err);
}

/** What the file says, as smooth functions of r. */
typedef struct curves {
    hs_tabulated data;
    hs_spline energy, force;
} curves;

static void free_curves(curves *from)
{
    hs_spline_fini(&from->energy);
    hs_spline_fini(&from->force);
    hs_tabulated_fini(&from->data);
}

static double force_over_r(const curves *from, double r) { return hs_spline_at(&from->force, r) / r; }

/** U and F/r at n points equally spaced in r^2 from r2 on; places, if not NULL, gets their r^2. */
static void sample(const curves *from, int n, double r2, double step, double *u, double *f, double *places)
{
    for (int i = 0; i < n; ++i) {
        const double place = r2 + i * step, r = sqrt(place);
        u[i] = hs_spline_at(&from->energy, r);
        f[i] = force_over_r(from, r);
        if (places != NULL) places[i] = place;
    }
}

/** Constants (the values in the middle of each interval) or straight lines. */
static void fill_simple(const curves *from, const table_state *state, intervals *to, double *u, double *f)
{
    const bool is_linear = state->kind == LINEAR;
    const double r2 = to->inner * to->inner, step = (to->cutoff * to->cutoff - r2) / state->n_intervals;
    sample(from, state->n_intervals + is_linear, is_linear ? r2 : r2 + 0.5 * step, step, u, f, NULL);
    for (int i = 0; i < state->n_intervals; ++i) {
        double *c = to->c + PER_INTERVAL * (size_t)i;
        c[FORCE] = f[i];
        c[ENERGY] = u[i];
        if (!is_linear) continue;
        c[FORCE + 1] = f[i + 1] - f[i];
        c[ENERGY + 1] = u[i + 1] - u[i];
    }
}

/** Cubics: splines in r^2 through the points. dU/d(r^2) = -F/(2 r) at the ends; the slope of F/r there is that of the chord
 *  of a tenth of an interval. */
static hs_status fill_spline(const curves *from, const table_state *state, intervals *to, double *u, double *f,
                             double *places, hs_error *err)
{
    const int n = state->n_intervals + 1;
    const double r2 = to->inner * to->inner, end = to->cutoff * to->cutoff, step = (end - r2) / state->n_intervals;
    const double near = 0.1 * step;
    hs_spline energy = {.n = 0}, force = {.n = 0};
    sample(from, n, r2, step, u, f, places);
    hs_status status = hs_spline_fit(&energy, n, places, u, -0.5 * f[0], -0.5 * f[n - 1], err);
    if (status == HS_OK)
        status = hs_spline_fit(&force, n, places, f, (force_over_r(from, sqrt(r2 + near)) - f[0]) / near,
                               (f[n - 1] - force_over_r(from, sqrt(end - near))) / near, err);
    for (int i = 0; i < n - 1 && status == HS_OK; ++i) {
        hs_spline_piece(&force, i, to->c + PER_INTERVAL * (size_t)i + FORCE);
        hs_spline_piece(&energy, i, to->c + PER_INTERVAL * (size_t)i + ENERGY);
    }
    hs_spline_fini(&energy);
    hs_spline_fini(&force);
    return status;
}

static hs_status fill(const curves *from, const table_state *state, intervals *to, hs_error *err)
{
    const size_t n = (size_t)state->n_intervals + 1;
    double *room = NULL; /* u, f and places */
    HS_TRY(HS_ALLOC(to->c, PER_INTERVAL * n, err));
    HS_TRY(HS_ALLOC(room, 3 * n, err));
    hs_status status = HS_OK;
    if (state->kind == SPLINE)
        status = fill_spline(from, state, to, room, room + n, room + 2 * n, err);
    else
        fill_simple(from, state, to, room, room + n);
    HS_FREE(room);
    return status;
}

static hs_status read_curves(curves *from, const hs_pair *pair, const hs_args *args, hs_error *err)
{
    hs_tabulated *data = &from->data;
    HS_TRY(hs_tabulated_read(data, args->command, args->word[0], args->word[1], pair->env->parallel, err));
    HS_TRY(
        hs_spline_fit(&from->energy, data->n, data->r, data->energy, -data->force[0], -data->force[data->n - 1], err));
    return hs_spline_fit(&from->force, data->n, data->r, data->force, data->slope[0], data->slope[1], err);
}

/** Forces of the file should be slopes of its energies: between those of the chords to both neighbors, except where the
 *  force has an extreme. */
static void warn_of_forces(const hs_pair *pair, const hs_tabulated *data, const hs_args *args)
{
    enum { MAY_BE_EXTREMES = 3 };
    int n_bad = 0, first = 0;
    for (int i = 1; i < data->n - 1; ++i) {
        const double *r = data->r + i, *u = data->energy + i, f = data->force[i];
        const double before = (u[-1] - u[0]) / (r[0] - r[-1]), after = (u[0] - u[1]) / (r[1] - r[0]);
        const double rounding = 1e-10 * (fabs(before) + fabs(after));
        if (f >= fmin(before, after) - rounding && f <= fmax(before, after) + rounding) continue;
        if (n_bad++ == 0) first = i + 1;
    }
    if (n_bad > MAY_BE_EXTREMES)
        hs_warn(pair->env->out,
                "%s: %d of %d forces in section '%s' of '%s' (the first in row %d) are not between the slopes of the "
                "energy on both sides; energy will not be conserved",
                args->command, n_bad, data->n, args->word[1], args->word[0], first);
}

static hs_status make(intervals *made, const curves *from, const table_state *state, const hs_args *args, hs_error *err)
{
    const double first = from->data.r[0], last = from->data.r[from->data.n - 1];
    *made = (intervals){.inner = first, .cutoff = last};
    if (args->n > 2) HS_TRY(hs_arg_positive(args, 2, &made->cutoff, err));
    if (made->cutoff <= first || made->cutoff > last)
        return hs_fail(err, HS_ERROR_INPUT, "%s: the cutoff %g is outside of the table, which goes from %g to %g",
                       args->command, made->cutoff, first, last);
    return fill(from, state, made, err);
}

/** halfshell check: a file that the deck itself will write is not there yet. A potential of zero stands for it. */
static hs_status pretend(hs_pair *pair, intervals *made, const hs_args *args, hs_error *err)
{
    const table_state *state = pair->state;
    *made = (intervals){.cutoff = 1.0};
    if (args->n > 2) HS_TRY(hs_arg_positive(args, 2, &made->cutoff, err));
    hs_warn(pair->env->out, "%s: '%s' is not there; unless the deck itself writes it before, the run will end here",
            args->command, args->word[0]);
    return HS_ALLOC(made->c, PER_INTERVAL * ((size_t)state->n_intervals + 1), err);
}

static hs_status coeff(hs_pair *pair, int i, int j, const hs_args *args, hs_error *err)
{
    const table_state *state = pair->state;
    intervals *to = &state->of[hs_pair_index(pair, i, j)], made = {.c = NULL};
    curves from = {.data = {.n = 0}};
    hs_status status;
    if (pair->env->dry_run && !hs_file_is_readable(pair->env->parallel, args->word[0])) {
        status = pretend(pair, &made, args, err);
    } else {
        status = read_curves(&from, pair, args, err);
        if (status == HS_OK) warn_of_forces(pair, &from.data, args);
        if (status == HS_OK) status = make(&made, &from, state, args, err);
        free_curves(&from);
    }
    if (status != HS_OK) {
        HS_FREE(made.c);
        return status;
    }
    HS_FREE(to->c);
    *to = made;
    return HS_OK;
}

/** Put the intervals of all pairs of types one after the other, those that are the same once. */
static hs_status init(hs_pair *pair, hs_error *err)
{
    table_state *state = pair->state;
    const size_t size = PER_INTERVAL * (size_t)state->n_intervals;
    size_t n = 0;
    HS_FREE(state->all);
    for (size_t k = 0; k < n_pairs(pair); ++k) {
        intervals *of = &state->of[k];
        if (of->c == NULL) continue;
        size_t same = 0;
        while (same < n && memcmp(state->all + same * size, of->c, size * sizeof *of->c) != 0) ++same;
        if ((same + 1) * (size_t)state->n_intervals > INTERVALS_MAX)
            return hs_fail(err, HS_ERROR_INPUT, "pair_style table: the tables have together more than %d points",
                           INTERVALS_MAX);
        if (same == n) {
            HS_TRY(HS_GROW(state->all, n * size, (n + 1) * size, err));
            memcpy(state->all + n * size, of->c, size * sizeof *of->c);
            ++n;
        }
        of->first = (int)(same * (size_t)state->n_intervals);
    }
    return HS_OK;
}

static const double *shared(const hs_pair *pair) { return ((const table_state *)pair->state)->all; }

static void params(const hs_pair *pair, int i, int j, double *cutoff, double *p)
{
    const table_state *state = pair->state;
    const intervals *of = &state->of[hs_pair_index(pair, i, j)];
    const double inner2 = of->inner * of->inner;
    *cutoff = of->cutoff;
    if (of->c == NULL) return;
    p[INNER_R2] = inner2;
    p[PER_R2] = state->n_intervals / (of->cutoff * of->cutoff - inner2);
    p[LAST] = state->n_intervals - 1;
    p[FIRST] = of->first;
}

const hs_pair_style hs_pair_style_table = {
    .about =
        {.name = "table",
         .syntax = {.usage = "lookup|linear|spline <N>", .n_min = 2, .n_max = 2},
         .summary = "tabulated potential, read from a file",
         .details =
             "Energy and force come from a table of N points, equally spaced in r^2, which is made from the rows of a "
             "file: `lookup` takes the values in the middle between two points, `linear` a straight line between them, "
             "`spline` cubic splines. All three are equally fast; `spline` needs the fewest points.\n\n"
             "`pair_coeff I J <file> <section> [<cutoff>]`: the section of the file, and a cutoff within it (distance; "
             "default the last distance of the section). Every pair of types must be given; a pair_style given again "
             "forgets them.\n\n"
             "A file (plain or compressed by gzip) has any number of sections, each of the form\n\n"
             "    NAME\n"
             "    N 500 R 0.8 2.5\n\n"
             "    1 0.80 43.2 815.3\n"
             "    2 0.80340681 40.5 770.2\n"
             "    ...\n\n"
             "with number, distance, energy and force (-dU/dr) in each row, in the units of the deck. `R <first> "
             "<last>` or `RSQ <first> <last>` give the distances instead, equally spaced in r or r^2; those of the "
             "rows are then not read. `FPRIME <first> <last>` are the slopes dF/dr at both ends (default: of the first "
             "and the last two rows). Between the rows, energy and force are cubic splines in r. A comment begins with "
             "`#`. `pair_write` writes such files.\n\n"
             "Atoms closer than the first distance of the table end the run. Force and energy of the file are taken as "
             "they are: where one is not the slope of the other, energy is not conserved. LAMMPS's style `bitmap` is "
             "not supported, and data files hold no tables: give them in the deck.",
         .example = "pair_style table spline 2000\npair_coeff * * potentials.table LJ_12_6 2.5"},
    .coeff_syntax = {.usage = "<file> <section> [<cutoff>]", .n_min = 2, .n_max = 3},
    .state_size = sizeof(table_state),
    .settings = settings,
    .destroy = forget,
    .coeff = coeff,
    .init = init,
    .params = params,
    .shared = shared,
    .evaluator = &hs_evaluator_table,
};

#endif
