#include "sim/rerun.h"

#include "base/timer.h"
#include "sim/report.h"
#include "sim/saving.h"
#include "sim/thermo.h"

/** A rerun on its way. */
typedef struct rerun {
    hs_sim *sim;
    const hs_rerun_plan *plan;
    hs_frames *frames;
    hs_snapshot snapshot; /**< the present one */
    int64_t n_done;       /**< snapshots taken */
    int64_t n_passed;     /**< snapshots since the last one taken that would have been, but for skip */
} rerun;

/** Whether the plan wants a snapshot that comes after those taken. */
static bool is_wanted(rerun *self)
{
    const hs_rerun_plan *plan = self->plan;
    const int64_t step = self->snapshot.step;
    if (step < plan->first) return false;
    if (self->n_done == 0) return true;
    if (step <= self->sim->env.step) return false; /* told already, at the end of the file before */
    if (plan->every > 0 && step % plan->every != 0) return false;
    return ++self->n_passed == plan->skip;
}

/** Go to the next snapshot that is wanted; *is_there = false when there is none. */
static hs_status find_next(rerun *self, bool *is_there, hs_error *err)
{
    do {
        HS_TRY(hs_frames_next(self->frames, &self->snapshot, is_there, err));
        if (*is_there && self->snapshot.step > self->plan->last) *is_there = false;
    } while (*is_there && !is_wanted(self));
    self->n_passed = 0;
    if (*is_there && self->snapshot.step > self->plan->stop)
        return hs_fail(err, HS_ERROR_INPUT, "rerun: the snapshot of step %lld is after 'stop %lld'",
                       (long long)self->snapshot.step, (long long)self->plan->stop);
    return HS_OK;
}

static hs_status take(rerun *self, hs_error *err)
{
    hs_sim *sim = self->sim;
    hs_read_counts counts;
    hs_sim_set_clock(sim, self->snapshot.step, sim->env.dt);
    HS_TRY(hs_read_snapshot(&sim->env, self->frames, &self->snapshot, &self->plan->read, &counts, err));
    hs_sim_atoms_changed(sim);
    ++self->n_done;
    return HS_OK;
}

/** There is no checkpoint within a rerun: it can be begun anew where it was stopped. */
static hs_status stop_if_asked(const rerun *self, hs_error *err)
{
    int64_t is_asked = hs_sim_is_asked_to_stop(self->sim);
    hs_parallel_max_int64(&self->sim->parallel, &is_asked, 1);
    if (!is_asked) return HS_OK;
    return hs_fail(err, HS_INTERRUPTED,
                   "rerun: stopped after the snapshot of step %lld; 'first %lld' goes on from there",
                   (long long)self->snapshot.step, (long long)self->snapshot.step + 1);
}

/** The first snapshot: as at the start of a run. */
static hs_status begin(rerun *self, hs_error *err)
{
    hs_sim *sim = self->sim;
    bool is_there;
    HS_TRY(find_next(self, &is_there, err));
    if (!is_there)
        return hs_fail(err, HS_ERROR_INPUT, "rerun: the files have no snapshot from step %lld on that 'last' allows",
                       (long long)self->plan->first);
    sim->env.first_step = self->plan->first;
    sim->env.last_step = self->plan->last;
    sim->env.ramp_start = self->plan->start;
    sim->env.ramp_stop = self->plan->stop;
    HS_TRY(take(self, err));
    HS_TRY(hs_sim_setup(sim, err));
    hs_report_setup(sim);
    hs_thermo_header(sim->thermo);
    return hs_sim_write_due(sim, true, err);
}

static hs_status go_through(rerun *self, hs_error *err)
{
    hs_sim *sim = self->sim;
    bool is_there = true;
    HS_TRY(begin(self, err));
    for (;;) {
        HS_TRY(stop_if_asked(self, err));
        HS_TRY(find_next(self, &is_there, err));
        if (!is_there) break;
        HS_TRY(take(self, err));
        HS_TRY(hs_sim_setup_forces(sim, err));
        HS_TRY(hs_sim_write_due(sim, false, err));
        if (sim->env.last_step < INT64_MAX / 8) hs_report_progress(sim); /* else nobody knows how many there are */
    }
    const bool has_row = self->n_done == 1 || hs_thermo_is_due(sim->thermo, sim->env.step);
    return has_row ? HS_OK
                   : hs_thermo_row(sim->thermo, err); /* the last snapshot has one, as the last step of a run has */
}

hs_status hs_sim_rerun(hs_sim *sim, const hs_rerun_plan *plan, hs_error *err)
{
    rerun self = {.sim = sim, .plan = plan};
    const double start_s = hs_time_now_s(), start_cpu_s = hs_time_cpu_s();
    if (sim->saving->restart[0].every > 0 || sim->saving->restart[1].every > 0 || sim->saving->every_steps > 0 ||
        sim->saving->every_s > 0.0)
        hs_warn(sim->env.out, "rerun writes no checkpoints: it can be begun anew at any snapshot (keyword first)");
    HS_TRY(hs_frames_open(&self.frames, &plan->read.plan, &sim->parallel, err));
    sim->is_rerunning = true;
    const hs_status status = go_through(&self, err);
    sim->is_rerunning = false;
    hs_frames_close(&self.frames);
    hs_progress_wipe(sim->env.out);
    HS_TRY(status);
    sim->env.first_step = sim->env.last_step = sim->env.ramp_start = sim->env.ramp_stop = sim->env.step;
    const double loop_s = hs_time_now_s() - start_s;
    if (plan->post)
        hs_report_finish(sim, self.n_done, loop_s, hs_time_cpu_s() - start_cpu_s, NULL);
    else
        hs_report_loop(sim, self.n_done, loop_s);
    hs_thermo_say_means(sim->thermo);
    return HS_OK;
}
