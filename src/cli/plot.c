/* halfshell plot: files of numbers that runs leave behind, as a picture. */
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "cli/cli.h"
#include "io/figure.h"

/** What the command line asks for. Words are borrowed from it. */
typedef struct plot_request {
    const char **file; /**< owned [n_files] */
    int n_files;
    const char *out, *units, *deck, *title, *legend, *x_label, *y_label;
    hs_plot_choice choice;
    hs_figure figure;
} plot_request;

static hs_status parse_range(const char *option, const char *word, double range[2], bool *has_range, hs_error *err)
{
    char copy[128], *colon;
    snprintf(copy, sizeof copy, "%s", word);
    colon = strchr(copy, ':');
    if (colon != NULL) *colon = '\0';
    *has_range = true;
    if (colon != NULL && hs_text_to_double(copy, &range[0]) && hs_text_to_double(colon + 1, &range[1]) &&
        range[0] < range[1])
        return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "%s: '%s' is not a range LO:HI, as in 0:2.5", option, word);
}

static hs_status parse_size(const char *word, hs_figure *figure, hs_error *err)
{
    int width, height, used = 0;
    if (sscanf(word, "%5dx%5d%n", &width, &height, &used) == 2 && word[used] == '\0' && width >= 100 && height >= 100 &&
        width <= 10000 && height <= 10000) {
        figure->width = width;
        figure->height = height;
        return HS_OK;
    }
    return hs_fail(err, HS_ERROR_INPUT, "-size: '%s' is not WIDTHxHEIGHT in pixels, from 100 to 10000, as in 900x600",
                   word);
}

static hs_status parse_word(const char *option, const char *word, const char *const *choices, int *choice,
                            hs_error *err)
{
    size_t n = 0;
    while (choices[n] != NULL && strcmp(choices[n], word) != 0) ++n;
    *choice = (int)n;
    if (choices[n] != NULL) return HS_OK;
    const char *nearest = hs_text_nearest(word, choices, n);
    if (nearest == NULL) nearest = choices[0];
    return hs_fail(err, HS_ERROR_INPUT, "%s: '%s' is not one of its words; did you mean '%s'?", option, word, nearest);
}

static hs_status parse_option(plot_request *r, const char *name, const char *value, hs_error *err)
{
    static const char *const axes[] = {"x", "y", "xy", "none", NULL};
    static const char *const styles[] = {"lines", "points", "both", NULL};
    const struct {
        const char *name, **target;
    } words[] = {
        {"-out", &r->out},       {"-units", &r->units},          {"-deck", &r->deck},         {"-title", &r->title},
        {"-legend", &r->legend}, {"-xlabel", &r->x_label},       {"-ylabel", &r->y_label},    {"-x", &r->choice.x},
        {"-y", &r->choice.y},    {"-errors", &r->choice.errors}, {"-block", &r->choice.block}};
    int choice;
    for (size_t k = 0; k < sizeof words / sizeof words[0]; ++k)
        if (strcmp(name, words[k].name) == 0) return *words[k].target = value, HS_OK;
    if (strcmp(name, "-xrange") == 0) return parse_range(name, value, r->figure.x_range, &r->figure.has_x_range, err);
    if (strcmp(name, "-yrange") == 0) return parse_range(name, value, r->figure.y_range, &r->figure.has_y_range, err);
    if (strcmp(name, "-size") == 0) return parse_size(value, &r->figure, err);
    if (strcmp(name, "-style") == 0) {
        HS_TRY(parse_word(name, value, styles, &choice, err));
        r->figure.style = (hs_figure_style)choice;
        return HS_OK;
    }
    HS_TRY(parse_word(name, value, axes, &choice, err)); /* -logscale */
    r->figure.is_log_x = choice == 0 || choice == 2;
    r->figure.is_log_y = choice == 1 || choice == 2;
    return HS_OK;
}

