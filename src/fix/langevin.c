/* Langevin thermostat: friction and noise, for use with a fix that integrates.
 *   F = -(m / damp) v + sqrt(2 k T m / (dt damp)) xi
 * Source: T. Schneider, E. Stoll, Phys. Rev. B 17, 1302 (1978), doi:10.1103/PhysRevB.17.1302; even noise instead of
 * normal: B. Duenweg, W. Paul, Int. J. Mod. Phys. C 2, 817 (1991), doi:10.1142/S0129183191001037. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "fix/bath.h"
#include "kernel/noise_fill.h"
#include "style/atom_sum.h"
#include "style/atom_vector.h"
#include "style/compute.h"
#include "style/spheres.h"

typedef struct langevin_state {
    bath_ramp bath;
    double damp;   /**< time */
    double *scale; /**< owned [n_types + 1]: damp is multiplied by it */
    hs_noise noise;
    bool is_zeroed, is_tallied;
    bool turns;           /**< omega yes: rotations are thermostatted, too */
    char *temperature_id; /**< owned; compute of fix_modify temp, whose bias is left alone; NULL: none */

    /* by type, for unit mass where atoms have masses of their own */
    double *drag;         /**< owned [n_types + 1]: force of a unit velocity, negative */
    double *kick;         /**< owned: standard deviation of the force at T = 1 */
    hs_atom_vector force; /**< with tally: what was added last */
    double energy;        /**< given to the atoms so far; energy */
    double power;         /**< of the latest step, all ranks; energy/time */
} langevin_state;

static const hs_keyword keywords[] = {
    {"scale", 2, "<type> <ratio>", "multiply the damping time for atoms of a type"},
    {"tally", 1, "yes|no", "add up the energy given to atoms: f_ID"},
    {"zero", 1, "yes|no", "make the sum of the random forces 0"},
    {"omega", 1, "yes|no", "friction and noise for the rotation of spheres, too (default no)"},
    {"angmom", 1, "no", "there are no ellipsoids"},
    {"gjf", 1, "no", "the scheme is that of Schneider and Stoll"},
    {NULL, 0, NULL, NULL},
};

static hs_status read_keyword(hs_fix *fix, const hs_args *args, int i, hs_error *err)
{
    langevin_state *state = fix->state;
    if (strcmp(args->word[i], "tally") == 0) return hs_arg_bool(args, i + 1, &state->is_tallied, err);
    if (strcmp(args->word[i], "zero") == 0) return hs_arg_bool(args, i + 1, &state->is_zeroed, err);
    if (strcmp(args->word[i], "omega") == 0) return hs_arg_bool(args, i + 1, &state->turns, err);
    if (strcmp(args->word[i], "scale") != 0) return HS_OK; /* the syntax allows only `no` */
    int lo, hi;
    double ratio;
    HS_TRY(hs_arg_range(args, i + 1, fix->env->atoms->n_types, &lo, &hi, err));
    HS_TRY(hs_arg_positive(args, i + 2, &ratio, err));
    for (int type = lo; type <= hi; ++type) state->scale[type] = ratio;
    return HS_OK;
}

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    langevin_state *state = fix->state;
    hs_atoms *atoms = fix->env->atoms;
    int64_t seed;
    HS_TRY(hs_syntax_check(&fix->style->about.syntax, args, false, err));
    HS_TRY(bath_read(&state->bath, args, 0, err));
    HS_TRY(hs_arg_positive(args, 2, &state->damp, err));
    HS_TRY(hs_arg_int(args, 3, 1, INT32_MAX, &seed, err));
    HS_TRY(HS_ALLOC(state->scale, (size_t)atoms->n_types + 1, err));
    HS_TRY(HS_ALLOC(state->drag, (size_t)atoms->n_types + 1, err));
    HS_TRY(HS_ALLOC(state->kick, (size_t)atoms->n_types + 1, err));
    for (int type = 1; type <= atoms->n_types; ++type) state->scale[type] = 1.0;
    for (int i = 4; i < args->n; i += strcmp(args->word[i], "scale") == 0 ? 3 : 2)
        HS_TRY(read_keyword(fix, args, i, err));
    if (state->turns) {
        const hs_spheres spheres = {.has_rotation = true};
        state->turns = false; /* until the field is there to be released */
        HS_TRY(hs_spheres_check_style(&spheres, fix, args, err));
        HS_TRY(hs_torques_want(fix->env, err));
        state->turns = true;
    }
    fix->is_coupling = state->is_tallied;
    if (state->is_tallied) HS_TRY(hs_atom_vector_add(fix->env->atoms, &state->force, "fix", fix->id, "force", err));
    return hs_fix_noise(fix, seed, &state->noise, err);
}

