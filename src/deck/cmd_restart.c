/* Commands of checkpoints: restart, write_restart, read_restart, checkpoint. */
#include <string.h>

#include "base/memory.h"
#include "deck/command.h"
#include "deck/frames.h"
#include "io/files.h"
#include "io/writer.h"
#include "sim/saving.h"

bool hs_deck_ends_check(hs_deck *deck, const char *command, const char *path)
{
    if (!deck->options.dry_run || !deck->is_unwritten) return false;
    if (hs_file_is_readable(&deck->sim->parallel, path)) return false;
    hs_warn(deck->out,
            "%s: '%s' is not there; unless the deck itself writes it before, the run will end here. What follows is "
            "not checked",
            command, path);
    deck->quit = true;
    return true;
}

static hs_status set_text(char **target, const char *value, hs_error *err)
{
    HS_FREE(*target);
    return hs_memory_strdup(target, value, err);
}

/** One file holds all ranks' atoms: LAMMPS's % makes no sense here. */
static hs_status refuse_percent(const hs_args *args, int i, hs_error *err)
{
    if (strchr(args->word[i], '%') == NULL) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "%s: '%s': one file is written, for any number of ranks; leave out the '%%'",
                   args->command, args->word[i]);
}

/* ---- restart, write_restart, read_restart ---- */

static hs_status restart_check(const hs_args *args, bool has_variables, hs_error *err)
{
    int64_t every;
    if (has_variables) return HS_OK;
    HS_TRY(hs_arg_int(args, 0, 0, INT64_MAX, &every, err));
    if (every > 0) HS_TRY(hs_arg_need(args, 1, "the name of a file", err));
    for (int i = 1; i < args->n; ++i) HS_TRY(refuse_percent(args, i, err));
    return HS_OK;
}

static hs_status restart_run(hs_deck *deck, const hs_args *args, hs_error *err)
{
    hs_saving *saving = deck->sim->saving;
    hs_restarts *restart = &saving->restart[args->n == 3];
    hs_text name = {0};
    int64_t every;
    HS_TRY(restart_check(args, false, err));
    HS_TRY(hs_arg_int(args, 0, 0, INT64_MAX, &every, err));
    hs_saving_be_asked(saving);
    if (every > 0) deck->is_unwritten = true;
    if (every == 0) saving->restart[0].every = saving->restart[1].every = 0;
    restart->every = every;
    restart->turn = 0;
    for (int i = 1; i < args->n; ++i) HS_TRY(set_text(&restart->file[i - 1], args->word[i], err));
    if (args->n != 2 || strchr(args->word[1], '*') != NULL) return HS_OK;
    hs_status status = hs_text_printf(&name, err, "%s.*", args->word[1]); /* as in LAMMPS */
    if (status == HS_OK) status = set_text(&restart->file[0], hs_text_get(&name), err);
    hs_text_fini(&name);
    return status;
}

static hs_status write_restart_check(const hs_args *args, bool has_variables, hs_error *err)
{
    (void)has_variables;
    return refuse_percent(args, 0, err);
}

static hs_status write_restart_run(hs_deck *deck, const hs_args *args, hs_error *err)
{
    char *path;
    HS_TRY(hs_sim_need_box(deck->sim, args->command, err));
    deck->is_unwritten = true;
    if (deck->options.dry_run) return HS_OK;
    HS_TRY(hs_writer_step_name(&path, args->word[0], deck->sim->env.step, 0, err));
    const hs_status status = hs_deck_save(deck, path, err);
    HS_FREE(path);
    return status;
}

static hs_status read_restart_run(hs_deck *deck, const hs_args *args, hs_error *err)
{
    if (deck->sim->box.exists)
        return hs_fail(err, HS_ERROR_INPUT, "%s: there is a box already; 'clear' forgets it", args->command);
    if (hs_deck_ends_check(deck, args->command, args->word[0])) return HS_OK;
    return hs_deck_read_restart(deck, args->word[0], err);
}

/* ---- checkpoint ---- */

static hs_status read_checkpoint(const hs_args *args, hs_saving *saving, hs_error *err)
{
    static const char *const units[] = {"steps", "minutes", NULL};
    int unit;
    double every;
    HS_TRY(hs_arg_need(args, 2, "'steps' or 'minutes' after the number", err));
    HS_TRY(hs_arg_choice(args, 2, units, &unit, err));
    saving->every_steps = 0;
    saving->every_s = 0.0;
    saving->keep = 2;
    if (unit == 0) {
        HS_TRY(hs_arg_int(args, 1, 1, INT64_MAX, &saving->every_steps, err));
    } else {
        HS_TRY(hs_arg_positive(args, 1, &every, err));
        saving->every_s = 60.0 * every;
    }
    for (int i = 3; i + 1 < args->n; i += 2) {
        if (strcmp(args->word[i], "keep") == 0) {
            HS_TRY(hs_arg_int(args, i + 1, 1, 1000000, &saving->keep, err));
        } else {
            HS_TRY(refuse_percent(args, i + 1, err));
            HS_TRY(set_text(&saving->pattern, args->word[i + 1], err));
        }
    }
    return HS_OK;
}

