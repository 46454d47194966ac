/* Atoms that follow a given path, whatever the forces on them: walls that shear, pistons, stirrers.
 *   linear    r = r0 + V t                                   wiggle  r = r0 + A sin(2 pi t/P)
 *   rotate    r = R(2 pi t/P) r0 about an axis through P0    variable  r = r0 + d(t), v = v(t)
 * r0: where the atom was when the fix was defined; t: the time since then. Directions that are left free follow the forces
 * by velocity Verlet. */
#include <math.h>
#include <string.h>

#include "core/atom_style.h"
#include "core/lattice.h"
#include "style/applied_force.h"
#include "style/atom_vector.h"
#include "style/places.h"
#include "style/unit_vector.h"

typedef enum { LINEAR, WIGGLE, ROTATE, VARIABLE } path;

typedef struct move_state {
    path path;
    double given[3];   /**< linear: velocity, wiggle: amplitude, rotate: a point of the axis; distance, time */
    bool is_free[3];   /**< NULL: this direction follows the forces */
    double axis[3];    /**< rotate: unit vector */
    double rate;       /**< wiggle, rotate: 2 pi/period, 1/time */
    int64_t start;     /**< step at which t is 0 */
    hs_atom_vector r0; /**< unwrapped, distance */
    hs_applied_force displacement, velocity; /**< variable */
} move_state;

static const char *const paths[] = {"linear", "wiggle", "rotate", "variable", NULL};
static const int n_words[] = {4, 5, 8, 7}; /* with the path's name */

static const hs_keyword keywords[] = {
    {"units", 1, "lattice|box",
     "lengths are in lattice spacings (default) or in distance units; not those of variables"},
    {NULL, 0, NULL, NULL},
};

/** Words 1, 2, 3, of which some may be NULL. */
static hs_status read_vector(move_state *state, const hs_args *args, bool may_be_free, hs_error *err)
{
    for (int axis = 0; axis < 3; ++axis) {
        state->is_free[axis] = may_be_free && strcmp(args->word[1 + axis], "NULL") == 0;
        if (!state->is_free[axis]) HS_TRY(hs_arg_double(args, 1 + axis, &state->given[axis], err));
    }
    return HS_OK;
}

static hs_status read_rate(move_state *state, const hs_args *args, int i, hs_error *err)
{
    double period;
    HS_TRY(hs_arg_positive(args, i, &period, err));
    state->rate = 2.0 * M_PI / period;
    return HS_OK;
}

/** Displacements and velocities by variables: a direction in which both are NULL is free. */
static hs_status read_variables(move_state *state, const hs_args *args, hs_error *err)
{
    for (int i = 1; i <= 6; ++i)
        if (strcmp(args->word[i], "NULL") != 0 && strncmp(args->word[i], "v_", 2) != 0)
            return hs_arg_refuse(args, i, "v_<name> or NULL", NULL, err);
    const hs_args displacement = hs_args_from(args, 1, NULL), velocity = hs_args_from(args, 4, NULL);
    HS_TRY(hs_applied_force_create(&state->displacement, &displacement, true, err));
    HS_TRY(hs_applied_force_create(&state->velocity, &velocity, true, err));
    for (int axis = 0; axis < 3; ++axis)
        state->is_free[axis] = state->displacement.is_free[axis] && state->velocity.is_free[axis];
    return HS_OK;
}

/** A flat system stays flat. */
static hs_status check_flat(const hs_fix *fix, const hs_args *args, hs_error *err)
{
    const move_state *state = fix->state;
    const bool is_flat = state->path == ROTATE     ? state->axis[0] == 0.0 && state->axis[1] == 0.0
                         : state->path == VARIABLE ? state->is_free[2]
                                                   : state->is_free[2] || state->given[2] == 0.0;
    if (fix->env->box->dimension == 3 || is_flat) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "%s: in two dimensions atoms stay in the plane: %s", args->command,
                   state->path == ROTATE ? "the axis must be along z" : "the word for z must be NULL or 0");
}

