/* The script that gnuplot draws a figure from. Data stand in it as numbers, names as quoted strings; nothing that
 * comes from outside is ever part of a command, and no file name is in it: gnuplot writes to its standard output. */
#include "io/figure.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "io/gnuplot.h"
#include "io/writer.h"

enum { WIDTH = 900, PANEL_HEIGHT = 260, HEIGHT_MIN = 420, POINTS_MAX = 200, LABEL_FITS = 24 };
/* More points than a picture has columns add nothing but size. */
enum { STRETCHES = 2000, LONG_LINE = 4 * STRETCHES };

/** Eight colours that stay apart for colour-blind eyes and on paper (Okabe and Ito); a grey instead of the yellow,
 *  which white paper swallows. */
static const char *const palette[] = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                      "#56B4E9", "#E69F00", "#7F7F7F", "#5B3A8E"};
enum { PALETTE_SIZE = sizeof palette / sizeof palette[0] };

void hs_figure_fini(hs_figure *figure)
{
    for (int k = 0; k < figure->n_curves; ++k) {
        hs_curve *curve = &figure->curve[k];
        HS_FREE(curve->title);
        HS_FREE(curve->x);
        HS_FREE(curve->y);
        HS_FREE(curve->error);
    }
    for (int k = 0; k < figure->n_panels; ++k) HS_FREE(figure->panel[k].label);
    HS_FREE(figure->curve);
    HS_FREE(figure->panel);
    HS_FREE(figure->title);
    HS_FREE(figure->x_label);
    figure->n_curves = figure->n_panels = 0;
}

static hs_status find_panel(hs_figure *figure, const char *label, int *panel, hs_error *err)
{
    for (*panel = 0; *panel < figure->n_panels; ++*panel)
        if (strcmp(figure->panel[*panel].label, label) == 0) return HS_OK;
    HS_TRY(HS_GROW(figure->panel, (size_t)figure->n_panels, (size_t)figure->n_panels + 1, err));
    figure->panel[figure->n_panels++] = (hs_panel){0};
    return hs_memory_strdup(&figure->panel[*panel].label, label, err);
}

hs_status hs_figure_add_curve(hs_figure *figure, const char *panel_label, const char *title, const hs_curve *points,
                              hs_error *err)
{
    int panel;
    HS_TRY(find_panel(figure, panel_label, &panel, err));
    HS_TRY(HS_GROW(figure->curve, (size_t)figure->n_curves, (size_t)figure->n_curves + 1, err));
    hs_curve *curve = &figure->curve[figure->n_curves++];
    *curve = (hs_curve){.panel = panel};
    ++figure->panel[panel].n_curves;
    HS_TRY(hs_memory_strdup(&curve->title, title, err));
    HS_TRY(HS_ALLOC(curve->x, (size_t)points->n, err));
    HS_TRY(HS_ALLOC(curve->y, (size_t)points->n, err));
    if (points->error != NULL) HS_TRY(HS_ALLOC(curve->error, (size_t)points->n, err));
    for (int64_t i = 0; i < points->n; ++i) {
        const double x = points->x[i], y = points->y[i];
        if (!isfinite(x) || !isfinite(y)) continue;
        if ((figure->is_log_x && x <= 0.0) || (figure->is_log_y && y <= 0.0)) continue; /* not on such an axis */
        curve->x[curve->n] = x;
        curve->y[curve->n] = y;
        if (curve->error != NULL) curve->error[curve->n] = isfinite(points->error[i]) ? points->error[i] : 0.0;
        ++curve->n;
    }
    return HS_OK;
}

/** A string of gnuplot: in single quotes, where nothing is special. A quote in the text ends the string, and is added
 *  to it as a string of its own; gnuplot misreads a doubled quote at the start. */
static hs_status put_string(hs_text *script, const char *text, hs_error *err)
{
    HS_TRY(hs_text_append(script, "'", 1, err));
    for (; *text != '\0'; ++text) {
        if (*text == '\'') {
            HS_TRY(hs_text_printf(script, err, "'.\"\\047\".'"));
            continue;
        }
        const char c = (unsigned char)*text < ' ' || *text == 127 ? ' ' : *text;
        HS_TRY(hs_text_append(script, &c, 1, err));
    }
    return hs_text_append(script, "'", 1, err);
}

static hs_status put_setting(hs_text *script, const char *what, const char *text, hs_error *err)
{
    HS_TRY(hs_text_printf(script, err, "set %s ", what));
    HS_TRY(put_string(script, text, err));
    return hs_text_append(script, "\n", 1, err);
}

