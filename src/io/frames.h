/** Trajectories read back, snapshot by snapshot: LAMMPS's text dumps (styles atom and custom, plain or gzip), XYZ and
 *  H5MD.
 *
 *      hs_frames_open(&frames, plan, parallel, err);
 *      while (hs_frames_next(frames, &snapshot, &is_there, err) == HS_OK && is_there)
 *          do hs_frames_read(frames, &rows, err);        // blocks of rows, in the order of the file
 *          while (rows.n > 0);
 *      hs_frames_close(&frames);
 *
 *  Everything is checked: numbers are finite, types and ids at least 1, and a snapshot that ends before its time is an
 *  error. All functions are collective; rank 0 reads, every rank gets every row, and no rank holds more of them than
 *  one block. Errors name file and line. */
#ifndef HS_IO_FRAMES_H
#define HS_IO_FRAMES_H

#include "core/atom_id.h"
#include "core/box.h"
#include "parallel/parallel.h"

typedef enum {
    HS_FIELD_ID,
    HS_FIELD_TYPE,
    HS_FIELD_X,
    HS_FIELD_Y,
    HS_FIELD_Z,
    HS_FIELD_VX,
    HS_FIELD_VY,
    HS_FIELD_VZ,
    HS_FIELD_IX,
    HS_FIELD_IY,
    HS_FIELD_IZ,
    HS_N_FIELDS
} hs_field;

/** "id", "type", "x", ..., ended by NULL. */
extern const char *const hs_field_names[];

typedef enum { HS_FRAMES_AUTO, HS_FRAMES_NATIVE, HS_FRAMES_XYZ, HS_FRAMES_H5MD } hs_frames_format;

/** What to read from where. Borrowed by hs_frames as long as it is open. */
typedef struct hs_frames_plan {
    const char *const *file; /**< [n_files] read one after the other */
    int n_files;
    hs_frames_format format; /**< HS_FRAMES_AUTO: H5MD files are known by their first bytes, others are native dumps */
    bool wants[HS_N_FIELDS];
    const char *label[HS_N_FIELDS]; /**< column that holds a field, NULL: the one of its name */
    bool is_scaled, is_wrapped;     /**< what x, y, z are when they have labels */
    const char *group;              /**< H5MD: which of /particles; NULL: the only one, or `all` */
} hs_frames_plan;

/** What stands above the rows of a snapshot. */
typedef struct hs_snapshot {
    int64_t step; /**< XYZ files have none: numbers from 0 on */
    bool has_box;
    double lo[3], hi[3]; /**< distance */
    bool is_tilted;      /**< the box has tilts: xy, xz, yz, which may be 0 */
    double tilt[3];
    char boundary[3][2]; /**< p, f, s or m; 0: not told */
    char units[16];      /**< "" when not told */
    bool is_scaled;      /**< x, y, z are fractions of the box */
    bool is_wrapped;     /**< x, y, z are within the box */
} hs_snapshot;

/** Some rows of a snapshot. Fields that are not wanted have no values. */
typedef struct hs_frame_rows {
    int n;         /**< 0: there are no more */
    int64_t first; /**< number of the first one in the snapshot, from 0 */
    const int64_t *id;
    const double *value[HS_N_FIELDS]; /**< types and image flags are whole numbers within 32 bits */
} hs_frame_rows;

typedef struct hs_frames hs_frames;

/** Open the first file. The caller closes it. */
HS_MUST_USE hs_status hs_frames_open(hs_frames **frames, const hs_frames_plan *plan, const hs_parallel *parallel,
                                     hs_error *err);
/** Go on to the next snapshot, whatever is left of the present one, and over the ends of files. */
HS_MUST_USE hs_status hs_frames_next(hs_frames *frames, hs_snapshot *snapshot, bool *is_there, hs_error *err);
/** The next rows, borrowed until the next call. */
HS_MUST_USE hs_status hs_frames_read(hs_frames *frames, hs_frame_rows *rows, hs_error *err);
/** Add to an error the place of row k of the present block. */
void hs_frames_locate(const hs_frames *frames, int k, hs_error *err);
/** NULL is fine. */
void hs_frames_close(hs_frames **frames);

#endif
