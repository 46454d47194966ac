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
    const hs_vec inv_r6 = inv_r2 * inv_r2 * inv_r2;
    *force_over_r = inv_r6 * hs_fma(p[F12], inv_r6, p[MINUS_F6]) * inv_r2;
    if (with_energy) *energy = inv_r6 * hs_fma(p[U12], inv_r6, p[MINUS_U6]) - p[SHIFT];
}

#define HS_EVALUATOR lj_cut
#include "kernel/instantiate.h"

#ifndef HS_KERNEL_ISA

#include "pair/lj_state.h"

static hs_status settings(hs_pair *pair, const hs_args *args, hs_error *err)
{
    lj_state *lj = pair->state;
    HS_TRY(hs_arg_positive(args, 0, &lj->cutoff_global, err));
    if (lj->coeff != NULL) {
        /* pair_style given again with the same style: explicit cutoffs of earlier pair_coeffs follow the new one */
        for (int k = 0; k < lj->n_coeffs; ++k)
            if (pair->is_set[k]) lj->coeff[k].cutoff = lj->cutoff_global;
        return HS_OK;
    }
    return hs_lj_allocate(pair, err);
}

static hs_status coeff(hs_pair *pair, int i, int j, const hs_args *args, hs_error *err)
{
    lj_state *lj = pair->state;
    lj_coeff c = {.cutoff = lj->cutoff_global};
    HS_TRY(hs_arg_double(args, 0, &c.epsilon, err));
    HS_TRY(hs_arg_not_negative(args, 1, &c.sigma, err));
    if (args->n > 2) HS_TRY(hs_arg_not_negative(args, 2, &c.cutoff, err));
    lj->coeff[hs_pair_index(pair, i, j)] = c;
    return HS_OK;
}

static hs_status mix(hs_pair *pair, int i, int j, hs_error *err)
{
    (void)err;
    hs_lj_mix(pair, i, j);
    return HS_OK;
}

static void params(const hs_pair *pair, int i, int j, double *cutoff, double *p)
{
    const lj_coeff c = ((lj_state *)pair->state)->coeff[hs_pair_index(pair, i, j)];
    *cutoff = c.cutoff;
    hs_lj_params(c, pair->shift, p);
}

static void tail(const hs_pair *pair, int i, int j, double *energy, double *virial)
{
    const lj_coeff c = ((lj_state *)pair->state)->coeff[hs_pair_index(pair, i, j)];
    const double sigma3 = c.sigma * c.sigma * c.sigma, rc3 = c.cutoff * c.cutoff * c.cutoff;
    const double s9 = sigma3 * sigma3 * sigma3 / (rc3 * rc3 * rc3), s3 = sigma3 / rc3;
    /* integrals of U and of r dU/dr from r_c to infinity with g(r) = 1, per n_i n_j / V */
    *energy = 8.0 * M_PI * c.epsilon * sigma3 * (s9 / 9.0 - s3 / 3.0);
    *virial = 16.0 * M_PI * c.epsilon * sigma3 * (2.0 * s9 / 9.0 - s3 / 3.0);
}

static hs_status write_coeff(const hs_pair *pair, int i, int j, hs_text *words, hs_error *err)
{
    const lj_coeff c = ((lj_state *)pair->state)->coeff[hs_pair_index(pair, i, j)];
    return hs_text_printf(words, err, "%.15g %.15g %.15g", c.epsilon, c.sigma, c.cutoff);
}

const hs_pair_style hs_pair_style_lj_cut = {
    .about = {.name = "lj/cut",
              .syntax = {.usage = "<cutoff>", .n_min = 1, .n_max = 1},
              .summary = "Lennard-Jones 12-6 potential, truncated at a cutoff",
              .details =
                  "U(r) = 4 epsilon [(sigma/r)^12 - (sigma/r)^6] for r < cutoff, 0 beyond.\n\n"
                  "`pair_style lj/cut <cutoff>` sets the cutoff (distance) of all pairs of types. "
                  "`pair_coeff I J <epsilon> <sigma> [<cutoff>]` sets the energy and length of a pair of types, and a "
                  "cutoff of its own. Pairs of different types that are not given are mixed from their like pairs "
                  "(`pair_modify mix`). `pair_modify shift yes` makes the energy zero at the cutoff; "
                  "`pair_modify tail yes` adds the long-range part to energy and pressure.",
              .reference = "J. E. Lennard-Jones, Proc. Phys. Soc. 43, 461 (1931), doi:10.1088/0959-5309/43/5/301",
              .example = "pair_style lj/cut 2.5\npair_coeff * * 1.0 1.0\npair_coeff 1 2 0.8 1.1 2.8"},
    .coeff_syntax = {.usage = "<epsilon> <sigma> [<cutoff>]", .n_min = 2, .n_max = 3},
    .state_size = sizeof(lj_state),
    .settings = settings,
    .destroy = hs_lj_destroy,
    .coeff = coeff,
    .mix = mix,
    .params = params,
    .tail = tail,
    .write_coeff = write_coeff,
    .evaluator = &hs_evaluator_lj_cut,
};

#endif