static hs_status put_point(hs_text *script, const hs_curve *curve, int64_t i, hs_error *err)
{
    return hs_text_printf(script, err, "%.10g %.10g %.10g\n", curve->x[i], curve->y[i],
                          curve->error != NULL ? curve->error[i] : 0.0);
}

/** A long line as it looks on paper: of each of many short stretches the first point, the least, the greatest. */
static hs_status put_envelope(hs_text *script, const hs_curve *curve, hs_error *err)
{
    for (int64_t k = 0; k < STRETCHES; ++k) {
        const int64_t begin = k * curve->n / STRETCHES, end = (k + 1) * curve->n / STRETCHES;
        int64_t least = begin, greatest = begin;
        for (int64_t i = begin; i < end; ++i) {
            if (curve->y[i] < curve->y[least]) least = i;
            if (curve->y[i] > curve->y[greatest]) greatest = i;
        }
        const int64_t second = least < greatest ? least : greatest, third = least < greatest ? greatest : least;
        HS_TRY(put_point(script, curve, begin, err));
        if (second != begin) HS_TRY(put_point(script, curve, second, err));
        if (third != second) HS_TRY(put_point(script, curve, third, err));
    }
    return put_point(script, curve, curve->n - 1, err);
}

static hs_status put_data(hs_text *script, const hs_figure *figure, hs_error *err)
{
    for (int k = 0; k < figure->n_curves; ++k) {
        const hs_curve *curve = &figure->curve[k];
        const bool is_long = curve->n > LONG_LINE && figure->style == HS_FIGURE_LINES && curve->error == NULL;
        HS_TRY(hs_text_printf(script, err, "$curve%d << END\n", k));
        if (is_long) HS_TRY(put_envelope(script, curve, err));
        for (int64_t i = 0; i < curve->n && !is_long; ++i) HS_TRY(put_point(script, curve, i, err));
        HS_TRY(hs_text_printf(script, err, "END\n"));
    }
    return HS_OK;
}

static hs_status put_terminal(hs_text *script, const hs_figure *figure, hs_figure_format format, hs_error *err)
{
    const int grown = figure->n_panels * PANEL_HEIGHT + 60;
    const int width = figure->width > 0 ? figure->width : WIDTH;
    const int height = figure->height > 0 ? figure->height : grown > HEIGHT_MIN ? grown : HEIGHT_MIN;
    switch (format) {
    case HS_FIGURE_PNG:
        return hs_text_printf(script, err, "set terminal pngcairo noenhanced size %d,%d font 'sans,11'\n", width,
                              height);
    case HS_FIGURE_PDF:
        return hs_text_printf(script, err, "set terminal pdfcairo noenhanced size %.3f,%.3f font 'sans,10'\n",
                              width / 100.0, height / 100.0); /* inches */
    case HS_FIGURE_SVG:
        return hs_text_printf(
            script, err, "set terminal svg noenhanced size %d,%d font 'sans,13' background '#ffffff'\n", width, height);
    default:
        return hs_text_printf(script, err, "set terminal svg noenhanced size %d,%d dynamic font 'sans,13'\n", width,
                              height);
    }
}

static hs_status put_style(hs_text *script, const hs_figure *figure, hs_error *err)
{
    HS_TRY(hs_text_printf(script, err,
                          "set encoding utf8\nset grid linetype 1 linecolor rgb '#d9d9d9' linewidth 0.7\n"
                          "set border 3\nset tics nomirror\nset key outside right top vertical Left reverse samplen 2\n"
                          "set pointsize 0.6\nset bars small\n"));
    for (int k = 0; k < PALETTE_SIZE; ++k)
        HS_TRY(hs_text_printf(script, err, "set linetype %d linecolor rgb '%s' linewidth 1.6 pointtype 7\n", k + 1,
                              palette[k]));
    HS_TRY(hs_text_printf(script, err, "set linetype cycle %d\n", PALETTE_SIZE));
    HS_TRY(hs_text_printf(script, err, "set autoscale xfix\n"));
    if (figure->has_x_range)
        HS_TRY(hs_text_printf(script, err, "set xrange [%.10g:%.10g]\n", figure->x_range[0], figure->x_range[1]));
    if (figure->has_y_range)
        HS_TRY(hs_text_printf(script, err, "set yrange [%.10g:%.10g]\n", figure->y_range[0], figure->y_range[1]));
    return HS_OK;
}

