/* A spring on the radius of gyration of a group:  E = K (R - R0)^2,  F_i = -2 K (m_i/M) (1 - R0/R) (r_i - r_cm). */
#include <math.h>
#include <string.h>

#include "core/atom_style.h"
#include "style/atom_sum.h"
#include "style/fix.h"
#include "style/moments.h"
#include "style/places.h"

typedef struct spring_state {
    double k;      /**< energy/distance^2 */
    double rest;   /**< R0, distance; below 0: that of the first run, which has not begun */
    double energy; /**< of the latest forces */
} spring_state;

/** Where the group is, and how wide. */
typedef struct extent {
    const hs_fix *fix;
    double center[3], mass, radius; /**< unwrapped distance, mass, distance */
} extent;

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    spring_state *state = fix->state;
    HS_TRY(hs_syntax_check(&fix->style->about.syntax, args, false, err));
    HS_TRY(hs_arg_double(args, 0, &state->k, err));
    state->rest = -1.0;
    return strcmp(args->word[1], "NULL") == 0 ? HS_OK : hs_arg_not_negative(args, 1, &state->rest, err);
}

static void arm(const extent *e, int i, double d[3])
{
    hs_unwrapped_place(e->fix->env, i, d);
    for (int axis = 0; axis < 3; ++axis) d[axis] -= e->center[axis];
}

static void add_squares(const hs_atoms *atoms, const void *context, int begin, int end, hs_exact_sum *sums)
{
    const extent *e = context;
    for (int i = begin; i < end; ++i) {
        double d[3];
        if (!(atoms->mask[i] & e->fix->mask)) continue;
        arm(e, i, d);
        hs_exact_add(&sums[0], hs_atom_mass(atoms, i) * (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]));
    }
}

/** Of the group as it is (collective). */
static extent find_extent(const hs_fix *fix)
{
    const hs_env *env = fix->env;
    extent e = {.fix = fix};
    double sum;
    e.mass = hs_center_of_mass(env, fix->mask, e.center, NULL);
    hs_atom_sum(env->atoms, env->parallel, add_squares, &e, 1, &sum);
    e.radius = e.mass > 0.0 ? sqrt(sum / e.mass) : 0.0;
    return e;
}

static hs_status init(hs_fix *fix, hs_error *err)
{
    spring_state *state = fix->state;
    (void)err;
    if (state->rest < 0.0) state->rest = find_extent(fix).radius;
    return HS_OK;
}

/** Each atom's part of the force is that of its mass and distance. */
static void pull(const extent *e, double factor)
{
    const hs_atoms *atoms = e->fix->env->atoms;
#pragma omp for schedule(static) nowait
    for (int i = 0; i < atoms->n_local; ++i) {
        double d[3];
        if (!(atoms->mask[i] & e->fix->mask)) continue;
        arm(e, i, d);
        for (int axis = 0; axis < 3; ++axis) atoms->f[axis][i] += factor * hs_atom_mass(atoms, i) * d[axis];
    }
}

static hs_status post_force(hs_fix *fix, hs_error *err)
{
    spring_state *state = fix->state;
    const extent e = find_extent(fix);
    const double stretched = e.radius - state->rest;
    (void)err;
    state->energy = state->k * stretched * stretched;
    if (e.radius > 0.0) HS_ON_THREADS(pull(&e, -2.0 * state->k / e.mass * stretched / e.radius));
    return HS_OK;
}

static hs_status scalar(hs_fix *fix, double *value, hs_error *err)
{
    (void)err;
    *value = ((const spring_state *)fix->state)->energy;
    return HS_OK;
}

static hs_status keep_state(hs_fix *fix, hs_state *kept, hs_error *err)
{
    spring_state *state = fix->state;
    HS_TRY(hs_state_double(kept, "rest", &state->rest, 1, err));
    return hs_state_double(kept, "energy", &state->energy, 1, err);
}

const hs_fix_style hs_fix_style_spring_rg = {
    .about = {.name = "spring/rg",
              .syntax = {.usage = "<K> <R0>|NULL", .n_min = 2, .n_max = 2},
              .summary = "a spring on the radius of gyration of a group",
              .details =
                  "The radius of gyration R of the group (compute gyration, of unwrapped places) is held near R0 by "
                  "the energy K (R - R0)^2, K in energy/distance^2: each atom feels -2 K (m/M) (1 - R0/R) (r - "
                  "r_cm). With `NULL` R0 is the group's radius when the fix's first run begins.\n\n"
                  "The scalar `f_ID` is that energy; `fix_modify energy yes` adds it to the potential energy. "
                  "Atoms in one place feel no force.",
              .example = "fix swell chain spring/rg 5.0 10.0\nfix keep chain spring/rg 20.0 NULL"},
    .state_size = sizeof(spring_state),
    .create = create,
    .init = init,
    .post_force = post_force,
    .keep_state = keep_state,
    .scalar = scalar,
    .is_extensive = true,
    .has_energy = true,
    .allows_dynamic_group = true,
};
