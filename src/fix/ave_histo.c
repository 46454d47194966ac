/* Histograms over time. */
#include "io/histogram.h"

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    return hs_histogram_create(fix, args, false, err);
}

const hs_fix_style hs_fix_style_ave_histo = {
    .about =
        {.name = "ave/histo",
         .syntax = {.usage = "<Nevery> <Nrepeat> <Nfreq> <lo> <hi> <bins> <value> ... [keyword value ...]",
                    .n_min = 7,
                    .n_max = -1,
                    .keywords = hs_histogram_keywords},
         .summary = "histograms of numbers, vectors, values per atom or local values",
         .details =
             "Samples are taken every Nevery steps; Nrepeat of them, up to each multiple of Nfreq steps, are counted "
             "together (as in fix ave/time). The range from lo to hi is cut into bins of equal width.\n\n"
             "In `mode scalar` a value is one number, `c_ID`, `c_ID[i]`, `f_ID`, `f_ID[i]` or `v_name`. In `mode "
             "vector` it is many: a vector `c_ID`, `f_ID`, a column of an array `c_ID[j]`, `f_ID[j]`, a value per "
             "atom (`c_ID`, `f_ID`, their columns, an atom-style `v_name`), one of `x y z vx vy vz fx fy fz`, or "
             "local values, such as those of compute pair/local. All inputs must be of one kind; where a compute or "
             "fix has several, `kind` says which. Per atom only atoms of the group count; of local values all rows "
             "do.\n\n"
             "`beyond ignore`, the default, leaves out what is below lo or above hi; `end` counts it in the first and "
             "last bin; `extra` counts it in two more bins, one at either end.\n\n"
             "Counts are summed over the samples of a window and, with `ave running` or `window`, over windows. The "
             "array `f_ID[i][j]` has for each bin its middle, its count, and its share of all counts; the vector is "
             "`f_ID[1]` all counts, `f_ID[2]` values beyond that were left out, `f_ID[3]` the least and `f_ID[4]` the "
             "greatest value. Before the first window is complete counts are 0.\n\n"
             "With `error yes` two more columns follow: the standard error of the share, by blocking over the samples "
             "(`ave window`: over the windows), and the statistical inefficiency, the number of samples that count as "
             "one; as in fix ave/time.",
         .example = "fix h all ave/histo 10 100 1000 -4 4 80 vx vy vz mode vector ave running file speeds.txt\n"
                    "compute n all coord/atom cutoff 1.5\n"
                    "fix c all ave/histo 100 1 100 -0.5 15.5 16 c_n mode vector\n"
                    "compute p all pair/local dist\nfix d all ave/histo 100 10 1000 0.8 2.5 170 c_p mode vector"},
    HS_HISTOGRAM_HOOKS,
};
