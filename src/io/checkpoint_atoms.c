/* Checkpoint files: the atoms, every field of theirs, in the order of ids. */
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "core/atom_id.h"
#include "io/checkpoint_internal.h"
#include "io/h5.h"
#include "io/rows.h"

/** Name of field k in the file. Names that occur twice (two fixes of one style) are counted. */
static void name_field(const hs_atoms *atoms, int k, char *name, size_t size)
{
    int n_before = 0;
    for (int i = 0; i < k; ++i) n_before += strcmp(atoms->field[i].name, atoms->field[k].name) == 0;
    if (n_before == 0)
        snprintf(name, size, "%s", atoms->field[k].name);
    else
        snprintf(name, size, "%s (%d)", atoms->field[k].name, n_before + 1);
    for (char *c = name; *c != '\0'; ++c)
        if (*c == '/') *c = '|';
}

/** Fields know only their size: words of 8 bytes are stored as floating point (bit by bit), of 4 as integers. */
static hid_t word_type(const hs_atom_field *field)
{
    if (strcmp(field->name, "id") == 0) return H5T_NATIVE_INT64;
    return field->size % 8 == 0 ? H5T_NATIVE_DOUBLE : H5T_NATIVE_INT32;
}

static hsize_t n_words(const hs_atom_field *field) { return field->size % 8 == 0 ? field->size / 8 : field->size / 4; }

/** The field's dataset on rank 0, made or opened; the caller closes it. */
static hid_t make_dataset(hid_t group, const char *name, const hs_atom_field *field, hsize_t n_all)
{
    const hsize_t extents[2] = {n_all, n_words(field)};
    const hid_t space = H5Screate_simple(extents[1] > 1 ? 2 : 1, extents, NULL), create = hs_h5_dataset_list();
    const hid_t dataset = H5Dcreate2(group, name, word_type(field), space, H5P_DEFAULT, create, H5P_DEFAULT);
    H5Pclose(create);
    H5Sclose(space);
    return dataset;
}

static hs_status put_field(hs_checkpoint *self, hid_t group, const hs_atoms *atoms, int k, hs_rows *rows, hs_error *err)
{
    const hs_atom_field *field = &atoms->field[k];
    const bool is_root = self->parallel.rank == 0, is_several = self->parallel.n_ranks > 1;
    char name[256];
    char *mine = NULL, *all = NULL;
    hid_t dataset = -1;
    name_field(atoms, k, name, sizeof name);
    hs_status status = HS_ALLOC(mine, field->size * (size_t)rows->n_mine, err);
    if (status == HS_OK && is_root && is_several) status = HS_ALLOC(all, field->size * (size_t)rows->n_block, err);
    status = hs_parallel_agree(&self->parallel, err);
    if (status == HS_OK) {
        const char *array = *field->array;
        for (int i = 0; i < rows->n_mine; ++i)
            memcpy(mine + field->size * (size_t)i, array + field->size * (size_t)rows->mine[i], field->size);
        char *const block = is_several ? all : mine;
        status = hs_rows_gather(rows, mine, field->size, block, err);
        if (status == HS_OK && is_root) {
            const hsize_t start[2] = {(hsize_t)rows->first_row, 0}, count[2] = {(hsize_t)rows->n_block, n_words(field)};
            dataset = rows->first_row == 0 ? make_dataset(group, name, field, (hsize_t)rows->n_all)
                                           : H5Dopen2(group, name, H5P_DEFAULT);
            if (dataset < 0 || !hs_h5_write_block(dataset, word_type(field), count[1] > 1 ? 2 : 1, start, count, block))
                (void)hs_checkpoint_fail(self, "written", err);
            if (dataset >= 0) H5Dclose(dataset);
        }
        status = hs_parallel_agree(&self->parallel, err);
    }
    HS_FREE(mine);
    HS_FREE(all);
    return status;
}

