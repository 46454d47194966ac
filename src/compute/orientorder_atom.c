/* Bond-orientational order of each atom in three dimensions, from the spherical harmonics of the directions to its N
 * neighbors:
 *     Y_lm = (1/N) sum over neighbors of Y_lm(theta, phi),  Q_l = sqrt(4 pi/(2 l + 1) sum_m |Y_lm|^2),
 *     W_l = sum over m1 + m2 + m3 = 0 of (l l l; m1 m2 m3) Y_lm1 Y_lm2 Y_lm3,  W^_l = W_l / (sum_m |Y_lm|^2)^(3/2)
 * with Wigner's 3j symbol (l l l; m1 m2 m3), taken from Racah's sum.
 * Source: P. J. Steinhardt, D. R. Nelson, M. Ronchetti, Phys. Rev. B 28, 784 (1983), doi:10.1103/PhysRevB.28.784. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "style/nearest.h"

/* Racah's sum in long double loses more than the last digits of a double beyond the second. */
enum { DEGREE_MAX = 200, DEGREE_MAX_W = 30 };

typedef struct orient_state {
    double cutoff; /**< 0: that of the pair style */
    int n_nearest; /**< neighbors that count; 0: all within the cutoff */
    int *degree;   /**< owned [n_degrees] */
    int n_degrees, degree_max;
    bool has_w, has_w_hat;
    int component;    /**< index of the degree whose harmonics are columns, too; -1: none */
    double *legendre; /**< owned [degree_max + 1][degree_max + 1][2]: factors of the recursion */
    double **wigner;  /**< owned [n_degrees], each [2 l + 1][2 l + 1]: 3j symbols of m1 and m2 */
    int n_harmonics;  /**< of all degrees together, m >= 0 */
} orient_state;

static const hs_keyword keywords[] = {
    {"cutoff", 1, "<distance>", "where neighbors are looked for (default: the cutoff of the pair style)"},
    {"nnn", 1, "<N>|NULL", "nearest neighbors that count; NULL: all within the cutoff (default: 12)"},
    {"degrees", -1, "<n> <l1> ... <ln>", "degrees of the harmonics (default: 5 4 6 8 10 12)"},
    {"wl", 1, "yes|no", "also the invariants W_l (default: no)"},
    {"wl/hat", 1, "yes|no", "also the normalised invariants W_l (default: no)"},
    {"components", 1, "<l>", "also the normalised harmonics of this degree"},
    {NULL, 0, NULL, NULL},
};

static hs_status set_degrees(orient_state *state, const int *degree, int n, hs_error *err)
{
    HS_TRY(HS_GROW(state->degree, 0, (size_t)n, err));
    memcpy(state->degree, degree, (size_t)n * sizeof *degree);
    state->n_degrees = n;
    return HS_OK;
}

/** Words from @p i on, up to the next keyword at @p end: how many degrees, and these. */
static hs_status read_degrees(orient_state *state, const hs_args *args, int i, int end, hs_error *err)
{
    int64_t n, value;
    HS_TRY(hs_arg_int(args, i, 1, DEGREE_MAX + 1, &n, err));
    if (end - i - 1 != n)
        return hs_fail(err, HS_ERROR_INPUT, "%s: degrees: %lld are announced, but %d follow", args->command,
                       (long long)n, end - i - 1);
    HS_TRY(HS_GROW(state->degree, 0, (size_t)n, err));
    for (state->n_degrees = 0; state->n_degrees < n; ++state->n_degrees) {
        HS_TRY(hs_arg_int(args, i + 1 + state->n_degrees, 0, DEGREE_MAX, &value, err));
        state->degree[state->n_degrees] = (int)value;
    }
    return HS_OK;
}

/** Index of the first keyword from word @p i on, args->n when there is none. */
static int next_keyword(const hs_args *args, int i)
{
    for (; i < args->n; ++i)
        for (const hs_keyword *k = keywords; k->name != NULL; ++k)
            if (strcmp(k->name, args->word[i]) == 0) return i;
    return i;
}

