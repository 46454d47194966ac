/** What is told and kept when atoms have moved as no system does: HS_ERROR_ATOMS. */
#ifndef HS_SIM_VIOLATION_H
#define HS_SIM_VIOLATION_H

#include "sim/sim.h"

/** The force between two atoms is infinite: name the two that are nearest to each other (collective). */
HS_MUST_USE hs_status hs_sim_report_overlap(hs_sim *sim, hs_error *err);

/** Write the atoms as they were when lists were last made, the last state that is known to be sound, and, if there is
 *  something to be seen, as they are, to failed.STEP.dump; @p err, which tells the violation and which all ranks hold,
 *  gets the file's name. Nothing is written for simulations that no program drives (collective). */
void hs_sim_show_violation(hs_sim *sim, hs_error *err);

#endif
