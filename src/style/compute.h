/** Interface of computes: quantities measured on demand. One compute style is one file in src/compute/. */
#ifndef HS_STYLE_COMPUTE_H
#define HS_STYLE_COMPUTE_H

#include "style/args.h"
#include "style/env.h"
#include "style/state.h"

struct hs_compute;

/** Descriptor of a compute style. Evaluations are collective; results are the same on all ranks. */
typedef struct hs_compute_style {
    hs_description about;
    size_t state_size;
    HS_MUST_USE hs_status (*create)(struct hs_compute *compute, const hs_args *args, hs_error *err);
    void (*destroy)(struct hs_compute *compute);
    HS_MUST_USE hs_status (*init)(struct hs_compute *compute, hs_error *err); /**< before each run */
    HS_MUST_USE hs_status (*scalar)(struct hs_compute *compute, double *value,
                                    hs_error *err); /**< NULL: has no scalar */
    /** Fill compute->vector[n_vector]; NULL: has no vector. */
    HS_MUST_USE hs_status (*vector)(struct hs_compute *compute, hs_error *err);
    /** Take the temperature from another compute (thermo_modify temp, fix_modify temp); NULL: uses none. */
    HS_MUST_USE hs_status (*set_temperature)(struct hs_compute *compute, const char *id, hs_error *err);
    /** Global values that outlive a step (a history), moved into a checkpoint or back (collective). Reading comes after
     *  create and init. NULL: there are none. */
    HS_MUST_USE hs_status (*keep_state)(struct hs_compute *compute, hs_state *state, hs_error *err);
    bool needs_energy;        /**< the pair energy or virial must have been computed on the step it is asked for */
    bool is_extensive;        /**< scalar grows with the number of atoms: divided by N under thermo_modify norm yes */
    bool is_vector_extensive; /**< the same for the elements of the vector */
    bool is_temperature, is_pressure; /**< may serve fix_modify temp / press */
} hs_compute_style;

/** One compute of a simulation. Results are remembered for a step: hs_compute_scalar evaluates at most once a step. */
typedef struct hs_compute {
    const hs_compute_style *style;
    char *id; /**< owned by hs_sim */
    int group;
    uint32_t mask;
    hs_env *env;
    void *state;
    double scalar;
    int64_t scalar_step; /**< -1: not evaluated yet */
    double *vector;      /**< [n_vector], allocated by create, freed by destroy of the style */
    int n_vector;
    int64_t vector_step;
    double n_dof; /**< temperature computes: degrees of freedom */
} hs_compute;

/** Evaluate if needed; an error when the style has none, or needs an energy that this step did not compute. */
HS_MUST_USE hs_status hs_compute_scalar(hs_compute *compute, double *value, hs_error *err);
/** Element i (from 0) of the vector. */
HS_MUST_USE hs_status hs_compute_vector(hs_compute *compute, int i, double *value, hs_error *err);
/** Forget remembered results (positions or velocities were changed between steps). */
void hs_compute_invalidate(hs_compute *compute);

/** All compute styles, ended by NULL; made by the build. */
extern const hs_compute_style *const hs_compute_styles[];

#endif