static void destroy(hs_fix *fix)
{
    langevin_state *state = fix->state;
    hs_atom_vector_remove(fix->env->atoms, &state->force);
    if (state->turns) hs_torques_release(fix->env);
    hs_varying_fini(&state->bath.start);
    HS_FREE(state->temperature_id);
    HS_FREE(state->scale);
    HS_FREE(state->drag);
    HS_FREE(state->kick);
}

static hs_status init(hs_fix *fix, hs_error *err)
{
    langevin_state *state = fix->state;
    const hs_env *env = fix->env;
    const hs_units *units = env->units;
    HS_TRY(hs_varying_check(&state->bath.start, fix, err));
    if (state->turns) HS_TRY(hs_spheres_check(fix, err));
    for (int type = 1; type <= env->atoms->n_types; ++type) {
        const double mass = env->atoms->rmass != NULL ? 1.0 : env->atoms->mass[type],
                     damp = state->damp * state->scale[type];
        state->drag[type] = -mass / damp / units->ftm2v;
        state->kick[type] = sqrt(2.0 * units->boltz * mass / damp / env->dt / units->mvv2e) / units->ftm2v;
    }
    return HS_OK;
}

static hs_status set_temperature(hs_fix *fix, const char *id, hs_error *err)
{
    langevin_state *state = fix->state;
    return hs_memory_replace(&state->temperature_id, id, err);
}

/** The compute whose bias is left alone, brought up to date; NULL when everything is thermal (collective). */
static hs_status find_bias(hs_fix *fix, const hs_compute **bias, hs_error *err)
{
    const langevin_state *state = fix->state;
    double ignored;
    *bias = NULL;
    if (state->temperature_id == NULL) return HS_OK;
    hs_compute *compute;
    HS_TRY(hs_compute_get(fix->env, state->temperature_id, HS_TEMPERATURE, hs_fix_who(fix).text, &compute, err));
    HS_TRY(hs_compute_scalar(compute, &ignored, err));
    if (compute->style->bias != NULL) *bias = compute;
    return HS_OK;
}

/** Thermal velocity of local atom i. A component that is exactly 0 is one that the temperature leaves out altogether
 *  (an atom outside of its region, an axis of temp/partial): as in LAMMPS it feels no noise. */
static void thermal_velocity(const hs_atoms *atoms, const hs_compute *bias, int i, double v[3])
{
    double b[3] = {0.0};
    if (bias != NULL) bias->style->bias(bias, i, b);
    for (int axis = 0; axis < 3; ++axis) v[axis] = atoms->v[axis][i] - b[axis];
}

/** Forces on the atoms [begin, begin + n): drag, and noise minus `offset`. */
static void push_block(const hs_fix *fix, double root_t, const double offset[3], const hs_noise_set *functions,
                       int begin, int n)
{
    const langevin_state *state = fix->state;
    const hs_atoms *atoms = fix->env->atoms;
    const int32_t *type = atoms->type + begin;
    const uint32_t *group = atoms->mask + begin;
    hs_noise_block xi;
    double drag[HS_NOISE_BLOCK], kick[HS_NOISE_BLOCK];
    functions->fill(state->noise, HS_NOISE_UNIFORM, hs_fix_clock(fix), 0, fix->env->box->dimension, atoms->id + begin,
                    n, &xi);
    for (int i = 0; i < n; ++i) {
        const bool is_pushed = (group[i] & fix->mask) != 0;
        const double mass = atoms->rmass != NULL ? atoms->rmass[begin + i] : 1.0;
        drag[i] = is_pushed ? state->drag[type[i]] * mass : 0.0;
        kick[i] = is_pushed ? state->kick[type[i]] * root_t * sqrt(mass) : 0.0;
    }
    for (int axis = 0; axis < fix->env->box->dimension; ++axis) {
        double *restrict f = atoms->f[axis] + begin;
        const double *restrict v = atoms->v[axis] + begin;
        for (int i = 0; i < n; ++i) {
            const double shift = group[i] & fix->mask ? offset[axis] : 0.0;
            const double push = drag[i] * v[i] + (kick[i] * xi.number[axis][i] - shift);
            f[i] += push;
            if (state->is_tallied) state->force.of[axis][begin + i] = push;
        }
    }
}

