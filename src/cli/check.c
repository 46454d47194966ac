/* halfshell check: the deck as far as it can be judged without a step and without writing a file. */
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "cli/cli.h"

hs_status hs_cli_check(const hs_cli *cli, hs_error *err)
{
    hs_cli_settings settings;
    HS_TRY(hs_cli_parse(cli, HS_CLI_CHECK, &settings, err));
    if (settings.deck == NULL) {
        if (isatty(STDIN_FILENO))
            return hs_fail(err, HS_ERROR_INPUT, "no deck given; usage: halfshell check [options] DECK");
        settings.deck = "-";
    }
    settings.options.dry_run = true;
    hs_sink out = {.screen = cli->parallel->rank == 0 ? stdout : NULL};
    hs_deck *deck = NULL;
    hs_status status = hs_deck_create(&deck, &settings.options, &out, err);
    if (status == HS_OK) {
        deck->sim->stop_requested = cli->stop_requested;
        deck->echo_log = deck->echo_screen = false;
        status = hs_cli_set_variables(cli, HS_CLI_CHECK, deck, err);
    }
    if (status == HS_OK) status = hs_deck_check(deck, settings.deck, err);
    if (status == HS_OK) status = hs_deck_run(deck, settings.deck, err);
    if (status == HS_OK) status = hs_cli_predict_ranks(deck, &settings, err);
    hs_deck_destroy(&deck);
    if (status != HS_OK) return status;
    hs_say(&out, "%s: no errors found; no step was run and no file written\n",
           strcmp(settings.deck, "-") == 0 ? "standard input" : settings.deck);
    return HS_OK;
}
