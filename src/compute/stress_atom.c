/* Stress of each atom times its volume:  S_ab = -(m v_a v_b + sum over pairs (r_a F_b) / 2 + W_ab),
 * W the virial of fixes.
 * Source: A. P. Thompson, S. J. Plimpton, W. Mattson, J. Chem. Phys. 131, 154107 (2009), doi:10.1063/1.3245303. */
#include <string.h>

#include "base/memory.h"
#include "core/atom_style.h"
#include "style/compute.h"
#include "style/fix.h"
#include "style/pair_shares.h"
#include "style/stress_parts.h"

typedef struct stress_state {
    char *temperature_id; /**< owned; NULL: velocities count as they are */
    hs_stress_parts parts;
    bool is_virial_user; /**< of env->virial_of_fixes */
} stress_state;

static hs_status find_temperature(const hs_compute *compute, hs_compute **temperature, hs_error *err)
{
    const stress_state *state = compute->state;
    *temperature = NULL;
    if (state->temperature_id == NULL) return HS_OK;
    *temperature = compute->env->find_compute(compute->env, state->temperature_id);
    if (*temperature != NULL && (*temperature)->style->is_temperature) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT,
                   "%s: '%s' is not a compute of a temperature; NULL takes the velocities as they are",
                   hs_compute_who(compute).text, state->temperature_id);
}

static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    stress_state *state = compute->state;
    hs_compute *temperature;
    compute->may_need_energy = true;
    compute->n_atom_columns = 6;
    state->parts = hs_stress_parts_read(args, 1);
    if (state->parts.has_pair) hs_pair_shares_want(compute->env->pair_shares, true);
    if (state->parts.has_fix) {
        HS_TRY(hs_virial_of_fixes_want(compute->env, err));
        state->is_virial_user = true;
    }
    if (strcmp(args->word[0], "NULL") != 0) HS_TRY(hs_memory_strdup(&state->temperature_id, args->word[0], err));
    return find_temperature(compute, &temperature, err);
}

static void destroy(hs_compute *compute)
{
    stress_state *state = compute->state;
    HS_FREE(state->temperature_id);
    if (state->parts.has_pair) hs_pair_shares_release(compute->env->pair_shares, true);
    if (state->is_virial_user) hs_virial_of_fixes_release(compute->env);
}

static hs_status init(hs_compute *compute, hs_error *err)
{
    hs_compute *temperature;
    return find_temperature(compute, &temperature, err);
}

static const int axis_a[6] = {0, 1, 2, 0, 0, 1}, axis_b[6] = {0, 1, 2, 1, 2, 2};

/** m v_a v_b of the thermal velocities. */
static hs_status add_kinetic(hs_compute *compute, hs_error *err)
{
    const hs_env *env = compute->env;
    const hs_atoms *atoms = env->atoms;
    const size_t n = (size_t)atoms->n_local;
    hs_compute *temperature;
    double t;
    HS_TRY(find_temperature(compute, &temperature, err));
    if (temperature != NULL) HS_TRY(hs_compute_scalar(temperature, &t, err)); /* brings the bias up to date */
    for (size_t i = 0; i < n; ++i) {
        double v[3], bias[3] = {0.0, 0.0, 0.0};
        if (temperature != NULL && temperature->style->bias != NULL)
            temperature->style->bias(temperature, (int)i, bias);
        for (int axis = 0; axis < 3; ++axis) v[axis] = atoms->v[axis][i] - bias[axis];
        const double mass = env->units->mvv2e * hs_atom_mass(atoms, i);
        for (size_t k = 0; k < 6; ++k) compute->atoms[k * n + i] += mass * v[axis_a[k]] * v[axis_b[k]];
    }
    return HS_OK;
}

static hs_status per_atom(hs_compute *compute, hs_error *err)
{
    const stress_state *state = compute->state;
    hs_env *env = compute->env;
    const size_t n = (size_t)env->atoms->n_local;
    const double *energy, *virial = NULL;
    if (state->parts.has_pair) HS_TRY(hs_pair_shares_get(env, true, &energy, &virial, err));
    for (size_t k = 0; k < 6 * n; ++k) compute->atoms[k] = virial != NULL ? virial[k] : 0.0;
    for (size_t k = 0; k < 6 && state->parts.has_fix; ++k)
        for (size_t i = 0; i < n; ++i) compute->atoms[k * n + i] += env->virial_of_fixes[k][i];
    if (state->parts.has_ke) HS_TRY(add_kinetic(compute, err));
    for (size_t i = 0; i < n; ++i) {
        const bool is_member = (env->atoms->mask[i] & compute->mask) != 0;
        for (size_t k = 0; k < 6; ++k)
            compute->atoms[k * n + i] = is_member ? -env->units->nktv2p * compute->atoms[k * n + i] : 0.0;
    }
    return HS_OK;
}

const hs_compute_style hs_compute_style_stress_atom = {
    .about =
        {.name = "stress/atom",
         .syntax = {.usage = "<temperature-compute | NULL> [ke pair virial bond angle dihedral improper kspace fix]",
                    .n_min = 1,
                    .n_max = 1,
                    .keywords = hs_stress_parts_keywords},
         .summary = "stress of each atom times its volume",
         .details =
             "The values per atom `c_ID[1]` ... `c_ID[6]` are -(m v_a v_b + sum over pairs (r_a F_b)/2 + W_ab), W the "
             "virial of fixes with `fix_modify virial yes`, in the order xx, yy, zz, xy, xz, yz (pressure times "
             "volume; the volume of an atom is not known); atoms outside the group have 0. Minus their sum over all "
             "atoms divided by the volume is the pressure tensor. The first word names a temperature compute, whose "
             "bias (as the motion of the center of mass in temp/com) is taken off the velocities; NULL takes them as "
             "they are. Without keywords every part counts; with keywords only the parts they name. The pairs are "
             "found once for all computes stress/atom and pe/atom of a step, which takes some timesteps' time.",
         .reference =
             "A. P. Thompson, S. J. Plimpton, W. Mattson, J. Chem. Phys. 131, 154107 (2009), doi:10.1063/1.3245303",
         .example = "compute s all stress/atom NULL\ncompute p all reduce sum c_s[1] c_s[2] c_s[3]"},
    .state_size = sizeof(stress_state),
    .create = create,
    .destroy = destroy,
    .init = init,
    .per_atom = per_atom,
};
