/* Checkpoints in time: when they are due, which are kept, and stopping with one. */
#include "sim/saving.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "base/memory.h"
#include "base/text.h"
#include "base/timer.h"
#include "io/writer.h"

static const char default_pattern[] = "checkpoint.*.h5";
static const char automatic_pattern[] = "autosave.*.h5";

void hs_saving_fini(hs_saving *saving)
{
    if (saving == NULL) return;
    for (int k = 0; k < saving->n_recent; ++k) HS_FREE(saving->recent[k]);
    HS_FREE(saving->recent);
    for (int k = 0; k < 4; ++k) HS_FREE(saving->restart[k / 2].file[k % 2]);
    HS_FREE(saving->pattern);
    HS_FREE(saving->last_path);
}

void hs_saving_be_automatic(hs_saving *saving, double every_s)
{
    saving->is_automatic = every_s > 0.0;
    saving->every_s = every_s;
    saving->keep = 1;
}

void hs_saving_be_asked(hs_saving *saving)
{
    if (!saving->is_automatic) return;
    saving->is_automatic = false;
    saving->every_s = 0.0;
    saving->keep = 0;
}

void hs_sim_remove_automatic(hs_sim *sim)
{
    hs_saving *saving = sim->saving;
    if (!saving->is_automatic) return;
    for (int k = 0; k < saving->n_recent; ++k) {
        if (sim->parallel.rank == 0) unlink(saving->recent[k]);
        HS_FREE(saving->recent[k]);
    }
    saving->n_recent = 0;
}

/** The pattern that names of kept checkpoints follow now. */
static const char *pattern_of(const hs_saving *saving)
{
    if (saving->is_automatic) return automatic_pattern;
    return saving->pattern != NULL ? saving->pattern : default_pattern;
}

/** Whether a name is the pattern with a number in place of its star. */
static bool follows(const char *name, const char *pattern)
{
    const char *const star = strchr(pattern, '*');
    if (star == NULL) return strcmp(name, pattern) == 0;
    const size_t n_before = (size_t)(star - pattern), n_name = strlen(name), n_after = strlen(star + 1);
    if (n_name <= n_before + n_after || strncmp(name, pattern, n_before) != 0) return false;
    return strspn(name + n_before, "0123456789") == n_name - n_before - n_after &&
           strcmp(name + n_name - n_after, star + 1) == 0;
}

hs_status hs_saving_put_kept(const hs_saving *saving, const char *path, hs_state *state, hs_error *err)
{
    hs_text names = {0};
    hs_status status = HS_OK;
    for (int k = 0; k < saving->n_recent && status == HS_OK; ++k)
        if (strcmp(saving->recent[k], path) != 0) status = hs_text_printf(&names, err, "%s\n", saving->recent[k]);
    if (status == HS_OK && saving->is_writing_kept) status = hs_text_printf(&names, err, "%s\n", path);
    if (status == HS_OK) status = hs_state_text(state, "kept files", &names.data, err);
    hs_text_fini(&names);
    return status;
}

hs_status hs_saving_get_kept(hs_saving *saving, const char *path, hs_state *state, hs_error *err)
{
    char *names = NULL, *rest = NULL;
    if (hs_state_find(state, "kept files") == NULL) return HS_OK; /* an older file */
    hs_status status = hs_state_text(state, "kept files", &names, err);
    const size_t n = names != NULL ? strlen(names) : 0, n_path = strlen(path);
    /* a file that was copied or moved is its owner's now, and so are those beside it */
    const bool is_in_place = n > n_path && strncmp(names + n - 1 - n_path, path, n_path) == 0 &&
                             (n == n_path + 1 || names[n - n_path - 2] == '\n');
    for (char *name = is_in_place ? strtok_r(names, "\n", &rest) : NULL; name != NULL && status == HS_OK;
         name = strtok_r(NULL, "\n", &rest)) {
        if (!follows(name, pattern_of(saving))) continue;
        status = HS_GROW(saving->recent, (size_t)saving->n_recent, (size_t)saving->n_recent + 1, err);
        if (status == HS_OK) status = hs_memory_strdup(&saving->recent[saving->n_recent++], name, err);
    }
    HS_FREE(names);
    return status;
}

void hs_saving_inherit(hs_saving *saving, hs_saving *from)
{
    if (from->is_automatic) {
        hs_saving_be_automatic(saving, from->every_s);
        saving->recent = from->recent;
        saving->n_recent = from->n_recent;
        saving->last_s = from->last_s;
        from->recent = NULL;
        from->n_recent = 0;
    }
    saving->on_stop = from->on_stop;
    saving->deadline_s = from->deadline_s;
    saving->write = from->write;
}

/** Time is over early enough to write a checkpoint. */
static bool is_late(const hs_saving *saving)
{
    const double margin_s = 2.0 * saving->cost_s + 1.0;
    return saving->deadline_s > 0.0 && hs_time_now_s() > saving->deadline_s - margin_s;
}

bool hs_sim_is_asked_to_stop(const hs_sim *sim)
{
    return (sim->stop_requested != NULL && *sim->stop_requested) || is_late(sim->saving);
}

static hs_status write_file(hs_sim *sim, const char *path, hs_error *err)
{
    hs_saving *saving = sim->saving;
    if (saving->write == NULL)
        return hs_fail(err, HS_ERROR_RUN, "a checkpoint can only be written by a simulation that a deck drives");
    const double start_s = hs_time_now_s();
    HS_TRY(hs_sim_finish_step(sim, err));
    HS_TRY(saving->write(sim->env.deck, path, err));
    saving->last_s = hs_time_now_s();
    saving->cost_s = saving->last_s - start_s;
    saving->last_step = sim->env.step;
    return hs_memory_replace(&saving->last_path, path, err);
}

