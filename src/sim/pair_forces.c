/* Pair forces of a step: the method's kernels for each part of the pair style, the halo's forces home, sums over
 * ranks. */
#include <math.h>
#include <string.h>

#include "core/exact_sum.h"
#include "kernel/pair_histogram.h"
#include "sim/methods.h"
#include "style/shared_fields.h"

/** Index of the first part of the pair style that exerts forces; there is one. Its table has the distances of the
 *  lists. */
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
                        .coarse = neighbor->has_levels ? &neighbor->coarse : NULL,
                        .evaluator = sim->pair->part[part]->style->evaluator,
                        .isa = sim->isa,
                        .precision = sim->kernel_precision,
                        .cutoff_max = sim->pair->cutoff_max,
                        .with_energy = with_energy,
                        .is_remote = sim->halo.is_remote};
    job.input = (hs_kernel_input){.x = {atoms->x[0], atoms->x[1], atoms->x[2]},
                                  .x_listed = {neighbor->x_listed[0], neighbor->x_listed[1], neighbor->x_listed[2]},
                                  .is_flat = neighbor->is_flat,
                                  .listed_only = hs_sim_misses_pairs(sim),
                                  .radius = hs_pair_has_radii(sim->pair, false) ? atoms->radius : NULL,
                                  .listed_by_radius = hs_pair_has_radii(sim->pair, true),
                                  .skin = neighbor->settings.skin,
                                  .type = sim->kernel_type != NULL ? sim->kernel_type : atoms->type,
                                  .gathers = hs_isa_gathers_fast(sim->isa),
                                  .looks_far = hs_machine_looks_far(),
                                  .table = &sim->pair_table[part]};
    return job;
}

void hs_sim_find_tail(hs_sim *sim)
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

static void clear_share(double *values, int64_t n)
{
    int64_t begin, end;
    hs_thread_range(n, 1, hs_thread_number(), hs_thread_count(), &begin, &end);
    memset(values + begin, 0, (size_t)(end - begin) * sizeof *values);
}

/** Evaluations of flat systems leave the forces along z as they were: those of a fix at the step before, or anything when atoms were
 *  sorted or halo atoms came. */
static void clear_z_forces(hs_sim *sim)
{
    const hs_atoms *atoms = &sim->atoms;
    const int64_t n = (int64_t)atoms->n_local + atoms->n_halo;
    if (!sim->neighbor.is_flat) return;
    if (sim->env.is_planar && sim->flat_generation == atoms->generation && sim->n_flat >= n) return;
    HS_ON_THREADS(clear_share(atoms->f[2], n));
    sim->flat_generation = atoms->generation;
    sim->n_flat = n;
}

void hs_sim_await_halo(hs_sim *sim)
{
    if (!sim->halo.is_awaited) return;
    hs_halo_forward_wait(&sim->halo);
    hs_timer_add_comm(&sim->timer, HS_COMM_WAIT);
    hs_halo_forward_receive(&sim->halo, &sim->atoms);
    hs_timer_add_comm(&sim->timer, HS_COMM_UNPACK);
}

/* What an evaluation calls between its stages: hs_force_halo. */

static void await_halo(void *context)
{
    hs_sim *sim = context;
    if (!sim->halo.is_awaited) return;
    hs_timer_add(&sim->timer, HS_PHASE_PAIR);
    hs_sim_await_halo(sim);
}

static void send_halo(void *context)
{
    hs_sim *sim = context;
    if (sim->halo.reverse.n == 0) return;
    hs_timer_add(&sim->timer, HS_PHASE_PAIR);
    hs_halo_reverse_send(&sim->halo, &sim->atoms);
    hs_timer_add_comm(&sim->timer, HS_COMM_PACK);
}

/** The last part of the pair style that exerts forces. */
static int last_part(const hs_pair *pair)
{
    int k = pair->n_parts - 1;
    while (pair->part[k]->style->evaluator == NULL) --k;
    return k;
}

/** Whether the distances of the job's pairs are wanted and can be counted with its forces. */
static bool counts_distances(const hs_sim *sim, const hs_force_job *job)
{
    return sim->env.pair_counter != NULL && hs_sim_method_in_use(sim) == HS_METHOD_CLUSTER &&
           hs_force_can_count(job, sim->env.pair_counter->r_max);
}

/** One evaluation for each part of the pair style, each added to the forces of those before. The first waits for the
 *  halo's positions, the last sends the forces on it. */
