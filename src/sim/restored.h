/** What read_restart brings for fixes that the new deck is yet to define: as in LAMMPS, a fix of the same ID and style goes on
 *  from the state it had. It is kept until the next run begins. */
#ifndef HS_SIM_RESTORED_H
#define HS_SIM_RESTORED_H

#include "sim/sim.h"

/** Forget all that is kept. */
void hs_restored_forget(hs_sim *sim);
/** Keep the state of a fix, which is the keeper's from now on. */
HS_MUST_USE hs_status hs_restored_keep_fix(hs_sim *sim, const char *id, const char *style, hs_state *state,
                                           hs_error *err);
/** Keep a field of the atoms, to be filled with what the file has of that name. */
HS_MUST_USE hs_status hs_restored_keep_field(hs_sim *sim, const char *name, size_t size, hs_error *err);
/** A fix was made: its fields of the atoms get what is kept. */
void hs_restored_give_fields(hs_sim *sim, const char *id);
/** A run begins, and fixes are ready: they get their states; the rest is forgotten. States that do not fit are told of. */
HS_MUST_USE hs_status hs_restored_give_states(hs_sim *sim, hs_error *err);

#endif
