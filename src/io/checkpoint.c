/* Checkpoint files: the container, its text at the head, sections of values. Atoms are in checkpoint_atoms.c. */
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include "base/memory.h"
#include "io/checkpoint_internal.h"
#include "io/h5.h"
#include "io/h5_driver.h"

enum { HEAD_SIZE = 512 };
static const char magic[] = "Halfshell checkpoint\n";

hs_status hs_checkpoint_fail(const hs_checkpoint *self, const char *what, hs_error *err)
{
    const int error = self->file >= 0 ? hs_h5_driver_errno(self->file) : 0;
    return hs_fail(err, HS_ERROR_IO, "the checkpoint '%s' could not be %s%s%s", self->path, what,
                   error != 0 ? ": " : "", error != 0 ? strerror(error) : "");
}

static hs_status damaged(const hs_checkpoint *self, const char *what, hs_error *err)
{
    return hs_fail(err, HS_ERROR_INPUT,
                   "'%s' is no whole checkpoint: %s. Use an earlier one (the command 'checkpoint' keeps several)",
                   self->path, what);
}

/* ---- The text at the head ---- */

/** CRC-32 of a file behind its head. */
static bool digest(int fd, uint32_t *crc)
{
    enum { PART = 1 << 20 };
    unsigned char *bytes = malloc(PART);
    off_t at = HEAD_SIZE;
    ssize_t n = -1;
    uLong sum = crc32(0, NULL, 0);
    while (bytes != NULL && (n = pread(fd, bytes, PART, at)) != 0) {
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) break;
        sum = crc32(sum, bytes, (uInt)n);
        at += n;
    }
    free(bytes);
    *crc = (uint32_t)sum;
    return n == 0;
}

static hs_status write_head(const hs_checkpoint *self, hs_error *err)
{
    struct stat info;
    uint32_t crc;
    char head[HEAD_SIZE];
    memset(head, ' ', sizeof head);
    const int fd = open(self->part.path, O_RDWR);
    bool is_fine = fd >= 0 && fstat(fd, &info) == 0 && digest(fd, &crc);
    if (is_fine) {
        const int n = snprintf(head, sizeof head,
                               "%sformat %d\nbytes %lld\ncrc32 %08x\nversion %s\n\nAn HDF5 file follows. To go on from "
                               "here: halfshell resume FILE\n",
                               magic, HS_CHECKPOINT_FORMAT, (long long)info.st_size, crc, HALFSHELL_VERSION);
        head[n] = ' ';
        head[HEAD_SIZE - 1] = '\n';
        is_fine = pwrite(fd, head, sizeof head, 0) == HEAD_SIZE && fsync(fd) == 0;
    }
    const int error = errno;
    if (fd >= 0 && close(fd) != 0) is_fine = false;
    if (is_fine) return HS_OK;
    return hs_fail(err, HS_ERROR_IO, "the checkpoint '%s' could not be written: %s", self->path, strerror(error));
}

static hs_status check_head(const hs_checkpoint *self, int fd, hs_error *err)
{
    char head[HEAD_SIZE + 1] = "";
    int format = 0;
    long long size = 0;
    unsigned wanted = 0;
    uint32_t crc;
    struct stat info;
    if (fstat(fd, &info) != 0 || !S_ISREG(info.st_mode)) return damaged(self, "it is not a file", err);
    if (pread(fd, head, HEAD_SIZE, 0) != HEAD_SIZE) return damaged(self, "it is too short", err);
    if (strncmp(head, magic, sizeof magic - 1) != 0)
        return hs_fail(
            err, HS_ERROR_INPUT,
            "'%s' was not written by write_restart or checkpoint of this program. From a restart file of LAMMPS "
            "atoms come by way of a data file: write_data there, read_data here",
            self->path);
    if (sscanf(head + sizeof magic - 1, "format %d\nbytes %lld\ncrc32 %x", &format, &size, &wanted) != 3 || format < 1)
        return damaged(self, "its first lines are damaged", err);
    if (format > HS_CHECKPOINT_FORMAT)
        return hs_fail(err, HS_ERROR_INPUT,
                       "'%s' has checkpoint format %d; this version reads formats up to %d. A later version of "
                       "Halfshell wrote it and is needed to read it",
                       self->path, format, HS_CHECKPOINT_FORMAT);
    if (format < HS_CHECKPOINT_FORMAT_OLDEST)
        return hs_fail(err, HS_ERROR_INPUT,
                       "'%s' has checkpoint format %d; this version reads formats from %d on. The version that wrote "
                       "it, named in its first lines, can go on from it",
                       self->path, format, HS_CHECKPOINT_FORMAT_OLDEST);
    if (size != (long long)info.st_size) return damaged(self, "bytes are missing or too many", err);
    if (!digest(fd, &crc) || crc != wanted) return damaged(self, "its checksum is wrong, so bytes have changed", err);
    return HS_OK;
}

