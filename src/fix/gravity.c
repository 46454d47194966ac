/* Uniform gravity: f += m g along a direction. */
#include <math.h>

#include "core/atom_style.h"
#include "style/atom_sum.h"
#include "style/places.h"
#include "style/unit_vector.h"
#include "style/varying.h"

typedef struct gravity_state {
    hs_varying magnitude; /**< force/mass */
    double direction[3];  /**< unit vector */
} gravity_state;

static hs_status read_direction(hs_fix *fix, const hs_args *args, hs_error *err)
{
    static const char *const styles[] = {"chute", "spherical", "vector", NULL};
    static const int n_numbers[] = {1, 2, 3};
    const double degree = M_PI / 180.0;
    gravity_state *state = fix->state;
    const bool is_flat = fix->env->box->dimension == 2;
    double number[3] = {0.0};
    int style;
    HS_TRY(hs_arg_choice(args, 1, styles, &style, err));
    HS_TRY(hs_arg_need(args, 1 + n_numbers[style], "the direction of gravity", err));
    if (args->n > 2 + n_numbers[style])
        return hs_arg_refuse(args, 2 + n_numbers[style], "the end of the command", NULL, err);
    for (int k = 0; k < n_numbers[style]; ++k) HS_TRY(hs_arg_double(args, 2 + k, &number[k], err));
    if (style == 2) {
        HS_TRY(hs_arg_direction(args, 2, state->direction, err));
    } else {
        /* a chute tilted by an angle is the direction phi = 0, theta = 180 - angle; in the plane theta alone counts */
        const double phi = style == 1 ? number[0] * degree : 0.0;
        const double theta = (style == 1 ? number[1] : 180.0 - number[0]) * degree;
        state->direction[0] = is_flat ? sin(theta) : sin(theta) * cos(phi);
        state->direction[1] = is_flat ? cos(theta) : sin(theta) * sin(phi);
        state->direction[2] = is_flat ? 0.0 : cos(theta);
    }
    if (is_flat && state->direction[2] != 0.0)
        return hs_fail(err, HS_ERROR_INPUT, "%s: gravity along z in two dimensions", args->command);
    return HS_OK;
}

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    gravity_state *state = fix->state;
    HS_TRY(hs_syntax_check(&fix->style->about.syntax, args, false, err));
    HS_TRY(hs_varying_read(&state->magnitude, args, 0, err));
    return read_direction(fix, args, err);
}

static void destroy(hs_fix *fix) { hs_varying_fini(&((gravity_state *)fix->state)->magnitude); }

static hs_status init(hs_fix *fix, hs_error *err)
{
    return hs_varying_check(&((gravity_state *)fix->state)->magnitude, fix, err);
}

/** Force on a unit mass along an axis. */
static double pull(const hs_fix *fix, int axis)
{
    const gravity_state *state = fix->state;
    return state->magnitude.value * state->direction[axis];
}

static void pull_atoms(const hs_fix *fix, const double g[3])
{
    const hs_atoms *atoms = fix->env->atoms;
#pragma omp for schedule(static) nowait
    for (int i = 0; i < atoms->n_local; ++i) {
        if (!(atoms->mask[i] & fix->mask)) continue;
        const double mass = hs_atom_mass(atoms, i);
        for (int axis = 0; axis < 3; ++axis) atoms->f[axis][i] += mass * g[axis];
    }
}

static hs_status post_force(hs_fix *fix, hs_error *err)
{
    HS_TRY(hs_varying_update(&((gravity_state *)fix->state)->magnitude, fix->env, err));
    const double g[3] = {pull(fix, 0), pull(fix, 1), pull(fix, 2)};
    HS_ON_THREADS(pull_atoms(fix, g));
    return HS_OK;
}

static void add_energy(const hs_atoms *atoms, const void *context, int begin, int end, hs_exact_sum *sums)
{
    const hs_fix *fix = context;
    const hs_places places = hs_places_of_forces(fix->env);
    const double g[3] = {pull(fix, 0), pull(fix, 1), pull(fix, 2)};
    for (int i = begin; i < end; ++i)
        for (int axis = 0; axis < 3 && atoms->mask[i] & fix->mask; ++axis) {
            const double x = hs_places_unwrapped(&places, atoms, axis, i);
            hs_exact_add(&sums[0], -hs_atom_mass(atoms, i) * g[axis] * x);
        }
}

static hs_status scalar(hs_fix *fix, double *value, hs_error *err)
{
    (void)err;
    hs_atom_sum(fix->env->atoms, fix->env->parallel, add_energy, fix, 1, value);
    return HS_OK;
}

const hs_fix_style hs_fix_style_gravity = {
    .about = {.name = "gravity",
              .syntax = {.usage = "<g> chute <angle> | spherical <phi> <theta> | vector <x> <y> <z>",
                         .n_min = 2,
                         .n_max = -1},
              .summary = "uniform gravity",
              .details =
                  "Adds mass times g to each atom of the group. g is an acceleration in force/mass units, or an "
                  "equal-style variable `v_name`. Direction: `vector` is any vector, of which only the direction "
                  "counts; `spherical` has phi from the x axis in the xy plane and theta from the z axis (in two "
                  "dimensions theta from the y axis), in degrees; `chute` is down (-z; -y in two dimensions), tilted "
                  "towards x by the angle.\n\nThe scalar `f_ID` is the potential energy, 0 at the origin, with "
                  "unwrapped coordinates; `fix_modify energy yes` adds it to the potential energy.",
              .example = "fix g all gravity 1.0 vector 0 -1 0\nfix g all gravity 1.0 chute 26.0"},
    .state_size = sizeof(gravity_state),
    .create = create,
    .destroy = destroy,
    .init = init,
    .post_force = post_force,
    .scalar = scalar,
    .is_extensive = true,
    .has_energy = true,
    .allows_dynamic_group = true,
};
