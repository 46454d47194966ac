/* What fixes add to forces, energy and virial. */
#include <string.h>

#include "sim/sim.h"
#include "style/shared_fields.h"

/** Whether the forces of a fix are to be heard now. */
static bool acts(const hs_sim *sim, const hs_fix *fix) { return !sim->is_minimizing || fix->style->acts_in_minimize; }

hs_status hs_sim_pre_force(hs_sim *sim, bool is_setup, hs_error *err)
{
    hs_env_changed(&sim->env);
    for (int k = 0; k < sim->n_fixes; ++k)
        if (sim->fix[k]->style->pre_force != NULL && acts(sim, sim->fix[k]))
            HS_TRY(sim->fix[k]->style->pre_force(sim->fix[k], is_setup, err));
    return HS_OK;
}

/** Energies and virials of the fixes that count, over all ranks. What a fix gives is summed over ranks already. */
static hs_status add_up(hs_sim *sim, hs_error *err)
{
    hs_env *env = &sim->env;
    env->fix_energy = 0.0;
    memset(env->fix_virial, 0, sizeof env->fix_virial);
    for (int k = 0; k < sim->n_fixes; ++k) {
        hs_fix *fix = sim->fix[k];
        double energy = 0.0;
        if (!acts(sim, fix)) continue;
        if (fix->adds_energy) HS_TRY(fix->style->scalar(fix, &energy, err));
        env->fix_energy += energy;
        if (!fix->adds_virial) continue;
        for (int c = 0; c < 6; ++c) env->fix_virial[c] += fix->virial[c];
    }
    return HS_OK;
}

hs_status hs_sim_post_force(hs_sim *sim, hs_error *err)
{
    hs_env_changed(&sim->env);
    if (sim->env.with_energy) hs_shared_fields_clear(&sim->atoms, sim->env.virial_of_fixes, 6);
    for (int k = 0; k < sim->n_fixes; ++k)
        if (sim->fix[k]->style->post_force != NULL && acts(sim, sim->fix[k]))
            HS_TRY(sim->fix[k]->style->post_force(sim->fix[k], err));
    return sim->env.with_energy ? add_up(sim, err) : HS_OK;
}

/** fix_modify temp or press. */
static hs_status set_compute(hs_sim *sim, hs_fix *fix, const char *keyword, const char *id, hs_error *err)
{
    const bool is_pressure = keyword[0] == 'p';
    hs_compute *compute;
    hs_status (*set)(hs_fix *, const char *, hs_error *) =
        is_pressure ? fix->style->set_pressure : fix->style->set_temperature;
    if (set == NULL)
        return hs_fail(err, HS_ERROR_INPUT, "fix_modify: %s uses no %s", hs_fix_who(fix).text,
                       is_pressure ? "pressure" : "temperature");
    HS_TRY(hs_compute_get(&sim->env, id, is_pressure ? HS_PRESSURE : HS_TEMPERATURE, "fix_modify", &compute, err));
    return set(fix, id, err);
}

hs_status hs_sim_modify_fix(hs_sim *sim, const char *id, const hs_args *args, hs_error *err)
{
    hs_fix *fix = hs_sim_find_fix(sim, id);
    if (fix == NULL) return hs_fail(err, HS_ERROR_INPUT, "fix_modify: there is no fix with the ID '%s'", id);
    for (int i = 1; i < args->n; i += 2) {
        const bool is_energy = strcmp(args->word[i], "energy") == 0;
        bool value;
        if (strcmp(args->word[i], "temp") == 0 || strcmp(args->word[i], "press") == 0) {
            HS_TRY(set_compute(sim, fix, args->word[i], args->word[i + 1], err));
            continue;
        }
        HS_TRY(hs_arg_bool(args, i + 1, &value, err));
        if (value && !(is_energy ? fix->style->has_energy : fix->style->has_virial))
            return hs_fail(err, HS_ERROR_INPUT, "fix_modify: %s has no %s to add", hs_fix_who(fix).text, args->word[i]);
        *(is_energy ? &fix->adds_energy : &fix->adds_virial) = value;
    }
    sim->is_initialized = false;
    return HS_OK;
}