static hs_status add_parts(hs_sim *sim, bool with_energy, hs_force_result *sum, hs_error *err)
{
    hs_force_job job = hs_sim_make_job(sim, with_energy);
    const int last = last_part(sim->pair);
    const bool is_fixed = sim->kernel_precision == HS_PRECISION_FIXED;
    const hs_halo *copies = &sim->halo;
    hs_force_halo halo = {.await = await_halo, .context = sim, .is_remote = sim->halo.forward.n > 0};
    job.halo = &halo;
    memset(sum, 0, sizeof *sum);
    hs_force_job_set_grid(&job, sim->grid);
    if (is_fixed)
        HS_TRY(
            hs_force_find_open(&sim->forces, sim->atoms.n_local, copies->source, copies->out.n, copies->version, err));
    for (int k = 0; k < sim->pair->n_parts; ++k) {
        hs_force_result result;
        job.evaluator = sim->pair->part[k]->style->evaluator;
        job.input.table = &sim->pair_table[k];
        if (job.evaluator == NULL) continue;
        if (k == last) halo.send = send_halo;
        if (k == last && is_fixed) job.settling_unit = ldexp(1.0, sim->grid.force);
        job.counter = !job.is_added && counts_distances(sim, &job) ? sim->env.pair_counter : NULL;
        HS_TRY(hs_sim_method(sim)->forces(sim, &job, &result, err));
        if (job.counter != NULL) job.counter->is_filled = true;
        job.is_added = true;
        hs_force_result_add(sum, &result);
    }
    return HS_OK;
}

static void take_halo_forces(hs_sim *sim, bool is_fixed)
{
    hs_halo_reverse_own(&sim->halo, &sim->atoms, is_fixed);
    hs_timer_add_comm(&sim->timer, HS_COMM_PACK);
    if (sim->halo.reverse.n == 0) return;
    hs_halo_reverse_wait(&sim->halo);
    hs_timer_add_comm(&sim->timer, HS_COMM_WAIT);
    hs_halo_reverse_receive(&sim->halo, &sim->atoms, is_fixed);
    hs_timer_add_comm(&sim->timer, HS_COMM_UNPACK);
}

/** Evaluate all parts; in fixed point again on a coarser grid when a force was too large for it. */
static hs_status evaluate(hs_sim *sim, bool with_energy, hs_force_result *result, hs_error *err)
{
    const bool is_fixed = sim->kernel_precision == HS_PRECISION_FIXED;
    clear_z_forces(sim);
    if (is_fixed) hs_sim_begin_grid(sim);
    for (bool fits = false; !fits;) {
        HS_TRY(add_parts(sim, with_energy, result, err));
        fits = true;
        const hs_status status = is_fixed ? hs_sim_fit_grid(sim, result, &fits, err) : HS_OK;
        if (status != HS_OK || !fits) hs_halo_reverse_wait(&sim->halo); /* what is under way is of no use */
        HS_TRY(status);
    }
    hs_timer_add(&sim->timer, HS_PHASE_PAIR);
    take_halo_forces(sim, is_fixed);
    if (!is_fixed) return HS_OK;
    hs_force_settle(&sim->forces, &sim->atoms, sim->isa, sim->grid.force, sim->neighbor.is_flat);
    hs_timer_add(&sim->timer, HS_PHASE_PAIR);
    return HS_OK;
}

/** Energy and virial over all ranks: sums[7] (collective). */
static void sum_energy(const hs_sim *sim, const hs_force_result *result, double sums[7])
{
    hs_exact_sum exact[7] = {{.n_added = 0}};
    for (int k = 0; k < 7; ++k) {
        hs_exact_add(&exact[k], k == 0 ? result->energy : result->virial[k - 1]);
        hs_exact_add_scaled(&exact[k], k == 0 ? result->energy_fixed : result->virial_fixed[k - 1], sim->grid.energy);
    }
    hs_exact_total(exact, 7, &sim->parallel, sums);
}

hs_status hs_sim_pair_forces(hs_sim *sim, bool with_energy, hs_error *err)
{
    hs_env *env = &sim->env;
    hs_force_result result = {0};
    sim->has_moved = false;
    env->peak_force = env->peak_energy = 0.0;
    hs_shared_fields_clear(&sim->atoms, env->torque, 3); /* to which fixes add after the forces */
    if (!hs_pair_has_forces(sim->pair) || sim->pair->cutoff_max <= 0.0) {
        hs_sim_await_halo(sim);
        clear_forces(&sim->atoms);
    } else {
        HS_TRY(evaluate(sim, with_energy, &result, err));
    }
    if (!with_energy) return HS_OK;
    double sums[7];
    sum_energy(sim, &result, sums);
    hs_timer_add_comm(&sim->timer, HS_COMM_AGREE);
    env->pair_energy = sums[0];
    memcpy(env->pair_virial, sums + 1, sizeof env->pair_virial);
    env->energy_step = env->step;
    hs_sim_find_tail(sim);
    return HS_OK;
}
