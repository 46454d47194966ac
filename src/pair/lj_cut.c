/* Lennard-Jones 12-6, truncated:  U(r) = 4 eps ((sigma/r)^12 - (sigma/r)^6) - shift   for r < r_c
 *                                 F(r)/r = 24 eps (2 (sigma/r)^12 - (sigma/r)^6) / r^2
 * Source: J. E. Lennard-Jones, Proc. Phys. Soc. 43, 461 (1931), doi:10.1088/0959-5309/43/5/301; truncation and tail
 * corrections: M. P. Allen, D. J. Tildesley, Computer Simulation of Liquids, 2nd ed. (2017), section 2.8.
 * Units: eps energy, sigma and r_c distance. */
#include "kernel/evaluator.h"

enum { F12, MINUS_F6, U12, MINUS_U6, SHIFT, N_PARAMS };

HS_EVALUATE(const hs_vec *p, hs_vec r2, hs_vec *force_over_r, hs_vec *energy, bool with_energy)
{
    const hs_vec inv_r2 = hs_set1(1.0) / r2;
    const hs_vec inv_r4 = inv_r2 * inv_r2, inv_r6 = inv_r4 * inv_r2;
    *force_over_r = hs_fma(p[F12], inv_r6, p[MINUS_F6]) * (inv_r4 * inv_r4);
    if (with_energy) *energy = inv_r6 * hs_fma(p[U12], inv_r6, p[MINUS_U6]) - p[SHIFT];
}

#define HS_EVALUATOR lj_cut
#include "kernel/instantiate.h"

#ifndef HS_KERNEL_ISA

#include "pair/lj_coeffs.h"

static void params(const hs_pair *pair, int i, int j, double *cutoff, double *p)
{
    const hs_pair_coeff *c = hs_pair_coeffs_at(pair, i, j);
    *cutoff = c->cutoff;
    hs_lj_params(c, pair->shift, p);
}

static void tail(const hs_pair *pair, int i, int j, double *energy, double *virial)
{
    const hs_pair_coeff c = *hs_pair_coeffs_at(pair, i, j);
    const double epsilon = c.c[HS_LJ_EPSILON], sigma = c.c[HS_LJ_SIGMA];
    const double sigma3 = sigma * sigma * sigma, rc3 = c.cutoff * c.cutoff * c.cutoff;
    const double s9 = sigma3 * sigma3 * sigma3 / (rc3 * rc3 * rc3), s3 = sigma3 / rc3;
    /* integrals of U and of r dU/dr from r_c to infinity with g(r) = 1, per n_i n_j / V */
    *energy = 8.0 * M_PI * epsilon * sigma3 * (s9 / 9.0 - s3 / 3.0);
    *virial = 16.0 * M_PI * epsilon * sigma3 * (2.0 * s9 / 9.0 - s3 / 3.0);
}

const hs_pair_style hs_pair_style_lj_cut = {
    .about = {.name = "lj/cut",
              .syntax = {.usage = "<cutoff>", .n_min = 1, .n_max = 1},
              .summary = "Lennard-Jones 12-6 potential, truncated at a cutoff",
              .details = "U(r) = 4 epsilon [(sigma/r)^12 - (sigma/r)^6] for r < cutoff, 0 beyond.\n\n"
                         "`pair_style lj/cut <cutoff>` sets the cutoff (distance) of all pairs of types. `pair_coeff I "
                         "J <epsilon> <sigma> [<cutoff>]` sets the energy and length of a pair of types, and a cutoff "
                         "of its own. Pairs of different types that are not given are mixed from their like pairs "
                         "(`pair_modify mix`). `pair_modify shift yes` makes the energy zero at the cutoff; "
                         "`pair_modify tail yes` adds the long-range part to energy and pressure.",
              .reference = "J. E. Lennard-Jones, Proc. Phys. Soc. 43, 461 (1931), doi:10.1088/0959-5309/43/5/301",
              .example = "pair_style lj/cut 2.5\npair_coeff * * 1.0 1.0\npair_coeff 1 2 0.8 1.1 2.8"},
    .coeff_syntax = {.usage = "<epsilon> <sigma> [<cutoff>]", .n_min = 2, .n_max = 3},
    .adaptable = HS_LJ_ADAPTABLE,
    HS_PAIR_COEFFS_HOOKS,
    .coeff = hs_lj_coeff,
    .mix = hs_lj_mix,
    .params = params,
    .tail = tail,
    .evaluator = &hs_evaluator_lj_cut,
};

#endif
