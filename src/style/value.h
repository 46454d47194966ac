/** Values that a deck names: c_ID, c_ID[i], c_ID[i][j] of computes, f_ID... of fixes, v_name of variables, i_name and
 *  d_name of atoms. Thermo output, formulas, dumps, averages and reductions read them all through here.
 *
 *  What a reference means depends on who asks, as in LAMMPS:
 *    number   c_ID the scalar, c_ID[i] an element of the vector, c_ID[i][j] one of the array (row i, column j)
 *    vector   c_ID the vector, c_ID[j] column j of the array
 *    (v_name the vector of a vector-style variable, v_name[i] an element of it)
 *    atoms    c_ID the value of each atom, c_ID[j] column j of the values of each atom
 *    local    c_ID the value of each row (style/local_rows.h), c_ID[j] column j of the rows; of computes only */
#ifndef HS_STYLE_VALUE_H
#define HS_STYLE_VALUE_H

#include "style/compute.h"
#include "style/fix.h"

typedef enum { HS_VALUE_NUMBER, HS_VALUE_VECTOR, HS_VALUE_ATOMS, HS_VALUE_LOCAL } hs_value_shape;

typedef struct hs_value {
    char kind;  /**< 'c', 'f', 'v', 'i', 'd' */
    char *word; /**< owned; as in the deck, with ranges expanded */
    char *id;   /**< owned */
    int n_indices;
    int64_t index[2]; /**< from 1 */
} hs_value;

/** Whether a word has the form of a reference: c_ID, f_ID with up to two [i] (each a number, or a range with *),
 *  v_name with up to one [i], i_name or d_name. For the first pass over a deck. */
bool hs_value_is_reference(const char *word);

/** Read references; those with a range, c_ID[*] or c_ID[2*4], become several. Fails when a word is no reference, or
 *  what it names does not exist or has no such shape. (*values)[*n] is the caller's: hs_values_destroy. Not
 *  collective. */
HS_MUST_USE hs_status hs_values_create(hs_value **values, int *n, hs_env *env, const hs_args *args, int first,
                                       int n_words, hs_value_shape shape, hs_error *err);
/** The same for values that need not exist yet, unless a range asks for their length. */
HS_MUST_USE hs_status hs_values_read(hs_value **values, int *n, hs_env *env, const hs_args *args, int first,
                                     int n_words, hs_value_shape shape, hs_error *err);
void hs_values_destroy(hs_value **values, int n);
/** As hs_values_create for one word, which may not have a range. Zero it before; free with hs_value_fini. */
HS_MUST_USE hs_status hs_value_init(hs_value *value, hs_env *env, const hs_args *args, int i, hs_value_shape shape,
                                    hs_error *err);
void hs_value_fini(hs_value *value);

/** Fail, naming @p command, unless the value exists and has that shape (computes and fixes may have been removed
 *  since). Elements beyond the end are refused. */
HS_MUST_USE hs_status hs_value_check(hs_env *env, const hs_value *value, hs_value_shape shape, const char *command,
                                     hs_error *err);
/** The same for values[n]. */
HS_MUST_USE hs_status hs_values_check(hs_env *env, const hs_value *values, int n, hs_value_shape shape,
                                      const char *command, hs_error *err);
/** Whether the shape is there at all: no error. */
bool hs_value_has(hs_env *env, const hs_value *value, hs_value_shape shape);
/** Whether there is the compute or fix that a reference c_ID or f_ID names. */
bool hs_value_exists(hs_env *env, const hs_value *value);
/** How many elements, columns or rows index number @p which (0 or 1) may count in that shape; 0: the shape has none. */
int hs_value_limit(hs_env *env, const hs_value *value, hs_value_shape shape, int which);

/** Bring a vector, or column of an array, whose length varies up to date, so that hs_value_length is that of now
 *  (collective). Nothing for all others. */
HS_MUST_USE hs_status hs_value_refresh(hs_env *env, const hs_value *value, hs_error *err);
/** Whether the length of a vector, or of an array's columns, varies. */
bool hs_value_is_variable(hs_env *env, const hs_value *value);
/** Elements of a vector (or rows of an array, when a column is named); 0 when there is none. */
int hs_value_length(hs_env *env, const hs_value *value);
/** The number now (collective). */
HS_MUST_USE hs_status hs_value_number(hs_env *env, const hs_value *value, double *number, hs_error *err);
/** out[hs_value_length] (collective). */
HS_MUST_USE hs_status hs_value_vector(hs_env *env, const hs_value *value, double *out, hs_error *err);
/** out[n_local]: the value of each local atom (collective). */
HS_MUST_USE hs_status hs_value_atoms(hs_env *env, const hs_value *value, double *out, hs_error *err);

/** Local values now (collective): *rows, of which *column[i] is the value of row i, both borrowed for one revision. */
HS_MUST_USE hs_status hs_value_local(hs_env *env, const hs_value *value, const hs_local_rows **rows,
                                     const double **column, hs_error *err);

/** Fail, naming @p command, unless two local values have the same rows, as many on every rank that is (collective, errors
 *  agreed). */
HS_MUST_USE hs_status hs_values_check_rows(hs_env *env, const hs_value *a, const hs_value *b, const char *command,
                                           hs_error *err);

/** All that a reference stands for, of the first shape that is there: a number, an array (c_ID), a vector (c_ID;
 *  c_ID[j]: column j of an array). */
typedef struct hs_value_extents {
    int rank; /**< 0: a number; 1: a vector; 2: an array */
    int n[2]; /**< lengths; 1 beyond the rank */
} hs_value_extents;

/** Fail, naming @p command, unless there is one. Lengths may be others at another time. */
HS_MUST_USE hs_status hs_value_find_extents(hs_env *env, const hs_value *value, const char *command,
                                            hs_value_extents *extents, hs_error *err);
/** out[n[0]][n[1]], with the extents of now (collective). */
HS_MUST_USE hs_status hs_value_all(hs_env *env, const hs_value *value, const hs_value_extents *extents, double *out,
                                   hs_error *err);

/** Whether the value may ask for the pair energy or virial. What a variable asks for is not known before it does:
 *  yes. */
bool hs_value_needs_energy(hs_env *env, const hs_value *value);
/** Whether one of values[n] may. */
bool hs_values_need_energy(hs_env *env, const hs_value *values, int n);
/** Tell the compute that it will be asked for at the end of the coming step: hs_compute_style.announce. */
void hs_value_announce(hs_env *env, const hs_value *value);
/** Whether the number grows with the number of atoms. */
bool hs_value_is_extensive(hs_env *env, const hs_value *value);

#endif
