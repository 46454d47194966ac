/** What the files io/data_*.c share. */
#ifndef HS_IO_DATA_INTERNAL_H
#define HS_IO_DATA_INTERNAL_H

#include "io/data_file.h"
#include "io/line_reader.h"
#include "style/fix.h"

/** Place of an atom by its id. A rank knows the atoms it owns, and of the others those whose ids it watches for being
 *  given twice: each id is watched by one rank, so that no rank knows all. */
typedef struct hs_data_id {
    int64_t id;
    long line;       /**< of the file, 0 for atoms that were there before */
    int32_t index;   /**< local index, -1: the atom is another rank's */
    int32_t section; /**< the last one that had a line for it; HS_DATA_VELOCITIES, or after that, a fix's */
} hs_data_id;
enum { HS_DATA_VELOCITIES = 1 };

/** A data file being read. */
typedef struct hs_data_reader {
    hs_env *env;
    const hs_data_options *options;
    hs_lines lines;

    int64_t n_atoms; /**< header; -1: not given */
    int64_t n_types; /**< header; 0: not given */
    double lo[3], hi[3];
    bool has_bounds[3];
    bool is_tilted; /**< the line `xy xz yz` is there */
    double tilt[3];

    int n_before; /**< local atoms there were */
    int64_t id_offset;
    hs_data_id *id; /**< owned [n_ids], sorted once the section Atoms is read */
    int64_t n_ids;
    size_t capacity_ids;
    int64_t *before;     /**< owned [n_before], sorted: ids of the local atoms there were */
    hs_error late;       /**< an error that only this rank has met; agreed at the end of the section */
    bool image_reset[3]; /**< image flags along an axis that is not periodic were met */
    bool has_atoms, has_velocities, has_masses;
    bool *has_section; /**< owned [options->n_sections] */
} hs_data_reader;

/** What stands in a line of the section Atoms after id and type. */
typedef enum { HS_DATA_PLACE, HS_DATA_DIAMETER, HS_DATA_DENSITY, HS_DATA_CHARGE, HS_DATA_DIPOLE } hs_data_column;
typedef struct hs_data_columns {
    hs_data_column column[8];
    int n;
    int n_words; /**< with id and type, without image flags */
} hs_data_columns;

/** The columns of an atom style, in LAMMPS's order. */
hs_data_columns hs_data_columns_of(const hs_atom_style *style);
/** Refuse a line of Atoms that has another number of words. */
HS_MUST_USE hs_status hs_data_refuse_columns(const hs_atom_style *style, int n_words, hs_error *err);
/** Values of one column into atom i (not its place), or out of it: the latter gives their number. */
HS_MUST_USE hs_status hs_data_set_column(hs_atoms *atoms, int i, hs_data_column kind, const double *value,
                                         hs_error *err);
int hs_data_column_words(hs_data_column kind);
int hs_data_get_column(const hs_atoms *atoms, int i, hs_data_column kind, const double place[3], double value[3]);

/** The lines up to the first section; leaves that line held. */
HS_MUST_USE hs_status hs_data_read_header(hs_data_reader *reader, hs_error *err);
/** The section Atoms (the present line is its name). */
HS_MUST_USE hs_status hs_data_read_atoms(hs_data_reader *reader, hs_error *err);
HS_MUST_USE hs_status hs_data_read_velocities(hs_data_reader *reader, hs_error *err);
/** Local index of a new atom, -1 where it is another rank's or none of the file's (*is_new false). The rank that
 *  watches the id keeps an error for the end of the section (late) when there is no such atom in the file, or it had a
 *  line in this section already. */
int hs_data_find_atom(hs_data_reader *reader, int64_t id, int32_t section, const char *name, bool *is_new);
HS_MUST_USE hs_status hs_data_read_id(const hs_data_reader *reader, const char *word, int64_t *id, hs_error *err);
/** The section of a fix by its name, NULL: there is none. */
const hs_data_section *hs_data_find_section(const hs_data_reader *reader, const char *name);
HS_MUST_USE hs_status hs_data_read_section(hs_data_reader *reader, const hs_data_section *section, hs_error *err);
void hs_data_warn_of_missing(const hs_data_reader *reader);
/** Next line of a section that should have n lines, of which k were read; an error when the section ends early. */
HS_MUST_USE hs_status hs_data_next_row(hs_data_reader *reader, const char *section, int64_t k, int64_t n,
                                       hs_error *err);

#endif
