/* halfshell report: a run's log, or a folder with what it left behind, as one HTML page. */
#include <ctype.h>
#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

#include "base/memory.h"
#include "cli/cli.h"
#include "cli/report.h"
#include "io/writer.h"

enum { PICTURES_MAX = 12 };

/** What the page is made of. */
typedef struct report {
    hs_text page;
    const char *run; /**< as given: a log or a folder */
    bool is_folder;
    char **name; /**< owned, each owned: files of the folder in the order of their names */
    int n_names;
    hs_deck_facts facts;
    int n_figures, n_parts;
    hs_error undrawn; /**< why the first plot is missing that could not be drawn */
} report;

static bool ends_in(const char *name, const char *ending)
{
    const size_t n = strlen(name), m = strlen(ending);
    return n > m && strcasecmp(name + n - m, ending) == 0;
}

static bool is_picture(const char *name)
{
    return ends_in(name, ".png") || ends_in(name, ".jpg") || ends_in(name, ".jpeg") || ends_in(name, ".svg");
}

static bool is_deck(const char *name) { return strncmp(name, "in.", 3) == 0 || ends_in(name, ".in"); }

static hs_status add_name(report *r, const char *name, hs_error *err)
{
    HS_TRY(HS_GROW(r->name, (size_t)r->n_names, (size_t)r->n_names + 1, err));
    return hs_memory_strdup(&r->name[r->n_names++], name, err);
}

/** Names compare with their numbers as numbers: step 900 comes before step 1000. */
static int compare_names(const void *left, const void *right)
{
    const char *a = *(char *const *)left, *b = *(char *const *)right;
    while (*a != '\0' && *b != '\0') {
        if (isdigit((unsigned char)*a) && isdigit((unsigned char)*b)) {
            char *a_end, *b_end;
            const unsigned long long m = strtoull(a, &a_end, 10), n = strtoull(b, &b_end, 10);
            if (m != n) return m < n ? -1 : 1;
            a = a_end;
            b = b_end;
        } else {
            if (*a != *b) return *a < *b ? -1 : 1;
            ++a;
            ++b;
        }
    }
    const int by_length = (*a != '\0') - (*b != '\0');
    return by_length != 0 ? by_length : strcmp(*(char *const *)left, *(char *const *)right);
}

static hs_status list_folder(report *r, hs_error *err)
{
    DIR *folder = opendir(r->run);
    if (folder == NULL) return hs_fail(err, HS_ERROR_INPUT, "'%s' cannot be read: %s", r->run, strerror(errno));
    hs_status status = HS_OK;
    for (struct dirent *entry = readdir(folder); entry != NULL && status == HS_OK; entry = readdir(folder)) {
        if (entry->d_name[0] == '.') continue;
        status = add_name(r, entry->d_name, err);
    }
    closedir(folder);
    if (status == HS_OK && r->n_names > 0) qsort(r->name, (size_t)r->n_names, sizeof *r->name, compare_names);
    return status;
}

/** Path of a file of the run. */
static hs_status path_of(const report *r, const char *name, hs_text *path, hs_error *err)
{
    hs_text_clear(path);
    return r->is_folder ? hs_text_printf(path, err, "%s/%s", r->run, name) : hs_text_printf(path, err, "%s", r->run);
}

static hs_status put_facts(report *r, const hs_log_summary *summary, hs_error *err)
{
    const char *text = hs_text_get(&summary->facts);
    HS_TRY(hs_text_printf(&r->page, err, "<dl>\n"));
    if (r->facts.units != NULL)
        HS_TRY(hs_text_printf(&r->page, err, "<dt>units, timestep</dt><dd>%s, %g</dd>\n", r->facts.units->name,
                              r->facts.dt));
    for (bool is_label = true; *text != '\0'; is_label = !is_label) {
        char line[1024];
        const size_t n = strcspn(text, "\n");
        snprintf(line, sizeof line, "%.*s", (int)n, text);
        text += n + 1;
        HS_TRY(hs_text_printf(&r->page, err, is_label ? "<dt>" : "<dd>"));
        HS_TRY(hs_html_text(&r->page, line, err));
        HS_TRY(hs_text_printf(&r->page, err, is_label ? "</dt>" : "</dd>\n"));
    }
    return hs_text_printf(&r->page, err, "</dl>\n");
}