static hs_status read_keywords(hs_compute *compute, const hs_args *args, int64_t *component, hs_error *err)
{
    orient_state *state = compute->state;
    for (int i = 0, end; i < args->n; i = end) {
        const char *word = args->word[i];
        int64_t n;
        end = next_keyword(args, i + 1);
        if (strcmp(word, "cutoff") == 0)
            HS_TRY(hs_arg_positive(args, i + 1, &state->cutoff, err));
        else if (strcmp(word, "wl") == 0)
            HS_TRY(hs_arg_bool(args, i + 1, &state->has_w, err));
        else if (strcmp(word, "wl/hat") == 0)
            HS_TRY(hs_arg_bool(args, i + 1, &state->has_w_hat, err));
        else if (strcmp(word, "components") == 0)
            HS_TRY(hs_arg_int(args, i + 1, 0, DEGREE_MAX, component, err));
        else if (strcmp(word, "degrees") == 0)
            HS_TRY(read_degrees(state, args, i + 1, end, err));
        else if (strcmp(args->word[i + 1], "NULL") == 0)
            state->n_nearest = 0;
        else {
            HS_TRY(hs_arg_int(args, i + 1, 1, 1000, &n, err));
            state->n_nearest = (int)n;
        }
    }
    return HS_OK;
}

/** n!; finite for all n that occur. */
static long double factorial(int n)
{
    long double product = 1.0L;
    for (int k = 2; k <= n; ++k) product *= k;
    return product;
}

/** Wigner's 3j symbol (l l l; m1 m2 -m1-m2) by Racah's formula. */
static double wigner_3j(int l, int m1, int m2)
{
    const int m3 = -m1 - m2;
    long double sum = 0.0L, scale = factorial(l) * factorial(l) * factorial(l) / factorial(3 * l + 1);
    if (m3 < -l || m3 > l) return 0.0;
    scale *= factorial(l + m1) * factorial(l - m1) * factorial(l + m2) * factorial(l - m2);
    scale *= factorial(l + m3) * factorial(l - m3);
    for (int k = 0; k <= l; ++k) {
        if (l - m1 - k < 0 || l + m2 - k < 0 || m1 + k < 0 || k - m2 < 0) continue;
        const long double term = sqrtl(scale) / (factorial(k) * factorial(l - k) * factorial(l - m1 - k)) /
                                 (factorial(l + m2 - k) * factorial(m1 + k) * factorial(k - m2));
        sum += k % 2 == 0 ? term : -term;
    }
    return (double)(m3 % 2 == 0 ? sum : -sum);
}

static hs_status make_wigner(orient_state *state, const char *command, hs_error *err)
{
    HS_TRY(HS_ALLOC(state->wigner, (size_t)state->n_degrees, err));
    for (int k = 0; k < state->n_degrees; ++k) {
        const int l = state->degree[k], n = 2 * l + 1;
        if (l > DEGREE_MAX_W)
            return hs_fail(err, HS_ERROR_INPUT, "%s: W_l is computed up to degree %d, not %d", command, DEGREE_MAX_W,
                           l);
        HS_TRY(HS_ALLOC(state->wigner[k], (size_t)n * (size_t)n, err));
        for (int m1 = -l; m1 <= l; ++m1)
            for (int m2 = -l; m2 <= l; ++m2) state->wigner[k][(m1 + l) * n + m2 + l] = wigner_3j(l, m1, m2);
    }
    return HS_OK;
}

/** Factors of  P_lm = a (cos(theta) P_(l-1)m - b P_(l-2)m),  of normalised Legendre functions; a of P_mm = a sin(theta)
 *  P_(m-1)(m-1) on the diagonal. */
static hs_status make_legendre(orient_state *state, hs_error *err)
{
    const int n = state->degree_max + 1;
    HS_TRY(HS_ALLOC(state->legendre, (size_t)n * (size_t)n * 2, err));
    for (int l = 0; l < n; ++l)
        for (int m = 0; m <= l; ++m) {
            double *factor = state->legendre + 2 * (l * n + m);
            const double ll = (double)l * l, mm = (double)m * m, before = (double)(l - 1) * (l - 1);
            if (l == m) {
                factor[0] = m == 0 ? sqrt(1.0 / (4.0 * M_PI)) : -sqrt((2.0 * m + 1.0) / (2.0 * m));
            } else {
                factor[0] = sqrt((4.0 * ll - 1.0) / (ll - mm));
                factor[1] = sqrt(fmax(before - mm, 0.0) / (4.0 * before - 1.0));
            }
        }
    return HS_OK;
}

static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    static const int usual[] = {4, 6, 8, 10, 12};
    orient_state *state = compute->state;
    int64_t component = -1;
    state->n_nearest = 12;
    state->component = -1;
    HS_TRY(hs_syntax_check(&compute->style->about.syntax, args, false, err));
    HS_TRY(set_degrees(state, usual, 5, err));
    HS_TRY(read_keywords(compute, args, &component, err));
    for (int k = 0; k < state->n_degrees; ++k) {
        if (state->degree[k] > state->degree_max) state->degree_max = state->degree[k];
        if (state->degree[k] == component) state->component = k;
        state->n_harmonics += state->degree[k] + 1;
    }
    if (component >= 0 && state->component < 0)
        return hs_fail(err, HS_ERROR_INPUT, "%s: components: %lld is not among the degrees", args->command,
                       (long long)component);
    compute->n_atom_columns = state->n_degrees * (1 + state->has_w + state->has_w_hat) +
                              (state->component >= 0 ? 2 * (2 * (int)component + 1) : 0);
    if (state->has_w || state->has_w_hat) HS_TRY(make_wigner(state, args->command, err));
    return make_legendre(state, err);
}