/** The same for the thermal part of the velocities. */
static void push_biased(const hs_fix *fix, const hs_compute *bias, double root_t, const double offset[3], int begin,
                        int end)
{
    const langevin_state *state = fix->state;
    const hs_atoms *atoms = fix->env->atoms;
    for (int i = begin; i < end; ++i) {
        const double mass = atoms->rmass != NULL ? atoms->rmass[i] : 1.0;
        double xi[HS_NOISE_NUMBERS], v[3];
        if (state->is_tallied)
            for (int axis = 0; axis < 3; ++axis) state->force.of[axis][i] = 0.0;
        if (!(atoms->mask[i] & fix->mask)) continue;
        hs_noise_numbers(state->noise, HS_NOISE_UNIFORM, hs_fix_clock(fix), 0, atoms->id[i], xi);
        thermal_velocity(atoms, bias, i, v);
        for (int axis = 0; axis < fix->env->box->dimension; ++axis) {
            const double noise = v[axis] != 0.0 ? state->kick[atoms->type[i]] * root_t * sqrt(mass) * xi[axis] : 0.0;
            const double push = state->drag[atoms->type[i]] * mass * v[axis] + (noise - offset[axis]);
            atoms->f[axis][i] += push;
            if (state->is_tallied) state->force.of[axis][i] = push;
        }
    }
}

/** Torques on the atoms [begin, end): those of a sphere in a fluid that sticks to it, where friction -gamma v of the places
 *  goes with -(4/3) R^2 gamma omega of the rotation, that is 10/3 of the rate at which velocities are forgotten. */
static void turn(const hs_fix *fix, double root_t, int begin, int end)
{
    static const double ratio = 10.0 / 3.0;
    const langevin_state *state = fix->state;
    const hs_atoms *atoms = fix->env->atoms;
    const int first = fix->env->box->dimension == 2 ? 2 : 0; /* in the plane they turn about z */
    for (int i = begin; i < end; ++i) {
        double xi[HS_NOISE_NUMBERS];
        if (!(atoms->mask[i] & fix->mask)) continue;
        const double inertia = hs_sphere_inertia(atoms, i);
        const double drag = state->drag[atoms->type[i]] * ratio * inertia,
                     kick = state->kick[atoms->type[i]] * root_t * sqrt(ratio * inertia);
        hs_noise_numbers(state->noise, HS_NOISE_UNIFORM, hs_fix_clock(fix), 1, atoms->id[i], xi);
        for (int axis = first; axis < 3; ++axis)
            fix->env->torque[axis][i] += drag * atoms->omega[axis][i] + kick * xi[axis];
    }
}

/** What random_forces needs of a step. */
typedef struct random_context {
    const hs_fix *fix;
    const hs_compute *bias;
    double root_t;
} random_context;

/** Sums of the random forces of a step, and the number of atoms. */
static void random_forces(const hs_atoms *atoms, const void *context, int begin, int end, hs_exact_sum *sums)
{
    const random_context *random = context;
    const hs_fix *fix = random->fix;
    const langevin_state *state = fix->state;
    for (int i = begin; i < end; ++i) {
        double xi[HS_NOISE_NUMBERS], v[3] = {1.0, 1.0, 1.0};
        if (!(atoms->mask[i] & fix->mask)) continue;
        hs_noise_numbers(state->noise, HS_NOISE_UNIFORM, hs_fix_clock(fix), 0, atoms->id[i], xi);
        if (random->bias != NULL) thermal_velocity(atoms, random->bias, i, v);
        const double mass = atoms->rmass != NULL ? atoms->rmass[i] : 1.0;
        const double kick = state->kick[atoms->type[i]] * random->root_t * sqrt(mass);
        for (int axis = 0; axis < 3; ++axis)
            if (v[axis] != 0.0) hs_exact_add(&sums[axis], kick * xi[axis]);
        hs_exact_add(&sums[3], 1.0);
    }
}

/** Forces on a thread's share of the atoms. */
static void push_share(const hs_fix *fix, const hs_compute *bias, double root_t, const double offset[3])
{
    const langevin_state *state = fix->state;
    const int n_local = fix->env->atoms->n_local, n_blocks = (n_local + HS_NOISE_BLOCK - 1) / HS_NOISE_BLOCK;
    const hs_noise_set *functions = hs_isa_noise(fix->env->isa);
#pragma omp for schedule(static) nowait
    for (int b = 0; b < n_blocks; ++b) {
        const int begin = b * HS_NOISE_BLOCK, left = n_local - begin, n = left < HS_NOISE_BLOCK ? left : HS_NOISE_BLOCK;
        if (bias != NULL)
            push_biased(fix, bias, root_t, offset, begin, begin + n);
        else
            push_block(fix, root_t, offset, functions, begin, n);
        if (state->turns) turn(fix, root_t, begin, begin + n);
    }
}

