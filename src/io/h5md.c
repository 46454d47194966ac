#include "io/h5md.h"

#include <errno.h>
#include <limits.h>
#include <math.h>
#include <pwd.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/memory.h"
#include "base/text.h"
#include "io/h5.h"
#include "io/h5_driver.h"

/** Rows of one chunk at most: 1.5 MB of vectors, few enough for viewers that read single atoms. */
enum { CHUNK_ROWS = 1 << 16, CHUNK_FRAMES = 256 };

struct hs_h5md {
    char *path;     /**< owned */
    char *part;     /**< owned; its name while it is not whole, beside path; NULL once it has its own */
    bool is_single; /**< takes its own name only when it is closed */
    bool is_failed;
    hid_t file;
    const hs_h5md_element *element; /**< borrowed */
    int n_elements, n_observables;
    hid_t *value;      /**< owned [n_elements] datasets */
    hid_t *observable; /**< owned [n_observables] datasets */
    hid_t step, time, edges, offset, id, species, mass;
    hsize_t n_frames, n_rows;
    bool is_plain;    /**< ids count up from 1: row = id - 1, and no table is needed */
    int64_t *sorted;  /**< owned [2 n_sorted]: id, row, ... in the order of ids, unless is_plain */
    hsize_t n_sorted; /**< less than n_rows: the table must be made anew */
};

static const double no_number = NAN;
static const int32_t no_integer = INT32_MIN;
static const int64_t no_step = -1;

static hs_status fail(hs_h5md *self, const char *what, hs_error *err)
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
        status = fail(self, "read", err);
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

/* ---- Making a file ---- */

static hid_t list_in_time(hid_t at, const char *name, hid_t type, const void *fill, int rank, hsize_t n_columns)
{
    const hs_h5_shape shape = {.type = type,
                               .rank = rank,
                               .now = {0, n_columns, n_columns},
                               .chunk = {CHUNK_FRAMES, n_columns, n_columns},
                               .fill = fill};
    return hs_h5_dataset(at, name, &shape);
}

/** Rows of a chunk: few chunks in large systems, small files for small ones. */
static hsize_t chunk_rows(const hs_h5md_plan *plan)
{
    const hsize_t least = 64, n = (hsize_t)plan->n_rows;
    return n < least ? least : n < CHUNK_ROWS ? n : CHUNK_ROWS;
}

static hid_t fixed_list(hid_t at, const char *name, hid_t type, const void *fill, const hs_h5md_plan *plan)
{
    const hs_h5_shape shape = {.type = type, .rank = 1, .now = {0}, .chunk = {chunk_rows(plan)}, .fill = fill};
    return hs_h5_dataset(at, name, &shape);
}

/** position/step and position/time, which all elements, the box and the observables share through hard links. */
static bool link_times(hid_t particles, const hs_h5md *self, hid_t to)
{
    char path[128];
    static const char *const names[] = {"step", "time"};
    for (int k = 0; k < 2; ++k) {
        snprintf(path, sizeof path, "%s/%s", self->element[0].name, names[k]);
        if (H5Lcreate_hard(particles, path, to, names[k], H5P_DEFAULT, H5P_DEFAULT) < 0) return false;
    }
    return true;
}

static bool put_unit(hid_t at, const char *unit)
{
    return unit == NULL || unit[0] == '\0' || hs_h5_put_text_attribute(at, "unit", unit);
}

/** Headers are written in the order in which they were made (h5_driver.h): values come last, so that a reader that asks
 *  them for the number of frames finds all the rest. */
