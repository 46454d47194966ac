/** A growing H5MD 1.1 file (https://www.nongnu.org/h5md). Used by rank 0 alone: nothing here is collective.
 *
 *  Reference: P. de Buyl, P. H. Colberg, F. Hoefling, Comput. Phys. Commun. 185, 1546 (2014),
 *  doi:10.1016/j.cpc.2014.01.018 */
#ifndef HS_IO_H5MD_H
#define HS_IO_H5MD_H

#include <stdint.h>

#include "core/box.h"
#include "core/units.h"

/** A quantity of atoms, one value or vector a row. */
typedef struct hs_h5md_element {
    const char *name; /**< "position", ... */
    int n_columns;    /**< 1 or 3 */
    bool is_integer;  /**< int32_t, else double */
    const char *unit; /**< attribute; NULL or "": none */
} hs_h5md_element;

/** A number, vector or array of the whole system. */
typedef struct hs_h5md_observable {
    const char *name; /**< as in the deck: c_thermo_press; borrowed as long as the file is open */
    int rank;         /**< 0: a number; 1: a vector; 2: an array */
    int n[2];         /**< lengths; 1 beyond the rank */
} hs_h5md_observable;

/** What a file holds. Borrowed by hs_h5md_open for its call, except element and observable: as long as the file is
 *  open. */
typedef struct hs_h5md_plan {
    const hs_h5md_element *element; /**< [n_elements] that change with time; the first is named in box/edges */
    int n_elements;
    const hs_h5md_observable *observable; /**< [n_observables] that change with time */
    int n_observables;
    const hs_box *box;
    const hs_units *units;
    const char *length_unit, *time_unit; /**< attributes; NULL: none */
    const char *version, *build, *deck;  /**< texts for /parameters; NULL: not known */
    int64_t n_rows;                      /**< atoms at first: decides the size of chunks */
    int deflate;                         /**< level 0 to 9 */
    bool is_single;                      /**< one snapshot: the file takes its name when it is closed */
    bool append;                         /**< go on with the file when it is there */
    int64_t step;                        /**< the present one */
    bool drops_later; /**< when appending: frames of later steps are dropped, else they are an error */
} hs_h5md_plan;

/** What belongs to the rows, whatever the time: fixed elements. */
typedef struct hs_h5md_rows {
    const int64_t *id;
    const int32_t *species;
    const double *mass;
} hs_h5md_rows;

typedef struct hs_h5md hs_h5md;

/** Make the file, or open it to append. A file that holds something else than the plan says is an error. */
HS_MUST_USE hs_status hs_h5md_open(hs_h5md **file, const char *path, const hs_h5md_plan *plan, hs_error *err);
/** Rows that were given to atoms. */
int64_t hs_h5md_n_rows(const hs_h5md *file);
/** Make hs_h5md_row right after rows were set. */
HS_MUST_USE hs_status hs_h5md_index(hs_h5md *file, hs_error *err);
/** Row of an atom, -1 when it has none. */
int64_t hs_h5md_row(const hs_h5md *file, int64_t id);
/** Give rows [first, first + n) to atoms; makes room for them. Earlier frames have fill values there. */
HS_MUST_USE hs_status hs_h5md_set_rows(hs_h5md *file, int64_t first, int64_t n, const hs_h5md_rows *rows,
                                       hs_error *err);

/** Frame: begin, rows and observables in any order, end. After an error the file must be closed; it is then as it was
 *  at the last hs_h5md_end_frame. */
HS_MUST_USE hs_status hs_h5md_begin_frame(hs_h5md *file, int64_t step, double time, const hs_box *box, hs_error *err);
HS_MUST_USE hs_status hs_h5md_put_rows(hs_h5md *file, int element, int64_t first, int64_t n, const void *values,
                                       hs_error *err);
HS_MUST_USE hs_status hs_h5md_put_observable(hs_h5md *file, int observable, const double *values, hs_error *err);
/** The frame is in the file from here on, and survives a kill of the process. */
HS_MUST_USE hs_status hs_h5md_end_frame(hs_h5md *file, hs_error *err);
/** Close; NULL is fine. */
HS_MUST_USE hs_status hs_h5md_close(hs_h5md **file, hs_error *err);

#endif
