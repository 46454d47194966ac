/** Computes of one row for each chunk of a compute chunk/atom: what those of the names .../chunk share. */
#ifndef HS_STYLE_PER_CHUNK_H
#define HS_STYLE_PER_CHUNK_H

#include "style/chunks.h"
#include "style/places.h"

/** The state of such a compute begins with this. */
typedef struct hs_per_chunk {
    char *chunk_id;         /**< owned */
    hs_compute *chunk_atom; /**< borrowed during an evaluation: the numbers of atoms are current */
    int64_t n;              /**< chunks, then */
    size_t capacity;
    double *value, *sum; /**< owned scratch: of the local atoms [n_local], of chunks [n] */
    /** Owned [n][4]: center of mass, unwrapped, and mass, by hs_per_chunk_find_centers; 0 without atoms. */
    double *center;
    size_t capacity_atoms, capacity_center;
} hs_per_chunk;

/** Read the ID of the compute chunk/atom, word 0. @p n_columns: 1 for a vector, more for an array (or @p is_array). */
HS_MUST_USE hs_status hs_per_chunk_create(hs_compute *compute, const hs_args *args, int n_columns, bool is_array,
                                          hs_error *err);
void hs_per_chunk_destroy(hs_compute *compute);
/** Before runs: there is such a compute still. */
HS_MUST_USE hs_status hs_per_chunk_init(hs_compute *compute, hs_error *err);
/** Number the atoms and make room for as many rows (collective); to be called first by evaluations. */
HS_MUST_USE hs_status hs_per_chunk_begin(hs_compute *compute, hs_error *err);
/** Where column k of chunk c goes: in the vector or the array. */
static inline double *hs_per_chunk_at(hs_compute *compute, int64_t c, int k)
{
    return compute->has_array ? &compute->array[c * compute->n_columns + k] : &compute->vector[c];
}
/** Local atom i's chunk, from 0, or -1: none, or not in the compute's group. */
static inline int64_t hs_per_chunk_of(const hs_compute *compute, int i)
{
    const hs_per_chunk *state = compute->state;
    return compute->env->atoms->mask[i] & compute->mask ? (int64_t)state->chunk_atom->atoms[i] - 1 : -1;
}
/** A value of local atom i; c is its chunk, from 0. */
typedef double (*hs_per_chunk_value)(const hs_compute *compute, int i, int64_t c, const void *context);
/** Column k = sums over the atoms of each chunk (collective). */
HS_MUST_USE hs_status hs_per_chunk_sum(hs_compute *compute, int k, hs_per_chunk_value value, const void *context,
                                       hs_error *err);
/** Columns 0 to n_columns - 1, with the chunks' centers up to date: the context of `value` is an int, the column. A
 *  whole evaluation (collective). */
HS_MUST_USE hs_status hs_per_chunk_sum_moments(hs_compute *compute, hs_per_chunk_value value, hs_error *err);
/** The same as hs_per_chunk_sum, into out[c * stride] for each chunk c. */
HS_MUST_USE hs_status hs_per_chunk_add_up(hs_compute *compute, hs_per_chunk_value value, const void *context,
                                          double *out, int stride, hs_error *err);
/** Bring state->center up to date (collective). */
HS_MUST_USE hs_status hs_per_chunk_find_centers(hs_compute *compute, hs_error *err);
/** Place of local atom i relative to the center of its chunk c. */
static inline void hs_per_chunk_arm(const hs_compute *compute, int i, int64_t c, double d[3])
{
    const double *center = ((const hs_per_chunk *)compute->state)->center + 4 * c;
    for (int axis = 0; axis < 3; ++axis) d[axis] = hs_unwrapped(compute->env, axis, i) - center[axis];
}
/** Means weighted by mass of three values, as columns 0 to 2: `value` gets the axis as its context; 0 where there are
 *  no atoms (collective). */
HS_MUST_USE hs_status hs_per_chunk_mean(hs_compute *compute, hs_per_chunk_value value, hs_error *err);

#endif
