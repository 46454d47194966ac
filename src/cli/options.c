#include <ctype.h>
#include <string.h>

#include "cli/cli.h"
#include "parallel/limits.h"

enum {
    RUN = HS_CLI_RUN,
    CHECK = HS_CLI_CHECK,
    BENCH = HS_CLI_BENCH,
    PLOT = HS_CLI_PLOT,
    REPORT = HS_CLI_REPORT,
    RESUME = HS_CLI_RESUME
};

const hs_cli_command hs_cli_commands[] = {
    {"run", "[options] DECK", HS_CLI_RUN, "run a deck; the word `run` may be left out"},
    {"resume", "[options] CHECKPOINT", HS_CLI_RESUME, "go on from a checkpoint to the end of the deck that wrote it"},
    {"check", "[options] DECK", HS_CLI_CHECK,
     "read and validate a deck, run no step, write no file, print what it would do"},
    {"bench", "[kernels|neighbors|scaling] [options]", HS_CLI_BENCH,
     "measure the speed of this machine on a Lennard-Jones liquid; with `kernels`, of the pair kernels alone; with "
     "`neighbors`, what each neighbor method costs; with `scaling`, what ranks and threads gain"},
    {"plot", "[options] FILE...", HS_CLI_PLOT,
     "draw logs, files that fixes write, and CSV as PNG, SVG or PDF (through gnuplot)"},
    {"report", "[options] RUN", HS_CLI_REPORT,
     "make one HTML page of a log, or of a folder with a run's outputs: deck, means and errors, plots, pictures"},
    {"help", "[WORD]", HS_CLI_HELP, "list what decks may contain; with a word, explain that command, style or keyword"},
    {NULL, NULL, 0, NULL},
};

const hs_cli_option hs_cli_options[] = {
    {"-in", "-i", "DECK", RUN | CHECK, "the deck to read; `-` is standard input"},
    {"-var", "-v", "NAME VALUE...", RUN | CHECK, "set a variable; wins over `variable NAME index` in the deck"},
    {"-log", "-l", "FILE|none", RUN | RESUME,
     "log file (default: log.halfshell; of `resume`: the run's own, added to)"},
    {"-walltime", NULL, "HH:MM:SS", RUN | RESUME,
     "stop with a checkpoint (exit code 3) before so much wall time has passed"},
    {"-screen", "-sc", "FILE|none", RUN, "write to a file what goes to the screen, or nowhere"},
    {"-echo", "-e", "none|screen|log|both", RUN, "where commands are echoed as they are read (default: log)"},
    {"-threads", "-t", "N", RUN | RESUME | CHECK,
     "OpenMP threads of each rank (default: OMP_NUM_THREADS, but 1 for fewer than 1000 atoms a rank, else 1)"},
    {"-neigh", NULL, "METHOD", RUN | RESUME | CHECK, "neighbor method; wins over the deck's neighbor_method"},
    {"-precision", NULL, "double|mixed", RUN | RESUME | CHECK | BENCH,
     "precision of the pair forces; wins over the deck's `precision`"},
    {"-reproducible", NULL, "on|off", RUN | RESUME | CHECK | BENCH,
     "same bits on any threads and ranks (default: on in double precision); wins over the deck's `reproducible`"},
    {"-isa", NULL, "NAME", RUN | RESUME | CHECK | BENCH,
     "instruction set of the kernels (default: auto, the widest of this machine)"},
    {"-ranks", NULL, "LIST", CHECK,
     "predict memory, halo, messages and speed for these numbers of ranks, as in 1,64,4096"},
    {"-speed", NULL, "X", CHECK,
     "million atom-steps/s of one core for that prediction, as `halfshell bench` tells (default: 9)"},
    {"-latency", NULL, "X", CHECK,
     "microseconds that a message takes, for that prediction (default: 2, shared memory)"},
    {"-bandwidth", NULL, "X", CHECK, "GB/s that a rank sends, for that prediction (default: 5, shared memory)"},
    {"-suffix", "-sf", "STYLE", RUN | CHECK, "accepted for LAMMPS's sake; has no effect"},
    {"-package", "-pk", "WORD...", RUN | CHECK, "accepted for LAMMPS's sake; has no effect"},
    {"-size", NULL, "N", BENCH, "cells of four atoms along each edge of the box (default: 20, which is 32,000 atoms)"},
    {"-steps", NULL, "N", BENCH, "timesteps of one measurement (default: 100)"},
    {"-repeat", NULL, "N", BENCH, "measurements of each case, of which the fastest counts (default: 3)"},
    {"-threads", "-t", "LIST", BENCH, "thread counts, as in 1,2,4 (default: 1 and all cores)"},
    {"-ranks", NULL, "LIST", BENCH,
     "of `bench scaling`: numbers of ranks, which it starts through mpirun (default: 1, 2, 4 ... and all cores)"},
    {"-neigh", NULL, "LIST", BENCH, "neighbor methods, as in cell,nsq (default: the fast ones)"},
    {"-only", NULL, "LIST", BENCH,
     "of `bench neighbors`, only these: size, density, emptiness, temperature, order, cells"},
    {"-out", "-o", "FOLDER", BENCH,
     "where `bench kernels` and `bench neighbors` (default: nowhere) and `bench scaling` (default: scaling) write CSV "
     "files and pictures"},
    {"-out", "-o", "FILE", PLOT,
     "the picture; its name ends in .png, .svg or .pdf (default: the first file's name and .png)"},
    {"-out", "-o", "FILE", REPORT, "the page (default: the run's name and .html)"},
    {"-x", NULL, "COLUMN", PLOT,
     "column of the horizontal axis, by name or number; `time`: steps times the timestep (default: time, step, "
     "distance, whichever the file has)"},
    {"-y", NULL, "LIST", PLOT,
     "columns to draw, by name, number, or a pattern with * and ?, as in Temp,E_* (default: all that change)"},
    {"-errors", NULL, "LIST|none", PLOT,
     "columns of standard errors, one for each drawn column (default: found by name, as in Temp_err)"},
    {"-block", NULL, "all|first|last|N", PLOT,
     "of a file with several tables, which: of a log the run (default: all), else the step (default: last)"},
    {"-deck", NULL, "FILE", PLOT, "deck or log that says units, timestep, and what c_ID is (a log says it of itself)"},
    {"-units", NULL, "NAME", PLOT, "unit system of the numbers, where no deck says it"},
    {"-logscale", NULL, "x|y|xy|none", PLOT, "logarithmic axes (default: none)"},
    {"-xrange", NULL, "LO:HI", PLOT, "part of the horizontal axis"},
    {"-yrange", NULL, "LO:HI", PLOT, "part of the vertical axes"},
    {"-style", NULL, "lines|points|both", PLOT, "how curves are drawn (default: lines; both where there are errors)"},
    {"-title", NULL, "TEXT", PLOT, "text above the picture"},
    {"-legend", NULL, "LIST", PLOT, "names of the files in the legend (default: their file names)"},
    {"-xlabel", NULL, "TEXT", PLOT, "label of the horizontal axis (default: quantity and unit)"},
    {"-ylabel", NULL, "TEXT", PLOT, "label of the vertical axis, where there is one (default: quantity and unit)"},
    {"-size", NULL, "WxH", PLOT, "pixels (default: 900 wide, high enough for one panel for each quantity)"},
    {NULL, NULL, NULL, 0, NULL},
};

