/* Pair forces of a step: the method's kernels, the halo's forces home, sums over ranks. */
#include <string.h>

#include "sim/methods.h"

hs_force_job hs_sim_make_job(hs_sim *sim, bool with_energy)
{
    hs_atoms *atoms = &sim->atoms;
    hs_neighbor *neighbor = &sim->neighbor;
    hs_force_job job = {.atoms = atoms,
                        .cells = &neighbor->cells,
                        .clusters = &neighbor->clusters,
                        .chains = &neighbor->chains,
                        .evaluator = sim->pair->style->evaluator,
                        .isa = sim->isa,
                        .precision = sim->precision,
                        .cutoff_max = sim->pair->cutoff_max,
                        .with_energy = with_energy};
    job.input = (hs_kernel_input){.x = {atoms->x[0], atoms->x[1], atoms->x[2]},
                                  .x_listed = {neighbor->x_listed[0], neighbor->x_listed[1], neighbor->x_listed[2]},
                                  .listed_only = neighbor->is_late && !neighbor->settings.exact,
                                  .type = sim->kernel_type != NULL ? sim->kernel_type : atoms->type,
                                  .table = &sim->pair_table};
    return job;
}

/** Energy of the long-range corrections at the present volume: see pair_modify tail. */
static void add_tail(hs_sim *sim)
{
    const hs_pair *pair = sim->pair;
    sim->env.tail_energy = sim->env.tail_pressure = 0.0;
    if (!pair->tail) return;
    const double volume = hs_box_volume(&sim->box);
    double energy, virial;
    for (int i = 1; i <= pair->n_types; ++i)
        for (int j = i; j <= pair->n_types; ++j) {
            pair->style->tail(pair, i, j, &energy, &virial);
            const double n_pairs = (i == j ? 1.0 : 2.0) * (double)sim->n_of_type[i] * (double)sim->n_of_type[j];
            sim->env.tail_energy += n_pairs * energy / volume;
            sim->env.tail_pressure += n_pairs * virial / (volume * volume) * sim->env.units->nktv2p;
        }
}

static void clear_forces(hs_atoms *atoms)
{
    for (int axis = 0; axis < 3; ++axis)
        memset(atoms->f[axis], 0, (size_t)(atoms->n_local + atoms->n_halo) * sizeof(double));
}

hs_status hs_sim_pair_forces(hs_sim *sim, bool with_energy, hs_error *err)
{
    hs_env *env = &sim->env;
    hs_force_result result = {0};
    hs_timer_mark(&sim->timer);
    if (sim->pair->style->evaluator == NULL || sim->pair->cutoff_max <= 0.0) {
        clear_forces(&sim->atoms);
    } else {
        const hs_force_job job = hs_sim_make_job(sim, with_energy);
        HS_TRY(hs_sim_method(sim)->forces(sim, &job, &result, err));
        hs_timer_add(&sim->timer, HS_PHASE_PAIR);
        hs_halo_reverse(&sim->halo, &sim->atoms);
        hs_timer_add(&sim->timer, HS_PHASE_COMM);
    }
    if (!with_energy) return HS_OK;
    double sums[7] = {result.energy};
    memcpy(sums + 1, result.virial, sizeof result.virial);
    hs_parallel_sum_double(&sim->parallel, sums, 7);
    env->pair_energy = sums[0];
    memcpy(env->pair_virial, sums + 1, sizeof env->pair_virial);
    env->energy_step = env->step;
    add_tail(sim);
    return HS_OK;
}
