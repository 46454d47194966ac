/* Lennard-Jones 12-6 up to its inflection point r_s = (26/7)^(1/6) sigma, and from there a cubic that continues energy,
 * force and the slope of the force (which is zero there) and ends at r_c = (67/48) r_s with energy and force zero:
 *     r_s < r < r_c:  U(r) = U_LJ(r_s) + U'_LJ(r_s) t - (A/6) t^3,  t = r - r_s,  A = 2 U'_LJ(r_s) / (r_c - r_s)^2
 * It is the potential of lj/smooth with another polynomial, and has no evaluator of its own.
 * Source: B. L. Holian, R. Ravelo, Phys. Rev. B 51, 11275 (1995), doi:10.1103/PhysRevB.51.11275. */
#include "pair/lj_coeffs.h"
#include "pair/lj_cubic_end.h"

extern const hs_evaluator hs_evaluator_lj_smooth;

/** Distance of the inflection point. */
static double inner_of(double sigma) { return pow(26.0 / 7.0, 1.0 / 6.0) * sigma; }

static void params(const hs_pair *pair, int i, int j, double *cutoff, double *p)
{
    const hs_pair_coeff *c = hs_pair_coeffs_at(pair, i, j);
    const double epsilon = c->c[HS_LJ_EPSILON], inner = inner_of(c->c[HS_LJ_SIGMA]), width = 19.0 / 48.0 * inner;
    *cutoff = inner + width;
    if (!(inner > 0.0)) return;
    hs_lj_cubic_end_params(epsilon, c->c[HS_LJ_SIGMA], inner, p);
    p[C0] = 24.0 * epsilon * (7.0 / 26.0) * (2.0 * 7.0 / 26.0 - 1.0) / inner;
    p[C2] = -p[C0] / (width * width);
}

const hs_pair_style hs_pair_style_lj_cubic = {
    .about = {.name = "lj/cubic",
              .syntax = {.usage = "", .n_min = 0, .n_max = 0},
              .summary = "Lennard-Jones potential with a cubic end, for solids under shock",
              .details = "U(r) = 4 epsilon [(sigma/r)^12 - (sigma/r)^6] up to the inflection point r_s = (26/7)^(1/6) "
                         "sigma; beyond it a cubic in r, which continues energy, force and slope of the force, and "
                         "ends with energy and force zero at (67/48) r_s = 1.737 sigma.\n\n"
                         "`pair_coeff I J <epsilon> <sigma>`: energy and distance; the minimum is at 2^(1/6) sigma. "
                         "There is nothing to shift, and no long-range part. Unlike pairs are mixed as in lj/cut.",
              .reference = "B. L. Holian, R. Ravelo, Phys. Rev. B 51, 11275 (1995), doi:10.1103/PhysRevB.51.11275",
              .example = "pair_style lj/cubic\npair_coeff * * 1.0 0.8908987"},
    .coeff_syntax = {.usage = "<epsilon> <sigma>", .n_min = 2, .n_max = 2},
    .adaptable = HS_LJ_ADAPTABLE,
    .state_size = sizeof(hs_pair_coeffs),
    .settings = hs_pair_coeffs_no_settings,
    .destroy = hs_pair_coeffs_destroy,
    .coeff = hs_lj_coeff,
    .mix = hs_lj_mix,
    .params = params,
    .write_coeff = hs_pair_coeffs_write_bare,
    .evaluator = &hs_evaluator_lj_smooth,
};
