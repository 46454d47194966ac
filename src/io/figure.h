/** Figures: curves in panels one above the other, drawn by gnuplot. */
#ifndef HS_IO_FIGURE_H
#define HS_IO_FIGURE_H

#include "io/quantity.h"
#include "io/table.h"

typedef struct hs_curve {
    char *title; /**< owned; in the legend */
    int panel;
    int64_t n;
    double *x, *y; /**< owned [n] */
    double *error; /**< owned [n]; standard errors of y; NULL: none */
} hs_curve;

/** Curves of one quantity share a panel and its vertical axis. */
typedef struct hs_panel {
    char *label; /**< owned; of the vertical axis */
    int n_curves;
} hs_panel;

typedef enum { HS_FIGURE_LINES, HS_FIGURE_POINTS, HS_FIGURE_LINES_AND_POINTS } hs_figure_style;
typedef enum { HS_FIGURE_PNG, HS_FIGURE_SVG, HS_FIGURE_PDF, HS_FIGURE_INLINE_SVG } hs_figure_format;

/** Zero it before use; hs_figure_fini frees what the functions below put in. */
typedef struct hs_figure {
    char *title;   /**< owned; NULL: none */
    char *x_label; /**< owned */
    hs_panel *panel;
    int n_panels;
    hs_curve *curve;
    int n_curves;
    hs_figure_style style;
    bool is_log_x, is_log_y, has_x_range, has_y_range;
    double x_range[2], y_range[2];
    int width, height; /**< pixels; 0: the default, which grows with the panels */
} hs_figure;

void hs_figure_fini(hs_figure *figure);

/** What of a file is drawn. Words are borrowed; NULL: the default. */
typedef struct hs_plot_choice {
    const char *x;      /**< column, by name or number; "time": steps times the timestep */
    const char *y;      /**< columns, names (with * and ?) or numbers between commas */
    const char *errors; /**< columns of standard errors, as many as y; "none": do not draw those found by name */
    const char *block;  /**< of a file with several tables: all, first, last, or the step (of a log: the run) */
} hs_plot_choice;

/** Add the chosen columns of a file as curves. @p label stands for the file in the legend, NULL when it is the only
 *  one. Errors name the column and the nearest there is. */
HS_MUST_USE hs_status hs_figure_add_file(hs_figure *figure, const hs_table_file *file, const char *label,
                                         const hs_plot_choice *choice, const hs_deck_facts *facts, hs_error *err);
/** Add one curve to the panel of that label; arrays are copied, points that are no numbers left out. */
HS_MUST_USE hs_status hs_figure_add_curve(hs_figure *figure, const char *panel_label, const char *title,
                                          const hs_curve *points, hs_error *err);

/** Draw: the picture's bytes are added to @p picture. An error says so when gnuplot is not installed. */
HS_MUST_USE hs_status hs_figure_draw(const hs_figure *figure, hs_figure_format format, hs_text *picture, hs_error *err);
/** Draw into a file, whose name's ending says the format (.png, .svg, .pdf). It appears whole or not at all. */
HS_MUST_USE hs_status hs_figure_write(const hs_figure *figure, const char *path, hs_error *err);
/** Format of a file name; an error for other endings. */
HS_MUST_USE hs_status hs_figure_format_of(const char *path, hs_figure_format *format, hs_error *err);

#endif
