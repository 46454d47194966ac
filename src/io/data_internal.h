/** What the files io/data_*.c share. */
#ifndef HS_IO_DATA_INTERNAL_H
#define HS_IO_DATA_INTERNAL_H

#include "io/data_file.h"
#include "io/line_reader.h"

/** Place of an atom by its id. */
typedef struct hs_data_id {
    int64_t id;
    long line; /**< of the file, 0 for atoms that were there before */
    int32_t index;
    bool has_velocity;
} hs_data_id;

/** A data file being read. */
typedef struct hs_data_reader {
    hs_env *env;
    const hs_data_options *options;
    hs_lines lines;

    int64_t n_atoms; /**< header; -1: not given */
    int64_t n_types; /**< header; 0: not given */
    double lo[3], hi[3];
    bool has_bounds[3];

    int n_before; /**< local atoms there were */
    int64_t id_offset;
    hs_data_id *id; /**< owned [n_ids], sorted once the section Atoms is read */
    int n_ids;
    bool image_reset[3]; /**< image flags along an axis that is not periodic were met */
    bool has_atoms, has_velocities, has_masses;
} hs_data_reader;

/** The lines up to the first section; leaves that line held. */
HS_MUST_USE hs_status hs_data_read_header(hs_data_reader *reader, hs_error *err);
/** The section Atoms (the present line is its name). */
HS_MUST_USE hs_status hs_data_read_atoms(hs_data_reader *reader, hs_error *err);
HS_MUST_USE hs_status hs_data_read_velocities(hs_data_reader *reader, hs_error *err);
/** Next line of a section that should have n lines, of which k were read; an error when the section ends early. */
HS_MUST_USE hs_status hs_data_next_row(hs_data_reader *reader, const char *section, int64_t k, int64_t n,
                                       hs_error *err);

#endif
