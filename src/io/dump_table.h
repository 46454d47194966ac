/** What all dump styles share: columns, selection, order, headers, and dump_modify. A dump style's state begins with an
 *  hs_dump_table; the style says which columns a row has and what stands above them. */
#ifndef HS_IO_DUMP_TABLE_H
#define HS_IO_DUMP_TABLE_H

#include "base/text.h"
#include "io/row_stream.h"
#include "io/writer.h"
#include "style/attribute.h"
#include "style/comparison.h"
#include "style/dump.h"
#include "style/region.h"
#include "style/value.h"

/** One value of an atom, or of a row of local values: a column of a row, or the left side of a condition. */
typedef struct hs_dump_column {
    hs_attribute attribute; /**< HS_ATTR_ID of local values: the number of the row */
    char *name;             /**< owned; as in the deck */
    hs_value reference;     /**< of HS_ATTR_VARIABLE */
    double *values;         /**< owned [n_local, or rows]; of a reference, at the present step */
    char *user_format;      /**< owned; dump_modify format N, or NULL */
    char *format;           /**< owned; made by init */
} hs_dump_column;

/** What the left side of a condition was for each atom in the latest snapshot. */
typedef struct hs_dump_last {
    double *values; /**< field of the atoms; not a number: there was no snapshot yet, and the present value serves */
    char *name;     /**< owned; of the field: by it checkpoints find it */
} hs_dump_last;

/** dump_modify thresh: atoms are written only when the comparison holds. */
typedef struct hs_dump_condition {
    hs_dump_column column;
    hs_comparison how;
    double value;
    hs_dump_last *last; /**< owned; takes the place of value; NULL: none */
} hs_dump_condition;

/** How a style lays out its rows: what dump_modify may change. */
typedef struct hs_dump_layout {
    bool has_atom_header; /**< ITEM: lines; false: the two lines of xyz */
    /** Not collective: lines above the rows, where those are neither of the two. */
    HS_MUST_USE hs_status (*write_header)(struct hs_dump *dump, hs_writer *writer, hs_error *err);
    const char *unnamed;      /**< element of types without one; NULL: C, as LAMMPS has it */
    const char *float_format; /**< default; NULL: %g */
    bool is_element_first;    /**< xyz: the first column is a type's number or name, always text */
    bool has_column_formats;  /**< dump_modify format int, float, N */
    bool has_scale_image;     /**< dump_modify scale, image */
    int n_line_columns;       /**< cfg: so many first columns stand on lines of their own, in the default formats */
    double spread; /**< cfg: fractions of the box in the three columns behind those are written relative to the
                                   middle of a box that is so many times as long; 0: as they are */
} hs_dump_layout;

typedef struct hs_dump_table {
    const hs_dump_layout *layout;
    bool is_local;          /**< rows are those of local values (style/local_rows.h), not atoms; set by the style */
    hs_dump_column *column; /**< owned [n_columns] */
    int n_columns;
    hs_text header; /**< names above the columns */

    /* dump_modify */
    char **element; /**< owned [n_types + 1]; NULL: none given */
    int n_elements;
    char *format_line, *format_int, *format_float;
    hs_where where;
    hs_dump_condition *condition;
    int n_conditions;
    int64_t delay; /**< nothing before this step; -1: no delay */
    int pad;
    int64_t max_files; /**< -1: no limit */
    int64_t *recent;   /**< owned [max_files] steps of the files kept, a ring; NULL before the first */
    int64_t n_recent;
    bool is_unsorted, is_descending, has_time, has_units, units_written, no_header;
    int sort_column;           /**< 1 .. n_columns; 0: by id */
    bool is_scaled, has_image; /**< of style atom */
    char *label;               /**< owned; what rows of local values are called; NULL: ENTRIES */

    hs_writer *writer; /**< owned; of a growing file, open from init on; on the first rank only */
    bool is_open;      /**< the first rank has it open; the same on all ranks */
    int32_t *order;    /**< owned; atoms, or rows of local values, of the snapshot being written */
    size_t capacity_order;
    int n_rows;         /**< of this rank */
    int64_t first_row;  /**< of local values: those of the ranks before this one */
    int64_t n_rows_all; /**< of all ranks */
} hs_dump_table;