hs_status hs_cli_find_option(const char *word, unsigned command, const hs_cli_option **option, hs_error *err)
{
    const char *names[64];
    size_t n = 0;
    for (*option = hs_cli_options; (*option)->name != NULL; ++*option) {
        if (((*option)->commands & command) == 0) continue;
        if (strcmp((*option)->name, word) == 0 || ((*option)->alias != NULL && strcmp((*option)->alias, word) == 0))
            return HS_OK;
        if (n < sizeof names / sizeof names[0]) names[n++] = (*option)->name;
    }
    const char *plain = word + (strncmp(word, "--", 2) == 0); /* --threads is as near as it gets to -threads */
    const char *nearest = hs_text_nearest(plain, names, n);
    if (nearest != NULL) return hs_fail(err, HS_ERROR_INPUT, "unknown option '%s'; did you mean '%s'?", word, nearest);
    return hs_fail(err, HS_ERROR_INPUT, "unknown option '%s'; see: halfshell --help", word);
}

bool hs_cli_is_option(const char *word)
{
    return word[0] == '-' && (isalpha((unsigned char)word[1]) || word[1] == '-');
}

/** Index of the next word that starts an option, or cli->n: the end of the values that begin at @p from. */
static int values_end(const hs_cli *cli, int from)
{
    while (from < cli->n && !hs_cli_is_option(cli->word[from])) ++from;
    return from;
}

static hs_status parse_echo(const char *word, hs_cli_settings *settings, hs_error *err)
{
    static const char *const choices[] = {"none", "screen", "log", "both"};
    for (int i = 0; i < 4; ++i)
        if (strcmp(word, choices[i]) == 0) {
            settings->echo_screen = (i & 1) != 0;
            settings->echo_log = (i & 2) != 0;
            return HS_OK;
        }
    return hs_fail(err, HS_ERROR_INPUT, "-echo: '%s' is not one of none, screen, log, both", word);
}

