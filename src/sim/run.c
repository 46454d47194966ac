/* A run: set-up, steps, output. */
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "sim/report.h"
#include "sim/restored.h"
#include "sim/saving.h"
#include "sim/sim.h"
#include "sim/thermo.h"
#include "sim/violation.h"
#include "style/varying.h"

/** Everything that must be right before atoms move. */
static hs_status check_system(hs_sim *sim, hs_error *err)
{
    HS_TRY(hs_sim_need_box(sim, "run", err));
    if (!hs_domain_is_divided(&sim->domain)) HS_TRY(hs_domain_divide(&sim->domain, &sim->box, err));
    HS_TRY(hs_sim_need_pair(sim, "run", err));
    HS_TRY(hs_sim_need_masses(sim, "run", err));
    if (sim->box.dimension == 2 && !sim->box.periodic[2])
        return hs_fail(err, HS_ERROR_INPUT, "run: a 2d simulation needs a periodic z boundary ('boundary p p p')");
    const hs_neighbor_settings *settings = &sim->neighbor.settings; /* perhaps from several commands */
    if (settings->delay > 0 && settings->delay % settings->every != 0)
        return hs_fail(err, HS_ERROR_INPUT, "neigh_modify: delay %lld is not a multiple of every %lld",
                       (long long)settings->delay, (long long)settings->every);
    return HS_OK;
}

/** Threads for the next run. Those of the environment are for all that is run there: where a rank has few atoms,
 *  threads would wait for each other longer than they work. What the options say is meant for this run. */
static void choose_threads(const hs_sim *sim)
{
    enum { FEW_ATOMS = 1000 };
    const int64_t n_ranks = sim->parallel.n_ranks > 1 ? sim->parallel.n_ranks : 1;
    const bool are_few = sim->atoms.n_all < FEW_ATOMS * n_ranks;
    hs_threads_set(sim->options.n_threads <= 0 && are_few ? 1 : sim->n_threads);
}

/** Who remembers something of each member cannot serve a group whose members change. */
static hs_status check_dynamic_groups(const hs_sim *sim, hs_error *err)
{
    const uint32_t dynamic = sim->groups.dynamic;
    const char *kind = NULL, *id = NULL, *style = NULL;
    int group = 0;
    for (int k = 0; k < sim->n_fixes && kind == NULL; ++k) {
        const hs_fix *fix = sim->fix[k];
        if (fix->style->allows_dynamic_group || !(fix->mask & dynamic)) continue;
        kind = "fix", id = fix->id, style = fix->style->about.name, group = fix->group;
    }
    for (int k = 0; k < sim->n_computes && kind == NULL; ++k) {
        const hs_compute *compute = sim->compute[k];
        if (!compute->style->needs_fixed_group || !(compute->mask & dynamic)) continue;
        kind = "compute", id = compute->id, style = compute->style->about.name, group = compute->group;
    }
    if (kind == NULL) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT,
                   "%s '%s' (%s) needs a group whose members stay, and '%s' is dynamic ('group %s static' ends that)",
                   kind, id, style, sim->groups.name[group], sim->groups.name[group]);
}

/** Fixes b > a that move atoms in common are nearly always a mistake: such atoms go twice as far in a step. LAMMPS warns,
 *  too. Collective. */
static void warn_of_two_integrators(hs_sim *sim)
{
    const hs_atoms *atoms = &sim->atoms;
    for (int b = 1; b < sim->n_fixes; ++b)
        for (int a = 0; a < b; ++a) {
            if (!sim->fix[a]->style->is_integrator || !sim->fix[b]->style->is_integrator) continue;
            int64_t n = 0;
            for (int i = 0; i < atoms->n_local; ++i)
                n += (atoms->mask[i] & sim->fix[a]->mask) && (atoms->mask[i] & sim->fix[b]->mask);
            hs_parallel_sum_int64(&sim->parallel, &n, 1);
            if (n > 0)
                hs_warn(sim->env.out,
                        "%s and %s both move atoms, %lld of them the same: these go twice as far in "
                        "a step; unfix one of the two",
                        hs_fix_who(sim->fix[a]).text, hs_fix_who(sim->fix[b]).text, (long long)n);
        }
}

