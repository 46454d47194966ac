/** What fix ave/histo and fix ave/histo/weight share: everything but their descriptions. */
#ifndef HS_IO_HISTOGRAM_H
#define HS_IO_HISTOGRAM_H

#include "io/average.h"
#include "style/atom_source.h"

typedef enum { HS_BEYOND_IGNORE, HS_BEYOND_END, HS_BEYOND_EXTRA } hs_beyond;

/** Counts of one sample, or of one window: these numbers, then one for each bin. */
enum { HS_HISTO_TOTAL, HS_HISTO_MISSING, HS_HISTO_BINS };

/** State of such a fix. */
typedef struct hs_histogram {
    hs_schedule schedule;
    double lo, hi;
    int n_bins;   /**< with beyond extra the first and the last are for what is below lo and above hi */
    double width; /**< of a bin */
    hs_beyond beyond;
    bool is_weighted;       /**< the second input is the weight of the first */
    bool is_vector;         /**< mode vector */
    hs_value_shape shape;   /**< of all inputs */
    hs_atom_source *inputs; /**< owned [n_inputs] */
    int n_inputs;
    double *count;          /**< owned [HS_HISTO_BINS + n_bins]: of the present window */
    double extreme[2];      /**< least and greatest value of the present window */
    double (*extremes)[2];  /**< owned: of the windows that count (ave window), else of all */
    double *value, *weight; /**< owned [capacity] scratch: of one input, and of the weights */
    size_t capacity_value, capacity_weight;
    hs_fold fold; /**< of count[] */
    hs_average_file file;
} hs_histogram;

/** Keywords, for the syntax of the styles. */
extern const hs_keyword hs_histogram_keywords[];

/** All hooks of the styles but create, which is `create`. */
#define HS_HISTOGRAM_HOOKS                                                                                             \
    .state_size = sizeof(hs_histogram), .create = create, .destroy = hs_histogram_destroy, .init = hs_histogram_init,  \
    .measure_at_setup = hs_histogram_end_of_step, .end_of_step = hs_histogram_end_of_step,                             \
    .vector = hs_histogram_vector, .n_vector = 4, .array = hs_histogram_array,                                         \
    .needs_energy = hs_histogram_needs_energy, .keep_state = hs_histogram_keep_state, .is_time_dependent = true,       \
    .keeps_plane = true

/* These, as in style/fix.h. */
HS_MUST_USE hs_status hs_histogram_create(hs_fix *fix, const hs_args *args, bool is_weighted, hs_error *err);
void hs_histogram_destroy(hs_fix *fix);
HS_MUST_USE hs_status hs_histogram_init(hs_fix *fix, hs_error *err);
HS_MUST_USE hs_status hs_histogram_end_of_step(hs_fix *fix, hs_error *err);
HS_MUST_USE hs_status hs_histogram_vector(hs_fix *fix, int i, double *value, hs_error *err);
HS_MUST_USE hs_status hs_histogram_array(hs_fix *fix, int i, int j, double *value, hs_error *err);
HS_MUST_USE hs_status hs_histogram_keep_state(hs_fix *fix, hs_state *kept, hs_error *err);
bool hs_histogram_needs_energy(const hs_fix *fix, int64_t step);

/* Between io/histogram.c and histogram_read.c. */
/** Extremes of no values at all, as LAMMPS shows them. */
extern const double hs_histogram_nothing[2];
/** Whether the inputs are there, and of the shape that is counted. */
HS_MUST_USE hs_status hs_histogram_check(const hs_fix *fix, const char *command, hs_error *err);

#endif