/** A logarithmic axis. gnuplot labels powers of ten only, of which a narrow range may have none: then 1, 2, 5 are
 *  labelled too. */
static hs_status put_log_axis(hs_text *script, char axis, double lo, double hi, hs_error *err)
{
    static const double steps[] = {1.0, 2.0, 5.0};
    const char *separator = "";
    HS_TRY(hs_text_printf(script, err, "set logscale %c\nset %ctics auto\n", axis, axis));
    if (hi > 100.0 * lo) return HS_OK;
    HS_TRY(hs_text_printf(script, err, "set %ctics (", axis));
    for (double decade = pow(10.0, floor(log10(lo))); decade <= hi; decade *= 10.0)
        for (int k = 0; k < 3; ++k, separator = ", ")
            HS_TRY(hs_text_printf(script, err, "%s'%g' %.10g", separator, decade * steps[k], decade * steps[k]));
    return hs_text_printf(script, err, ")\n");
}

/** Smallest and largest value of one panel, or of all (panel < 0); of x or of y. */
static void find_range(const hs_figure *figure, int panel, bool is_x, double *lo, double *hi)
{
    *lo = INFINITY;
    *hi = -INFINITY;
    for (int k = 0; k < figure->n_curves; ++k) {
        const hs_curve *curve = &figure->curve[k];
        if (panel >= 0 && curve->panel != panel) continue;
        for (int64_t i = 0; i < curve->n; ++i) {
            *lo = fmin(*lo, is_x ? curve->x[i] : curve->y[i]);
            *hi = fmax(*hi, is_x ? curve->x[i] : curve->y[i]);
        }
    }
}

static hs_status put_log_axes(hs_text *script, const hs_figure *figure, int panel, hs_error *err)
{
    double lo, hi;
    if (figure->is_log_x) {
        find_range(figure, -1, true, &lo, &hi);
        HS_TRY(put_log_axis(script, 'x', lo, hi, err));
    }
    if (!figure->is_log_y) return HS_OK;
    find_range(figure, panel, false, &lo, &hi);
    HS_TRY(put_log_axis(script, 'y', lo, hi, err));
    if (figure->has_y_range || hi > 100.0 * lo) return HS_OK;
    return hs_text_printf(script, err, "set yrange [%.10g:%.10g]\n", lo / 1.2, hi * 1.2);
}

static hs_status put_curve(hs_text *script, const hs_figure *figure, int k, bool has_legend, hs_error *err)
{
    const hs_curve *curve = &figure->curve[k];
    /* A curve of few points shows where they are. */
    const bool has_points = figure->style != HS_FIGURE_LINES || curve->error != NULL;
    const bool has_lines = figure->style != HS_FIGURE_POINTS;
    const char *with = has_points && has_lines && curve->n <= POINTS_MAX ? "linespoints"
                       : has_lines                                       ? "lines"
                                                                         : "points";
    int in_panel = 0; /* the legend's colours begin anew in each panel */
    for (int other = 0; other < k; ++other) in_panel += figure->curve[other].panel == curve->panel;
    if (curve->error != NULL)
        HS_TRY(hs_text_printf(script, err,
                              "$curve%d using 1:2:3 with yerrorbars linetype %d pointtype 0 linewidth 1 notitle, ", k,
                              in_panel + 1));
    HS_TRY(hs_text_printf(script, err, "$curve%d using 1:2 with %s linetype %d ", k, with, in_panel + 1));
    if (!has_legend) return hs_text_printf(script, err, "notitle");
    HS_TRY(hs_text_printf(script, err, "title "));
    return put_string(script, curve->title, err);
}

static hs_status put_panel(hs_text *script, const hs_figure *figure, int panel, bool has_legend, hs_error *err)
{
    const char *separator = "plot ";
    HS_TRY(put_log_axes(script, figure, panel, err));
    HS_TRY(put_setting(script, "ylabel", figure->panel[panel].label, err));
    /* beside one panel of several a long label finds room in small letters only */
    const bool is_long = figure->n_panels > 1 && strlen(figure->panel[panel].label) > LABEL_FITS;
    HS_TRY(hs_text_printf(script, err, "set ylabel font '%s'\n", is_long ? ",8" : ""));
    if (panel == figure->n_panels - 1 && figure->x_label != NULL)
        HS_TRY(put_setting(script, "xlabel", figure->x_label, err));
    for (int k = 0; k < figure->n_curves; ++k) {
        if (figure->curve[k].panel != panel || figure->curve[k].n == 0) continue;
        HS_TRY(hs_text_printf(script, err, "%s", separator));
        HS_TRY(put_curve(script, figure, k, has_legend, err));
        separator = ", ";
    }
    return hs_text_append(script, "\n", 1, err);
}