static hs_status parse_method(const char *word, hs_cli_settings *settings, hs_error *err)
{
    size_t n = 0;
    while (hs_neighbor_methods[n] != NULL && strcmp(hs_neighbor_methods[n], word) != 0) ++n;
    if (hs_neighbor_methods[n] != NULL) {
        snprintf(settings->options.neighbor_method, sizeof settings->options.neighbor_method, "%s", word);
        return HS_OK;
    }
    const char *nearest = hs_text_nearest(word, hs_neighbor_methods, n);
    if (nearest != NULL)
        return hs_fail(err, HS_ERROR_INPUT, "-neigh: '%s' is not a neighbor method; did you mean '%s'?", word, nearest);
    return hs_fail(err, HS_ERROR_INPUT, "-neigh: '%s' is not a neighbor method; see: halfshell help neighbor", word);
}

hs_status hs_cli_parse_precision(const char *word, hs_options *options, hs_error *err)
{
    hs_precision precision;
    HS_TRY(hs_precision_get(word, &precision, err));
    snprintf(options->precision, sizeof options->precision, "%s", word);
    return HS_OK;
}

hs_status hs_cli_parse_reproducible(const char *word, hs_options *options, hs_error *err)
{
    if (strcmp(word, "on") != 0 && strcmp(word, "off") != 0)
        return hs_fail(err, HS_ERROR_INPUT, "-reproducible: '%s' is neither on nor off", word);
    options->reproducible = word[1] == 'n' ? HS_REPRODUCIBLE_ON : HS_REPRODUCIBLE_OFF;
    return HS_OK;
}

hs_status hs_cli_parse_isa(const char *word, hs_options *options, hs_error *err)
{
    hs_isa isa;
    HS_TRY(hs_isa_get(word, &isa, err));
    snprintf(options->isa, sizeof options->isa, "%s", word);
    return HS_OK;
}

static hs_status parse_threads(const char *word, hs_cli_settings *settings, hs_error *err)
{
    int64_t n;
    if (!hs_text_to_int64(word, &n) || n < 1 || n > HS_THREADS_MAX)
        return hs_fail(err, HS_ERROR_INPUT, "-threads: '%s' is not a whole number from 1 to %d", word, HS_THREADS_MAX);
    settings->options.n_threads = (int)n;
    return HS_OK;
}

/** HH:MM:SS, MM:SS or SS. */
static hs_status parse_walltime(const char *word, hs_cli_settings *settings, hs_error *err)
{
    double total = 0.0;
    char part[32];
    for (const char *at = word; at != NULL;) {
        const char *colon = strchr(at, ':');
        int64_t n;
        snprintf(part, sizeof part, "%.*s", colon != NULL ? (int)(colon - at) : 31, at);
        if (!hs_text_to_int64(part, &n) || n < 0 || n > 1000000 || (at != word && n > 59))
            return hs_fail(err, HS_ERROR_INPUT, "-walltime: '%s' is not a time like 12:30:00 (hours, minutes, seconds)",
                           word);
        total = 60.0 * total + (double)n;
        at = colon != NULL ? colon + 1 : NULL;
    }
    if (total <= 0.0) return hs_fail(err, HS_ERROR_INPUT, "-walltime: '%s' leaves no time", word);
    settings->walltime_s = total;
    return HS_OK;
}

/** 1,2,4: at most so many ranks that their grid can be looked for. */
static hs_status parse_ranks(const char *list, hs_cli_settings *settings, hs_error *err)
{
    char copy[512];
    if (snprintf(copy, sizeof copy, "%s", list) >= (int)sizeof copy)
        return hs_fail(err, HS_ERROR_INPUT, "-ranks: the list is too long");
    char *rest = copy;
    for (char *word = strsep(&rest, ","); word != NULL; word = strsep(&rest, ",")) {
        int64_t n;
        if (!hs_text_to_int64(word, &n) || n < 1 || n > 100000000)
            return hs_fail(err, HS_ERROR_INPUT, "-ranks: '%s' is not a whole number from 1 to 100000000", word);
        if (settings->n_rank_counts == HS_CLI_RANK_COUNTS_MAX)
            return hs_fail(err, HS_ERROR_INPUT, "-ranks: more than %d numbers", HS_CLI_RANK_COUNTS_MAX);
        settings->rank_counts[settings->n_rank_counts++] = (int)n;
    }
    return HS_OK;
}

static hs_status parse_positive(const char *option, const char *word, double *value, hs_error *err)
{
    if (hs_text_to_double(word, value) && *value > 0.0) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "%s: '%s' is not a number above 0", option, word);
}

static hs_status set_deck(const char *word, hs_cli_settings *settings, hs_error *err)
{
    if (settings->deck == NULL) {
        settings->deck = word;
        return HS_OK;
    }
    const char *names[32];
    size_t n = 0;
    for (const hs_cli_command *command = hs_cli_commands; command->name != NULL && n < 32; ++command)
        names[n++] = command->name;
    const char *nearest = hs_text_nearest(settings->deck, names, n);
    if (nearest != NULL)
        return hs_fail(err, HS_ERROR_INPUT, "'%s' and '%s' cannot both be the deck; did you mean the subcommand '%s'?",
                       settings->deck, word, nearest);
    return hs_fail(err, HS_ERROR_INPUT, "'%s' and '%s' cannot both be the deck; a run takes one", settings->deck, word);
}