hs_status hs_checkpoint_put_atoms(hs_checkpoint *self, const hs_atoms *atoms, hs_error *err)
{
    hs_rows rows = {0};
    hs_h5_quiet quiet = hs_h5_be_quiet();
    const bool is_root = self->parallel.rank == 0;
    const hid_t group = is_root ? hs_h5_group(self->file, "atoms") : -1;
    if (is_root && group < 0) (void)hs_checkpoint_fail(self, "written", err);
    hs_status status = hs_parallel_agree(&self->parallel, err);
    if (status == HS_OK) status = hs_rows_begin(&rows, &self->parallel, atoms, UINT32_MAX, err);
    while (status == HS_OK && hs_rows_next(&rows, &status, err))
        for (int k = 0; k < atoms->n_fields && status == HS_OK; ++k)
            status = put_field(self, group, atoms, k, &rows, err);
    for (int k = 0; k < atoms->n_fields && status == HS_OK && is_root && rows.n_all == 0; ++k) {
        char name[256];
        name_field(atoms, k, name, sizeof name);
        H5Dclose(make_dataset(group, name, &atoms->field[k], 0));
    }
    if (group >= 0) H5Gclose(group);
    hs_rows_end(&rows);
    hs_h5_end_quiet(&quiet);
    return status;
}

/* ---- Reading ---- */

/** Rows of a field's dataset; -1 when it is missing or of another form. Rank 0 only. */
static int64_t field_rows(hid_t group, const hs_atoms *atoms, int k)
{
    char name[256];
    hsize_t extents[3] = {0, 1, 1};
    name_field(atoms, k, name, sizeof name);
    if (H5Lexists(group, name, H5P_DEFAULT) <= 0) return -1;
    const hid_t dataset = H5Dopen2(group, name, H5P_DEFAULT);
    const int rank = dataset >= 0 ? hs_h5_extents(dataset, extents) : -1;
    if (dataset >= 0) H5Dclose(dataset);
    if (rank < 1 || rank > 2 || (rank == 1 ? 1 : extents[1]) != n_words(&atoms->field[k])) return -1;
    return (int64_t)extents[0];
}

static hs_status read_field(hs_checkpoint *self, hid_t group, const hs_atoms *atoms, int k, hsize_t first, hsize_t n,
                            char *block, hs_error *err)
{
    const hs_atom_field *field = &atoms->field[k];
    char name[256];
    name_field(atoms, k, name, sizeof name);
    const hid_t dataset = H5Dopen2(group, name, H5P_DEFAULT);
    const hsize_t start[2] = {first, 0}, count[2] = {n, n_words(field)};
    const bool is_fine =
        dataset >= 0 && hs_h5_read_block(dataset, word_type(field), count[1] > 1 ? 2 : 1, start, count, block);
    if (dataset >= 0) H5Dclose(dataset);
    return is_fine ? HS_OK : hs_checkpoint_fail(self, "read", err);
}

/** Number of atoms, and which fields the file has (is_there[n_fields]). Rank 0 only. */
static hs_status look(hs_checkpoint *self, hid_t group, const hs_atoms *atoms, bool all_fields, int64_t *n_all,
                      unsigned char *is_there, hs_error *err)
{
    H5G_info_t info;
    hsize_t n_there = 0;
    *n_all = -1;
    for (int k = 0; k < atoms->n_fields; ++k) {
        const int64_t n = field_rows(group, atoms, k);
        is_there[k] = n >= 0;
        n_there += n >= 0;
        if (n >= 0 && *n_all >= 0 && n != *n_all)
            return hs_checkpoint_fail(self, "read: its fields differ in length", err);
        if (n >= 0) *n_all = n;
        if (n < 0 && (all_fields || k < 15))
            return hs_fail(err, HS_ERROR_INPUT, "the checkpoint '%s' has no values '%s' of atoms", self->path,
                           atoms->field[k].name);
    }
    if (all_fields && (H5Gget_info(group, &info) < 0 || info.nlinks != n_there))
        return hs_fail(err, HS_ERROR_INPUT, "the checkpoint '%s' has values of atoms that nothing here uses",
                       self->path);
    return *n_all >= 0 ? HS_OK : hs_checkpoint_fail(self, "read: it has no atoms", err);
}

