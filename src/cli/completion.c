/* Completion for bash and zsh, from the option table and the catalogue. */
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "cli/catalog.h"
#include "cli/cli.h"
#include "kernel/kernel.h"

static hs_status put_names(FILE *stream, const hs_catalog *family, hs_error *err)
{
    hs_catalog_entry *entries;
    int n;
    HS_TRY(hs_catalog_list(family, &entries, &n, err));
    for (int i = 0; i < n; ++i) fprintf(stream, " %s", entries[i].about.name);
    HS_FREE(entries);
    return HS_OK;
}

static void put_subcommands(FILE *stream)
{
    for (const hs_cli_command *command = hs_cli_commands; command->name != NULL; ++command)
        fprintf(stream, "%s%s", command == hs_cli_commands ? "" : " ", command->name);
}

/** Shell variables with the words to offer, the same for both shells. */
static hs_status put_words(FILE *stream, hs_error *err)
{
    fputs("    local commands=\"", stream);
    put_subcommands(stream);
    fputs("\"\n", stream);
    for (const hs_cli_command *command = hs_cli_commands; command->name != NULL; ++command) {
        fprintf(stream, "    local options_%s=\"", command->name);
        for (const hs_cli_option *option = hs_cli_options; option->name != NULL; ++option)
            if (option->commands & command->bit) fprintf(stream, " %s", option->name);
        if (command->bit == HS_CLI_RUN) fputs(" --help --version", stream);
        fputs("\"\n", stream);
    }
    fputs("    local methods=\"", stream);
    for (const hs_catalog *family = hs_catalogs; family->name != NULL; ++family)
        if (strcmp(family->name, "neighbor") == 0) HS_TRY(put_names(stream, family, err));
    fputs("\"\n    local topics=\"command-line exit-codes", stream);
    for (const hs_catalog *family = hs_catalogs; family->name != NULL; ++family) {
        fprintf(stream, " %s", family->name);
        HS_TRY(put_names(stream, family, err));
    }
    fputs("\"\n", stream);
    return HS_OK;
}

/** Values that are words of a list, as in double|mixed: no file is meant there, and nothing else. */
static bool is_choice(const char *values)
{
    return strchr(values, '|') != NULL && strspn(values, "abcdefghijklmnopqrstuvwxyz|") == strlen(values);
}

/** Cases of the word before the one to complete, for both shells. */
static void put_choices(FILE *stream)
{
    for (const hs_cli_option *option = hs_cli_options; option->name != NULL; ++option) {
        const bool is_neigh = strcmp(option->name, "-neigh") == 0, is_isa = strcmp(option->name, "-isa") == 0;
        bool is_told = false;
        for (const hs_cli_option *other = hs_cli_options; other != option; ++other)
            is_told = is_told || strcmp(other->name, option->name) == 0;
        if (is_told || (!is_neigh && !is_isa && !is_choice(option->values))) continue;
        fprintf(stream, "    %s%s%s) is_file= offered=\"", option->name, option->alias != NULL ? " | " : "",
                option->alias != NULL ? option->alias : "");
        for (const char *c = is_neigh ? "$methods" : is_isa ? "auto" : option->values; *c != '\0'; ++c)
            fputc(*c == '|' ? ' ' : *c, stream);
        for (int isa = 0; is_isa && hs_isa_names[isa] != NULL; ++isa) fprintf(stream, " %s", hs_isa_names[isa]);
        fputs("\" ;;\n", stream);
    }
}

static const char bash_head[] =
    "    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} command=run offered= is_file=yes\n"
    "    case \" $commands \" in *\" ${COMP_WORDS[1]} \"*) [ \"$COMP_CWORD\" -gt 1 ] && command=${COMP_WORDS[1]} ;; "
    "esac\n"
    "    case $before in\n";
static const char bash_body[] = "    *)\n"
                                "        case $command in\n"
                                "        help) is_file= offered=$topics ;;\n"
                                "        *) offered=options_$command offered=${!offered} ;;\n"
                                "        esac\n"
                                "        [ \"$COMP_CWORD\" -eq 1 ] && offered=\"$offered $commands\"\n"
                                "        ;;\n"
                                "    esac\n"
                                "    COMPREPLY=($(compgen -W \"$offered\" -- \"$word\"))\n"
                                "    local IFS=$'\\n'\n" /* names may have blanks */
                                "    [ -z \"$is_file\" ] || COMPREPLY+=($(compgen -f -- \"$word\"))\n";

static const char zsh_head[] =
    "    local before=${words[CURRENT-1]} command=run offered= is_file=yes\n"
    "    case \" $commands \" in *\" ${words[2]} \"*) (( CURRENT > 2 )) && command=${words[2]} ;; esac\n"
    "    case $before in\n";
static const char zsh_body[] = "    *)\n"
                               "        case $command in\n"
                               "        help) is_file= offered=$topics ;;\n"
                               "        *) offered=options_$command offered=${(P)offered} ;;\n"
                               "        esac\n"
                               "        (( CURRENT == 2 )) && offered=\"$offered $commands\"\n"
                               "        ;;\n"
                               "    esac\n"
                               "    compadd -- ${=offered}\n"
                               "    [[ -z $is_file ]] || _files\n";

hs_status hs_completion_write(FILE *stream, const char *shell, hs_error *err)
{
    const bool is_bash = strcmp(shell, "bash") == 0;
    if (!is_bash && strcmp(shell, "zsh") != 0)
        return hs_fail(err, HS_ERROR_INPUT, "help --completion: '%s' is not bash or zsh", shell);
    fputs(is_bash ? "# bash completion for halfshell\n_halfshell() {\n" : "#compdef halfshell\n_halfshell() {\n",
          stream);
    HS_TRY(put_words(stream, err));
    fputs(is_bash ? bash_head : zsh_head, stream);
    put_choices(stream);
    fputs(is_bash ? bash_body : zsh_body, stream);
    fputs(is_bash ? "}\ncomplete -o filenames -F _halfshell halfshell\n" : "}\n_halfshell \"$@\"\n", stream);
    return HS_OK;
}