static hs_status put_block(report *r, const char *title, const char *attributes, const hs_text *text, hs_error *err)
{
    if (text->length == 0) return HS_OK;
    HS_TRY(hs_text_printf(&r->page, err, "<h2>%s</h2>\n<pre%s>", title, attributes));
    HS_TRY(hs_html_text(&r->page, hs_text_get(text), err));
    return hs_text_printf(&r->page, err, "</pre>\n");
}

/** A file's default figure. A file that cannot be drawn says why in its place. */
static hs_status put_figure(report *r, const hs_table_file *file, const char *caption, hs_error *err)
{
    hs_figure figure = {.width = 720};
    hs_error cause = {0};
    const hs_plot_choice choice = {0};
    hs_status status;
    if (hs_figure_add_file(&figure, file, NULL, &choice, &r->facts, &cause) == HS_OK) {
        status = hs_html_figure(&r->page, &figure, ++r->n_figures, caption, &r->undrawn, err);
    } else {
        status = hs_text_printf(&r->page, err, "<p class=\"note\">");
        if (status == HS_OK) status = hs_html_text(&r->page, cause.text, err);
        if (status == HS_OK) status = hs_text_printf(&r->page, err, "</p>\n");
    }
    hs_figure_fini(&figure);
    return status;
}

static hs_status put_folded(report *r, const char *summary, const char *text, hs_error *err)
{
    HS_TRY(hs_text_printf(&r->page, err, "<details><summary>"));
    HS_TRY(hs_html_text(&r->page, summary, err));
    HS_TRY(hs_text_printf(&r->page, err, "</summary>\n<pre>"));
    HS_TRY(hs_html_text(&r->page, text, err));
    return hs_text_printf(&r->page, err, "</pre></details>\n");
}

/** Of a log that would make the page heavy, the beginning and the end. */
static hs_status put_whole_log(report *r, const char *log, hs_error *err)
{
    const size_t most = 400000, part = 150000, length = strlen(log);
    if (length <= most) return put_folded(r, "The whole log", log, err);
    hs_text cut = {0};
    hs_status status = hs_text_append(&cut, log, part, err);
    if (status == HS_OK) status = hs_text_printf(&cut, err, "\n[...]\n%s", log + length - part);
    if (status == HS_OK) status = put_folded(r, "Beginning and end of the log", hs_text_get(&cut), err);
    hs_text_fini(&cut);
    return status;
}

static hs_status put_title(report *r, const char *before, const char *name, hs_error *err)
{
    HS_TRY(hs_text_printf(&r->page, err, "<h2>%s", before));
    HS_TRY(hs_html_text(&r->page, name, err));
    return hs_text_printf(&r->page, err, "</h2>\n");
}

static hs_status put_log_parts(report *r, const hs_table_file *file, const char *name, const char *log,
                               hs_log_summary *summary, hs_error *err)
{
    hs_deck_facts_fini(&r->facts);
    r->facts = (hs_deck_facts){0};
    HS_TRY(hs_deck_facts_learn(&r->facts, log, err));
    HS_TRY(hs_log_summary_read(summary, log, err));
    HS_TRY(put_title(r, "Log ", name, err));
    HS_TRY(put_facts(r, summary, err));
    HS_TRY(put_block(r, "Warnings", " class=\"warning\"", &summary->warnings, err));
    HS_TRY(hs_text_printf(&r->page, err, "<h2>Thermodynamics</h2>\n"));
    HS_TRY(put_figure(r, file, "thermo output of all runs", err));
    HS_TRY(hs_html_means(&r->page, file, &r->facts, err));
    HS_TRY(put_block(r, "Where the time went (last run)", " class=\"table\"", &summary->timing, err));
    HS_TRY(put_block(r, "Deck", "", &summary->deck, err));
    return put_whole_log(r, log, err);
}

static hs_status put_log(report *r, const hs_table_file *file, const char *name, const char *path, hs_error *err)
{
    hs_log_summary summary = {0};
    hs_text log = {0}; /* once more: reading its tables has cut the first one into words */
    hs_status status = hs_table_read_text(path, &log, err);
    if (status == HS_OK) status = put_log_parts(r, file, name, hs_text_get(&log), &summary, err);
    hs_log_summary_fini(&summary);
    hs_text_fini(&log);
    ++r->n_parts;
    return status;
}

