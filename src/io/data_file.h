/** LAMMPS's data files: the commands read_data and write_data. */
#ifndef HS_IO_DATA_FILE_H
#define HS_IO_DATA_FILE_H

#include "base/text.h"
#include "style/args.h"
#include "style/env.h"

enum { HS_DATA_TYPES_MAX = 10000 };

struct hs_fix;

/** read_data fix <ID> NULL <name>: values of a fix, which has some, are read from a section of that name. */
typedef struct hs_data_section {
    struct hs_fix *fix; /**< borrowed */
    const char *name;   /**< borrowed */
} hs_data_section;

/** Words of read_data, and what the reader needs of the pair style. */
typedef struct hs_data_options {
    bool is_added;     /**< add append|merge|N: to the box and atoms there are */
    bool is_appended;  /**< ids go on after the largest one */
    int64_t id_offset; /**< add N */
    int type_offset;   /**< offset */
    double shift[3];   /**< distance */
    int n_extra_types;
    bool may_be_skewed;       /**< box tilt large */
    uint32_t mask;            /**< groups that new atoms join, besides all */
    hs_data_section *section; /**< owned by the command [n_sections] */
    int n_sections;
    bool no_coeffs;         /**< pass over the coefficients */
    const char *pair_style; /**< name of the present pair style, NULL without one */
    /** pair_coeff with the words "I J coefficients..." */
    HS_MUST_USE hs_status (*pair_coeff)(void *context, const hs_args *args, hs_error *err);
    void *context;
} hs_data_options;

/** Read a data file, plain or .gz (collective: the first rank reads, every rank keeps the atoms of its brick). Makes
 *  the box and the types unless options say add; adds the atoms. Everything is checked; errors name file and line, and
 *  leave no atoms behind. The caller then tells the simulation that atoms have changed. */
HS_MUST_USE hs_status hs_data_read(hs_env *env, const char *path, const hs_data_options *options, hs_error *err);

/** Which coefficients write_data writes. */
typedef enum { HS_DATA_PAIR_NONE, HS_DATA_PAIR_II, HS_DATA_PAIR_IJ } hs_data_pair;

typedef struct hs_data_write_options {
    hs_data_pair pair;
    const char *pair_style; /**< NULL: no coefficients */
    /** Append the coefficients of types i <= j, separated by spaces. */
    HS_MUST_USE hs_status (*write_coeff)(void *context, int i, int j, hs_text *words, hs_error *err);
    void *context;
    struct hs_fix *const *fix; /**< borrowed [n_fixes]: those that have sections write them */
    int n_fixes;
} hs_data_write_options;

/** Write a data file that LAMMPS reads too, wholly or not at all: positions in the box, shortest digits that give
 *  the same doubles, atoms in the order of ids, whatever the number of ranks. Collective. */
HS_MUST_USE hs_status hs_data_write(const hs_env *env, const char *path, const hs_data_write_options *options,
                                    hs_error *err);

/** The shortest decimal form of a finite double that reads back as the same bits. */
enum { HS_SHORTEST_SIZE = 32 };
const char *hs_data_shortest(double value, char text[HS_SHORTEST_SIZE]);

#endif