/** Remember a checkpoint, and delete those that are more than wanted. */
static hs_status keep(hs_sim *sim, const char *path, hs_error *err)
{
    hs_saving *saving = sim->saving;
    for (int k = 0; k < saving->n_recent; ++k)
        if (strcmp(saving->recent[k], path) == 0) return HS_OK;
    HS_TRY(HS_GROW(saving->recent, (size_t)saving->n_recent, (size_t)saving->n_recent + 1, err));
    HS_TRY(hs_memory_strdup(&saving->recent[saving->n_recent], path, err));
    ++saving->n_recent;
    while (saving->keep > 0 && saving->n_recent > saving->keep) {
        if (sim->parallel.rank == 0) unlink(saving->recent[0]);
        HS_FREE(saving->recent[0]);
        memmove(saving->recent, saving->recent + 1, sizeof *saving->recent * (size_t)--saving->n_recent);
    }
    return HS_OK;
}

/** One of the files that are kept. */
static hs_status save(hs_sim *sim, char **path, hs_error *err)
{
    HS_TRY(hs_writer_step_name(path, pattern_of(sim->saving), sim->env.step, 0, err));
    sim->saving->is_writing_kept = true;
    const hs_status status = write_file(sim, *path, err);
    sim->saving->is_writing_kept = false;
    HS_TRY(status);
    return keep(sim, *path, err);
}

hs_status hs_sim_save_now(hs_sim *sim, char **path, hs_error *err)
{
    if (!sim->saving->is_automatic) return save(sim, path, err);
    HS_TRY(hs_writer_step_name(path, default_pattern, sim->env.step, 0, err));
    HS_TRY(write_file(sim, *path, err));
    hs_sim_remove_automatic(sim); /* this one, of which the user hears, is newer */
    return HS_OK;
}

/** A checkpoint that nobody asked for must do no harm. */
static void save_automatically(hs_sim *sim)
{
    hs_error err = {0};
    char *path = NULL;
    if (save(sim, &path, &err) != HS_OK) {
        hs_warn(sim->env.out, "%s; the run goes on without automatic checkpoints", err.text);
        hs_saving_be_asked(sim->saving);
    }
    HS_FREE(path);
}

/** Whether a checkpoint by wall time is due. Rank 0's clock decides, and is asked every few steps only. */
static bool is_due_by_time(hs_sim *sim)
{
    hs_saving *saving = sim->saving;
    const int steps_between = saving->is_automatic ? 64 : 8;
    if (saving->every_s <= 0.0 || (sim->parallel.n_ranks > 1 && sim->env.step % steps_between != 0)) return false;
    const double now_s = sim->timer.last_s; /* the end of the step */
    if (saving->last_s == 0.0) saving->last_s = now_s;
    bool is_due = now_s - saving->last_s >= saving->every_s;
    hs_parallel_broadcast(&sim->parallel, 0, &is_due, sizeof is_due);
    return is_due;
}

static bool is_checkpoint_due(hs_sim *sim)
{
    const hs_saving *saving = sim->saving;
    return (saving->every_steps > 0 && sim->env.step % saving->every_steps == 0) || is_due_by_time(sim);
}

static bool is_restart_due(const hs_sim *sim, int k)
{
    const int64_t every = sim->saving->restart[k].every;
    return every > 0 && sim->env.step % every == 0;
}

bool hs_sim_is_save_due(hs_sim *sim)
{
    return (!sim->saving->is_automatic && is_checkpoint_due(sim)) || is_restart_due(sim, 0) || is_restart_due(sim, 1);
}

static hs_status write_restart(hs_sim *sim, hs_restarts *restart, hs_error *err)
{
    char *path = NULL;
    const int turn = restart->turn;
    if (restart->file[1] != NULL) restart->turn = 1 - turn;
    hs_status status = hs_writer_step_name(&path, restart->file[turn], sim->env.step, 0, err);
    if (status == HS_OK) status = write_file(sim, path, err);
    HS_FREE(path);
    return status;
}

hs_status hs_sim_save_if_due(hs_sim *sim, hs_error *err)
{
    hs_saving *saving = sim->saving;
    char *path = NULL;
    hs_status status = HS_OK;
    const bool is_due = is_checkpoint_due(sim);
    if (is_due && saving->is_automatic)
        save_automatically(sim);
    else if (is_due)
        status = hs_sim_save_now(sim, &path, err);
    HS_FREE(path);
    HS_TRY(status);
    for (int k = 0; k < 2; ++k)
        if (is_restart_due(sim, k)) HS_TRY(write_restart(sim, &saving->restart[k], err));
    return HS_OK;
}

hs_status hs_sim_stop(hs_sim *sim, const char *where, hs_error *err)
{
    const bool by_signal = sim->stop_requested != NULL && *sim->stop_requested;
    const char *const cause = by_signal              ? "by a signal"
                              : is_late(sim->saving) ? "because the time of -walltime is over"
                                                     : "by a signal to another rank";
    char *path = NULL;
    if (!sim->saving->on_stop || !sim->box.exists)
        return hs_fail(err, HS_INTERRUPTED, "stopped %s %s", by_signal ? cause : "", where);
    const hs_status status = hs_sim_save_now(sim, &path, err);
    if (status == HS_OK)
        (void)hs_fail(err, HS_INTERRUPTED, "stopped %s %s; 'halfshell resume %s' goes on from there", cause, where,
                      path);
    HS_FREE(path);
    return status == HS_OK ? HS_INTERRUPTED : status;
}
