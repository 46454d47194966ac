/* The timestep. */
#include "kernel/pair_histogram.h"
#include "sim/methods.h"

/** One hook of all fixes, in the deck's order. */
#define CALL_FIXES(sim, hook, err)                                                                                     \
    do {                                                                                                               \
        hs_env_changed(&(sim)->env);                                                                                   \
        for (int k_ = 0; k_ < (sim)->n_fixes; ++k_)                                                                    \
            if ((sim)->fix[k_]->style->hook != NULL) HS_TRY((sim)->fix[k_]->style->hook((sim)->fix[k_], (err)));       \
    } while (0)

/** Whether a fix wants new lists at this step. */
static bool is_wanted(const hs_sim *sim)
{
    for (int k = 0; k < sim->n_fixes; ++k) {
        const hs_fix *fix = sim->fix[k];
        if (fix->style->next_exchange != NULL && fix->style->next_exchange(fix) == sim->env.step) return true;
    }
    return false;
}

/** New cells, halo and lists when they are due; else only new positions of halo atoms, which may still be under way
 *  when this returns. */
static hs_status bring_neighbors_up_to_date(hs_sim *sim, hs_error *err)
{
    bool is_due;
    sim->is_stopping = hs_sim_is_asked_to_stop(sim);
    const hs_displacements moved =
        hs_neighbor_settle(&sim->neighbor, &sim->atoms, sim->env.position_magic, sim->box.dimension == 2,
                           sim->env.is_planar, hs_isa_settle(sim->isa));
    hs_timer_add(&sim->timer, HS_PHASE_NEIGH);
    HS_TRY(hs_neighbor_is_due(&sim->neighbor, &sim->atoms, &sim->box, &moved, &sim->parallel, sim->env.step, &is_due,
                              &sim->is_stopping, err));
    if (sim->parallel.n_ranks > 1) hs_timer_add_comm(&sim->timer, HS_COMM_AGREE);
    is_due = is_due || is_wanted(sim);
    sim->env.has_new_lists = is_due;
    if (is_due) {
        ++sim->neighbor.counters.n_builds;
        hs_tuner_at_build(sim);
    }
    const hs_method *method = hs_sim_method(sim);
    if (is_due) return hs_sim_exchange(sim, err);
    if (sim->pair->cutoff_max <= 0.0) return HS_OK;
    hs_halo_fit_box(&sim->halo, &sim->box);
    hs_halo_forward_send(&sim->halo, &sim->atoms);
    hs_timer_add_comm(&sim->timer, HS_COMM_PACK);
    if (method->update == NULL) return HS_OK;
    hs_sim_await_halo(sim);
    HS_TRY(method->update(sim, err));
    hs_timer_add(&sim->timer, HS_PHASE_NEIGH);
    return HS_OK;
}

hs_status hs_sim_move_forces(hs_sim *sim, hs_error *err)
{
    sim->env.with_energy = true;
    hs_timer_mark(&sim->timer);
    HS_TRY(bring_neighbors_up_to_date(sim, err));
    HS_TRY(hs_sim_pair_forces(sim, true, err));
    hs_timer_mark(&sim->timer);
    HS_TRY(hs_sim_post_force(sim, err));
    hs_timer_add(&sim->timer, HS_PHASE_MODIFY);
    return HS_OK;
}

/** The long-range corrections are those of the box that a fix leaves, as in LAMMPS. */
static hs_status end_step(hs_sim *sim, hs_error *err)
{
    hs_env_changed(&sim->env);
    for (int k = 0; k < sim->n_fixes; ++k) {
        hs_fix *fix = sim->fix[k];
        if (fix->style->end_of_step == NULL) continue;
        const uint64_t before = sim->env.revision;
        HS_TRY(fix->style->end_of_step(fix, err));
        sim->has_moved |= fix->style->moves_at_end && sim->env.revision != before;
        if (fix->style->changes_box) hs_sim_find_tail(sim);
    }
    return HS_OK;
}

/** The fix whose two halves can be joined: the only one that integrates, where none acts between the halves. */
static hs_fix *joining_fix(const hs_sim *sim)
{
    hs_fix *joining = NULL;
    for (int k = 0; k < sim->n_fixes; ++k) {
        const hs_fix_style *style = sim->fix[k]->style;
        if (style->end_of_step != NULL) return NULL;
        if (style->initial_integrate == NULL && style->final_integrate == NULL) continue;
        if (style->join_integrate == NULL || joining != NULL) return NULL;
        if (sim->fix[k]->mask & sim->groups.dynamic) return NULL; /* other members for the other half */
        joining = sim->fix[k];
    }
    return joining;
}

/** The first half of a step, and with it what the step before has left. */
static hs_status begin_motion(hs_sim *sim, hs_error *err)
{
    hs_fix *unfinished = sim->unfinished;
    sim->unfinished = NULL;
    if (unfinished == NULL)
        CALL_FIXES(sim, initial_integrate, err);
    else
        HS_TRY(unfinished->style->join_integrate(unfinished, err));
    hs_env_changed(&sim->env);
    return HS_OK;
}

hs_status hs_sim_finish_step(hs_sim *sim, hs_error *err)
{
    hs_fix *unfinished = sim->unfinished;
    sim->unfinished = NULL;
    if (unfinished == NULL) return HS_OK;
    HS_TRY(unfinished->style->final_integrate(unfinished, err));
    hs_env_changed(&sim->env);
    return HS_OK;
}

hs_status hs_sim_step(hs_sim *sim, bool with_energy, bool is_seen, hs_error *err)
{
    ++sim->env.step;
    sim->env.with_energy = with_energy;
    hs_sim_forget_force_places(sim);
    hs_timer_mark(&sim->timer);
    HS_TRY(begin_motion(sim, err));
    CALL_FIXES(sim, post_integrate, err);
    HS_TRY(hs_sim_pre_force(sim, false, err));
    hs_timer_add(&sim->timer, HS_PHASE_MODIFY);

    HS_TRY(bring_neighbors_up_to_date(sim, err));

    HS_TRY(hs_sim_pair_forces(sim, with_energy, err));

    /* what a fix computes in one of these hooks is void in the next; a fix that changes atoms in end_of_step says so */
    HS_TRY(hs_sim_post_force(sim, err));
    sim->unfinished = is_seen ? NULL : joining_fix(sim);
    if (sim->unfinished == NULL) CALL_FIXES(sim, final_integrate, err);
    /* positions are still those of the forces, until a fix says otherwise */
    if (sim->env.pair_counter != NULL) hs_pair_counter_hold(sim->env.pair_counter, sim->env.revision + 1);
    hs_sim_keep_force_places(sim);
    HS_TRY(end_step(sim, err));
    hs_timer_add(&sim->timer, HS_PHASE_MODIFY);
    return HS_OK;
}
