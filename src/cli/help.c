/* halfshell help: what decks may contain, from the descriptors. */
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "cli/catalog.h"
#include "cli/cli.h"
#include "deck/command.h"

enum { NAME_COLUMN = 22, NAMES_MAX = 1024 };

static void show_options(FILE *stream, const hs_cli_command *command)
{
    fprintf(stream, "\n%s: %s\n", command->name, command->help);
    for (const hs_cli_option *option = hs_cli_options; option->name != NULL; ++option)
        if (option->commands & command->bit) {
            char form[64];
            snprintf(form, sizeof form, "%s%s%s %s", option->name, option->alias != NULL ? ", " : "",
                     option->alias != NULL ? option->alias : "", option->values);
            fprintf(stream, "  %-32s  %s\n", form, option->help);
        }
}

static void show_command_line(FILE *stream)
{
    fputs("Usage: halfshell [run] DECK [options]\n", stream);
    for (const hs_cli_command *command = hs_cli_commands + 1; command->name != NULL; ++command)
        fprintf(stream, "       halfshell %s %s\n", command->name, command->usage);
    for (const hs_cli_command *command = hs_cli_commands; command->name != NULL; ++command)
        show_options(stream, command);
}

void hs_cli_usage_of(FILE *stream, const hs_cli_command *command)
{
    fprintf(stream, "Usage: halfshell %s %s\n", command->name, command->usage);
    show_options(stream, command);
}

static void show_exit_codes(FILE *stream)
{
    fputs("Exit codes\n", stream);
    for (const char *const *row = hs_exit_code_meanings; *row != NULL; row += 2)
        fprintf(stream, "  %s  %s\n", row[0], row[1]);
}

void hs_cli_usage(FILE *stream)
{
    fputs("Halfshell runs LAMMPS input decks of short-range particle systems.\n\n", stream);
    show_command_line(stream);
    fputs("\nOther: --help (after a subcommand: of that one), --version\n\n", stream);
    show_exit_codes(stream);
    fputs("\nWhat decks may contain: halfshell help.\n", stream);
}

static void show_keywords(FILE *stream, const hs_keyword *keywords)
{
    if (keywords == NULL || keywords->name == NULL) return;
    fputs("Keywords\n", stream);
    for (const hs_keyword *keyword = keywords; keyword->name != NULL; ++keyword) {
        char form[96];
        snprintf(form, sizeof form, "%s %s", keyword->name, keyword->values != NULL ? keyword->values : "");
        fprintf(stream, "  %-30s  %s\n", form, keyword->help != NULL ? keyword->help : "");
    }
    fputc('\n', stream);
}

static void show_indented(FILE *stream, const char *text)
{
    for (const char *line = text; *line != '\0';) {
        size_t n = strcspn(line, "\n");
        fprintf(stream, "    %.*s\n", (int)n, line);
        line += n + (line[n] == '\n');
    }
}

static void show_entry(FILE *stream, const hs_catalog_entry *entry)
{
    const hs_description *about = &entry->about;
    fprintf(stream, "%s: %s\n", about->name, entry->family->kind);
    fprintf(stream, "%s\n\n", about->summary);
    if (entry->family->before == NULL) return;
    fputs("    ", stream);
    hs_catalog_syntax(stream, entry);
    if (entry->coeff != NULL) fputs("    ", stream);
    hs_catalog_coeff_syntax(stream, entry);
    fputc('\n', stream);
    if (about->details != NULL) fprintf(stream, "%s\n\n", about->details);
    show_keywords(stream, about->syntax.keywords);
    if (about->example != NULL) {
        fputs("Example\n", stream);
        show_indented(stream, about->example);
        fputc('\n', stream);
    }
    if (about->reference != NULL) fprintf(stream, "Source: %s\n\n", about->reference);
}

static hs_status show_family(FILE *stream, const hs_catalog *family, hs_error *err)
{
    hs_catalog_entry *entries;
    int n;
    HS_TRY(hs_catalog_list(family, &entries, &n, err));
    fprintf(stream, "%s\n", family->title);
    for (int i = 0; i < n; ++i)
        fprintf(stream, "  %-*s  %s\n", NAME_COLUMN, entries[i].about.name, entries[i].about.summary);
    fputc('\n', stream);
    HS_FREE(entries);
    return HS_OK;
}

