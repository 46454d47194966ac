/* HTML of the report: one page that asks no other host for anything. */
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "cli/report.h"

hs_status hs_html_text(hs_text *page, const char *text, hs_error *err)
{
    for (; *text != '\0'; ++text) {
        const unsigned char c = (unsigned char)*text;
        switch (c) {
        case '&':
            HS_TRY(hs_text_append(page, "&amp;", 5, err));
            break;
        case '<':
            HS_TRY(hs_text_append(page, "&lt;", 4, err));
            break;
        case '>':
            HS_TRY(hs_text_append(page, "&gt;", 4, err));
            break;
        case '"':
            HS_TRY(hs_text_append(page, "&quot;", 6, err));
            break;
        case '\'':
            HS_TRY(hs_text_append(page, "&#39;", 5, err));
            break;
        default:
            if (c >= ' ' || c == '\n' || c == '\t') HS_TRY(hs_text_append(page, text, 1, err));
        }
    }
    return HS_OK;
}

static const char head[] = "<meta charset=\"utf-8\">\n"
                           "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
                           "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; "
                           "style-src 'unsafe-inline'\">\n"
                           "<meta name=\"color-scheme\" content=\"light dark\">\n";

static const char style[] =
    "<style>\n"
    ":root { --paper: #fff; --card: #f6f7f9; --ink: #1c2126; --faint: #5d6670; --line: #d9dde2; --accent: #0072b2; }\n"
    "@media (prefers-color-scheme: dark) {\n"
    "  :root { --paper: #15181c; --card: #1e2328; --ink: #e4e7ea; --faint: #a0a8b0; --line: #3a4148; --accent: "
    "#6cb6e8; }\n"
    "  svg .series { filter: brightness(1.35); }\n"
    "}\n"
    "* { box-sizing: border-box; }\n"
    "body { margin: 0 auto; padding: 1.5rem 1rem 4rem; max-width: 62rem; background: var(--paper); color: var(--ink);\n"
    "  font: 16px/1.5 system-ui, sans-serif; overflow-wrap: anywhere; }\n"
    "h1 { font-size: 1.5rem; margin: 0 0 .25rem; } h2 { font-size: 1.2rem; margin: 2.2rem 0 .6rem; }\n"
    "h3 { font-size: 1rem; margin: 1.2rem 0 .4rem; } p { margin: .4rem 0; }\n"
    ".note, figcaption, .lead { color: var(--faint); font-size: .875rem; }\n"
    "dl { display: grid; grid-template-columns: max-content 1fr; gap: .25rem 1rem; margin: 0; }\n"
    "dt { color: var(--faint); } dd { margin: 0; }\n"
    "@media (max-width: 34rem) { dl { grid-template-columns: 1fr; gap: 0; } dd { margin-bottom: .5rem; } }\n"
    ".wide { overflow-x: auto; } table { border-collapse: collapse; font-variant-numeric: tabular-nums;\n"
    "  font-size: .875rem; overflow-wrap: normal; }\n"
    "th, td { text-align: right; padding: .25rem .75rem .25rem 0; border-bottom: 1px solid var(--line);\n"
    "  white-space: nowrap; }\n"
    "th:first-child, th:nth-child(2), td.what { text-align: left; } thead th { color: var(--faint); font-weight: 500; "
    "}\n"
    "figure { margin: 1rem 0; padding: .75rem; background: var(--card); border-radius: .5rem; break-inside: avoid; }\n"
    "figure svg { display: block; width: 100%; min-width: 34rem; height: auto; }\n"
    "figure img { display: block; max-width: 100%; height: auto; margin: auto; }\n"
    ".pictures { display: grid; grid-template-columns: repeat(auto-fill, minmax(15rem, 1fr)); gap: 1rem; }\n"
    ".pictures figure { margin: 0; }\n"
    "pre { background: var(--card); padding: .75rem; border-radius: .5rem; overflow-x: auto; font-size: .8125rem;\n"
    "  line-height: 1.45; white-space: pre-wrap; }\n"
    "pre.table { white-space: pre; overflow-wrap: normal; }\n"
    ".warning { border-left: 3px solid #d55e00; }\n"
    "summary { cursor: pointer; color: var(--accent); }\n"
    "@media print { :root { --paper: #fff; --card: #fff; --ink: #000; --faint: #444; --line: #bbb; }\n"
    "  body { max-width: none; padding: 0; font-size: 11pt; } figure svg { min-width: 0; } h2 { break-after: avoid; }\n"
    "  .wide { overflow: visible; } table { font-size: 8pt; } details { display: none; } }\n"
    "</style>\n";

