/** Random subsets of exactly a given size, as create_atoms ratio|subset and set type/ratio|subset draw them. */
#ifndef HS_DECK_SUBSET_H
#define HS_DECK_SUBSET_H

#include <stdint.h>

#include "base/error.h"

/** Mark n_wanted of n items (mark[n] is 1 for those, else 0), the same ones as LAMMPS on one rank for this seed.
 *  Not collective: equal arguments give equal marks on every rank. n_wanted must be 0 .. n. */
HS_MUST_USE hs_status hs_subset_select(unsigned char *mark, int64_t n, int64_t n_wanted, int seed, hs_error *err);

#endif
