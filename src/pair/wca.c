/* Weeks-Chandler-Andersen: the repulsive part of Lennard-Jones, cut and shifted at its minimum 2^(1/6) sigma.
 * Source: J. D. Weeks, D. Chandler, H. C. Andersen, J. Chem. Phys. 54, 5237 (1971), doi:10.1063/1.1674820. */
#include "pair/lj_coeffs.h"

extern const hs_evaluator hs_evaluator_lj_cut;

static const double minimum = 1.122462048309373; /* 2^(1/6), in units of sigma */

static hs_status coeff(hs_pair *pair, int i, int j, const hs_args *args, hs_error *err)
{
    return hs_pair_coeffs_set(pair, i, j, "0+", args, err);
}

/** The cutoff follows from sigma, which fix adapt may have changed. */
static void params(const hs_pair *pair, int i, int j, double *cutoff, double *p)
{
    hs_pair_coeff c = *hs_pair_coeffs_at(pair, i, j);
    *cutoff = c.cutoff = minimum * c.c[HS_LJ_SIGMA];
    hs_lj_params(&c, true, p);
}

const hs_pair_style hs_pair_style_wca = {
    .about = {.name = "wca",
              .syntax = {.usage = "", .n_min = 0, .n_max = 0},
              .summary = "Weeks-Chandler-Andersen potential: purely repulsive Lennard-Jones",
              .details = "U(r) = 4 epsilon [(sigma/r)^12 - (sigma/r)^6] + epsilon for r < 2^(1/6) sigma, 0 beyond.\n\n"
                         "`pair_coeff I J <epsilon> <sigma>`. In LAMMPS the same is written `pair_style lj/cut "
                         "1.122462` with `pair_modify shift yes`.",
              .reference =
                  "J. D. Weeks, D. Chandler, H. C. Andersen, J. Chem. Phys. 54, 5237 (1971), doi:10.1063/1.1674820",
              .example = "pair_style wca\npair_coeff * * 1.0 1.0"},
    .coeff_syntax = {.usage = "<epsilon> <sigma>", .n_min = 2, .n_max = 2},
    .adaptable = HS_LJ_ADAPTABLE,
    .state_size = sizeof(hs_pair_coeffs),
    .settings = hs_pair_coeffs_no_settings,
    .destroy = hs_pair_coeffs_destroy,
    .coeff = coeff,
    .mix = hs_lj_mix,
    .params = params,
    .write_coeff = hs_pair_coeffs_write_bare,
    .evaluator = &hs_evaluator_lj_cut,
};
