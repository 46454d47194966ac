/* What a log says beside its thermo tables. */
#include <stdio.h>
#include <string.h>
#include <zlib.h>

#include "cli/report.h"
#include "deck/command.h"

/** What is worth a line at the head of the page: how log lines begin, and what that tells. */
static const struct {
    const char *start, *label;
} told[] = {
    {"Halfshell ", "program"},
    {"LAMMPS (", "program"},
    {"Running on ", "machine"},
    {"Created orthogonal box = ", "box"},
    {"Created triclinic box = ", "box"},
    {"  pair kernels: ", "pair kernels"},
    {"  neighbor method ", "neighbor method"},
    {"Per MPI rank memory allocation (min/avg/max) = ", "memory of a rank (min/avg/max)"},
    {"Loop time of ", "loop time"},
    {"Performance: ", "speed"},
};

void hs_log_summary_fini(hs_log_summary *summary)
{
    hs_text_fini(&summary->deck);
    hs_text_fini(&summary->warnings);
    hs_text_fini(&summary->facts);
    hs_text_fini(&summary->timing);
}

static bool starts_with(const char *line, const char *start) { return strncmp(line, start, strlen(start)) == 0; }

/** First word of a line; "" when it is blank or a comment. */
static void first_word(const char *line, char word[64])
{
    line += strspn(line, " \t");
    size_t n = strcspn(line, " \t\r");
    n = line[0] == '#' ? 0 : n < 63 ? n : 63;
    memcpy(word, line, n);
    word[n] = '\0';
}

static bool is_command(const char *word)
{
    for (int family = 0; hs_command_families[family] != NULL; ++family)
        for (const hs_command *command = hs_command_families[family]; command->about.name != NULL; ++command)
            if (strcmp(command->about.name, word) == 0) return true;
    return false;
}

/** While the log is read. */
typedef struct log_scan {
    hs_log_summary *summary;
    char pending[64];  /**< command whose substituted forms follow; "" for none */
    bool is_continued; /**< the command goes on in the next line */
    bool in_timing;
    const char *fact[sizeof told / sizeof told[0]]; /**< rest of the last line of each kind; borrowed */
} log_scan;

/** A command stands in the log as it is in the deck, and after that, where it holds `$`, as it was run: only the first
 *  is the deck's. */
static hs_status scan_command(log_scan *scan, const char *line, hs_error *err)
{
    char word[64];
    first_word(line, word);
    const bool is_comment = line[strspn(line, " \t")] == '#', has_dollar = strchr(line, '$') != NULL;
    if (!scan->is_continued && !is_comment) {
        /* "create_atoms CPU = 0.1 seconds" is what the command says, not the command */
        if (!is_command(word) || strstr(line, " CPU = ") != NULL) return HS_OK;
        if (strcmp(word, scan->pending) == 0) {
            if (!has_dollar) scan->pending[0] = '\0';
            return HS_OK;
        }
        snprintf(scan->pending, sizeof scan->pending, "%s", has_dollar ? word : "");
    }
    const size_t length = strlen(line);
    scan->is_continued = !is_comment && length > 0 && line[length - 1] == '&';
    return hs_text_printf(&scan->summary->deck, err, "%s\n", line);
}

static hs_status scan_line(log_scan *scan, char *line, hs_error *err)
{
    if (starts_with(line, "WARNING")) return hs_text_printf(&scan->summary->warnings, err, "%s\n", line);
    if (starts_with(line, "MPI task timing breakdown")) {
        scan->in_timing = true;
        hs_text_clear(&scan->summary->timing);
        return HS_OK;
    }
    if (line[0] == '\0') scan->in_timing = false;
    if (scan->in_timing) return hs_text_printf(&scan->summary->timing, err, "%s\n", line);
    bool is_fact = false;
    for (size_t k = 0; k < sizeof told / sizeof told[0]; ++k)
        if (starts_with(line, told[k].start)) {
            const bool keeps_start = strcmp(told[k].label, "program") == 0;
            scan->fact[k] = keeps_start ? line : line + strlen(told[k].start);
            is_fact = true;
        }
    return is_fact ? HS_OK : scan_command(scan, line, err);
}

static hs_status scan(hs_log_summary *summary, hs_text *log, hs_error *err)
{
    log_scan state = {.summary = summary};
    hs_table_lines lines = {.next = log->data, .end = log->data + log->length};
    for (char *line = hs_table_next_line(&lines); line != NULL; line = hs_table_next_line(&lines))
        HS_TRY(scan_line(&state, line, err));
    for (size_t k = 0; k < sizeof told / sizeof told[0]; ++k)
        if (state.fact[k] != NULL)
            HS_TRY(hs_text_printf(&summary->facts, err, "%s\n%s\n", told[k].label, state.fact[k]));
    return HS_OK;
}

hs_status hs_log_summary_read(hs_log_summary *summary, const char *log, hs_error *err)
{
    hs_text copy = {0};
    hs_status status = hs_text_append(&copy, log, strlen(log), err);
    if (status == HS_OK) status = scan(summary, &copy, err);
    hs_text_fini(&copy);
    return status;
}