static bool make_box(hs_h5md *self, hid_t particles, const hs_h5md_plan *plan)
{
    const hid_t box = hs_h5_group(particles, "box"), edges = hs_h5_group(box, "edges"),
                offset = hs_h5_group(box, "offset");
    const int32_t dimension = 3;
    char boundary[3][8] = {{0}};
    for (int axis = 0; axis < 3; ++axis)
        memcpy(boundary[axis], plan->box->periodic[axis] ? "periodic" : "none\0\0\0", 8);
    const hid_t type = H5Tcopy(H5T_C_S1), space = H5Screate_simple(1, (const hsize_t[]){3}, NULL);
    H5Tset_size(type, sizeof boundary[0]);
    H5Tset_strpad(type, H5T_STR_NULLPAD);
    const hid_t attribute = H5Acreate2(box, "boundary", type, space, H5P_DEFAULT, H5P_DEFAULT);
    bool is_fine = attribute >= 0 && H5Awrite(attribute, type, boundary) >= 0;
    H5Aclose(attribute);
    H5Sclose(space);
    H5Tclose(type);
    is_fine = is_fine && hs_h5_put_int_attributes(box, "dimension", &dimension, 1);
    is_fine = is_fine && link_times(particles, self, edges) && link_times(particles, self, offset);
    self->edges = list_in_time(edges, "value", H5T_NATIVE_DOUBLE, &no_number, 3, 3);
    self->offset = list_in_time(offset, "value", H5T_NATIVE_DOUBLE, &no_number, 2, 3);
    is_fine = is_fine && put_unit(self->edges, plan->length_unit) && put_unit(self->offset, plan->length_unit);
    H5Gclose(offset);
    H5Gclose(edges);
    H5Gclose(box);
    return is_fine && self->edges >= 0 && self->offset >= 0;
}

static bool make_element(hs_h5md *self, hid_t particles, int k, const hs_h5md_plan *plan)
{
    const hs_h5md_element *element = &plan->element[k];
    const hs_h5_shape shape = {.type = element->is_integer ? H5T_NATIVE_INT32 : H5T_NATIVE_DOUBLE,
                               .rank = element->n_columns > 1 ? 3 : 2,
                               .now = {0, 0, (hsize_t)element->n_columns},
                               .chunk = {1, chunk_rows(plan), (hsize_t)element->n_columns},
                               .grows_twice = true,
                               .fill = element->is_integer ? (const void *)&no_integer : &no_number,
                               .deflate = plan->deflate};
    const hid_t group = H5Gopen2(particles, element->name, H5P_DEFAULT);
    bool is_fine = k == 0 || link_times(particles, self, group);
    self->value[k] = hs_h5_dataset(group, "value", &shape);
    is_fine = is_fine && self->value[k] >= 0 && put_unit(self->value[k], element->unit);
    H5Gclose(group);
    return is_fine;
}

static bool make_particles(hs_h5md *self, const hs_h5md_plan *plan)
{
    const hid_t above = hs_h5_group(self->file, "particles"), particles = hs_h5_group(above, "all");
    bool is_fine = particles >= 0;
    for (int k = 0; k < plan->n_elements && is_fine; ++k) {
        const hid_t group = hs_h5_group(particles, plan->element[k].name);
        is_fine = group >= 0;
        if (k == 0 && is_fine) {
            self->step = list_in_time(group, "step", H5T_NATIVE_INT64, &no_step, 1, 1);
            self->time = list_in_time(group, "time", H5T_NATIVE_DOUBLE, &no_number, 1, 1);
            is_fine = self->step >= 0 && self->time >= 0 && put_unit(self->time, plan->time_unit);
        }
        H5Gclose(group);
    }
    self->id = fixed_list(particles, "id", H5T_NATIVE_INT64, &no_step, plan);
    self->mass = fixed_list(particles, "mass", H5T_NATIVE_DOUBLE, &no_number, plan);
    bool has_species = false; /* as one that changes */
    for (int k = 0; k < plan->n_elements; ++k)
        has_species = has_species || strcmp(plan->element[k].name, "species") == 0;
    if (!has_species) self->species = fixed_list(particles, "species", H5T_NATIVE_INT32, &no_integer, plan);
    is_fine = is_fine && self->id >= 0 && self->mass >= 0 && (has_species || self->species >= 0);
    is_fine = is_fine && make_box(self, particles, plan);
    if (is_fine && plan->n_observables > 0) {
        const hid_t group = hs_h5_group(self->file, "observables");
        for (int k = 0; k < plan->n_observables && is_fine; ++k) {
            const hid_t one = hs_h5_group(group, plan->observable[k]);
            is_fine = one >= 0 && link_times(particles, self, one);
            self->observable[k] = list_in_time(one, "value", H5T_NATIVE_DOUBLE, &no_number, 1, 1);
            is_fine = is_fine && self->observable[k] >= 0;
            H5Gclose(one);
        }
        H5Gclose(group);
    }
    for (int k = plan->n_elements - 1; k >= 0 && is_fine; --k) is_fine = make_element(self, particles, k, plan);
    H5Gclose(particles);
    H5Gclose(above);
    return is_fine;
}

