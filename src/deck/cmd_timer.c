/* Command timer: how LAMMPS times its phases. */
#include <string.h>

#include "deck/command.h"

static const hs_keyword keywords[] = {
    {"off", 0, "", "levels of detail: accepted"},
    {"loop", 0, "", "the same"},
    {"normal", 0, "", "the same"},
    {"full", 0, "", "the same"},
    {"sync", 0, "", "whether ranks wait: accepted"},
    {"nosync", 0, "", "the same"},
    {"timeout", 1, "<time>|off", "no limit of time: only off"},
    {"every", 1, "<N>", "accepted"},
    {0},
};

static hs_status check(const hs_args *args, bool has_variables, hs_error *err)
{
    for (int i = 0; i + 1 < args->n; ++i) {
        int64_t every;
        if (has_variables) return HS_OK;
        if (strcmp(args->word[i], "every") == 0) HS_TRY(hs_arg_int(args, i + 1, 1, INT64_MAX, &every, err));
        if (strcmp(args->word[i], "timeout") == 0 && strcmp(args->word[i + 1], "off") != 0)
            return hs_arg_refuse(
                args, i + 1,
                "off: to end runs by wall time take 'fix halt ... tlimit', or the option -walltime, which "
                "writes a checkpoint",
                NULL, err);
    }
    return HS_OK;
}

static hs_status run(hs_deck *deck, const hs_args *args, hs_error *err)
{
    HS_TRY(check(args, false, err));
    hs_say(deck->out, "The command timer has no effect: Halfshell always times its phases\n");
    return HS_OK;
}

const hs_command hs_commands_timer[] = {
    {.about = {.name = "timer",
               .syntax = {.usage = "<keyword> ...", .n_min = 0, .n_max = 0, .keywords = keywords},
               .summary = "Detail of LAMMPS's timing table, accepted without effect",
               .details = "Halfshell times its phases at every run, which costs nothing that could be measured. A "
                          "limit of wall time (`timeout 1:00:00`) is refused: `fix halt ... tlimit` ends runs by it, "
                          "and the option `-walltime` stops with a checkpoint.",
               .example = "timer full"},
     .run = run,
     .check = check},
    {.run = NULL},
};
