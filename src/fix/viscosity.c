/* Makes momentum flow through a fluid, for its viscosity: atoms of two layers exchange one component of their
 * velocities.
 * Source: F. Müller-Plathe, Phys. Rev. E 59, 4894 (1999), doi:10.1103/PhysRevE.59.4894. */
#include <math.h>
#include <string.h>

#include "style/slab_swap.h"

typedef struct viscosity_state {
    int64_t every;
    int component; /**< of the velocities, that is exchanged */
    hs_slab_swap swap;
    double target;    /**< velocity of partners, distance/time; INFINITY: the fastest */
    double exchanged; /**< momentum that the lowest layer has gained so far */
} viscosity_state;

static const hs_keyword keywords[] = {
    {"swap", 1, "<N>", "pairs of atoms that exchange velocities each time (default 1)"},
    {"vtarget", 1, "<v>",
     "take partners whose velocity is nearest to v and -v (distance/time; default INF: the fastest)"},
    {NULL, 0, NULL, NULL},
};

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    static const char *const axes[] = {"x", "y", "z", NULL};
    viscosity_state *state = fix->state;
    HS_TRY(hs_syntax_check(&fix->style->about.syntax, args, false, err));
    HS_TRY(hs_arg_int(args, 0, 1, INT64_MAX, &state->every, err));
    HS_TRY(hs_arg_choice(args, 1, axes, &state->component, err));
    if (state->component == 2 && fix->env->box->dimension == 2)
        return hs_arg_refuse(args, 1, "an axis of the plane", NULL, err);
    HS_TRY(hs_slab_swap_read(&state->swap, fix, args, 2, err));
    state->swap.n_swaps = 1;
    state->target = INFINITY;
    for (int i = 4; i + 1 < args->n; i += 2) {
        int64_t n;
        if (strcmp(args->word[i], "swap") == 0) {
            HS_TRY(hs_arg_int(args, i + 1, 1, HS_SLAB_SWAPS_MAX, &n, err));
            state->swap.n_swaps = (int)n;
        } else if (strcmp(args->word[i + 1], "INF") == 0) {
            state->target = INFINITY;
        } else {
            HS_TRY(hs_arg_positive(args, i + 1, &state->target, err));
        }
    }
    return HS_OK;
}

/** Partners move forward in the lowest layer and backward in the middle one. */
static double rank_of(const hs_fix *fix, int i, int slab)
{
    const viscosity_state *state = fix->state;
    const double v = fix->env->atoms->v[state->component][i], forward = slab == HS_SLAB_LOWEST ? v : -v;
    if (forward < 0.0) return INFINITY;
    return state->target < INFINITY ? fabs(forward - state->target) : -forward;
}

static void add_exchanged(hs_fix *fix, double mass, const double before[3], const double after[3])
{
    viscosity_state *state = fix->state;
    state->exchanged += mass * (after[state->component] - before[state->component]);
}

static hs_status end_of_step(hs_fix *fix, hs_error *err)
{
    const viscosity_state *state = fix->state;
    if (fix->env->step % state->every != 0) return HS_OK;
    return hs_slab_swap_make(&state->swap, fix, state->component, state->component + 1, rank_of, add_exchanged, err);
}

static hs_status scalar(hs_fix *fix, double *value, hs_error *err)
{
    (void)err;
    *value = ((viscosity_state *)fix->state)->exchanged;
    return HS_OK;
}

static hs_status keep_state(hs_fix *fix, hs_state *kept, hs_error *err)
{
    return hs_state_double(kept, "exchanged", &((viscosity_state *)fix->state)->exchanged, 1, err);
}

const hs_fix_style hs_fix_style_viscosity = {
    .about = {.name = "viscosity",
              .syntax = {.usage = "<N> x|y|z x|y|z <N bins> [swap <N>] [vtarget <v>]",
                         .n_min = 4,
                         .n_max = 4,
                         .keywords = keywords},
              .summary = "make momentum flow between two layers, to measure the shear viscosity",
              .details = "The box is cut into an even number of layers along the second axis. At multiples of N steps "
                         "the atom of the lowest layer that moves forward along the first axis the fastest, and the "
                         "one of the middle layer (number N bins/2 + 1) that moves backward the fastest, exchange that "
                         "component of their velocities; atoms of different mass make an elastic collision along it. "
                         "Energy and momentum are conserved, and a stationary profile of the velocity builds up, which "
                         "`fix ave/chunk` over a `chunk/atom` of such layers shows.\n\n"
                         "The scalar `f_ID` is the momentum that the lowest layer has gained since the fix was defined "
                         "(below 0). The viscosity is -(f_ID/(2 t A))/(dv/dz) with A the area of a layer's face: "
                         "momentum flows both ways, through the upper and the lower half of the box. Use it with `fix "
                         "nve`; the choice of atoms does not depend on ranks or threads.",
              .reference = "F. Müller-Plathe, Phys. Rev. E 59, 4894 (1999), doi:10.1103/PhysRevE.59.4894",
              .example = "fix flow all viscosity 100 x z 20\nfix flow all viscosity 50 x y 20 swap 2 vtarget 1.5"},
    .state_size = sizeof(viscosity_state),
    .create = create,
    .end_of_step = end_of_step,
    .keep_state = keep_state,
    .scalar = scalar,
};