static hs_status parse(const hs_cli *cli, plot_request *r, hs_error *err)
{
    HS_TRY(HS_ALLOC(r->file, (size_t)cli->n, err));
    for (int i = 0; i < cli->n; ++i) {
        const hs_cli_option *option;
        if (!hs_cli_is_option(cli->word[i])) {
            r->file[r->n_files++] = cli->word[i];
            continue;
        }
        HS_TRY(hs_cli_find_option(cli->word[i], HS_CLI_PLOT, &option, err));
        if (++i == cli->n) return hs_fail(err, HS_ERROR_INPUT, "%s needs %s after it", option->name, option->values);
        HS_TRY(parse_option(r, option->name, cli->word[i], err));
    }
    if (r->n_files > 0) return HS_OK;
    return hs_fail(err, HS_ERROR_INPUT, "no file given; usage: halfshell plot [options] FILE...");
}

/** Name of file number @p i in the legend: from -legend, else the file's own without its folders. */
static hs_status legend_name(const plot_request *r, int i, hs_text *name, hs_error *err)
{
    const char *slash = strrchr(r->file[i], '/'), *list = r->legend;
    hs_text_clear(name);
    for (int k = 0; list != NULL && k < i; ++k) {
        list = strchr(list, ',');
        if (list != NULL) ++list;
    }
    if (r->legend == NULL) return hs_text_printf(name, err, "%s", slash != NULL ? slash + 1 : r->file[i]);
    if (list == NULL)
        return hs_fail(err, HS_ERROR_INPUT, "-legend: names between commas, one for each of the %d files", r->n_files);
    return hs_text_append(name, list, strcspn(list, ","), err);
}

static hs_status add_file(plot_request *r, int i, hs_error *err)
{
    hs_table_file file;
    hs_deck_facts facts = {0};
    hs_text name = {0};
    hs_status status = hs_table_file_read(&file, r->file[i], err);
    if (status == HS_OK && (r->deck != NULL || file.kind == HS_TABLE_LOG))
        status = hs_deck_facts_read(&facts, r->deck != NULL ? r->deck : r->file[i], err);
    if (status == HS_OK && r->units != NULL) status = hs_deck_facts_set_units(&facts, r->units, err);
    if (status == HS_OK) status = legend_name(r, i, &name, err);
    if (status == HS_OK)
        status = hs_figure_add_file(&r->figure, &file, r->n_files > 1 || r->legend != NULL ? hs_text_get(&name) : NULL,
                                    &r->choice, &facts, err);
    hs_text_fini(&name);
    hs_deck_facts_fini(&facts);
    hs_table_file_fini(&file);
    return status;
}

static hs_status set_texts(plot_request *r, hs_error *err)
{
    if (r->title != NULL) HS_TRY(hs_memory_replace(&r->figure.title, r->title, err));
    if (r->x_label != NULL) HS_TRY(hs_memory_replace(&r->figure.x_label, r->x_label, err));
    if (r->y_label != NULL && r->figure.n_panels > 1)
        return hs_fail(err, HS_ERROR_INPUT,
                       "-ylabel: the columns are of %d different quantities and get an axis each; choose one with -y",
                       r->figure.n_panels);
    return r->y_label != NULL ? hs_memory_replace(&r->figure.panel[0].label, r->y_label, err) : HS_OK;
}

static hs_status draw(plot_request *r, hs_error *err)
{
    hs_text out = {0};
    hs_figure_format format;
    const char *slash = strrchr(r->file[0], '/');
    hs_status status = hs_text_printf(&out, err, r->out != NULL ? "%s" : "%s.png",
                                      r->out != NULL  ? r->out
                                      : slash != NULL ? slash + 1
                                                      : r->file[0]);
    if (status == HS_OK) status = hs_figure_format_of(hs_text_get(&out), &format, err);
    for (int i = 0; i < r->n_files && status == HS_OK; ++i) status = add_file(r, i, err);
    if (status == HS_OK) status = set_texts(r, err);
    if (status == HS_OK) status = hs_figure_write(&r->figure, hs_text_get(&out), err);
    if (status == HS_OK)
        printf("%s: %d curve%s\n", hs_text_get(&out), r->figure.n_curves, r->figure.n_curves == 1 ? "" : "s");
    hs_text_fini(&out);
    return status;
}

hs_status hs_cli_plot(const hs_cli *cli, hs_error *err)
{
    plot_request r = {0};
    if (cli->parallel->rank != 0) return HS_OK;
    hs_status status = parse(cli, &r, err);
    if (status == HS_OK) status = draw(&r, err);
    hs_figure_fini(&r.figure);
    HS_FREE(r.file);
    return status;
}
