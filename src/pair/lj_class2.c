/* Lennard-Jones 9-6 of class 2 force fields:  U(r) = eps (2 (sigma/r)^9 - 3 (sigma/r)^6) - shift   for r < r_c. It has no
 * evaluator of its own: see mie_cut.c.
 * Units: eps energy, sigma and r_c distance. */
#include "pair/powers.h"

extern const hs_evaluator hs_evaluator_mie_cut;

static hs_powers powers_of(const hs_pair_coeff *c)
{
    const double epsilon = c->c[HS_LJ_EPSILON], sigma = c->c[HS_LJ_SIGMA];
    return (hs_powers){.a = 2.0 * epsilon * pow(sigma, 9.0), .n = 9.0, .b = 3.0 * epsilon * pow(sigma, 6.0), .m = 6.0};
}

/** Energies and distances always by the sixth power, as is the way of class 2 force fields; the cutoff by the chosen rule. */
static hs_status mix(hs_pair *pair, int i, int j, hs_error *err)
{
    const hs_mix_rule rule = pair->mix;
    HS_TRY(hs_lj_mix(pair, i, j, err));
    const double cutoff = hs_pair_coeffs_at(pair, i, j)->cutoff;
    pair->mix = HS_MIX_SIXTHPOWER;
    const hs_status status = hs_lj_mix(pair, i, j, err);
    pair->mix = rule;
    hs_pair_coeffs_at(pair, i, j)->cutoff = cutoff;
    return status;
}

const hs_pair_style hs_pair_style_lj_class2 = {
    .about = {.name = "lj/class2",
              .syntax = {.usage = "<cutoff>", .n_min = 1, .n_max = 1},
              .summary = "Lennard-Jones 9-6 potential of class 2 force fields, without charges",
              .details =
                  "U(r) = epsilon [2 (sigma/r)^9 - 3 (sigma/r)^6] for r < cutoff, 0 beyond: the minimum is -epsilon, "
                  "at sigma.\n\n"
                  "`pair_coeff I J <epsilon> <sigma> [<cutoff>]`: energy, and the distance of the minimum. Pairs of "
                  "different types that are not given are mixed from their like pairs: epsilon and sigma always by the "
                  "sixth power, the cutoff as `pair_modify mix` says. `pair_modify shift yes` makes the energy zero at "
                  "the cutoff; `pair_modify tail yes` adds the long-range part to energy and pressure.",
              .reference = "H. Sun, J. Phys. Chem. B 102, 7338 (1998), doi:10.1021/jp980939v",
              .example = "pair_style lj/class2 2.5\npair_coeff * * 1.0 1.0\npair_modify tail yes"},
    .coeff_syntax = {.usage = "<epsilon> <sigma> [<cutoff>]", .n_min = 2, .n_max = 3},
    .adaptable = HS_LJ_ADAPTABLE,
    HS_PAIR_COEFFS_HOOKS,
    .coeff = hs_lj_coeff,
    .mix = mix,
    .params = hs_powers_params,
    .tail = hs_powers_tail,
    .evaluator = &hs_evaluator_mie_cut,
};
