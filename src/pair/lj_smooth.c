/* Lennard-Jones 12-6 up to r_in, and from there a force that is a cubic polynomial in t = r - r_in and ends at the
 * cutoff with value and slope zero:
 *     r < r_in:  U(r) = 4 eps ((sigma/r)^12 - (sigma/r)^6) - shift
 *     r < r_c:   F(r) = C0 + C1 t + C2 t^2 + C3 t^3,   U(r) = U_LJ(r_in) - C0 t - C1 t^2/2 - C2 t^3/3 - C3 t^4/4 -
 * shift C0 and C1 are value and slope of the Lennard-Jones force at r_in; C2 and C3 follow from the two conditions at
 * r_c.
 * Units: eps energy; sigma, r_in and r_c distance. */
#include "kernel/evaluator.h"
#include "pair/lj_cubic_end.h"

HS_EVALUATE(const hs_vec *p, hs_vec r2, hs_vec *force_over_r, hs_vec *energy, bool with_energy)
{
    const hs_vec inv_r2 = hs_set1(1.0) / r2;
    const hs_vec inv_r6 = inv_r2 * inv_r2 * inv_r2;
    const hs_vec r = hs_sqrt(r2), t = r - p[INNER];
    const hs_msk is_inside = hs_less(r2, p[INNER_R2]);
    const hs_vec smooth = hs_fma(hs_fma(hs_fma(p[C3], t, p[C2]), t, p[C1]), t, p[C0]) / r;
    *force_over_r = hs_select(is_inside, inv_r6 * hs_fma(p[F12], inv_r6, p[MINUS_F6]) * inv_r2, smooth);
    if (with_energy) {
        const hs_vec fall = t * hs_fma(hs_fma(hs_fma(p[C3] * hs_set1(1.0 / 4.0), t, p[C2] * hs_set1(1.0 / 3.0)), t,
                                              p[C1] * hs_set1(1.0 / 2.0)),
                                       t, p[C0]);
        *energy = hs_select(is_inside, inv_r6 * hs_fma(p[U12], inv_r6, p[MINUS_U6]), p[U_INNER] - fall) - p[SHIFT];
    }
}

#define HS_EVALUATOR lj_smooth
#include "kernel/instantiate.h"

#ifndef HS_KERNEL_ISA

#include <math.h>

#include "style/pair_coeffs.h"

enum { EPSILON, SIGMA, INNER_CUTOFF };

typedef struct smooth_state {
    hs_pair_coeffs coeffs;
    double inner; /**< of pairs that are given none of their own, distance */
} smooth_state;

static hs_status settings(hs_pair *pair, const hs_args *args, hs_error *err)
{
    smooth_state *state = pair->state;
    double cutoff;
    HS_TRY(hs_arg_positive(args, 0, &state->inner, err));
    HS_TRY(hs_arg_positive(args, 1, &cutoff, err));
    if (state->inner > cutoff) return hs_arg_refuse(args, 0, "at most the cutoff", NULL, err);
    HS_TRY(hs_pair_coeffs_set_cutoff(pair, cutoff, err));
    for (int k = 0; k < (pair->n_types + 1) * (pair->n_types + 1); ++k)
        if (pair->is_set[k]) state->coeffs.at[k].c[INNER_CUTOFF] = state->inner;
    return HS_OK;
}

static hs_status coeff(hs_pair *pair, int i, int j, const hs_args *args, hs_error *err)
{
    const smooth_state *state = pair->state;
    hs_pair_coeff c = {.c = {[INNER_CUTOFF] = state->inner}, .cutoff = state->coeffs.cutoff};
    HS_TRY(hs_arg_double(args, 0, &c.c[EPSILON], err));
    HS_TRY(hs_arg_not_negative(args, 1, &c.c[SIGMA], err));
    if (args->n == 3) return hs_arg_need(args, 3, "the cutoff after the inner one", err);
    if (args->n > 2) HS_TRY(hs_arg_positive(args, 2, &c.c[INNER_CUTOFF], err));
    if (args->n > 3) HS_TRY(hs_arg_positive(args, 3, &c.cutoff, err));
    if (c.c[INNER_CUTOFF] > c.cutoff) return hs_arg_refuse(args, 2, "at most the cutoff", NULL, err);
    *hs_pair_coeffs_at(pair, i, j) = c;
    return HS_OK;
}

