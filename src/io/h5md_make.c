/* H5MD files: making a new one. */
#include <errno.h>
#include <math.h>
#include <pwd.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "io/h5.h"
#include "io/h5_driver.h"
#include "io/h5md_internal.h"

/** Rows of one chunk at most: 1.5 MB of vectors, few enough for viewers that read single atoms. */
enum { CHUNK_ROWS = 1 << 16, CHUNK_FRAMES = 256, CHUNK_NUMBERS = 1 << 13 };

static const double no_number = NAN;
static const int32_t no_integer = INT32_MIN;
static const int64_t no_step = -1;

static hid_t list_in_time(hid_t at, const char *name, hid_t type, const void *fill, int rank, hsize_t n_columns)
{
    const hs_h5_shape shape = {.type = type,
                               .rank = rank,
                               .now = {0, n_columns, n_columns},
                               .chunk = {CHUNK_FRAMES, n_columns, n_columns},
                               .fill = fill};
    return hs_h5_dataset(at, name, &shape);
}

/** Frames of a chunk of an observable: a chunk that is begun is written with every frame, so large ones get fewer. */
static hid_t observable_in_time(hid_t at, const hs_h5md_observable *what)
{
    const hsize_t n = (hsize_t)what->n[0] * (hsize_t)what->n[1], fit = n > 0 ? CHUNK_NUMBERS / n : CHUNK_FRAMES;
    const hsize_t columns[2] = {(hsize_t)what->n[0], (hsize_t)what->n[1]};
    const hs_h5_shape shape = {.type = H5T_NATIVE_DOUBLE,
                               .rank = 1 + what->rank,
                               .now = {0, columns[0], columns[1]},
                               .chunk = {fit < 1              ? 1
                                         : fit < CHUNK_FRAMES ? fit
                                                              : CHUNK_FRAMES,
                                         columns[0] > 0 ? columns[0] : 1, columns[1] > 0 ? columns[1] : 1},
                               .fill = &no_number};
    return hs_h5_dataset(at, "value", &shape);
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
            const hid_t one = hs_h5_group(group, plan->observable[k].name);
            is_fine = one >= 0 && link_times(particles, self, one);
            self->observable[k] = observable_in_time(one, &plan->observable[k]);
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

hs_status hs_h5md_take_name(hs_h5md *self, hs_error *err)
{
    return self->part.path != NULL ? hs_part_file_finish(&self->part, err) : HS_OK;
}

hs_status hs_h5md_make(hs_h5md *self, const hs_h5md_plan *plan, hs_error *err)
{
    HS_TRY(hs_part_file_make(&self->part, self->path, err));
    const hid_t list = hs_h5_driver_list(), create = H5Pcreate(H5P_FILE_CREATE);
    H5Pset_istore_k(create, 128); /* an index node for 256 chunks: few levels in long files */
    errno = 0;
    self->file = H5Fcreate(self->part.path, H5F_ACC_TRUNC, create, list);
    const int error = errno;
    H5Pclose(create);
    H5Pclose(list);
    if (self->file < 0)
        return hs_fail(err, HS_ERROR_IO, "'%s' could not be opened for writing: %s", self->path,
                       error != 0 ? strerror(error) : "HDF5 gives no reason");
    if (!make_metadata(self, plan) || !make_particles(self, plan) || H5Fflush(self->file, H5F_SCOPE_LOCAL) < 0)
        return hs_h5md_fail(self, "written", err);
    return self->is_single ? HS_OK : hs_h5md_take_name(self, err);
}
