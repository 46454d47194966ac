/* One number from the values of the atoms of a group, or from local values. */
#include "style/reduction.h"

const hs_compute_style hs_compute_style_reduce = {
    .about =
        {.name = "reduce",
         .syntax = {.usage = "<sum | min | max | ave | sumsq | avesq> <input> ... [replace <i> <j>]",
                    .n_min = 2,
                    .n_max = -1,
                    .keywords = hs_reduction_keywords},
         .summary = "sum, mean or extreme of values over the atoms of a group, or of local values",
         .details =
             "An input is an attribute (`x y z vx vy vz fx fy fz`), a value per atom of a compute or fix (`c_ID`, "
             "`c_ID[i]`, `f_ID`, `f_ID[i]`, ranges as in `c_ID[*]`), an atom-style variable (`v_name`), or local "
             "values of a compute (`c_ID`, `c_ID[i]`), all rows of which count, whatever the group. `sum` and `sumsq` "
             "(of squares) grow with the number of atoms: under `thermo_modify norm yes` thermo output divides them "
             "by it; `ave` and `avesq` divide by the atoms of the group, or the rows. With one input the result is "
             "the scalar `c_ID`, with several the vector `c_ID[1]`, ... . Without atoms in the group, or without "
             "rows, the result is 0, but of `min` 1e20 and of `max` -1e20, as in LAMMPS.",
         .example = "compute fmax all reduce max fx fy fz\ncompute q all reduce max c_k x replace 2 1\n"
                    "compute p all pair/local dist\ncompute nearest all reduce min c_p"},
    .state_size = sizeof(hs_reduction),
    .create = hs_reduction_create,
    .destroy = hs_reduction_destroy,
    .init = hs_reduction_init,
    .scalar = hs_reduction_scalar,
    .vector = hs_reduction_vector,
};
