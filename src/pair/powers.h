/** Potentials of two powers of the distance,  U(r) = A r^-n - B r^-m - shift:  what mie/cut, nm/cut, lj96/cut and lj/class2
 *  share. Their evaluator is in mie_cut.c. */
#ifndef HS_PAIR_POWERS_H
#define HS_PAIR_POWERS_H

/** Parameters of the evaluator. */
enum { MINUS_HALF_N, MINUS_HALF_M, A, B, N_A, M_B, SHIFT, N_PARAMS };

#ifndef HS_KERNEL_ISA

#include "pair/lj_coeffs.h"

/** A potential of one pair of types: energy distance^n, energy distance^m. */
typedef struct hs_powers {
    double a, n, b, m;
} hs_powers;

/** Of the coefficients of one pair of types: every style that includes this defines it. */
static hs_powers powers_of(const hs_pair_coeff *c);

/** ->params */
static inline void hs_powers_params(const hs_pair *pair, int i, int j, double *cutoff, double *p)
{
    const hs_pair_coeff *c = hs_pair_coeffs_at(pair, i, j);
    const hs_powers u = powers_of(c);
    *cutoff = c->cutoff;
    p[MINUS_HALF_N] = -0.5 * u.n;
    p[MINUS_HALF_M] = -0.5 * u.m;
    p[A] = u.a;
    p[B] = u.b;
    p[N_A] = u.n * u.a;
    p[M_B] = u.m * u.b;
    p[SHIFT] = pair->shift && c->cutoff > 0.0 ? u.a * pow(c->cutoff, -u.n) - u.b * pow(c->cutoff, -u.m) : 0.0;
}

/** ->tail: integrals of U and of r dU/dr from the cutoff to infinity with g(r) = 1, per n_i n_j / V: both exponents above 3. */
static inline void hs_powers_tail(const hs_pair *pair, int i, int j, double *energy, double *virial)
{
    const hs_pair_coeff *c = hs_pair_coeffs_at(pair, i, j);
    const hs_powers u = powers_of(c);
    const double repulsion = u.a * pow(c->cutoff, 3.0 - u.n) / (u.n - 3.0),
                 attraction = u.b * pow(c->cutoff, 3.0 - u.m) / (u.m - 3.0);
    *energy = 2.0 * M_PI * (repulsion - attraction);
    *virial = 2.0 * M_PI / 3.0 * (u.n * repulsion - u.m * attraction);
}

/** Read word i, an exponent of the repulsion, and word i + 1, a smaller one of the attraction. */
static inline HS_MUST_USE hs_status hs_powers_read(const hs_args *args, int i, double *n, double *m, hs_error *err)
{
    HS_TRY(hs_arg_positive(args, i, n, err));
    HS_TRY(hs_arg_positive(args, i + 1, m, err));
    return *m < *n ? HS_OK : hs_arg_refuse(args, i + 1, "smaller than the exponent of the repulsion", NULL, err);
}

/** ->init of styles whose exponents are coefficients @p at and @p at + 1: tails exist only above 3. */
static inline HS_MUST_USE hs_status hs_powers_check_tail(const hs_pair *pair, int at, hs_error *err)
{
    for (int i = 1; i <= pair->n_types && pair->tail; ++i)
        for (int j = i; j <= pair->n_types; ++j)
            if (pair->is_set[hs_pair_index(pair, i, j)] && hs_pair_coeffs_at(pair, i, j)->c[at + 1] <= 3.0)
                return hs_fail(
                    err, HS_ERROR_INPUT,
                    "pair_style %s: 'pair_modify tail yes' needs exponents above 3; that of types %d %d is %g",
                    pair->style->about.name, i, j, hs_pair_coeffs_at(pair, i, j)->c[at + 1]);
    return HS_OK;
}

#endif
#endif