static void destroy(hs_compute *compute)
{
    orient_state *state = compute->state;
    for (int k = 0; state->wigner != NULL && k < state->n_degrees; ++k) HS_FREE(state->wigner[k]);
    HS_FREE(state->wigner);
    HS_FREE(state->legendre);
    HS_FREE(state->degree);
}

/** A complex number. */
typedef struct harmonic {
    double re, im;
} harmonic;

/** Add the harmonics of one direction, from the neighbor to the atom (as in LAMMPS; it is the sign of odd degrees), m
 *  >= 0 of each degree in turn, to sums[n_harmonics]. */
static void add_direction(const orient_state *state, const hs_near *near, harmonic *sums)
{
    const int n = state->degree_max + 1;
    const double r = sqrt(near->r2), rho = hypot(near->d[0], near->d[1]);
    const double cosine = -near->d[2] / r, sine = rho / r;
    const harmonic turn = rho > 0.0 ? (harmonic){-near->d[0] / rho, -near->d[1] / rho} : (harmonic){1.0, 0.0};
    harmonic phase = {1.0, 0.0}; /* exp(i m phi) */
    double diagonal = 1.0;       /* P_mm */
    for (int m = 0; m < n; ++m) {
        diagonal *= state->legendre[2 * (m * n + m)] * (m > 0 ? sine : 1.0);
        double before = 0.0, now = diagonal;
        for (int l = m; l < n; ++l) {
            if (l > m) {
                const double *factor = state->legendre + 2 * (l * n + m);
                const double next = factor[0] * (cosine * now - factor[1] * before);
                before = now;
                now = next;
            }
            harmonic *sum = sums;
            for (int k = 0; k < state->n_degrees; sum += state->degree[k] + 1, ++k) {
                if (state->degree[k] != l) continue;
                sum[m].re += now * phase.re;
                sum[m].im += now * phase.im;
            }
        }
        phase = (harmonic){phase.re * turn.re - phase.im * turn.im, phase.re * turn.im + phase.im * turn.re};
    }
}

/** Y_lm for any sign of m. */
static harmonic of_m(const harmonic *y, int m)
{
    if (m >= 0) return y[m];
    return m % 2 == 0 ? (harmonic){y[-m].re, -y[-m].im} : (harmonic){-y[-m].re, y[-m].im};
}

/** W_l, which is real: the imaginary parts of (m1, m2, m3) and (-m1, -m2, -m3) cancel for even l, and it is 0 for odd
 *  l. */