static hs_status put_table(report *r, const hs_table_file *file, const char *name, hs_error *err)
{
    HS_TRY(put_title(r, "", name, err));
    ++r->n_parts;
    return put_figure(r, file, file->about, err);
}

/** Whether a file may be one of the page's: a log or CSV by its name, a fix's output by the comment it begins with.
 *  Others are not even read: a folder may hold snapshots larger than memory. */
static bool is_worth_reading(const char *path, const char *name)
{
    const off_t size_max = 200000000;
    struct stat about;
    if (is_picture(name) || is_deck(name) || stat(path, &about) != 0) return false;
    if (!S_ISREG(about.st_mode) || about.st_size > size_max) return false;
    if (strncmp(name, "log.", 4) == 0 || ends_in(name, ".log") || ends_in(name, ".csv") || ends_in(name, ".gz"))
        return true;
    FILE *file = fopen(path, "rb");
    const int first = file != NULL ? fgetc(file) : EOF;
    if (file != NULL) fclose(file);
    return first == '#';
}

/** A file by its content: a log or another table, whichever @p wants_log asks for. A file of a folder that is neither
 *  is none of the page's business. */
static hs_status put_file(report *r, const char *name, bool wants_log, hs_error *err)
{
    hs_text path = {0};
    hs_table_file file = {0};
    hs_error cause = {0};
    hs_status status = path_of(r, name, &path, err);
    if (status == HS_OK && (!r->is_folder || is_worth_reading(hs_text_get(&path), name))) {
        const hs_status read = hs_table_file_read(&file, hs_text_get(&path), &cause);
        const bool is_log = read == HS_OK && file.kind == HS_TABLE_LOG;
        if (read != HS_OK && !r->is_folder) *err = cause, status = read;
        if (read == HS_OK && is_log && wants_log) status = put_log(r, &file, name, hs_text_get(&path), err);
        if (read == HS_OK && !is_log && !wants_log) status = put_table(r, &file, name, err);
    }
    hs_table_file_fini(&file);
    hs_text_fini(&path);
    return status;
}

/** Pictures, of more than PICTURES_MAX so many at equal distances, the last one always. */
static hs_status put_pictures(report *r, hs_error *err)
{
    hs_text path = {0};
    int n = 0, n_seen = 0, n_shown = 0;
    for (int k = 0; k < r->n_names && r->is_folder; ++k) n += is_picture(r->name[k]);
    if (n == 0) return HS_OK;
    hs_status status = hs_text_printf(&r->page, err, "<h2>Pictures</h2>\n");
    if (status == HS_OK && n > PICTURES_MAX)
        status = hs_text_printf(&r->page, err, "<p class=\"note\">%d of the %d there are.</p>\n", PICTURES_MAX, n);
    if (status == HS_OK) status = hs_text_printf(&r->page, err, "<div class=\"pictures\">\n");
    for (int k = 0; k < r->n_names && status == HS_OK; ++k) {
        if (!is_picture(r->name[k])) continue;
        const int n_due = n > PICTURES_MAX ? (int)(((int64_t)++n_seen * PICTURES_MAX) / n) : ++n_seen;
        if (n_due == n_shown) continue;
        n_shown = n_due;
        status = path_of(r, r->name[k], &path, err);
        if (status == HS_OK) status = hs_html_picture(&r->page, hs_text_get(&path), r->name[k], err);
    }
    if (status == HS_OK) status = hs_text_printf(&r->page, err, "</div>\n");
    hs_text_fini(&path);
    ++r->n_parts;
    return status;
}

static hs_status put_decks(report *r, hs_error *err)
{
    hs_text path = {0}, text = {0};
    hs_status status = HS_OK;
    for (int k = 0; k < r->n_names && r->is_folder && status == HS_OK; ++k) {
        hs_error cause = {0};
        if (!is_deck(r->name[k])) continue;
        hs_text_clear(&text);
        status = path_of(r, r->name[k], &path, err);
        if (status == HS_OK && hs_table_read_text(hs_text_get(&path), &text, &cause) == HS_OK)
            status = put_folded(r, r->name[k], hs_text_get(&text), err);
    }
    hs_text_fini(&path);
    hs_text_fini(&text);
    return status;
}