/** One option whose values are words [first, end); *used tells how many of them it took. */
static hs_status parse_option(const hs_cli *cli, const hs_cli_option *option, int first, int *used,
                              hs_cli_settings *settings, hs_error *err)
{
    const char *value = cli->word[first];
    int end = values_end(cli, first + 1); /* a first value may begin with a minus sign */
    *used = 1;
    if (strcmp(option->name, "-in") == 0) return set_deck(value, settings, err);
    if (strcmp(option->name, "-log") == 0) return settings->log = value, HS_OK;
    if (strcmp(option->name, "-walltime") == 0) return parse_walltime(value, settings, err);
    if (strcmp(option->name, "-screen") == 0) return settings->screen = value, HS_OK;
    if (strcmp(option->name, "-echo") == 0) return parse_echo(value, settings, err);
    if (strcmp(option->name, "-threads") == 0) return parse_threads(value, settings, err);
    if (strcmp(option->name, "-neigh") == 0) return parse_method(value, settings, err);
    if (strcmp(option->name, "-precision") == 0) return hs_cli_parse_precision(value, &settings->options, err);
    if (strcmp(option->name, "-reproducible") == 0) return hs_cli_parse_reproducible(value, &settings->options, err);
    if (strcmp(option->name, "-isa") == 0) return hs_cli_parse_isa(value, &settings->options, err);
    if (strcmp(option->name, "-ranks") == 0) return parse_ranks(value, settings, err);
    if (strcmp(option->name, "-speed") == 0) return parse_positive("-speed", value, &settings->speed, err);
    if (strcmp(option->name, "-latency") == 0) return parse_positive("-latency", value, &settings->latency_us, err);
    if (strcmp(option->name, "-bandwidth") == 0) return parse_positive("-bandwidth", value, &settings->bandwidth, err);
    if (strcmp(option->name, "-var") == 0) {
        if (first + 1 >= cli->n) return hs_fail(err, HS_ERROR_INPUT, "-var %s: a value is missing", value);
        end = values_end(cli, first + 2);
        *used = end - first;
        settings->last_variable = *used > 2 ? value : NULL;
        settings->last_value = *used > 2 ? cli->word[end - 1] : NULL;
        return HS_OK;
    }
    int i = 0;
    while (i + 1 < HS_CLI_NO_EFFECT_MAX && settings->no_effect[i] != NULL && settings->no_effect[i] != option->name)
        ++i;
    settings->no_effect[i] = option->name;
    if (strcmp(option->name, "-package") == 0) *used = end - first;
    return HS_OK;
}

hs_status hs_cli_parse(const hs_cli *cli, unsigned command, hs_cli_settings *settings, hs_error *err)
{
    *settings = (hs_cli_settings){.echo_log = true, .speed = 9.0, .latency_us = 2.0, .bandwidth = 5.0};
    for (int i = 0; i < cli->n; ++i) {
        const char *word = cli->word[i];
        if (!hs_cli_is_option(word)) {
            HS_TRY(set_deck(word, settings, err));
            continue;
        }
        const hs_cli_option *option;
        HS_TRY(hs_cli_find_option(word, command, &option, err));
        if (i + 1 >= cli->n) return hs_fail(err, HS_ERROR_INPUT, "%s needs %s after it", word, option->values);
        int used;
        HS_TRY(parse_option(cli, option, i + 1, &used, settings, err));
        i += used;
    }
    if (settings->deck == NULL && settings->last_value != NULL)
        return hs_fail(err, HS_ERROR_INPUT,
                       "no deck: '%s' was taken as a value of '-var %s'; name the deck first, or with -in",
                       settings->last_value, settings->last_variable);
    return HS_OK;
}

hs_status hs_cli_set_variables(const hs_cli *cli, unsigned command, hs_deck *deck, hs_error *err)
{
    for (int i = 0; i < cli->n; ++i) {
        const hs_cli_option *option;
        if (!hs_cli_is_option(cli->word[i])) continue;
        HS_TRY(hs_cli_find_option(cli->word[i], command, &option, err));
        hs_cli_settings ignored = {0};
        int used;
        HS_TRY(parse_option(cli, option, i + 1, &used, &ignored, err));
        if (strcmp(option->name, "-var") == 0)
            HS_TRY(hs_deck_set_variable(deck, cli->word[i + 1], used - 1, (const char *const *)&cli->word[i + 2], err));
        i += used;
    }
    return HS_OK;
}
