/* halfshell(1): the man page, in troff, from the same tables as the manual. */
#include <stdio.h>

#include "base/memory.h"
#include "cli/catalog.h"
#include "cli/cli.h"

/** Text as troff takes it: backslashes and leading dots quoted, hyphens as minus signs, Markdown's backquotes
 *  dropped. */
static void put(FILE *stream, const char *text)
{
    if (text[0] == '.' || text[0] == '\'') fputs("\\&", stream);
    for (; *text != '\0'; ++text)
        if (*text == '\\')
            fputs("\\e", stream);
        else if (*text == '-')
            fputs("\\-", stream);
        else if (*text != '`')
            fputc(*text, stream);
}

static void put_bold_line(FILE *stream, const char *text)
{
    fputs("\\fB", stream);
    put(stream, text);
    fputs("\\fR", stream);
}

static void put_option(FILE *stream, const hs_cli_option *option)
{
    fputs(".TP\n", stream);
    put_bold_line(stream, option->name);
    if (option->alias != NULL) {
        fputs(", ", stream);
        put_bold_line(stream, option->alias);
    }
    fputs(" \\fI", stream);
    put(stream, option->values);
    fputs("\\fR\n", stream);
    put(stream, option->help);
    fputs(".\n", stream);
}

static void put_synopsis(FILE *stream)
{
    fputs(".SH SYNOPSIS\n.nf\n", stream);
    for (const hs_cli_command *command = hs_cli_commands; command->name != NULL; ++command) {
        put_bold_line(stream, "halfshell");
        fputc(' ', stream);
        put(stream, command->bit == HS_CLI_RUN ? "[run]" : command->name);
        fputc(' ', stream);
        put(stream, command->usage);
        fputc('\n', stream);
    }
    fputs(".fi\n", stream);
}

static void put_subcommands(FILE *stream)
{
    for (const hs_cli_command *command = hs_cli_commands; command->name != NULL; ++command) {
        fputs(".SS halfshell ", stream);
        put(stream, command->name);
        fputc('\n', stream);
        put(stream, command->help);
        fputs(".\n", stream);
        for (const hs_cli_option *option = hs_cli_options; option->name != NULL; ++option)
            if (option->commands & command->bit) put_option(stream, option);
    }
}

static hs_status put_family(FILE *stream, const hs_catalog *family, hs_error *err)
{
    hs_catalog_entry *entries;
    int n;
    HS_TRY(hs_catalog_list(family, &entries, &n, err));
    fputs(".SS ", stream);
    put(stream, family->title);
    fputc('\n', stream);
    for (int i = 0; i < n; ++i) {
        fputs(".TP\n", stream);
        put_bold_line(stream, entries[i].about.name);
        fputc('\n', stream);
        put(stream, entries[i].about.summary);
        fputc('\n', stream);
    }
    HS_FREE(entries);
    return HS_OK;
}

hs_status hs_manpage_write(FILE *stream, hs_error *err)
{
    fprintf(stream,
            ".\\\" Made by script/manual from the descriptors in the sources: do not edit.\n"
            ".TH HALFSHELL 1 \"\" \"halfshell %s\" \"User Commands\"\n"
            ".SH NAME\nhalfshell \\- molecular dynamics of short\\-range particle systems from LAMMPS input decks\n",
            HALFSHELL_VERSION);
    put_synopsis(stream);
    fputs(".SH DESCRIPTION\n"
          "Halfshell reads a LAMMPS input deck, checks all of it, and runs it on OpenMP threads.\n"
          "The thermo table goes to the screen and, with the deck's commands, to the log file.\n"
          ".PP\nThe values of \\-var end at the next option, so a deck named after them belongs before them or behind "
          "\\-in.\n"
          "Without a deck, and with standard input not a terminal, the deck is read from there.\n"
          ".SH COMMANDS AND OPTIONS\n",
          stream);
    put_subcommands(stream);
    fputs(".SH DECKS\nhalfshell help WORD explains one of these at length.\n", stream);
    for (const hs_catalog *family = hs_catalogs; family->name != NULL; ++family)
        HS_TRY(put_family(stream, family, err));
    fputs(".SH EXIT STATUS\n", stream);
    for (const char *const *row = hs_exit_code_meanings; *row != NULL; row += 2) {
        fprintf(stream, ".TP\n%s\n", row[0]);
        put(stream, row[1]);
        fputc('\n', stream);
    }
    fputs(".SH ENVIRONMENT\n.TP\n\\fBOMP_NUM_THREADS\\fR\nThreads of each rank where \\-threads does not say.\n"
          ".TP\n\\fBHALFSHELL_ISA\\fR\nInstruction set of the kernels where \\-isa does not say.\n"
          ".SH FILES\n.TP\n\\fIlog.halfshell\\fR\nThe log of a run, in the working directory.\n",
          stream);
    return HS_OK;
}