static hs_status put_parts(report *r, hs_error *err)
{
    for (int k = 0; k < r->n_names; ++k) HS_TRY(put_file(r, r->name[k], true, err));
    HS_TRY(put_pictures(r, err));
    for (int k = 0; k < r->n_names; ++k) HS_TRY(put_file(r, r->name[k], false, err));
    HS_TRY(put_decks(r, err));
    if (r->n_parts > 0) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT,
                   "'%s' holds nothing to report: no log, no file that a fix or a dump image writes, no CSV", r->run);
}

/** Name of the run: the last part of its path. */
static hs_status title_of(const report *r, hs_text *title, hs_error *err)
{
    char *real = realpath(r->run, NULL);
    if (real == NULL) return hs_fail(err, HS_ERROR_INPUT, "'%s' cannot be read: %s", r->run, strerror(errno));
    const char *slash = strrchr(real, '/');
    const hs_status status = hs_text_printf(title, err, "%s", slash != NULL && slash[1] != '\0' ? slash + 1 : real);
    free(real);
    return status;
}

static hs_status write_page(const report *r, const char *path, hs_error *err)
{
    hs_writer *writer = NULL;
    HS_TRY(hs_writer_open(&writer, path, HS_WRITE_WHOLE, err));
    const hs_status status = hs_writer_bytes(writer, r->page.data, r->page.length, err);
    if (status == HS_OK) return hs_writer_close(&writer, err);
    hs_writer_abandon(&writer);
    return status;
}

static hs_status make(report *r, const char *out, hs_error *err)
{
    hs_text title = {0}, path = {0};
    struct stat about;
    hs_status status = title_of(r, &title, err);
    if (status == HS_OK && stat(r->run, &about) == 0) r->is_folder = S_ISDIR(about.st_mode);
    if (status == HS_OK) status = r->is_folder ? list_folder(r, err) : add_name(r, hs_text_get(&title), err);
    if (status == HS_OK) status = hs_html_begin(&r->page, hs_text_get(&title), err);
    if (status == HS_OK) status = put_parts(r, err);
    if (status == HS_OK) status = hs_html_end(&r->page, err);
    if (status == HS_OK)
        status =
            hs_text_printf(&path, err, "%s%s", out != NULL ? out : hs_text_get(&title), out != NULL ? "" : ".html");
    if (status == HS_OK) status = write_page(r, hs_text_get(&path), err);
    if (status == HS_OK) printf("%s: %d figure%s\n", hs_text_get(&path), r->n_figures, r->n_figures == 1 ? "" : "s");
    if (status == HS_OK && r->undrawn.status != HS_OK)
        fprintf(stderr, "halfshell: warning: the page lacks plots: %s\n", r->undrawn.text);
    hs_text_fini(&path);
    hs_text_fini(&title);
    return status;
}

static hs_status parse(const hs_cli *cli, const char **run, const char **out, hs_error *err)
{
    *run = *out = NULL;
    for (int i = 0; i < cli->n; ++i) {
        const hs_cli_option *option;
        if (!hs_cli_is_option(cli->word[i])) {
            if (*run != NULL)
                return hs_fail(err, HS_ERROR_INPUT, "'%s' and '%s' are two runs; a report takes one log or folder",
                               *run, cli->word[i]);
            *run = cli->word[i];
            continue;
        }
        HS_TRY(hs_cli_find_option(cli->word[i], HS_CLI_REPORT, &option, err));
        if (++i == cli->n) return hs_fail(err, HS_ERROR_INPUT, "%s needs %s after it", option->name, option->values);
        *out = cli->word[i]; /* -out, the only one */
    }
    if (*run != NULL) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "no run given; usage: halfshell report [options] RUN");
}

hs_status hs_cli_report(const hs_cli *cli, hs_error *err)
{
    report r = {0};
    const char *out;
    if (cli->parallel->rank != 0) return HS_OK;
    hs_status status = parse(cli, &r.run, &out, err);
    if (status == HS_OK) status = make(&r, out, err);
    for (int k = 0; k < r.n_names; ++k) HS_FREE(r.name[k]);
    HS_FREE(r.name);
    hs_deck_facts_fini(&r.facts);
    hs_text_fini(&r.page);
    return status;
}
