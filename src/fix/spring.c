/* A spring that holds the center of mass of a group: to a place, or to that of another group.  E = K/2 (r - R0)^2. */
#include <math.h>
#include <string.h>

#include "core/atom_style.h"
#include "style/fix.h"
#include "style/moments.h"

typedef struct spring_state {
    bool is_coupled; /**< to another group, else to a place */
    uint32_t other;  /**< group bit of that */
    double k, rest;  /**< energy/distance^2, distance */
    bool acts[3];    /**< directions that count (not NULL) */
    double place[3]; /**< of the end, or displacement of the other group's center; distance */
    double energy;   /**< of the latest forces, */
    double force[4]; /**< the force on the group, and K (r - R0) */
} spring_state;

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    static const char *const styles[] = {"tether", "couple", NULL};
    spring_state *state = fix->state;
    int style, bit, at = 1;
    HS_TRY(hs_syntax_check(&fix->style->about.syntax, args, false, err));
    HS_TRY(hs_arg_choice(args, 0, styles, &style, err));
    state->is_coupled = style == 1;
    if (args->n != 6 + style)
        return hs_fail(err, HS_ERROR_INPUT, "%s: expected: %s", args->command,
                       style == 0 ? "tether <K> <x> <y> <z> <R0>" : "couple <group-ID> <K> <x> <y> <z> <R0>");
    if (state->is_coupled) {
        HS_TRY(hs_groups_get(fix->env->groups, args->word[at++], &bit, err));
        if (bit == fix->group)
            return hs_fail(err, HS_ERROR_INPUT, "%s: a spring between a group and itself", args->command);
        state->other = fix->other_groups = hs_group_mask(bit);
    }
    HS_TRY(hs_arg_double(args, at++, &state->k, err));
    for (int axis = 0; axis < 3; ++axis, ++at) {
        state->acts[axis] = strcmp(args->word[at], "NULL") != 0;
        if (state->acts[axis]) HS_TRY(hs_arg_double(args, at, &state->place[axis], err));
    }
    return hs_arg_not_negative(args, at, &state->rest, err);
}

/** From the group's center to the other end, along the directions that count; false where a group has no mass
 *  (collective). */
static bool find_ends(const hs_fix *fix, double d[3], double mass[2])
{
    const spring_state *state = fix->state;
    double center[3], other[3] = {0.0, 0.0, 0.0};
    mass[0] = hs_center_of_mass(fix->env, fix->mask, center, NULL);
    mass[1] = state->is_coupled ? hs_center_of_mass(fix->env, state->other, other, NULL) : 1.0;
    for (int axis = 0; axis < 3; ++axis) {
        const double end = state->is_coupled ? other[axis] - state->place[axis] : state->place[axis];
        d[axis] = state->acts[axis] ? end - center[axis] : 0.0;
    }
    return mass[0] > 0.0 && mass[1] > 0.0;
}

/** Each atom's part of the force is that of its mass. */
static void pull(const hs_fix *fix, uint32_t mask, double factor)
{
    const hs_atoms *atoms = fix->env->atoms;
    const double *force = ((const spring_state *)fix->state)->force;
#pragma omp for schedule(static) nowait
    for (int i = 0; i < atoms->n_local; ++i) {
        if (!(atoms->mask[i] & mask)) continue;
        const double part = factor * hs_atom_mass(atoms, i);
        for (int axis = 0; axis < 3; ++axis) atoms->f[axis][i] += part * force[axis];
    }
}

static hs_status post_force(hs_fix *fix, hs_error *err)
{
    const double tiny = 1e-10; /* distance: at the place itself a spring has no direction */
    spring_state *state = fix->state;
    double d[3], mass[2];
    (void)err;
    memset(state->force, 0, sizeof state->force);
    state->energy = 0.0;
    if (!find_ends(fix, d, mass)) return HS_OK;
    const double r = fmax(sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]), tiny), stretched = r - state->rest;
    for (int axis = 0; axis < 3; ++axis) state->force[axis] = state->k * stretched * d[axis] / r;
    state->force[3] = state->k * stretched;
    state->energy = 0.5 * state->k * stretched * stretched;
    HS_ON_THREADS(pull(fix, fix->mask, 1.0 / mass[0]));
    if (state->is_coupled) HS_ON_THREADS(pull(fix, state->other, -1.0 / mass[1]));
    return HS_OK;
}

static hs_status scalar(hs_fix *fix, double *value, hs_error *err)
{
    (void)err;
    *value = ((const spring_state *)fix->state)->energy;
    return HS_OK;
}

static hs_status vector(hs_fix *fix, int i, double *value, hs_error *err)
{
    (void)err;
    *value = ((const spring_state *)fix->state)->force[i];
    return HS_OK;
}

static hs_status keep_state(hs_fix *fix, hs_state *kept, hs_error *err)
{
    spring_state *state = fix->state;
    HS_TRY(hs_state_double(kept, "energy", &state->energy, 1, err));
    return hs_state_double(kept, "force", state->force, 4, err);
}

const hs_fix_style hs_fix_style_spring = {
    .about =
        {.name = "spring",
         .syntax = {.usage = "tether <K> <x> <y> <z> <R0> | couple <group-ID> <K> <x> <y> <z> <R0>",
                    .n_min = 6,
                    .n_max = 7},
         .summary = "a spring on the center of mass of a group",
         .details = "`tether` pulls the center of mass of the group to the place (x, y, z), in distance units, by K (r "
                    "- R0) at the distance r, K in units of force/distance; `couple` pulls the centers of mass of two "
                    "groups together, where the other's should be (x, y, z) away. A direction that is NULL counts for "
                    "nothing. Each atom feels the part of the force that its mass is of the group's, so that a group "
                    "is moved as a whole; places are unwrapped ones.\n\n"
                    "The scalar `f_ID` is the energy K (r - R0)^2/2; `f_ID[1]` to `f_ID[3]` are the force on the "
                    "group, `f_ID[4]` is K (r - R0), positive where the spring pulls. `fix_modify energy yes` adds the "
                    "energy to the potential energy. Acts in minimisations, too.",
         .example =
             "fix pull ball spring tether 50.0 10 NULL NULL 0.0\nfix pair left spring couple right 100.0 3 0 0 0.0"},
    .state_size = sizeof(spring_state),
    .create = create,
    .post_force = post_force,
    .keep_state = keep_state,
    .scalar = scalar,
    .vector = vector,
    .n_vector = 4,
    .is_extensive = true,
    .is_vector_extensive = true,
    .acts_in_minimize = true,
    .has_energy = true,
    .allows_dynamic_group = true,
};
