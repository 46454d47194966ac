/** Pair kernels and how they are chosen. */
#ifndef HS_KERNEL_KERNEL_H
#define HS_KERNEL_KERNEL_H

#include "base/error.h"

/** A potential compiled for every instruction set; made by kernel/evaluator.h from the file of a pair style. */
typedef struct hs_evaluator {
    int n_params;   /**< doubles per type pair */
    /** The potential of one pair: force/r and energy from r^2 and the pair's parameters. The oracle of all kernels. */
    void (*single)(const double *params, double r2, double *force_over_r, double *energy);
} hs_evaluator;

#endif
