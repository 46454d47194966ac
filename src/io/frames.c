#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "io/frames_internal.h"

const char *const hs_field_names[] = {"id", "type", "x", "y", "z", "vx", "vy", "vz", "ix", "iy", "iz", NULL};

hs_status hs_frames_number(hs_frames *frames, int field, const char *word, int k, hs_error *err)
{
    int64_t whole;
    double number;
    if (field == HS_FIELD_ID) {
        if (!hs_text_to_int64(word, &frames->id[k]) || frames->id[k] < 1 || frames->id[k] > HS_ATOM_ID_MAX)
            return hs_fail(err, HS_ERROR_INPUT, "'%s' is not an atom id (a whole number from 1 to 2^62)", word);
        return HS_OK;
    }
    if (field == HS_FIELD_TYPE || hs_field_is_image(field)) {
        const int64_t least = field == HS_FIELD_TYPE ? 1 : -HS_FRAME_IMAGE_MAX;
        if (!hs_text_to_int64(word, &whole) || whole < least || whole > HS_FRAME_IMAGE_MAX)
            return hs_fail(err, HS_ERROR_INPUT, "'%s' is not an %s", word,
                           field == HS_FIELD_TYPE ? "atom type (a whole number of 1 or more)"
                                                  : "image flag (a whole number)");
        frames->value[field][k] = (double)whole;
        return HS_OK;
    }
    if (!hs_text_to_double(word, &number))
        return hs_fail(err, HS_ERROR_INPUT, "'%s' is not a finite number (%s)", word, hs_field_names[field]);
    frames->value[field][k] = number;
    return HS_OK;
}

/** Whether the file begins as HDF5 files do; 0 for what cannot be read, which opening it will say. */
static bool is_hdf5(const hs_frames *frames, const char *path)
{
    static const char signature[8] = "\x89HDF\r\n\x1a\n";
    char head[sizeof signature] = "";
    int64_t is_it = 0;
    FILE *file = frames->parallel.rank == 0 ? fopen(path, "rb") : NULL;
    if (file != NULL) {
        is_it = fread(head, 1, sizeof head, file) == sizeof head && memcmp(head, signature, sizeof head) == 0;
        fclose(file);
    }
    hs_parallel_broadcast(&frames->parallel, 0, &is_it, sizeof is_it);
    return is_it != 0;
}

static hs_status open_next(hs_frames *frames, hs_error *err)
{
    static const hs_frames_reader *const readers[] = {
        [HS_FRAMES_NATIVE] = &hs_frames_native, [HS_FRAMES_XYZ] = &hs_frames_xyz, [HS_FRAMES_H5MD] = &hs_frames_h5md};
    const char *path = frames->plan->file[frames->n_opened++];
    hs_frames_format format = frames->plan->format;
    if (format == HS_FRAMES_AUTO) format = is_hdf5(frames, path) ? HS_FRAMES_H5MD : HS_FRAMES_NATIVE;
    HS_TRY(readers[format]->open(frames, path, err));
    frames->reader = readers[format];
    return HS_OK;
}

hs_status hs_frames_open(hs_frames **frames, const hs_frames_plan *plan, const hs_parallel *parallel, hs_error *err)
{
    HS_TRY(HS_ALLOC(*frames, 1, err));
    hs_frames *self = *frames;
    self->plan = plan;
    self->parallel = *parallel;
    hs_status status = HS_ALLOC(self->id, HS_FRAME_BLOCK, err);
    if (status == HS_OK) status = HS_ALLOC(self->line, HS_FRAME_BLOCK, err);
    for (int field = 1; field < HS_N_FIELDS && status == HS_OK; ++field)
        if (plan->wants[field]) status = HS_ALLOC(self->value[field], HS_FRAME_BLOCK, err);
    status = hs_parallel_agree(parallel, err);
    if (status == HS_OK) status = open_next(self, err);
    if (status != HS_OK) hs_frames_close(frames);
    return status;
}

static void close_file(hs_frames *frames)
{
    if (frames->reader != NULL) frames->reader->close(frames);
    frames->reader = NULL;
}

hs_status hs_frames_next(hs_frames *frames, hs_snapshot *snapshot, bool *is_there, hs_error *err)
{
    *is_there = false;
    if (frames->is_within) HS_TRY(frames->reader->skip(frames, err));
    frames->is_within = false;
    while (frames->reader != NULL) {
        *snapshot = (hs_snapshot){.is_wrapped = true};
        HS_TRY(frames->reader->next(frames, snapshot, is_there, err));
        if (*is_there) break;
        close_file(frames);
        if (frames->n_opened < frames->plan->n_files) HS_TRY(open_next(frames, err));
    }
    frames->is_within = *is_there;
    frames->n_read = 0;
    frames->n_snapshots += *is_there;
    return HS_OK;
}

hs_status hs_frames_read(hs_frames *frames, hs_frame_rows *rows, hs_error *err)
{
    *rows = (hs_frame_rows){.id = frames->id, .first = frames->n_read};
    for (int field = 1; field < HS_N_FIELDS; ++field) rows->value[field] = frames->value[field];
    if (!frames->is_within) return HS_OK;
    HS_TRY(frames->reader->read(frames, &rows->n, err));
    frames->n_read += rows->n;
    frames->is_within = rows->n > 0;
    return HS_OK;
}

void hs_frames_locate(const hs_frames *frames, int k, hs_error *err)
{
    hs_error_locate(err, frames->plan->file[frames->n_opened - 1], frames->line[k]);
}

void hs_frames_close(hs_frames **frames)
{
    if (*frames == NULL) return;
    close_file(*frames);
    for (int field = 0; field < HS_N_FIELDS; ++field) HS_FREE((*frames)->value[field]);
    HS_FREE((*frames)->id);
    HS_FREE((*frames)->line);
    HS_FREE(*frames);
}