hs_status hs_html_begin(hs_text *page, const char *title, hs_error *err)
{
    HS_TRY(hs_text_printf(page, err, "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n%s<title>", head));
    HS_TRY(hs_html_text(page, title, err));
    HS_TRY(hs_text_printf(page, err, "</title>\n%s</head>\n<body>\n<h1>", style));
    HS_TRY(hs_html_text(page, title, err));
    return hs_text_printf(page, err, "</h1>\n");
}

hs_status hs_html_end(hs_text *page, hs_error *err)
{
    return hs_text_printf(page, err, "<p class=\"note\">Made by halfshell report, version %s.</p>\n</body>\n</html>\n",
                          HALFSHELL_VERSION);
}

/** What in gnuplot's SVG becomes what: names apart from other figures', the page's colours, no mention of hosts. */
static const struct {
    const char *from, *to; /**< %d: the number of the figure */
} changes[] = {
    {"xlink:href=", "href="},
    {" xmlns=\"http://www.w3.org/2000/svg\"", ""},
    {" xmlns:xlink=\"http://www.w3.org/1999/xlink\"", ""},
    {"<title>Gnuplot</title>", ""},
    {"id='gp", "id='f%dgp"},
    {"href='#gp", "href='#f%dgp"},
    {"id='textbox'", "id='f%dtextbox'"},
    {"id='greybox'", "id='f%dgreybox'"},
    {"url(#textbox)", "url(#f%dtextbox)"},
    {"id=\"gnuplot_plot_", "class=\"series\" id=\"f%dgnuplot_plot_"},
    {"id=\"gnuplot_canvas\"", "id=\"f%dgnuplot_canvas\""},
    {"color=\"black\"", ""},
    {"fill=\"black\"", "fill=\"currentColor\""},
    {"stroke=\"black\"", "stroke=\"currentColor\""},
    {"stroke='black'", "stroke='currentColor'"},
    {"stroke=\"rgb(217, 217, 217)\"", "style=\"stroke: var(--line)\""},
    {"stroke='rgb(217, 217, 217)'", "style='stroke: var(--line)'"},
};
enum { N_CHANGES = sizeof changes / sizeof changes[0] };

/** Put text, with %d as the number. */
static hs_status put_change(hs_text *page, const char *to, int number, hs_error *err)
{
    const char *slot = strstr(to, "%d");
    if (slot == NULL) return hs_text_append(page, to, strlen(to), err);
    return hs_text_printf(page, err, "%.*s%d%s", (int)(slot - to), to, number, slot + 2);
}

static hs_status put_svg(hs_text *page, const char *svg, int number, hs_error *err)
{
    while (*svg != '\0') {
        int k = 0;
        while (k < N_CHANGES && strncmp(svg, changes[k].from, strlen(changes[k].from)) != 0) ++k;
        if (k < N_CHANGES) {
            HS_TRY(put_change(page, changes[k].to, number, err));
            svg += strlen(changes[k].from);
            continue;
        }
        /* up to where a change may begin */
        const size_t n = 1 + strcspn(svg + 1, "x <ihucfs");
        HS_TRY(hs_text_append(page, svg, n, err));
        svg += n;
    }
    return HS_OK;
}

