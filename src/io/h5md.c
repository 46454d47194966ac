/* H5MD files: adding frames, and going on with a file that is there. h5md_make.c makes new ones. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/memory.h"
#include "io/h5.h"
#include "io/h5_driver.h"
#include "io/h5md_internal.h"

hs_status hs_h5md_fail(hs_h5md *self, const char *what, hs_error *err)
{
    self->is_failed = true;
    const int error = self->file >= 0 ? hs_h5_driver_errno(self->file) : 0;
    if (error != 0)
        return hs_fail(err, HS_ERROR_IO, "'%s' could not be %s: %s; the frames before are whole", self->path, what,
                       strerror(error));
    return hs_fail(err, HS_ERROR_IO, "'%s' could not be %s", self->path, what);
}

int64_t hs_h5md_n_rows(const hs_h5md *self) { return (int64_t)self->n_rows; }

static int compare_ids(const void *a, const void *b)
{
    const int64_t first = *(const int64_t *)a, second = *(const int64_t *)b;
    return first < second ? -1 : first > second;
}

hs_status hs_h5md_index(hs_h5md *self, hs_error *err)
{
    const hsize_t start = 0, n = self->n_rows;
    if (self->is_plain || self->n_sorted == n) return HS_OK;
    int64_t *id = NULL;
    HS_FREE(self->sorted);
    self->n_sorted = 0;
    hs_status status = HS_ALLOC(id, (size_t)n, err);
    if (status == HS_OK) status = HS_ALLOC(self->sorted, 2 * (size_t)n, err);
    if (status == HS_OK && !hs_h5_read_block(self->id, H5T_NATIVE_INT64, 1, &start, &n, id))
        status = hs_h5md_fail(self, "read", err);
    if (status == HS_OK) {
        for (hsize_t row = 0; row < n; ++row) {
            self->sorted[2 * row] = id[row];
            self->sorted[2 * row + 1] = (int64_t)row;
        }
        qsort(self->sorted, (size_t)n, 2 * sizeof(int64_t), compare_ids);
        self->n_sorted = n;
    }
    HS_FREE(id);
    return status;
}

int64_t hs_h5md_row(const hs_h5md *self, int64_t id)
{
    if (self->is_plain) return id >= 1 && id <= (int64_t)self->n_rows ? id - 1 : -1;
    const int64_t *found = bsearch(&id, self->sorted, (size_t)self->n_sorted, 2 * sizeof(int64_t), compare_ids);
    return found != NULL ? found[1] : -1;
}

/* ---- Appending ---- */

static hid_t open_in(hid_t at, const char *path) { return hs_h5_has(at, path) ? H5Dopen2(at, path, H5P_DEFAULT) : -1; }

static hs_status refuse(const hs_h5md *self, const char *what, hs_error *err)
{
    return hs_fail(err, HS_ERROR_INPUT,
                   "'%s' cannot be added to: %s. Give the dump another file, or leave out 'append yes'", self->path,
                   what);
}

static hs_status open_datasets(hs_h5md *self, const hs_h5md_plan *plan, hs_error *err)
{
    char path[256];
    hsize_t extents[3];
    if (!hs_h5_has(self->file, "particles/all") || !hs_h5_has(self->file, "h5md"))
        return refuse(self, "it is not an H5MD file with the group 'all'", err);
    const hid_t at = self->file;
    snprintf(path, sizeof path, "particles/all/%s/step", plan->element[0].name);
    self->step = open_in(at, path);
    snprintf(path, sizeof path, "particles/all/%s/time", plan->element[0].name);
    self->time = open_in(at, path);
    self->edges = open_in(at, "particles/all/box/edges/value");
    self->offset = open_in(at, "particles/all/box/offset/value");
    self->id = open_in(at, "particles/all/id");
    self->mass = open_in(at, "particles/all/mass");
    if (self->step < 0 || self->time < 0 || self->edges < 0 || self->offset < 0 || self->id < 0 || self->mass < 0)
        return refuse(self, "it was not written by this program's dump h5md with the same elements", err);
    self->species = open_in(at, "particles/all/species");
    if (hs_h5_extents(self->id, extents) != 1) return refuse(self, "its ids are not a list", err);
    self->n_rows = extents[0];
    self->n_frames = HSIZE_UNDEF;
    for (int k = 0; k < plan->n_elements; ++k) {
        const int rank = plan->element[k].n_columns > 1 ? 3 : 2;
        snprintf(path, sizeof path, "particles/all/%s/value", plan->element[k].name);
        self->value[k] = open_in(at, path);
        if (self->value[k] < 0 || hs_h5_extents(self->value[k], extents) != rank || extents[1] != self->n_rows) {
            snprintf(path, sizeof path, "its element '%s' is missing or of another shape", plan->element[k].name);
            return refuse(self, path, err);
        }
        if (extents[0] < self->n_frames) self->n_frames = extents[0];
    }
    for (int k = 0; k < plan->n_observables; ++k) {
        const hs_h5md_observable *what = &plan->observable[k];
        hsize_t there[3] = {0, 1, 1};
        snprintf(path, sizeof path, "observables/%.200s/value", what->name);
        self->observable[k] = open_in(at, path);
        if (self->observable[k] < 0) return refuse(self, "its observables are others", err);
        if (hs_h5_extents(self->observable[k], there) != 1 + what->rank || there[1] != (hsize_t)what->n[0] ||
            there[2] != (hsize_t)what->n[1]) {
            snprintf(path, sizeof path, "its observable '%.100s' has another length", what->name);
            return refuse(self, path, err);
        }
    }
    return HS_OK;
}