static bool make_metadata(const hs_h5md *self, const hs_h5md_plan *plan)
{
    const struct passwd *user = getpwuid(geteuid());
    const hid_t h5md = hs_h5_group(self->file, "h5md"), author = hs_h5_group(h5md, "author"),
                creator = hs_h5_group(h5md, "creator"), above = hs_h5_group(self->file, "parameters"),
                parameters = hs_h5_group(above, "halfshell");
    const char *const name = user != NULL ? user->pw_name : "unknown";
    const bool is_fine =
        hs_h5_put_int_attributes(h5md, "version", (const int32_t[]){1, 1}, 2) &&
        hs_h5_put_text_attribute(author, "name", name) && hs_h5_put_text_attribute(creator, "name", "Halfshell") &&
        hs_h5_put_text_attribute(creator, "version", plan->version) &&
        hs_h5_put_text(parameters, "version", plan->version) && hs_h5_put_text(parameters, "build", plan->build) &&
        hs_h5_put_text(parameters, "units", plan->units->name) &&
        hs_h5_put_values(parameters, "dimension", H5T_NATIVE_INT32, &plan->box->dimension, 1) &&
        (plan->deck == NULL || hs_h5_put_text(parameters, "deck", plan->deck));
    H5Gclose(parameters);
    H5Gclose(above);
    H5Gclose(creator);
    H5Gclose(author);
    H5Gclose(h5md);
    return is_fine;
}

/** The file takes its name; what had it before is replaced. */
static hs_status take_name(hs_h5md *self, hs_error *err)
{
    if (self->part == NULL) return HS_OK;
    if (rename(self->part, self->path) != 0)
        return hs_fail(err, HS_ERROR_IO, "'%s' could not be renamed into place: %s", self->path, strerror(errno));
    HS_FREE(self->part);
    return HS_OK;
}

static hs_status choose_part(hs_h5md *self, hs_error *err)
{
    hs_text text = {0};
    hs_status status = hs_text_printf(&text, err, "%s.part-%ld", self->path, (long)getpid());
    if (status == HS_OK) status = hs_memory_strdup(&self->part, hs_text_get(&text), err);
    hs_text_fini(&text);
    return status;
}

static hs_status make(hs_h5md *self, const hs_h5md_plan *plan, hs_error *err)
{
    HS_TRY(choose_part(self, err));
    const hid_t list = hs_h5_driver_list(), create = H5Pcreate(H5P_FILE_CREATE);
    H5Pset_istore_k(create, 128); /* an index node for 256 chunks: few levels in long files */
    errno = 0;
    self->file = H5Fcreate(self->part, H5F_ACC_TRUNC, create, list);
    const int error = errno;
    H5Pclose(create);
    H5Pclose(list);
    if (self->file < 0)
        return hs_fail(err, HS_ERROR_IO, "'%s' could not be opened for writing: %s", self->path,
                       error != 0 ? strerror(error) : "HDF5 gives no reason");
    if (!make_metadata(self, plan) || !make_particles(self, plan) || H5Fflush(self->file, H5F_SCOPE_LOCAL) < 0)
        return fail(self, "written", err);
    return self->is_single ? HS_OK : take_name(self, err);
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
        snprintf(path, sizeof path, "observables/%.200s/value", plan->observable[k]);
        self->observable[k] = open_in(at, path);
        if (self->observable[k] < 0) return refuse(self, "its observables are others", err);
    }
    return HS_OK;
}

