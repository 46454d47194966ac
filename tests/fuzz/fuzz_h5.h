/** For fuzzers of readers of HDF5 files: a true file, in which numbers are changed, so that what stands behind HDF5 is tested
 *  and not HDF5. */
#ifndef HS_FUZZ_FUZZ_H5_H
#define HS_FUZZ_FUZZ_H5_H

#include <hdf5.h>

#include "fuzz.h"

enum { HS_FUZZ_NAME_SIZE = 512, HS_FUZZ_SETS_MAX = 256 };

static uint8_t *hs_fuzz_whole; /**< the true file */
static size_t hs_fuzz_n_whole;
static char hs_fuzz_sets[HS_FUZZ_SETS_MAX][HS_FUZZ_NAME_SIZE]; /**< its datasets of numbers */
static size_t hs_fuzz_n_sets;

static inline herr_t hs_fuzz_note_set(hid_t file, const char *name, const H5O_info_t *info, void *context)
{
    (void)context;
    if (info->type != H5O_TYPE_DATASET || hs_fuzz_n_sets == HS_FUZZ_SETS_MAX) return 0;
    const hid_t set = H5Dopen2(file, name, H5P_DEFAULT), type = H5Dget_type(set);
    if (H5Tget_class(type) != H5T_STRING) snprintf(hs_fuzz_sets[hs_fuzz_n_sets++], HS_FUZZ_NAME_SIZE, "%s", name);
    H5Tclose(type);
    H5Dclose(set);
    return 0;
}

/** Remember a file as the true one. */
static inline void hs_fuzz_h5_take(const char *name)
{
    FILE *file = fopen(name, "rb");
    if (file == NULL || fseek(file, 0, SEEK_END) != 0) abort();
    hs_fuzz_n_whole = (size_t)ftell(file);
    rewind(file);
    hs_fuzz_whole = malloc(hs_fuzz_n_whole);
    if (hs_fuzz_whole == NULL || fread(hs_fuzz_whole, 1, hs_fuzz_n_whole, file) != hs_fuzz_n_whole) abort();
    fclose(file);
    const hid_t h5 = H5Fopen(name, H5F_ACC_RDONLY, H5P_DEFAULT);
    if (h5 < 0 || H5Ovisit(h5, H5_INDEX_NAME, H5_ITER_INC, hs_fuzz_note_set, NULL) < 0) abort();
    H5Fclose(h5);
}

/** Nine bytes: the dataset, and the bits that one of its elements gets; their low byte also chooses the element. */
static inline void hs_fuzz_h5_change(hid_t file, const uint8_t *bytes)
{
    const hid_t set = H5Dopen2(file, hs_fuzz_sets[bytes[0] % hs_fuzz_n_sets], H5P_DEFAULT), type = H5Dget_type(set);
    const hid_t space = H5Dget_space(set);
    const size_t n = (size_t)H5Sget_simple_extent_npoints(space), size = H5Tget_size(type);
    uint8_t *values = calloc(n + 1, size);
    if (n > 0 && H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0) {
        memcpy(values + (bytes[1] % n) * size, bytes + 1, size < 8 ? size : 8);
        if (H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0) abort();
    }
    free(values);
    H5Sclose(space);
    H5Tclose(type);
    H5Dclose(set);
}

/** Write the true file, changed as the bytes say, under another name. */
static inline void hs_fuzz_h5_make(const char *name, const uint8_t *data, size_t size)
{
    hs_fuzz_write(name, hs_fuzz_whole, hs_fuzz_n_whole);
    const hid_t file = H5Fopen(name, H5F_ACC_RDWR, H5P_DEFAULT);
    if (file < 0) abort();
    for (size_t at = 0; at + 9 <= size; at += 9) hs_fuzz_h5_change(file, data + at);
    H5Fclose(file);
}

#endif