static hs_status init_styles(hs_sim *sim, hs_error *err)
{
    int n_integrators = 0;
    HS_TRY(check_dynamic_groups(sim, err));
    for (int k = 0; k < sim->n_fixes; ++k) {
        if (sim->fix[k]->style->init != NULL) HS_TRY(sim->fix[k]->style->init(sim->fix[k], err));
        n_integrators += sim->fix[k]->style->is_integrator;
    }
    if (n_integrators == 0 && !sim->is_rerunning && !sim->is_minimizing)
        hs_warn(sim->env.out, "no fix moves the atoms: a time integrator such as 'fix nve' is missing");
    if (n_integrators > 1 && !sim->is_rerunning && !sim->is_minimizing) warn_of_two_integrators(sim);
    hs_env_changed(&sim->env);
    for (int k = 0; k < sim->n_computes; ++k) {
        if (sim->compute[k]->style->init != NULL) HS_TRY(sim->compute[k]->style->init(sim->compute[k], err));
    }
    HS_TRY(hs_restored_give_states(sim, err));
    for (int k = 0; k < sim->n_dumps; ++k)
        if (sim->dump[k]->style->init != NULL) HS_TRY(sim->dump[k]->style->init(sim->dump[k], err));
    return hs_thermo_init(sim->thermo, err);
}

hs_status hs_sim_init_resumed(hs_sim *sim, hs_error *err)
{
    HS_TRY(check_system(sim, err));
    choose_threads(sim);
    HS_TRY(hs_sim_setup_pair(sim, err));
    HS_TRY(hs_sim_setup_reproducible(sim, err));
    hs_tuner_start(sim);
    return init_styles(sim, err);
}

hs_status hs_sim_setup(hs_sim *sim, hs_error *err)
{
    HS_TRY(check_system(sim, err));
    sim->is_initialized =
        false; /* until the end of this: the exchange below may find atoms that were placed far away */
    hs_timer_reset(&sim->timer);
    choose_threads(sim);
    HS_TRY(hs_sim_setup_pair(sim, err));
    HS_TRY(hs_sim_setup_reproducible(sim, err));
    hs_tuner_start(sim);
    HS_TRY(init_styles(sim, err));
    return hs_sim_setup_forces(sim, err);
}

/** Atoms that are lost when the first lists are made are no part of the run: temperatures are to count anew. */
static void count_again_if_lost(hs_sim *sim)
{
    int64_t n = sim->atoms.n_local;
    hs_parallel_sum_int64(&sim->parallel, &n, 1);
    if (n == sim->atoms.n_all) return;
    for (int k = 0; hs_sim_temperature(sim, k) != NULL; ++k) hs_sim_temperature(sim, k)->n_dof = -1.0;
}

hs_status hs_sim_setup_forces(hs_sim *sim, hs_error *err)
{
    hs_neighbor_start(&sim->neighbor);
    hs_sim_forget_force_places(sim);
    HS_TRY(hs_sim_pre_force(sim, true, err));
    HS_TRY(hs_sim_exchange(sim, err));
    count_again_if_lost(sim);
    HS_TRY(hs_sim_pair_forces(sim, true, err));
    sim->env.with_energy = true;
    hs_env_changed(&sim->env);
    for (int k = 0; k < sim->n_fixes; ++k)
        if (sim->fix[k]->style->setup != NULL && (!sim->is_minimizing || sim->fix[k]->style->acts_in_minimize))
            HS_TRY(sim->fix[k]->style->setup(sim->fix[k], err));
    HS_TRY(hs_sim_post_force(sim, err));
    hs_env_changed(&sim->env);
    for (int k = 0; k < sim->n_computes; ++k)
        if (sim->compute[k]->style->setup != NULL) HS_TRY(sim->compute[k]->style->setup(sim->compute[k], err));
    for (int k = 0; k < sim->n_fixes; ++k)
        if (sim->fix[k]->style->measure_at_setup != NULL && !sim->is_minimizing)
            HS_TRY(sim->fix[k]->style->measure_at_setup(sim->fix[k], err));
    sim->is_initialized = true;
    return HS_OK;
}

/** Whether dump has a snapshot at this step; the first step of the dump's first run only when asked for (or a multiple). */
static bool is_dump_due(const hs_dump *dump, int64_t step, bool is_first)
{
    if (dump->last_written == step) return false;
    if (dump->every_variable != NULL && !is_first && step == dump->next_due) return true;
    if (dump->every_variable == NULL && dump->every > 0 && step % dump->every == 0) return true;
    return is_first && dump->write_first && dump->last_written < 0;
}

static hs_status write_dump(hs_sim *sim, hs_dump *dump, hs_error *err)
{
    const int64_t before = dump->last_written;
    const hs_status status = dump->style->write(dump, err);
    dump->last_written = status == HS_OK ? sim->env.step : before;
    return status;
}

hs_status hs_sim_write_all_dumps(hs_sim *sim, hs_error *err)
{
    for (int k = 0; k < sim->n_dumps; ++k)
        if (sim->dump[k]->last_written != sim->env.step) HS_TRY(write_dump(sim, sim->dump[k], err));
    return HS_OK;
}

