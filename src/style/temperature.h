/** What all temperature computes share: degrees of freedom, sums, compute_modify. Their state begins with an
 *  hs_temperature.
 *
 *  Thermal is a velocity without its bias, the part that the style leaves out (hs_compute_style.bias): thermostats
 *  change only the thermal part. */
#ifndef HS_STYLE_TEMPERATURE_H
#define HS_STYLE_TEMPERATURE_H

#include "style/compute.h"

enum { HS_ALL_AXES = -1 };

typedef struct hs_temperature {
    int n_axes;       /**< degrees of freedom of an atom; HS_ALL_AXES: as many as the box has dimensions */
    double n_fixed;   /**< not thermal, to be taken off: compute_modify extra/dof */
    double n_bias;    /**< degrees of freedom that the bias takes, to be taken off too */
    bool has_n_fixed; /**< else they are those of one atom */
    bool is_dynamic;  /**< atoms are counted at each evaluation: compute_modify dynamic/dof */
} hs_temperature;

/** Room for the tensor. The dimensions of the box are looked up when atoms are counted: the temperature of the thermo
 *  output exists before the deck says `dimension 2`. */
HS_MUST_USE hs_status hs_temperature_create(hs_compute *compute, int n_axes, hs_error *err);
void hs_temperature_destroy(hs_compute *compute);
/** Count the atoms: compute->n_dof. Before each run (collective). */
HS_MUST_USE hs_status hs_temperature_init(hs_compute *compute, hs_error *err);
/** Refuse a number of degrees of freedom (compute->n_dof) below 0, unless there are no atoms or these are counted again. */
HS_MUST_USE hs_status hs_temperature_check_freedom(const hs_compute *compute, int64_t n, hs_error *err);
/** T = sum(m v_thermal^2) / (n_dof k) (collective). */
HS_MUST_USE hs_status hs_temperature_scalar(hs_compute *compute, double *value, hs_error *err);
/** sum(m v_a v_b) of the thermal velocities: xx yy zz xy xz yz (collective). */
HS_MUST_USE hs_status hs_temperature_vector(hs_compute *compute, hs_error *err);
/** Whether atoms come and go, so that degrees of freedom are counted whenever the temperature is asked for. */
bool hs_temperature_is_recounted(const hs_compute *compute);
HS_MUST_USE hs_status hs_temperature_modify(hs_compute *compute, const hs_args *args, int *n_used, hs_error *err);

#endif