static hs_status read_path(hs_fix *fix, const hs_args *args, int n, hs_error *err)
{
    move_state *state = fix->state;
    int chosen;
    HS_TRY(hs_arg_choice(args, 0, paths, &chosen, err));
    state->path = (path)chosen;
    if (n != n_words[chosen])
        return hs_fail(err, HS_ERROR_INPUT, "%s: %s needs %d words and has %d; expected: fix move %s", args->command,
                       paths[chosen], n_words[chosen] - 1, n - 1, fix->style->about.syntax.usage);
    switch (state->path) {
    case LINEAR:
        return read_vector(state, args, true, err);
    case WIGGLE:
        HS_TRY(read_vector(state, args, true, err));
        return read_rate(state, args, 4, err);
    case ROTATE:
        HS_TRY(read_vector(state, args, false, err));
        HS_TRY(hs_arg_direction(args, 4, state->axis, err));
        return read_rate(state, args, 7, err);
    default:
        return read_variables(state, args, err);
    }
}

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    move_state *state = fix->state;
    HS_TRY(hs_syntax_check(&fix->style->about.syntax, args, false, err));
    const int n = hs_syntax_first_keyword(&fix->style->about.syntax, args);
    bool is_box = false;
    for (int i = n; i < args->n; i += 2) is_box = strcmp(args->word[i + 1], "box") == 0;
    HS_TRY(read_path(fix, args, n, err));
    HS_TRY(check_flat(fix, args, err));
    for (int axis = 0; axis < 3 && !is_box; ++axis) state->given[axis] *= fix->env->lattice->spacing[axis];
    state->start = fix->env->step;
    HS_TRY(hs_atom_vector_add(fix->env->atoms, &state->r0, "fix", fix->id, "r0", err));
    hs_atom_vector_set_places(&state->r0, fix->env, (const double[3]){0.0});
    fix->n_atom_columns = 3;
    return HS_OK;
}

static void destroy(hs_fix *fix)
{
    move_state *state = fix->state;
    hs_atom_vector_remove(fix->env->atoms, &state->r0);
    hs_applied_force_fini(&state->displacement);
    hs_applied_force_fini(&state->velocity);
}

static hs_status init(hs_fix *fix, hs_error *err)
{
    move_state *state = fix->state;
    if (state->path != VARIABLE) return HS_OK;
    HS_TRY(hs_applied_force_init(&state->displacement, fix, true, err));
    return hs_applied_force_init(&state->velocity, fix, true, err);
}

/** What is the same for all atoms at a time: sine and cosine of 2 pi t/P. */
typedef struct phase {
    double t, sine, cosine;
} phase;

/** Place and velocity of an atom that was at r0, on all paths but `variable`. */
static void follow(const move_state *state, phase now, const double r0[3], double r[3], double v[3])
{
    const double *u = state->axis;
    if (state->path != ROTATE) {
        const bool is_linear = state->path == LINEAR;
        for (int axis = 0; axis < 3; ++axis) {
            const double a = state->given[axis];
            r[axis] = r0[axis] + a * (is_linear ? now.t : now.sine);
            v[axis] = is_linear ? a : a * state->rate * now.cosine;
        }
        return;
    }
    double d[3], along = 0.0, turned[3];
    for (int axis = 0; axis < 3; ++axis) {
        d[axis] = r0[axis] - state->given[axis];
        along += d[axis] * u[axis];
    }
    for (int axis = 0; axis < 3; ++axis) {
        const int b = (axis + 1) % 3, c = (axis + 2) % 3;
        const double across = d[axis] - along * u[axis], third = u[b] * d[c] - u[c] * d[b];
        turned[axis] = across * now.cosine + third * now.sine;
        r[axis] = state->given[axis] + along * u[axis] + turned[axis];
    }
    for (int axis = 0; axis < 3; ++axis) {
        const int b = (axis + 1) % 3, c = (axis + 2) % 3;
        v[axis] = state->rate * (u[b] * turned[c] - u[c] * turned[b]);
    }
}

/** One free direction of an atom: half kick and drift of velocity Verlet. */
static void kick(const hs_fix *fix, int axis, int i)
{
    const hs_env *env = fix->env;
    env->atoms->v[axis][i] += 0.5 * env->dt * env->units->ftm2v / hs_atom_mass(env->atoms, i) * env->atoms->f[axis][i];
}

static void drift(const hs_fix *fix, int axis, int i, double d)
{
    const hs_env *env = fix->env;
    env->atoms->x[axis][i] = hs_moved(env->atoms->x[axis][i], d, env->position_magic);
}

/** A direction of an atom whose displacement or velocity is that of a variable. */
static void follow_variable(const hs_fix *fix, int axis, int i, double place)
{
    const move_state *state = fix->state;
    double *v = fix->env->atoms->v[axis];
    if (!state->velocity.is_free[axis]) v[i] = hs_applied_force_of(&state->velocity, axis, i);
    if (state->displacement.is_free[axis])
        drift(fix, axis, i, fix->env->dt * v[i]);
    else
        drift(fix, axis, i, state->r0.of[axis][i] + hs_applied_force_of(&state->displacement, axis, i) - place);
}

