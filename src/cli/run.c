/* halfshell run: a deck from its first line to its last, or to its first error. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/machine.h"
#include "base/memory.h"
#include "base/text.h"
#include "base/timer.h"
#include "cli/cli.h"
#include "io/files.h"
#include "sim/saving.h"

enum { SECONDS_A_MINUTE = 60, SECONDS_AN_HOUR = 3600 };

/** Open the file of -log or -screen on rank 0; "none" and other ranks give NULL. */
static hs_status open_output(const hs_cli *cli, const char *option, const char *name, const char *deck, FILE **stream,
                             hs_error *err)
{
    *stream = NULL;
    if (strcmp(name, "none") == 0) return HS_OK;
    if (hs_file_is_same(cli->parallel, name, deck))
        return hs_fail(err, HS_ERROR_INPUT, "%s: '%s' is the deck itself, which would be overwritten", option, name);
    if (cli->parallel->rank == 0) {
        *stream = fopen(name, "w");
        if (*stream == NULL)
            (void)hs_fail(err, HS_ERROR_IO, "%s: cannot write '%s': %s", option, name, strerror(errno));
    }
    return hs_parallel_agree(cli->parallel, err);
}

hs_status hs_cli_flush(FILE *stream, const char *what, hs_error *err)
{
    if (stream == NULL) return HS_OK;
    const bool is_flushed = fflush(stream) == 0;
    if (is_flushed && !ferror(stream)) return HS_OK;
    return hs_fail(err, HS_ERROR_IO, "the %s could not be written in full%s%s", what, is_flushed ? "" : ": ",
                   is_flushed ? "" : strerror(errno)); /* an earlier write failed, and errno is of something else */
}

static void say_wall_time(hs_sink *out, double start_s)
{
    long seconds = (long)(hs_time_now_s() - start_s);
    hs_say(out, "Total wall time: %ld:%02ld:%02ld\n", seconds / SECONDS_AN_HOUR,
           seconds % SECONDS_AN_HOUR / SECONDS_A_MINUTE, seconds % SECONDS_A_MINUTE);
}

static void greet(const hs_cli *cli, const hs_cli_settings *settings, hs_sink *out)
{
    int n_threads = hs_threads_get();
    hs_say(out, "Halfshell %s, %d rank%s of %d thread%s\n", HALFSHELL_VERSION, cli->parallel->n_ranks,
           cli->parallel->n_ranks == 1 ? "" : "s", n_threads, n_threads == 1 ? "" : "s");
    char machine[256];
    hs_machine_describe(machine, sizeof machine);
    hs_say_log(out, "Running on %s\n", machine);
    if (cli->parallel->n_ranks > 1 && n_threads > hs_threads_available())
        hs_warn(out,
                "the %d threads of a rank have %d core%s together: mpirun has bound them; 'mpirun --bind-to none' or "
                "'--map-by slot:PE=%d' gives each its own",
                n_threads, hs_threads_available(), hs_threads_available() == 1 ? "" : "s", n_threads);
    if (cli->parallel->n_ranks == 1 && n_threads > hs_threads_available())
        hs_warn(out, "%d threads take turns on %d core%s, which costs time: '-threads %d' gives each its own",
                n_threads, hs_threads_available(), hs_threads_available() == 1 ? "" : "s", hs_threads_available());
    if (settings->options.n_threads > n_threads)
        hs_warn(out, "OpenMP gives a rank %d thread%s, not the %d of -threads: see OMP_THREAD_LIMIT", n_threads,
                n_threads == 1 ? "" : "s", settings->options.n_threads);
    for (int i = 0; i < HS_CLI_NO_EFFECT_MAX && settings->no_effect[i] != NULL; ++i)
        hs_say(out, "The option %s has no effect: Halfshell chooses its own kernels\n", settings->no_effect[i]);
}

