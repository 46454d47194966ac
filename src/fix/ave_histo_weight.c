/* Histograms over time in which each value counts with a weight. */
#include "io/histogram.h"

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    return hs_histogram_create(fix, args, true, err);
}

const hs_fix_style hs_fix_style_ave_histo_weight = {
    .about = {.name = "ave/histo/weight",
              .syntax = {.usage = "<Nevery> <Nrepeat> <Nfreq> <lo> <hi> <bins> <value> <weight> [keyword value ...]",
                         .n_min = 7,
                         .n_max = -1,
                         .keywords = hs_histogram_keywords},
              .summary = "histogram in which each value counts with a weight",
              .details =
                  "As fix ave/histo, with exactly two inputs of one kind and length: the first says in which bin a "
                  "value counts, the second how much. `f_ID[1]`, `f_ID[2]` and the counts of the array are sums of "
                  "weights.",
              .example =
                  "compute k all ke/atom\nfix h all ave/histo/weight 10 10 100 0 10 20 z c_k mode vector file ke.txt"},
    HS_HISTOGRAM_HOOKS,
};
