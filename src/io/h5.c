#include "io/h5.h"

#include <string.h>

static hid_t file_type(hid_t type)
{
    if (H5Tequal(type, H5T_NATIVE_DOUBLE) > 0) return H5T_IEEE_F64LE;
    if (H5Tequal(type, H5T_NATIVE_FLOAT) > 0) return H5T_IEEE_F32LE;
    if (H5Tequal(type, H5T_NATIVE_INT64) > 0) return H5T_STD_I64LE;
    if (H5Tequal(type, H5T_NATIVE_INT32) > 0) return H5T_STD_I32LE;
    if (H5Tequal(type, H5T_NATIVE_UINT32) > 0) return H5T_STD_U32LE;
    if (H5Tequal(type, H5T_NATIVE_UINT8) > 0) return H5T_STD_U8LE;
    return type;
}

/** The caller closes it. */
static hid_t text_type(const char *text)
{
    const size_t n = strlen(text);
    const hid_t type = H5Tcopy(H5T_C_S1);
    if (type >= 0) {
        H5Tset_size(type, n > 0 ? n : 1);
        H5Tset_strpad(type, H5T_STR_NULLPAD);
        for (const char *at = text; *at != '\0'; ++at)
            if ((unsigned char)*at >= 0x80) H5Tset_cset(type, H5T_CSET_UTF8);
    }
    return type;
}

bool hs_h5_put_text_attribute(hid_t at, const char *name, const char *text)
{
    const hid_t type = text_type(text), space = H5Screate(H5S_SCALAR);
    const hid_t attribute = H5Acreate2(at, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
    const bool is_fine = attribute >= 0 && H5Awrite(attribute, type, text) >= 0;
    H5Aclose(attribute);
    H5Sclose(space);
    H5Tclose(type);
    return is_fine;
}

bool hs_h5_put_int_attributes(hid_t at, const char *name, const int32_t *values, int n)
{
    const hsize_t size = (hsize_t)n;
    const hid_t space = n == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &size, NULL);
    const hid_t attribute = H5Acreate2(at, name, H5T_STD_I32LE, space, H5P_DEFAULT, H5P_DEFAULT);
    const bool is_fine = attribute >= 0 && H5Awrite(attribute, H5T_NATIVE_INT32, values) >= 0;
    H5Aclose(attribute);
    H5Sclose(space);
    return is_fine;
}

bool hs_h5_get_int_attribute(hid_t at, const char *name, int64_t *value)
{
    const hid_t attribute = H5Aopen(at, name, H5P_DEFAULT), space = attribute >= 0 ? H5Aget_space(attribute) : -1;
    const bool is_fine =
        space >= 0 && H5Sget_simple_extent_npoints(space) == 1 && H5Aread(attribute, H5T_NATIVE_INT64, value) >= 0;
    H5Sclose(space);
    H5Aclose(attribute);
    return is_fine;
}

hid_t hs_h5_dataset_list(void)
{
    const hid_t create = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_obj_track_times(create, false);
    return create;
}

bool hs_h5_put_text(hid_t at, const char *name, const char *text)
{
    const hid_t type = text_type(text), space = H5Screate(H5S_SCALAR), create = hs_h5_dataset_list();
    const hid_t dataset = H5Dcreate2(at, name, type, space, H5P_DEFAULT, create, H5P_DEFAULT);
    const bool is_fine = dataset >= 0 && H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text) >= 0;
    H5Dclose(dataset);
    H5Pclose(create);
    H5Sclose(space);
    H5Tclose(type);
    return is_fine;
}

bool hs_h5_put_values(hid_t at, const char *name, hid_t type, const void *values, hsize_t n)
{
    const hid_t space = n == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &n, NULL);
    const hid_t create = hs_h5_dataset_list();
    const hid_t dataset = H5Dcreate2(at, name, file_type(type), space, H5P_DEFAULT, create, H5P_DEFAULT);
    const bool is_fine =
        dataset >= 0 && (n == 0 || H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0);
    H5Dclose(dataset);
    H5Pclose(create);
    H5Sclose(space);
    return is_fine;
}

hid_t hs_h5_group(hid_t at, const char *name) { return H5Gcreate2(at, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT); }