static double third_order(const double *wigner, const harmonic *y, int l)
{
    double sum = 0.0;
    for (int m1 = -l; m1 <= l; ++m1)
        for (int m2 = -l; m2 <= l; ++m2) {
            if (m1 + m2 < -l || m1 + m2 > l) continue;
            const harmonic a = of_m(y, m1), b = of_m(y, m2), c = of_m(y, -m1 - m2);
            const harmonic ab = {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
            sum += wigner[(m1 + l) * (2 * l + 1) + m2 + l] * (ab.re * c.re - ab.im * c.im);
        }
    return sum;
}

/** The columns of one atom from its neighbors; @p sums is room for the harmonics. */
static void find_order(const orient_state *state, const hs_near *near, int n, harmonic *sums, double *column)
{
    int at = 0, n_used = 0;
    memset(sums, 0, (size_t)state->n_harmonics * sizeof *sums);
    if (n == 0 || n < state->n_nearest) return;
    for (int k = 0; k < n; ++k) {
        if (!(near[k].r2 > 0.0)) continue; /* atoms at one place have no direction */
        add_direction(state, &near[k], sums);
        ++n_used;
    }
    if (n_used == 0) return;
    for (int k = 0; k < state->n_harmonics; ++k) sums[k] = (harmonic){sums[k].re / n_used, sums[k].im / n_used};
    for (int k = 0; k < state->n_degrees; at += state->degree[k] + 1, ++k) {
        const int l = state->degree[k];
        const harmonic *y = sums + at;
        double square = y[0].re * y[0].re;
        for (int m = 1; m <= l; ++m) square += 2.0 * (y[m].re * y[m].re + y[m].im * y[m].im);
        column[k] = sqrt(4.0 * M_PI / (2.0 * l + 1.0) * square);
        const double w = state->wigner != NULL ? third_order(state->wigner[k], y, l) : 0.0;
        const double norm = sqrt(square);
        if (state->has_w) column[state->n_degrees + k] = w;
        if (state->has_w_hat && norm > 1e-12)
            column[state->n_degrees * (1 + state->has_w) + k] = w / (norm * norm * norm);
        if (k != state->component || !(norm > 1e-12)) continue;
        double *component = column + state->n_degrees * (1 + state->has_w + state->has_w_hat);
        for (int m = -l; m <= l; ++m) {
            *component++ = of_m(y, m).re / norm;
            *component++ = of_m(y, m).im / norm;
        }
    }
}

/** Room of one thread: harmonics, then columns. */
static size_t room_of(const hs_compute *compute)
{
    return 2 * (size_t)((const orient_state *)compute->state)->n_harmonics + (size_t)compute->n_atom_columns;
}

static void find_orders(hs_compute *compute, const hs_nearest *nearest, double *room)
{
    const orient_state *state = compute->state;
    const hs_atoms *atoms = compute->env->atoms;
    const size_t n_local = (size_t)atoms->n_local;
#pragma omp parallel
    {
        double *mine = room + room_of(compute) * (size_t)hs_thread_number();
        double *column = mine + 2 * (size_t)state->n_harmonics;
#pragma omp for schedule(static)
        for (size_t i = 0; i < n_local; ++i) {
            int n;
            const hs_near *near = hs_nearest_of(nearest, (int)i, state->n_nearest, &n);
            memset(column, 0, (size_t)compute->n_atom_columns * sizeof *column);
            if (atoms->mask[i] & compute->mask) find_order(state, near, n, (harmonic *)mine, column);
            for (int k = 0; k < compute->n_atom_columns; ++k) compute->atoms[(size_t)k * n_local + i] = column[k];
        }
    }
}

static hs_status per_atom(hs_compute *compute, hs_error *err)
{
    const orient_state *state = compute->state;
    hs_nearest nearest = {0};
    double range, *room = NULL;
    HS_TRY(hs_nearest_range(compute, state->cutoff, &range, err));
    hs_status status = HS_ALLOC(room, room_of(compute) * (size_t)hs_threads_get(), err);
    if (hs_parallel_agree(compute->env->parallel, err) != HS_OK) status = err->status;
    if (status == HS_OK) status = hs_nearest_find(&nearest, compute->env, range, state->n_nearest, err);
    if (status == HS_OK) find_orders(compute, &nearest, room);
    hs_nearest_fini(&nearest);
    HS_FREE(room);
    return status;
}

const hs_compute_style hs_compute_style_orientorder_atom = {
    .about =
        {.name = "orientorder/atom",
         .syntax = {.usage = "[keyword value ...]", .n_min = 0, .n_max = 0, .keywords = keywords},
         .summary = "Steinhardt's bond-orientational order parameters of each atom, in three dimensions",
         .details = "From the directions to the N nearest neighbors: the mean of the spherical harmonics Y_lm over the "
                    "neighbors, and its invariants Q_l = sqrt(4 pi/(2 l + 1) sum |Y_lm|^2), from 0 to 1. `c_ID[1]`, "
                    "... are the Q_l in the order of the degrees. With `wl yes` the third-order invariants W_l follow, "
                    "with `wl/hat yes` W_l / (sum |Y_lm|^2)^(3/2) (both up to degree 30), with `components l` the real "
                    "and imaginary parts of Y_lm / sqrt(sum |Y_lm|^2) from m = -l to l.\n\n"
                    "Neighbors are all atoms, of any group. An atom with fewer than N neighbors within the cutoff, or "
                    "outside of the compute's group, has 0. With 12 neighbors Q_6 is 0.575 in an fcc crystal, 0.485 in "
                    "hcp, 0.663 around an atom of an icosahedron; with 14, Q_6 is 0.511 in bcc.",
         .reference =
             "P. J. Steinhardt, D. R. Nelson, M. Ronchetti, Phys. Rev. B 28, 784 (1983), doi:10.1103/PhysRevB.28.784",
         .example = "compute q all orientorder/atom degrees 2 4 6 nnn 12 cutoff 2.0\n"
                    "compute w all orientorder/atom wl/hat yes components 6"},
    .state_size = sizeof(orient_state),
    .create = create,
    .destroy = destroy,
    .per_atom = per_atom,
};
