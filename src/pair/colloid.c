/* Spheres that are made of Lennard-Jones matter: integrals of the Lennard-Jones potential over two balls, over a ball and a point, or
 * of two points. With A the energy of the pair (Hamaker constant), radii a1 >= 0 and a2 >= 0, s = a1 + a2, d = a1 - a2:
 *     two balls:        U(r) = -A/6 [2 a1 a2 (1/q1 + 1/q2) + ln(q1/q2)],  q1 = r^2 - s^2, q2 = r^2 - d^2
 *                              + A sigma^6/(37800 r) [P(s,-)/(r - s)^7 + P(s,+)/(r + s)^7 - P(d,+)/(r + d)^7 - P(d,-)/(r - d)^7]
 *                       P(s,+-) = r^2 +- 7 r s + 6 (a1^2 + 7 a1 a2 + a2^2),  P(d,+-) = r^2 +- 7 r d + 6 (a1^2 - 7 a1 a2 + a2^2)
 *     ball a and point: U(r) = -(2/9) A a^3 sigma^3/m^3 [1 - sigma^6 Q/(15 m^6)],  m = r^2 - a^2
 *                       Q = 5 a^6 + 45 a^4 r^2 + 63 a^2 r^4 + 15 r^6
 *     two points:       U(r) = A/36 [(sigma/r)^12 - (sigma/r)^6]
 * less the shift. Balls that overlap have no energy: it is infinite.
 * Units: A energy; sigma, radii distance.
 * Source: R. Everaers, M. R. Ejtehadi, Phys. Rev. E 67, 041710 (2003), doi:10.1103/PhysRevE.67.041710. */
#include <math.h>

#include "kernel/evaluator.h"
#include "kernel/vector_log.h"

enum {
    N_BALLS, /**< 0, 1 or 2 */
    CONTACT, /**< distance at which surfaces touch: s, a or 0 */
    SHIFT,
    R12, /**< two points: A sigma^12/36 */
    R6,
    A2,         /**< ball and point: a^2 */
    B3,         /**< (2/9) A a^3 sigma^3 */
    B9,         /**< the same times sigma^6/15 */
    DIFFERENCE, /**< two balls: d */
    PLUS,       /**< 6 (a1^2 + 7 a1 a2 + a2^2) */
    MINUS,
    REPULSION,     /**< A sigma^6/37800 */
    SIXTH,         /**< A/6 */
    TWICE_PRODUCT, /**< 2 a1 a2 */
    ATTRACTION,    /**< (32/3) A (a1 a2)^3 */
    N_PARAMS
};

/** One of the four terms of the repulsion of two balls: P/(r + c)^7, and minus its derivative. */
static inline __attribute__((always_inline)) hs_vec repel(hs_vec r, hs_vec r2, hs_vec c, hs_vec rest, hs_vec *fall)
{
    const hs_vec g = hs_set1(1.0) / (r + c), g2 = g * g, g7 = g2 * g2 * g2 * g;
    const hs_vec seven_c = hs_set1(7.0) * c, term = (hs_fma(seven_c, r, r2) + rest) * g7;
    *fall = hs_fma(hs_set1(7.0) * term, g, hs_set1(0.0) - (r + r + seven_c) * g7);
    return term;
}

static inline __attribute__((always_inline)) void two_balls(const hs_vec *p, hs_vec r2, hs_vec *force_over_r,
                                                            hs_vec *energy, bool with_energy)
{
    const hs_vec zero = hs_set1(0.0), r = hs_sqrt(r2), s = p[CONTACT], d = p[DIFFERENCE];
    const hs_vec q1 = (r - s) * (r + s), q2 = (r - d) * (r + d), inv_q = hs_set1(1.0) / (q1 * q2);
    hs_vec f0, f1, f2, f3;
    const hs_vec u0 = repel(r, r2, zero - s, p[PLUS], &f0), u1 = repel(r, r2, s, p[PLUS], &f1);
    const hs_vec u2 = repel(r, r2, d, p[MINUS], &f2), u3 = repel(r, r2, zero - d, p[MINUS], &f3);
    const hs_vec scale = p[REPULSION] / r, repulsion = scale * ((u0 - u2) + (u1 - u3));
    const hs_vec push = hs_fma(scale, (f0 - f2) + (f1 - f3), repulsion / r);
    *force_over_r = push / r - p[ATTRACTION] * inv_q * inv_q;
    if (with_energy) *energy = repulsion - p[SIXTH] * hs_fma(p[TWICE_PRODUCT] * inv_q, q1 + q2, hs_log(q1 / q2));
}

