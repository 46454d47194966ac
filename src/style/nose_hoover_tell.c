/* What fix nvt, npt and nph tell: energies, their parts, and their state for checkpoints. */
#include <string.h>

#include "style/nose_hoover_internal.h"

enum { N_PARTS = 13 }; /* of the vector f_ID */

double hs_nose_hoover_barostat_target(const hs_nose_hoover *nh, double kt)
{
    return nh->barometer.is_iso ? kt : nh->n_moves * kt;
}

/** Lengths of the parts of the vector, in order. */
static void vector_parts(const hs_nose_hoover *nh, int n[N_PARTS])
{
    const int n_t = nh->chain.n, n_p = nh->barostat_chain.n,
              n_strains = !nh->has_barostat      ? 0
                          : nh->barometer.is_iso ? 1
                          : nh->has_tilts        ? 6
                                                 : 3;
    const int parts[N_PARTS] = {
        n_t, n_t, n_strains, n_strains, n_p, n_p, n_t, n_t, n_strains, n_strains, n_p, n_p, nh->has_strain_energy};
    memcpy(n, parts, sizeof parts);
}

int hs_nose_hoover_n_vector(const hs_nose_hoover *nh)
{
    int n[N_PARTS], sum = 0;
    vector_parts(nh, n);
    for (int k = 0; k < N_PARTS; ++k) sum += n[k];
    return sum;
}

/** As in LAMMPS the axes whose lengths stay count, too: a constant in an orthogonal box. */
static double strain_energy(const hs_nose_hoover *nh, const hs_env *env)
{
    return nh->has_strain_energy ? hs_strain_energy_of(&nh->strained, env->box) / env->units->nktv2p : 0.0;
}

static double strain_kinetic(const hs_nose_hoover *nh, int k)
{
    return nh->moves[k] ? 0.5 * nh->mass[k] * nh->strain_rate[k] * nh->strain_rate[k] : 0.0;
}

static double work(const hs_nose_hoover *nh, const hs_env *env)
{
    return nh->p_mean * (hs_box_volume(env->box) - hs_box_volume(&nh->reference)) / env->units->nktv2p;
}

/** Component of strain number i of the vector. */
static int component(int i)
{
    static const int order[HS_NH_COMPONENTS] = {0, 1, 2, 5, 4, 3};
    return order[i];
}

hs_status hs_nose_hoover_scalar(hs_fix *fix, double *value, hs_error *err)
{
    const hs_nose_hoover *nh = fix->state;
    const hs_env *env = fix->env;
    const double kt = env->units->boltz * nh->t_target;
    (void)err;
    *value = hs_nh_chain_energy(&nh->chain, kt, nh->n_dof * kt);
    if (!nh->has_barostat) return HS_OK;
    for (int k = 0; k < HS_NH_COMPONENTS; ++k) *value += strain_kinetic(nh, k);
    *value += work(nh, env) + hs_nh_chain_energy(&nh->barostat_chain, kt, hs_nose_hoover_barostat_target(nh, kt));
    *value += strain_energy(nh, env);
    return HS_OK;
}

hs_status hs_nose_hoover_vector(hs_fix *fix, int i, double *value, hs_error *err)
{
    const hs_nose_hoover *nh = fix->state;
    const hs_env *env = fix->env;
    const double kt = env->units->boltz * nh->t_target;
    int n[N_PARTS], part = 0;
    (void)err;
    vector_parts(nh, n);
    for (; i >= n[part]; ++part) i -= n[part];
    const hs_nh_chain *chain = part < 2 || part == 6 || part == 7 ? &nh->chain : &nh->barostat_chain;
    switch (part) {
    case 0:
    case 4:
        *value = chain->place[i];
        break;
    case 1:
    case 5:
        *value = chain->rate[i];
        break;
    case 2:
        *value = nh->strain[component(i)];
        break;
    case 3:
        *value = nh->strain_rate[component(i)];
        break;
    case 6:
        *value = hs_nh_chain_potential(chain, i, kt, nh->n_dof * kt);
        break;
    case 10:
        *value = hs_nh_chain_potential(chain, i, kt, hs_nose_hoover_barostat_target(nh, kt));
        break;
    case 7:
    case 11:
        *value = hs_nh_chain_kinetic(chain, i);
        break;
    case 8:
        *value = nh->barometer.is_iso ? work(nh, env) : i < HS_NH_XY && nh->moves[i] ? work(nh, env) / nh->n_axes : 0.0;
        break;
    case 9:
        *value = nh->barometer.is_iso ? nh->n_axes * strain_kinetic(nh, 0) : strain_kinetic(nh, component(i));
        break;
    default:
        *value = strain_energy(nh, env);
    }
    return HS_OK;
}

hs_status hs_nose_hoover_keep_state(hs_fix *fix, hs_state *kept, hs_error *err)
{
    static const char *const thermostat[4] = {"eta", "eta rate", "eta force", "eta mass"};
    static const char *const barostat[4] = {"etap", "etap rate", "etap force", "etap mass"};
    hs_nose_hoover *nh = fix->state;
    HS_TRY(hs_nh_chain_keep(&nh->chain, kept, thermostat, err));
    HS_TRY(hs_nh_chain_keep(&nh->barostat_chain, kept, barostat, err));
    HS_TRY(hs_state_double(kept, "temperature", &nh->t_now, 1, err));
    HS_TRY(hs_state_double(kept, "target temperature", &nh->t_target, 1, err));
    HS_TRY(hs_state_double(kept, "first temperature", &nh->t_fixed, 1, err));
    HS_TRY(hs_state_double(kept, "degrees of freedom", &nh->n_dof, 1, err));
    HS_TRY(hs_state_double(kept, "strain", nh->strain, HS_NH_COMPONENTS, err));
    HS_TRY(hs_state_double(kept, "strain rate", nh->strain_rate, HS_NH_COMPONENTS, err));
    HS_TRY(hs_state_double(kept, "strain mass", nh->mass, HS_NH_COMPONENTS, err));
    HS_TRY(hs_state_double(kept, "target pressure", nh->p_target, HS_NH_COMPONENTS, err));
    HS_TRY(hs_state_double(kept, "mean pressure", &nh->p_mean, 1, err));
    HS_TRY(hs_state_double(kept, "fixed point", nh->fixed_point, 3, err));
    HS_TRY(hs_state_bool(kept, "has reference", &nh->has_reference, err));
    if (kept->is_reading) nh->reference = *fix->env->box;
    HS_TRY(hs_state_double(kept, "reference lo", nh->reference.lo, 3, err));
    HS_TRY(hs_state_double(kept, "reference hi", nh->reference.hi, 3, err));
    HS_TRY(hs_state_double(kept, "reference tilt", nh->reference.tilt, 3, err));
    HS_TRY(hs_state_double(kept, "strain energy volume", &nh->strained.volume, 1, err));
    return hs_state_double(kept, "strain energy", nh->strained.sigma[0], 9, err);
}
