/* Another name of lj/smooth/linear, which decks use. */
#include "pair/force_shifted.h"

extern const hs_evaluator hs_evaluator_lj_smooth_linear;

const hs_pair_style hs_pair_style_lj_sf = {
    .about = {.name = "lj/sf",
              .syntax = {.usage = "<cutoff>", .n_min = 1, .n_max = 1},
              .summary = "Lennard-Jones with shifted force: another name of lj/smooth/linear",
              .details = "U(r) = phi(r) - phi(cutoff) - (r - cutoff) phi'(cutoff) for r < cutoff, 0 beyond, where phi "
                         "is the Lennard-Jones potential "
                         "4 epsilon [(sigma/r)^12 - (sigma/r)^6].\n\n"
                         "`pair_coeff I J <epsilon> <sigma> [<cutoff>]` as in lj/cut. There is nothing to shift, and "
                         "no long-range part. Unlike "
                         "pairs are mixed as in lj/cut.",
              .reference = "S. Toxvaerd, J. C. Dyre, J. Chem. Phys. 134, 081102 (2011), doi:10.1063/1.3558787",
              .example = "pair_style lj/sf 2.5\npair_coeff * * 1.0 1.0"},
    .coeff_syntax = {.usage = "<epsilon> <sigma> [<cutoff>]", .n_min = 2, .n_max = 3},
    .state_size = sizeof(hs_pair_coeffs),
    .settings = hs_pair_coeffs_settings,
    .destroy = hs_pair_coeffs_destroy,
    .coeff = hs_force_shifted_coeff,
    .mix = hs_force_shifted_mix,
    .params = hs_force_shifted_params,

    .write_coeff = hs_force_shifted_write_coeff,
    .evaluator = &hs_evaluator_lj_smooth_linear,
};
