/** Between the files style/nose_hoover*.c. */
#ifndef HS_STYLE_NOSE_HOOVER_INTERNAL_H
#define HS_STYLE_NOSE_HOOVER_INTERNAL_H

#include "style/nose_hoover.h"

/** What the chain of the barostat keeps, energy. */
double hs_nose_hoover_barostat_target(const hs_nose_hoover *nh, double kt);
/** Length of the vector f_ID. */
int hs_nose_hoover_n_vector(const hs_nose_hoover *nh);
/** Scale the thermal velocities of the group: by the bias of @p temperature. */
void hs_nose_hoover_scale(const hs_fix *fix, const hs_compute *temperature, const double factor[3]);
/** The same, with the shear (xy, xz, yz) between two such scalings: it takes shear[0] v_y + shear[1] v_z off v_x, and shear[2]
 *  v_z off v_y. */
void hs_nose_hoover_shear(const hs_fix *fix, const hs_compute *temperature, const double factor[3],
                          const double shear[3]);
/** Scale them and let the flow act on them, for half a step. @p temperature NULL: the flow itself is the bias. */
void hs_nose_hoover_flow(const hs_fix *fix, const hs_compute *temperature, double factor);
/** Half a step of the velocities, and a step of the places. */
void hs_nose_hoover_kick(const hs_fix *fix);
void hs_nose_hoover_drift(const hs_fix *fix);
/** Targets of the present step, and the strain energy's. */
void hs_nose_hoover_find_targets(const hs_fix *fix);
/** The present box becomes the reference. */
void hs_nose_hoover_set_reference(hs_nose_hoover *nh, const hs_box *box);
/** The present pressure. At the start of a step that is the virial of the step before with the present velocities. */
HS_MUST_USE hs_status hs_nose_hoover_measure_pressure(const hs_fix *fix, hs_error *err);
/** Masses of the barostat and its chain. As in LAMMPS they stay through a run, even when its temperature changes. */
void hs_nose_hoover_set_barostat_masses(hs_nose_hoover *nh, const hs_env *env);
/** Half a step of the strain rates: by their chain; by the pressure. */
void hs_nose_hoover_advance_barostat_chain(const hs_fix *fix);
HS_MUST_USE hs_status hs_nose_hoover_kick_barostat(const hs_fix *fix, hs_error *err);
/** The strain rates act for half a step: on the velocities; on box and places. */
HS_MUST_USE hs_status hs_nose_hoover_strain_velocities(const hs_fix *fix, hs_error *err);
void hs_nose_hoover_strain_box(const hs_fix *fix);
/** Read the words; part of create. */
HS_MUST_USE hs_status hs_nose_hoover_read(hs_fix *fix, const hs_args *args, hs_error *err);

#endif
