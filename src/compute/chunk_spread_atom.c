/* Values of chunks as values of their atoms. */
#include <stdio.h>

#include "compute/spread.h"
#include "style/chunks.h"

static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    hs_compute *chunks;
    char index[160];
    HS_TRY(hs_chunks_find(compute->env, args->word[0], args->command, &chunks, err));
    snprintf(index, sizeof index, "c_%.150s", args->word[0]);
    return spread_create(compute, args, index, err);
}

const hs_compute_style hs_compute_style_chunk_spread_atom = {
    .about =
        {.name = "chunk/spread/atom",
         .syntax = {.usage = "<chunk-ID> <vector> ...", .n_min = 2, .n_max = -1},
         .summary = "values of chunks as values of their atoms",
         .details =
             "Each atom has the value of the chunk of compute chunk/atom that it belongs to. A value of chunks is a "
             "vector `c_ID` or `f_ID` with an element for each chunk, or a column of an array, `c_ID[j]` or "
             "`f_ID[j]` (`c_ID[*]`: all of them), such as computes of the names .../chunk and fix ave/chunk "
             "give. One makes the values per atom `c_ID`, several make `c_ID[1]` and so on. Atoms outside of the "
             "group, or in no chunk, have 0.",
         .example = "compute near all cluster/atom 1.3\ncompute drops all chunk/atom c_near compress yes\n"
                    "compute size all property/chunk drops count\ncompute s all chunk/spread/atom drops c_size\n"
                    "dump 1 all custom 100 drops.dump id x y z c_s"},
    SPREAD_HOOKS,
};
