/* Takes off the momentum, and if asked the angular momentum, of a group from time to time. */
#include <math.h>
#include <string.h>

#include "core/atom_style.h"
#include "style/atom_sum.h"
#include "style/fix.h"
#include "style/places.h"

typedef struct momentum_state {
    int64_t every;
    bool linear[3], is_angular, is_rescaled;
    double center[3]; /**< of mass, unwrapped, distance */
} momentum_state;

static const hs_keyword keywords[] = {
    {"linear", 3, "<x> <y> <z>", "1 or 0 for each direction: take off the momentum along it"},
    {"angular", 0, "", "take off the angular momentum about the center of mass"},
    {"rescale", 0, "", "then scale velocities so that the kinetic energy stays"},
    {NULL, 0, NULL, NULL},
};

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    momentum_state *state = fix->state;
    HS_TRY(hs_syntax_check(&fix->style->about.syntax, args, false, err));
    HS_TRY(hs_arg_int(args, 0, 1, INT64_MAX, &state->every, err));
    for (int i = 1; i < args->n; ++i) {
        if (strcmp(args->word[i], "linear") == 0) {
            for (int axis = 0; axis < 3; ++axis) {
                int64_t flag;
                HS_TRY(hs_arg_int(args, ++i, 0, 1, &flag, err));
                state->linear[axis] = flag == 1;
            }
        } else if (strcmp(args->word[i], "angular") == 0) {
            state->is_angular = true;
        } else {
            state->is_rescaled = true;
        }
    }
    if (state->is_angular || state->linear[0] || state->linear[1] || state->linear[2]) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "%s: nothing to take off: 'linear 1 1 1' or 'angular' is missing",
                   args->command);
}

static void place_of(const hs_fix *fix, int i, double r[3])
{
    const momentum_state *state = fix->state;
    for (int axis = 0; axis < 3; ++axis) r[axis] = hs_unwrapped(fix->env, axis, i) - state->center[axis];
}

/** Mass, momentum, mass times place, and m v^2. */
static void linear_terms(const hs_atoms *atoms, const void *context, int begin, int end, hs_exact_sum *sums)
{
    const hs_fix *fix = context;
    for (int i = begin; i < end; ++i) {
        double r[3], v2 = 0.0;
        if (!(atoms->mask[i] & fix->mask)) continue;
        const double mass = hs_atom_mass(atoms, i);
        place_of(fix, i, r);
        hs_exact_add(&sums[0], mass);
        for (int axis = 0; axis < 3; ++axis) {
            const double v = atoms->v[axis][i];
            v2 += v * v;
            hs_exact_add(&sums[1 + axis], mass * v);
            hs_exact_add(&sums[4 + axis], mass * r[axis]);
        }
        hs_exact_add(&sums[7], mass * v2);
    }
}

/** Angular momentum about the center: xyz. */
static void angular_terms(const hs_atoms *atoms, const void *context, int begin, int end, hs_exact_sum *sums)
{
    const hs_fix *fix = context;
    for (int i = begin; i < end; ++i) {
        double r[3];
        if (!(atoms->mask[i] & fix->mask)) continue;
        const double mass = hs_atom_mass(atoms, i), v[3] = {atoms->v[0][i], atoms->v[1][i], atoms->v[2][i]};
        place_of(fix, i, r);
        for (int a = 0; a < 3; ++a) {
            const int b = (a + 1) % 3, c = (a + 2) % 3;
            hs_exact_add(&sums[a], mass * (r[b] * v[c] - r[c] * v[b]));
        }
    }
}

/** Second moments of the mass: xx yy zz xy xz yz. */
static void inertia_terms(const hs_atoms *atoms, const void *context, int begin, int end, hs_exact_sum *sums)
{
    const hs_fix *fix = context;
    for (int i = begin; i < end; ++i) {
        double r[3];
        if (!(atoms->mask[i] & fix->mask)) continue;
        const double mass = hs_atom_mass(atoms, i);
        place_of(fix, i, r);
        for (int axis = 0; axis < 3; ++axis) hs_exact_add(&sums[axis], mass * r[axis] * r[axis]);
        hs_exact_add(&sums[3], mass * r[0] * r[1]);
        hs_exact_add(&sums[4], mass * r[0] * r[2]);
        hs_exact_add(&sums[5], mass * r[1] * r[2]);
    }
}