static inline __attribute__((always_inline)) void ball_and_point(const hs_vec *p, hs_vec r2, hs_vec *force_over_r,
                                                                 hs_vec *energy, bool with_energy)
{
    const hs_vec a2 = p[A2], a4 = a2 * a2;
    const hs_vec inv_m = hs_set1(1.0) / (r2 - a2), inv_m3 = inv_m * inv_m * inv_m, inv_m9 = inv_m3 * inv_m3 * inv_m3;
    const hs_vec q = hs_fma(hs_fma(hs_fma(hs_set1(15.0), r2, hs_set1(63.0) * a2), r2, hs_set1(45.0) * a4), r2,
                            hs_set1(5.0) * a4 * a2);
    const hs_vec slope = hs_fma(hs_fma(hs_set1(45.0), r2, hs_set1(126.0) * a2), r2, hs_set1(45.0) * a4); /* dQ/dr^2 */
    const hs_vec repulsion = p[B9] * inv_m9 * hs_fma(hs_set1(9.0) * q, inv_m, hs_set1(0.0) - slope);
    *force_over_r = hs_set1(2.0) * (repulsion - hs_set1(3.0) * p[B3] * inv_m3 * inv_m);
    if (with_energy) *energy = p[B9] * q * inv_m9 - p[B3] * inv_m3;
}

HS_EVALUATE(const hs_vec *p, hs_vec r2, hs_vec *force_over_r, hs_vec *energy, bool with_energy)
{
    const hs_vec infinite = hs_set1(INFINITY), inv_r2 = hs_set1(1.0) / r2, inv_r6 = inv_r2 * inv_r2 * inv_r2;
    const hs_msk is_point = hs_less(p[N_BALLS], hs_set1(0.5)), is_two = hs_less(hs_set1(1.5), p[N_BALLS]);
    const hs_msk is_apart = hs_less(p[CONTACT] * p[CONTACT], r2);
    hs_vec f, f_two, u = infinite, u_two = infinite;
    ball_and_point(p, r2, &f, &u, with_energy);
    two_balls(p, r2, &f_two, &u_two, with_energy);
    const hs_vec f_point = inv_r6 * hs_fma(hs_set1(12.0) * p[R12], inv_r6, hs_set1(-6.0) * p[R6]) * inv_r2;
    f = hs_select(is_two, f_two, hs_select(is_point, f_point, f));
    *force_over_r = hs_select(is_apart, f, infinite);
    if (!with_energy) return;
    const hs_vec u_point = inv_r6 * hs_fma(p[R12], inv_r6, hs_set1(0.0) - p[R6]);
    u = hs_select(is_two, u_two, hs_select(is_point, u_point, u));
    *energy = hs_select(is_apart, u - p[SHIFT], infinite);
}

#define HS_EVALUATOR colloid
#include "kernel/instantiate.h"

#ifndef HS_KERNEL_ISA

#include "style/pair_coeffs.h"

/** Words of pair_coeff: energy, distance, diameters. */
enum { ENERGY, SIGMA, D1, D2 };

static hs_status coeff(hs_pair *pair, int i, int j, const hs_args *args, hs_error *err)
{
    hs_pair_coeff c = {.cutoff = 0.0};
    HS_TRY(hs_pair_coeffs_read(pair, "n000", args, &c, err));
    if (i == j && c.c[D1] != c.c[D2])
        return hs_fail(err, HS_ERROR_INPUT, "pair_coeff: atoms of type %d cannot have both diameters %g and %g", i,
                       c.c[D1], c.c[D2]);
    const double contact = 0.5 * (c.c[D1] + c.c[D2]);
    if (contact > 0.0 && c.cutoff > 0.0 && c.cutoff <= contact)
        return hs_fail(
            err, HS_ERROR_INPUT,
            "pair_coeff: the cutoff %g is a distance of centers, and spheres of diameters %g and %g touch at %g",
            c.cutoff, c.c[D1], c.c[D2], contact);
    *hs_pair_coeffs_at(pair, i, j) = c;
    return HS_OK;
}

