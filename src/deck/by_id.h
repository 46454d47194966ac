/** Local atoms in the order of their IDs. Commands that draw random numbers or add up velocities go through atoms in
 *  this order, which is LAMMPS's before the first run, and does not depend on how atoms lie in memory or on ranks. */
#ifndef HS_DECK_BY_ID_H
#define HS_DECK_BY_ID_H

#include "sim/sim.h"

/** Indices of the local atoms by ascending ID: (*order)[n_local], owned by the caller (HS_FREE). Not collective. */
HS_MUST_USE hs_status hs_by_id_order(const hs_atoms *atoms, int32_t **order, hs_error *err);

/** Called for one ID. */
typedef hs_status (*hs_by_id_visitor)(void *context, int64_t id, hs_error *err);
/** Visit the IDs of the atoms of all ranks with selected[local index] != 0, ascending; every rank visits all of them,
 *  and holds no more than some thousand at a time. Collective. */
HS_MUST_USE hs_status hs_by_id_visit(const hs_sim *sim, const unsigned char *selected, hs_by_id_visitor visit,
                                     void *context, hs_error *err);

/** IDs of the atoms of all ranks with selected[local index] != 0, ascending: (*ids)[*n], owned by the caller (HS_FREE).
 *  Collective. */
HS_MUST_USE hs_status hs_by_id_members(const hs_sim *sim, const unsigned char *selected, int64_t **ids, int64_t *n,
                                       hs_error *err);

#endif