/** Every panel must have a point, else gnuplot would stop without saying which. */
static hs_status check_panels(const hs_figure *figure, hs_error *err)
{
    if (figure->n_panels == 0) return hs_fail(err, HS_ERROR_INPUT, "there is nothing to plot");
    for (int panel = 0; panel < figure->n_panels; ++panel) {
        int64_t n = 0;
        for (int k = 0; k < figure->n_curves; ++k) n += figure->curve[k].panel == panel ? figure->curve[k].n : 0;
        if (n == 0)
            return hs_fail(err, HS_ERROR_INPUT, "there is no point to plot for '%s'%s", figure->panel[panel].label,
                           figure->is_log_x || figure->is_log_y ? ": on a logarithmic axis only values above zero are"
                                                                : "");
    }
    return HS_OK;
}

static hs_status make_script(hs_text *script, const hs_figure *figure, hs_figure_format format, hs_error *err)
{
    bool has_legend = false;
    size_t longest = 0; /* text of the legend, characters */
    for (int k = 0; k < figure->n_curves; ++k)
        if (strlen(figure->curve[k].title) > longest) longest = strlen(figure->curve[k].title);
    const int legend_width = (longest < 40 ? (int)longest : 40) + 6;
    for (int panel = 0; panel < figure->n_panels; ++panel) has_legend |= figure->panel[panel].n_curves > 1;
    HS_TRY(put_terminal(script, figure, format, err));
    HS_TRY(put_style(script, figure, err));
    HS_TRY(put_data(script, figure, err));
    const bool is_stacked = figure->n_panels > 1;
    if (is_stacked) {
        /* the same margins in all panels, so that their axes stand above each other */
        HS_TRY(hs_text_printf(script, err, "set lmargin 12\nset rmargin %d\n", has_legend ? legend_width : 3));
        HS_TRY(hs_text_printf(script, err, "set multiplot layout %d,1", figure->n_panels));
        if (figure->title != NULL) {
            HS_TRY(hs_text_printf(script, err, " title "));
            HS_TRY(put_string(script, figure->title, err));
        }
        HS_TRY(hs_text_append(script, "\n", 1, err));
    } else if (figure->title != NULL) {
        HS_TRY(put_setting(script, "title", figure->title, err));
    }
    for (int panel = 0; panel < figure->n_panels; ++panel) HS_TRY(put_panel(script, figure, panel, has_legend, err));
    return is_stacked ? hs_text_printf(script, err, "unset multiplot\n") : HS_OK;
}

hs_status hs_figure_draw(const hs_figure *figure, hs_figure_format format, hs_text *picture, hs_error *err)
{
    hs_text script = {0};
    hs_status status = check_panels(figure, err);
    if (status == HS_OK) status = make_script(&script, figure, format, err);
    if (status == HS_OK) status = hs_gnuplot_run(&script, picture, err);
    hs_text_fini(&script);
    return status;
}

hs_status hs_figure_format_of(const char *path, hs_figure_format *format, hs_error *err)
{
    static const char *const endings[] = {".png", ".svg", ".pdf"};
    const size_t length = strlen(path);
    for (int k = 0; k < 3; ++k)
        if (length > 4 && strcasecmp(path + length - 4, endings[k]) == 0) {
            *format = (hs_figure_format)k;
            return HS_OK;
        }
    return hs_fail(err, HS_ERROR_INPUT, "the picture's name '%s' should end in .png, .svg or .pdf", path);
}

hs_status hs_figure_write(const hs_figure *figure, const char *path, hs_error *err)
{
    hs_figure_format format;
    hs_text picture = {0};
    hs_writer *writer = NULL;
    HS_TRY(hs_figure_format_of(path, &format, err));
    hs_status status = hs_figure_draw(figure, format, &picture, err);
    if (status == HS_OK) status = hs_writer_open(&writer, path, HS_WRITE_WHOLE, err);
    if (status == HS_OK) status = hs_writer_bytes(writer, picture.data, picture.length, err);
    if (status == HS_OK)
        status = hs_writer_close(&writer, err);
    else
        hs_writer_abandon(&writer);
    hs_text_fini(&picture);
    return status;
}