static hs_status mix(hs_pair *pair, int i, int j, hs_error *err)
{
    const hs_pair_coeff a = *hs_pair_coeffs_at(pair, i, i), b = *hs_pair_coeffs_at(pair, j, j);
    hs_pair_coeff *c = hs_pair_coeffs_at(pair, i, j);
    (void)err;
    *c = (hs_pair_coeff){.cutoff = hs_pair_mix_distance(pair->mix, a.cutoff, b.cutoff)};
    c->c[ENERGY] = hs_pair_mix_energy(pair->mix, a.c[ENERGY], b.c[ENERGY], a.c[SIGMA], b.c[SIGMA]);
    for (int k = SIGMA; k <= D2; ++k) c->c[k] = hs_pair_mix_distance(pair->mix, a.c[k], b.c[k]);
    return HS_OK;
}

static void params(const hs_pair *pair, int i, int j, double *cutoff, double *p)
{
    const hs_pair_coeff c = *hs_pair_coeffs_at(pair, i, j);
    const double energy = c.c[ENERGY], sigma3 = pow(c.c[SIGMA], 3.0), sigma6 = sigma3 * sigma3;
    const double a1 = 0.5 * c.c[D1], a2 = 0.5 * c.c[D2], s = a1 + a2;
    double over_r, at_cutoff = 0.0;
    *cutoff = c.cutoff;
    p[N_BALLS] = (a1 > 0.0) + (a2 > 0.0);
    p[CONTACT] = s;
    p[SHIFT] = 0.0;
    p[R12] = energy * sigma6 * sigma6 / 36.0;
    p[R6] = energy * sigma6 / 36.0;
    p[A2] = s * s;
    p[B3] = 2.0 / 9.0 * energy * s * s * s * sigma3;
    p[B9] = p[B3] * sigma6 / 15.0;
    p[DIFFERENCE] = a1 - a2;
    p[PLUS] = 6.0 * (a1 * a1 + 7.0 * a1 * a2 + a2 * a2);
    p[MINUS] = 6.0 * (a1 * a1 - 7.0 * a1 * a2 + a2 * a2);
    p[REPULSION] = energy * sigma6 / 37800.0;
    p[SIXTH] = energy / 6.0;
    p[TWICE_PRODUCT] = 2.0 * a1 * a2;
    p[ATTRACTION] = 32.0 / 3.0 * energy * pow(a1 * a2, 3.0);
    if (pair->shift && c.cutoff > s) hs_evaluator_colloid.single(p, NULL, c.cutoff * c.cutoff, &over_r, &at_cutoff);
    p[SHIFT] = at_cutoff;
}

const hs_pair_style hs_pair_style_colloid = {
    .about =
        {.name = "colloid",
         .syntax = {.usage = "<cutoff>", .n_min = 1, .n_max = 1},
         .summary = "large spheres made of Lennard-Jones matter, and small particles among them",
         .details =
             "The Lennard-Jones potential summed over the matter of two spheres (formulas in the reference, and at the "
             "head of src/pair/colloid.c): between two large ones, a large and a small one, or two small ones, which "
             "have A/36 [(sigma/r)^12 - (sigma/r)^6], so that A = 144 is Lennard-Jones with epsilon = 1.\n\n"
             "`pair_coeff I J <A> <sigma> <d1> <d2> [<cutoff>]`: A (energy) is the Hamaker constant, 4 pi^2 (rho1 "
             "rho2) epsilon sigma^6 for densities of matter rho; sigma the size of what the spheres are made of; d1 "
             "and d2 the diameters of atoms of type I and of type J, 0 for a small particle. Distances and the cutoff "
             "are those of centers. Spheres that overlap stop the run. `pair_modify shift yes` makes the energy zero "
             "at the cutoff. Unlike pairs are mixed: A as the energy, sigma, d1, d2 and the cutoff as distances "
             "(`pair_modify mix`); where sizes differ, give them with pair_coeff, for mixed diameters are seldom "
             "meant.",
         .reference = "R. Everaers, M. R. Ejtehadi, Phys. Rev. E 67, 041710 (2003), doi:10.1103/PhysRevE.67.041710",
         .example = "pair_style colloid 12.5\npair_coeff 1 1 1.0 1.0 5.0 5.0 12.5\npair_coeff 1 2 5.0 1.0 5.0 0.0 "
                    "7.0\npair_coeff 2 2 10.0 1.0 0.0 0.0 2.5"},
    .coeff_syntax = {.usage = "<A> <sigma> <d1> <d2> [<cutoff>]", .n_min = 4, .n_max = 5},
    HS_PAIR_COEFFS_HOOKS,
    .coeff = coeff,
    .mix = mix,
    .params = params,
    .evaluator = &hs_evaluator_colloid,
};

#endif
