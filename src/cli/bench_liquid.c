#include "cli/bench_liquid.h"

#include <stdio.h>

hs_status hs_bench_feed_liquid(hs_deck *deck, int64_t size, hs_error *err)
{
    char region[96];
    snprintf(region, sizeof region, "region box block 0 %lld 0 %lld 0 %lld", (long long)size, (long long)size,
             (long long)size);
    const char *const lines[] = {"units lj",
                                 "atom_style atomic",
                                 "lattice fcc 0.8442",
                                 region,
                                 "create_box 1 box",
                                 "create_atoms 1 box",
                                 "mass 1 1.0",
                                 "velocity all create 1.44 87287 loop geom",
                                 "pair_style lj/cut 2.5",
                                 "pair_coeff 1 1 1.0 1.0 2.5",
                                 "neighbor 0.3 bin",
                                 "neigh_modify delay 0 every 20 check no",
                                 "fix 1 all nve",
                                 "thermo 100"};
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; ++i) HS_TRY(hs_deck_command(deck, lines[i], err));
    return HS_OK;
}