/** The block's rows [begin, end) become this rank's atoms from index @p first on. */
static hs_status take_block(hs_checkpoint *self, hid_t group, hs_atoms *atoms, const unsigned char *is_there,
                            int64_t first_row, int n, hs_error *err)
{
    const hs_parallel *parallel = &self->parallel;
    int64_t begin, end;
    char *block = NULL;
    size_t widest = 0;
    hs_thread_range(n, 1, parallel->rank, parallel->n_ranks, &begin, &end);
    const int first = atoms->n_local, n_mine = (int)(end - begin);
    hs_status status = hs_atoms_reserve(atoms, (int64_t)first + n_mine, 0, err);
    for (int k = 0; k < atoms->n_fields; ++k)
        if (atoms->field[k].size > widest) widest = atoms->field[k].size;
    if (status == HS_OK) status = HS_ALLOC(block, widest * (size_t)n, err);
    status = hs_parallel_agree(parallel, err);
    for (int k = 0; k < atoms->n_fields && status == HS_OK; ++k) {
        const size_t size = atoms->field[k].size;
        char *array = (char *)*atoms->field[k].array + size * (size_t)first;
        if (!is_there[k]) {
            memset(array, 0, size * (size_t)n_mine);
            continue;
        }
        if (parallel->rank == 0) (void)!read_field(self, group, atoms, k, (hsize_t)first_row, (hsize_t)n, block, err);
        status = hs_parallel_agree(parallel, err);
        hs_parallel_broadcast(parallel, 0, block, size * (size_t)n);
        memcpy(array, block + size * (size_t)begin, size * (size_t)n_mine);
    }
    HS_FREE(block);
    atoms->n_local = first + n_mine;
    return status;
}

/** Numbers that nothing later would question. */
static hs_status check_atoms(const hs_checkpoint *self, const hs_atoms *atoms, hs_error *err)
{
    for (int i = 0; i < atoms->n_local; ++i)
        if (atoms->id[i] < 1 || atoms->id[i] > HS_ATOM_ID_MAX || atoms->type[i] < 1 || atoms->type[i] > atoms->n_types)
            return hs_fail(err, HS_ERROR_INPUT, "the checkpoint '%s' has an atom with id %lld and type %d of %d types",
                           self->path, (long long)atoms->id[i], atoms->type[i], atoms->n_types);
    return HS_OK;
}

hs_status hs_checkpoint_get_atoms(hs_checkpoint *self, hs_atoms *atoms, bool all_fields, hs_error *err)
{
    unsigned char *is_there;
    int64_t n_all = 0;
    HS_TRY(HS_ALLOC(is_there, (size_t)atoms->n_fields, err));
    hs_h5_quiet quiet = hs_h5_be_quiet();
    const bool is_root = self->parallel.rank == 0;
    const hid_t group = is_root ? H5Gopen2(self->file, "atoms", H5P_DEFAULT) : -1;
    if (is_root && group < 0) (void)hs_checkpoint_fail(self, "read: it has no atoms", err);
    if (is_root && group >= 0) (void)!look(self, group, atoms, all_fields, &n_all, is_there, err);
    hs_status status = hs_parallel_agree(&self->parallel, err);
    hs_parallel_broadcast(&self->parallel, 0, &n_all, sizeof n_all);
    hs_parallel_broadcast(&self->parallel, 0, is_there, (size_t)atoms->n_fields);
    atoms->n_local = atoms->n_halo = 0;
    for (int64_t first = 0; first < n_all && status == HS_OK; first += HS_ROWS_BLOCK) {
        const int64_t left = n_all - first;
        status = take_block(self, group, atoms, is_there, first, left < HS_ROWS_BLOCK ? (int)left : HS_ROWS_BLOCK, err);
    }
    if (status == HS_OK) (void)!check_atoms(self, atoms, err);
    if (group >= 0) H5Gclose(group);
    hs_h5_end_quiet(&quiet);
    HS_FREE(is_there);
    ++atoms->generation;
    return hs_parallel_agree(&self->parallel, err);
}