static hs_status show_all(FILE *stream, hs_error *err)
{
    for (const hs_catalog *family = hs_catalogs; family->name != NULL; ++family)
        HS_TRY(show_family(stream, family, err));
    fputs("halfshell help WORD explains one of them; halfshell help FAMILY lists one family (commands, pair, fix, "
          "compute,\n"
          "region, dump, thermo, neighbor); halfshell help command-line and halfshell help exit-codes show the "
          "program's own, halfshell help plot the options of that subcommand.\n",
          stream);
    return HS_OK;
}

/** Show every entry named @p word; its name may have more than one meaning (a fix and a compute, a command and a
 *  subcommand). */
static hs_status show_word(FILE *stream, const char *word, hs_error *err)
{
    const char *names[NAMES_MAX];
    size_t n_names = 0;
    int n_shown = 0;
    for (const hs_catalog *family = hs_catalogs; family->name != NULL; ++family) {
        hs_catalog_entry *entries;
        int n;
        HS_TRY(hs_catalog_list(family, &entries, &n, err));
        for (int i = 0; i < n; ++i) {
            if (n_names < NAMES_MAX) names[n_names++] = entries[i].about.name;
            if (strcmp(entries[i].about.name, word) == 0) show_entry(stream, &entries[i]), ++n_shown;
        }
        HS_FREE(entries);
    }
    for (const hs_cli_command *command = hs_cli_commands; command->name != NULL; ++command) {
        if (n_names < NAMES_MAX) names[n_names++] = command->name;
        if (strcmp(command->name, word) == 0) hs_cli_usage_of(stream, command), ++n_shown;
    }
    if (n_shown > 0) return HS_OK;
    for (const hs_catalog *family = hs_catalogs; family->name != NULL; ++family)
        if (n_names < NAMES_MAX) names[n_names++] = family->name;
    const char *nearest = hs_text_nearest(word, names, n_names);
    if (nearest != NULL)
        return hs_fail(err, HS_ERROR_INPUT, "help: nothing is called '%s'; did you mean '%s'?", word, nearest);
    return hs_fail(err, HS_ERROR_INPUT, "help: nothing is called '%s'; halfshell help lists everything", word);
}

/** The forms by which the build makes manual, man page and completion. */
static hs_status show_generated(const hs_cli *cli, bool *done, hs_error *err)
{
    *done = true;
    const char *form = cli->word[0], *word = cli->n > 1 ? cli->word[1] : NULL;
    if (strcmp(form, "--man") == 0) return hs_manpage_write(stdout, err);
    if (strcmp(form, "--markdown") == 0 && word != NULL) return hs_manual_write(word, err);
    if (strcmp(form, "--completion") == 0 && word != NULL) return hs_completion_write(stdout, word, err);
    *done = false;
    return HS_OK;
}

static hs_status show(const hs_cli *cli, hs_error *err)
{
    if (cli->n == 0) return show_all(stdout, err);
    bool done;
    HS_TRY(show_generated(cli, &done, err));
    if (done) return HS_OK;
    if (cli->n > 1) return hs_fail(err, HS_ERROR_INPUT, "help: one word at a time; '%s' is one too many", cli->word[1]);
    const char *word = cli->word[0];
    if (strcmp(word, "command-line") == 0) return show_command_line(stdout), HS_OK;
    if (strcmp(word, "exit-codes") == 0) return show_exit_codes(stdout), HS_OK;
    /* Where a command has the name of a family (fix, region, ...), its page comes first and the family after it. */
    bool is_command = hs_command_find(word) != NULL;
    for (const hs_catalog *family = hs_catalogs; family->name != NULL; ++family)
        if (strcmp(word, family->name) == 0) {
            if (is_command) HS_TRY(show_word(stdout, word, err));
            return show_family(stdout, family, err);
        }
    return show_word(stdout, word, err);
}

hs_status hs_cli_help(const hs_cli *cli, hs_error *err)
{
    if (cli->parallel->rank != 0) return HS_OK;
    return show(cli, err);
}