static hs_status mix(hs_pair *pair, int i, int j, hs_error *err)
{
    const hs_pair_coeff a = *hs_pair_coeffs_at(pair, i, i), b = *hs_pair_coeffs_at(pair, j, j);
    (void)err;
    *hs_pair_coeffs_at(pair, i, j) =
        (hs_pair_coeff){.c = {hs_pair_mix_energy(pair->mix, a.c[EPSILON], b.c[EPSILON], a.c[SIGMA], b.c[SIGMA]),
                              hs_pair_mix_distance(pair->mix, a.c[SIGMA], b.c[SIGMA]),
                              hs_pair_mix_distance(pair->mix, a.c[INNER_CUTOFF], b.c[INNER_CUTOFF])},
                        .cutoff = hs_pair_mix_distance(pair->mix, a.cutoff, b.cutoff)};
    return HS_OK;
}

static void params(const hs_pair *pair, int i, int j, double *cutoff, double *p)
{
    const hs_pair_coeff *c = hs_pair_coeffs_at(pair, i, j);
    const double epsilon = c->c[EPSILON], inner = c->c[INNER_CUTOFF], width = c->cutoff - inner;
    const double ratio6 = pow(c->c[SIGMA] / inner, 6.0);
    *cutoff = c->cutoff;
    hs_lj_cubic_end_params(epsilon, c->c[SIGMA], inner, p);
    if (width > 0.0) {
        p[C0] = 24.0 * epsilon * ratio6 * (2.0 * ratio6 - 1.0) / inner;
        p[C1] = -24.0 * epsilon * ratio6 * (26.0 * ratio6 - 7.0) / (inner * inner);
        p[C2] = -(3.0 * p[C0] + 2.0 * p[C1] * width) / (width * width);
        p[C3] = (2.0 * p[C0] + p[C1] * width) / (width * width * width);
    }
    const double fall = width * (p[C0] + width * (p[C1] / 2.0 + width * (p[C2] / 3.0 + width * p[C3] / 4.0)));
    p[SHIFT] = pair->shift ? p[U_INNER] - fall : 0.0;
}

const hs_pair_style hs_pair_style_lj_smooth = {
    .about = {.name = "lj/smooth",
              .syntax = {.usage = "<inner> <cutoff>", .n_min = 2, .n_max = 2},
              .summary = "Lennard-Jones potential whose force is led smoothly to zero between two distances",
              .details =
                  "U(r) = 4 epsilon [(sigma/r)^12 - (sigma/r)^6] for r < inner; between inner and cutoff the force is "
                  "a cubic polynomial in r, which continues the Lennard-Jones force and its slope and ends at the "
                  "cutoff with force and slope zero.\n\n"
                  "`pair_style lj/smooth <inner> <cutoff>`: distances of all pairs that are given none of their own. "
                  "`pair_coeff I J <epsilon> <sigma> [<inner> <cutoff>]`. `pair_modify shift yes` makes the energy "
                  "zero at the cutoff; without it the energy is the Lennard-Jones energy below inner, and steps to "
                  "zero at the cutoff. Unlike pairs are mixed as in lj/cut, both distances like sigma.",
              .reference = NULL,
              .example = "pair_style lj/smooth 2.0 2.5\npair_coeff * * 1.0 1.0\npair_coeff 1 2 1.0 1.0 1.8 2.2"},
    .coeff_syntax = {.usage = "<epsilon> <sigma> [<inner> <cutoff>]", .n_min = 2, .n_max = 4},
    .adaptable = (const hs_pair_adaptable[]){{"epsilon", EPSILON}, {"sigma", SIGMA}, {NULL, 0}},
    .state_size = sizeof(smooth_state),
    .settings = settings,
    .destroy = hs_pair_coeffs_destroy,
    .coeff = coeff,
    .mix = mix,
    .params = params,

    .write_coeff = hs_pair_coeffs_write,
    .evaluator = &hs_evaluator_lj_smooth,
};

#endif
