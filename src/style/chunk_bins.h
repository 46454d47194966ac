/** Bins of the box along one to three axes, and shells around a point or an axis: what compute chunk/atom numbers
 *  places by. */
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

/** Shells of equal thickness around a point (no axis has bins), or around a line along the one axis that has bins. */
typedef struct hs_bins_shells {
    int64_t n;        /**< 0: there are none */
    double center[3]; /**< as in the deck, then distance or fractions of the box; of a line, at its axis: unused */
    double radius[2]; /**< inner and outer, the same */
    bool is_periodic; /**< distances are those to the nearest image of the center */
    double place[3], ends[2]; /**< center and radii in the box that bins were last laid over: distance */
} hs_bins_shells;

typedef struct hs_chunk_bins {
    hs_bins_axis axis[3]; /**< [n_axes], the last one changes fastest */
    int n_axes;
    hs_bins_shells shells; /**< change slower than all axes */
    hs_bins_units units;
    hs_bins_discard discard;
} hs_chunk_bins;

/** Read `axis origin delta` n_axes times from word 1 on. Lengths stay in the deck's units until hs_chunk_bins_scale,
 *  for keywords may change these. */
HS_MUST_USE hs_status hs_chunk_bins_read(hs_chunk_bins *bins, const hs_env *env, const hs_args *args, int n_axes,
                                         hs_error *err);
/** The same for `x y z rmin rmax n` of a sphere, and for `axis origin delta c1 c2 rmin rmax n` of a cylinder. */
HS_MUST_USE hs_status hs_chunk_bins_read_sphere(hs_chunk_bins *bins, const hs_args *args, hs_error *err);
HS_MUST_USE hs_status hs_chunk_bins_read_cylinder(hs_chunk_bins *bins, const hs_env *env, const hs_args *args,
                                                  hs_error *err);
/** `axis lo hi` of the keyword bound, from word i on. */
HS_MUST_USE hs_status hs_chunk_bins_read_bound(hs_chunk_bins *bins, const hs_args *args, int i, hs_error *err);
/** After all words: lengths in lattice spacings become distances. */
void hs_chunk_bins_scale(hs_chunk_bins *bins, const hs_env *env);
/** Lay the bins over the present box: *n of them; one, the whole box, without any. *volume is that of one bin, or with
 *  shells of all space along the axes. @p command names the caller in messages. */
HS_MUST_USE hs_status hs_chunk_bins_lay(hs_chunk_bins *bins, const hs_env *env, const char *command, int64_t *n,
                                        double *volume, hs_error *err);
/** Volume of bin c, from 0: distance^3, in two dimensions distance^2. @p volume is that of hs_chunk_bins_lay. */
double hs_chunk_bins_volume(const hs_chunk_bins *bins, const hs_box *box, int64_t c, double volume);
/** How many coordinates the middle of a bin has. */
static inline int hs_chunk_bins_coordinates(const hs_chunk_bins *bins) { return bins->n_axes + (bins->shells.n > 0); }
/** Number of the bin of local atom i, from 0, or -1: outside. */
int64_t hs_chunk_bins_find(const hs_chunk_bins *bins, const hs_env *env, int i);
/** Middle of bin number c: place[hs_chunk_bins_coordinates], the radius first. */
void hs_chunk_bins_place(const hs_chunk_bins *bins, int64_t c, double *place);

#endif
