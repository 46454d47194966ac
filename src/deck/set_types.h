/** Types for a part of the atoms, drawn at random: type/fraction, type/ratio and type/subset of `set`. */
#ifndef HS_DECK_SET_TYPES_H
#define HS_DECK_SET_TYPES_H

#include "sim/sim.h"

/** The keyword at word i, with `fraction or number` and `seed` as words i + 2 and i + 3: that part of the flagged local
 *  atoms (flag[n_local]), of which there are @p n_all on all ranks, gets the type. The atoms are those that LAMMPS
 *  would choose, on any number of ranks. *n is how many were changed on this one (collective). */
HS_MUST_USE hs_status hs_set_random_types(hs_sim *sim, const unsigned char *flag, int64_t n_all, const hs_args *args,
                                          int i, int type, int64_t *n, hs_error *err);

#endif
