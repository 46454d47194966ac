/* A spring from each atom to the place where it was when the fix was defined: E = K/2 (r - r0)^2. */
#include <string.h>

#include "style/atom_sum.h"
#include "style/atom_vector.h"
#include "style/fix.h"
#include "style/places.h"

typedef struct spring_state {
    double k;          /**< energy/distance^2 */
    bool acts[3];      /**< along which axes */
    hs_atom_vector r0; /**< unwrapped, distance */
} spring_state;

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    static const char *const directions[] = {"xyz", "x", "y", "z", "xy", "xz", "yz", NULL};
    spring_state *state = fix->state;
    int direction = 0;
    HS_TRY(hs_syntax_check(&fix->style->about.syntax, args, false, err));
    HS_TRY(hs_arg_positive(args, 0, &state->k, err));
    if (args->n > 1) HS_TRY(hs_arg_choice(args, 1, directions, &direction, err));
    for (int axis = 0; axis < 3; ++axis)
        state->acts[axis] = strchr(directions[direction], "xyz"[axis]) != NULL && axis < fix->env->box->dimension;
    HS_TRY(hs_atom_vector_add(fix->env->atoms, &state->r0, "fix", fix->id, "r0", err));
    hs_atom_vector_set_places(&state->r0, fix->env, (const double[3]){0.0});
    return HS_OK;
}

static void destroy(hs_fix *fix) { hs_atom_vector_remove(fix->env->atoms, &((spring_state *)fix->state)->r0); }

static void force_of(const hs_fix *fix, const hs_places *places, int i, double f[3])
{
    const spring_state *state = fix->state;
    for (int axis = 0; axis < 3; ++axis) {
        const double r = hs_places_unwrapped(places, fix->env->atoms, axis, i);
        f[axis] = state->acts[axis] ? -state->k * (r - state->r0.of[axis][i]) : 0.0;
    }
}

static void pull(const hs_fix *fix)
{
    const hs_atoms *atoms = fix->env->atoms;
    const hs_places now = hs_places_now(fix->env);
#pragma omp for schedule(static) nowait
    for (int i = 0; i < atoms->n_local; ++i) {
        double f[3];
        if (!(atoms->mask[i] & fix->mask)) continue;
        force_of(fix, &now, i, f);
        for (int axis = 0; axis < 3; ++axis) atoms->f[axis][i] += f[axis];
    }
}

static hs_status post_force(hs_fix *fix, hs_error *err)
{
    (void)err;
    HS_ON_THREADS(pull(fix));
    return HS_OK;
}

static void add_energy(const hs_atoms *atoms, const void *context, int begin, int end, hs_exact_sum *sums)
{
    const hs_fix *fix = context;
    const hs_places places = hs_places_of_forces(fix->env);
    const double k = ((spring_state *)fix->state)->k;
    for (int i = begin; i < end; ++i) {
        double f[3];
        if (!(atoms->mask[i] & fix->mask)) continue;
        force_of(fix, &places, i, f);
        hs_exact_add(&sums[0], (f[0] * f[0] + f[1] * f[1] + f[2] * f[2]) / (2.0 * k));
    }
}

static hs_status scalar(hs_fix *fix, double *value, hs_error *err)
{
    (void)err;
    hs_atom_sum(fix->env->atoms, fix->env->parallel, add_energy, fix, 1, value);
    return HS_OK;
}

const hs_fix_style hs_fix_style_spring_self = {
    .about =
        {.name = "spring/self",
         .syntax = {.usage = "<K> [x|y|z|xy|xz|yz|xyz]", .n_min = 1, .n_max = 2},
         .summary = "a spring that ties each atom to its starting place",
         .details =
             "Each atom of the group is pulled by -K (r - r0), K in energy/distance^2, to the place where it was "
             "when the fix was defined (unwrapped: it does not matter how often the atom crosses periodic faces). "
             "The second word limits the spring to some directions. An atom that is created later is tied to where "
             "that was; define the fix after all atoms are there.\n\nThe scalar `f_ID` is the energy K/2 (r - r0)^2 "
             "of all springs; `fix_modify energy yes` adds it to the potential energy.",
         .example = "fix trap all spring/self 10.0\nfix tether walls spring/self 100.0 xy"},
    .state_size = sizeof(spring_state),
    .create = create,
    .destroy = destroy,
    .post_force = post_force,
    .acts_in_minimize = true,
    .scalar = scalar,
    .is_extensive = true,
    .has_energy = true,
};