/** The beginning of ->create: check the words by the style's syntax and take the layout (borrowed for good) and the defaults. */
HS_MUST_USE hs_status hs_dump_table_begin(hs_dump *dump, const hs_args *args, const hs_dump_layout *layout,
                                          hs_error *err);
/** Columns named by words (attributes or references); the former ones are forgotten. */
HS_MUST_USE hs_status hs_dump_set_columns(hs_dump *dump, const hs_args *args, hs_error *err);
/** Fail unless words i to i + n - 1 may be columns, as far as that can be told before anything runs. */
HS_MUST_USE hs_status hs_dump_check_words(const hs_args *args, int i, int n, hs_error *err);
/** The same for rows of local values. */
HS_MUST_USE hs_status hs_dump_check_local_words(const hs_args *args, hs_error *err);
void hs_dump_table_destroy(hs_dump *dump);
/** Forget the conditions of dump_modify thresh. */
void hs_dump_clear_conditions(hs_dump *dump);
/** Before a run: find the region, make the formats, open a growing file. */
HS_MUST_USE hs_status hs_dump_table_init(hs_dump *dump, hs_error *err);
int64_t hs_dump_table_position(const hs_dump *dump);
/** keep_state: which files dump_modify maxfiles will remove. */
HS_MUST_USE hs_status hs_dump_table_keep(hs_dump *dump, hs_state *state, hs_error *err);
/** Write a snapshot of the present step (collective). */
HS_MUST_USE hs_status hs_dump_table_write(hs_dump *dump, hs_error *err);

/** Write the file of the present step, whole or not at all, by @p write, which all ranks call: the first one with the
 *  writer, the others with NULL. Older files beyond dump_modify maxfiles go. Collective, errors agreed. */
HS_MUST_USE hs_status hs_dump_write_step_file(hs_dump *dump,
                                              hs_status (*write)(hs_dump *dump, hs_writer *writer, hs_error *err),
                                              hs_error *err);

/** All words of dump_modify after the ID, for any style. */
HS_MUST_USE hs_status hs_dump_modify(hs_dump *dump, const hs_args *args, hs_error *err);
/** The same for one keyword and what follows it: hs_dump_style.modify of all styles. */
HS_MUST_USE hs_status hs_dump_table_modify(hs_dump *dump, const hs_args *args, int *n_used, hs_error *err);
extern const hs_keyword hs_dump_modify_keywords[];

/* Shared by the files io/dump_*.c */
HS_MUST_USE hs_status hs_dump_parse_column(const char *word, hs_dump_column *column, hs_error *err);
/** The same for rows of local values: `index` and references to computes and fixes. */
HS_MUST_USE hs_status hs_dump_parse_local_column(const char *word, hs_dump_column *column, hs_error *err);
/** Shape of columns that are references. */
static inline hs_value_shape hs_dump_shape(const hs_dump_table *table)
{
    return table->is_local ? HS_VALUE_LOCAL : HS_VALUE_ATOMS;
}
void hs_dump_fini_column(hs_dump_column *column);
bool hs_dump_is_int(const hs_dump_column *column);
/** Its name without brackets, c_s_1 for c_s[1], for headers in which they mean something else. */
HS_MUST_USE hs_status hs_dump_write_name(const hs_dump_column *column, hs_writer *writer, hs_error *err);
/** Value of an attribute of atom i, or of row i of local values; positions and images wrapped into the box when dump_modify pbc
 *  asks for it. */
double hs_dump_value(const hs_dump *dump, const hs_dump_column *column, int i);
/** What row k of a snapshot is sorted by; context is the dump. */
hs_row_key hs_dump_key(const void *context, int64_t k);
/** Fill table->order with the local atoms, or rows of local values, to write, in the order asked for, and n_rows. Collective. */
HS_MUST_USE hs_status hs_dump_select(hs_dump *dump, hs_error *err);

#endif
