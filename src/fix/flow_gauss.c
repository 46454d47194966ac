/* Gaussian dynamics: the acceleration, the same for all atoms of a group, that keeps their momentum as it is,
 * a = -sum(f) / sum(m). */
#include <string.h>

#include "core/atom_style.h"
#include "style/atom_sum.h"
#include "style/fix.h"

typedef struct flow_state {
    bool is_kept[3];   /**< the momentum along this axis */
    bool counts_work;  /**< keyword energy */
    double applied[3]; /**< force on the whole group, at the latest step */
    double energy;     /**< minus the work done so far */
} flow_state;

static const hs_keyword keywords[] = {
    {"energy", 1, "yes|no", "count the work (default no); fix_modify energy yes counts it, too"},
    {NULL, 0, NULL, NULL},
};

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    flow_state *state = fix->state;
    HS_TRY(hs_syntax_check(&fix->style->about.syntax, args, false, err));
    for (int axis = 0; axis < 3; ++axis) {
        int64_t flag;
        HS_TRY(hs_arg_int(args, axis, 0, 1, &flag, err));
        state->is_kept[axis] = flag == 1;
    }
    if (!state->is_kept[0] && !state->is_kept[1] && !state->is_kept[2])
        return hs_fail(err, HS_ERROR_INPUT, "%s: '0 0 0' keeps no flow; 1 is wanted for at least one of x, y, z",
                       args->command);
    if (state->is_kept[2] && fix->env->box->dimension == 2)
        return hs_fail(err, HS_ERROR_INPUT, "%s: nothing flows along z in a simulation of dimension 2; give 0 for it",
                       args->command);
    for (int i = 3; i < args->n; i += 2) HS_TRY(hs_arg_bool(args, i + 1, &state->counts_work, err));
    return HS_OK;
}

/** Forces, mass and momentum of the group. */
static void add_terms(const hs_atoms *atoms, const void *context, int begin, int end, hs_exact_sum *sums)
{
    const hs_fix *fix = context;
    for (int i = begin; i < end; ++i) {
        if (!(atoms->mask[i] & fix->mask)) continue;
        const double mass = hs_atom_mass(atoms, i);
        hs_exact_add(&sums[3], mass);
        for (int axis = 0; axis < 3; ++axis) {
            hs_exact_add(&sums[axis], atoms->f[axis][i]);
            hs_exact_add(&sums[4 + axis], mass * atoms->v[axis][i]);
        }
    }
}

static void accelerate(const hs_fix *fix, const double acceleration[3])
{
    const hs_atoms *atoms = fix->env->atoms;
#pragma omp parallel for schedule(static)
    for (int i = 0; i < atoms->n_local; ++i) {
        if (!(atoms->mask[i] & fix->mask)) continue;
        const double mass = hs_atom_mass(atoms, i);
        for (int axis = 0; axis < 3; ++axis) atoms->f[axis][i] += mass * acceleration[axis];
    }
}

static hs_status post_force(hs_fix *fix, hs_error *err)
{
    flow_state *state = fix->state;
    const hs_env *env = fix->env;
    double sums[7], acceleration[3] = {0.0}, power = 0.0;
    (void)err;
    memset(state->applied, 0, sizeof state->applied);
    hs_atom_sum(env->atoms, env->parallel, add_terms, fix, 7, sums);
    if (!(sums[3] > 0.0)) return HS_OK;
    for (int axis = 0; axis < 3; ++axis) {
        if (!state->is_kept[axis]) continue;
        state->applied[axis] = 0.0 - sums[axis]; /* not -0 */
        acceleration[axis] = -sums[axis] / sums[3];
        power += acceleration[axis] * sums[4 + axis];
    }
    accelerate(fix, acceleration);
    /* the set-up's forces are those of the step at which the run begins, whose work was counted when it was made */
    if (env->step > env->first_step && (state->counts_work || fix->adds_energy)) state->energy -= power * env->dt;
    return HS_OK;
}

static hs_status scalar(hs_fix *fix, double *value, hs_error *err)
{
    (void)err;
    *value = ((const flow_state *)fix->state)->energy;
    return HS_OK;
}

static hs_status vector(hs_fix *fix, int i, double *value, hs_error *err)
{
    (void)err;
    *value = ((const flow_state *)fix->state)->applied[i];
    return HS_OK;
}

static hs_status keep_state(hs_fix *fix, hs_state *kept, hs_error *err)
{
    flow_state *state = fix->state;
    HS_TRY(hs_state_double(kept, "applied", state->applied, 3, err));
    return hs_state_double(kept, "energy", &state->energy, 1, err);
}

const hs_fix_style hs_fix_style_flow_gauss = {
    .about =
        {.name = "flow/gauss",
         .syntax = {.usage = "<x> <y> <z> [energy yes|no]", .n_min = 3, .n_max = 3, .keywords = keywords},
         .summary = "keep the flow of a group constant (Gaussian dynamics)",
         .details =
             "1 or 0 for each of x, y and z: along the axes with 1 all atoms of the group get, at every step, the one "
             "acceleration with which the sum of the forces on them is 0, so that their momentum stays what it is. "
             "Define the fix after those whose forces it shall balance. It starts no flow; the command `velocity` "
             "does. In a steady flow the fix heats the system, so that a thermostat is needed that leaves the flow "
             "alone, such as one with `compute temp/profile`; a thermostat that acts on other atoms too would change "
             "the flow.\n\n"
             "The vector `f_ID[1]` ... `f_ID[3]` is the force on the whole group at the latest step (force units): its "
             "mean divided by the cross-section of a pipe is the pressure drop along it. The scalar `f_ID` is minus "
             "the work done since the fix was made (energy units), for tests of the conservation of energy; it is "
             "counted with `energy yes`, or when `fix_modify energy yes` adds it to the potential energy, and else 0.",
         .reference = "D. J. Evans, G. P. Morriss, Phys. Rev. Lett. 56, 2172 (1986), doi:10.1103/PhysRevLett.56.2172; "
                      "S. E. Strong, J. D. Eaves, J. Phys. Chem. Lett. 7, 1907 (2016), doi:10.1021/acs.jpclett.6b00748",
         .example = "velocity fluid set 0.1 0 0 sum yes\nfix GD fluid flow/gauss 1 0 0\nfix GD fluid flow/gauss 1 1 1 "
                    "energy yes"},
    .state_size = sizeof(flow_state),
    .create = create,
    .post_force = post_force,
    .keep_state = keep_state,
    .scalar = scalar,
    .vector = vector,
    .n_vector = 3,
    .is_extensive = true,
    .is_vector_extensive = true,
    .has_energy = true,
};
