/** Flat walls with a potential: forces on atoms, energy, forces on the walls. */
#ifndef HS_FIX_WALL_POTENTIAL_H
#define HS_FIX_WALL_POTENTIAL_H

#include "fix/wall.h"
#include "style/places.h"
#include "style/varying.h"

typedef struct wall_potential_state {
    wall_state wall; /**< first: wall.h takes the state as one */
    double unit[WALL_MAX];
    hs_varying epsilon[WALL_MAX], sigma[WALL_MAX]; /**< those of the faces, which may follow variables */
    bool has_sigma;
} wall_potential_state;

/** Epsilon and sigma of face k as they are now. */
static inline hs_status wall_set_strength(const hs_fix *fix, int k, hs_error *err)
{
    wall_potential_state *state = fix->state;
    wall_face *face = &state->wall.face[k];
    face->epsilon = state->epsilon[k].value;
    face->sigma = state->sigma[k].value;
    const bool is_epsilon = !(face->epsilon >= 0.0);
    if (!is_epsilon && (!state->has_sigma || face->sigma > 0.0)) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "%s: %s of the wall %s is %g; it must be %s", hs_fix_who(fix).text,
                   is_epsilon ? "epsilon" : "sigma", wall_faces[2 * face->axis + face->end],
                   is_epsilon ? face->epsilon : face->sigma, is_epsilon ? "0 or positive" : "positive");
}

/** face place epsilon sigma cutoff, once or more; units, fld, pbc. @p has_sigma: the potential depends on sigma, which is a number
 *  at least in any case. */
static inline hs_status wall_potential_read(hs_fix *fix, const hs_args *args, bool has_sigma, hs_error *err)
{
    wall_potential_state *state = fix->state;
    bool is_lattice = true;
    int i = 0;
    state->has_sigma = has_sigma;
    while (i < args->n && strcmp(args->word[i], "units") != 0 && strcmp(args->word[i], "fld") != 0 &&
           strcmp(args->word[i], "pbc") != 0) {
        HS_TRY(wall_read_face(fix, args, i, err));
        wall_face *face = &state->wall.face[state->wall.n - 1];
        HS_TRY(hs_arg_need(args, i + 4, "one of the wall's epsilon, sigma and cutoff", err));
        const int k = state->wall.n - 1;
        HS_TRY(hs_varying_read(&state->epsilon[k], args, i + 2, err));
        HS_TRY(hs_varying_read(&state->sigma[k], args, i + 3, err));
        if (state->epsilon[k].variable == NULL) HS_TRY(hs_arg_not_negative(args, i + 2, &face->epsilon, err));
        if (has_sigma && state->sigma[k].variable == NULL) HS_TRY(hs_arg_positive(args, i + 3, &face->sigma, err));
        face->sigma = state->sigma[k].value;
        HS_TRY(hs_arg_positive(args, i + 4, &face->cutoff, err));
        i += 5;
    }
    if (state->wall.n == 0) return hs_arg_need(args, args->n, "a wall (xlo, xhi, ylo, yhi, zlo or zhi)", err);
    for (; i < args->n; i += 2) {
        static const char *const units[] = {"box", "lattice", NULL}, *const no[] = {"no", NULL};
        int choice;
        HS_TRY(hs_arg_need(args, i + 1, "the value of the last keyword", err));
        if (strcmp(args->word[i], "units") == 0) {
            HS_TRY(hs_arg_choice(args, i + 1, units, &choice, err));
            is_lattice = choice == 1;
        } else if (strcmp(args->word[i], "fld") == 0 || strcmp(args->word[i], "pbc") == 0) {
            HS_TRY(hs_arg_choice(args, i + 1, no, &choice, err));
        } else {
            return hs_arg_refuse(args, i, "a keyword (units, fld, pbc); all walls come before them", NULL, err);
        }
    }
    for (int k = 0; k < state->wall.n; ++k) {
        wall_face *face = &state->wall.face[k];
        state->unit[k] = wall_unit(fix, face, is_lattice);
        face->place *= state->unit[k];
    }
    fix->n_vector = state->wall.n;
    return HS_OK;
}

/** Distance of x, a coordinate along the wall's axis, from the wall, positive on the particles' side. */
static inline double wall_distance(const wall_face *face, double x)
{
    return face->end == 0 ? x - face->place : face->place - x;
}

