/** What h5md.c and h5md_make.c share. */
#ifndef HS_IO_H5MD_INTERNAL_H
#define HS_IO_H5MD_INTERNAL_H

#include <hdf5.h>

#include "io/h5md.h"
#include "io/part_file.h"

struct hs_h5md {
    char *path;        /**< owned */
    hs_part_file part; /**< the file while it is not whole; none once it has its name */
    bool is_single;    /**< takes its own name only when it is closed */
    bool is_failed;
    hid_t file;
    const hs_h5md_element *element; /**< borrowed */
    const hs_h5md_observable *what; /**< borrowed [n_observables] */
    int n_elements, n_observables;
    hid_t *value;      /**< owned [n_elements] datasets */
    hid_t *observable; /**< owned [n_observables] datasets */
    hid_t step, time, edges, offset, id, species, mass;
    hsize_t n_frames, n_rows;
    bool is_plain;    /**< ids count up from 1: row = id - 1, and no table is needed */
    int64_t *sorted;  /**< owned [2 n_sorted]: id, row, ... in the order of ids, unless is_plain */
    hsize_t n_sorted; /**< less than n_rows: the table must be made anew */
};

/** An error that names the file and, when there was one, the system's reason. */
hs_status hs_h5md_fail(hs_h5md *file, const char *what, hs_error *err);
/** A new file with all its groups and empty datasets. */
HS_MUST_USE hs_status hs_h5md_make(hs_h5md *file, const hs_h5md_plan *plan, hs_error *err);
/** The file takes its name; what had it before is replaced. */
HS_MUST_USE hs_status hs_h5md_take_name(hs_h5md *file, hs_error *err);

#endif
