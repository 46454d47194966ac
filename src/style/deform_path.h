/** How a length or a tilt of the box goes on in time: the styles of fix deform. */
#ifndef HS_STYLE_DEFORM_PATH_H
#define HS_STYLE_DEFORM_PATH_H

#include "style/varying.h"

typedef enum {
    HS_DEFORM_NOT,
    HS_DEFORM_FINAL,
    HS_DEFORM_DELTA,
    HS_DEFORM_SCALE,
    HS_DEFORM_VELOCITY,
    HS_DEFORM_RATE,
    HS_DEFORM_TRUE_RATE,
    HS_DEFORM_VOLUME,
    HS_DEFORM_WIGGLE,
    HS_DEFORM_VARIABLE
} hs_deform_style;

typedef struct hs_deform_path {
    hs_deform_style style;
    double number[2];  /**< of the style; lengths in distance */
    char *variable[2]; /**< owned; equal-style variables: change since the start, distance, and its rate, velocity */
} hs_deform_path;

/** Read `style numbers` from word i on (lengths times @p unit); a tilt has neither scale nor volume, and its final and
 *  delta one number. *n_used counts the words. */
HS_MUST_USE hs_status hs_deform_path_read(hs_deform_path *path, const hs_args *args, int i, bool is_tilt, double unit,
                                          int *n_used, hs_error *err);
void hs_deform_path_fini(hs_deform_path *path);
/** Before a run: variables must be there, with one value; an error names the fix. */
HS_MUST_USE hs_status hs_deform_path_check(const hs_deform_path *path, const hs_fix *fix, hs_error *err);

/** What grows. */
typedef struct hs_deform_start {
    double value;  /**< final only: where it starts, distance */
    double length; /**< that rates and factors refer to, distance */
    double time;   /**< since then */
    int k;         /**< final and delta: which of the numbers is its own */
    /** Steps between changes: as in LAMMPS the rate of trate is that of the value before the present change. */
    int64_t every;
} hs_deform_start;
/** How much more it is at the present step than at the start of the run (or series of runs), and how fast that grows; 0
 *  for HS_DEFORM_NOT and HS_DEFORM_VOLUME. Collective. */
HS_MUST_USE hs_status hs_deform_growth(const hs_deform_path *path, const hs_env *env, const hs_deform_start *start,
                                       double *growth, double *rate, hs_error *err);

#endif
