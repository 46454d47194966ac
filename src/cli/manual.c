/* The reference manual, docs/reference/: Markdown from the descriptors. A test fails when the committed pages are
 * stale. */
#include <errno.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "cli/catalog.h"
#include "cli/cli.h"

#define PATH_SIZE 4096
#define MADE_BY   "<!-- Made by script/manual from the descriptors in the sources: do not edit. -->\n\n"

static hs_status open_page(const char *directory, const char *name, FILE **page, hs_error *err)
{
    char path[PATH_SIZE];
    if (snprintf(path, sizeof path, "%s/%s.md", directory, name) >= (int)sizeof path)
        return hs_fail(err, HS_ERROR_INPUT, "help: the directory's name is too long");
    *page = fopen(path, "w");
    if (*page == NULL) return hs_fail(err, HS_ERROR_IO, "help: cannot write '%s': %s", path, strerror(errno));
    fputs(MADE_BY, *page);
    return HS_OK;
}

static hs_status close_page(FILE *page, hs_error *err)
{
    bool failed = ferror(page) != 0;
    if (fclose(page) != 0 || failed) return hs_fail(err, HS_ERROR_IO, "help: the manual could not be written");
    return HS_OK;
}

/** A table cell: `|` would end it. */
static void put_cell(FILE *page, const char *text)
{
    for (; text != NULL && *text != '\0'; ++text) {
        if (*text == '|') fputc('\\', page);
        fputc(*text, page);
    }
}

static void put_code_cell(FILE *page, const char *text)
{
    if (text == NULL || text[0] == '\0') return;
    fputc('`', page);
    put_cell(page, text);
    fputc('`', page);
}

static void put_keywords(FILE *page, const hs_keyword *keywords)
{
    if (keywords == NULL || keywords->name == NULL) return;
    fputs("| keyword | values | meaning |\n|---|---|---|\n", page);
    for (const hs_keyword *keyword = keywords; keyword->name != NULL; ++keyword) {
        fputs("| ", page);
        put_code_cell(page, keyword->name);
        fputs(" | ", page);
        put_code_cell(page, keyword->values);
        fputs(" | ", page);
        put_cell(page, keyword->help);
        fputs(" |\n", page);
    }
    fputc('\n', page);
}

static void put_entry(FILE *page, const hs_catalog_entry *entry)
{
    const hs_description *about = &entry->about;
    fprintf(page, "## %s\n\n%s\n\n```\n", about->name, about->summary);
    hs_catalog_syntax(page, entry);
    hs_catalog_coeff_syntax(page, entry);
    fputs("```\n\n", page);
    if (about->details != NULL) fprintf(page, "%s\n\n", about->details);
    put_keywords(page, about->syntax.keywords);
    if (entry->coeff != NULL) put_keywords(page, entry->coeff->keywords);
    if (about->example != NULL) {
        size_t n = strlen(about->example);
        fprintf(page, "Example:\n\n```\n%s%s```\n\n", about->example,
                n > 0 && about->example[n - 1] == '\n' ? "" : "\n");
    }
    if (about->reference != NULL) fprintf(page, "Source: %s\n\n", about->reference);
}

static void put_table(FILE *page, const hs_catalog_entry *entries, int n)
{
    fputs("| name | meaning |\n|---|---|\n", page);
    for (int i = 0; i < n; ++i) {
        fputs("| ", page);
        put_code_cell(page, entries[i].about.name);
        fputs(" | ", page);
        put_cell(page, entries[i].about.summary);
        fputs(" |\n", page);
    }
}

static hs_status write_family(const char *directory, const hs_catalog *family, hs_error *err)
{
    FILE *page;
    hs_catalog_entry *entries = NULL;
    int n;
    HS_TRY(open_page(directory, family->name, &page, err));
    hs_status status = hs_catalog_list(family, &entries, &n, err);
    if (status == HS_OK) {
        fprintf(page, "# %s\n\n%s\n\n", family->title, family->intro);
        if (family->before == NULL) put_table(page, entries, n);
        for (int i = 0; family->before != NULL && i < n; ++i) put_entry(page, &entries[i]);
    }
    HS_FREE(entries);
    hs_status closed = close_page(page, err);
    return status != HS_OK ? status : closed;
}

static hs_status write_command_line(const char *directory, hs_error *err)
{
    FILE *page;
    HS_TRY(open_page(directory, "command-line", &page, err));
    fputs("# Command line\n\n", page);
    for (const hs_cli_command *command = hs_cli_commands; command->name != NULL; ++command) {
        fprintf(page, "## halfshell %s\n\n`halfshell %s %s`: %s.\n\n", command->name, command->name, command->usage,
                command->help);
        bool has_options = false;
        for (const hs_cli_option *option = hs_cli_options; option->name != NULL; ++option) {
            if ((option->commands & command->bit) == 0) continue;
            if (!has_options) fputs("| option | short | values | meaning |\n|---|---|---|---|\n", page);
            has_options = true;
            fprintf(page, "| `%s` | ", option->name);
            put_code_cell(page, option->alias);
            fputs(" | ", page);
            put_code_cell(page, option->values);
            fputs(" | ", page);
            put_cell(page, option->help);
            fputs(" |\n", page);
        }
        if (has_options) fputc('\n', page);
    }
    fputs(
        "`halfshell --help` prints this in short, `halfshell --version` the version.\n\n"
        "The values of `-var` end at the next option, so a deck named after them belongs before them or behind `-in`.\n"
        "Without a deck, and with standard input not a terminal, the deck is read from there: `halfshell < "
        "deck.in`.\n\n"
        "The environment's `OMP_NUM_THREADS` and `HALFSHELL_ISA` stand in for `-threads` and `-isa` where those are "
        "not given, but runs with fewer than 1,000 atoms a rank then take one thread: they would be slower with "
        "more.\n\n"
        "Errors go to standard error as `DECK:LINE: error: what, why, what would be right`; see [exit "
        "codes](exit-codes.md).\n",
        page);
    return close_page(page, err);
}

static hs_status write_exit_codes(const char *directory, hs_error *err)
{
    FILE *page;
    HS_TRY(open_page(directory, "exit-codes", &page, err));
    fputs("# Exit codes\n\n| code | meaning |\n|---|---|\n", page);
    for (const char *const *row = hs_exit_code_meanings; *row != NULL; row += 2)
        fprintf(page, "| %s | %s |\n", row[0], row[1]);
    fputs("\nThe deck's command `quit N` sets its own.\n", page);
    return close_page(page, err);
}

static hs_status write_index(const char *directory, hs_error *err)
{
    FILE *page;
    HS_TRY(open_page(directory, "README", &page, err));
    fputs("# Reference manual\n\n"
          "What decks may contain. The same text is in the program: `halfshell help`, `halfshell help lj/cut`.\n\n",
          page);
    for (const hs_catalog *family = hs_catalogs; family->name != NULL; ++family)
        fprintf(page, "- [%s](%s.md)\n", family->title, family->name);
    fputs("- [Command line](command-line.md)\n- [Exit codes](exit-codes.md)\n", page);
    return close_page(page, err);
}

hs_status hs_manual_write(const char *directory, hs_error *err)
{
    for (const hs_catalog *family = hs_catalogs; family->name != NULL; ++family)
        HS_TRY(write_family(directory, family, err));
    HS_TRY(write_command_line(directory, err));
    HS_TRY(write_exit_codes(directory, err));
    return write_index(directory, err);
}
