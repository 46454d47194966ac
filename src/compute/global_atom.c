/* Elements of global vectors as values per atom: each atom says which. */
#include "compute/spread.h"

static hs_status create(hs_compute *compute, const hs_args *args, hs_error *err)
{
    if (!hs_value_is_reference(args->word[0]))
        return hs_arg_refuse(args, 0, "a value for each atom: c_ID, c_ID[i], f_ID, f_ID[i] or v_name", NULL, err);
    return spread_create(compute, args, args->word[0], err);
}

const hs_compute_style hs_compute_style_global_atom = {
    .about = {.name = "global/atom",
              .syntax = {.usage = "<index> <vector> ...", .n_min = 2, .n_max = -1},
              .summary = "elements of vectors as values per atom",
              .details =
                  "The index is a value for each atom, `c_ID`, `c_ID[i]`, `f_ID`, `f_ID[i]` or `v_name`; cut off to a "
                  "whole number from 1 on it says which element of each vector is the atom's. A vector is `c_ID` or "
                  "`f_ID`, a column of an array, `c_ID[j]` or `f_ID[j]` (`c_ID[*]`: all of them), or a vector-style "
                  "variable `v_name`. One vector makes the values per atom `c_ID`, several make `c_ID[1]` and so on. "
                  "Atoms outside of the group, and those whose index points to no element, have 0.",
              .example = "compute kind all property/atom type\ncompute d all global/atom c_kind v_diameters"},
    SPREAD_HOOKS,
};