/** Where to go on: a frame of the present step is written anew, and so are later ones by a run that is resumed. */
static hs_status find_end(hs_h5md *self, const hs_h5md_plan *plan, hs_error *err)
{
    for (; self->n_frames > 0; --self->n_frames) {
        int64_t step;
        const hsize_t at = self->n_frames - 1, one = 1;
        if (!hs_h5_read_block(self->step, H5T_NATIVE_INT64, 1, &at, &one, &step))
            return hs_h5md_fail(self, "read", err);
        if (step > plan->step && !plan->drops_later)
            return hs_fail(err, HS_ERROR_INPUT,
                           "'%s' holds frames up to step %lld, and the present step is %lld: steps must count up. Give "
                           "the dump another file, or leave out 'append yes'",
                           self->path, (long long)step, (long long)plan->step);
        if (step < plan->step || (step == plan->step && plan->drops_later)) return HS_OK;
    }
    return HS_OK;
}

static bool set_frames(hs_h5md *self, hsize_t n)
{
    bool is_fine = true;
    const hsize_t edges[3] = {n, 3, 3};
    is_fine = H5Dset_extent(self->step, &n) >= 0 && H5Dset_extent(self->time, &n) >= 0;
    is_fine = is_fine && H5Dset_extent(self->edges, edges) >= 0 && H5Dset_extent(self->offset, edges) >= 0;
    for (int k = 0; k < self->n_observables && is_fine; ++k) {
        const hsize_t extents[3] = {n, (hsize_t)self->what[k].n[0], (hsize_t)self->what[k].n[1]};
        is_fine = H5Dset_extent(self->observable[k], extents) >= 0;
    }
    for (int k = 0; k < self->n_elements && is_fine; ++k) {
        const hsize_t extents[3] = {n, self->n_rows, (hsize_t)self->element[k].n_columns};
        is_fine = H5Dset_extent(self->value[k], extents) >= 0;
    }
    return is_fine;
}

/** Whether a file of this size can have as many frames as a dataset says: HDF5 walks over all of those that are to be
 *  cut off, and a flipped bit of their number would take it years. */
static bool is_possible(const hs_h5md *self, hid_t dataset)
{
    hsize_t size, extents[3] = {0, 1, 1};
    return hs_h5_extents(dataset, extents) > 0 && H5Fget_filesize(self->file, &size) >= 0 && extents[0] <= size;
}

static bool are_frames_possible(const hs_h5md *self)
{
    bool is_fine = is_possible(self, self->step) && is_possible(self, self->time) && is_possible(self, self->edges) &&
                   is_possible(self, self->offset);
    for (int k = 0; k < self->n_observables && is_fine; ++k) is_fine = is_possible(self, self->observable[k]);
    for (int k = 0; k < self->n_elements && is_fine; ++k) is_fine = is_possible(self, self->value[k]);
    return is_fine;
}

static hs_status open_again(hs_h5md *self, const hs_h5md_plan *plan, hs_error *err)
{
    const hid_t list = hs_h5_driver_list();
    self->file = H5Fopen(self->path, H5F_ACC_RDWR, list);
    H5Pclose(list);
    if (self->file < 0) return refuse(self, "it is not an HDF5 file that can be opened and written", err);
    hs_h5_driver_opened(self->file);
    HS_TRY(open_datasets(self, plan, err));
    if (!are_frames_possible(self)) return refuse(self, "it says that it has more frames than fit into it", err);
    self->is_plain = self->n_rows == 0;
    HS_TRY(find_end(self, plan, err));
    if (set_frames(self, self->n_frames) && H5Fflush(self->file, H5F_SCOPE_LOCAL) >= 0) return HS_OK;
    return hs_h5md_fail(self, "written", err);
}

