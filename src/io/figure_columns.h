/** Which columns of a table are drawn, and what they are drawn against. */
#ifndef HS_IO_FIGURE_COLUMNS_H
#define HS_IO_FIGURE_COLUMNS_H

#include "io/figure.h"

/** The horizontal axis of one table. */
typedef struct hs_figure_axis {
    int column;
    double factor; /**< timestep where steps become times */
} hs_figure_axis;

/** The column that was asked for; "time" stands for steps times the timestep. Else the one that rows of such a file go
 *  along. */
HS_MUST_USE hs_status hs_figure_choose_x(const hs_table_file *file, const hs_table *table, const hs_plot_choice *choice,
                                         const hs_deck_facts *facts, hs_figure_axis *x, hs_error *err);

/** Columns to draw, in the order asked for. */
typedef struct hs_figure_columns {
    int *column; /**< owned [capacity], one for each column of the table */
    int n;
} hs_figure_columns;

/** Columns that were asked for, or all that measure something; @p x is not drawn against itself. */
HS_MUST_USE hs_status hs_figure_choose_y(const hs_table_file *file, const hs_table *table, const hs_plot_choice *choice,
                                         int x, hs_figure_columns *list, hs_error *err);

/** Column of errors for the curve number @p number of column y: named in -errors, else found by its name; -1: none. */
HS_MUST_USE hs_status hs_figure_choose_errors(const hs_table_file *file, const hs_table *table,
                                              const hs_plot_choice *choice, int y, int number, int *column,
                                              hs_error *err);

#endif
