/* Adds heat to a group of atoms, or takes it, at constant momentum, as fix heat does, and corrects the places of the
 * atoms so that the energy of long runs does not drift by the error of the splitting.
 * Source: P. Wirnsberger, D. Frenkel, C. Dellago, J. Chem. Phys. 143, 124104 (2015), doi:10.1063/1.4931597, method
 * eHEX/a. */
#include <string.h>

#include "base/memory.h"
#include "fix/thermal_motion.h"

typedef struct ehex_state {
    thermal_state thermal; /* first: thermal_motion.h takes the state as one */
    bool is_plain;         /**< places are not corrected */
    double v[3];           /**< velocity of the center of mass, at the present step */
} ehex_state;

static const hs_keyword keywords[] = {
    {"region", 1, "<region-ID>", "only atoms that are in this region at the step"},
    {"hex", 0, "", "without the correction of places: the method of fix heat"},
    {NULL, 0, NULL, NULL},
};

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    ehex_state *state = fix->state;
    state->thermal.scale = 1.0;
    HS_TRY(hs_syntax_check(&fix->style->about.syntax, args, false, err));
    HS_TRY(hs_arg_int(args, 0, 1, INT64_MAX, &state->thermal.every, err));
    HS_TRY(hs_arg_double(args, 1, &state->thermal.rate.value, err));
    for (int i = 2; i < args->n; ++i) {
        if (strcmp(args->word[i], "hex") == 0) {
            state->is_plain = true;
            continue;
        }
        HS_TRY(hs_where_set(&state->thermal.where, args->word[++i], err));
    }
    return thermal_find_region(fix, err);
}

/** Whether an atom takes part: by its place within the box, though lists may be older than its crossing of a face. */
static bool acts(const hs_fix *fix, int i)
{
    const hs_where *where = &((const ehex_state *)fix->state)->thermal.where;
    const hs_atoms *atoms = fix->env->atoms;
    double x[3] = {atoms->x[0][i], atoms->x[1][i], atoms->x[2][i]};
    int32_t image[3] = {0};
    hs_box_wrap(fix->env->box, x, image);
    return (atoms->mask[i] & fix->mask) != 0 && (where->region == NULL || hs_region_contains(where->region, x));
}

enum { FORCE, POWER = FORCE + 3, N_FORCE_SUMS };

/** Forces, and their power on the motion relative to the center of mass. */
static void add_force_terms(const hs_atoms *atoms, const void *context, int begin, int end, hs_exact_sum *sums)
{
    const ehex_state *state = ((const hs_fix *)context)->state;
    for (int i = begin; i < end; ++i) {
        double power = 0.0;
        if (!acts(context, i)) continue;
        for (int axis = 0; axis < 3; ++axis) {
            power += atoms->f[axis][i] * (atoms->v[axis][i] - state->v[axis]);
            hs_exact_add(&sums[FORCE + axis], atoms->f[axis][i]);
        }
        hs_exact_add(&sums[POWER], power);
    }
}

/** The error of a step of velocity Verlet with heat, of third order in the timestep, taken off the places. All heat of N
 *  steps comes in one. */
static void correct_places(hs_fix *fix, const unsigned char *is_in, double mass, double ke, double heat_rate)
{
    const ehex_state *state = fix->state;
    const hs_env *env = fix->env;
    const hs_atoms *atoms = env->atoms;
    double sums[N_FORCE_SUMS];
    hs_atom_sum(atoms, env->parallel, add_force_terms, fix, N_FORCE_SUMS, sums);
    const double ftm2v = env->units->ftm2v, dt3 = env->dt * env->dt * env->dt;
    const double power = sums[POWER] * ftm2v;
    const double along_v = heat_rate / (2.0 * ke * ke) * (heat_rate / 48.0 + power / 6.0);
    const double along_f = heat_rate / (12.0 * ke);
#pragma omp parallel for schedule(static)
    for (int i = 0; i < atoms->n_local; ++i) {
        if (!is_in[i]) continue;
        const double m = hs_atom_mass(atoms, i);
        for (int axis = 0; axis < 3; ++axis) {
            const double v = atoms->v[axis][i] - state->v[axis];
            const double a = (atoms->f[axis][i] / m - sums[FORCE + axis] / mass) * ftm2v;
            atoms->x[axis][i] = hs_moved(atoms->x[axis][i], -dt3 * (along_v * v - along_f * a), env->position_magic);
        }
    }
}

