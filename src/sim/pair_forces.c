/* Pair forces of a step: the method's kernels for each part of the pair style, the halo's forces home, sums over ranks. */
#include <string.h>

#include "sim/methods.h"

/** Index of the first part of the pair style that exerts forces; there is one. Its table has the distances of the lists. */
static int first_part(const hs_pair *pair)
{
    int k = 0;
    while (pair->part[k]->style->evaluator == NULL) ++k;
    return k;
}

hs_force_job hs_sim_make_job(hs_sim *sim, bool with_energy)
{
    const int part = first_part(sim->pair);
    hs_atoms *atoms = &sim->atoms;
    hs_neighbor *neighbor = &sim->neighbor;
    hs_force_job job = {.atoms = atoms,
                        .cells = &neighbor->cells,
                        .clusters = &neighbor->clusters,
                        .chains = &neighbor->chains,
                        .evaluator = sim->pair->part[part]->style->evaluator,
                        .isa = sim->isa,
                        .precision = sim->precision,
                        .cutoff_max = sim->pair->cutoff_max,
                        .with_energy = with_energy};
    job.input = (hs_kernel_input){.x = {atoms->x[0], atoms->x[1], atoms->x[2]},
                                  .x_listed = {neighbor->x_listed[0], neighbor->x_listed[1], neighbor->x_listed[2]},
                                  .listed_only = neighbor->is_late && !neighbor->settings.exact,
                                  .type = sim->kernel_type != NULL ? sim->kernel_type : atoms->type,
                                  .table = &sim->pair_table[part]};
    return job;
}

/** Energy of the long-range corrections at the present volume: see pair_modify tail. */
static void add_tail(hs_sim *sim)
{
    sim->env.tail_energy = sim->env.tail_pressure = 0.0;
    const double volume = hs_box_volume(&sim->box);
    for (int k = 0; k < sim->pair->n_parts; ++k) {
        const hs_pair *part = sim->pair->part[k];
        for (int i = 1; i <= part->n_types && part->tail; ++i)
            for (int j = i; j <= part->n_types; ++j) {
                double energy, virial;
                if (part->cutoff[hs_pair_index(part, i, j)] <= 0.0) continue;
                part->style->tail(part, i, j, &energy, &virial);
                const double n_pairs = (i == j ? 1.0 : 2.0) * (double)sim->n_of_type[i] * (double)sim->n_of_type[j];
                sim->env.tail_energy += n_pairs * energy / volume;
                sim->env.tail_pressure += n_pairs * virial / (volume * volume) * sim->env.units->nktv2p;
            }
    }
}

static void clear_forces(hs_atoms *atoms)
{
    for (int axis = 0; axis < 3; ++axis)
        memset(atoms->f[axis], 0, (size_t)(atoms->n_local + atoms->n_halo) * sizeof(double));
}

/** One evaluation for each part of the pair style, each added to the forces of those before. */
static hs_status add_parts(hs_sim *sim, bool with_energy, hs_force_result *sum, hs_error *err)
{
    hs_force_job job = hs_sim_make_job(sim, with_energy);
    for (int k = 0; k < sim->pair->n_parts; ++k) {
        hs_force_result result;
        job.evaluator = sim->pair->part[k]->style->evaluator;
        job.input.table = &sim->pair_table[k];
        if (job.evaluator == NULL) continue;
        HS_TRY(hs_sim_method(sim)->forces(sim, &job, &result, err));
        job.is_added = true;
        sum->energy += result.energy;
        for (int c = 0; c < 6; ++c) sum->virial[c] += result.virial[c];
    }
    return HS_OK;
}

hs_status hs_sim_pair_forces(hs_sim *sim, bool with_energy, hs_error *err)
{
    hs_env *env = &sim->env;
    hs_force_result result = {0};
    hs_timer_mark(&sim->timer);
    if (!hs_pair_has_forces(sim->pair) || sim->pair->cutoff_max <= 0.0) {
        clear_forces(&sim->atoms);
    } else {
        HS_TRY(add_parts(sim, with_energy, &result, err));
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