/** omega with inertia omega = l. A direction about which nothing can turn (all atoms on a line) is left out. */
static void solve(double a[3][3], double l[3], double omega[3])
{
    const double largest = fmax(a[0][0], fmax(a[1][1], a[2][2]));
    bool is_left_out[3] = {false};
    for (int k = 0; k < 3; ++k) {
        is_left_out[k] = !(a[k][k] > 1e-12 * largest);
        for (int row = k + 1; row < 3 && !is_left_out[k]; ++row) {
            const double factor = a[row][k] / a[k][k];
            for (int column = k; column < 3; ++column) a[row][column] -= factor * a[k][column];
            l[row] -= factor * l[k];
        }
    }
    for (int k = 2; k >= 0; --k) {
        omega[k] = is_left_out[k] ? 0.0 : l[k];
        for (int column = k + 1; column < 3; ++column) omega[k] -= is_left_out[k] ? 0.0 : a[k][column] * omega[column];
        if (!is_left_out[k]) omega[k] /= a[k][k];
    }
}

static void stop_rotation(const hs_fix *fix)
{
    const hs_env *env = fix->env;
    const hs_atoms *atoms = env->atoms;
    double l[3], m[6], omega[3];
    hs_atom_sum(atoms, env->parallel, angular_terms, fix, 3, l);
    hs_atom_sum(atoms, env->parallel, inertia_terms, fix, 6, m);
    double inertia[3][3] = {{m[1] + m[2], -m[3], -m[4]}, {-m[3], m[0] + m[2], -m[5]}, {-m[4], -m[5], m[0] + m[1]}};
    solve(inertia, l, omega);
#pragma omp parallel for schedule(static)
    for (int i = 0; i < atoms->n_local; ++i) {
        double r[3];
        if (!(atoms->mask[i] & fix->mask)) continue;
        place_of(fix, i, r);
        for (int a = 0; a < 3; ++a) {
            const int b = (a + 1) % 3, c = (a + 2) % 3;
            atoms->v[a][i] -= omega[b] * r[c] - omega[c] * r[b];
        }
    }
}

static void rescale(const hs_fix *fix, double mv2_before)
{
    const hs_atoms *atoms = fix->env->atoms;
    double sums[8];
    hs_atom_sum(atoms, fix->env->parallel, linear_terms, fix, 8, sums);
    if (!(sums[7] > 0.0)) return;
    const double factor = sqrt(mv2_before / sums[7]);
#pragma omp parallel for schedule(static)
    for (int i = 0; i < atoms->n_local; ++i)
        for (int axis = 0; axis < 3 && atoms->mask[i] & fix->mask; ++axis) atoms->v[axis][i] *= factor;
}

static hs_status end_of_step(hs_fix *fix, hs_error *err)
{
    momentum_state *state = fix->state;
    const hs_env *env = fix->env;
    const hs_atoms *atoms = env->atoms;
    double sums[8];
    (void)err;
    if (env->step % state->every != 0) return HS_OK;
    memset(state->center, 0, sizeof state->center);
    hs_atom_sum(atoms, env->parallel, linear_terms, fix, 8, sums);
    if (!(sums[0] > 0.0)) return HS_OK;
    for (int axis = 0; axis < 3; ++axis) {
        const double drift = state->linear[axis] ? sums[1 + axis] / sums[0] : 0.0;
        state->center[axis] = sums[4 + axis] / sums[0];
#pragma omp parallel for schedule(static)
        for (int i = 0; i < atoms->n_local; ++i)
            if (atoms->mask[i] & fix->mask) atoms->v[axis][i] -= drift;
    }
    if (state->is_angular) stop_rotation(fix);
    if (state->is_rescaled) rescale(fix, sums[7]);
    return HS_OK;
}

const hs_fix_style hs_fix_style_momentum = {
    .about = {.name = "momentum",
              .syntax = {.usage = "<N> [linear <x> <y> <z>] [angular] [rescale]",
                         .n_min = 1,
                         .n_max = 1,
                         .keywords = keywords},
              .summary = "take off the momentum of a group from time to time",
              .details = "At every step that is a multiple of N: `linear 1 1 1` subtracts the velocity of the center "
                         "of mass (1 or 0 for each direction), `angular` the rigid rotation about it, with unwrapped "
                         "coordinates; at least one of the two is needed. `rescale` then scales the group's velocities "
                         "so that its kinetic energy is what it was.",
              .example = "fix 1 all momentum 100 linear 1 1 1\nfix 1 drop momentum 10 linear 1 1 1 angular rescale"},
    .state_size = sizeof(momentum_state),
    .create = create,
    .end_of_step = end_of_step,
    .allows_dynamic_group = true,
    .keeps_plane = true,
};