static hs_status find_next(const hs_sim *sim, hs_dump *dump, hs_error *err)
{
    return hs_next_step(&sim->env, dump->every_variable, hs_dump_who(dump).text, "snapshot", &dump->next_due, err);
}

static hs_status write_dumps(hs_sim *sim, bool is_first, hs_error *err)
{
    for (int k = 0; k < sim->n_dumps; ++k) {
        hs_dump *dump = sim->dump[k];
        const bool is_due = is_dump_due(dump, sim->env.step, is_first);
        if (is_due) HS_TRY(write_dump(sim, dump, err));
        if (dump->every_variable != NULL && (is_due || is_first)) HS_TRY(find_next(sim, dump, err));
    }
    return HS_OK;
}

hs_status hs_sim_write_due(hs_sim *sim, bool is_first, hs_error *err)
{
    HS_TRY(write_dumps(sim, is_first, err));
    return is_first || hs_thermo_is_due(sim->thermo, sim->env.step) ? hs_thermo_row(sim->thermo, err) : HS_OK;
}

static bool is_output_due(const hs_sim *sim, int64_t step)
{
    if (hs_thermo_is_due(sim->thermo, step)) return true;
    for (int k = 0; k < sim->n_dumps; ++k)
        if (is_dump_due(sim->dump[k], step, false)) return true;
    return false;
}

/** Whether output or a fix will ask for the pair energy or virial of a step. */
static bool is_energy_due(const hs_sim *sim, int64_t step)
{
    for (int k = 0; k < sim->n_fixes; ++k)
        if (sim->fix[k]->style->needs_energy != NULL && sim->fix[k]->style->needs_energy(sim->fix[k], step))
            return true;
    return false;
}

/** Let computes know that fixes will ask for them at the end of a step. */
static void announce_samples(hs_sim *sim, int64_t step)
{
    sim->env.pair_counter = NULL;
    for (int k = 0; k < sim->n_fixes; ++k)
        if (sim->fix[k]->style->announce != NULL) sim->fix[k]->style->announce(sim->fix[k], step);
}

hs_status hs_sim_begin_output(hs_sim *sim, hs_error *err)
{
    hs_thermo_header(sim->thermo);
    HS_TRY(hs_sim_write_due(sim, true, err));
    hs_timer_reset(&sim->timer);
    return HS_OK;
}

/** A file could not be written, but the step is whole: a checkpoint, perhaps on another disk, loses nothing. */
static hs_status rescue(hs_sim *sim, hs_status status)
{
    hs_error ignored = {0};
    char *path = NULL;
    if (status != HS_ERROR_IO || !sim->saving->on_stop) return status;
    sim->is_output_due = true;
    if (hs_sim_save_now(sim, &path, &ignored) == HS_OK) sim->saving->is_rescued = true;
    sim->is_output_due = false;
    HS_FREE(path);
    return status;
}

static hs_status begin_run(hs_sim *sim, const hs_run_plan *plan, hs_error *err)
{
    if (plan->is_resumed) { /* all is as it was at this step, and its output is written */
        hs_thermo_header(sim->thermo);
        if (sim->is_output_due) HS_TRY(hs_sim_write_due(sim, sim->env.step == sim->env.first_step, err));
        sim->is_output_due = false;
        hs_timer_reset(&sim->timer);
        return HS_OK;
    }
    sim->n_minimized = 0;
    sim->env.first_step = sim->env.step;
    sim->env.last_step = sim->env.step + plan->n_steps;
    sim->env.is_cut_short = false;
    sim->env.ramp_start = plan->start;
    sim->env.ramp_stop = plan->stop;
    if (plan->pre || !sim->is_initialized) {
        HS_TRY(hs_sim_setup(sim, err));
        hs_report_setup(sim);
    } else {
        HS_TRY(init_styles(sim, err));
        hs_neighbor_continue(&sim->neighbor);
    }
    return rescue(sim, hs_sim_begin_output(sim, err));
}

static hs_status write_output(hs_sim *sim, hs_error *err)
{
    hs_timer_mark(&sim->timer);
    const hs_status status = hs_sim_write_due(sim, false, err);
    if (status != HS_OK) return rescue(sim, status);
    hs_timer_add(&sim->timer, HS_PHASE_OUTPUT);
    return HS_OK;
}

hs_status hs_sim_output_if_due(hs_sim *sim, bool is_last, hs_error *err)
{
    hs_timer_mark(&sim->timer);
    if (is_last || is_output_due(sim, sim->env.step)) HS_TRY(hs_sim_write_due(sim, false, err));
    hs_timer_add(&sim->timer, HS_PHASE_OUTPUT);
    return HS_OK;
}