hid_t hs_h5_dataset(hid_t at, const char *name, const hs_h5_shape *shape)
{
    hsize_t most[3] = {H5S_UNLIMITED, shape->now[1], shape->now[2]};
    if (shape->grows_twice) most[1] = H5S_UNLIMITED;
    const hid_t space = H5Screate_simple(shape->rank, shape->now, most);
    const hid_t create = hs_h5_dataset_list(), use = H5Pcreate(H5P_DATASET_ACCESS);
    hsize_t chunk_bytes = H5Tget_size(shape->type);
    for (int k = 0; k < shape->rank; ++k) chunk_bytes *= shape->chunk[k];
    H5Pset_chunk(create, shape->rank, shape->chunk);
    if (shape->fill != NULL) H5Pset_fill_value(create, shape->type, shape->fill);
    if (shape->deflate > 0) {
        H5Pset_shuffle(create);
        H5Pset_deflate(create, (unsigned)shape->deflate);
    }
    /* Large chunks are written whole, once: no copy of them in a cache. */
    if (chunk_bytes > 65536 && shape->deflate == 0) H5Pset_chunk_cache(use, 0, 0, 1.0);
    const hid_t dataset = H5Dcreate2(at, name, file_type(shape->type), space, H5P_DEFAULT, create, use);
    H5Pclose(use);
    H5Pclose(create);
    H5Sclose(space);
    return dataset;
}

static bool move_block(hid_t dataset, hid_t type, int rank, const hsize_t *start, const hsize_t *count, void *read_to,
                       const void *write_from)
{
    const hid_t all = H5Dget_space(dataset), block = H5Screate_simple(rank, count, NULL);
    bool is_fine = H5Sselect_hyperslab(all, H5S_SELECT_SET, start, NULL, count, NULL) >= 0;
    if (is_fine && read_to != NULL) is_fine = H5Dread(dataset, type, block, all, H5P_DEFAULT, read_to) >= 0;
    if (is_fine && write_from != NULL) is_fine = H5Dwrite(dataset, type, block, all, H5P_DEFAULT, write_from) >= 0;
    H5Sclose(block);
    H5Sclose(all);
    return is_fine;
}

bool hs_h5_write_block(hid_t dataset, hid_t type, int rank, const hsize_t *start, const hsize_t *count,
                       const void *values)
{
    return move_block(dataset, type, rank, start, count, NULL, values);
}

bool hs_h5_is_plain(hid_t dataset, hid_t type)
{
    const hid_t create = H5Dget_create_plist(dataset), in_file = H5Dget_type(dataset);
    const bool is_plain = H5Pget_nfilters(create) == 0 && H5Tequal(in_file, type) > 0;
    H5Tclose(in_file);
    H5Pclose(create);
    return is_plain;
}

bool hs_h5_write_chunk(hid_t dataset, const hsize_t *start, size_t n_bytes, const void *values)
{
    return H5Dwrite_chunk(dataset, H5P_DEFAULT, 0, start, n_bytes, values) >= 0;
}

bool hs_h5_read_block(hid_t dataset, hid_t type, int rank, const hsize_t *start, const hsize_t *count, void *values)
{
    return move_block(dataset, type, rank, start, count, values, NULL);
}

int hs_h5_extents(hid_t dataset, hsize_t *extents)
{
    const hid_t space = H5Dget_space(dataset);
    int rank = space >= 0 ? H5Sget_simple_extent_ndims(space) : -1;
    if (rank > 3) rank = -1;
    if (rank > 0) H5Sget_simple_extent_dims(space, extents, NULL);
    H5Sclose(space);
    return rank;
}

bool hs_h5_has(hid_t at, const char *path)
{
    char part[256];
    for (const char *end = path; *end != '\0';) {
        end = strchr(end + 1, '/') != NULL ? strchr(end + 1, '/') : path + strlen(path);
        const size_t n = (size_t)(end - path);
        if (n >= sizeof part) return false;
        memcpy(part, path, n);
        part[n] = '\0';
        if (H5Lexists(at, part, H5P_DEFAULT) <= 0) return false;
    }
    return H5Oexists_by_name(at, path, H5P_DEFAULT) > 0;
}

hs_h5_quiet hs_h5_be_quiet(void)
{
    hs_h5_quiet quiet = {0};
    H5Eget_auto2(H5E_DEFAULT, &quiet.function, &quiet.data);
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
    return quiet;
}

void hs_h5_end_quiet(hs_h5_quiet *quiet) { H5Eset_auto2(H5E_DEFAULT, quiet->function, quiet->data); }
