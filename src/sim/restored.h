/** What read_restart brings for fixes and computes that the new deck is yet to define: as in LAMMPS, one of the same ID
 *  and style goes on from the state it had. It is kept until the next run begins. */
#ifndef HS_SIM_RESTORED_H
#define HS_SIM_RESTORED_H

#include "sim/sim.h"

typedef enum { HS_RESTORED_FIX, HS_RESTORED_COMPUTE, HS_N_RESTORED } hs_restored_kind;
/** "fix", "compute": also how names of their fields of the atoms begin. */
extern const char *const hs_restored_kinds[];

/** Forget all that is kept. */
void hs_restored_forget(hs_sim *sim);
/** Keep the state of a fix or compute, which is the keeper's from now on; @p name is that of the style. */
HS_MUST_USE hs_status hs_restored_keep_style(hs_sim *sim, hs_restored_kind kind, const char *id, const char *name,
                                             hs_state *state, hs_error *err);
/** Keep a field of the atoms, to be filled with what the file has of that name. */
HS_MUST_USE hs_status hs_restored_keep_field(hs_sim *sim, const char *name, size_t size, hs_error *err);
/** A fix or compute was made: its fields of the atoms get what is kept of their names, or, where that was of another ID
 *  or style, it is forgotten. */
void hs_restored_give_fields(hs_sim *sim, hs_restored_kind kind, const char *id);
/** A run begins, and fixes and computes are ready: they get their states; the rest is forgotten. States that do not fit
 *  are told of. */
HS_MUST_USE hs_status hs_restored_give_states(hs_sim *sim, hs_error *err);

#endif