static void close_datasets(hs_h5md *self)
{
    const hid_t single[] = {self->step, self->time, self->edges, self->offset, self->id, self->species, self->mass};
    for (size_t k = 0; k < sizeof single / sizeof single[0]; ++k)
        if (single[k] >= 0) H5Dclose(single[k]);
    for (int k = 0; k < self->n_elements && self->value != NULL; ++k)
        if (self->value[k] >= 0) H5Dclose(self->value[k]);
    for (int k = 0; k < self->n_observables && self->observable != NULL; ++k)
        if (self->observable[k] >= 0) H5Dclose(self->observable[k]);
}

hs_status hs_h5md_open(hs_h5md **file, const char *path, const hs_h5md_plan *plan, hs_error *err)
{
    HS_TRY(HS_ALLOC(*file, 1, err));
    hs_h5md *self = *file;
    self->file = self->step = self->time = self->edges = self->offset = self->id = self->species = self->mass = -1;
    self->element = plan->element;
    self->what = plan->observable;
    self->is_plain = true;
    self->is_single = plan->is_single;
    hs_status status = hs_memory_strdup(&self->path, path, err);
    if (status == HS_OK) status = HS_ALLOC(self->value, (size_t)plan->n_elements, err);
    if (status == HS_OK) status = HS_ALLOC(self->observable, (size_t)plan->n_observables, err);
    if (status == HS_OK) {
        self->n_elements = plan->n_elements;
        self->n_observables = plan->n_observables;
        for (int k = 0; k < plan->n_elements; ++k) self->value[k] = -1;
        for (int k = 0; k < plan->n_observables; ++k) self->observable[k] = -1;
        hs_h5_quiet quiet = hs_h5_be_quiet();
        status = plan->append && access(path, F_OK) == 0 ? open_again(self, plan, err) : hs_h5md_make(self, plan, err);
        hs_h5_end_quiet(&quiet);
    }
    hs_error ignored = {0};
    if (status != HS_OK) (void)!hs_h5md_close(file, &ignored);
    return status;
}

/* ---- Rows and frames ---- */

static bool put_fixed(hid_t dataset, hid_t type, hsize_t first, hsize_t n, const void *values)
{
    const hsize_t end = first + n;
    return H5Dset_extent(dataset, &end) >= 0 && hs_h5_write_block(dataset, type, 1, &first, &n, values);
}

hs_status hs_h5md_set_rows(hs_h5md *self, int64_t first, int64_t n, const hs_h5md_rows *rows, hs_error *err)
{
    const hsize_t start = (hsize_t)first, count = (hsize_t)n, end = start + count;
    hs_h5_quiet quiet = hs_h5_be_quiet();
    bool is_fine = put_fixed(self->id, H5T_NATIVE_INT64, start, count, rows->id) &&
                   put_fixed(self->mass, H5T_NATIVE_DOUBLE, start, count, rows->mass) &&
                   (self->species < 0 || put_fixed(self->species, H5T_NATIVE_INT32, start, count, rows->species));
    for (int64_t k = 0; k < n && self->is_plain; ++k) self->is_plain = rows->id[k] == first + k + 1;
    if (self->n_rows < end) self->n_rows = end;
    is_fine = is_fine && set_frames(self, self->n_frames);
    hs_status status = is_fine ? HS_OK : hs_h5md_fail(self, "written", err);
    hs_h5_end_quiet(&quiet);
    return status;
}

hs_status hs_h5md_begin_frame(hs_h5md *self, int64_t step, double time, const hs_box *box, hs_error *err)
{
    const hsize_t start[3] = {self->n_frames, 0, 0}, one[3] = {1, 3, 3};
    const double *tilt = box->tilt; /* a row is an edge */
    const double edges[3][3] = {{hs_box_length(box, 0), 0.0, 0.0},
                                {tilt[0], hs_box_length(box, 1), 0.0},
                                {tilt[1], tilt[2], hs_box_length(box, 2)}};
    hs_h5_quiet quiet = hs_h5_be_quiet();
    const bool is_fine = set_frames(self, self->n_frames + 1) &&
                         hs_h5_write_block(self->step, H5T_NATIVE_INT64, 1, start, one, &step) &&
                         hs_h5_write_block(self->time, H5T_NATIVE_DOUBLE, 1, start, one, &time) &&
                         hs_h5_write_block(self->edges, H5T_NATIVE_DOUBLE, 3, start, one, edges) &&
                         hs_h5_write_block(self->offset, H5T_NATIVE_DOUBLE, 2, start, one, box->lo);
    hs_h5_end_quiet(&quiet);
    if (!is_fine) return hs_h5md_fail(self, "written", err);
    ++self->n_frames;
    return HS_OK;
}

