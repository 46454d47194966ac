/* Commands of time: run, timestep, reset_timestep. */
#include <string.h>

#include "deck/command.h"
#include "deck/frames.h"
#include "sim/report.h"

/** Steps are counted well within 64 bits, so that sums of them never overflow. */
static const int64_t step_max = INT64_C(1) << 60;

/** The words of `run`. */
typedef struct run_words {
    int64_t n;
    bool is_upto;
    bool has_start, has_stop;
    int64_t start, stop;
    bool pre, post;
    int64_t every;          /**< 0: not given */
    int first_command, end; /**< words of the commands */
} run_words;

static hs_status read_every(const hs_args *args, int i, run_words *run, hs_error *err)
{
    HS_TRY(hs_arg_int(args, i + 1, 1, step_max, &run->every, err));
    HS_TRY(hs_arg_need(args, i + 2, "a command (or NULL) after 'every'", err));
    run->first_command = i + 2;
    run->end = args->n;
    if (strcmp(args->word[i + 2], "NULL") == 0) {
        if (i + 3 < args->n)
            return hs_arg_refuse(args, i + 3, "expected after NULL: 'every <M> NULL' must be the last words", NULL,
                                 err);
        run->end = run->first_command;
    }
    return HS_OK;
}

static hs_status read_run(const hs_args *args, run_words *run, hs_error *err)
{
    static const char *const keywords[] = {"upto", "start", "stop", "pre", "post", "every", NULL};
    *run = (run_words){.pre = true, .post = true};
    HS_TRY(hs_arg_int(args, 0, 0, step_max, &run->n, err));
    for (int i = 1; i < args->n; i += 2) {
        int keyword;
        HS_TRY(hs_arg_choice(args, i, keywords, &keyword, err));
        switch (keyword) {
        case 0:
            run->is_upto = true;
            --i;
            break;
        case 1:
            run->has_start = true;
            HS_TRY(hs_arg_int(args, i + 1, 0, step_max, &run->start, err));
            break;
        case 2:
            run->has_stop = true;
            HS_TRY(hs_arg_int(args, i + 1, 0, step_max, &run->stop, err));
            break;
        case 3:
            HS_TRY(hs_arg_bool(args, i + 1, &run->pre, err));
            break;
        case 4:
            HS_TRY(hs_arg_bool(args, i + 1, &run->post, err));
            break;
        default:
            return read_every(args, i, run, err);
        }
    }
    return HS_OK;
}

static hs_status run_check(const hs_args *args, bool has_variables, hs_error *err)
{
    run_words run;
    if (has_variables) {
        /* Only the commands of `every` may hold variables without making the words before them unsure. */
        int n = 0;
        while (n < args->n && strchr(args->word[n], '$') == NULL) ++n;
        for (int i = 1; i + 2 < n; ++i)
            if (strcmp(args->word[i], "every") == 0) return read_run(args, &run, err);
        return HS_OK;
    }
    return read_run(args, &run, err);
}

/** The run's words in steps. */
static hs_status plan_run(const hs_sim *sim, const run_words *run, hs_run_plan *plan, hs_error *err)
{
    const int64_t now = sim->env.step;
    if (run->is_upto && run->n < now)
        return hs_fail(err, HS_ERROR_INPUT, "run: 'upto %lld' is before the present step %lld", (long long)run->n,
                       (long long)now);
    if (run->n > step_max - now)
        return hs_fail(err, HS_ERROR_INPUT, "run: %lld steps from step %lld would go beyond step %lld",
                       (long long)run->n, (long long)now, (long long)step_max);
    *plan = (hs_run_plan){.n_steps = run->is_upto ? run->n - now : run->n, .pre = run->pre, .post = run->post};
    plan->start = run->has_start ? run->start : now;
    plan->stop = run->has_stop ? run->stop : now + plan->n_steps;
    if (plan->start > now)
        return hs_fail(err, HS_ERROR_INPUT, "run: 'start %lld' is after the run's first step %lld",
                       (long long)plan->start, (long long)now);
    if (plan->stop < now + plan->n_steps)
        return hs_fail(err, HS_ERROR_INPUT, "run: 'stop %lld' is before the run's last step %lld",
                       (long long)plan->stop, (long long)(now + plan->n_steps));
    return HS_OK;
}

