/** What the log says before and after a run, in the form that readers of LAMMPS's logs look for, and the progress
 *  line. */
#ifndef HS_SIM_REPORT_H
#define HS_SIM_REPORT_H

#include "sim/sim.h"

/** Before the first row: how neighbors are found (when that changed since the last run) and memory (collective). */
void hs_report_setup(hs_sim *sim);
/** After the last row: loop time, performance, the timing table, counts of atoms and list builds (collective).
 *  @param loop_s  wall time of the steps, seconds   @param cpu_s  processor time of this rank's threads, seconds
 *  @param statistics  of a minimisation, in place of the performance; NULL: of a run */
void hs_report_finish(hs_sim *sim, int64_t n_steps, double loop_s, double cpu_s, const char *statistics);
/** The first line of that alone. */
void hs_report_loop(hs_sim *sim, int64_t n_steps, double loop_s);
/** After a step: bring the line on the terminal up to date, at most twice a second. Not collective; does nothing when
 *  the screen is not a terminal. */
void hs_report_progress(hs_sim *sim);

#endif