/** A thread's share of the atoms: to their places at the end of the step. */
static void move(const hs_fix *fix, phase now)
{
    const move_state *state = fix->state;
    const hs_atoms *atoms = fix->env->atoms;
#pragma omp for schedule(static) nowait
    for (int i = 0; i < atoms->n_local; ++i) {
        if (!(atoms->mask[i] & fix->mask)) continue;
        double r0[3], place[3], r[3], v[3];
        hs_unwrapped_place(fix->env, i, place);
        for (int axis = 0; axis < 3; ++axis) r0[axis] = state->r0.of[axis][i];
        if (state->path != VARIABLE) follow(state, now, r0, r, v);
        for (int axis = 0; axis < 3; ++axis) {
            if (state->is_free[axis]) {
                kick(fix, axis, i);
                drift(fix, axis, i, fix->env->dt * atoms->v[axis][i]);
            } else if (state->path == VARIABLE) {
                follow_variable(fix, axis, i, place[axis]);
            } else {
                atoms->v[axis][i] = v[axis];
                drift(fix, axis, i, r[axis] - place[axis]);
            }
            if (state->path == ROTATE && atoms->omega[axis] != NULL)
                atoms->omega[axis][i] = state->rate * state->axis[axis];
        }
    }
}

static hs_status initial_integrate(hs_fix *fix, hs_error *err)
{
    move_state *state = fix->state;
    const double t = (double)(fix->env->step - state->start) * fix->env->dt;
    const phase now = {.t = t, .sine = sin(state->rate * t), .cosine = cos(state->rate * t)};
    if (state->path == VARIABLE) {
        HS_TRY(hs_applied_force_update(&state->displacement, fix, err));
        HS_TRY(hs_applied_force_update(&state->velocity, fix, err));
    }
    HS_ON_THREADS(move(fix, now));
    return HS_OK;
}

static void finish(const hs_fix *fix)
{
    const move_state *state = fix->state;
    const hs_atoms *atoms = fix->env->atoms;
#pragma omp for schedule(static) nowait
    for (int i = 0; i < atoms->n_local; ++i)
        for (int axis = 0; axis < 3 && atoms->mask[i] & fix->mask; ++axis)
            if (state->is_free[axis]) kick(fix, axis, i);
}

static hs_status final_integrate(hs_fix *fix, hs_error *err)
{
    const move_state *state = fix->state;
    (void)err;
    if (state->is_free[0] || state->is_free[1] || state->is_free[2]) HS_ON_THREADS(finish(fix));
    return HS_OK;
}

static hs_status per_atom(hs_fix *fix, int column, double *values, hs_error *err)
{
    const hs_atoms *atoms = fix->env->atoms;
    (void)err;
    for (int i = 0; i < atoms->n_local; ++i)
        values[i] = atoms->mask[i] & fix->mask ? ((const move_state *)fix->state)->r0.of[column][i] : 0.0;
    return HS_OK;
}

static hs_status keep_state(hs_fix *fix, hs_state *kept, hs_error *err)
{
    return hs_state_int64(kept, "start", &((move_state *)fix->state)->start, 1, err);
}

const hs_fix_style hs_fix_style_move = {
    .about =
        {.name = "move",
         .syntax = {.usage = "linear <Vx> <Vy> <Vz> | wiggle <Ax> <Ay> <Az> <period> | rotate <Px> <Py> <Pz> <Rx> <Ry> "
                             "<Rz> <period> | variable v_<dx> v_<dy> v_<dz> v_<vx> v_<vy> v_<vz> [units lattice|box]",
                    .n_min = 4,
                    .n_max = 8,
                    .keywords = keywords},
         .summary = "move atoms along a given path",
         .details =
             "The atoms of the group follow a path, whatever forces act on them: no other integrator may have them. r0 "
             "is where an atom was when the fix was defined (unwrapped), t the time since then.\n\n"
             "`linear` moves them with the velocity V: r = r0 + V t. `wiggle` lets them swing: r = r0 + A sin(2 pi "
             "t/period). `rotate` turns them about the axis through the point P along R, by the right-hand rule, once "
             "in a period; spheres get that angular velocity. `variable` takes displacements r - r0 and velocities "
             "from six equal-style or atom-style variables, evaluated at the start of each step.\n\n"
             "In linear and wiggle, NULL leaves a direction free: it follows the forces, as in `fix nve`. In variable, "
             "a direction is free where both are NULL; without the velocity alone, the velocity stays as it is; "
             "without the displacement alone, places follow from the velocity. In two dimensions atoms stay in the "
             "plane.\n\n"
             "`f_ID[1]` to `f_ID[3]` of an atom are r0. Of an atom that is created later it is where that was; define "
             "the fix after all atoms are there. Forces on the atoms are computed as ever, and can be measured; to "
             "compute temperatures without them, use a group of the others.",
         .example = "fix shear upper move linear 0.1 NULL NULL units box\nfix stir blade move rotate 0 0 0 0 0 1 "
                    "25.0\nfix shake floor move wiggle 0 0 0.2 1.5"},
    .state_size = sizeof(move_state),
    .create = create,
    .destroy = destroy,
    .init = init,
    .initial_integrate = initial_integrate,
    .final_integrate = final_integrate,
    .per_atom = per_atom,
    .keep_state = keep_state,
    .is_integrator = true,
    .is_time_dependent = true,
};