static hs_status stop_if_asked(hs_sim *sim, hs_error *err)
{
    char where[64];
    if (sim->parallel.n_ranks > 1 ? !sim->is_stopping : !hs_sim_is_asked_to_stop(sim)) return HS_OK;
    snprintf(where, sizeof where, "after step %lld", (long long)sim->env.step);
    return hs_sim_stop(sim, where, err);
}

static hs_status run_steps(hs_sim *sim, hs_error *err)
{
    sim->env.is_planar = hs_sim_is_planar(sim);
    while (sim->env.step < sim->env.last_step) {
        const int64_t next = sim->env.step + 1;
        const bool is_due = next == sim->env.last_step || is_output_due(sim, next);
        announce_samples(sim, next);
        HS_TRY(hs_sim_step(sim, is_due || is_energy_due(sim, next), is_due, err));
        if (is_due) HS_TRY(write_output(sim, err));
        hs_report_progress(sim);
        HS_TRY(hs_sim_save_if_due(sim, err));
        HS_TRY(stop_if_asked(sim, err));
    }
    return HS_OK;
}

static void warn_of_late_lists(hs_sim *sim)
{
    const hs_neighbor *neighbor = &sim->neighbor;
    if (neighbor->counters.n_late_steps == 0 || neighbor->settings.exact || sim->pair->cutoff_max <= 0.0) return;
    hs_warn(sim->env.out,
            "on %lld steps (the first is %lld) atoms had moved more than half the skin before neigh_modify's schedule "
            "allowed new lists. As in LAMMPS, pairs that came within the cutoff meanwhile were not counted, and energy "
            "may drift. 'neigh_modify every 1 delay 0 check yes' or 'neighbor_method %s pairs exact' counts every pair",
            (long long)neighbor->counters.n_late_steps, (long long)neighbor->counters.first_late_step,
            hs_neighbor_methods[neighbor->settings.method]);
}

/** A run that failed leaves a picture of what went wrong, and can go on from the last checkpoint, perhaps with other
 *  settings. */
static hs_status tell_what_is_left(hs_sim *sim, hs_status status, hs_error *err)
{
    const hs_saving *saving = sim->saving;
    if (status == HS_ERROR_ATOMS) hs_sim_show_violation(sim, err);
    char *const end = err->text + strlen(err->text);
    const size_t n = sizeof err->text - strlen(err->text);
    const char *const path = saving->last_path;
    if (status == HS_INTERRUPTED || path == NULL) return status;
    if (saving->is_rescued)
        snprintf(end, n, ". Nothing is lost: '%s' is of this step, and 'halfshell resume %s' goes on from there", path,
                 path);
    else if (status == HS_ERROR_IO)
        snprintf(end, n, ". The last checkpoint is '%s', of step %lld: 'halfshell resume %s' goes on from there", path,
                 (long long)saving->last_step, path);
    else /* it would end in the same way */
        snprintf(end, n,
                 ". The last checkpoint is '%s', of step %lld: a deck with 'read_restart %s' goes on from there with "
                 "other settings",
                 path, (long long)saving->last_step, path);
    return status;
}

hs_status hs_sim_run(hs_sim *sim, const hs_run_plan *plan, hs_error *err)
{
    if (sim->env.is_halted && !plan->is_resumed) {
        hs_say(sim->env.out, "Skipped: a fix halt has ended the runs of this deck\n");
        return HS_OK;
    }
    hs_status status = begin_run(sim, plan, err);
    if (status != HS_OK && !sim->saving->is_rescued) return status;
    const double start_s = hs_time_now_s(), start_cpu_s = hs_time_cpu_s();
    if (status == HS_OK) status = run_steps(sim, err);
    const hs_status finished = hs_sim_finish_step(sim, err); /* however it has ended */
    status = status == HS_OK ? finished : status;
    sim->env.is_planar = false;
    hs_progress_wipe(sim->env.out);
    if (status != HS_OK) return tell_what_is_left(sim, status, err);
    for (int k = 0; k < sim->n_fixes; ++k)
        if (sim->fix[k]->style->end_of_run != NULL) HS_TRY(sim->fix[k]->style->end_of_run(sim->fix[k], err));
    const double loop_s = hs_time_now_s() - start_s;
    if (plan->post)
        hs_report_finish(sim, sim->env.step - sim->env.first_step, loop_s, hs_time_cpu_s() - start_cpu_s, NULL);
    else
        hs_report_loop(sim, sim->env.step - sim->env.first_step, loop_s);
    hs_thermo_say_means(sim->thermo);
    for (int k = 0; k < sim->n_fixes; ++k)
        if (sim->fix[k]->style->say_results != NULL) sim->fix[k]->style->say_results(sim->fix[k]);
    warn_of_late_lists(sim);
    return HS_OK;
}