static hs_status checkpoint_check(const hs_args *args, bool has_variables, hs_error *err)
{
    static const char *const words[] = {"every", "off", NULL};
    int choice;
    hs_saving ignored = {0};
    if (has_variables) return HS_OK;
    HS_TRY(hs_arg_choice(args, 0, words, &choice, err));
    if (choice == 1) return args->n == 1 ? HS_OK : hs_arg_refuse(args, 1, "allowed after 'off'", NULL, err);
    const hs_status status = read_checkpoint(args, &ignored, err);
    hs_saving_fini(&ignored);
    return status;
}

static hs_status checkpoint_run(hs_deck *deck, const hs_args *args, hs_error *err)
{
    hs_saving *saving = deck->sim->saving;
    HS_TRY(checkpoint_check(args, false, err));
    hs_saving_be_asked(saving);
    if (strcmp(args->word[0], "every") == 0) return read_checkpoint(args, saving, err);
    saving->every_steps = 0;
    saving->every_s = 0.0;
    return HS_OK;
}

static const hs_keyword checkpoint_keywords[] = {
    {"keep", 1, "<K>", "delete all but the last K of this run's checkpoints, resumed or not (default: 2)"},
    {"file", 1, "<output-file>", "name of the files; * becomes the step (default: checkpoint.*.h5)"},
    {0},
};

const hs_command hs_commands_restart[] = {
    {.about =
         {.name = "checkpoint",
          .syntax = {"every <N> steps|minutes [keyword value ...] | off", 1, 3, checkpoint_keywords},
          .summary = "Write checkpoints, from which an interrupted run goes on",
          .details =
              "After every N steps, or N minutes of wall time, all that decides the future goes into a file: "
              "atoms, box, fixes with their state, variables, random numbers, the schedule of neighbor lists, and "
              "the place in the deck. `halfshell resume FILE` goes on from there to the end of the deck. Files "
              "that dumps have added to since are cut back.\n\n"
              "A checkpoint appears whole or not at all: it is written beside its place, flushed to the disk and "
              "renamed. It is an HDF5 file with a checksum, which is tested before anything of it is used. "
              "SIGINT, SIGTERM, SIGHUP and the end of `-walltime` also write one, without this command too; so does a "
              "file that cannot be written, if there is a place for it.\n\n"
              "A deck with neither `checkpoint` nor `restart` has an automatic one, `autosave.STEP.h5`, every 15 "
              "minutes of wall time, each in place of the one before; it is removed at the end of the deck, also "
              "of one that `resume` has brought to its end. The environment variable HALFSHELL_AUTOSAVE is "
              "another number of minutes, 0 for none; `checkpoint off` also means none.",
          .example = "checkpoint every 10 minutes\ncheckpoint every 50000 steps keep 3 file run.*.chk\ncheckpoint off"},
     .run = checkpoint_run,
     .check = checkpoint_check},
    {.about = {.name = "restart",
               .syntax = {"<N> <output-file> [<output-file>] | 0", 1, 3, NULL},
               .summary = "Write checkpoints every N steps, by LAMMPS's word",
               .details = "A `*` in the name becomes the step; without one, `.*` is added. With two names the files "
                          "take turns. A command with one name and a command with two hold side by side; 0 ends both. "
                          "The files are those of `checkpoint`; LAMMPS cannot read them.",
               .example = "restart 1000 run.restart\nrestart 500 a.restart b.restart\nrestart 0"},
     .run = restart_run,
     .check = restart_check},
    {.about = {.name = "write_restart",
               .syntax = {"<output-file>", 1, 1, NULL},
               .summary = "Write a checkpoint now",
               .details = "A `*` in the name becomes the step. `read_restart` reads it, and `halfshell resume` goes on "
                          "with the deck's next command.",
               .example = "write_restart equilibrated.h5"},
     .run = write_restart_run,
     .check = write_restart_check},
    {.about = {.name = "read_restart",
               .syntax = {"<file>", 1, 1, NULL},
               .summary = "Start from a checkpoint in another deck",
               .details = "Takes over units, dimension, boundary, atom style, box, atoms, masses, groups, pair style "
                          "and its coefficients, step, timestep and simulated time. Fixes, computes, regions, neighbor "
                          "and output settings are the new deck's; a fix or compute of the same ID and style as one of "
                          "the old deck's goes on from its state (averages, thermostats, starting places of `msd`), as "
                          "far as its words allow, and this is told when the run begins. To go on with the same deck, "
                          "use `halfshell resume FILE` instead. Only files of this program can be read.",
               .example = "read_restart equilibrated.h5"},
     .run = read_restart_run},
    {.about = {.name = NULL}},
};
