/* Mie potential:  U(r) = C eps ((sigma/r)^n - (sigma/r)^m) - shift,  C = n/(n - m) (n/m)^(m/(n - m))   for r < r_c
 *                 F(r)/r = C eps (n (sigma/r)^n - m (sigma/r)^m) / r^2
 * Powers are taken by way of the logarithm:  A r^-n = A exp(-n/2 log r^2).
 * Source: G. Mie, Ann. Phys. 316, 657 (1903), doi:10.1002/andp.19033160802.
 * Units: eps energy, sigma and r_c distance. */
#include "kernel/evaluator.h"
#include "kernel/vector_log.h"
#include "pair/powers.h"

HS_EVALUATE(const hs_vec *p, hs_vec r2, hs_vec *force_over_r, hs_vec *energy, bool with_energy)
{
    const hs_vec square = hs_max(r2, hs_set1(HS_TINY_R2)), log_r2 = hs_log(square);
    const hs_vec r_n = hs_exp(p[MINUS_HALF_N] * log_r2), r_m = hs_exp(p[MINUS_HALF_M] * log_r2);
    *force_over_r = (p[N_A] * r_n - p[M_B] * r_m) / square;
    if (with_energy) *energy = p[A] * r_n - p[B] * r_m - p[SHIFT];
}

#define HS_EVALUATOR mie_cut
#include "kernel/instantiate.h"

#ifndef HS_KERNEL_ISA

/** Coefficients behind epsilon and sigma. */
enum { REPULSION = HS_LJ_N_COEFFS, ATTRACTION };

static hs_status coeff(hs_pair *pair, int i, int j, const hs_args *args, hs_error *err)
{
    hs_pair_coeff c = {.cutoff = 0.0};
    HS_TRY(hs_arg_double(args, 0, &c.c[HS_LJ_EPSILON], err));
    HS_TRY(hs_arg_not_negative(args, 1, &c.c[HS_LJ_SIGMA], err));
    HS_TRY(hs_powers_read(args, 2, &c.c[REPULSION], &c.c[ATTRACTION], err));
    HS_TRY(hs_pair_coeffs_read_cutoff(pair, args, 4, &c.cutoff, err));
    *hs_pair_coeffs_at(pair, i, j) = c;
    return HS_OK;
}

static hs_status mix(hs_pair *pair, int i, int j, hs_error *err)
{
    const hs_pair_coeff a = *hs_pair_coeffs_at(pair, i, i), b = *hs_pair_coeffs_at(pair, j, j);
    HS_TRY(hs_lj_mix(pair, i, j, err));
    for (int k = REPULSION; k <= ATTRACTION; ++k)
        hs_pair_coeffs_at(pair, i, j)->c[k] = hs_pair_mix_distance(pair->mix, a.c[k], b.c[k]);
    return HS_OK;
}

static hs_powers powers_of(const hs_pair_coeff *c)
{
    const double n = c->c[REPULSION], m = c->c[ATTRACTION], sigma = c->c[HS_LJ_SIGMA];
    const double scale = n > m ? n / (n - m) * pow(n / m, m / (n - m)) * c->c[HS_LJ_EPSILON] : 0.0;
    return (hs_powers){.a = scale * pow(sigma, n), .n = n, .b = scale * pow(sigma, m), .m = m};
}

static hs_status init(hs_pair *pair, hs_error *err) { return hs_powers_check_tail(pair, REPULSION, err); }

const hs_pair_style hs_pair_style_mie_cut = {
    .about =
        {.name = "mie/cut",
         .syntax = {.usage = "<cutoff>", .n_min = 1, .n_max = 1},
         .summary = "Mie potential: Lennard-Jones with exponents of your own",
         .details =
             "U(r) = C epsilon [(sigma/r)^n - (sigma/r)^m] for r < cutoff, 0 beyond, with C = n/(n - m) "
             "(n/m)^(m/(n - m)), so that the depth is epsilon; 12 and 6 make it lj/cut, which is faster.\n\n"
             "`pair_coeff I J <epsilon> <sigma> <n> <m> [<cutoff>]`: energy, distance, and the exponents of "
             "repulsion and attraction, n > m > 0, whole numbers or not. Pairs of different types that are not given "
             "are mixed from their like pairs, exponents by the rule of distances (`pair_modify mix`). `pair_modify "
             "shift yes` makes the energy zero at the cutoff; `pair_modify tail yes` adds the long-range part to "
             "energy and pressure, for exponents above 3.",
         .reference = "G. Mie, Ann. Phys. 316, 657 (1903), doi:10.1002/andp.19033160802",
         .example = "pair_style mie/cut 2.5\npair_coeff * * 1.0 1.0 50 49\npair_coeff 1 2 0.8 1.1 14.3 6.7 2.8"},
    .coeff_syntax = {.usage = "<epsilon> <sigma> <n> <m> [<cutoff>]", .n_min = 4, .n_max = 5},
    .adaptable = (const hs_pair_adaptable[]){{"epsilon", HS_LJ_EPSILON},
                                             {"sigma", HS_LJ_SIGMA},
                                             {"gamma_repulsive", REPULSION},
                                             {"gamma_attractive", ATTRACTION},
                                             {NULL, 0}},
    HS_PAIR_COEFFS_HOOKS,
    .coeff = coeff,
    .mix = mix,
    .init = init,
    .params = hs_powers_params,
    .tail = hs_powers_tail,
    .evaluator = &hs_evaluator_mie_cut,
};

#endif
