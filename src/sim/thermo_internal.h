/** What the files sim/thermo*.c share. */
#ifndef HS_SIM_THERMO_INTERNAL_H
#define HS_SIM_THERMO_INTERNAL_H

#include "core/statistics.h"
#include "sim/thermo.h"
#include "style/value.h"

/** One column of the table. */
typedef struct hs_thermo_column {
    const hs_thermo_entry *entry; /**< NULL: a compute, fix or variable */
    char *header;                 /**< owned */
    hs_value value;               /**< which; empty for keywords */
    char *user_format;            /**< owned; thermo_modify format N, or NULL */
    char *format;                 /**< owned; made by init, with one conversion for a long long or a double */
} hs_thermo_column;

typedef enum { HS_THERMO_STYLE_ONE, HS_THERMO_STYLE_MULTI, HS_THERMO_STYLE_CUSTOM } hs_thermo_style;

struct hs_thermo {
    hs_sim *sim; /**< borrowed: the owner */
    int64_t every;
    char *every_variable; /**< owned; thermo v_name, or NULL */
    int64_t next_due;     /**< by that variable */

    hs_thermo_style style;
    hs_thermo_column *column; /**< owned [n_columns] */
    int n_columns;
    size_t capacity_columns;

    /* thermo_modify; reset by thermo_style */
    bool is_modified;
    hs_thermo_lost_mode lost;
    bool lost_warned;
    int norm; /**< -1: by the units */
    bool flush;
    bool is_multi_line;
    bool has_means;
    char *format_line, *format_int, *format_float; /**< owned; NULL: default */
    char *temp_id, *press_id;                      /**< owned; NULL: thermo_temp, thermo_press */

    /* of the present run */
    bool is_norm; /**< energies are divided by n_atoms */
    int64_t n_atoms;
    hs_compute *temp, *press, *pe;                      /**< borrowed until the next init */
    double last_tpcpu_s, last_tpcpu_time, last_spcpu_s; /**< of the row before: cpu seconds, simulated time */
    int64_t last_spcpu_step;

    hs_series_set means; /**< owned; thermo_modify means: of each column, rows of the run after its first */
    double *mean_row;    /**< owned [means.n_series]: the present row */
    hs_line drift;       /**< total energy per atom against time, of the same rows */

    double last_progress_s; /**< sim/report.c: when the progress line was shown last */
    char *neighbor_info;    /**< owned; sim/report.c: the neighbor block printed last */
};

/** Find thermo_temp, thermo_press, thermo_pe (or those of thermo_modify); an error when one is gone. */
HS_MUST_USE hs_status hs_thermo_find_computes(hs_thermo *thermo, hs_error *err);
/** Value of a column at the present step, normalised if it is to be (collective). */
HS_MUST_USE hs_status hs_thermo_column_value(hs_thermo *thermo, const hs_thermo_column *column, double *value,
                                             hs_error *err);
/** Forget the columns and make those of the words (keywords and references). */
HS_MUST_USE hs_status hs_thermo_set_columns(hs_thermo *thermo, const hs_args *args, hs_error *err);
/** Columns of the styles one and multi, the volume only when the box can change. */
HS_MUST_USE hs_status hs_thermo_set_standard_columns(hs_thermo *thermo, hs_error *err);
void hs_thermo_clear_columns(hs_thermo *thermo);
/** Find the computes, fixes and variables of all columns. */
HS_MUST_USE hs_status hs_thermo_resolve_columns(hs_thermo *thermo, hs_error *err);
/** Fill column[].format from thermo_modify's formats. */
HS_MUST_USE hs_status hs_thermo_make_formats(hs_thermo *thermo, hs_error *err);
/** thermo_modify means (sim/thermo_means.c): forget the rows; note column k of a row; take the row in; keep all of them. */
HS_MUST_USE hs_status hs_thermo_means_begin(hs_thermo *thermo, hs_error *err);
void hs_thermo_means_note(hs_thermo *thermo, int k, double value);
HS_MUST_USE hs_status hs_thermo_means_row(hs_thermo *thermo, hs_error *err);
HS_MUST_USE hs_status hs_thermo_means_keep(hs_thermo *thermo, hs_state *state, hs_error *err);
void hs_thermo_means_fini(hs_thermo *thermo);
bool hs_thermo_is_int(const hs_thermo_column *column);

#endif
