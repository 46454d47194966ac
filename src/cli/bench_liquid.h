/** The liquid that `halfshell bench` and `bench kernels` measure with. */
#ifndef HS_CLI_BENCH_LIQUID_H
#define HS_CLI_BENCH_LIQUID_H

#include "deck/deck.h"

/** Set up the Lennard-Jones liquid of LAMMPS's bench/in.lj, of 4 size^3 atoms, with its schedule of lists. No step is
 *  run. */
HS_MUST_USE hs_status hs_bench_feed_liquid(hs_deck *deck, int64_t size, hs_error *err);

#endif