/* ---- Files ---- */

static hs_status create_file(hs_checkpoint *self, hs_error *err)
{
    HS_TRY(hs_part_file_make(&self->part, self->path, err));
    const hid_t list = hs_h5_driver_list(), create = H5Pcreate(H5P_FILE_CREATE);
    H5Pset_userblock(create, HEAD_SIZE);
    hs_h5_quiet quiet = hs_h5_be_quiet();
    errno = 0;
    self->file = H5Fcreate(self->part.path, H5F_ACC_TRUNC, create, list);
    const int error = errno;
    hs_h5_end_quiet(&quiet);
    H5Pclose(create);
    H5Pclose(list);
    if (self->file >= 0) return HS_OK;
    return hs_fail(err, HS_ERROR_IO, "the checkpoint '%s' could not be opened for writing: %s", self->path,
                   error != 0 ? strerror(error) : "HDF5 gives no reason");
}

static hs_status make(hs_checkpoint **checkpoint, const char *path, const hs_parallel *parallel, hs_error *err)
{
    HS_TRY(HS_ALLOC(*checkpoint, 1, err));
    (*checkpoint)->file = -1;
    (*checkpoint)->parallel = *parallel;
    return hs_memory_strdup(&(*checkpoint)->path, path, err);
}

hs_status hs_checkpoint_create(hs_checkpoint **checkpoint, const char *path, const hs_parallel *parallel, hs_error *err)
{
    hs_status status = make(checkpoint, path, parallel, err);
    if (status == HS_OK && parallel->rank == 0) (void)!create_file(*checkpoint, err);
    status = hs_parallel_agree(parallel, err);
    if (status != HS_OK) hs_checkpoint_destroy(checkpoint);
    return status;
}

static hs_status commit(hs_checkpoint *self, hs_error *err)
{
    hs_h5_quiet quiet = hs_h5_be_quiet();
    const bool is_flushed = H5Fflush(self->file, H5F_SCOPE_LOCAL) >= 0;
    hs_status status = is_flushed ? HS_OK : hs_checkpoint_fail(self, "written", err);
    H5Fclose(self->file);
    self->file = -1;
    hs_h5_end_quiet(&quiet);
    if (status == HS_OK) status = write_head(self, err);
    return status == HS_OK ? hs_part_file_finish(&self->part, err) : status;
}

hs_status hs_checkpoint_commit(hs_checkpoint **checkpoint, hs_error *err)
{
    const hs_parallel copy = (*checkpoint)->parallel, *const parallel = &copy;
    if (parallel->rank == 0) (void)!commit(*checkpoint, err);
    hs_checkpoint_destroy(checkpoint);
    return hs_parallel_agree(parallel, err);
}