void hs_cli_prepare_stop(const hs_cli *cli, const hs_cli_settings *settings, hs_deck *deck)
{
    deck->sim->stop_requested = cli->stop_requested;
    deck->sim->saving->on_stop = true;
    const char *const autosave = getenv("HALFSHELL_AUTOSAVE");
    double minutes = 15.0;
    if (autosave == NULL || hs_text_to_double(autosave, &minutes))
        hs_saving_be_automatic(deck->sim->saving, minutes * SECONDS_A_MINUTE);
    if (settings->walltime_s > 0.0) deck->sim->saving->deadline_s = hs_time_now_s() + settings->walltime_s;
}

/** First pass over the deck, before anything is written: a deck that is refused leaves the last run's log in place. */
static hs_status prepare(const hs_cli *cli, const hs_cli_settings *settings, hs_deck *deck, hs_error *err)
{
    deck->echo_screen = settings->echo_screen;
    deck->echo_log = settings->echo_log;
    hs_cli_prepare_stop(cli, settings, deck);
    HS_TRY(hs_cli_set_variables(cli, HS_CLI_RUN, deck, err));
    HS_TRY(hs_deck_check(deck, settings->deck, err));
    const char *const log = settings->log != NULL ? settings->log : "log.halfshell";
    HS_TRY(open_output(cli, "-log", log, settings->deck, &deck->log_opened, err));
    HS_TRY(hs_memory_strdup(&deck->log_name, log, err));
    deck->out->log = deck->log_opened; /* the deck closes it, and the deck's own `log` may replace it */
    greet(cli, settings, deck->out);
    return HS_OK;
}

/** Run the deck. On return *exit_code is the deck's own (quit N). */
static hs_status run_deck(const hs_cli *cli, const hs_cli_settings *settings, hs_sink *out, int *exit_code,
                          hs_error *err)
{
    const double start_s = hs_time_now_s();
    hs_deck *deck = NULL;
    HS_TRY(hs_deck_create(&deck, &settings->options, out, err));
    hs_status status = prepare(cli, settings, deck, err);
    if (status == HS_OK) status = hs_deck_run(deck, settings->deck, err);
    if (status == HS_OK) {
        *exit_code = deck->exit_code;
        hs_sim_remove_automatic(deck->sim);
    }
    hs_progress_wipe(out);
    if (status != HS_OK)
        hs_say_log(out, "%s%s (%s:%ld)\n", status == HS_INTERRUPTED ? "" : "ERROR: ", err->text,
                   err->file[0] != '\0' ? err->file : settings->deck, err->line);
    else
        say_wall_time(out, start_s);
    if (status == HS_OK) status = hs_cli_flush(out->log, "log file", err);
    hs_deck_destroy(&deck);
    return status;
}

hs_status hs_cli_run(const hs_cli *cli, int *exit_code, hs_error *err)
{
    hs_cli_settings settings;
    HS_TRY(hs_cli_parse(cli, HS_CLI_RUN, &settings, err));
    if (settings.deck == NULL) {
        if (isatty(STDIN_FILENO))
            return hs_fail(err, HS_ERROR_INPUT,
                           "no deck given; usage: halfshell DECK [options], see: halfshell --help");
        settings.deck = "-";
    }
    FILE *file = NULL;
    HS_TRY(open_output(cli, "-screen", settings.screen != NULL ? settings.screen : "none", settings.deck, &file, err));
    hs_sink out = {.screen = settings.screen != NULL    ? file
                             : cli->parallel->rank == 0 ? stdout
                                                        : NULL,
                   .no_progress = cli->parallel->is_launched};
    hs_threads_set(settings.options.n_threads);
    if (cli->parallel->n_ranks == 1) hs_threads_bind();
    hs_status status = run_deck(cli, &settings, &out, exit_code, err);
    if (status == HS_OK) status = hs_cli_flush(file, "screen output", err);
    if (file != NULL) fclose(file);
    return status;
}