/** Force on an atom at x along the axis of a wall; 0 beyond its cutoff. */
static inline double wall_force(const wall_state *state, const wall_face *face, double x, double *energy)
{
    const double r = wall_distance(face, x);
    double force = 0.0;
    *energy = 0.0;
    if (r < face->cutoff) *energy = state->energy(face->epsilon, face->sigma, face->cutoff, r, &force);
    return face->end == 0 ? force : -force;
}

static inline hs_status wall_report(const hs_fix *fix, const wall_face *face, hs_error *err)
{
    const hs_atoms *atoms = fix->env->atoms;
    int first = -1;
    for (int i = 0; i < atoms->n_local; ++i)
        if (atoms->mask[i] & fix->mask && !(wall_distance(face, atoms->x[face->axis][i]) > 0.0) &&
            (first < 0 || atoms->id[i] < atoms->id[first]))
            first = i;
    return hs_fail(err, HS_ERROR_RUN,
                   "%s: at step %lld atom %lld at (%g %g %g) is on or behind the wall %s at %g. Place atoms inside of "
                   "the walls, or use a shorter timestep or a stronger wall",
                   hs_fix_who(fix).text, (long long)fix->env->step, (long long)atoms->id[first], atoms->x[0][first],
                   atoms->x[1][first], atoms->x[2][first], wall_faces[2 * face->axis + face->end], face->place);
}

/** The lever is the distance from the wall, as in LAMMPS: the wall is part of the system. */
static inline void wall_virial_of(const hs_fix *fix, int i, double w[6])
{
    const wall_state *state = fix->state;
    for (int k = 0; k < state->n; ++k) {
        const wall_face *face = &state->face[k];
        double energy;
        const double x = fix->env->atoms->x[face->axis][i], force = wall_force(state, face, x, &energy);
        w[face->axis] += wall_distance(face, x) * (face->end == 0 ? force : -force);
    }
}

/** Forces of one face on a thread's share of the atoms; *is_inside becomes false when one is on or behind the wall. */
static inline void wall_push(const hs_fix *fix, const wall_face *face, bool *is_inside)
{
    const wall_state *state = fix->state;
    const hs_atoms *atoms = fix->env->atoms;
#pragma omp for schedule(static) nowait
    for (int i = 0; i < atoms->n_local; ++i) {
        const double x = atoms->x[face->axis][i], r = wall_distance(face, x);
        double energy;
        if (r >= face->cutoff || !(atoms->mask[i] & fix->mask)) continue;
        if (r > 0.0) {
            atoms->f[face->axis][i] += wall_force(state, face, x, &energy);
            continue;
        }
#pragma omp atomic write
        *is_inside = false;
    }
}

static inline hs_status wall_post_force(hs_fix *fix, hs_error *err)
{
    wall_potential_state *state = fix->state;
    const wall_face *crossed = NULL;
    for (int k = 0; k < state->wall.n; ++k) {
        wall_face *face = &state->wall.face[k];
        bool is_inside = true;
        HS_TRY(wall_place(fix, face, state->unit[k], err));
        HS_TRY(hs_varying_update(&state->epsilon[k], fix->env, err));
        HS_TRY(hs_varying_update(&state->sigma[k], fix->env, err));
        HS_TRY(wall_set_strength(fix, k, err));
        HS_ON_THREADS(wall_push(fix, face, &is_inside));
        if (!is_inside && crossed == NULL) crossed = face;
    }
    if (crossed != NULL) (void)wall_report(fix, crossed, err);
    HS_TRY(hs_parallel_agree(fix->env->parallel, err));
    if (hs_fix_needs_virial(fix)) hs_fix_sum_virial(fix, wall_virial_of);
    return HS_OK;
}

static inline void wall_terms(const hs_atoms *atoms, const void *context, int begin, int end, hs_exact_sum *sums)
{
    const hs_fix *fix = context;
    const wall_state *state = fix->state;
    const hs_places places = hs_places_of_forces(fix->env);
    for (int i = begin; i < end; ++i) {
        if (!(atoms->mask[i] & fix->mask)) continue;
        for (int k = 0; k < state->n; ++k) {
            double energy;
            const double force = wall_force(state, &state->face[k], places.x[state->face[k].axis][i], &energy);
            hs_exact_add(&sums[0], energy);
            hs_exact_add(&sums[1 + k], -force);
        }
    }
}

