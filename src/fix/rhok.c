/* Bias on a Fourier mode of the density: E = K/2 (|rho_k| - a)^2, rho_k = sum_j exp(-i k r_j) / sqrt(N), k = 2 pi n /
 * L.
 * Source: U. R. Pedersen, J. Chem. Phys. 139, 104102 (2013), doi:10.1063/1.4818747. */
#include <math.h>
#include <string.h>

#include "style/atom_sum.h"
#include "style/fix.h"
#include "style/upright.h"

typedef struct rhok_state {
    int64_t n[3];     /**< waves in the box along each axis */
    double k, anchor; /**< energy; without unit */
    double mode[3];   /**< real and imaginary part of the latest rho_k, its length */
    double energy;
    double wave[3]; /**< the wave vector now, 1/distance */
    double push[2]; /**< force along the wave vector, in units of its length: push[0] sin(k r) + push[1] cos(k r) */
} rhok_state;

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    rhok_state *state = fix->state;
    HS_TRY(hs_syntax_check(&fix->style->about.syntax, args, false, err));
    for (int axis = 0; axis < 3; ++axis) {
        HS_TRY(hs_arg_int(args, axis, -1000000, 1000000, &state->n[axis], err));
        if (state->n[axis] != 0 && !fix->env->box->periodic[axis])
            return hs_fail(
                err, HS_ERROR_INPUT,
                "%s: the box is not periodic in %c, so waves along it have no meaning ('boundary' makes it periodic)",
                args->command, "xyz"[axis]);
    }
    HS_TRY(hs_arg_double(args, 3, &state->k, err));
    return hs_arg_double(args, 4, &state->anchor, err);
}

static hs_status init(hs_fix *fix, hs_error *err) { return hs_need_upright(fix->env, "fix rhok", err); }

static inline double phase_of(const rhok_state *state, const hs_atoms *atoms, int i)
{
    return state->wave[0] * atoms->x[0][i] + state->wave[1] * atoms->x[1][i] + state->wave[2] * atoms->x[2][i];
}

static void add_waves(const hs_atoms *atoms, const void *context, int begin, int end, hs_exact_sum *sums)
{
    const hs_fix *fix = context;
    for (int i = begin; i < end; ++i) {
        if (!(atoms->mask[i] & fix->mask)) continue;
        const double phase = phase_of(fix->state, atoms, i);
        hs_exact_add(&sums[0], cos(phase));
        hs_exact_add(&sums[1], -sin(phase));
        hs_exact_add(&sums[2], 1.0);
    }
}

static void push(const hs_fix *fix)
{
    const hs_atoms *atoms = fix->env->atoms;
    const rhok_state *state = fix->state;
#pragma omp for schedule(static) nowait
    for (int i = 0; i < atoms->n_local; ++i) {
        if (!(atoms->mask[i] & fix->mask)) continue;
        const double phase = phase_of(state, atoms, i),
                     force = state->push[0] * sin(phase) + state->push[1] * cos(phase);
        for (int axis = 0; axis < 3; ++axis) atoms->f[axis][i] += force * state->wave[axis];
    }
}

static hs_status post_force(hs_fix *fix, hs_error *err)
{
    rhok_state *state = fix->state;
    double sums[3];
    (void)err;
    for (int axis = 0; axis < 3; ++axis)
        state->wave[axis] = 2.0 * acos(-1.0) * (double)state->n[axis] / hs_box_length(fix->env->box, axis);
    hs_atom_sum(fix->env->atoms, fix->env->parallel, add_waves, fix, 3, sums);
    memset(state->mode, 0, sizeof state->mode);
    state->energy = 0.0;
    if (sums[2] == 0.0) return HS_OK;
    const double root = sqrt(sums[2]), re = sums[0] / root, im = sums[1] / root, length = sqrt(re * re + im * im);
    const double away = length - state->anchor;
    state->mode[0] = re;
    state->mode[1] = im;
    state->mode[2] = length;
    state->energy = 0.5 * state->k * away * away;
    if (length == 0.0) return HS_OK; /* no phase, no direction */
    state->push[0] = state->k * away * re / (root * length);
    state->push[1] = state->k * away * im / (root * length);
    HS_ON_THREADS(push(fix));
    return HS_OK;
}

static hs_status scalar(hs_fix *fix, double *value, hs_error *err)
{
    (void)err;
    *value = ((const rhok_state *)fix->state)->energy;
    return HS_OK;
}

static hs_status vector(hs_fix *fix, int i, double *value, hs_error *err)
{
    (void)err;
    *value = ((const rhok_state *)fix->state)->mode[i];
    return HS_OK;
}

static hs_status keep_state(hs_fix *fix, hs_state *kept, hs_error *err)
{
    rhok_state *state = fix->state;
    HS_TRY(hs_state_double(kept, "energy", &state->energy, 1, err));
    return hs_state_double(kept, "mode", state->mode, 3, err);
}

const hs_fix_style hs_fix_style_rhok = {
    .about = {.name = "rhok",
              .syntax = {.usage = "<nx> <ny> <nz> <K> <a>", .n_min = 5, .n_max = 5},
              .summary = "a bias on a Fourier mode of the density",
              .details = "Adds the energy K/2 (|rho_k| - a)^2, where rho_k is the sum of exp(-i k r) over the N atoms "
                         "of the group, divided by the root of N, and k = 2 pi (nx/Lx, ny/Ly, nz/Lz) follows the box. "
                         "In a crystal that has k in its reciprocal lattice |rho_k| is of the order of the root of N, "
                         "in a liquid of order 1: the bias pins a half-molten system there (interface pinning), or "
                         "measures with K = 0. The box must be orthogonal, and periodic along the wave.\n\nThe scalar "
                         "`f_ID` is the energy; `f_ID[1]` and `f_ID[2]` are the real and imaginary part of rho_k, "
                         "`f_ID[3]` its length; none is divided by the number of atoms under `thermo_modify norm yes`. "
                         "`fix_modify energy yes` adds the energy to the potential energy. Acts in minimisations, too.",
              .reference = "U. R. Pedersen, J. Chem. Phys. 139, 104102 (2013), doi:10.1063/1.4818747",
              .example = "fix bias all rhok 16 0 0 4.0 26.0\nthermo_style custom step temp pe f_bias f_bias[3]"},
    .state_size = sizeof(rhok_state),
    .create = create,
    .init = init,
    .post_force = post_force,
    .keep_state = keep_state,
    .scalar = scalar,
    .vector = vector,
    .n_vector = 3,
    .acts_in_minimize = true,
    .has_energy = true,
};