/** Where to go on: a frame of the present step is written anew, and so are later ones by a run that is resumed. */
static hs_status find_end(hs_h5md *self, const hs_h5md_plan *plan, hs_error *err)
{
    for (; self->n_frames > 0; --self->n_frames) {
        int64_t step;
        const hsize_t at = self->n_frames - 1, one = 1;
        if (!hs_h5_read_block(self->step, H5T_NATIVE_INT64, 1, &at, &one, &step)) return fail(self, "read", err);
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
    for (int k = 0; k < self->n_observables && is_fine; ++k) is_fine = H5Dset_extent(self->observable[k], &n) >= 0;
    for (int k = 0; k < self->n_elements && is_fine; ++k) {
        const hsize_t extents[3] = {n, self->n_rows, (hsize_t)self->element[k].n_columns};
        is_fine = H5Dset_extent(self->value[k], extents) >= 0;
    }
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
    self->is_plain = self->n_rows == 0;
    HS_TRY(find_end(self, plan, err));
    if (set_frames(self, self->n_frames) && H5Fflush(self->file, H5F_SCOPE_LOCAL) >= 0) return HS_OK;
    return fail(self, "written", err);
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
        status = plan->append && access(path, F_OK) == 0 ? open_again(self, plan, err) : make(self, plan, err);
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
    hs_status status = is_fine ? HS_OK : fail(self, "written", err);
    hs_h5_end_quiet(&quiet);
    return status;
}

hs_status hs_h5md_begin_frame(hs_h5md *self, int64_t step, double time, const hs_box *box, hs_error *err)
{
    const hsize_t start[3] = {self->n_frames, 0, 0}, one[3] = {1, 3, 3};
    double edges[3][3] = {{0.0}};
    for (int axis = 0; axis < 3; ++axis) edges[axis][axis] = hs_box_length(box, axis);
    hs_h5_quiet quiet = hs_h5_be_quiet();
    const bool is_fine = set_frames(self, self->n_frames + 1) &&
                         hs_h5_write_block(self->step, H5T_NATIVE_INT64, 1, start, one, &step) &&
                         hs_h5_write_block(self->time, H5T_NATIVE_DOUBLE, 1, start, one, &time) &&
                         hs_h5_write_block(self->edges, H5T_NATIVE_DOUBLE, 3, start, one, edges) &&
                         hs_h5_write_block(self->offset, H5T_NATIVE_DOUBLE, 2, start, one, box->lo);
    hs_h5_end_quiet(&quiet);
    if (!is_fine) return fail(self, "written", err);
    ++self->n_frames;
    return HS_OK;
}

hs_status hs_h5md_put_rows(hs_h5md *self, int element, int64_t first, int64_t n, const void *values, hs_error *err)
{
    const hs_h5md_element *kind = &self->element[element];
    const hsize_t start[3] = {self->n_frames - 1, (hsize_t)first, 0},
                  count[3] = {1, (hsize_t)n, (hsize_t)kind->n_columns};
    hs_h5_quiet quiet = hs_h5_be_quiet();
    const bool is_fine =
        hs_h5_write_block(self->value[element], kind->is_integer ? H5T_NATIVE_INT32 : H5T_NATIVE_DOUBLE,
                          kind->n_columns > 1 ? 3 : 2, start, count, values);
    hs_h5_end_quiet(&quiet);
    return is_fine ? HS_OK : fail(self, "written", err);
}

hs_status hs_h5md_put_observable(hs_h5md *self, int observable, double value, hs_error *err)
{
    const hsize_t start = self->n_frames - 1;
    hs_h5_quiet quiet = hs_h5_be_quiet();
    const bool is_fine =
        hs_h5_write_block(self->observable[observable], H5T_NATIVE_DOUBLE, 1, &start, (const hsize_t[]){1}, &value);
    hs_h5_end_quiet(&quiet);
    return is_fine ? HS_OK : fail(self, "written", err);
}

hs_status hs_h5md_end_frame(hs_h5md *self, hs_error *err)
{
    hs_h5_quiet quiet = hs_h5_be_quiet();
    const bool is_fine = H5Fflush(self->file, H5F_SCOPE_LOCAL) >= 0;
    hs_h5_end_quiet(&quiet);
    return is_fine ? HS_OK : fail(self, "written", err);
}

hs_status hs_h5md_close(hs_h5md **file, hs_error *err)
{
    if (*file == NULL) return HS_OK;
    hs_h5md *self = *file;
    hs_status status = HS_OK;
    hs_h5_quiet quiet = hs_h5_be_quiet();
    close_datasets(self);
    if (self->file >= 0) {
        if (H5Fflush(self->file, H5F_SCOPE_LOCAL) < 0) status = fail(self, "written", err);
        H5Fclose(self->file);
    }
    if (self->part != NULL && self->file >= 0 && !self->is_failed) {
        const hs_status named = take_name(self, err);
        if (status == HS_OK) status = named;
    }
    if (self->part != NULL) unlink(self->part);
    HS_FREE(self->part);
    hs_h5_end_quiet(&quiet);
    HS_FREE(self->path);
    HS_FREE(self->value);
    HS_FREE(self->observable);
    HS_FREE(self->sorted);
    HS_FREE(*file);
    return status;
}