static hs_status open_file(hs_checkpoint *self, hs_error *err)
{
    const int fd = open(self->path, O_RDONLY);
    if (fd < 0)
        return hs_fail(err, HS_ERROR_INPUT, "the checkpoint '%s' cannot be read: %s", self->path, strerror(errno));
    const hs_status status = check_head(self, fd, err);
    close(fd);
    HS_TRY(status);
    hs_h5_quiet quiet = hs_h5_be_quiet();
    self->file = H5Fopen(self->path, H5F_ACC_RDONLY, H5P_DEFAULT);
    hs_h5_end_quiet(&quiet);
    return self->file >= 0 ? HS_OK : damaged(self, "HDF5 cannot open it", err);
}

hs_status hs_checkpoint_open(hs_checkpoint **checkpoint, const char *path, const hs_parallel *parallel, hs_error *err)
{
    hs_status status = make(checkpoint, path, parallel, err);
    if (status == HS_OK && parallel->rank == 0) (void)!open_file(*checkpoint, err);
    status = hs_parallel_agree(parallel, err);
    if (status != HS_OK) hs_checkpoint_destroy(checkpoint);
    return status;
}

void hs_checkpoint_destroy(hs_checkpoint **checkpoint)
{
    if (*checkpoint == NULL) return;
    hs_checkpoint *self = *checkpoint;
    hs_h5_quiet quiet = hs_h5_be_quiet();
    if (self->file >= 0) H5Fclose(self->file);
    hs_h5_end_quiet(&quiet);
    hs_part_file_abandon(&self->part);
    HS_FREE(self->path);
    HS_FREE(*checkpoint);
}

/* ---- Sections ---- */

/** Groups along a path are made where they are missing. */
static hid_t make_group(hid_t file, const char *section)
{
    const hid_t links = H5Pcreate(H5P_LINK_CREATE);
    H5Pset_create_intermediate_group(links, 1);
    const hid_t group = H5Gcreate2(file, section, links, H5P_DEFAULT, H5P_DEFAULT);
    H5Pclose(links);
    return group;
}

static bool put_state(hid_t file, const char *section, const hs_state *state)
{
    const hid_t group = make_group(file, section);
    bool is_fine = group >= 0;
    for (int k = 0; k < state->n_values && is_fine; ++k) {
        const hs_state_value *value = &state->value[k];
        if (value->kind == HS_STATE_TEXT)
            is_fine = hs_h5_put_text(group, value->name, value->data);
        else
            is_fine = hs_h5_put_values(group, value->name,
                                       value->kind == HS_STATE_INTEGER ? H5T_NATIVE_INT64 : H5T_NATIVE_DOUBLE,
                                       value->data, (hsize_t)value->n);
    }
    H5Gclose(group);
    return is_fine;
}

hs_status hs_checkpoint_put(hs_checkpoint *self, const char *section, const hs_state *state, hs_error *err)
{
    if (self->parallel.rank == 0) {
        hs_h5_quiet quiet = hs_h5_be_quiet();
        if (!put_state(self->file, section, state)) (void)hs_checkpoint_fail(self, "written", err);
        hs_h5_end_quiet(&quiet);
    }
    return hs_parallel_agree(&self->parallel, err);
}

