/* No pair forces, and no neighbor search. */
#include "style/pair.h"

static hs_status settings(hs_pair *pair, const hs_args *args, hs_error *err)
{
    (void)pair, (void)args, (void)err;
    return HS_OK;
}

static hs_status coeff(hs_pair *pair, int i, int j, const hs_args *args, hs_error *err)
{
    (void)pair, (void)i, (void)j, (void)args;
    return hs_fail(err, HS_ERROR_INPUT, "pair_coeff: pair_style none has no coefficients");
}

static void params(const hs_pair *pair, int i, int j, double *cutoff, double *p)
{
    (void)pair, (void)i, (void)j, (void)p;
    *cutoff = 0.0;
}

const hs_pair_style hs_pair_style_none = {
    .about =
        {.name = "none",
         .syntax = {.usage = "", .n_min = 0, .n_max = 0},
         .summary = "no pair interaction",
         .details =
             "Atoms do not interact; no neighbors are searched. An ideal gas, or a system in which only fixes act.",
         .example = "pair_style none"},
    .coeff_syntax = {.usage = "", .n_min = 0, .n_max = 0},
    .settings = settings,
    .coeff = coeff,
    .params = params,
    .allows_none = true,
};
