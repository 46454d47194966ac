/** Bins of the box along one to three axes: what compute chunk/atom numbers places by. */
#ifndef HS_STYLE_CHUNK_BINS_H
#define HS_STYLE_CHUNK_BINS_H

#include "style/args.h"
#include "style/env.h"

typedef enum { HS_BINS_LATTICE, HS_BINS_BOX, HS_BINS_REDUCED } hs_bins_units;
typedef enum { HS_BINS_FROM_LOWER, HS_BINS_FROM_CENTER, HS_BINS_FROM_UPPER, HS_BINS_FROM_NUMBER } hs_bins_origin;
typedef enum { HS_DISCARD_MIXED, HS_DISCARD_YES, HS_DISCARD_NO } hs_bins_discard;

/** Bins along one axis. Lengths in distance, or fractions of the box with units reduced. */
typedef struct hs_bins_axis {
    int axis;
    hs_bins_origin from;
    double origin, delta;
    bool has_bound[2]; /**< else the box's face */
    double bound[2];
    double offset; /**< lower end of the first bin */
    int64_t n;
} hs_bins_axis;

typedef struct hs_chunk_bins {
    hs_bins_axis axis[3]; /**< [n_axes], the last one changes fastest */
    int n_axes;
    hs_bins_units units;
    hs_bins_discard discard;
} hs_chunk_bins;

/** Read `axis origin delta` n_axes times from word 1 on. Lengths stay in the deck's units until hs_chunk_bins_scale, for
 *  keywords may change these. */
HS_MUST_USE hs_status hs_chunk_bins_read(hs_chunk_bins *bins, const hs_env *env, const hs_args *args, int n_axes,
                                         hs_error *err);
/** `axis lo hi` of the keyword bound, from word i on. */
HS_MUST_USE hs_status hs_chunk_bins_read_bound(hs_chunk_bins *bins, const hs_args *args, int i, hs_error *err);
void hs_chunk_bins_scale(hs_chunk_bins *bins, const hs_env *env);
/** Lay the bins over the present box: *n of them, each with *volume. @p command names the caller in messages. */
HS_MUST_USE hs_status hs_chunk_bins_lay(hs_chunk_bins *bins, const hs_env *env, const char *command, int64_t *n,
                                        double *volume, hs_error *err);
/** Number of the bin of local atom i, from 0, or -1: outside. */
int64_t hs_chunk_bins_find(const hs_chunk_bins *bins, const hs_env *env, int i);
/** Middle of bin number c: place[n_axes]. */
void hs_chunk_bins_place(const hs_chunk_bins *bins, int64_t c, double *place);

#endif