hs_status hs_html_figure(hs_text *page, const hs_figure *figure, int number, const char *caption, hs_error *undrawn,
                         hs_error *err)
{
    hs_text picture = {0};
    hs_error cause = {0};
    const hs_status drawn = hs_figure_draw(figure, HS_FIGURE_INLINE_SVG, &picture, &cause);
    const char *svg = drawn == HS_OK ? strstr(hs_text_get(&picture), "<svg") : NULL;
    hs_status status = hs_text_printf(page, err, "<figure><div class=\"wide\">");
    if (status == HS_OK && svg != NULL) {
        status = put_svg(page, svg, number, err);
    } else if (status == HS_OK) {
        status = hs_text_printf(page, err, "<p>");
        if (drawn == HS_OK) (void)hs_fail(&cause, HS_ERROR_RUN, "gnuplot has drawn nothing");
        if (status == HS_OK) status = hs_html_text(page, cause.text, err);
        if (status == HS_OK) status = hs_text_printf(page, err, "</p>");
        (void)hs_fail(undrawn, cause.status, "%s", cause.text);
    }
    if (status == HS_OK) status = hs_text_printf(page, err, "</div><figcaption>");
    if (status == HS_OK) status = hs_html_text(page, caption, err);
    if (status == HS_OK) status = hs_text_printf(page, err, "</figcaption></figure>\n");
    hs_text_fini(&picture);
    return status;
}

static hs_status put_base64(hs_text *page, const unsigned char *bytes, size_t n, hs_error *err)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < n; i += 3) {
        const unsigned b = i + 1 < n ? bytes[i + 1] : 0, c = i + 2 < n ? bytes[i + 2] : 0;
        const unsigned word = (unsigned)bytes[i] << 16 | b << 8 | c;
        const char four[4] = {digits[word >> 18], digits[word >> 12 & 63], i + 1 < n ? digits[word >> 6 & 63] : '=',
                              i + 2 < n ? digits[word & 63] : '='};
        HS_TRY(hs_text_append(page, four, 4, err));
    }
    return HS_OK;
}

static hs_status read_file(const char *path, hs_text *bytes, hs_error *err)
{
    char piece[1 << 14];
    size_t n;
    FILE *file = fopen(path, "rb");
    if (file == NULL) return hs_fail(err, HS_ERROR_INPUT, "'%s' cannot be read: %s", path, strerror(errno));
    hs_status status = HS_OK;
    while (status == HS_OK && (n = fread(piece, 1, sizeof piece, file)) > 0)
        status = hs_text_append(bytes, piece, n, err);
    if (status == HS_OK && ferror(file)) status = hs_fail(err, HS_ERROR_INPUT, "'%s' cannot be read", path);
    fclose(file);
    return status;
}

static const char *media_type(const char *path)
{
    const char *dot = strrchr(path, '.');
    if (dot != NULL && strcasecmp(dot, ".svg") == 0) return "image/svg+xml";
    return dot != NULL && strcasecmp(dot, ".png") == 0 ? "image/png" : "image/jpeg";
}

hs_status hs_html_picture(hs_text *page, const char *path, const char *name, hs_error *err)
{
    hs_text bytes = {0};
    hs_status status = read_file(path, &bytes, err);
    if (status == HS_OK) status = hs_text_printf(page, err, "<figure><img src=\"data:%s;base64,", media_type(path));
    if (status == HS_OK) status = put_base64(page, (const unsigned char *)bytes.data, bytes.length, err);
    if (status == HS_OK) status = hs_text_printf(page, err, "\" alt=\"");
    if (status == HS_OK) status = hs_html_text(page, name, err);
    if (status == HS_OK) status = hs_text_printf(page, err, "\"><figcaption>");
    if (status == HS_OK) status = hs_html_text(page, name, err);
    if (status == HS_OK) status = hs_text_printf(page, err, "</figcaption></figure>\n");
    hs_text_fini(&bytes);
    return status;
}
