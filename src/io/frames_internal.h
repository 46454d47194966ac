/** What frames.c and the readers of single formats share. */
#ifndef HS_IO_FRAMES_INTERNAL_H
#define HS_IO_FRAMES_INTERNAL_H

#include "io/frames.h"
#include "io/line_reader.h"

enum { HS_FRAME_BLOCK = 1 << 15, HS_FRAME_IMAGE_MAX = 1 << 30 };

/** How one format is read. All functions are collective. */
typedef struct hs_frames_reader {
    HS_MUST_USE hs_status (*open)(hs_frames *frames, const char *path, hs_error *err);
    void (*close)(hs_frames *frames);
    /** The head of the next snapshot; the rows of the one before were all read. */
    HS_MUST_USE hs_status (*next)(hs_frames *frames, hs_snapshot *snapshot, bool *is_there, hs_error *err);
    /** At most HS_FRAME_BLOCK rows into id[], value[][] and line[]; *n = 0 at the end of the snapshot. */
    HS_MUST_USE hs_status (*read)(hs_frames *frames, int *n, hs_error *err);
    /** Pass over the rows that are left. */
    HS_MUST_USE hs_status (*skip)(hs_frames *frames, hs_error *err);
} hs_frames_reader;

struct hs_frames {
    const hs_frames_plan *plan;
    hs_parallel parallel;
    const hs_frames_reader *reader; /**< of the present file; NULL: none is open */
    int n_opened;                   /**< files opened so far */
    int64_t n_snapshots;            /**< met so far */
    bool is_within;                 /**< rows of the present snapshot may be left */
    int64_t n_read;                 /**< rows of it read so far */

    int64_t *id;                /**< owned [HS_FRAME_BLOCK] */
    double *value[HS_N_FIELDS]; /**< owned [HS_FRAME_BLOCK]; NULL: not wanted */
    long *line;                 /**< owned [HS_FRAME_BLOCK]; line of each row; 0: not a text */

    /* Texts */
    hs_lines lines;
    int64_t n_rows; /**< of the present snapshot */
    int64_t n_seen;
    int n_columns;
    int column[HS_N_FIELDS]; /**< of the fields; -1: none */

    struct hs_frames_h5 *h5; /**< owned; H5MD */
};

extern const hs_frames_reader hs_frames_native, hs_frames_xyz, hs_frames_h5md;

/** Text of a number that a field may have, into value[field][k]; errors say what is wrong. */
HS_MUST_USE hs_status hs_frames_number(hs_frames *frames, int field, const char *word, int k, hs_error *err);
/** Whether the field is a coordinate, an image flag. */
static inline bool hs_field_is_place(int field) { return field >= HS_FIELD_X && field <= HS_FIELD_Z; }
static inline bool hs_field_is_image(int field) { return field >= HS_FIELD_IX && field <= HS_FIELD_IZ; }

#endif