/** Local atoms that take part, for places change while the velocities wait. */
static hs_status mark_atoms(const hs_fix *fix, unsigned char **is_in, hs_error *err)
{
    const int n = fix->env->atoms->n_local;
    HS_UNLESS_FAILED(err, HS_ALLOC(*is_in, (size_t)n + 1, err));
    HS_TRY(hs_parallel_agree(fix->env->parallel, err));
#pragma omp parallel for schedule(static)
    for (int i = 0; i < n; ++i) (*is_in)[i] = acts(fix, i);
    return HS_OK;
}

static void scale_velocities(const hs_fix *fix, const unsigned char *is_in)
{
    const ehex_state *state = fix->state;
    const hs_atoms *atoms = fix->env->atoms;
#pragma omp parallel for schedule(static)
    for (int i = 0; i < atoms->n_local; ++i) {
        if (!is_in[i]) continue;
        for (int axis = 0; axis < 3; ++axis)
            atoms->v[axis][i] = state->v[axis] + state->thermal.scale * (atoms->v[axis][i] - state->v[axis]);
    }
}

static hs_status end_of_step(hs_fix *fix, hs_error *err)
{
    ehex_state *state = fix->state;
    hs_env *env = fix->env;
    const double rate = state->thermal.rate.value / env->units->mvv2e;
    thermal_motion motion;
    unsigned char *is_in = NULL;
    if (env->step % state->thermal.every != 0) return HS_OK;
    HS_TRY(thermal_find(fix, acts, rate * (double)state->thermal.every * env->dt, &motion, err));
    if (!(motion.mass > 0.0)) return HS_OK;
    memcpy(state->v, motion.v, sizeof state->v);
    state->thermal.scale = motion.scale;
    const hs_status status = mark_atoms(fix, &is_in, err);
    if (status == HS_OK && !state->is_plain)
        correct_places(fix, is_in, motion.mass, motion.ke, rate * (double)state->thermal.every);
    if (status == HS_OK) scale_velocities(fix, is_in);
    HS_FREE(is_in);
    hs_env_changed(env);
    return status;
}

const hs_fix_style hs_fix_style_ehex = {
    .about =
        {.name = "ehex",
         .syntax = {.usage = "<N> <rate> [region <region-ID>] [hex]", .n_min = 2, .n_max = 2, .keywords = keywords},
         .summary = "add heat to atoms, or take it, at constant momentum and without drift of the energy",
         .details =
             "At multiples of N steps the velocities of the group's atoms (with `region`, of those that are in it at "
             "the step) relative to that of their center of mass are scaled so that their kinetic energy grows by rate "
             "times N timesteps, as `fix heat` does; the rate (energy/time) is negative to take heat. Then the places "
             "are corrected by terms of third order in the timestep, which takes away most of the loss of energy that "
             "fix heat has in long runs. `hex` leaves the correction out. Use it with `fix nve`.\n\n"
             "The scalar `f_ID` is the factor on the velocities of the latest step. More heat than the atoms have "
             "cannot be taken: that stops the run.",
         .reference =
             "P. Wirnsberger, D. Frenkel, C. Dellago, J. Chem. Phys. 143, 124104 (2015), doi:10.1063/1.4931597",
         .example = "fix hot all ehex 1 100.0 region hot\nfix cold all ehex 1 -100.0 region cold"},
    .state_size = sizeof(ehex_state),
    .create = create,
    .end_of_step = end_of_step,
    .moves_at_end = true,
    THERMAL_HOOKS,
    .allows_dynamic_group = true,
};
