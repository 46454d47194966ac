/** Short forms of what is done with HDF5 again and again. Only folder io/ includes this. All functions are local; < 0
 *  or false is a failure, of which the caller makes a message. */
#ifndef HS_IO_H5_H
#define HS_IO_H5_H

#include <hdf5.h>
#include <stdbool.h>
#include <stdint.h>

/** Fixed-length strings, without a zero at their end when they fill it: what all readers understand. */
bool hs_h5_put_text_attribute(hid_t at, const char *name, const char *text);
bool hs_h5_put_int_attributes(hid_t at, const char *name, const int32_t *values, int n);
/** False when there is no such attribute, or it is not one whole number. */
bool hs_h5_get_int_attribute(hid_t at, const char *name, int64_t *value);
/** How datasets are made: without the time when, so that the same run gives the same file, byte for byte. The caller closes it. */
hid_t hs_h5_dataset_list(void);
/** A dataset of one string. */
bool hs_h5_put_text(hid_t at, const char *name, const char *text);
/** A dataset of one value, or a list. @p type is the type in memory; the file's is the same, little-endian. */
bool hs_h5_put_values(hid_t at, const char *name, hid_t type, const void *values, hsize_t n);
/** A new group; the caller closes it. */
hid_t hs_h5_group(hid_t at, const char *name);

/** How a dataset that grows is made. */
typedef struct hs_h5_shape {
    hid_t type; /**< in memory; the file's is the same, little-endian */
    int rank;   /**< 1 to 3; the first dimension may grow, also the second when rank > 2 or grows_twice */
    hsize_t now[3], chunk[3];
    bool grows_twice;
    const void *fill;
    int deflate; /**< level, 0: not compressed */
} hs_h5_shape;

/** A new chunked dataset; the caller closes it. Intermediate groups must exist. */
hid_t hs_h5_dataset(hid_t at, const char *name, const hs_h5_shape *shape);
/** Write a block at @p start of @p count elements. */
bool hs_h5_write_block(hid_t dataset, hid_t type, int rank, const hsize_t *start, const hsize_t *count,
                       const void *values);
/** Whether hs_h5_write_chunk can be used: the dataset is not compressed, and numbers in memory are as in the file. */
bool hs_h5_is_plain(hid_t dataset, hid_t type);
/** Write a whole chunk as it is, past HDF5's own buffers: parts beyond the dataset's extents must hold fill values. */
bool hs_h5_write_chunk(hid_t dataset, const hsize_t *start, size_t n_bytes, const void *values);
bool hs_h5_read_block(hid_t dataset, hid_t type, int rank, const hsize_t *start, const hsize_t *count, void *values);
/** Extents of a dataset; its rank, or -1. At most 3 dimensions. */
int hs_h5_extents(hid_t dataset, hsize_t *extents);
/** Whether there is a link of that name (also a path: every part is looked for). */
bool hs_h5_has(hid_t at, const char *path);

/** HDF5 prints its errors by default; between these two it does not. */
typedef struct hs_h5_quiet {
    H5E_auto2_t function;
    void *data;
} hs_h5_quiet;
hs_h5_quiet hs_h5_be_quiet(void);
void hs_h5_end_quiet(hs_h5_quiet *quiet);

#endif
