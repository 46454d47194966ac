/* halfshell resume: go on from a checkpoint to the end of the deck that wrote it. */
#include <errno.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "cli/cli.h"
#include "deck/frames.h"
#include "sim/saving.h"

/** The log goes on where it was: in the file of -log, or in the one that the checkpoint names. */
static hs_status open_log(hs_deck *deck, hs_error *err)
{
    if (deck->log_name == NULL || strcmp(deck->log_name, "none") == 0) return HS_OK;
    if (deck->sim->parallel.rank == 0) {
        deck->log_opened = fopen(deck->log_name, "a");
        if (deck->log_opened == NULL)
            (void)hs_fail(err, HS_ERROR_IO, "the log '%.400s' cannot be written: %s", deck->log_name, strerror(errno));
        deck->out->log = deck->log_opened;
    }
    return hs_parallel_agree(&deck->sim->parallel, err);
}

static hs_status resume(const hs_cli *cli, const hs_cli_settings *settings, hs_deck *deck, int *exit_code,
                        hs_error *err)
{
    hs_cli_prepare_stop(cli, settings, deck);
    deck->at_resumed = open_log;
    if (settings->log != NULL) HS_TRY(hs_memory_strdup(&deck->log_name, settings->log, err));
    HS_TRY(hs_deck_resume(deck, settings->deck, err));
    *exit_code = deck->exit_code;
    hs_sim_remove_automatic(deck->sim);
    return hs_cli_flush(deck->out->log, "log file", err);
}

hs_status hs_cli_resume(const hs_cli *cli, int *exit_code, hs_error *err)
{
    hs_cli_settings settings;
    HS_TRY(hs_cli_parse(cli, HS_CLI_RESUME, &settings, err));
    if (settings.deck == NULL)
        return hs_fail(err, HS_ERROR_INPUT, "no checkpoint given; usage: halfshell resume [options] FILE");
    hs_sink out = {.screen = cli->parallel->rank == 0 ? stdout : NULL};
    hs_deck *deck = NULL;
    hs_threads_set(settings.options.n_threads);
    if (cli->parallel->n_ranks == 1) hs_threads_bind();
    HS_TRY(hs_deck_create(&deck, &settings.options, &out, err));
    hs_status status = resume(cli, &settings, deck, exit_code, err);
    hs_progress_wipe(&out);
    if (status != HS_OK) hs_say_log(&out, "%s%s\n", status == HS_INTERRUPTED ? "" : "ERROR: ", err->text);
    hs_deck_destroy(&deck);
    return status;
}