static hs_status post_force(hs_fix *fix, hs_error *err)
{
    const langevin_state *state = fix->state;
    const hs_env *env = fix->env;
    const hs_compute *bias;
    double t, sums[4] = {0.0}, offset[3] = {0.0};
    HS_TRY(bath_now(fix, &((langevin_state *)fix->state)->bath, &t, err));
    HS_TRY(find_bias(fix, &bias, err));
    const double root_t = sqrt(t);
    if (state->is_zeroed) {
        const random_context context = {.fix = fix, .bias = bias, .root_t = root_t};
        hs_atom_sum(env->atoms, env->parallel, random_forces, &context, 4, sums);
        for (int axis = 0; axis < 3 && sums[3] > 0.0; ++axis) offset[axis] = sums[axis] / sums[3];
    }
    HS_ON_THREADS(push_share(fix, bias, root_t, offset));
    return HS_OK;
}

static void add_power(const hs_atoms *atoms, const void *context, int begin, int end, hs_exact_sum *sums)
{
    const hs_fix *fix = context;
    const langevin_state *state = fix->state;
    for (int i = begin; i < end; ++i)
        for (int axis = 0; axis < 3; ++axis)
            if (atoms->mask[i] & fix->mask) hs_exact_add(&sums[0], state->force.of[axis][i] * atoms->v[axis][i]);
}

/** Power at the end of the step: the trapezoidal rule over steps gives the energy. */
static hs_status end_of_step(hs_fix *fix, hs_error *err)
{
    langevin_state *state = fix->state;
    (void)err;
    if (!state->is_tallied) return HS_OK;
    hs_atom_sum(fix->env->atoms, fix->env->parallel, add_power, fix, 1, &state->power);
    state->energy += state->power * fix->env->dt;
    return HS_OK;
}

static hs_status scalar(hs_fix *fix, double *value, hs_error *err)
{
    const langevin_state *state = fix->state;
    if (!state->is_tallied)
        return hs_fail(err, HS_ERROR_INPUT, "%s: its energy f_%s needs the keyword 'tally yes'", hs_fix_who(fix).text,
                       fix->id);
    *value = -(state->energy - 0.5 * state->power * fix->env->dt);
    return HS_OK;
}

static hs_status keep_state(hs_fix *fix, hs_state *kept, hs_error *err)
{
    langevin_state *state = fix->state;
    HS_TRY(hs_state_double(kept, "energy", &state->energy, 1, err));
    return hs_state_double(kept, "power", &state->power, 1, err);
}

const hs_fix_style hs_fix_style_langevin = {
    .about =
        {.name = "langevin",
         .syntax = {.usage = "<Tstart> <Tstop> <damp> <seed> [keyword value ...]",
                    .n_min = 4,
                    .n_max = 4,
                    .keywords = keywords},
         .summary = "Langevin thermostat: friction and noise",
         .details =
             "Adds to each atom of the group the friction -m v / damp and a random force of variance 2 k T m / (dt "
             "damp) in each direction, evenly spread. `damp` is the time in which velocities are forgotten (time "
             "units); free atoms diffuse with D = k T damp / m. The temperature goes from Tstart to Tstop over the run "
             "(or from `run start` to `run stop`); Tstart may be an equal-style variable `v_name`, which then is the "
             "temperature at every step. The fix moves nothing: use it with `fix nve` or another integrator.\n\n"
             "The noise of an atom depends on the seed, the fix's ID, the step and the atom's ID alone. `scale` "
             "multiplies damp for types or ranges of them. With `tally yes` the scalar `f_ID` is the energy the atoms "
             "have given to the bath, so that total energy plus f_ID is conserved; `fix_modify energy yes` adds it to "
             "the potential energy. `zero yes` takes the mean off the random forces, so that they do not push the "
             "group as a whole. `angmom` and `gjf` are known and only `no` is supported.\n\n"
             "`omega yes` does the same to the rotation of spheres, which `fix nve/sphere` or `nvt/sphere` then move: "
             "their angular velocities are forgotten in (3/10) damp, the time of a sphere in a fluid that sticks to "
             "it, and noise holds the energy of rotation at k T / 2 for each direction. In two dimensions spheres turn "
             "about z alone.\n\n"
             "After `fix_modify temp` only the thermal part of the velocities in that temperature feels friction, and "
             "components that it leaves out altogether (atoms outside of the region of temp/region, axes of "
             "temp/partial) feel neither friction nor noise.",
         .reference = "T. Schneider, E. Stoll, Phys. Rev. B 17, 1302 (1978), doi:10.1103/PhysRevB.17.1302",
         .example = "fix 1 all nve\nfix 2 all langevin 1.0 1.0 0.5 48279"},
    .state_size = sizeof(langevin_state),
    .create = create,
    .destroy = destroy,
    .init = init,
    .dt_changed = init,
    .post_force = post_force,
    .end_of_step = end_of_step,
    .set_temperature = set_temperature,
    .scalar = scalar,
    .keep_state = keep_state,
    .has_energy = true,
    .is_coupling = true,
    .allows_dynamic_group = true,
    .keeps_plane = true,
};
