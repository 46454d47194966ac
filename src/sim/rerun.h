/** A run whose atoms come from a trajectory instead of from a time integration. */
#ifndef HS_SIM_RERUN_H
#define HS_SIM_RERUN_H

#include "io/read_dump.h"
#include "sim/sim.h"

/** Words of the command `rerun`. */
typedef struct hs_rerun_plan {
    hs_read_options read;
    int64_t first, last; /**< steps of the first and the last snapshot that counts */
    int64_t every;       /**< only those of steps that are multiples of this, and the first; 0: all */
    int64_t skip;        /**< of these, each skip-th */
    int64_t start, stop; /**< steps that ramps in fixes and thermo's time left refer to */
    bool post;           /**< timing table at the end */
} hs_rerun_plan;

/** Energies, forces and output of each snapshot that the plan wants, as if the run were at its step (collective). Fixes
 *  are asked for forces and samples; none moves atoms. */
HS_MUST_USE hs_status hs_sim_rerun(hs_sim *sim, const hs_rerun_plan *plan, hs_error *err);

#endif
