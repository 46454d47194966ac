/** The columns of an average over chunks: what is added up for each atom, and what the sums of a chunk mean. */
#ifndef HS_IO_CHUNK_COLUMNS_H
#define HS_IO_CHUNK_COLUMNS_H

#include "style/atom_source.h"
#include "style/chunks.h"

typedef enum { HS_NORM_ALL, HS_NORM_SAMPLE, HS_NORM_NONE } hs_chunk_norm;
typedef enum {
    HS_CHUNK_NUMBER,
    HS_CHUNK_MASS_DENSITY,
    HS_CHUNK_MASS,
    HS_CHUNK_TEMPERATURE,
    HS_CHUNK_SOURCE
} hs_chunk_quantity;

typedef struct hs_chunk_column {
    hs_chunk_quantity kind;
    hs_atom_source source; /**< HS_CHUNK_SOURCE; empty for others */
    const char *name;      /**< borrowed: a literal, or source.value.word */
} hs_chunk_column;

typedef struct hs_chunk_columns {
    hs_chunk_column *column; /**< owned [n] */
    int n;
    hs_chunk_norm norm;
    double adof, cdof; /**< degrees of freedom of each atom, of each chunk */
    char *bias_id;     /**< owned; temperature compute whose bias is taken off, or NULL */
} hs_chunk_columns;

void hs_chunk_columns_fini(hs_chunk_columns *columns);
/** The column (or, of a range, columns) that word i names. */
HS_MUST_USE hs_status hs_chunk_columns_add(hs_chunk_columns *columns, hs_env *env, const hs_args *args, int i,
                                           hs_error *err);
/** norm, adof, cdof or bias and its value. */
HS_MUST_USE hs_status hs_chunk_columns_keyword(hs_chunk_columns *columns, const hs_fix *fix, const hs_args *args, int i,
                                               hs_error *err);
/** The compute of bias_id, or NULL without one. */
HS_MUST_USE hs_status hs_chunk_columns_bias(const hs_chunk_columns *columns, const hs_fix *fix, hs_compute **bias,
                                            hs_error *err);
/** Before a run: what references name is there still. */
HS_MUST_USE hs_status hs_chunk_columns_check(const hs_chunk_columns *columns, const hs_fix *fix, const char *command,
                                             hs_error *err);
bool hs_chunk_columns_need_energy(const hs_chunk_columns *columns, hs_env *env);
/** values[n_local]: what column k adds up for each local atom; column -1 is the count (collective). */
HS_MUST_USE hs_status hs_chunk_columns_fill(const hs_chunk_columns *columns, hs_env *env, int k, const hs_compute *bias,
                                            double *values, hs_error *err);
/** A sum over `count` atoms of a chunk of that volume in `n_samples` samples as the mean that the column stands for. */
double hs_chunk_columns_mean(const hs_chunk_columns *columns, const hs_env *env, double volume, int k, double sum,
                             double count, double n_samples);
/** For errors: what one sample of a chunk gives to column k, and the weight that it has in the mean. */
void hs_chunk_columns_weigh(const hs_chunk_columns *columns, const hs_env *env, double volume, int k, double sum,
                            double count, double *value, double *weight);

#endif