/** halfshell check: set-up, so that what depends on values is checked too, and the step's number as if it had run. */
static hs_status pretend(hs_deck *deck, const hs_run_plan *plan, hs_error *err)
{
    hs_sim *sim = deck->sim;
    sim->env.first_step = sim->env.step;
    sim->env.last_step = sim->env.step + plan->n_steps;
    sim->env.ramp_start = plan->start;
    sim->env.ramp_stop = plan->stop;
    deck->is_running = true; /* set-up may ask for functions of time */
    const hs_status status = hs_sim_setup(sim, err);
    deck->is_running = false;
    HS_TRY(status);
    hs_report_setup(sim);
    hs_say(deck->out, "Run of %lld steps from step %lld, of %.15g time units each, with %lld atoms\n",
           (long long)plan->n_steps, (long long)sim->env.step, sim->env.dt, (long long)sim->atoms.n_all);
    sim->env.step += plan->n_steps;
    /* Later commands may ask for energies: those of the start stand for those of the end. */
    sim->env.energy_step = sim->env.step;
    return HS_OK;
}

/** The present part of the series; the last one always has its timing table, and the first one its set-up. */
static hs_status run_part(hs_deck *deck, const run_words *run, const hs_frame *frame, bool is_within, hs_error *err)
{
    hs_sim *sim = deck->sim;
    const bool is_last = frame->part == frame->left;
    hs_run_plan plan = {.n_steps = frame->part, .is_resumed = is_within};
    plan.pre = run->pre || (run->every > 0 && frame->is_first);
    plan.post = run->post || (run->every > 0 && is_last);
    plan.start = run->has_start ? run->start : sim->env.step;
    plan.stop = run->has_stop ? run->stop : sim->env.step + frame->part;
    if (deck->options.dry_run) return pretend(deck, &plan, err);
    deck->is_running = true;
    hs_status status = hs_sim_run(sim, &plan, err);
    deck->is_running = false;
    return status;
}

static hs_status run_parts(hs_deck *deck, const run_words *run, hs_frame *frame, bool is_within, hs_error *err)
{
    const bool is_cut = run->every > 0 && !deck->options.dry_run;
    for (;;) {
        if (!frame->is_in_commands) {
            if (!is_within) frame->part = is_cut && run->every < frame->left ? run->every : frame->left;
            HS_TRY(run_part(deck, run, frame, is_within, err));
            frame->is_in_commands = true;
            frame->next = run->first_command;
        }
        while (frame->next < run->end && !deck->quit)
            HS_TRY(hs_deck_command(deck, frame->words.word[frame->next++], err));
        frame->left -= frame->part;
        frame->is_first = frame->is_in_commands = is_within = false;
        if (frame->left <= 0 || deck->quit || deck->label_wanted != NULL) return HS_OK;
    }
}

hs_status hs_frame_run_run(hs_deck *deck, hs_frame *frame, bool is_within, hs_error *err)
{
    run_words run;
    HS_TRY(read_run(&frame->words, &run, err));
    if (frame->left < 0 || frame->part < 0 || frame->part > frame->left || frame->next < 0)
        return hs_fail(err, HS_ERROR_INPUT, "run: the place within it is none");
    hs_frame_push(deck, frame);
    const hs_status status = run_parts(deck, &run, frame, is_within, err);
    hs_frame_pop(deck);
    return status;
}

/** As LAMMPS does it, `every` makes a series of runs with the commands between them. */
static hs_status run_run(hs_deck *deck, const hs_args *args, hs_error *err)
{
    run_words run;
    hs_run_plan plan;
    HS_TRY(read_run(args, &run, err));
    HS_TRY(hs_sim_need_box(deck->sim, "run", err));
    HS_TRY(plan_run(deck->sim, &run, &plan, err));
    hs_frame frame = {.kind = HS_FRAME_RUN, .words = *args, .left = plan.n_steps, .is_first = true};
    return hs_frame_run_run(deck, &frame, false, err);
}

/* ---- timestep, reset_timestep ---- */