/** Rows of an element as whole chunks, as far as they are: HDF5 would copy each into a new buffer, after having filled
 *  it. *n_done rows were written. */
static bool put_chunks(const hs_h5md *self, int element, hsize_t first, hsize_t n, const char *values, hsize_t *n_done)
{
    const hs_h5md_element *kind = &self->element[element];
    const hid_t dataset = self->value[element], type = kind->is_integer ? H5T_NATIVE_INT32 : H5T_NATIVE_DOUBLE;
    const hid_t create = H5Dget_create_plist(dataset);
    hsize_t chunk[3] = {0, 0, 0};
    const int rank = kind->n_columns > 1 ? 3 : 2;
    const bool is_chunked = H5Pget_chunk(create, rank, chunk) == rank;
    const size_t row = (size_t)kind->n_columns * (kind->is_integer ? sizeof(int32_t) : sizeof(double));
    H5Pclose(create);
    *n_done = 0;
    if (!is_chunked || chunk[0] != 1 || first % chunk[1] != 0 || !hs_h5_is_plain(dataset, type)) return true;
    while (*n_done + chunk[1] <= n) {
        const hsize_t start[3] = {self->n_frames - 1, first + *n_done, 0};
        if (!hs_h5_write_chunk(dataset, start, row * (size_t)chunk[1], values + row * (size_t)*n_done)) return false;
        *n_done += chunk[1];
    }
    return true;
}

hs_status hs_h5md_put_rows(hs_h5md *self, int element, int64_t first, int64_t n, const void *values, hs_error *err)
{
    const hs_h5md_element *kind = &self->element[element];
    const size_t row = (size_t)kind->n_columns * (kind->is_integer ? sizeof(int32_t) : sizeof(double));
    hsize_t n_done;
    hs_h5_quiet quiet = hs_h5_be_quiet();
    bool is_fine = put_chunks(self, element, (hsize_t)first, (hsize_t)n, values, &n_done);
    const hsize_t start[3] = {self->n_frames - 1, (hsize_t)first + n_done, 0},
                  count[3] = {1, (hsize_t)n - n_done, (hsize_t)kind->n_columns};
    if (is_fine && count[1] > 0)
        is_fine = hs_h5_write_block(self->value[element], kind->is_integer ? H5T_NATIVE_INT32 : H5T_NATIVE_DOUBLE,
                                    kind->n_columns > 1 ? 3 : 2, start, count, (const char *)values + row * n_done);
    hs_h5_end_quiet(&quiet);
    return is_fine ? HS_OK : hs_h5md_fail(self, "written", err);
}

hs_status hs_h5md_put_observable(hs_h5md *self, int observable, const double *values, hs_error *err)
{
    const hs_h5md_observable *what = &self->what[observable];
    const hsize_t start[3] = {self->n_frames - 1, 0, 0}, count[3] = {1, (hsize_t)what->n[0], (hsize_t)what->n[1]};
    hs_h5_quiet quiet = hs_h5_be_quiet();
    const bool is_fine =
        hs_h5_write_block(self->observable[observable], H5T_NATIVE_DOUBLE, 1 + what->rank, start, count, values);
    hs_h5_end_quiet(&quiet);
    return is_fine ? HS_OK : hs_h5md_fail(self, "written", err);
}

hs_status hs_h5md_end_frame(hs_h5md *self, hs_error *err)
{
    hs_h5_quiet quiet = hs_h5_be_quiet();
    const bool is_fine = H5Fflush(self->file, H5F_SCOPE_LOCAL) >= 0;
    hs_h5_end_quiet(&quiet);
    return is_fine ? HS_OK : hs_h5md_fail(self, "written", err);
}

hs_status hs_h5md_close(hs_h5md **file, hs_error *err)
{
    if (*file == NULL) return HS_OK;
    hs_h5md *self = *file;
    hs_status status = HS_OK;
    hs_h5_quiet quiet = hs_h5_be_quiet();
    close_datasets(self);
    if (self->file >= 0) {
        if (H5Fflush(self->file, H5F_SCOPE_LOCAL) < 0) status = hs_h5md_fail(self, "written", err);
        H5Fclose(self->file);
    }
    if (self->part.path != NULL && self->file >= 0 && !self->is_failed) {
        const hs_status named = hs_h5md_take_name(self, err);
        if (status == HS_OK) status = named;
    }
    hs_part_file_abandon(&self->part);
    hs_h5_end_quiet(&quiet);
    HS_FREE(self->path);
    HS_FREE(self->value);
    HS_FREE(self->observable);
    HS_FREE(self->sorted);
    HS_FREE(*file);
    return status;
}