static inline hs_status wall_scalar(hs_fix *fix, double *value, hs_error *err)
{
    double sums[1 + WALL_MAX];
    (void)err;
    hs_atom_sum(fix->env->atoms, fix->env->parallel, wall_terms, fix, 1 + ((wall_state *)fix->state)->n, sums);
    *value = sums[0];
    return HS_OK;
}

static inline hs_status wall_vector(hs_fix *fix, int i, double *value, hs_error *err)
{
    double sums[1 + WALL_MAX];
    (void)err;
    hs_atom_sum(fix->env->atoms, fix->env->parallel, wall_terms, fix, 1 + ((wall_state *)fix->state)->n, sums);
    *value = sums[1 + i];
    return HS_OK;
}

static inline void wall_potential_destroy(hs_fix *fix)
{
    wall_potential_state *state = fix->state;
    for (int k = 0; k < WALL_MAX; ++k) {
        hs_varying_fini(&state->epsilon[k]);
        hs_varying_fini(&state->sigma[k]);
    }
    wall_destroy(fix);
}

static inline hs_status wall_potential_init(hs_fix *fix, hs_error *err)
{
    const wall_potential_state *state = fix->state;
    for (int k = 0; k < state->wall.n; ++k) {
        if (state->wall.face[k].variable != NULL)
            HS_TRY(hs_fix_need_equal_style(fix, state->wall.face[k].variable, err));
        HS_TRY(hs_varying_check(&state->epsilon[k], fix, err));
        HS_TRY(hs_varying_check(&state->sigma[k], fix, err));
    }
    return HS_OK;
}

static inline hs_status wall_potential_keep_state(hs_fix *fix, hs_state *kept, hs_error *err)
{
    wall_state *state = fix->state;
    double epsilon[WALL_MAX], sigma[WALL_MAX];
    HS_TRY(wall_keep_state(fix, kept, err));
    for (int k = 0; k < state->n; ++k) epsilon[k] = state->face[k].epsilon, sigma[k] = state->face[k].sigma;
    HS_TRY(hs_state_double(kept, "epsilon", epsilon, state->n, err));
    HS_TRY(hs_state_double(kept, "sigma", sigma, state->n, err));
    for (int k = 0; k < state->n; ++k) state->face[k].epsilon = epsilon[k], state->face[k].sigma = sigma[k];
    return HS_OK;
}

#define WALL_USAGE "<face> <place> <epsilon> <sigma> <cutoff> ... [units lattice|box] [fld no] [pbc no]"

#define WALL_DETAILS                                                                                                   \
    "A face is xlo, xhi, ylo, yhi, zlo or zhi; up to six walls can be given one after the other, each with its own "   \
    "values. The place is a coordinate, `EDGE` (where the box's face is when the fix is defined), or an "              \
    "equal-style variable "                                                                                            \
    "`v_name`; numbers and variables are in lattice spacings unless `units box` is said. epsilon (energy), sigma and " \
    "cutoff (distance) are in plain units; epsilon and sigma may be such variables, too. Walls must stand across "     \
    "directions that are not periodic. An atom on or "                                                                 \
    "behind a wall stops the run.\n\nThe scalar `f_ID` is the energy of all walls, `f_ID[1]` ... the force on each "   \
    "wall. `fix_modify energy yes` adds the energy to the potential energy, `virial yes` the virial, with distances "  \
    "from the walls, to the pressure. "                                                                                \
    "`fld` and `pbc` are known and only `no` is supported."

/** The rest of a wall style's descriptor. */
#define WALL_HOOKS                                                                                                     \
    .state_size = sizeof(wall_potential_state), .create = create, .destroy = wall_potential_destroy,                   \
    .init = wall_potential_init, .keep_state = wall_potential_keep_state, .post_force = wall_post_force,               \
    .acts_in_minimize = true, .scalar = wall_scalar, .vector = wall_vector, .n_vector = WALL_MAX,                      \
    .is_extensive = true, .is_vector_extensive = true, .has_energy = true, .has_virial = true, .keeps_plane = true

#endif