static hs_status timestep_check(const hs_args *args, bool has_variables, hs_error *err)
{
    double dt;
    return has_variables ? HS_OK : hs_arg_double(args, 0, &dt, err);
}

static hs_status timestep_run(hs_deck *deck, const hs_args *args, hs_error *err)
{
    double dt;
    HS_TRY(hs_arg_double(args, 0, &dt, err));
    hs_sim_set_clock(deck->sim, deck->sim->env.step, dt);
    return HS_OK;
}

static hs_status reset_check(const hs_args *args, bool has_variables, hs_error *err)
{
    int64_t step;
    return has_variables ? HS_OK : hs_arg_int(args, 0, 0, step_max, &step, err);
}

static hs_status reset_run(hs_deck *deck, const hs_args *args, hs_error *err)
{
    int64_t step;
    HS_TRY(hs_arg_int(args, 0, 0, step_max, &step, err));
    hs_sim *sim = deck->sim;
    HS_TRY(hs_sim_need_no_counters(sim, "reset_timestep", err));
    hs_sim_set_clock(sim, step, sim->env.dt);
    sim->env.first_step = sim->env.last_step = step;
    for (int i = 0; i < sim->n_dumps; ++i) sim->dump[i]->last_written = -1;
    return HS_OK;
}

static hs_status style_check(const hs_args *args, bool has_variables, hs_error *err)
{
    if (has_variables || strcmp(args->word[0], "verlet") == 0) return HS_OK;
    return hs_arg_refuse(args, 0, "verlet, the only way in which Halfshell makes timesteps", NULL, err);
}

static hs_status style_run(hs_deck *deck, const hs_args *args, hs_error *err)
{
    (void)deck;
    return style_check(args, false, err);
}

static const hs_keyword run_keywords[] = {
    {"upto", 0, "", "N is the step to run up to, not a number of steps"},
    {"start", 1, "<step>", "first step of the range over which `ramp` and the like change (default: this run's first)"},
    {"stop", 1, "<step>", "last step of that range (default: this run's last)"},
    {"pre", 1, "yes|no", "`no` skips the set-up of a run that goes on where the last one ended (default: yes)"},
    {"post", 1, "yes|no", "`no` leaves out the timing table (default: yes)"},
    {"every", -1, "<M> \"command\" ...",
     "carry out the commands after each M steps; `NULL` for none; must be the last keyword"},
    {0},
};

const hs_command hs_commands_run[] = {
    {
        .about =
            {
                .name = "run",
                .syntax = {"<N> [keyword value ...]", 1, 1, run_keywords},
                .summary = "Run N timesteps",
                .details = "With `every`, the run is cut into runs of M steps, each with its own table, and the "
                           "commands, each one quoted, are carried\nout after each. Everything behind `every M` is a "
                           "command. `quit` ends the run.\n",
                .example =
                    "run 1000\nrun 5000 upto\nrun 1000 start 0 stop 10000\nrun 1000 every 100 \"print 'T = $(temp)'\"",
            },
        .run = run_run,
        .check = run_check,
    },
    {
        .about =
            {
                .name = "timestep",
                .syntax = {"<dt>", 1, 1, NULL},
                .summary = "Length of a timestep",
                .details = "In time units. The default depends on `units`: 0.005 for lj, 1 fs for real, 0.001 ps for "
                           "metal. A negative step runs\nbackwards in time.\n",
                .example = "timestep 0.002",
            },
        .run = timestep_run,
        .check = timestep_check,
    },
    {
        .about =
            {
                .name = "reset_timestep",
                .syntax = {"<N>", 1, 1, NULL},
                .summary = "Set the number of the present timestep",
                .details = "The simulated time goes on as it is.\n",
                .example = "reset_timestep 0",
            },
        .run = reset_run,
        .check = reset_check,
    },
    {
        .about =
            {
                .name = "run_style",
                .syntax = {"verlet", 1, 1, NULL},
                .summary = "How timesteps are made: by velocity Verlet",
                .details = "Accepted for decks that say it; there is nothing to choose from.\n",
                .example = "run_style verlet",
            },
        .run = style_run,
        .check = style_check,
    },
    {.about = {.name = NULL}},
};
