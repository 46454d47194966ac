/** The experiments of `halfshell bench neighbors`: what is varied, which methods are compared, what is measured. */
#ifndef HS_CLI_BENCH_EXPERIMENTS_H
#define HS_CLI_BENCH_EXPERIMENTS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/** One Lennard-Jones system (cutoff 2.5, skin 0.3) and the method that runs it. */
typedef struct hs_bench_case {
    int size;           /**< fcc cells of four atoms along each edge */
    double density;     /**< of the atoms' crystal */
    double emptiness;   /**< volume of the box over that of the crystal */
    double temperature; /**< at the start */
    double cell;        /**< edge of the cells over the cutoff; 0: the method's own */
    bool is_shuffled;   /**< atoms stand in memory in random order at the start */
    const char *method; /**< words of neighbor_method */
} hs_bench_case;

/** What one measurement gives; NAN where it has no meaning. */
typedef struct hs_bench_sample {
    double total_ns; /**< processor time of an atom-step, nanoseconds */
    double cells_ns; /**< the part of it that brings cells and lists up to date */
    double bytes;    /**< memory of the cells, bytes an atom (methods with chains) */
    double changed;  /**< atoms that changed cell in a step, percent (incremental) */
    double stencil;  /**< cells of the half stencil (methods with chains) */
} hs_bench_sample;

enum { HS_BENCH_POINTS_MAX = 16, HS_BENCH_SERIES_MAX = 10, HS_BENCH_METRICS_MAX = 2 };

/** One line of a picture, and one column of a table. */
typedef struct hs_bench_series {
    const char *name;
    const char *method;  /**< words of neighbor_method */
    int64_t n_atoms_max; /**< beyond, it is left out; 0: no limit */
} hs_bench_series;

/** A number of the samples, with a table of its own. */
typedef struct hs_bench_metric {
    const char *suffix; /**< of the files' names; "" for the first */
    const char *label;  /**< of the vertical axis */
    size_t offset;      /**< of the number in hs_bench_sample */
    bool is_linear;     /**< vertical axis; else logarithmic */
    bool is_drawn;      /**< it has a picture, too */
} hs_bench_metric;

typedef struct hs_bench_experiment {
    const char *name;    /**< word of -only, and of the files' names */
    const char *title;   /**< one line */
    const char *x_label; /**< of the horizontal axis */
    const char *x_name;  /**< of the first column */
    double x[HS_BENCH_POINTS_MAX];
    int n_x;
    bool is_linear_x;
    hs_bench_series series[HS_BENCH_SERIES_MAX]; /**< ended by a NULL name */
    hs_bench_metric metric[HS_BENCH_METRICS_MAX];
    int n_metrics;
    /** Complete a case, which holds the defaults and the series' method, for a place on the horizontal axis. */
    void (*set)(hs_bench_case *c, double x);
} hs_bench_experiment;

extern const hs_bench_experiment hs_bench_experiments[]; /**< ended by a NULL name */

static inline int64_t hs_bench_n_atoms(const hs_bench_case *c) { return (int64_t)4 * c->size * c->size * c->size; }

#endif