static hs_status get_value(const hs_checkpoint *self, hid_t group, const char *name, hs_state *state, hs_error *err)
{
    const hid_t dataset = H5Dopen2(group, name, H5P_DEFAULT), type = H5Dget_type(dataset);
    const hid_t space = H5Dget_space(dataset);
    const H5T_class_t kind = H5Tget_class(type);
    const hssize_t n_elements = H5Sget_simple_extent_npoints(space);
    const hsize_t n = n_elements >= 0 ? (hsize_t)n_elements : 0, most = (hsize_t)1 << 32;
    const size_t length = kind == H5T_STRING ? H5Tget_size(type) : 0;
    char *data = NULL;
    hs_status status = HS_OK;
    if (dataset < 0 || n_elements < 0 || n > most || (kind == H5T_STRING && (n != 1 || H5Tis_variable_str(type) > 0)))
        status = damaged(self, "a value in it has no known form", err);
    if (status == HS_OK) status = HS_ALLOC(data, kind == H5T_STRING ? length + 1 : (size_t)n * 8 + 8, err);
    if (status == HS_OK) {
        const hid_t memory = kind == H5T_STRING ? type : kind == H5T_INTEGER ? H5T_NATIVE_INT64 : H5T_NATIVE_DOUBLE;
        if (n > 0 && H5Dread(dataset, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0)
            status = damaged(self, "a value in it cannot be read", err);
    }
    if (status == HS_OK && kind == H5T_STRING)
        status = hs_state_add(state, name, HS_STATE_TEXT, data, (int64_t)strlen(data), err);
    else if (status == HS_OK)
        status =
            hs_state_add(state, name, kind == H5T_INTEGER ? HS_STATE_INTEGER : HS_STATE_REAL, data, (int64_t)n, err);
    HS_FREE(data);
    H5Sclose(space);
    H5Tclose(type);
    H5Dclose(dataset);
    return status;
}

static hs_status get_state(const hs_checkpoint *self, const char *section, hs_state *state, hs_error *err)
{
    H5G_info_t info;
    hs_status status = HS_OK;
    if (!hs_h5_has(self->file, section)) return damaged(self, section, err);
    const hid_t group = H5Gopen2(self->file, section, H5P_DEFAULT);
    if (group < 0 || H5Gget_info(group, &info) < 0) status = damaged(self, section, err);
    for (hsize_t k = 0; status == HS_OK && k < info.nlinks; ++k) {
        char name[512];
        H5O_info_t object;
        if (H5Lget_name_by_idx(group, ".", H5_INDEX_NAME, H5_ITER_INC, k, name, sizeof name, H5P_DEFAULT) < 0 ||
            H5Oget_info_by_name(group, name, &object, H5P_DEFAULT) < 0)
            status = damaged(self, section, err);
        else if (object.type == H5O_TYPE_DATASET)
            status = get_value(self, group, name, state, err);
    }
    if (group >= 0) H5Gclose(group);
    return status;
}

/** Rank 0's values to all ranks. */
static hs_status share(const hs_parallel *parallel, hs_state *state, hs_error *err)
{
    int64_t n_values = state->n_values;
    hs_parallel_broadcast(parallel, 0, &n_values, sizeof n_values);
    for (int k = 0; k < n_values; ++k) {
        char name[512] = "";
        int64_t head[2] = {0, 0};
        void *data = NULL;
        if (parallel->rank == 0) {
            snprintf(name, sizeof name, "%s", state->value[k].name);
            head[0] = state->value[k].kind;
            head[1] = state->value[k].n;
        }
        hs_parallel_broadcast(parallel, 0, name, sizeof name);
        hs_parallel_broadcast(parallel, 0, head, sizeof head);
        const size_t size = (size_t)head[1] * (head[0] == HS_STATE_TEXT ? 1 : sizeof(int64_t));
        if (parallel->rank != 0) (void)!hs_memory_alloc(&data, size, 1, err);
        HS_TRY(hs_parallel_agree(parallel, err));
        hs_parallel_broadcast(parallel, 0, parallel->rank == 0 ? state->value[k].data : data, size);
        if (parallel->rank != 0) (void)!hs_state_add(state, name, (int)head[0], data, head[1], err);
        HS_FREE(data);
        HS_TRY(hs_parallel_agree(parallel, err));
    }
    return HS_OK;
}

hs_status hs_checkpoint_get(hs_checkpoint *self, const char *section, hs_state *state, hs_error *err)
{
    *state = (hs_state){.is_reading = true};
    if (self->parallel.rank == 0) {
        hs_h5_quiet quiet = hs_h5_be_quiet();
        (void)!get_state(self, section, state, err);
        hs_h5_end_quiet(&quiet);
    }
    HS_TRY(hs_parallel_agree(&self->parallel, err));
    return self->parallel.n_ranks > 1 ? share(&self->parallel, state, err) : HS_OK;
}
