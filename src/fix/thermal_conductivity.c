/* Makes heat flow through a fluid, for its thermal conductivity: a hot atom of one layer and a cold one of another
 * exchange their velocities. Source: F. Müller-Plathe, J. Chem. Phys. 106, 6082 (1997), doi:10.1063/1.473271. */

#include "core/atom_style.h"
#include "style/slab_swap.h"

typedef struct conductivity_state {
    int64_t every;
    hs_slab_swap swap;
    double exchanged; /**< energy that has gone from the lowest layer to the middle one so far */
} conductivity_state;

static const hs_keyword keywords[] = {
    {"swap", 1, "<N>", "pairs of atoms that exchange velocities each time (default 1)"},
    {NULL, 0, NULL, NULL},
};

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    conductivity_state *state = fix->state;
    HS_TRY(hs_syntax_check(&fix->style->about.syntax, args, false, err));
    HS_TRY(hs_arg_int(args, 0, 1, INT64_MAX, &state->every, err));
    HS_TRY(hs_slab_swap_read(&state->swap, fix, args, 1, err));
    state->swap.n_swaps = 1;
    for (int i = 3; i + 1 < args->n; i += 2) {
        int64_t n;
        HS_TRY(hs_arg_int(args, i + 1, 1, HS_SLAB_SWAPS_MAX, &n, err));
        state->swap.n_swaps = (int)n;
    }
    return HS_OK;
}

/** The hottest of the lowest layer, the coldest of the middle one. */
static double rank_of(const hs_fix *fix, int i, int slab)
{
    const hs_atoms *atoms = fix->env->atoms;
    const double v[3] = {atoms->v[0][i], atoms->v[1][i], atoms->v[2][i]};
    const double energy = 0.5 * hs_atom_mass(atoms, i) * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    return slab == HS_SLAB_LOWEST ? -energy : energy;
}

static void add_exchanged(hs_fix *fix, double mass, const double before[3], const double after[3])
{
    conductivity_state *state = fix->state;
    double change = 0.0;
    for (int axis = 0; axis < 3; ++axis) change += before[axis] * before[axis] - after[axis] * after[axis];
    state->exchanged += 0.5 * fix->env->units->mvv2e * mass * change;
}

static hs_status end_of_step(hs_fix *fix, hs_error *err)
{
    const conductivity_state *state = fix->state;
    if (fix->env->step % state->every != 0) return HS_OK;
    return hs_slab_swap_make(&state->swap, fix, 0, 3, rank_of, add_exchanged, err);
}

static hs_status scalar(hs_fix *fix, double *value, hs_error *err)
{
    (void)err;
    *value = ((conductivity_state *)fix->state)->exchanged;
    return HS_OK;
}

static hs_status keep_state(hs_fix *fix, hs_state *kept, hs_error *err)
{
    return hs_state_double(kept, "exchanged", &((conductivity_state *)fix->state)->exchanged, 1, err);
}

const hs_fix_style hs_fix_style_thermal_conductivity = {
    .about = {.name = "thermal/conductivity",
              .syntax = {.usage = "<N> x|y|z <N bins> [swap <N>]", .n_min = 3, .n_max = 3, .keywords = keywords},
              .summary = "make heat flow between two layers, to measure the thermal conductivity",
              .details = "The box is cut into an even number of layers along the axis. At multiples of N steps the "
                         "hottest atom of the lowest layer and the coldest one of the middle layer (number N bins/2 + "
                         "1) exchange their velocities; atoms of different mass make an elastic collision. Energy and "
                         "momentum are conserved, and a stationary profile of the temperature builds up, which `fix "
                         "ave/chunk` over a `chunk/atom` of such layers shows.\n\n"
                         "The scalar `f_ID` is the kinetic energy that has gone from the lowest to the middle layer "
                         "since the fix was defined. The conductivity is (f_ID/(2 t A))/(dT/dz) with A the area of a "
                         "layer's face: heat flows both ways, through the upper and the lower half of the box. Use it "
                         "with `fix nve`; the choice of atoms does not depend on ranks or threads.",
              .reference = "F. Müller-Plathe, J. Chem. Phys. 106, 6082 (1997), doi:10.1063/1.473271",
              .example = "fix flow all thermal/conductivity 100 z 20"},
    .state_size = sizeof(conductivity_state),
    .create = create,
    .end_of_step = end_of_step,
    .keep_state = keep_state,
    .scalar = scalar,
};
