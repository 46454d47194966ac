/** What commands share that move or remove atoms, or change the box, between runs. */
#ifndef HS_DECK_PLACE_ATOMS_H
#define HS_DECK_PLACE_ATOMS_H

#include "sim/sim.h"

/** Bring all atoms back into the box along periodic axes, however far away they are, and count the crossings.
 *  Collective: an atom farther away than images can be counted stops all ranks. */
HS_MUST_USE hs_status hs_atoms_wrap_all(hs_sim *sim, const char *command, hs_error *err);
/** Atoms that have left the box since the last lists come back, as when new lists are made: with the velocities of their images
 *  where the box flows (`fix deform ... remap v`). Collective. */
HS_MUST_USE hs_status hs_atoms_bring_back(hs_sim *sim, const char *command, hs_error *err);
/** One axis of `boundary`, word i: "p", or one or two of f, s, m for the lower and the upper face. */
HS_MUST_USE hs_status hs_boundary_read(const hs_args *args, int i, int axis, hs_boundary faces[2], hs_error *err);

#endif
